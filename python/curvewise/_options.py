"""The choices and defaults of the measures' options.

The measures and the reference, which must not import each other, both take choices and defaults
from here. Choices are repeated here for type checkers, and a test compares them with
``_core.choices()``. Signatures of measures repeat the library's defaults for editors, and a test
compares them with ``_core.measures()``; other packages take `Default`.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, Final, Literal, SupportsFloat, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from ._core import earth_radius, measures
from ._names import did_you_mean

__all__ = [
    "EARTH_RADIUS",
    "BoundMetric",
    "CoordinateMetric",
    "Crossing",
    "Default",
    "Differentiable",
    "GroundDistance",
    "LengthScale",
    "Metric",
    "Missing",
    "Offsets",
    "Order",
    "Preset",
    "Radius",
    "Relax",
    "Spacing",
    "StepPatternName",
    "WarpingName",
    "Window",
    "check_choice",
    "check_closed",
    "check_independent",
    "check_window",
    "real_number",
    "whole_number",
    "window_radius",
]

Differentiable: TypeAlias = Literal[
    "area", "curve_length", "dtw", "frechet", "frechet_continuous", "soft_dtw", "sum_of_squares"
]
WarpingName: TypeAlias = Literal["dtw", "frechet"]
Preset: TypeAlias = Literal["scaled", "paper", "raw"]
Missing: TypeAlias = Literal["refuse", "skip"]  # points with nan

# Monotone in every difference of coordinates, also after rounding.
BoundMetric: TypeAlias = Literal["euclidean", "sqeuclidean", "cityblock", "chebyshev"]
CoordinateMetric: TypeAlias = Literal[BoundMetric, "minkowski"]  # of differences of coordinates
Metric: TypeAlias = Literal[CoordinateMetric, "haversine"]
_Points: TypeAlias = npt.NDArray[np.float64]
# A metric's name, or a user-defined matrix or function of two blocks of points.
GroundDistance: TypeAlias = (
    Metric | npt.NDArray[Any] | Sequence[Sequence[float]] | Callable[[_Points, _Points], Any]
)
Order: TypeAlias = SupportsFloat | None
Radius: TypeAlias = SupportsFloat | None
StepPatternName: TypeAlias = Literal[
    "symmetric1",
    "symmetric2",
    "asymmetric",
    "symmetricP0",
    "symmetricP05",
    "symmetricP1",
    "symmetricP2",
    "asymmetricP0",
    "asymmetricP05",
    "asymmetricP1",
    "asymmetricP2",
    "typeIa",
    "typeIb",
    "typeIc",
    "typeId",
    "typeIas",
    "typeIbs",
    "typeIcs",
    "typeIds",
    "typeIIa",
    "typeIIb",
    "typeIIc",
    "typeIId",
    "typeIIIc",
    "typeIVc",
    "rigid",
    "mori2006",
]
Window: TypeAlias = SupportsIndex | float | None
Relax: TypeAlias = Sequence[SupportsIndex] | None  # ends of P, then of Q
Spacing: TypeAlias = Literal["distance", "x", "arc_length", "matched", "function"]
Crossing: TypeAlias = Literal["rearrange", "split", "polygon"]
Offsets: TypeAlias = SupportsIndex | Literal["continuous"]
LengthScale: TypeAlias = Literal["mean", "mean_abs", "range"]


EARTH_RADIUS: Final[float] = earth_radius

_DEFAULTS: dict[str, Any] = {
    option: value
    for options in reversed(measures().values())  # of the same option, the first measure's
    for option, value in options.items()
}


class Default:
    """Defaults that functions of many packages share: the compiled library's, or Python's own."""

    metric: Final[Metric] = _DEFAULTS["metric"]
    p: Final[Order] = _DEFAULTS["p"]
    radius: Final[Radius] = _DEFAULTS["radius"]
    window: Final[Window] = _DEFAULTS["window"]
    spacing: Final[Spacing] = _DEFAULTS["spacing"]
    crossing: Final[Crossing] = _DEFAULTS["crossing"]
    offsets: Final[Offsets] = _DEFAULTS["offsets"]
    scale: Final[LengthScale] = _DEFAULTS["scale"]
    directed: Final[bool] = _DEFAULTS["directed"]
    workers: Final[SupportsIndex] = _DEFAULTS["workers"]
    cutoff: Final[SupportsFloat | None] = _DEFAULTS["cutoff"]
    missing: Final[Missing] = "refuse"


def check_choice(option: str, value: object, choices: Collection[str]) -> None:
    """Refuse a `value` that is not one of the strings in `choices`."""
    if not (isinstance(value, str) and value in choices):
        raise ValueError(
            f"unknown {option} {value!r}; choose from {', '.join(choices)}"
            f"{did_you_mean([value], choices)}"
        )


_OF_CLOSED = {
    "P",
    "Q",
    "metric",
    "p",
    "radius",
    "workers",
    "prune",
    "cutoff",
    "missing",
    "closed",
    "dependent",
}


def check_closed(given: Mapping[str, object]) -> None:
    """Refuse options that closed curves do not have, unless they are the defaults.

    Parameters
    ----------
    given : mapping of str to object
        All arguments of a measure's function by name.
    """
    for option in [name for name in given if name not in _OF_CLOSED]:
        value, default = given[option], _DEFAULTS[option]
        if value is not default and value != default:
            raise ValueError(f"closed=True has no {option}; leave out {option}={value!r}")


def check_independent(metric: object) -> None:
    """Refuse distances of whole points, which coordinates do not have alone."""
    if not isinstance(metric, str) or metric == "haversine":
        kind = f"metric={metric!r}" if isinstance(metric, str) else "a user-defined metric"
        raise ValueError(
            f"dependent=False compares each coordinate alone, unlike {kind}; give the name of "
            "another metric, such as 'euclidean'"
        )


def real_number(option: str, value: Any, least: float, advice: str) -> float:
    """Return `value` as a float; raise for text, nan, and values below `least`."""
    try:
        number = math.nan if isinstance(value, str | bytes) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not number >= least:
        raise ValueError(f"{option} is {value!r}; {advice}")
    return number


def whole_number(option: str, value: Any, least: int, advice: str, most: float = math.inf) -> int:
    """Return `value` as an int; raise for bools, floats and values out of range."""
    try:
        number = None if isinstance(value, bool) else operator.index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        raise ValueError(f"{option} is {(value if number is None else number)!r}; {advice}")
    return number


def check_window(window: Any) -> Any:
    """Check a window, and return it as a radius, a fraction, or None."""
    if window is None or (isinstance(window, float) and 0 < window < 1):
        return window
    advice = "give a whole number >= 0, a fraction between 0 and 1, or None"
    return whole_number("window", window, 0, advice)


def window_radius(window: Any, n: int, m: int) -> int | None:
    """Return the radius of a window for n and m points, or None."""
    radius = check_window(window)
    if isinstance(radius, float):
        radius = int(radius * max(n, m))
    if radius == 0 and n != m and min(n, m) > 1:
        raise ValueError(f"window=0 admits no path between {n} and {m} points; use at least 1")
    return None if radius is None else int(radius)
