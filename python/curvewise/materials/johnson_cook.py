"""Johnson and Cook's isotropic hardening with the rate of strain."""

from __future__ import annotations

from dataclasses import dataclass

from .._bounds import Bounds, Log
from .material import Material
from .readings import Span

__all__ = ["JohnsonCook"]


@dataclass(frozen=True)
class JohnsonCook(Material):
    r"""Johnson and Cook's hardening at a rate of strain.

    .. math::

        |\sigma| \le (A + B p^n) \left(1 + C \ln \frac{\dot\varepsilon}{\dot\varepsilon_0}\right)

    with the accumulated plastic strain p, at the reference temperature. There is no kinematic
    hardening, so the model is one of monotonic tests. Each test has one rate of strain: pass
    `rates` to `driven_by`. Each step of strain is exact, whatever its length.

    Parameters
    ----------
    rate : float, default 1.0
        Rate of strain of the test [1/s]; positive.
    reference_rate : float, default 1.0
        Rate of strain at which C has no effect [1/s]; positive.

    References
    ----------
    G. R. Johnson, W. H. Cook, "A constitutive model and data for metals subjected to large strains,
    high strain rates and high temperatures", Proceedings of the 7th International Symposium on
    Ballistics (1983) 541-547.

    Examples
    --------
    >>> from curvewise.materials import JohnsonCook
    >>> steel = JohnsonCook(rate=1000.0)
    >>> steel.names
    ('E', 'A', 'B', 'n', 'C')
    >>> constants = dict(zip(steel.names, (200e3, 350.0, 275.0, 0.36, 0.022)))
    >>> steel.stress([0.001, 0.05], constants).round(2)
    array([200.  , 508.93])

    Tests at several rates identify C:

    >>> import numpy as np
    >>> tests = [np.array([[0.0, 0.0], [0.05, 442.0]]), np.array([[0.0, 0.0], [0.05, 509.0]])]
    >>> model = JohnsonCook().driven_by(tests, rates=[1.0, 1000.0])
    >>> [round(float(curve[-1, 1]), 1) for curve in model(constants)]
    [442.0, 508.9]
    """

    name = "johnson-cook"
    yield_stress = "A"
    has_kinematic_hardening = False

    rate: float = 1.0
    reference_rate: float = 1.0

    def _hardening_bounds(self, span: Span) -> Bounds:
        return {
            "A": Log(0.02 * span.lowest_yield, 1.2 * span.highest_yield),
            "B": Log(0.01 * span.stress, 20.0 * span.stress),
            "n": (0.05, 1.0),
            "C": (0.0, 0.1),
        }
