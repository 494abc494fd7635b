"""pyts: dtw of series of numbers; the root of a sum of squares, undone where need be."""

from pyts.metrics import dtw

PACKAGE = "pyts"
LICENCE = "BSD-3-Clause"


def numbers(P, Q, **options):
    """Return dtw of series of numbers."""
    if P.shape[1] != 1 or Q.shape[1] != 1:
        raise NotImplementedError("series of numbers")
    return dtw(P.ravel(), Q.ravel(), **options)


def window(P, Q, radius):
    """Return dtw of squares in its band."""
    return numbers(P, Q, method="sakoechiba", options={"window_size": radius}) ** 2


CHECKS = {
    "dtw": lambda P, Q: numbers(P, Q, dist="absolute"),
    "dtw-squared": lambda P, Q: numbers(P, Q) ** 2,
    "dtw-squared-root": numbers,
    "dtw-window": window,
    "dtw-window-scaled": window,
}
OTHER = {"dtw-window-scaled": "a band around the diagonal by another rule"}
