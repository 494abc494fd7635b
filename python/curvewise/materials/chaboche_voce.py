"""Chaboche's back stresses with Voce's isotropic hardening or softening."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .._core import chaboche_voce_parameters, chaboche_voce_stress
from .material import Material

__all__ = ["ChabocheVoce"]


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
        How many, 0 to 99. C1, gamma1, C2, gamma2, … are their parameters.
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

    backstresses: int = 2
    modulus: Literal["constant", "decaying"] = "constant"

    @property
    def _compiled(self) -> tuple[Any, Any]:
        return chaboche_voce_parameters, chaboche_voce_stress
