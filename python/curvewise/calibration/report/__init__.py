"""Report of a search as one HTML page.

The page shows the problem, the results, and how to repeat the search. It depends only on the record
of the search (search_record.py), not on a clock or random numbers. A page made from a store is
therefore bitwise identical to the page of the search that filled it. The browser draws the figures
with plotly.js, which the page contains: it opens without a network. plotly is needed: ``pip install
"curvewise[report]"``.
"""

from .page import page, write_report
from .reading import records_of

__all__ = ["page", "records_of", "write_report"]
