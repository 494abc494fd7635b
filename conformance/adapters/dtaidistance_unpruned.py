"""dtaidistance with use_pruning=False, for series of numbers."""

from dtaidistance import dtw

PACKAGE = "dtaidistance"
NAME = "dtaidistance, use_pruning=False"
LICENCE = "Apache-2.0"


def distance(P, Q, **options):
    """Return its distance, the whole table computed."""
    if P.shape[1] != 1 or Q.shape[1] != 1:
        raise NotImplementedError("series of numbers")
    return dtw.distance_fast(P.ravel(), Q.ravel(), use_pruning=False, **options)


CHECKS = {
    "dtw": lambda P, Q: distance(P, Q, inner_dist="euclidean"),
    "dtw-squared": lambda P, Q: distance(P, Q) ** 2,
    "dtw-squared-root": distance,
    "dtw-window": lambda P, Q, radius: distance(P, Q, window=radius + 1) ** 2,
}
