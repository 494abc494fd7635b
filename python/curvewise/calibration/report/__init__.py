"""A search as one page of HTML: what was searched, what was found, and how to repeat it.

The page is made of what a search has written down (search_record.py) and of nothing else, no clock
and no random number, so that the page of a store is the page of the search that filled it, bit for
bit. Its figures are drawn in the browser by plotly.js, which the page carries: it opens without a
network. plotly is needed: ``pip install "curvewise[report]"``.
"""

from .page import page, write_report
from .reading import records_of

__all__ = ["page", "records_of", "write_report"]
