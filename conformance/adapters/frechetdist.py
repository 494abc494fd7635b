"""frechetdist: the recursion of Eiter & Mannila, for curves of equal length."""

from frechetdist import frdist

PACKAGE = "frechetdist"
LICENCE = "MIT"


def equal_lengths(P, Q):
    """Return the discrete Fréchet distance of curves of equal length."""
    if len(P) != len(Q) and len(P) and len(Q):
        raise NotImplementedError("curves of equal length")
    return frdist(P, Q)


CHECKS = {"frechet": equal_lengths}
