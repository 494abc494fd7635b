"""dtwParallel: dependent dtw of series of vectors with a distance of scipy's."""

from dtwParallel.dtw_functions import dtw
from scipy.spatial.distance import euclidean, sqeuclidean

PACKAGE = "dtwparallel"
LICENCE = "BSD-2-Clause"


def distance(P, Q, ground=euclidean, **options):
    """Return dtw of two series."""
    return dtw(P, Q, type_dtw="d", local_dissimilarity=ground, MTS=True, **options)


def window(P, Q, radius):
    """Return dtw of squares in its band."""
    band = {"constrained_path_search": "sakoe_chiba", "sakoe_chiba_radius": radius}
    return distance(P, Q, sqeuclidean, **band)


CHECKS = {
    "dtw": distance,
    "dtw-squared": lambda P, Q: distance(P, Q, sqeuclidean),
    "dtw-window": window,
    "dtw-window-widened": window,
}
