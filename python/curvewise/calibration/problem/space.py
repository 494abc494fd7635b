"""The parameter space: names, bounds, and the unit cube of the optimisers.

Optimisers work in the unit cube, so that a modulus of 10⁵ and an exponent of 0.1 have the same
weight. A point is a tuple of Python floats in the order of the bounds. The same point of the cube
always gives bitwise identical parameters. A resumed search finds its evaluations by them. A
parameter may also use a logarithmic scale, stay below another one, be fixed, or follow from the
others.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..._bounds import DECADE, Below, Bounds, Log, Tied
from ...curves.foreign_curves import warn
from ...curves.inputs import Array
from ..models.identity import fingerprint
from ..records.evaluation import Point

__all__ = ["Space", "WideBoundsWarning"]

# Columns of the table of evaluations, in addition to the parameters.
_RESERVED = ("evaluation", "value", "failed", "seconds", "message")

# Gap between a parameter and the one that it must stay below, as a fraction of its bounds' range.
_GAP = 1e-6

# A parameter within this fraction of the range from a bound is reported as at the bound.
_AT_BOUND = 1e-3


class WideBoundsWarning(UserWarning):
    """Linear bounds span more than a decade and lie mostly in the last decade.

    :func:`identify`, :func:`identify_each` and :func:`cross_validate` warn once, before the first
    run of the model. Use :class:`Log` for such bounds.

    Examples
    --------
    >>> import warnings
    >>> from curvewise.calibration import WideBoundsWarning
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", WideBoundsWarning)  # and identify(...) here
    """


class Space:
    """Named parameters with bounds.

    Parameters
    ----------
    bounds : mapping of str to (low, high), Log, Below, Tied or float
        The bounds; their order is the order of the parameters everywhere. A number, or low = high,
        fixes a parameter.

    Attributes
    ----------
    names : tuple of str
        The parameters to search for.
    bounds : dict of str to (low, high)
        The bounds of these parameters.
    is_log : tuple of bool
        Whether each of them uses a logarithmic scale.
    fixed : dict of str to float
        The fixed parameters.

    Raises
    ------
    ValueError
        If no parameter is left to search for, or a name is reserved. If bounds are not finite with
        low < high, or not above 0 on a logarithmic scale. If a parameter must stay below one that
        is not listed before it.
    """

    def __init__(self, bounds: Bounds) -> None:
        if not isinstance(bounds, Mapping):
            raise ValueError(f"bounds is {type(bounds).__name__}; give a dict of name: (low, high)")
        if not bounds:
            raise ValueError("bounds is empty; give a dict of name: (low, high)")
        self.bounds: dict[str, tuple[float, float]] = {}
        self._given = dict(bounds)
        self._others: dict[int, int] = {}  # of a parameter the one that it stays below
        self.fixed: dict[str, float] = {}
        is_log = []
        for name, given in bounds.items():
            if not isinstance(name, str) or not name or name in _RESERVED:
                raise ValueError(f"a parameter cannot be called {name!r}; rename it")
            if isinstance(given, Tied):
                continue
            low, high = _pair(name, given)
            if low == high:
                self.fixed[name] = low
                continue
            if isinstance(given, Below):
                self._others[len(self.bounds)] = self._index(name, given.other)
            self.bounds[name] = (low, high)
            is_log.append(isinstance(given, Log))
        if not self.bounds:
            raise ValueError("every parameter is fixed; give one of them bounds (low, high)")
        self.names = tuple(self.bounds)
        self.is_log = tuple(is_log)
        self._low = np.array([low for low, _ in self.bounds.values()])
        self._high = np.array([high for _, high in self.bounds.values()])
        self._gaps = _GAP * (self._high - self._low)
        for below, above in self._others.items():  # so that there is always room below
            self._low[above] = max(self._low[above], self._low[below] + 2.0 * self._gaps[below])
            if not self._low[above] < self._high[above]:
                raise ValueError(
                    f"{self.names[below]} cannot stay below {self.names[above]} within their bounds"
                )
        self._logs = [i for i, log in enumerate(self.is_log) if log]

    def _index(self, name: str, other: str) -> int:
        if other not in self.bounds:
            raise ValueError(
                f"{name} stays below {other!r}, which is not a parameter with bounds before it"
            )
        return list(self.bounds).index(other)

    def warn_of_wide_bounds(self) -> None:
        """Warn of parameters that are better searched for on a logarithmic scale."""
        wide = [
            f"{name} ({low:g} to {high:g})"
            for (name, (low, high)), is_log in zip(self.bounds.items(), self.is_log, strict=True)
            if not is_log and not isinstance(self._given[name], Below) and 0.0 < DECADE * low < high
        ]
        if wide:
            warn(
                WideBoundsWarning(
                    f"the bounds of {', '.join(wide)} go over more than a decade: a logarithmic "
                    "scale searches small values like large ones, Log(low, high), in a study "
                    "scale = 'log'"
                )
            )

    @property
    def settings(self) -> dict[str, Any]:
        """The record of the space; for plain bounds the bounds."""
        settings: dict[str, Any] = {}
        for name, given in self._given.items():
            if isinstance(given, Tied):
                settings[name] = ["tied", fingerprint(given.function)]
            elif isinstance(given, Below):
                settings[name] = ["below", given.other, *self.bounds[name]]
            elif isinstance(given, Log):
                settings[name] = ["log", *_pair(name, given)]
            else:
                settings[name] = self.bounds.get(name, self.fixed.get(name))
        return settings

    def point(self, unit: Array) -> Point:
        """Return the parameters at a point of the unit cube."""
        unit = np.clip(unit, 0.0, 1.0)
        scaled = self._low + unit * (self._high - self._low)
        for i in self._logs:
            scaled[i] = self._low[i] * (self._high[i] / self._low[i]) ** unit[i]
        for below, above in self._others.items():
            high = min(self._high[below], scaled[above] - self._gaps[below])
            reached = self._low[below] + unit[below] * (high - self._low[below])
            scaled[below] = min(reached, high)  # a rounding above it would be refused by `unit`
        return tuple(np.clip(scaled, self._low, self._high).tolist())

    def unit(self, parameters: Mapping[str, float], name: str = "start") -> Array:
        """Return the point of the unit cube for parameters, which must lie within the bounds."""
        if set(parameters) != set(self.names):
            raise ValueError(
                f"{name} has parameters {', '.join(map(str, parameters))}; "
                f"give a value for each of {', '.join(self.names)}"
            )
        values = np.array([float(parameters[key]) for key in self.names])
        for key, value, low, high in zip(self.names, values, self._low, self._high, strict=True):
            if not low <= value <= high:
                raise ValueError(f"{name}[{key!r}] is {value}; it must be from {low} to {high}")
        for below, above in self._others.items():
            if values[below] > min(self._high[below], values[above] - self._gaps[below]):
                raise ValueError(
                    f"{name}[{self.names[below]!r}] is {values[below]}; it must be below "
                    f"{self.names[above]}, {values[above]}"
                )
        return np.array([self.place(key, parameters[key], parameters) for key in self.names])

    def unit_of(self, parameters: Mapping[str, float]) -> Array:
        """Return where in the unit cube all that a model is called with lies."""
        return self.unit({name: parameters[name] for name in self.names}, "parameters")

    def with_fixed(self, name: str, value: float) -> Space:
        """Return the same space with one parameter fixed."""
        return Space({**self._given, name: value})

    def place(
        self, name: str, value: float, parameters: Mapping[str, float] | None = None
    ) -> float:
        """Return where a value is between the bounds of its parameter.

        Parameters
        ----------
        name : str
            A parameter that is searched for.
        value : float
            The value of the parameter.
        parameters : mapping of str to float, optional
            All of them: with them the upper bound of a parameter that stays below another one is
            at most the value of that one.

        Returns
        -------
        float
            0 at the lower bound and 1 at the upper one, less or more outside of them; on a
            logarithmic scale where the parameter is searched for on one.
        """
        i, value = self.names.index(name), float(value)
        low, high = float(self._low[i]), float(self._high[i])
        if parameters is not None and i in self._others:
            above = float(parameters[self.names[self._others[i]]])
            high = min(high, above - float(self._gaps[i]))
        if self.is_log[i]:
            return math.log(value / low) / math.log(high / low) if value > 0 else -math.inf
        return (value - low) / (high - low)

    def at_bounds(self, parameters: Mapping[str, float]) -> dict[str, str]:
        """Return "lower" or "upper" for every parameter that is at a bound, to 0.1 % of the range.

        For a parameter that must stay below another one, the largest allowed value counts as its
        upper bound.
        """
        places = {name: self.place(name, parameters[name], parameters) for name in self.names}
        return {
            name: "lower" if place < 0.5 else "upper"
            for name, place in places.items()
            if min(place, 1.0 - place) < _AT_BOUND
        }

    def at_limits(self, parameters: Mapping[str, float]) -> tuple[str, ...]:
        """Return the parameters at a natural bound: 0 or their upper parameter.

        Nothing lies beyond such a bound, because a modulus, a rate or a share cannot be negative.
        """
        at_bounds = self.at_bounds(parameters)
        return tuple(n for n, side in at_bounds.items() if self._is_limit(n, side, parameters))

    def _is_limit(self, name: str, side: str, parameters: Mapping[str, float]) -> bool:
        i, upper = self.names.index(name), side == "upper"
        above = parameters[self.names[self._others[i]]] if i in self._others else math.inf
        return self.bounds[name][upper] == 0.0 or (upper and above < self.bounds[name][1])

    def open_ends(
        self, name: str, interval: tuple[float, float], parameters: Mapping[str, float]
    ) -> tuple[bool, bool]:
        """Return which ends of a parameter's interval are at a bound, and not at a limit.

        There the bound, and not the tests, has ended the interval.
        """
        low, high = (self.place(name, end, parameters) for end in interval)
        return (
            abs(low) < _AT_BOUND and not self._is_limit(name, "lower", parameters),
            abs(1.0 - high) < _AT_BOUND and not self._is_limit(name, "upper", parameters),
        )

    def differential(self, unit: Array) -> Array:
        """Return the derivatives of the parameters by the place in the unit cube, shape (k, k)."""
        unit = np.clip(unit, 0.0, 1.0)
        values = self.point(unit)
        slopes = np.diag(self._high - self._low)
        for i in self._logs:
            slopes[i, i] = values[i] * math.log(self._high[i] / self._low[i])
        for below, above in self._others.items():
            most = values[above] - self._gaps[below]
            if most < self._high[below]:
                slopes[below] = unit[below] * slopes[above]
                slopes[below, below] = most - self._low[below]
        return slopes

    def rates(self, unit: Array) -> Array:
        """Return the derivatives of all that a model is called with by the place in the unit cube.

        Shape (p, k): parameters that are fixed count among the p, and tied ones, by differences.
        """
        free = self.differential(unit)
        rows = np.zeros((len(self._given), len(self.names)))
        for row, (name, given) in enumerate(self._given.items()):
            if isinstance(given, Tied):
                rows[row] = self._tied_rates(name, unit)
            elif name in self.bounds:
                rows[row] = free[self.names.index(name)]
        return rows

    def _tied_rates(self, name: str, unit: Array) -> Array:
        step = 1e-6
        rates = []
        for axis in np.eye(len(unit)):
            ends = np.clip((unit + step * axis, unit - step * axis), 0.0, 1.0)
            high, low = (self.dictionary(self.point(end))[name] for end in ends)
            rates.append((high - low) / float((ends[0] - ends[1]) @ axis))
        return np.array(rates)

    def dictionary(self, point: Point) -> dict[str, float]:
        """Return a point as the dict that a model is called with."""
        free = dict(zip(self.names, point, strict=True))
        values: dict[str, float] = {}
        for name, given in self._given.items():
            if name in free:
                values[name] = free[name]
            elif isinstance(given, Tied):
                values[name] = float(given.function(dict(values)))
            else:
                values[name] = self.fixed[name]
        return values


def _pair(name: str, given: Any) -> tuple[float, float]:
    """Return low and high; the same number twice for a parameter that is fixed."""
    pair = (given.low, given.high) if isinstance(given, (Log, Below)) else given
    if np.ndim(pair) == 0 and isinstance(pair, (int, float, np.number)) and math.isfinite(pair):
        return float(pair), float(pair)
    if np.shape(pair) != (2,):
        raise ValueError(
            f"bounds[{name!r}] is {given!r}; give (low, high), or a number that it stays"
        )
    low, high = pair
    may_stay = low == high and not isinstance(given, (Log, Below))
    if not (math.isfinite(low) and math.isfinite(high) and (low < high or may_stay)):
        raise ValueError(f"bounds[{name!r}] is {given!r}; they must be finite, low < high")
    if not math.isfinite(high - low):
        raise ValueError(f"bounds[{name!r}] is {given!r}; the range overflows")
    if isinstance(given, Log) and low <= 0:
        raise ValueError(f"bounds[{name!r}] is {given!r}; a logarithm needs low above 0")
    return float(low), float(high)
