"""dtwalign: step patterns and windows over scipy's metrics."""

from dtwalign import dtw

PACKAGE = "dtwalign"
LICENCE = "MIT"


def distance(P, Q, dist="euclidean", step_pattern="symmetric1", **options):
    """Return the distance without the path."""
    return dtw(P, Q, dist=dist, step_pattern=step_pattern, dist_only=True, **options).distance


def window(P, Q, radius):
    """Return dtw of squares in its band."""
    return distance(P, Q, "sqeuclidean", window_type="sakoechiba", window_size=radius)


CHECKS = {
    "dtw": distance,
    "dtw-squared": lambda P, Q: distance(P, Q, "sqeuclidean"),
    "dtw-symmetric2": lambda P, Q: distance(P, Q, step_pattern="symmetric2"),
    "dtw-asymmetric": lambda P, Q: distance(P, Q, step_pattern="asymmetric"),
    "dtw-window": window,
    "dtw-window-difference": window,
}
