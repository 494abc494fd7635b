"""From measured loops to the parameters of a material: read, searched, and written down.

What ``curvewise fit`` and ``curvewise flow`` do, as functions: :func:`prepare`,
:func:`fit_material`, :func:`flow_curve`.
"""

from __future__ import annotations

from .._names import names_alone
from .beginnings import BeginningWarning
from .card_refusals import UndeterminedCardError
from .flow_curve import FlowCurve, FlowLaw, flow_curve
from .material_fit import MaterialFit, fit_material
from .preparation import PreparedTest, prepare
from .units_of_tests import UnitsWarning

__all__ = [
    "BeginningWarning",
    "FlowCurve",
    "FlowLaw",
    "MaterialFit",
    "PreparedTest",
    "UndeterminedCardError",
    "UnitsWarning",
    "fit_material",
    "flow_curve",
    "prepare",
]
__dir__ = names_alone(__all__)
