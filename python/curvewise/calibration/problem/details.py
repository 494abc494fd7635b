"""The details of a problem that a search records for its report."""

from __future__ import annotations

import platform
from typing import Any

import numpy as np

from ..._extras import required
from ...installation import build_info
from ..models.identity import qualified_name
from ..records.search_record import text_of
from .execution import Execution
from .problem import Problem

__all__ = ["details_of"]


def details_of(problem: Problem, execution: Execution, max_runs: int | None) -> dict[str, Any]:
    """Return what a report needs in addition to the settings, as JSON data.

    These are the names of tests, columns, parameters and models, and the versions of the software.
    """
    objective, models = problem.objective, problem.callables
    return {
        "experiments": text_of(objective.experiments),
        "axes": [list(names) for names in objective.axes()],
        "named": [list(names) for names in objective.names],
        "titles": objective.titles,
        "parameters": list(problem.space.names),
        "y": list(objective.y_columns),
        "has_function": objective.has_function,
        "model": execution.identities(models) or [qualified_name(model) for model in models],
        "max_runs": max_runs,
        "versions": _versions(),
    }


def _versions() -> dict[str, str]:
    info = build_info()
    return {
        "curvewise": info["version"],
        "instruction set": info["active"],
        "numpy": np.__version__,
        "scipy": required("scipy").__version__,
        "Python": platform.python_version(),
        "platform": platform.platform(),
    }
