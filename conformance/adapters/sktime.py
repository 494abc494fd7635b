"""sktime: DtwDist of two panels of one series each; equal lengths, by its documentation."""

from sktime.dists_kernels.dtw import DtwDist

PACKAGE = "sktime"
LICENCE = "BSD-3-Clause"


def distance(P, Q, **options):
    """Return dtw of two series."""
    if len(P) != len(Q) and len(P) and len(Q):
        raise NotImplementedError("series of equal length")
    return DtwDist(**options).transform(P.T[None].copy(), Q.T[None].copy())[0, 0]


CHECKS = {"dtw-squared": distance}
