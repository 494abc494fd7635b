"""A measure as a function of the simulation alone, for one loop of an objective.

By its name, or a function of the user's own; with the options and the scaling of a preset; and
which curve is matched to a part of the other. Cost: that of the measure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from inspect import signature
from typing import Any, Literal, TypeAlias

from ..._names import meant
from ..._options import Preset
from ...curves.inputs import Array
from ...many.pairwise import Prepared
from ...measures import dtw, pcm_match, value_and_gradient
from ...measures.registry import MEASURES, PRESETS, Condition
from ...measures.results import PcmMatch
from .common_x import differences, squared_differences, squared_differences_and_gradient

__all__ = [
    "Measure",
    "Part",
    "check_part",
    "condition_of",
    "functions",
    "gradient_of",
    "measure_name",
    "unknown_options_explained",
]

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


def _option_names(measure: Measure) -> list[str]:
    """Return the names of a measure's options; of a function those of its keywords."""
    if measure == "sum_of_squares":
        return ["over"]
    function = measure if callable(measure) else MEASURES[measure].function
    try:
        parameters = signature(function).parameters.values()
    except ValueError:  # of a builtin
        return []
    return [p.name for p in parameters if p.kind in (p.KEYWORD_ONLY, p.POSITIONAL_OR_KEYWORD)]


@contextmanager
def unknown_options_explained(
    measure: Measure, given: Iterable[str], others: Iterable[str] = ()
) -> Iterator[None]:
    """Add to the error of an option that a measure does not have what it was meant to be.

    Parameters
    ----------
    measure
        The measure.
    given
        The names of the options that a user gave.
    others
        What else could have been meant: arguments of the function that was called.
    """
    try:
        yield
    except TypeError as error:
        hint = meant(given, [*_option_names(measure), *others])
        if not hint or "did you mean" in str(error):
            raise
        raise TypeError(f"{error}{hint}") from error


def check_part(part: str, measure: Measure, options: dict[str, Any]) -> None:
    """Refuse a part that is unknown, or of a measure that compares whole curves."""
    if part not in ("experiment", "simulation"):
        known = ("experiment", "simulation")
        raise ValueError(
            f"unknown part {part!r}; choose from {', '.join(known)}{meant([part], known)}"
        )
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
