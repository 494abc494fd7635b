"""PathSimAnalysis (of MDAnalysis): a point is an atom in space, zeros stand for absent axes."""

import numpy as np
from pathsimanalysis import discrete_frechet, hausdorff

PACKAGE = "pathsimanalysis"
LICENCE = "LGPL-2.1"


def atoms(curve):
    """Return points as one atom with three coordinates."""
    if curve.shape[1] > 3:
        raise NotImplementedError("three dimensions")
    return np.pad(curve, ((0, 0), (0, 3 - curve.shape[1])))


CHECKS = {
    "frechet": lambda P, Q: discrete_frechet(atoms(P), atoms(Q)),
    "hausdorff": lambda P, Q: hausdorff(atoms(P), atoms(Q)),
}
