"""Yoshida and Uemori's two surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .._bounds import Below, Bounds, Log, on_its_scale
from .material import Material
from .readings import Span

__all__ = ["YoshidaUemori"]


@dataclass(frozen=True)
class YoshidaUemori(Material):
    r"""The Yoshida-Uemori model of cyclic loading, with LS-DYNA's names.

    A yield surface of the constant size Y moves inside a bounding surface, which moves and grows;
    while its centre stays within the stagnation surface, it does not grow. Uniaxial, as `*MAT_125`
    of LS-DYNA writes it. In one direction of flow, with the stress :math:`Y + \theta + \beta`:

    .. math::

        d\theta = C \left(a - \operatorname{sgn}(\theta) \sqrt{a |\theta|}\right) dp, \quad
        a = CB + R - Y, \qquad d\beta = K (SB - \beta) \, dp

    Parameters
    ----------
    growth : {"saturating", "power"}, default "saturating"
        The growth law of the bounding surface: :math:`dR = K (RSAT - R) \, dp`, or :math:`R = RSAT
        \left((C_1 + p)^{C_2} - C_1^{C_2}\right)` with parameters C1 and C2, as in the paper's
        section 3.3.
    modulus : {"constant", "decaying"}, default "constant"
        "decaying": :math:`d\sigma = E(p) \, d\varepsilon_e` with
        :math:`E(p) = E - (E - E_a)(1 - e^{-\xi p})`, with parameters Ea and xi.
    rtol : float, default 1e-9
        The error that the integration may make, relative to CB; 1e-12 to 1e-3.

    References
    ----------
    F. Yoshida, T. Uemori, "A model of large-strain cyclic plasticity describing the Bauschinger
    effect and workhardening stagnation", International Journal of Plasticity 18 (2002) 661-686.

    Examples
    --------
    >>> from curvewise.materials import YoshidaUemori
    >>> steel = YoshidaUemori()
    >>> steel.names
    ('E', 'CB', 'Y', 'C', 'K', 'RSAT', 'SB', 'H')
    >>> constants = dict(zip(steel.names, (200e3, 420.0, 300.0, 300.0, 12.0, 150.0, 120.0, 0.4)))
    >>> steel.stress([0.001, 0.03, -0.03], constants).round(2)
    array([ 200.  ,  485.77, -536.89])
    """

    name = "yoshida-uemori"
    yield_stress = "Y"
    growth: Literal["saturating", "power"] = "saturating"
    modulus: Literal["constant", "decaying"] = "constant"
    rtol: float = 1e-9

    def _hardening_bounds(self, span: Span) -> Bounds:
        bounds: dict[str, Any] = {
            "CB": on_its_scale(0.3 * span.lowest_yield, 1.5 * span.stress),
            "Y": Below("CB", 0.01 * span.lowest_yield, 1.2 * span.highest_yield),
            "C": Log(1.0 / span.longest_branch, 1e4 / span.shortest_branch),
            "K": Log(0.005 / span.longest_branch, 500.0 / span.shortest_branch),
            "RSAT": (0.0, 5.0 * span.stress),
            "SB": (0.0, 5.0 * span.stress),
            "H": (0.0, 1.0),
        }
        if self.growth == "power":
            bounds["C1"] = Log(1e-3 * span.path, span.path)
            bounds["C2"] = (0.02, 1.0)
        return bounds
