"""The profile of one parameter: the best fit at fixed values of it.

Intervals by sensitivities assume that the curves are linear in the parameters; a profile does not.
The parameter is fixed at several values in turn, and all others are identified again. The interval
ends where the objective has risen as much as on the linear surfaces at the ends of the interval by
sensitivities. Correlated residuals therefore widen both intervals equally. Cost: a search from a
nearby start for each of `points` values, with about 5 to 30 runs each.

D. J. Venzon, S. H. Moolgavkar, "A method for computing profile-likelihood-based confidence
intervals", Applied Statistics 37 (1988) 87-94.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..curves.inputs import Array
from ..drawing.profiles import profile_of_a_parameter
from ..showing.result import Result, Table
from .answers.identification import Identification
from .answers.search import Plan, identification_of
from .methods.method import Method
from .methods.trust_region import TrustRegion
from .problem.tables import digits
from .uncertainty.noise import Noise, noise_of
from .uncertainty.sensitivity import Optimum
from .uncertainty.spread import linear_spread, rise_at

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["Profile", "profile"]

_BEYOND = 1.5  # how far the values go, in half intervals by sensitivities


@dataclass(frozen=True, eq=False)
class Profile(Result):
    """Result of `profile`.

    Attributes
    ----------
    name : str
        The parameter.
    values : ndarray, shape (points,)
        The fixed values, ascending; the optimum is one of them.
    objective : ndarray, shape (points,)
        The smallest value of the objective at each of them.
    parameters : tuple of dict of str to float
        All parameters at each of them.
    interval : (float, float)
        The interval in which the objective rises by less than `rise`; the first or last of `values`
        if it stays below.
    is_open : (bool, bool)
        Whether the interval extends beyond `values` on either side.
    by_sensitivities : (float, float)
        The interval by sensitivities alone, as :meth:`Identification.uncertainty` gives it for a
        model without a Jacobian.
    rise : float
        The rise of the objective at the ends of the interval.
    level : float
        The probability level of the call.
    runs : int
        The number of runs of the model.
    """

    name: str
    values: Array = field(repr=False)
    objective: Array = field(repr=False)
    parameters: tuple[dict[str, float], ...] = field(repr=False)
    interval: tuple[float, float]
    is_open: tuple[bool, bool]
    by_sensitivities: tuple[float, float]
    rise: float
    level: float
    runs: int

    picture_shows = "The smallest objective against the parameter, with both intervals"

    def parts(self) -> Sequence[Table | str]:
        """Return the profile as a table, and both intervals."""
        others = [name for name in self.parameters[0] if name != self.name]
        rows = [
            [digits(value, 4), f"{lowest:.6g}", *(digits(one[name], 4) for name in others)]
            for value, lowest, one in zip(self.values, self.objective, self.parameters, strict=True)
        ]
        first, last = (digits(end, 4) for end in self.interval)
        ends = f"{'<' * self.is_open[0]}{first} to {'>' * self.is_open[1]}{last}"
        linear = " to ".join(digits(end, 4) for end in self.by_sensitivities)
        said = f"{100.0 * self.level:g} % interval of {self.name}: {ends}"
        return [
            Table(rows, [self.name, "objective", *others]),
            f"{said} (by sensitivities {linear}), {self.runs} runs of the model",
        ]

    def plot(self) -> Picture:
        """Return a matplotlib Figure: the objective against the parameter, with both intervals.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return profile_of_a_parameter(
            self.name, self.values, self.objective, self.rise, self.interval, self.by_sensitivities
        )


def profile(
    found: Identification,
    name: str,
    *,
    points: int = 7,
    level: float = 0.95,
    method: Method | None = None,
) -> Profile:
    """Compute the profile of a parameter: the best fits at fixed values of it.

    Parameters
    ----------
    found : Identification
        The result of a search.
    name : str
        A parameter that was searched for.
    points : int, default 7
        Number of values, including the optimum; odd, at least 5.
    level : float, default 0.95
        The probability of the interval.
    method : method, optional
        The method for the other parameters: by default :class:`TrustRegion`, starting at the values
        next to them.

    Returns
    -------
    Profile
        Prints as a table, plots itself.

    Raises
    ------
    ValueError
        If the parameter does not exist, is the only one, or another one must stay below it. If
        `points` is even.

    Notes
    -----
    Runs go into the store of the search. D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37
    (1988) 87-94.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import identify, profile
    >>> x = np.linspace(0, 1, 50)
    >>> def curve(p):
    ...     return np.column_stack((x, p["K"] * x ** p["n"]))
    >>> test = curve({"K": 2.0, "n": 0.5})
    >>> test[:, 1] += np.random.default_rng(0).normal(0.0, 0.05, 50)
    >>> bounds = {"K": (1, 5), "n": (0.1, 1)}
    >>> found = identify(curve, test, bounds, measure="sum_of_squares", progress=False)
    >>> low, high = profile(found, "n", points=5).interval
    >>> low < found.parameters["n"] < high
    True
    """
    space = found.problem.space
    if name not in space.names or len(space.names) < 2:
        raise ValueError(f"{name!r} is not one of several parameters: {', '.join(space.names)}")
    if points < 5 or points % 2 == 0:
        raise ValueError(f"points is {points}; give an odd number, at least 5")
    uncertainty = found.uncertainty(level=level)
    optimum, index = uncertainty.optimum, space.names.index(name)
    noise = noise_of(optimum, None)
    linear = linear_spread(optimum, noise, level).intervals[index]
    # Half the interval, taken on the side that a bound does not cut.
    half = max(abs(end - found.parameters[name]) for end in linear)
    values = _values(found, half, name, points)
    search = method or TrustRegion(initial_range=0.05)
    at_values = [found.parameters] * points
    lowest, runs = np.full(points, found.value), uncertainty.runs
    middle = points // 2
    for i in [*range(middle + 1, points), *range(middle - 1, -1, -1)]:
        if values[i] == values[middle]:  # at a bound
            continue
        near = at_values[i - 1] if i > middle else at_values[i + 1]
        held = replace(found.problem, space=space.with_fixed(name, float(values[i])))
        start = {key: near[key] for key in held.space.names}
        plan = Plan(search, found.seed, start, False, None, None, found.execution)
        best = identification_of(held, plan)
        at_values[i], lowest[i], runs = best.parameters, best.value, runs + best.runs
    rise = _rise(optimum, noise, index, half)
    sides = [(values[middle::-1], lowest[middle::-1]), (values[middle:], lowest[middle:])]
    crossings = [_crossing(*side, rise) for side in sides]
    kept = [i for i in range(points) if i == middle or values[i] != values[middle]]
    return Profile(
        name,
        values[kept],
        lowest[kept],
        tuple({key: at_values[i][key] for key in space.names} for i in kept),
        (crossings[0][0], crossings[1][0]),
        (crossings[0][1], crossings[1][1]),
        linear,
        rise,
        level,
        runs,
    )


def _values(found: Identification, half: float, name: str, points: int) -> Array:
    """Return at what values the parameter is held, within its bounds."""
    low, high = found.bounds[name]
    best, reach = found.parameters[name], _BEYOND * half
    below = np.linspace(max(low, best - reach), best, points // 2 + 1)
    above = np.linspace(best, min(high, best + reach), points // 2 + 1)
    return np.concatenate((below, above[1:]))


def _rise(optimum: Optimum, noise: Noise, index: int, half: float) -> float:
    """Return the rise of the objective at the ends of the interval by sensitivities."""
    differential = optimum.problem.space.differential(optimum.unit)
    return rise_at(optimum, noise, index, half / abs(float(differential[index, index])))


def _crossing(values: Array, lowest: Array, rise: float) -> tuple[float, bool]:
    """Return where a side of the profile reaches the rise; whether it is open.

    The square root of the rise is interpolated between values, because it is linear for a parabola.
    """
    roots = np.sqrt(np.maximum(lowest - lowest[0], 0.0))
    wanted = float(np.sqrt(rise))
    beyond = np.flatnonzero(roots > wanted)
    if not beyond.size:
        return float(values[-1]), True
    k = int(beyond[0])
    part = (wanted - roots[k - 1]) / (roots[k] - roots[k - 1])
    return float(values[k - 1] + part * (values[k] - values[k - 1])), False
