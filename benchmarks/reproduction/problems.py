"""The paper's problems: their data, models and bounds, read from the golden data where it has them.

Straight lines fitted to ten points (section 3.1); a load–unload cycle with four parameters (3.2);
five tension–compression loops with nine (3.3), for which the uniaxial Yoshida–Uemori point of
`curvewise.materials` takes the place of LS-DYNA. Nothing here optimises. The golden data is not
part of the project: it is read from `../shared/data` beside it, or from the folder that
CURVEWISE_DATA names.
"""

from __future__ import annotations

import functools
import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from curvewise.materials import YoshidaUemori

Array: TypeAlias = npt.NDArray[np.float64]
Bounds: TypeAlias = dict[str, tuple[float, float]]

MEASURES = ("area", "pcm", "frechet", "dtw", "curve_length")
TITLES = {
    "sum_of_squares": "Sum of squares",
    "area": "Area",
    "pcm": "PCM",
    "frechet": "Fréchet",
    "dtw": "DTW",
    "curve_length": "Curve length",
}
COLOURS = {
    "sum_of_squares": "#666666",
    "area": "#0072B2",
    "pcm": "#E69F00",
    "frechet": "#D55E00",
    "dtw": "#009E73",
    "curve_length": "#CC79A7",
}

LOAD_UNLOAD_TRUTH = {"b0": 1.0, "b1": -1.0, "b2": 1.0, "b3": 1.0}
LOADING = np.linspace(0.0, 1.0, 100)
# The true unloading branch is 0 at its end; the text rounds this x to 0.62.
UNLOADING = np.linspace(1.0, math.log((1.0 + math.e) / 2.0), 50)
LOAD_UNLOAD_X = np.concatenate((LOADING, UNLOADING))
LOOPS = range(1, 6)

# The paper's bounding surface grows by a power law; SIGY is its name for the yield surface's size.
POINT = YoshidaUemori(growth="power")
YOUNGS_MODULUS = 198.8e3  # MPa; the slope with which the five test loops start


def data_dir() -> Path:
    """Return the folder with the paper's tables and curves."""
    root = Path(__file__).resolve().parents[2]
    folder = Path(os.environ.get("CURVEWISE_DATA", root.parent / "shared" / "data")) / "paper"
    if not folder.is_dir():
        raise FileNotFoundError(
            f"no golden data in {folder}: set CURVEWISE_DATA to the folder that holds paper/"
        )
    return folder


@functools.cache
def tables() -> dict[str, Any]:
    """Return tables 1 to 5 of the paper and the optima of its figures 7 and 8."""
    content: dict[str, Any] = json.loads((data_dir() / "tables.json").read_text())
    return content


def line_with_outlier() -> Array:
    """Return the data of figure 7: y = 2x + 1 with 15 added to one of ten points."""
    x = np.linspace(0, 10, 10)
    y = 2 * x + 1
    y[4] += 15
    return np.column_stack((x, y))


def quadratic(*, scaled: bool = False) -> Array:
    """Return the data of figure 8a, or of 8b: y = 2x² + x + 1, each variable over its largest.

    The paper's text says "normalized"; that its slope is 210/211 where it would be 1 on curves
    scaled to [0, 1] says that y was divided by its largest value, 211, without moving it.
    """
    x = np.linspace(0, 10, 10)
    points = np.column_stack((x, 2 * x**2 + x + 1))
    return points / points.max(axis=0) if scaled else points


def load_unload_bounds() -> Bounds:
    """Return the bounds of Table 1."""
    table = tables()["table_1_load_unload"]
    limits = zip(table["lower"], table["upper"], strict=True)
    return dict(zip(LOAD_UNLOAD_TRUTH, limits, strict=True))


def load_unload(parameters: Mapping[str, float]) -> Array:
    r"""Return the paper's Eq. 2: 100 points up to x = 1, and 50 back to x = ln((1 + e)/2).

    .. math::

        f = e^{b_0 x} + b_1 \text{ (loading)}, \qquad
        f = 2 e^{b_2 x} - 2 e^{b_3} + e - 1 \text{ (unloading)}

    The 2, e and 1 are constants. The branches share no parameter, and at x = 1, which occurs
    twice, they meet for some parameters only, the truth among them: elsewhere the curve jumps.
    Every simulation has the x of the data, so the sum of squares applies as it is.
    """
    b0, b1, b2, b3 = (parameters[name] for name in LOAD_UNLOAD_TRUTH)
    loading = np.exp(b0 * LOADING) + b1
    unloading = 2.0 * np.exp(b2 * UNLOADING) - 2.0 * math.exp(b3) + math.e - 1.0
    return np.column_stack((LOAD_UNLOAD_X, np.concatenate((loading, unloading))))


def load_unload_data(*, noise: bool) -> Array:
    """Return the paper's data of the load–unload problem."""
    points: Array = np.loadtxt(data_dir() / f"load_unload_{'noise' if noise else 'true'}.txt")
    return points


def load_unload_noisy(deviation: float, draw: int) -> Array:
    """Return the true cycle with normal noise of our own in f."""
    return with_noise([load_unload(LOAD_UNLOAD_TRUTH)], deviation, draw)[0]


def hardening_bounds() -> Bounds:
    """Return the bounds of Table 2."""
    return {name: (low, high) for name, (low, high) in tables()["table_2_bounds"].items()}


def test_loops() -> list[Array]:
    """Return the five test loops: strain and stress [MPa], 155 points each."""
    return [_loop(f"test/loop_{k}.csv") for k in LOOPS]


def paper_responses(measure: str) -> list[Array]:
    """Return the paper's five responses at the optimum of a measure, 102 points each."""
    return [_loop(f"model/{measure}_loop_{k}.csv") for k in LOOPS]


def paper_parameters(measure: str, *, noise: bool = False) -> dict[str, float]:
    """Return a row of Table 3."""
    table = tables()[f"table_3_with{'' if noise else 'out'}_noise"]
    return dict(zip(table["columns"], map(float, table[measure]), strict=True))


def with_noise(loops: Sequence[Array], deviation: float, seed: int) -> list[Array]:
    """Return curves with normal noise of a standard deviation added to their y alone."""
    random = np.random.Generator(np.random.PCG64(seed))
    return [
        np.column_stack((loop[:, 0], loop[:, 1] + random.normal(0.0, deviation, len(loop))))
        for loop in loops
    ]


@dataclass(frozen=True)
class HardeningModel:
    """The material point driven through the strains of each loop: a model for `identify`.

    Of the parameters of Table 2, stresses in MPa.
    """

    strains: tuple[Array, ...]

    @classmethod
    def of_the_paper(cls) -> HardeningModel:
        """Return the model at the strains of the paper's responses."""
        return cls(tuple(loop[:, 0] for loop in paper_responses("area")))

    def __call__(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return one loop for each strain path."""
        constants = {"E": YOUNGS_MODULUS, **parameters}
        constants["Y"] = constants.pop("SIGY")
        return [
            np.column_stack((strain, POINT.stress(strain, constants))) for strain in self.strains
        ]


def _loop(name: str) -> Array:
    points: Array = np.loadtxt(data_dir() / name, delimiter=",", skiprows=1)
    return points
