"""dtw-python, R's dtw: step patterns, windows, open ends of normalisable patterns."""

from dtw import dtw

PACKAGE = "dtw-python"
LICENCE = "GPL-3.0"


def distance(P, Q, metric="euclidean", step_pattern="symmetric1", **options):
    """Return the distance without the path."""
    return dtw(
        P, Q, dist_method=metric, step_pattern=step_pattern, distance_only=True, **options
    ).distance


def window(P, Q, radius):
    """Return dtw of squares in its band."""
    band = {"window_type": "sakoechiba", "window_args": {"window_size": radius}}
    return distance(P, Q, "sqeuclidean", **band)


CHECKS = {
    "dtw": distance,
    "dtw-squared": lambda P, Q: distance(P, Q, "sqeuclidean"),
    "dtw-symmetric2": lambda P, Q: distance(P, Q, step_pattern="symmetric2"),
    "dtw-asymmetric": lambda P, Q: distance(P, Q, step_pattern="asymmetric"),
    "dtw-window": window,
    "dtw-window-difference": window,
}
