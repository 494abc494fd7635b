"""dtw (Pierre Rouanet's): dtw with a function for the distance of two points."""

from dtw import dtw
from scipy.spatial.distance import euclidean, sqeuclidean

PACKAGE = "dtw"
LICENCE = "GPL-3.0"
CHECKS = {
    "dtw": lambda P, Q: dtw(P, Q, dist=euclidean)[0],
    "dtw-squared": lambda P, Q: dtw(P, Q, dist=sqeuclidean)[0],
}
