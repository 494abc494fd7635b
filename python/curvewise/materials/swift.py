"""Swift's isotropic hardening."""

from __future__ import annotations

from dataclasses import dataclass

from .._bounds import Bounds, Log
from .material import Material
from .readings import Span

__all__ = ["Swift"]


@dataclass(frozen=True)
class Swift(Material):
    r"""Swift's isotropic hardening by a power law.

    .. math::

        |\sigma| \le K (\varepsilon_0 + p)^n

    with the accumulated plastic strain p. There is no kinematic hardening, so the model is one of
    monotonic tests. Each step of strain is exact, whatever its length.

    References
    ----------
    H. W. Swift, "Plastic instability under plane stress", Journal of the Mechanics and Physics of
    Solids 1 (1952) 1-18.

    Examples
    --------
    >>> from curvewise.materials import Swift
    >>> steel = Swift()
    >>> steel.names
    ('E', 'K', 'e0', 'n')
    >>> constants = dict(zip(steel.names, (200e3, 720.0, 0.004, 0.21)))
    >>> steel.stress([0.001, 0.02, 0.018], constants).round(2)
    array([200.  , 324.19, -75.81])
    """

    name = "swift"
    yield_stress = ""
    has_kinematic_hardening = False

    def _hardening_bounds(self, span: Span) -> Bounds:
        return {
            "K": Log(0.5 * span.lowest_yield, 20.0 * span.stress),
            "e0": Log(1e-6, max(0.5, span.path)),
            "n": (0.0, 1.0),
        }
