"""Ohno and Wang's back stresses, version II, which ratchet less than Chaboche's."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from .._bounds import Bounds, Log
from .chaboche_voce import backstress_bounds
from .material import Material
from .readings import Span

__all__ = ["OhnoWang"]


@dataclass(frozen=True)
class OhnoWang(Material):
    r"""Ohno and Wang's kinematic and Voce's isotropic hardening.

    .. math::

        \left|\sigma - \sum_k X_k\right| \le \sigma_y + Q (1 - e^{-b p}), \qquad
        dX_k = \zeta_k \left( r_k \, d\varepsilon_p - \left(\frac{|X_k|}{r_k}\right)^{m_k} X_k
        \left\langle d\varepsilon_p \, \operatorname{sign} X_k \right\rangle \right)

    with the plastic strain :math:`\varepsilon_p` and its length p (factors of 2/3 and 3/2 absorbed
    into the constants). The recall acts near the limit of a back stress, and not while it unloads.
    Loops under unequal stresses therefore ratchet less than with Chaboche's model, and not at all
    as m grows. Each step of strain is exact, whatever its length.

    Parameters
    ----------
    backstresses : int, default 2
        Number of back stresses, 0 to 99. Their parameters are zeta1, r1, m1, zeta2, r2, m2, …

    References
    ----------
    N. Ohno, J.-D. Wang, "Kinematic hardening rules with critical state of dynamic recovery",
    International Journal of Plasticity 9 (1993) 375-403, part I: version II.

    Examples
    --------
    >>> from curvewise.materials import OhnoWang
    >>> steel = OhnoWang(backstresses=1)
    >>> steel.names
    ('E', 'yield', 'Q', 'b', 'zeta1', 'r1', 'm1')
    >>> constants = dict(zip(steel.names, (200e3, 300.0, 0.0, 1.0, 60.0, 150.0, 4.0)))
    >>> steel.stress([0.001, 0.02, 0.018, -0.02], constants).round(2)
    array([ 200.  ,  436.76,   36.76, -443.31])
    """

    name = "ohno-wang"
    yield_stress = "yield"
    isotropic = MappingProxyType({"Q": 0.0, "b": 1.0})

    backstresses: int = 2

    def _hardening_bounds(self, span: Span) -> Bounds:
        bounds: dict[str, Any] = {
            "yield": Log(0.02 * span.lowest_yield, 1.2 * span.highest_yield),
            "Q": (-1.2 * span.highest_yield, 4.0 * span.stress),
            "b": Log(0.02 / span.path, 200.0 / span.path),
        }
        rates = backstress_bounds(self.backstresses, span)
        for k in range(1, self.backstresses + 1):
            bounds[f"zeta{k}"] = rates[f"gamma{k}"]
            bounds[f"r{k}"] = Log(0.01 * span.stress, 2.0 * span.stress)
            bounds[f"m{k}"] = Log(0.1, 100.0)
        return bounds
