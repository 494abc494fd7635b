"""One measure between many curves, on any scheduler of dask: threads, processes, a cluster.

The matrix of :func:`curvewise.cdist` is cut into blocks. A block is one call of curvewise.cdist for
some rows and columns, made wherever dask makes it. Since a value depends on its two curves alone,
the blocks change no bit, and a block that is lost with its worker is simply computed again. Cost:
that of the local matrix, and about a millisecond a block for dask's scheduler. The curves go into
the graph once, in pieces of a block's rows or columns.

With ``store="d.zarr"`` each block is written to disk as it is done, so that the matrix may be
larger than memory, and what was cut short is begun again where it stopped. Nearest neighbours are
found block by block, in an index of each block of the curves, and merged.
"""

from .matrix import cdist, pdist
from .neighbors import kneighbors

__all__ = ["cdist", "kneighbors", "pdist"]
