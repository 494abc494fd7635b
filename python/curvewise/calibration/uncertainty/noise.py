"""The noise of a test: its residuals from the fitted curve, or a given deviation; draws of it.

Residuals that go on alike from point to point (a model that is wrong rather than noise) are drawn
in blocks, so that they keep to that. Cost: that of a dynamic time warping path for every loop; a
draw is O(n).

H. R. Künsch, "The jackknife and the bootstrap for general stationary observations", Ann. Stat. 17
(1989) 1217-1241; E. Carlstein, "The use of subseries values for estimating the variance of a
general statistic", Ann. Stat. 14 (1986) 1171-1179 (the length of blocks).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...curves.inputs import Array
from .fitted_points import fitted_points
from .sensitivity import Optimum

__all__ = ["Noise", "autocorrelation", "block_length", "draw_noise", "noise_of"]

# Residuals with a smaller autocorrelation from point to point are drawn one by one.
_INDEPENDENT = 0.2


class Noise(NamedTuple):
    """The fitted curves, and how the measured ones scatter about them.

    Attributes
    ----------
    fitted : list of ndarray
        For each test the simulated point that belongs to each measured one.
    residuals : list of ndarray or None
        Measured minus fitted y, enlarged for the parameters that were fitted; None where sigma is
        given.
    sigma : ndarray, shape (tests,)
        The standard deviation of each test.
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
    residuals = [
        inflation * (P[:, y] - F[:, y]) for P, F, y in zip(experiments, fitted, ys, strict=True)
    ]
    # Of a single number there is no residual to speak of: a hundredth of it, if nothing is given.
    deviations = np.array(
        [
            given or (math.sqrt(float(np.mean(r**2))) if r.size > 1 else 0.01 * float(extent[-1]))
            for r, given, extent in zip(residuals, objective.sigmas, objective.extents, strict=True)
        ]
    )
    return Noise(fitted, residuals, deviations, freedom)


def autocorrelation(residuals: Array) -> float:
    """Return the correlation of neighbours, at most 0.97; 0 if it is negligible."""
    if residuals.size < 4:
        return 0.0
    centred = residuals - residuals.mean()
    square = float(centred @ centred)
    rho = float(centred[1:] @ centred[:-1]) / square if square > 0 else 0.0
    return min(rho, 0.97) if rho >= _INDEPENDENT else 0.0


def block_length(residuals: Array) -> int:
    """Return Carlstein's length for the autocorrelation of neighbours; 1 if there is none."""
    rho = autocorrelation(residuals)
    if rho == 0.0:
        return 1
    length = float(((2.0 * rho / (1.0 - rho**2)) ** 2 * len(residuals)) ** (1.0 / 3.0))
    return max(1, min(round(length), len(residuals) // 4))


def draw_noise(noise: Noise, loop: int, lengths: list[int], random: np.random.Generator) -> Array:
    """Return noise of one loop, drawn anew."""
    count = len(noise.fitted[loop])
    if noise.residuals is None or lengths[loop] == 1:
        return random.normal(0.0, noise.sigma[loop], count)
    length = lengths[loop]
    starts = random.integers(0, count, -(-count // length))
    places = (starts[:, np.newaxis] + np.arange(length)).ravel()[:count] % count
    residuals: Array = noise.residuals[loop][places]
    return residuals
