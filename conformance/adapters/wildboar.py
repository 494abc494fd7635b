"""wildboar: distances of series of numbers, of equal length where they are paired."""

from wildboar.distance import pairwise_distance

PACKAGE = "wildboar"
LICENCE = "BSD-3-Clause"


def numbers(P, Q, metric="dtw", **options):
    """Return a distance of two series of numbers of equal length."""
    if P.shape[1] != 1 or Q.shape[1] != 1 or len(P) != len(Q):
        raise NotImplementedError("series of numbers, of equal length")
    found = pairwise_distance(P.T.copy(), Q.T.copy(), metric=metric, metric_params=options)
    return found.item()


CHECKS = {
    "dtw-squared": lambda P, Q: numbers(P, Q) ** 2,
    "dtw-squared-root": numbers,
}
