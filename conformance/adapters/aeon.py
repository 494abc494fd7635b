"""aeon: sums of squares; its window is a share of the shorter length, here half a cell more."""

from aeon.distances import adtw_distance, dtw_distance

PACKAGE = "aeon"
LICENCE = "BSD-3-Clause"


def window(P, Q, radius):
    """Return dtw in its band."""
    share = min(1.0, (radius + 0.5) / min(len(P), len(Q)))
    return dtw_distance(P.T.copy(), Q.T.copy(), window=share)


def penalised(P, Q, penalty):
    """Return the amerced distance."""
    return adtw_distance(P.T.copy(), Q.T.copy(), warp_penalty=penalty)


CHECKS = {
    "dtw-squared": lambda P, Q: dtw_distance(P.T.copy(), Q.T.copy()),
    "dtw-window": window,
    "dtw-window-scaled": window,
    "dtw-penalty": penalised,
}
OTHER = {"dtw-window-scaled": "follows the diagonal too, by cells rounded down"}
