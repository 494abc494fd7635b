"""dtw (Pierre Rouanet's): dtw with a function for the distance of two points."""

from dtw import accelerated_dtw, dtw
from scipy.spatial.distance import euclidean

PACKAGE = "dtw"
LICENCE = "GPL-3.0"
CHECKS = {
    "dtw": lambda P, Q: dtw(P, Q, dist=euclidean)[0],
    "dtw-squared": lambda P, Q: accelerated_dtw(P, Q, dist="sqeuclidean")[0],
}
