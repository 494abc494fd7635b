"""frechetlib: discrete and continuous Fréchet distances."""

from frechetlib.continuous_frechet import frechet_c_compute
from frechetlib.discrete_frechet import discrete_frechet

PACKAGE = "frechetlib"
LICENCE = "MIT"
CHECKS = {
    "frechet": lambda P, Q: discrete_frechet(P, Q)[0],
    "frechet-continuous": lambda P, Q: frechet_c_compute(P, Q).dist,
}
