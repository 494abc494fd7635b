"""From measured loops to the parameters of a material: read, searched, and written down.

What ``curvewise fit`` does, as functions: :func:`prepare`, :func:`fit_material`.
"""

from __future__ import annotations

from .._names import names_alone
from .beginnings import BeginningWarning
from .doubtful import UndeterminedCardError
from .material_fit import MaterialFit, fit_material
from .preparation import PreparedTest, prepare
from .units_of_tests import UnitsWarning

__all__ = [
    "BeginningWarning",
    "MaterialFit",
    "PreparedTest",
    "UndeterminedCardError",
    "UnitsWarning",
    "fit_material",
    "prepare",
]
__dir__ = names_alone(__all__)
