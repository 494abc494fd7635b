"""Identify the parameters of a model from measured curves: inverse analysis.

An :class:`Objective` turns simulations into one number, and :func:`identify` searches for the
parameters that minimise it. :func:`cross_validate` leaves out one loop after the other.
:func:`line_plot` shows the objectives between two sets of parameters. The method is that of Jekel,
Venter, Venter, Stander, Haftka, "Similarity measures for identifying material parameters from
hysteresis loops using inverse analysis", Int. J. Material Forming (2018). scipy and tqdm are
needed: ``pip install "curvewise[calibration]"``.
"""

from .._bounds import Below, Log, OutsideModelError, Tied
from .._names import names_alone
from . import methods
from .answers.identification import Identification
from .answers.several_measures import SeveralMeasures
from .cross_validation import CrossValidation, Fold, cross_validate
from .fronts import Front, front
from .identify import identify
from .identify_each import identify_each
from .line_plot import LinePlot, line_plot
from .methods import *  # noqa: F403  # the classes that methods/__init__ lists
from .models.command import CommandModel, SolverError
from .objective.cases import Case
from .objective.criterion import MEASURES, Criterion
from .objective.first_run import FirstRunWarning
from .objective.noisy_tests import NoisyTestWarning
from .objective.objective import Objective, Score
from .problem.ask_tell import Answer, OpenSearch
from .problem.evaluations import Progress
from .problem.problem import Problem
from .problem.space import WideBoundsWarning
from .profiles import Profile, profile
from .records.database import StoreError
from .records.store import SimulationStore
from .records.stored_run import StoredRun
from .rescoring import Rescored, rescore
from .screening import Screening, screening
from .uncertainty.uncertainty import Uncertainty

__all__ = [
    *methods.__all__,
    "MEASURES",
    "Answer",
    "Below",
    "Case",
    "CommandModel",
    "Criterion",
    "CrossValidation",
    "FirstRunWarning",
    "Fold",
    "Front",
    "Identification",
    "LinePlot",
    "Log",
    "OutsideModelError",
    "NoisyTestWarning",
    "Objective",
    "OpenSearch",
    "Problem",
    "Profile",
    "Progress",
    "Rescored",
    "Score",
    "Screening",
    "SeveralMeasures",
    "SimulationStore",
    "SolverError",
    "StoreError",
    "StoredRun",
    "Tied",
    "Uncertainty",
    "WideBoundsWarning",
    "cross_validate",
    "front",
    "identify",
    "identify_each",
    "line_plot",
    "profile",
    "rescore",
    "screening",
]
__dir__ = names_alone(__all__)
