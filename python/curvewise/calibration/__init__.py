"""Identify the parameters of a model from measured curves: inverse analysis.

An :class:`Objective` turns simulations into one number, :func:`identify` searches for the
parameters that make it smallest, :func:`cross_validate` leaves out one loop after the other, and
:func:`line_plot` shows the objectives between two sets of parameters. The method is that of Jekel,
Venter, Venter, Stander, Haftka, "Similarity measures for identifying material parameters from
hysteresis loops using inverse analysis", Int. J. Material Forming (2018). scipy and tqdm are
needed: ``pip install "curvewise[calibration]"``.
"""

from .answers.identification import Identification
from .answers.several_measures import SeveralMeasures
from .cross_validation import CrossValidation, Fold, cross_validate
from .identify import identify
from .identify_each import identify_each
from .line_plot import LinePlot, line_plot
from .methods.differential_evolution import DifferentialEvolution
from .methods.domain_reduction import SDRM
from .methods.least_squares import LeastSquares
from .methods.simplex import NelderMead
from .methods.trust_region import TrustRegion
from .models.command import CommandModel, SolverError
from .objective.cases import Case
from .objective.objective import MEASURES, Objective, Score
from .problem.evaluations import Progress
from .problem.space import Below, Log, Tied
from .records.store import SimulationStore, StoredRun
from .rescoring import Rescored, rescore
from .uncertainty.uncertainty import Uncertainty

__all__ = [
    "MEASURES",
    "SDRM",
    "Below",
    "Case",
    "CommandModel",
    "CrossValidation",
    "DifferentialEvolution",
    "Fold",
    "Identification",
    "LeastSquares",
    "LinePlot",
    "Log",
    "NelderMead",
    "Objective",
    "Progress",
    "Rescored",
    "Score",
    "SeveralMeasures",
    "SimulationStore",
    "SolverError",
    "StoredRun",
    "Tied",
    "TrustRegion",
    "Uncertainty",
    "cross_validate",
    "identify",
    "identify_each",
    "line_plot",
    "rescore",
]
