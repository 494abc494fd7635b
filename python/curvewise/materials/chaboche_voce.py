"""Chaboche's back stresses with Voce's isotropic hardening or softening."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

from .._bounds import Bounds, Log
from .material import Material
from .readings import Span

__all__ = ["ChabocheVoce", "backstress_bounds"]


@dataclass(frozen=True)
class ChabocheVoce(Material):
    r"""Chaboche's kinematic and Voce's isotropic hardening.

    .. math::

        \left|\sigma - \sum_k X_k\right| \le \sigma_y + Q (1 - e^{-b p}), \qquad
        dX_k = C_k \, d\varepsilon_p - \gamma_k X_k \, dp

    with the plastic strain :math:`\varepsilon_p` and its length p (factors of 2/3 and 3/2 absorbed
    into the constants). Each step of strain is exact, however long: in one direction of flow all is
    closed in p, for which one equation is solved.

    Parameters
    ----------
    backstresses : int, default 2
        Number of back stresses, 0 to 99. Their parameters are C1, gamma1, C2, gamma2, …
    modulus : {"constant", "decaying"}, default "constant"
        "decaying": :math:`d\sigma = E(p) \, d\varepsilon_e` with
        :math:`E(p) = E - (E - E_a)(1 - e^{-\xi p})`, with parameters Ea and xi.

    References
    ----------
    J. L. Chaboche, "Time-independent constitutive theories for cyclic plasticity", International
    Journal of Plasticity 2 (1986) 149-188. F. Yoshida, T. Uemori, K. Fujiwara, "Elastic-plastic
    behavior of steel sheets under in-plane cyclic tension-compression at large strain", ibid. 18
    (2002) 633-659, for the modulus.

    Examples
    --------
    >>> from curvewise.materials import ChabocheVoce
    >>> steel = ChabocheVoce(backstresses=1)
    >>> steel.names
    ('E', 'yield', 'Q', 'b', 'C1', 'gamma1')
    >>> constants = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0)))
    >>> steel.stress([0.001, 0.02, 0.018, -0.02], constants).round(2)
    array([ 200.  ,  493.28,   93.28, -482.81])
    """

    name = "chaboche-voce"
    yield_stress = "yield"
    isotropic = MappingProxyType({"Q": 0.0, "b": 1.0})
    backstresses: int = 2
    modulus: Literal["constant", "decaying"] = "constant"

    def _hardening_bounds(self, span: Span) -> Bounds:
        # Steep back stresses leave little initial yield stress; softening may remove much of it.
        bounds: dict[str, Any] = {
            "yield": Log(0.02 * span.lowest_yield, 1.2 * span.highest_yield),
            "Q": (-1.2 * span.highest_yield, 4.0 * span.stress),
            "b": Log(0.02 / span.path, 200.0 / span.path),
        }
        return bounds | backstress_bounds(self.backstresses, span)


def backstress_bounds(count: int, span: Span) -> dict[str, Any]:
    """Return the bounds of C and gamma of each back stress.

    Parameters
    ----------
    count : int
    span : Span
        The readings of the tests.
    """
    bounds: dict[str, Any] = {}
    # The range of rates is divided among the back stresses, the first the fastest, so that they
    # do not change places. It extends from saturation within a thousandth of a branch to almost
    # a line.
    slowest, fastest = 0.02 / span.longest_branch, 2000.0 / span.shortest_branch
    for k in range(count):
        first, last = (1.0 - (k + f) / count for f in (1.15, -0.15))
        low, high = (
            slowest * (fastest / slowest) ** min(max(place, 0.0), 1.0) for place in (first, last)
        )
        bounds[f"gamma{k + 1}"] = Log(low, high)
        # The back stress saturates at C / gamma, and rises by C times a branch if it does not.
        softest, stiffest = (max(rate, 1.0 / span.longest_branch) for rate in (low, high))
        bounds[f"C{k + 1}"] = Log(0.01 * span.stress * softest, 2.0 * span.stress * stiffest)
    return bounds
