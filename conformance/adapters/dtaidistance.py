"""dtaidistance, its compiled functions: the root of a sum of squares, undone where need be.

Its window counts the diagonal, and its penalty is squared like the distances.
"""

from math import sqrt

from dtaidistance import dtw, dtw_ndim

PACKAGE = "dtaidistance"
LICENCE = "Apache-2.0"


def distance(P, Q, **options):
    """Return its distance by the function for numbers or the one for points."""
    if P.shape[1] == Q.shape[1] == 1:
        return dtw.distance_fast(P.ravel(), Q.ravel(), **options)
    return dtw_ndim.distance_fast(P, Q, **options)


def window(P, Q, radius):
    """Return the squared distance in its band."""
    return distance(P, Q, window=radius + 1) ** 2


CHECKS = {
    "dtw": lambda P, Q: distance(P, Q, inner_dist="euclidean"),
    "dtw-squared": lambda P, Q: distance(P, Q) ** 2,
    "dtw-squared-root": distance,
    "dtw-window": window,
    "dtw-window-widened": window,
    "dtw-penalty": lambda P, Q, penalty: distance(P, Q, penalty=sqrt(penalty)) ** 2,
    "dtw-open-end": lambda P, Q: distance(P, Q, psi=(0, 0, 0, len(Q) - 1)) ** 2,
    "dtw-subsequence": lambda P, Q: distance(P, Q, psi=(0, 0, len(Q) - 1, len(Q) - 1)) ** 2,
}
PRUNING = (
    "series of numbers are pruned by default, by a bound that is rounded and ignores penalties; "
    "with use_pruning=False the value is right"
)
NOTES = dict.fromkeys(CHECKS, PRUNING)
