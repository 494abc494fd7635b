"""Points of material: the stress along a path of strain, compiled, with exact slopes.

Uniaxial, driven by strain, independent of rate: what a model must be to be fitted to loops of
tension and compression in seconds. ``material.driven_by(loops)`` is a model for
`curvewise.calibration.identify`.
"""

from __future__ import annotations

from .._names import names_alone
from .chaboche_voce import ChabocheVoce
from .driven_model import DrivenModel
from .johnson_cook import JohnsonCook
from .material import Material
from .ohno_wang import OhnoWang
from .point import Parameter
from .swift import Swift
from .updated_voce_chaboche import UpdatedVoceChaboche
from .yoshida_uemori import YoshidaUemori

__all__ = [
    "MATERIALS",
    "ChabocheVoce",
    "DrivenModel",
    "JohnsonCook",
    "Material",
    "OhnoWang",
    "Parameter",
    "Swift",
    "UpdatedVoceChaboche",
    "YoshidaUemori",
]
__dir__ = names_alone(__all__)

_KINDS = (ChabocheVoce, YoshidaUemori, Swift, JohnsonCook, UpdatedVoceChaboche, OhnoWang)
MATERIALS: dict[str, type[Material]] = {kind.name: kind for kind in _KINDS}
"""The materials by the names that commands and studies call them by."""
