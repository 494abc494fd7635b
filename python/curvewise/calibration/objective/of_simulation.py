"""A criterion as functions of the simulation alone, for one experiment.

The measure itself, the differences that it squares, and the derivatives of both: those of the
package's measures where they exist, of sum_of_squares, and of a user's function the value. Cost:
that of the measure.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from ...curves.inputs import Array
from ...many.prepared import Prepared
from ...measures import dtw, pcm_match, value_and_gradient
from ...measures.registry import MEASURES
from ...measures.results import PcmMatch
from .common_x import (
    difference_slopes,
    differences,
    squared_differences,
    squared_differences_and_gradient,
)
from .criterion import Criterion

__all__ = ["OfSimulation", "of_simulation"]


class OfSimulation(NamedTuple):
    """The functions of a measure, each as a function of Q.

    Attributes
    ----------
    value
        The measure; for pcm the match, which has its coverage.
    residuals
        The differences whose squares the measure sums, if it does.
    residual_slopes
        Their derivatives, shape (m, k), as Q moves along directions of shape (n, d, k). None if
        they must be computed by finite differences.
    gradient
        The measure with its derivative by Q, or None. The gradient of frechet is 0 except at one
        point, so it does not help a minimisation.
    """

    value: Callable[[Array], float | PcmMatch]
    residuals: Callable[[Array], Array] | None = None
    residual_slopes: Callable[[Array, Array], Array] | None = None
    gradient: Callable[[Array], tuple[float, Array]] | None = None


def of_simulation(criterion: Criterion, P: Array) -> OfSimulation:
    """Return a criterion's functions for an experiment, scaled if required."""
    measure, options = criterion.measure, criterion.condition.options
    if callable(measure):
        return OfSimulation(partial(_called, measure, P, options))
    if measure == "sum_of_squares":
        return OfSimulation(
            partial(squared_differences, P, **options),
            partial(differences, P, **options),
            partial(difference_slopes, P, **options),
            partial(squared_differences_and_gradient, P, **options),
        )
    info = MEASURES[measure]
    residuals = None if info.residuals is None else partial(info.residuals, P, **options)
    if measure == "pcm":
        return OfSimulation(partial(pcm_match, P, **options), residuals)
    if criterion.part == "simulation":  # the curve that is matched to a part comes first
        return OfSimulation(partial(_dtw_of_simulation, P, options), residuals)
    differentiable = measure in ("curve_length", "dtw") or (
        measure == "area"
        and options.get("spacing") not in ("arc_length", "function")
        and not options.get("closed")
    )
    named: dict[str, Any] = {"measure": measure, **options}
    gradient = partial(value_and_gradient, P, **named) if differentiable else None
    return OfSimulation(Prepared(P, info.name, **options), residuals, gradient=gradient)


def _called(function: Callable[..., float], P: Array, options: dict[str, Any], Q: Array) -> float:
    return float(function(P, Q, **options))


def _dtw_of_simulation(P: Array, options: dict[str, Any], Q: Array) -> float:
    return dtw(Q, P, **options)
