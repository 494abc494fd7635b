"""What the tests determine, as one report: errors, intervals, the weakest direction, what is loose.

The noise is that of the residuals, or of a standard deviation that is given (`noise`); how far the
parameters would move with other noise is the linear theory of least squares, or a bootstrap on
response surfaces (`spread`); what the loops do not notice has nothing to do with noise
(`sensitivity`); `determined` is the verdict on both. Cost: no runs, or 2 k of them where the search
has left no surfaces; then `samples` minimisations of the measure, of some 30 k evaluations each.
Sources: see those modules.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...curves.inputs import Array
from ...showing.notebook import paragraph, picture, table
from .determined import determined_by, is_narrow
from .noise import noise_of
from .sensitivity import Optimum, indifferent
from .spread import bootstrapped_spread, linear_spread

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["Uncertainty", "uncertainty_of"]

# A bias of less than this many standard errors does not matter (Efron & Tibshirani, section 10.3).
_HARMLESS_BIAS = 0.25
# Measures that go by arc length, which noise adds to.
_OF_LENGTH = ("curve_length", "pcm")
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
    bias : dict of str to float
        By how much noise alone moves each parameter in the mean; 0 for "sum_of_squares". The
        intervals allow for it as far as that can be done, `parameters` are as identified.
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
        Whether half the interval, twice the error by linear theory and `unnoticed` are all within
        10 % of the bounds' range and 20 % of the value (or 2 % of the range), and the parameter is
        not at a bound.
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
    bias: dict[str, float]
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
        unit = self.optimum.problem.space.differential(self.optimum.unit)
        step = np.linalg.solve(unit, np.array(list(self.weakest_direction.values())))
        curves = self.optimum.curves(self.optimum.unit + step)
        moves = []
        for old, new, extent in zip(
            self.optimum.curves(self.optimum.unit),
            curves,
            self.optimum.problem.objective.extents,
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
        if moved := self._biased():
            lines.append(
                f"noise like this moves {moved} in the mean; intervals allow for it in part only"
            )
            if self.measure in _OF_LENGTH:
                lines.append(
                    f"{self.measure} takes noise for length: filter the test "
                    "(curvewise.curves.smooth), or take another measure"
                )
        return "\n".join(lines)

    def _biased(self) -> str:
        """Say which parameters are biased by more than is harmless, and by how much."""
        return ", ".join(
            f"{name} by {self.bias[name]:+.2g}"
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
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        from .picture import intervals_correlations_direction

        return intervals_correlations_direction(self, names)

    def _repr_html_(self) -> str:
        percent = f"{100 * self.level:g} %"
        rows = []
        for name, error in self.standard_errors.items():
            low, high = self.intervals[name]
            note = "determined" if self.determined[name] else "not determined"
            numbers = [f"{self.parameters[name]:.5g}", f"{error:.3g}", f"{low:.5g}", f"{high:.5g}"]
            rows.append([name, *numbers, note])
        header = ["parameter", "value", "std. error", f"{percent} from", "to", ""]
        about = "Intervals, correlations, and the weakest direction"
        return "\n".join(
            [
                table(rows, header),
                paragraph(f"weakest direction: {self.in_words}"),
                picture(self.plot, about),
            ]
        )


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
    space, objective = optimum.problem.space, optimum.problem.objective
    noise = noise_of(optimum, sigma)
    differential = space.differential(optimum.unit)
    if objective.is_least_squares:
        spread = linear_spread(optimum, noise, level, differential)
    else:
        spread = bootstrapped_spread(optimum, noise, level, samples, seed)
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
        bias=dict(zip(named, spread.bias.tolist(), strict=True)),
        correlations=spread.correlations,
        sensitivities=optimum.loop_sensitivities(),
        singular_values=values,
        weakest_direction=dict(zip(named, weakest.tolist(), strict=True)),
        unnoticed=dict(zip(named, (np.abs(differential) @ reach).tolist(), strict=True)),
        determined={
            name: good and name not in at_bounds and is_narrow(optimum, i, intervals[name])
            for i, (name, good) in enumerate(determined_by(optimum, reach).items())
        },
        at_bounds=at_bounds,
        sigma=noise.sigma,
        level=level,
        measure=objective.measure,
        runs=runs,
        optimum=optimum,
    )
