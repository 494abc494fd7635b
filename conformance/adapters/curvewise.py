"""curvewise, called as its users call it; the root of dtw-squared-root is taken here."""

from math import sqrt

import curvewise
from curvewise import dtw

PACKAGE = "curvewise"
VERSION = curvewise.__version__
LICENCE = "MIT"


def squared(P, Q, **options):
    """Return dtw of squared distances."""
    return dtw(P, Q, metric="sqeuclidean", **options)


CHECKS = {
    "frechet": curvewise.frechet,
    "frechet-continuous": curvewise.frechet_continuous,
    "hausdorff": curvewise.hausdorff,
    "area": curvewise.area,
    "dtw": dtw,
    "dtw-squared": squared,
    "dtw-squared-root": lambda P, Q: sqrt(squared(P, Q)),
    "dtw-symmetric2": lambda P, Q: dtw(P, Q, step_pattern="symmetric2"),
    "dtw-asymmetric": lambda P, Q: dtw(P, Q, step_pattern="asymmetric"),
    "dtw-window": lambda P, Q, radius: squared(P, Q, window=radius),
    "dtw-window-scaled": lambda P, Q, radius: squared(P, Q, window=radius),
    "dtw-penalty": lambda P, Q, penalty: squared(P, Q, penalty=penalty),
    "dtw-open-end": lambda P, Q: squared(P, Q, open_end=True),
    "dtw-subsequence": lambda P, Q: squared(P, Q, open_begin=True, open_end=True),
}
NOTES = {
    "dtw-squared-root": "the squares overflow or vanish before the root that the adapter takes",
}
