"""Report on what the tests determine: errors, intervals, weak directions.

The noise is that of the residuals, normal to the curves (`directions`), or a given deviation
(`noise`), with the correlation of the residuals (`correlation`). The effect of noise on the
parameters follows from sensitivities, on the nonlinear model if that has a Jacobian (`followed`),
or from a bootstrap on response surfaces (`spread`). Insensitive directions do not depend on noise
(`sensitivity`). `determined` gives the verdict on both. Cost: no runs, or 2 k of them if the search
has left no surfaces, or about 10 k of a model with a Jacobian. In addition about 30 k evaluations
of the measure, with a bootstrap for each of its `samples`. Sources: see those modules.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from ...curves.inputs import Array
from ...drawing.intervals import Intervals, intervals_and_moves
from ...showing.result import Result, Table
from ..objective.noisy_tests import advice_against_noise
from ..problem.space import Space
from ..problem.tables import digits, parameter_table, per_cent
from .determined import determined
from .followed import followed_spread
from .noise import noise_of
from .sensitivity import Optimum, sensitivity_of
from .spread import ADDED_UP, bootstrapped_spread, linear_spread

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["Uncertainty", "uncertainty_of"]

_Value = TypeVar("_Value")

# A bias of less than this many standard errors does not matter (Efron & Tibshirani, section 10.3).
_HARMLESS_BIAS = 0.25
# A value below this part of the bounds' range is 0.
_ZERO = 1e-6
# Samples of a bootstrap.
_FEWEST = 20


@dataclass(frozen=True, eq=False)
class Uncertainty(Result):
    """How precisely the tests determine the parameters.

    Attributes
    ----------
    parameters : dict of str to float
        The identified parameters.
    standard_errors : dict of str to float
        The standard error of each parameter, in its unit.
    intervals : dict of str to (low, high)
        The interval that contains each parameter with the probability `level`.
    bias : dict of str to float
        The mean change of each parameter due to noise alone, from a bootstrap; 0 without one. The
        intervals allow for it as far as possible. `parameters` are not corrected for it.
    correlations : ndarray, shape (k, k)
        The correlations of the errors of the parameters.
    sensitivities : ndarray, shape (loops, k)
        The root mean square move of each loop as a parameter spans its bounds, in units of the
        loop's bounding box.
    singular_values : ndarray, shape (k,)
        The sensitivities of the principal combinations of parameters, in descending order.
    weakest_direction : dict of str to float
        The least sensitive combination of parameters, as a change of each in its own unit. It is
        scaled so that one of them changes by 10 % of its value, or of its bounds' range if its
        value is 0.
    determined : dict of str to bool
        Whether a parameter is known precisely enough and not at a bound. Half its interval must be
        within 25 % of the bounds' range, and within 25 % of the value or 2 % of the bounds' range,
        whichever is more. With `samples`, the interval by sensitivities must also satisfy this.
    open_ends : dict of str to (bool, bool)
        Whether each end of an interval is at a bound that is not a limit. The tests do not exclude
        values beyond such an end. Texts mark it by "<" or ">".
    at_bounds : dict of str to str
        "lower" or "upper", for the parameters that are at a bound.
    at_limits : tuple of str
        The parameters at a natural bound: 0, or the parameter that they must stay below.
    sigma : ndarray, shape (loops,)
        The standard deviation of the noise in units of y, as given or estimated from the residuals.
        The variances of x and y are added, with x scaled by the test's bounding box.
    level, samples, measure
        The arguments of the call.
    runs : int
        The number of runs of the model, including those read from a store.
    """

    parameters: dict[str, float]
    standard_errors: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    bias: dict[str, float]
    correlations: Array = field(repr=False)
    sensitivities: Array = field(repr=False)
    singular_values: Array = field(repr=False)
    weakest_direction: dict[str, float]
    determined: dict[str, bool]
    open_ends: dict[str, tuple[bool, bool]]
    at_bounds: dict[str, str]
    at_limits: tuple[str, ...]
    sigma: Array = field(repr=False)
    level: float
    samples: int
    measure: str
    runs: int
    optimum: Optimum = field(repr=False)

    @property
    def is_rough(self) -> bool:
        """Whether the theory of sums of distances is used for another measure."""
        measures = self.optimum.problem.objective.measures
        return not self.samples and any(measure not in ADDED_UP for measure in measures)

    @cached_property
    def moved(self) -> tuple[list[Array], list[Array]]:
        """The curves moved along the weakest direction, and the other way."""
        optimum = self.optimum
        differential = optimum.problem.space.differential(optimum.unit)
        step = np.linalg.solve(differential, np.array(list(self.weakest_direction.values())))
        return optimum.curves(optimum.unit + step), optimum.curves(optimum.unit - step)

    @property
    def in_words(self) -> str:
        """The weakest direction as a sentence."""
        space = self.optimum.problem.space
        sizes = {name: _size(space, name, self.parameters[name]) for name in self.weakest_direction}
        shares = {name: 100.0 * self.weakest_direction[name] / size for name, size in sizes.items()}
        moves = [
            f"{'raise' if share > 0 else 'lower'} {name} by {abs(share):.2g} %"
            f"{'' if sizes[name] == abs(self.parameters[name]) else ' of its range'}"
            for name, share in sorted(shares.items(), key=lambda item: -abs(item[1]))
            if abs(share) >= 1.0
        ]
        listed = " and ".join([", ".join(moves[:-1]), moves[-1]] if len(moves) > 1 else moves)
        if not listed:
            return "no parameter changes by 1 % of itself along the weakest direction"
        extents = self.optimum.problem.objective.extents
        pairs = zip(self.optimum.curves(self.optimum.unit), self.moved[0], extents, strict=True)
        move = max(float(np.sqrt((((new - old) / size) ** 2).mean())) for old, new, size in pairs)
        return f"{listed}: the loops change by {100.0 * move:.2g} % of their size"

    picture_shows = "Intervals, correlations, and the weakest direction"

    def parts(self) -> Sequence[Table | str]:
        """Return the parameters with their intervals, and the undetermined ones."""
        searched = {name: self.parameters[name] for name in self.standard_errors}
        space = self.optimum.problem.space
        table = parameter_table(space, searched, spread=vars(self), with_bounds=False)
        noise = ", ".join(f"{sigma:.3g}" for sigma in self.sigma)
        how = f"{self.samples} bootstrap replicates" if self.samples else "sensitivities"
        lines = [
            f"measure {self.measure}, standard deviation {noise} of the residuals, "
            f"intervals from {how}, {self.runs} runs of the model"
        ]
        if self.is_rough:
            lines.append(
                f"intervals of {self.measure} from sensitivities are rough: pass samples=1000 "
                "for a bootstrap"
            )
        undetermined = [name for name, good in self.determined.items() if not good]
        lines.append(
            f"not determined: {', '.join(undetermined)}"
            if undetermined
            else "all parameters are determined"
        )
        if self.at_limits:
            lines.append(
                f"not determined by these tests: {', '.join(self.at_limits)}, at a limit beyond "
                "which nothing lies"
            )
        if any(map(any, self.open_ends.values())):
            lines.append("< and >: the interval ends at a bound, and values beyond it are possible")
        lines.append(f"weakest direction: {self.in_words}")
        if moved := self._biased():
            lines.append(
                f"bias due to noise of this size: {moved}; the intervals include only a part of it"
            )
            if advice := advice_against_noise(self.optimum.problem.objective.measures):
                lines.append(advice)
        return [table, "\n".join(lines)]

    def _biased(self) -> str:
        """Return a description of the parameters with a considerable bias."""
        return ", ".join(
            f"{name} {self.bias[name]:+.2g}"
            for name, error in self.standard_errors.items()
            if abs(self.bias[name]) > _HARMLESS_BIAS * error
        )

    def plot(self, *, names: Sequence[str] | None = None) -> Picture:
        """Return a matplotlib Figure: intervals, correlations, and the weakest direction.

        Parameters
        ----------
        names : sequence of str, optional
            As for :meth:`Identification.plot`.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        optimum = self.optimum
        objective, space = optimum.problem.objective, optimum.problem.space
        places, texts = [], []
        for name, error in self.standard_errors.items():
            value = self.parameters[name]
            ends = (*self.intervals[name], value)
            places.append([space.place(name, end, self.parameters) for end in ends])
            share = per_cent(error, value)
            note = "" if self.determined[name] else ", not determined"
            part = f" ({share} %)" if share else ""
            texts.append(f"{digits(value, 4)} ± {digits(error, 2)}{part}{note}")
        return intervals_and_moves(
            Intervals(space.names, places, texts, list(self.determined.values()), self.level),
            self.correlations,
            zip(objective.experiments, optimum.curves(optimum.unit), *self.moved, strict=True),
            objective.axes(names),
            self.in_words,
        )


def _size(space: Space, name: str, value: float) -> float:
    """Return the scale of a parameter: its value, or its range if that is 0."""
    low, high = space.bounds[name]
    return abs(value) if abs(value) > _ZERO * (high - low) else high - low


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
    if samples != 0 and samples < _FEWEST:
        raise ValueError(f"samples is {samples}; give at least {_FEWEST}, or 0 for no bootstrap")
    space, objective = optimum.problem.space, optimum.problem.objective
    noise = noise_of(optimum, sigma)
    differential = space.differential(optimum.unit)
    if samples == 0 and optimum.has_slopes:
        spread, more = followed_spread(optimum, noise, level)
        runs += more
    elif samples == 0:
        spread = linear_spread(optimum, noise, level)
    else:
        spread = bootstrapped_spread(optimum, noise, level, samples, seed)
    halves = spread.halves
    if samples:  # draws that begin at the optimum stay there along a flat direction
        halves = list(map(max, halves, linear_spread(optimum, noise, level).halves))
    values, directions = sensitivity_of(optimum)
    point = space.point(optimum.unit)
    parameters = space.dictionary(point)
    weakest = differential @ directions[-1]
    sizes = [_size(space, name, value) for name, value in zip(space.names, point, strict=True)]
    shares = np.abs(weakest) / sizes
    weakest = weakest * (0.1 / shares.max()) * (np.sign(weakest[np.argmax(shares)]) or 1.0)

    def named(values: Iterable[_Value]) -> dict[str, _Value]:
        return dict(zip(space.names, values, strict=True))

    return Uncertainty(
        parameters=parameters,
        standard_errors=named(spread.errors.tolist()),
        intervals=named(spread.intervals),
        bias=named(spread.bias.tolist()),
        correlations=spread.correlations,
        sensitivities=optimum.loop_sensitivities(),
        singular_values=values,
        weakest_direction=named(weakest.tolist()),
        determined=determined(space, parameters, halves),
        open_ends={
            name: space.open_ends(name, interval, parameters)
            for name, interval in named(spread.intervals).items()
        },
        at_bounds=space.at_bounds(parameters),
        at_limits=space.at_limits(parameters),
        sigma=noise.sigma,
        level=level,
        samples=samples,
        measure=objective.measure,
        runs=runs,
        optimum=optimum,
    )
