"""The updated Voce-Chaboche model, whose yield stress also falls."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from .._bounds import Below, Bounds, Log
from .chaboche_voce import backstress_bounds
from .material import Material
from .readings import Span

__all__ = ["UpdatedVoceChaboche"]


@dataclass(frozen=True)
class UpdatedVoceChaboche(Material):
    r"""Chaboche's hardening with an initial fall of the yield stress.

    .. math::

        \left|\sigma - \sum_k X_k\right| \le \sigma_y + Q (1 - e^{-b p}) - D (1 - e^{-a p}), \qquad
        dX_k = C_k \, d\varepsilon_p - \gamma_k X_k \, dp

    with the plastic strain :math:`\varepsilon_p` and its length p (factors of 2/3 and 3/2 absorbed
    into the constants). The fall D models the yield plateau of mild steel, and the smaller elastic
    range after the first yielding. Each step of strain is exact, whatever its length.

    Parameters
    ----------
    backstresses : int, default 2
        Number of back stresses, 0 to 99. Their parameters are C1, gamma1, C2, gamma2, …

    References
    ----------
    A. R. Hartloper, A. de Castro e Sousa, D. G. Lignos, "Constitutive modeling of structural
    steels: nonlinear isotropic/kinematic hardening material model and its calibration", Journal of
    Structural Engineering 147 (2021) 04021031.

    Examples
    --------
    >>> from curvewise.materials import UpdatedVoceChaboche
    >>> steel = UpdatedVoceChaboche(backstresses=1)
    >>> steel.names
    ('E', 'yield', 'Q', 'b', 'D', 'a', 'C1', 'gamma1')
    >>> constants = dict(zip(steel.names, (200e3, 350.0, 100.0, 10.0, 90.0, 200.0, 15e3, 120.0)))
    >>> steel.stress([0.001, 0.003, 0.01, 0.02], constants).round(2)
    array([200.  , 348.75, 363.55, 389.62])
    """

    name = "updated-voce-chaboche"
    yield_stress = "yield"
    isotropic = MappingProxyType({"Q": 0.0, "b": 1.0, "D": 0.0, "a": 1.0})

    backstresses: int = 2

    def _hardening_bounds(self, span: Span) -> Bounds:
        bounds: dict[str, Any] = {
            "yield": Log(0.02 * span.lowest_yield, 2.0 * span.highest_yield),
            "Q": (0.0, 4.0 * span.stress),
            "b": Log(0.02 / span.path, 200.0 / span.path),
            "D": Below("yield", 1e-3 * span.lowest_yield, 2.0 * span.highest_yield),
            "a": Log(0.2 / span.path, 2e4 / span.path),
        }
        return bounds | backstress_bounds(self.backstresses, span)
