"""The space that is searched: names, bounds, and the unit cube that optimisers see.

Optimisers work in the unit cube, so that a modulus of 10⁵ and an exponent of 0.1 weigh alike. A
point is a tuple of Python floats in the order of the bounds; the same point of the cube always
gives the same bits, which is what a resumed run finds its evaluations by.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from .._curves import Array

__all__ = ["Point", "Space"]

Point: TypeAlias = tuple[float, ...]

# Columns of the history, beside the parameters.
_RESERVED = ("evaluation", "value", "failed", "seconds", "message", "simulations")


class Space:
    """Named parameters with bounds.

    Parameters
    ----------
    bounds : mapping of str to (low, high)
        In the order in which parameters are listed from then on.

    Raises
    ------
    ValueError
        No parameter, a name that is reserved, or bounds that are not finite with low < high.
    """

    def __init__(self, bounds: Mapping[str, tuple[float, float]]) -> None:
        if not isinstance(bounds, Mapping) or not bounds:
            raise ValueError("bounds is empty; give a dict of name: (low, high)")
        for name, pair in bounds.items():
            if not isinstance(name, str) or not name or name in _RESERVED:
                raise ValueError(f"a parameter cannot be called {name!r}; rename it")
            if np.shape(pair) != (2,):
                raise ValueError(f"bounds[{name!r}] is {pair!r}; give (low, high)")
            low, high = pair
            if not (math.isfinite(low) and math.isfinite(high) and low < high):
                raise ValueError(f"bounds[{name!r}] is {pair!r}; they must be finite, low < high")
            if not math.isfinite(high - low):
                raise ValueError(f"bounds[{name!r}] is {pair!r}; the range overflows")
        self.bounds = {name: (float(low), float(high)) for name, (low, high) in bounds.items()}
        self.names = tuple(self.bounds)
        self._low = np.array([low for low, _ in self.bounds.values()])
        self._high = np.array([high for _, high in self.bounds.values()])

    def point(self, unit: Array) -> Point:
        """Return the parameters at a point of the unit cube."""
        scaled = self._low + np.clip(unit, 0.0, 1.0) * (self._high - self._low)
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
        unit: Array = (values - self._low) / (self._high - self._low)
        return unit

    @property
    def is_log(self) -> tuple[bool, ...]:
        """Whether each parameter is searched for on a logarithmic scale."""
        return (False,) * len(self.names)

    def differential(self, unit: Array) -> Array:
        """Return the derivatives of the parameters by the place in the unit cube, shape (k, k)."""
        return np.diag(self._high - self._low)

    def unit_of(self, parameters: Mapping[str, float]) -> Array:
        """Return where in the unit cube all that a model is called with lies."""
        return self.unit({name: parameters[name] for name in self.names}, "parameters")

    def dictionary(self, point: Point) -> dict[str, float]:
        """Return a point as the dict that a model is called with."""
        return dict(zip(self.names, point, strict=True))
