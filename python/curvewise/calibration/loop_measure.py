"""A measure as a function of the simulation alone, for one loop of an objective.

By its name, or a function of the user's own; with the options and the scaling of a preset; and
which curve is matched to a part of the other. Cost: that of the measure.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Literal, TypeAlias

from .._curves import Array
from .._options import Preset
from ..measures import dtw, pcm_match, value_and_gradient
from ..measures.registry import MEASURES, PRESETS, Condition
from ..pairwise import Prepared
from ..results import PcmMatch
from .common_x import differences, squared_differences, squared_differences_and_gradient

__all__ = ["Measure", "Part", "check_part", "condition_of", "functions", "gradient_of", "measure_name"]

Measure: TypeAlias = str | Callable[..., float]
Part: TypeAlias = Literal["experiment", "simulation"]


def functions(
    measure: Measure, P: Array, options: dict[str, Any], part: Part
) -> tuple[Callable[[Array], float | PcmMatch], Callable[[Array], Array] | None]:
    """Return the measure, and the residuals where it has them, as functions of Q alone."""
    if callable(measure):
        return partial(_called, measure, P, options), None
    if measure == "sum_of_squares":
        if unknown := set(options) - {"over"}:
            raise TypeError(f"sum_of_squares has the option over alone, not {', '.join(unknown)}")
        return partial(squared_differences, P, **options), partial(differences, P, **options)
    info = MEASURES[measure]
    residuals = None if info.residuals is None else partial(info.residuals, P, **options)
    if measure == "pcm":  # for its coverage
        return partial(pcm_match, P, **options), residuals
    if part == "simulation":  # the curve that is matched to a part of the other comes first
        return partial(_dtw_of_simulation, P, options), residuals
    return Prepared(P, info.name, **options), residuals


def gradient_of(
    measure: Measure, P: Array, options: dict[str, Any], part: Part
) -> Callable[[Array], tuple[float, Array]] | None:
    """Return the measure with its derivative by Q, as a function of Q; None where there is none.

    That of frechet is 0 except at one point, and of no use to whoever wants to go down.
    """
    if measure == "sum_of_squares":
        return partial(squared_differences_and_gradient, P, **options)
    differentiable = measure in ("curve_length", "dtw") or (
        measure == "area" and options.get("spacing") != "arc_length"
    )
    if not differentiable or part == "simulation":
        return None
    return partial(_value_and_gradient, P, measure, options)


def _value_and_gradient(
    P: Array, measure: Any, options: dict[str, Any], Q: Array
) -> tuple[float, Array]:
    return value_and_gradient(P, Q, measure, **options)


def _called(function: Callable[..., float], P: Array, options: dict[str, Any], Q: Array) -> float:
    return float(function(P, Q, **options))


def _dtw_of_simulation(P: Array, options: dict[str, Any], Q: Array) -> float:
    return dtw(Q, P, **options)


def check_part(part: str, measure: Measure, options: dict[str, Any]) -> None:
    """Refuse a part that is unknown, or of a measure that compares whole curves."""
    if part not in ("experiment", "simulation"):
        raise ValueError(f"unknown part {part!r}; choose from experiment, simulation")
    open_ends = options.get("open_begin", False) or options.get("open_end", False)
    if part == "simulation" and measure != "pcm" and not (measure == "dtw" and open_ends):
        raise ValueError(
            f"measure {measure_name(measure)!r} compares whole curves; part='simulation' needs "
            "measure='pcm', or measure='dtw' with open_begin=True or open_end=True"
        )


def measure_name(measure: Measure) -> str:
    """Return a measure's name; of a callable its `__name__`, or its type's."""
    if isinstance(measure, str):
        return measure
    return str(getattr(measure, "__name__", type(measure).__name__))


def condition_of(preset: Preset, measure: Measure) -> Condition:
    """Return whether a preset scales the curves for a measure, and its options."""
    if callable(measure) or measure == "sum_of_squares":
        return Condition(preset == "scaled", {})
    return PRESETS[preset][measure]
