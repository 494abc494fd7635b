"""What the tests determine: how far the parameters would move with other noise.

The noise is that of the residuals, or of a standard deviation that is given. For a sum of squares
its effect on the parameters follows from the slopes of the residuals (the linear theory of least
squares, with Student's t). For every other measure the tests are made anew many times, as the
fitted curves plus noise, and the parameters are identified from each on the response surfaces
around the optimum, which takes no run of the model: a bootstrap, with its basic interval.
Residuals that go on alike from point to point (a model that is wrong rather than noise) are drawn
in blocks, so that they keep to that.

Cost: no runs, or 2 k of them where the search has left no surfaces; then `samples` minimisations
of the measure, of some 30 k evaluations each.

B. Efron, R. J. Tibshirani, "An introduction to the bootstrap", Chapman & Hall (1993); H. R. Künsch,
"The jackknife and the bootstrap for general stationary observations", Ann. Stat. 17 (1989)
1217-1241; E. Carlstein, "The use of subseries values for estimating the variance of a general
statistic", Ann. Stat. 14 (1986) 1171-1179 (the length of blocks).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .._curves import Array
from ._extra import required
from .fitted_points import fitted_points
from .parameters import Space
from .quasi_newton import quasi_newton
from .sensitivity import Optimum, indifferent

if TYPE_CHECKING:
    from ..plotting.picture import Picture

__all__ = ["Uncertainty", "determined_by", "uncertainty_of"]

# Residuals with a smaller autocorrelation from point to point are drawn one by one.
_INDEPENDENT = 0.2
# A parameter is determined if it may be wrong by less than a tenth of its bounds' range and a
# fifth of itself (by less than 2 % of the range will do, for one that is nearly 0).
_OF_RANGE, _OF_VALUE, _SMALL = 0.1, 0.2, 0.02
# Of a minimisation on the surfaces: differences, in standard errors, and the gain that is not worth
# another step, in parts of what a standard error costs.
_DIFFERENCE, _ENOUGH = 0.05, 0.002
_FLATTEST = 1e-3  # directions that the loops notice less than this, relative to the best, are alike
# As in an identification's summary.
_AT_BOUND = 1e-3


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """How well the tests determine the parameters.

    Attributes
    ----------
    parameters : dict of str to float
        The optimum.
    standard_errors : dict of str to float
        Of each parameter, in its own unit.
    intervals : dict of str to (low, high)
        In which each parameter lies with the probability `level`.
    correlations : ndarray, shape (k, k)
        Of the errors of the parameters.
    sensitivities : ndarray, shape (loops, k)
        The root mean square move of each loop as a parameter goes through its bounds, in units of
        the loop's box.
    singular_values : ndarray, shape (k,)
        The same for the combinations of parameters that the loops notice most to least.
    weakest_direction : dict of str to float
        By how much each parameter changes, in its own unit, along the direction that the loops
        notice least: by so much that one of them changes by 10 % of its value.
    unnoticed : dict of str to float
        By how much each parameter may change, others with it, before the objective rises by 1 %.
    determined : dict of str to bool
        Whether interval and `unnoticed` are both within 10 % of the bounds' range and 20 % of the
        value (or 2 % of the range), and the parameter is not at a bound.
    at_bounds : dict of str to str
        "lower" or "upper", for the parameters that are at a bound.
    sigma : ndarray, shape (loops,)
        The standard deviation of the noise, as given or as the residuals have it.
    level, measure
        As asked for.
    runs : int
        How many runs of the model it took.
    """

    parameters: dict[str, float]
    standard_errors: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    correlations: Array = field(repr=False)
    sensitivities: Array = field(repr=False)
    singular_values: Array = field(repr=False)
    weakest_direction: dict[str, float]
    unnoticed: dict[str, float]
    determined: dict[str, bool]
    at_bounds: dict[str, str]
    sigma: Array = field(repr=False)
    level: float
    measure: str
    runs: int
    optimum: Optimum = field(repr=False)

    def __str__(self) -> str:
        return self.summary()

    @property
    def in_words(self) -> str:
        """The weakest direction as a sentence."""
        changes = sorted(self.weakest_direction.items(), key=lambda item: -abs(item[1]))
        parts = []
        for name, change in changes:
            share = 100.0 * change / abs(self.parameters[name]) if self.parameters[name] else 0.0
            if abs(share) >= 1.0:
                parts.append((abs(share), f"{'raise' if share > 0 else 'lower'} {name} by "))
        parts.sort(key=lambda part: -part[0])
        moves = [f"{text}{share:.2g} %" for share, text in parts]
        listed = " and ".join([", ".join(moves[:-1]), moves[-1]] if len(moves) > 1 else moves)
        if not listed:
            return "no parameter changes by 1 % of itself along the weakest direction"
        return f"{listed}: the loops move by {100.0 * self._weakest_move():.2g} % of their size"

    def _weakest_move(self) -> float:
        """Return the largest root mean square move of a loop along the weakest direction."""
        unit = self.optimum.study.space.differential(self.optimum.unit)
        step = np.linalg.solve(unit, np.array(list(self.weakest_direction.values())))
        curves = self.optimum.curves(self.optimum.unit + step)
        moves = []
        for old, new, extent in zip(
            self.optimum.curves(self.optimum.unit),
            curves,
            self.optimum.study.objective.extents,
            strict=True,
        ):
            moves.append(np.sqrt((((new - old) / extent) ** 2).mean()))
        return float(max(moves))

    def summary(self) -> str:
        """Return a table of the parameters with their intervals, and what is not determined."""
        width = max(9, *map(len, self.parameters))
        percent = f"{100 * self.level:g} %"
        lines = [
            f"{'parameter':<{width}}  {'value':>11}  {'std. error':>11}  "
            f"{percent + ' from':>11}  {'to':>11}"
        ]
        for name, error in self.standard_errors.items():
            low, high = self.intervals[name]
            note = f"  at its {self.at_bounds[name]} bound" if name in self.at_bounds else ""
            note = note or ("" if self.determined[name] else "  not determined")
            lines.append(
                f"{name:<{width}}  {self.parameters[name]:>11.5g}  {error:>11.3g}  "
                f"{low:>11.5g}  {high:>11.5g}{note}"
            )
        noise = ", ".join(f"{sigma:.3g}" for sigma in self.sigma)
        lines += ["", f"measure {self.measure}, noise {noise}, {self.runs} runs of the model"]
        undetermined = [name for name, good in self.determined.items() if not good]
        lines.append(
            f"not determined: {', '.join(undetermined)}" if undetermined else "all are determined"
        )
        lines.append(f"weakest direction: {self.in_words}")
        return "\n".join(lines)

    def plot(self, *, names: Sequence[str] | None = None) -> Picture:
        """Return a matplotlib Figure: intervals, correlations, and the weakest direction.

        Parameters
        ----------
        names : sequence of str, optional
            As for :meth:`Identification.plot`.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        from .uncertainty_picture import intervals_correlations_direction

        return intervals_correlations_direction(self, names)

    def _repr_html_(self) -> str:
        from .in_notebooks import uncertainty_html

        return uncertainty_html(self)


def uncertainty_of(
    optimum: Optimum,
    *,
    sigma: float | Sequence[float] | None,
    level: float,
    samples: int,
    seed: int,
    runs: int,
) -> Uncertainty:
    """Return the uncertainty of an optimum with its surfaces; see `Identification.uncertainty`."""
    if not 0.0 < level < 1.0:
        raise ValueError(f"level is {level}; it must be between 0 and 1")
    if samples < 20:
        raise ValueError(f"samples is {samples}; give at least 20")
    space, objective = optimum.study.space, optimum.study.objective
    noise = _noise(optimum, sigma)
    differential = space.differential(optimum.unit)
    if objective.is_least_squares:
        spread = _linear(optimum, noise, level, differential)
    else:
        spread = _bootstrapped(optimum, noise, level, samples, seed)
    values, directions, reach = indifferent(optimum)
    parameters = dict(zip(space.names, space.point(optimum.unit), strict=True))
    weakest = differential @ directions[-1]
    shares = np.abs(weakest) / np.maximum(np.abs(list(parameters.values())), 1e-300)
    weakest = weakest * (0.1 / shares.max()) * (np.sign(weakest[np.argmax(shares)]) or 1.0)
    at_bounds = {
        name: "lower" if place < 0.5 else "upper"
        for name, place in zip(space.names, optimum.unit, strict=True)
        if min(place, 1.0 - place) < _AT_BOUND
    }
    named = list(space.names)
    intervals = dict(zip(named, spread.intervals, strict=True))
    return Uncertainty(
        parameters=space.dictionary(space.point(optimum.unit)),
        standard_errors=dict(zip(named, spread.errors.tolist(), strict=True)),
        intervals=intervals,
        correlations=spread.correlations,
        sensitivities=optimum.loop_sensitivities(),
        singular_values=values,
        weakest_direction=dict(zip(named, weakest.tolist(), strict=True)),
        unnoticed=dict(zip(named, (np.abs(differential) @ reach).tolist(), strict=True)),
        determined={
            name: good and name not in at_bounds and _narrow(optimum, i, intervals[name])
            for i, (name, good) in enumerate(determined_by(optimum, reach).items())
        },
        at_bounds=at_bounds,
        sigma=noise.sigma,
        level=level,
        measure=objective.measure,
        runs=runs,
        optimum=optimum,
    )


def determined_by(optimum: Optimum, reach: Array) -> dict[str, bool]:
    """Return which parameters are determined as far as can be said without a bootstrap.

    By how far they go unnoticed, and by twice the standard errors of the linear theory.
    """
    space = optimum.study.space
    differential = space.differential(optimum.unit)
    noise = _noise(optimum, None)
    covariance = differential @ _linear_covariance(optimum, noise) @ differential.T
    changes = np.maximum(np.abs(differential) @ reach, 2.0 * np.sqrt(np.diag(covariance)))
    point = space.point(optimum.unit)
    return {name: _small(space, i, changes[i], point[i]) for i, name in enumerate(space.names)}


def _linear_covariance(optimum: Optimum, noise: _Noise) -> Array:
    """Return what the best use of the noisy points could do, in the unit cube.

    The inverse of the information of all points; n points whose noise is alike in blocks count as
    n / (length of a block).
    """
    k = optimum.unit.size
    information = np.zeros((k, k))
    columns = [optimum.responses.curves(column) for column in optimum.surfaces.slopes.T]
    for i, sigma in enumerate(noise.sigma):
        y = optimum.study.objective.y_columns[i]
        slopes = np.column_stack([column[i][:, y] for column in columns])
        length = 1 if noise.residuals is None else _block_length(noise.residuals[i])
        count = len(noise.fitted[i]) / length
        information += count / max(sigma, 1e-300) ** 2 * (slopes.T @ slopes) / len(slopes)
    values, directions = np.linalg.eigh(information)
    # What no point notices is as uncertain as the bounds are wide, and no more.
    variances = 1.0 / np.maximum(values, 1.0)
    covariance: Array = (directions * variances) @ directions.T
    return covariance


def _narrow(optimum: Optimum, i: int, interval: tuple[float, float]) -> bool:
    space = optimum.study.space
    low, high = interval
    return _small(space, i, (high - low) / 2.0, space.point(optimum.unit)[i])


def _small(space: Space, i: int, change: float, value: float) -> bool:
    """Return whether a parameter that may be off by a change is still determined."""
    low, high = space.bounds[space.names[i]]
    if space.is_log[i]:
        return change <= _OF_VALUE * abs(value)
    return change <= min(
        _OF_RANGE * (high - low), max(_OF_VALUE * abs(value), _SMALL * (high - low))
    )


class _Noise(NamedTuple):
    """What a test is beside its fitted curve."""

    fitted: list[Array]
    residuals: list[Array] | None  # None where sigma is given
    sigma: Array
    freedom: int


class _Spread(NamedTuple):
    """Of the parameters, in their own units."""

    errors: Array
    intervals: list[tuple[float, float]]
    correlations: Array


def _noise(optimum: Optimum, sigma: float | Sequence[float] | None) -> _Noise:
    """Return the fitted points, and the residuals or the deviation that is given."""
    objective = optimum.study.objective
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
        return _Noise(fitted, None, given, freedom)
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
    return _Noise(fitted, residuals, deviations, freedom)


def _linear(optimum: Optimum, noise: _Noise, level: float, differential: Array) -> _Spread:
    """Return what the linear theory of least squares gives."""
    objective = optimum.study.objective
    residuals = objective.residuals(optimum.curves(optimum.unit))
    step = 1e-4
    jacobian = np.column_stack(
        [
            objective.residuals(optimum.curves(optimum.unit + step * axis))
            - objective.residuals(optimum.curves(optimum.unit - step * axis))
            for axis in np.eye(optimum.unit.size)
        ]
    ) / (2.0 * step)
    # With a given sigma in units of y; else of the residuals themselves, one deviation a loop.
    ends = np.cumsum(objective.residual_counts)
    parts = np.split(residuals, ends[:-1])
    inflation = residuals.size / max(1, residuals.size - optimum.unit.size)
    if noise.residuals is None:
        scale = objective.residual_factors * noise.sigma
    else:
        scale = np.sqrt([inflation * float(np.mean(part**2)) for part in parts])
    spread = np.concatenate([np.full(p.size, s) for p, s in zip(parts, scale, strict=True)])
    inverse = np.linalg.pinv(jacobian)
    covariance = (inverse * spread**2) @ inverse.T
    covariance = differential @ covariance @ differential.T
    errors = np.sqrt(np.diag(covariance))
    stats = required("scipy.stats")
    quantile = stats.norm if noise.residuals is None else stats.t(noise.freedom)
    width = float(quantile.ppf((1.0 + level) / 2.0)) * errors
    point = optimum.study.space.point(optimum.unit)
    intervals = [(p - w, p + w) for p, w in zip(point, width.tolist(), strict=True)]
    return _Spread(errors, intervals, _correlation(covariance))


def _bootstrapped(
    optimum: Optimum, noise: _Noise, level: float, samples: int, seed: int
) -> _Spread:
    """Return the spread of the parameters that other noise would have given."""
    random = np.random.default_rng(seed)
    space = optimum.study.space
    ys = optimum.study.objective.y_columns
    lengths = [_block_length(residuals) for residuals in noise.residuals or ()]
    steps = _natural_steps(optimum, noise.sigma)
    points = np.empty((samples, optimum.unit.size))
    for i in range(samples):
        tests = []
        for loop, fitted in enumerate(noise.fitted):
            test = fitted.copy()
            test[:, ys[loop]] += _drawn(noise, loop, lengths, random)
            tests.append(test)
        points[i] = space.point(_reminimised(optimum, tests, steps))
    covariance = np.atleast_2d(np.cov(points.T))
    tail = 100.0 * (1.0 - level) / 2.0
    low, high = np.percentile(points, [tail, 100.0 - tail], axis=0)
    # The mirror image of the percentiles about the optimum, which undoes a bias of the measure.
    # Samples that end at a bound may all be on one side of the optimum: it is inside all the same.
    point = np.array(space.point(optimum.unit))
    low, high = np.minimum(2.0 * point - high, point), np.maximum(2.0 * point - low, point)
    limits = zip(low.tolist(), high.tolist(), space.bounds.values(), strict=True)
    intervals = [(max(a, first), min(b, last)) for a, b, (first, last) in limits]
    return _Spread(np.sqrt(np.diag(covariance)), intervals, _correlation(covariance))


def _correlation(covariance: Array) -> Array:
    errors = np.sqrt(np.diag(covariance))
    errors = np.where(errors > 0, errors, 1.0)
    correlation: Array = covariance / np.outer(errors, errors)
    return correlation


def _block_length(residuals: Array) -> int:
    """Return Carlstein's length for the autocorrelation of neighbours; 1 if there is none."""
    if residuals.size < 4:
        return 1
    centred = residuals - residuals.mean()
    square = float(centred @ centred)
    rho = float(centred[1:] @ centred[:-1]) / square if square > 0 else 0.0
    if rho < _INDEPENDENT:
        return 1
    rho = min(rho, 0.97)
    length = float(((2.0 * rho / (1.0 - rho**2)) ** 2 * len(residuals)) ** (1.0 / 3.0))
    return max(1, min(round(length), len(residuals) // 4))


def _drawn(noise: _Noise, loop: int, lengths: list[int], random: np.random.Generator) -> Array:
    """Draw the noise of one loop."""
    count = len(noise.fitted[loop])
    if noise.residuals is None:
        return random.normal(0.0, noise.sigma[loop], count)
    length = lengths[loop]
    if length == 1:
        return random.normal(0.0, noise.sigma[loop], count)
    starts = random.integers(0, count, -(-count // length))
    places = (starts[:, np.newaxis] + np.arange(length)).ravel()[:count] % count
    drawn: Array = noise.residuals[loop][places]
    return drawn


def _reminimised(optimum: Optimum, tests: list[Array], steps: Array) -> Array:
    """Return where on the surfaces the objective of other tests is lowest.

    The search is in coordinates in which all directions count alike: of `steps`.
    """
    objective = optimum.study.objective.of_other_tests(tests)

    def place(z: Array) -> Array:
        moved: Array = np.clip(optimum.unit + steps @ z, 0.0, 1.0)
        return moved

    start = np.zeros(optimum.unit.size)
    lowest = objective.predicted(optimum.curves(optimum.unit)).value or 1.0
    count = sum(map(len, tests))
    best = quasi_newton(
        lambda z: objective.predicted(optimum.curves(place(z))).value / lowest,
        start,
        count * np.eye(start.size),  # a standard error raises the value by 1 / (2 n) of itself
        difference=_DIFFERENCE,
        enough=_ENOUGH / count,
        maxiter=10 + 5 * start.size,
    )
    return place(best)


def _natural_steps(optimum: Optimum, sigma: Array) -> Array:
    """Return steps, as columns, that the loops notice alike: about one standard error each."""
    slopes = optimum.scaled_slopes()
    _, values, directions = np.linalg.svd(slopes, full_matrices=False)
    experiments = optimum.study.objective.experiments
    objective = optimum.study.objective
    heights = np.array(
        [extent[y] for extent, y in zip(objective.extents, objective.y_columns, strict=True)]
    )
    count = sum(map(len, experiments))
    noise = max(float(np.mean(sigma / heights)), 1e-9) / math.sqrt(count)
    sizes = noise / np.maximum(values, _FLATTEST * values[0])
    steps: Array = directions.T * np.minimum(sizes, 0.25)
    return steps
