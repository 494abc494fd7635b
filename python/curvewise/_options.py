"""What the options of the measures can be, and what they are where they are not given.

The measures and the reference, which must not know of each other, both take choices and defaults
from here, and so do the docstrings that list them. The compiled library has its own, which
``_core.choices()``, ``_core.measures()`` and ``_core.presets()`` return; a test holds the two
together.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal, SupportsFloat, SupportsIndex, TypeAlias

__all__ = [
    "Crossing",
    "Default",
    "Differentiable",
    "LengthScale",
    "Metric",
    "Offsets",
    "Order",
    "Preset",
    "Spacing",
    "StepPattern",
    "WarpingName",
    "Window",
    "check_choice",
]

Differentiable: TypeAlias = Literal["area", "curve_length", "dtw", "frechet", "sum_of_squares"]
WarpingName: TypeAlias = Literal["dtw", "frechet"]
Preset: TypeAlias = Literal["scaled", "paper", "raw"]

Metric: TypeAlias = Literal["euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"]
Order: TypeAlias = SupportsFloat | None
StepPattern: TypeAlias = Literal["symmetric1", "symmetric2"]
Window: TypeAlias = SupportsIndex | float | None
Spacing: TypeAlias = Literal["distance", "x", "arc_length", "matched"]
Crossing: TypeAlias = Literal["rearrange", "split"]
Offsets: TypeAlias = SupportsIndex | Literal["continuous"]
LengthScale: TypeAlias = Literal["mean", "mean_abs", "range"]


class Default:
    """The value of each option that is not given."""

    metric: Final[Metric] = "euclidean"
    p: Final[Order] = None
    step_pattern: Final[StepPattern] = "symmetric1"
    window: Final[Window] = None
    open_begin: Final[bool] = False
    open_end: Final[bool] = False
    normalize: Final[bool] = False
    spacing: Final[Spacing] = "distance"
    crossing: Final[Crossing] = "rearrange"
    squared: Final[bool] = False
    offsets: Final[Offsets] = 200
    scale: Final[LengthScale] = "mean"
    workers: Final[SupportsIndex] = 1
    prune: Final[bool] = True
    cutoff: Final[SupportsFloat | None] = None


def check_choice(option: str, value: object, choices: Sequence[str]) -> None:
    """Refuse a `value` that is not one of the strings in `choices`."""
    if not (isinstance(value, str) and value in choices):
        raise ValueError(f"unknown {option} {value!r}; choose from {', '.join(choices)}")
