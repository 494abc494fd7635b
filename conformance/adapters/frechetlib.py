"""frechetlib: discrete and continuous Fréchet distances."""

import frechetlib

PACKAGE = "frechetlib"
LICENCE = "MIT"
CHECKS = {
    "frechet": lambda P, Q: frechetlib.discrete_frechet(P, Q)[0],
    "frechet-continuous": lambda P, Q: frechetlib.frechet_c_compute(P, Q).dist,
}
