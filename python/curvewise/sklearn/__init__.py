"""Estimators of scikit-learn for lists of curves: neighbours, clusters, and transformers.

The conventions are those of scikit-learn 1.6 and later (``pip install "curvewise[sklearn]"``), so
that pipelines, grid searches and cross-validation take them.
"""

from .._names import names_alone
from .k_means import CurveKMeans
from .k_medoids import CurveKMedoids
from .neighbors import CurveKNeighborsClassifier, CurveKNeighborsRegressor
from .transformers import CurveBoxScaler, CurveDerivative, CurveResampler, CurveZNormalizer

__all__ = [
    "CurveBoxScaler",
    "CurveDerivative",
    "CurveKMeans",
    "CurveKMedoids",
    "CurveKNeighborsClassifier",
    "CurveKNeighborsRegressor",
    "CurveResampler",
    "CurveZNormalizer",
]
__dir__ = names_alone(__all__)
