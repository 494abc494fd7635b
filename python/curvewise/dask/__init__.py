"""One measure between many curves, on any scheduler of dask: threads, processes, a cluster.

The matrix of :func:`curvewise.cdist` is cut into blocks. A block is one call of curvewise.cdist for
some rows and columns, on any worker of dask. A value depends only on its two curves, so blocks give
bitwise identical values. A block that is lost with its worker is computed again. Cost: that of the
local matrix, and about a millisecond for each block for dask's scheduler. The curves are stored
once in the graph, in pieces of a block's rows or columns.

With ``store="d.zarr"`` each block is written to disk when it is finished. The matrix may then be
larger than memory, and an interrupted call continues from the stored blocks. Nearest neighbours are
found in one index for each block of the curves, and merged.
"""

from .._names import names_alone
from .matrix import cdist, pdist
from .neighbors import kneighbors

__all__ = ["cdist", "kneighbors", "pdist"]
__dir__ = names_alone(__all__)
