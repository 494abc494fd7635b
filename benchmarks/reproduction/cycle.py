"""What the scripts of the load–unload cycle share: conditions, errors, and the fits' curves.

The sum of squares applies here, since every simulation has the data's x. Fréchet and DTW are
taken on the curves as they are, as in the author's scripts (normalisation is spoken of in section
3.3 only), and beside them on scaled curves, as in section 3.3. For the sum of squares and area
scaling changes the value by a factor alone, PCM and curve length scale in any case.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from problems import (
    COLOURS,
    LOAD_UNLOAD_TRUTH,
    TITLES,
    Array,
    load_unload,
    load_unload_bounds,
)
from studies import Effort, Task

import curvewise

HEIGHT = math.e - 1.0  # of the true cycle


@dataclass(frozen=True)
class Condition:
    """A measure, with which preset and options it is minimised, and how it is shown."""

    title: str
    measure: str | Callable[..., float]
    preset: str = "paper"
    options: Mapping[str, Any] = field(default_factory=dict)
    colour: str = "black"

    def task(
        self, name: str, test: Array, effort: Effort, seed: int = 0, *, traced: bool = False
    ) -> Task:
        """Return the identification of Table 1's parameters from a test."""
        return Task(
            name,
            load_unload,
            [test],
            load_unload_bounds(),
            self.measure,
            effort,
            seed,
            self.preset,
            self.options,
            traced,
        )


FIVE = {
    "area": Condition(TITLES["area"], "area", colour=COLOURS["area"]),
    "pcm": Condition(TITLES["pcm"], "pcm", colour=COLOURS["pcm"]),
    "frechet": Condition(TITLES["frechet"], "frechet", "raw", colour=COLOURS["frechet"]),
    "dtw": Condition(
        TITLES["dtw"], "dtw", "raw", {"step_pattern": "symmetric2"}, colour=COLOURS["dtw"]
    ),
    "curve_length": Condition(
        TITLES["curve_length"], "curve_length", colour=COLOURS["curve_length"]
    ),
}
SCALED = {
    "frechet_scaled": Condition("Fréchet, scaled", "frechet"),
    "dtw_scaled": Condition("DTW, scaled", "dtw"),
}
SQUARES = Condition(
    TITLES["sum_of_squares"],
    curvewise.sum_of_squares,
    preset="raw",
    colour=COLOURS["sum_of_squares"],
)
CONDITIONS = {
    "sum_of_squares": SQUARES,
    "sum_of_squares_scaled": Condition(
        "Sum of squares, scaled", curvewise.sum_of_squares, preset="scaled"
    ),
    **FIVE,
    **SCALED,
}


def parameter_error(parameters: Mapping[str, float]) -> float:
    """Return the largest difference from a true parameter."""
    return max(abs(parameters[name] - truth) for name, truth in LOAD_UNLOAD_TRUTH.items())


def curve_error(parameters: Mapping[str, float]) -> float:
    """Return the mean difference in f from the true cycle, as a share of its height."""
    difference = load_unload(parameters) - load_unload(LOAD_UNLOAD_TRUTH)
    return float(np.abs(difference[:, 1]).mean() / HEIGHT)
