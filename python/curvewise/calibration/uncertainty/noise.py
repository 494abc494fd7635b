"""The noise of a test: its residuals from the fitted curve, or a given deviation; draws of it.

Residuals that go on alike from point to point (a model that is wrong rather than noise) are drawn
so that they keep to that (`correlation`). Cost: that of a dynamic time warping path for every loop;
a draw is O(n).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from .correlation import Correlation
from .fitted_points import fitted_points
from .sensitivity import Optimum

__all__ = ["Noise", "draw_noise", "noise_of"]


class Noise(NamedTuple):
    """The fitted curves, and how the measured ones scatter about them.

    Attributes
    ----------
    fitted : list of ndarray
        For each test the simulated point that belongs to each measured one.
    residuals : list of ndarray or None
        Measured minus fitted y; None where sigma is given.
    sigma : ndarray, shape (tests,)
        The standard deviation of each test, enlarged for the parameters that were fitted.
    freedom : int
        Points of all tests minus parameters.
    """

    fitted: list[Array]
    residuals: list[Array] | None
    sigma: Array
    freedom: int


def noise_of(optimum: Optimum, sigma: float | Sequence[float] | None) -> Noise:
    """Return the fitted points, and the residuals or the deviation that is given."""
    objective = optimum.problem.objective
    experiments, ys = objective.experiments, objective.y_columns
    count = len(experiments)
    curves = optimum.curves(optimum.unit)
    fitted = objective.fitted(curves) or [
        fitted_points(P, Q) for P, Q in zip(experiments, curves, strict=True)
    ]
    total = sum(map(len, experiments))
    freedom = total - optimum.unit.size
    if freedom < 1:
        raise ValueError(f"the tests have {total} points for {optimum.unit.size} parameters")
    if sigma is not None:
        given = np.broadcast_to(np.asarray(sigma, dtype=np.float64), (count,)).copy()
        if not (np.isfinite(given).all() and (given >= 0).all()):
            raise ValueError(f"sigma is {sigma}; give a finite deviation, not negative")
        return Noise(fitted, None, given, freedom)
    inflation = math.sqrt(total / freedom)
    residuals = [P[:, y] - F[:, y] for P, F, y in zip(experiments, fitted, ys, strict=True)]
    # Of a single number there is no residual to speak of: a hundredth of it, if nothing is given.
    deviations = np.array(
        [
            given or (_deviation(r) * inflation if r.size > 1 else 0.01 * float(extent[-1]))
            for r, given, extent in zip(residuals, objective.sigmas, objective.extents, strict=True)
        ]
    )
    return Noise(fitted, residuals, deviations, freedom)


def _deviation(residuals: Array) -> float:
    return math.sqrt(float(np.mean(residuals**2)))


def draw_noise(noise: Noise, correlation: Correlation, random: np.random.Generator) -> list[Array]:
    """Return noise of every test, drawn anew."""
    counts = [len(fitted) for fitted in noise.fitted]
    parts = np.split(correlation.draw(random), np.cumsum(counts)[:-1])
    return [sigma * part for sigma, part in zip(noise.sigma, parts, strict=True)]
