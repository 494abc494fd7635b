"""Several measures of one pair of curves, and how far apart the compared points are."""
