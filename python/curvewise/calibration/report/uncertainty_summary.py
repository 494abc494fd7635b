"""The summary of an uncertainty in a report, as JSON numbers and texts.

It is recorded with the search once it has been computed. Otherwise it is computed from the record:
the objective, the space and the surfaces are rebuilt from it, with bitwise identical results. This
is not possible if the measure is a user-defined function.
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from ..._bounds import Below, Log
from ...curves.inputs import Array
from ...curves.named_curve import NamedCurve
from ..objective.cases import Case, Cases
from ..objective.criterion import Criterion
from ..objective.objective import Objective
from ..problem.problem import Problem
from ..problem.space import Space
from ..records.search_record import SearchRecord, text_of
from ..surfaces.surfaces import Responses, Surfaces
from ..uncertainty.sensitivity import Optimum
from ..uncertainty.uncertainty import Uncertainty, uncertainty_of

__all__ = ["space_of", "summary_of", "summary_of_record"]


# Attributes of an uncertainty that the page has from elsewhere, or does not have.
_NOT_WRITTEN = ("parameters", "bias", "measure", "optimum")


def summary_of(uncertainty: Uncertainty) -> dict[str, Any]:
    """Return what a page says of an uncertainty."""
    names = [one.name for one in fields(uncertainty) if one.name not in _NOT_WRITTEN]
    values = {name: getattr(uncertainty, name) for name in names}
    return {
        **{k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in values.items()},
        "in_words": uncertainty.in_words,
        "moved": [text_of(curves) for curves in uncertainty.moved],
    }


def summary_of_record(record: SearchRecord) -> tuple[dict[str, Any] | None, str]:
    """Return what a page says of the uncertainty of a search, or None and why it is not known."""
    ending = record.ending
    if ending is None:
        return None, "The search has not ended."
    if ending.uncertainty is not None:
        return ending.uncertainty, ""
    if ending.unit is None or ending.slopes is None:
        return None, (
            f"Intervals take {2 * len(record.names)} more runs of the model, since the search has "
            "left too few near the optimum: call found.uncertainty()."
        )
    if record.details["has_function"]:
        return None, (
            "The measure is a function, which is not written down: only found.report(...) itself "
            "computes the intervals, and writes them down."
        )
    optimum = _optimum(record, ending.simulations, ending.unit, ending.slopes)
    try:
        found = uncertainty_of(optimum, sigma=None, level=0.95, samples=0, seed=0, runs=0)
    except ValueError as error:  # fewer points than parameters
        return None, f"There are no intervals: {error}."
    return summary_of(found), ""


def _optimum(
    record: SearchRecord, simulations: tuple[Array, ...], unit: Array, slopes: Array
) -> Optimum:
    """Return the optimum of a search, rebuilt from its record."""
    problem = Problem(_objective(record), space_of(record))
    responses = Responses(simulations)
    base = responses.vector(simulations)
    return Optimum(problem, unit, responses, Surfaces(unit, base, slopes))


def _run_nothing(_: Any) -> Any:
    raise RuntimeError("a report runs no model")  # nothing asks it to: surfaces are there


def _objective(record: SearchRecord) -> Objective:
    settings, details = record.settings, record.details
    tests: list[Any] = [
        NamedCurve(curve, names) if names else curve
        for curve, names in zip(record.experiments, details["named"], strict=True)
    ]
    if settings["cases"] is None:
        return Objective(tests, Criterion(**settings["criterion"]))
    pairs = zip(settings["cases"], tests, strict=True)
    return Cases([_case(written, test) for written, test in pairs]).objective()


def _case(written: dict[str, Any], test: Any) -> Case:
    criterion = Criterion(**written["criterion"])
    weighed = {name: written[name] for name in ("weight", "sigma")}
    return Case(written["name"], _run_nothing, test, measure=criterion, **weighed)


def space_of(record: SearchRecord) -> Space:
    """Return the space; parameters that follow from others by a function are left out."""
    bounds: dict[str, Any] = {}
    kinds = {"log": Log, "below": Below}
    for name, given in record.settings["bounds"].items():
        if isinstance(given, list) and given[0] in kinds:
            bounds[name] = kinds[given[0]](*given[1:])
        elif not isinstance(given, list) or given[0] != "tied":
            bounds[name] = given
    return Space(bounds)
