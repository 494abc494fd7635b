"""Bounds of parameters for `identify`, also derived from tests by a material."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

__all__ = ["DECADE", "Below", "Bounds", "Log", "OutsideModelError", "Tied", "on_its_scale"]

# Bounds that go further than this, the upper by the lower, are better searched as logarithms.
DECADE = 10.0


class OutsideModelError(ValueError):
    """A model does not have an answer for these parameters; not a failed run.

    A search does not go there, does not log it and does not count it among its failures.

    Examples
    --------
    >>> from curvewise.calibration import OutsideModelError
    >>> def model(p):
    ...     if p["a"] >= p["b"]:
    ...         raise OutsideModelError("a must be below b")
    ...     return [(0.0, 0.0), (1.0, p["b"] - p["a"])]
    """


@dataclass(frozen=True)
class Log:
    """Bounds of a parameter that is searched for on a logarithmic scale.

    Parameters
    ----------
    low, high : float
        Above 0.

    Examples
    --------
    >>> from curvewise.calibration import Log
    >>> bounds = {"viscosity": Log(1e-2, 1e4)}
    """

    low: float
    high: float


@dataclass(frozen=True)
class Below:
    """Bounds of a parameter that stays below another one in every run.

    They suit, for example, two back stresses that could change places: C1 > C2.

    Parameters
    ----------
    other : str
        A parameter with its own bounds, listed before this one.
    low, high : float
        The additional bounds of this parameter.

    Examples
    --------
    >>> from curvewise.calibration import Below
    >>> bounds = {"C1": (1e3, 300e3), "C2": Below("C1", 1e3, 300e3)}
    """

    other: str
    low: float
    high: float


@dataclass(frozen=True)
class Tied:
    """A parameter that follows from the others.

    Parameters
    ----------
    function : callable
        A function of the dict of parameters listed before it.

    Examples
    --------
    >>> from curvewise.calibration import Tied
    >>> bounds = {"E": (150e3, 230e3), "G": Tied(lambda p: p["E"] / 2.6)}
    """

    function: Callable[[dict[str, float]], float]


Bounds: TypeAlias = Mapping[str, "tuple[float, float] | float | Log | Below | Tied"]


def on_its_scale(low: float, high: float) -> tuple[float, float] | Log:
    """Return bounds above 0, logarithmic where they go over more than a decade."""
    return Log(low, high) if high > DECADE * low else (low, high)
