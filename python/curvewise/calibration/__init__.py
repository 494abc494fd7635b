"""Identify the parameters of a model from measured curves: inverse analysis.

An :class:`Objective` turns simulations into one number, :func:`identify` searches for the
parameters that make it smallest, :func:`cross_validate` leaves out one loop after the other, and
:func:`line_plot` shows the objectives between two sets of parameters. The method is that of Jekel,
Venter, Venter, Stander, Haftka, "Similarity measures for identifying material parameters from
hysteresis loops using inverse analysis", Int. J. Material Forming (2018). scipy and tqdm are
needed: ``pip install "curvewise[calibration]"``.
"""

from .cases import Case
from .command_model import CommandModel, SolverError
from .cross_validation import CrossValidation, Fold, cross_validate
from .evaluations import Progress
from .identification import Identification
from .line_plot import LinePlot, line_plot
from .objective import MEASURES, Objective, Score
from .parameters import Below, Log, Tied
from .rescoring import Rescored, rescore
from .search import identify
from .several_measures import SeveralMeasures, identify_each
from .store import SimulationStore, StoredRun
from .uncertainty import Uncertainty

__all__ = [
    "MEASURES",
    "Below",
    "Case",
    "CommandModel",
    "CrossValidation",
    "Fold",
    "Identification",
    "LinePlot",
    "Log",
    "Objective",
    "Progress",
    "Rescored",
    "Score",
    "SeveralMeasures",
    "SimulationStore",
    "SolverError",
    "StoredRun",
    "Tied",
    "Uncertainty",
    "cross_validate",
    "identify",
    "identify_each",
    "line_plot",
    "rescore",
]
