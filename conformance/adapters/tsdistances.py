"""tsdistances: sums of squares, of series of numbers; its band is a share of the length."""

import tsdistances

PACKAGE = "tsdistances"
LICENCE = "MIT"


def numbers(function, P, Q, **options):
    """Return a distance of series of numbers."""
    if P.shape[1] != 1 or Q.shape[1] != 1:
        raise NotImplementedError("series of numbers")
    return function(P.ravel(), Q.ravel(), par=False, **options)


def penalised(P, Q, penalty):
    """Return the amerced distance."""
    return numbers(tsdistances.adtw_distance, P, Q, warp_penalty=penalty)


def window(P, Q, radius):
    """Return dtw in its band."""
    share = min(1.0, radius / max(1, len(P)))
    return numbers(tsdistances.dtw_distance, P, Q, band=share)


CHECKS = {
    "dtw-squared": lambda P, Q: numbers(tsdistances.dtw_distance, P, Q),
    "dtw-window": window,
    "dtw-penalty": penalised,
}
