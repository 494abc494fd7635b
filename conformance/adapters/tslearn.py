"""tslearn: dtw is the root of a sum of squares, which is undone where a check asks for the sum."""

from tslearn import metrics

PACKAGE = "tslearn"
LICENCE = "BSD-2-Clause"


def window(P, Q, radius):
    """Return dtw in a Sakoe–Chiba band."""
    return metrics.dtw(P, Q, global_constraint="sakoe_chiba", sakoe_chiba_radius=radius) ** 2


CHECKS = {
    "frechet": metrics.frechet,
    "dtw": lambda P, Q: metrics.dtw_path_from_metric(P, Q, metric="euclidean")[1],
    "dtw-squared": lambda P, Q: metrics.dtw(P, Q) ** 2,
    "dtw-squared-root": metrics.dtw,
    "dtw-window": window,
    "dtw-window-widened": window,
    "dtw-subsequence": lambda P, Q: metrics.dtw_subsequence_path(P, Q)[1] ** 2,
}
NOTES = {"dtw": "distances from expanded squares lose half of their digits between near points"}
