"""The terms of an objective: one measured curve or number each.

The experiment is checked and scaled once; an invalid experiment raises an error then. An invalid
simulation raises `FailedSimulationError` later, and the objective uses the term's failure value
instead. Cost: that of the measure.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from ...curves.inputs import Array, check_column_names, column_names
from ...curves.missing import skip_in_each
from ...curves.named_curve import axis_names, known_names
from ...curves.scaling import box
from ...curves.several_curves import as_points
from ...curves.thinning import Rows
from ...measures import normalize
from ...measures.results import PcmMatch
from .common_x import check_common_x, y_column
from .criterion import Criterion
from .of_simulation import of_simulation

__all__ = ["CurveTerm", "FailedSimulationError", "Label", "NumberTerm", "Term"]

T = TypeVar("T")

# The value of a failed simulation, in values of one that deviates by the loop's range of y.
_FAILURE = 1e6
_DIFFERENCE = 1e-6  # of a place in the unit cube, along known derivatives


class FailedSimulationError(Exception):
    """Raised if a simulation does not have a value; the message says why."""


class Label(NamedTuple):
    """The names of a term.

    Attributes
    ----------
    title : str
        In pictures and tables.
    argument : str
        The name of its experiment in errors.
    prefix : str
        The beginning of the message of a failed simulation.
    """

    title: str
    argument: str
    prefix: str


class Term(ABC):
    """One experiment, with its criterion and its weight.

    Parameters
    ----------
    experiment
        The curve or number with which simulations are compared.
    criterion : Criterion
        The comparison.
    label : Label
        The name of the experiment.
    factor : float
        The user's weight.
    sigma : float, optional
        The standard deviation of the noise in y, as the unit of the weight.

    Attributes
    ----------
    experiment : ndarray, shape (n, d)
        The experiment in float64; shape (1, 1) for a number.
    names : tuple of str
        The names of its columns; empty if they are unknown.
    y : int
        The column with noise.
    extent : ndarray, shape (d,)
        The extent of the experiment in each coordinate; for a number the number itself.
    height : float
        The divisor of y before the comparison.
    scale : float
        The measure of a simulation that deviates by the experiment's range of y.
    residual_count : int
        The number of residuals.
    has_gradient, can_be_thinned : bool
        See `Objective`.
    weight, failure_value : float
        The factor of the value; the value of a failed simulation.
    """

    experiment: Array
    names: tuple[str, ...]
    y: int
    extent: Array
    height: float
    scale: float
    residual_count: int
    has_gradient: bool
    can_be_thinned: bool

    def __init__(
        self,
        experiment: Any,
        criterion: Criterion,
        label: Label,
        factor: float = 1.0,
        sigma: float | None = None,
    ) -> None:
        self.criterion, self.label, self.factor, self.sigma = criterion, label, factor, sigma
        self._prepare(experiment)
        self.weight = self._weight()
        given = criterion.failure_value
        self.failure_value = _FAILURE * self.scale if given is None else given

    def of(self, experiment: Any) -> Term:
        """Return the same term of another experiment."""
        return type(self)(experiment, self.criterion, self.label, self.factor, self.sigma)

    def thinned(self, rows: Rows) -> Term:
        """Return the term of some points of the experiment, weighted to count the same."""
        thinned = self.of(self.experiment[rows])
        thinned.weight = self.weight * self.scale / thinned.scale
        thinned.failure_value = self.failure_value * thinned.scale / self.scale
        return thinned

    @property
    def is_least_squares(self) -> bool:
        """Whether the value is the sum of the squares of the residuals."""
        return self.criterion.measure == "sum_of_squares"

    @property
    def is_area_of_pieces(self) -> bool:
        """Whether the value adds up absolute areas of pieces: area with spacing "matched"."""
        options = self.criterion.condition.options
        others = options.get("squared") or options.get("closed")
        is_of_pieces = options.get("spacing") == "matched" and not others
        return self.criterion.measure == "area" and is_of_pieces

    @property
    def is_sum_of_distances(self) -> bool:
        """Whether the value adds up Euclidean distances of all points: dtw without options."""
        return self.criterion.measure == "dtw" and not self.criterion.condition.options

    @property
    def settings(self) -> dict[str, Any]:
        """The settings that a record stores in addition to the experiment."""
        return {
            "name": self.label.title,
            "criterion": self.criterion.settings,
            "weight": self.factor,
            "sigma": self.sigma,
        }

    def axes(self, names: Sequence[str] | None) -> tuple[str, ...]:
        """Return what the coordinates are called: as given, or as the columns are."""
        given = names if self.experiment.size > 1 else None
        if given is None and len(self.names) == self.experiment.shape[1]:
            return self.names
        return axis_names(self.experiment.shape[1], given)

    def residuals_or_penalty(self, simulation: Any) -> Array:
        """Return the residuals; those of a failed simulation are equal and add up to its value.

        Squared for curve_length, whose value is the root of a sum.
        """
        try:
            return self.residuals(simulation)
        except FailedSimulationError:
            total = self.failure_value if self.is_least_squares else self.failure_value**2
            return np.full(self.residual_count, math.sqrt(total / self.residual_count))

    def residual_slopes(self, simulation: Any, directions: Array) -> Array:
        """Return how fast the residuals change as a simulation moves, by differences.

        Parameters
        ----------
        simulation : ndarray, shape (n, d)
            One that has not failed.
        directions : ndarray, shape (n, d, k)
            The directions in which it moves.

        Returns
        -------
        ndarray, shape (m, k)
        """
        step, moves = _DIFFERENCE, np.moveaxis(directions, -1, 0)
        ahead, behind = (
            [self.residuals_or_penalty(simulation + by * move) for move in moves]
            for by in (step, -step)
        )
        return np.subtract(ahead, behind).T / (2.0 * step)

    def fitted(self, simulation: Any) -> Array:
        """Return the experiment with the simulated y, of a sum of squares."""
        return _moved(self.experiment, self.y, self.height * self.residuals(simulation))

    @abstractmethod
    def value(self, simulation: Any) -> float:
        """Return the value of the measure, or raise FailedSimulationError."""

    @abstractmethod
    def value_and_gradient(self, simulation: Any) -> tuple[float, Array]:
        """Return the value and its derivative by the simulation's coordinates."""

    @abstractmethod
    def residuals(self, simulation: Any) -> Array:
        """Return the differences that the measure squares, or raise FailedSimulationError."""

    @abstractmethod
    def _prepare(self, experiment: Any) -> None:
        """Check the experiment, and set the attributes."""

    def _weight(self) -> float:
        """Return the factor, in units of the noise if that is given."""
        return self.factor


class CurveTerm(Term):
    """A curve, scaled and ready to be compared with simulations."""

    def _prepare(self, experiment: Any) -> None:
        argument = self.label.argument
        given = as_points(experiment, argument)
        (kept,) = skip_in_each([given], [argument], self.criterion.missing)
        self.experiment = kept.copy()
        self._columns = column_names(experiment)
        self.names = tuple(known_names(experiment))
        self._name = "the experiment" if argument == "P" else argument
        try:
            (P,) = normalize(self.experiment)  # raises an error if it is empty or not finite
            self._box = box(self.experiment) if self.criterion.condition.scaled else None
            P = self.experiment if self._box is None else P
            extent = np.ptp(self.experiment, axis=0)
            self.extent = np.where(extent > 0, extent, 1.0)
            self.y = P.shape[1] - 1
            if self.is_least_squares:
                abscissa = self.criterion.options.get("abscissa", 0)
                check_common_x(P, abscissa)
                self.y = y_column(abscissa)
            self.height = 1.0 if self._box is None else float(self._box[1][self.y])
            self._measured = of_simulation(self.criterion, P)
            # Fails here, not at the first simulation, for an experiment or option it refuses.
            height = np.ptp(P[:, self.y]) or 1.0
            value = self._measured.value(_moved(P, self.y, height))
            self.scale = value.value if isinstance(value, PcmMatch) else value
        except ValueError as error:
            prefix = "" if argument == "P" else f"{argument}, as P: "
            raise ValueError(f"{prefix}{error}") from error
        if not math.isfinite(self.scale):
            raise ValueError(f"{argument}: the measure overflows; give the curve in larger units")
        residuals = self._measured.residuals
        self.residual_count = 0 if residuals is None else residuals(P).size
        self.has_gradient = self._measured.gradient is not None
        self.can_be_thinned = not self.is_least_squares

    def _weight(self) -> float:
        if self.sigma is None:
            return self.factor
        if self.is_least_squares:
            return self.factor * float(self.height / self.sigma) ** 2
        off_by_sigma = _moved(self.experiment, self.y, self.sigma)
        return self.factor / float(self.value(off_by_sigma))

    def value(self, simulation: Any) -> float:
        """Return the value of the measure, or raise FailedSimulationError."""
        value = self._asked(self._measured.value, simulation)
        if isinstance(value, PcmMatch):
            value = self._covered(value)
        if not math.isfinite(value):
            raise FailedSimulationError(f"the value of the measure is {value}")
        return value

    def value_and_gradient(self, simulation: Any) -> tuple[float, Array]:
        """Return the value and its derivative by the simulation's coordinates."""
        assert self._measured.gradient is not None, "see has_gradient"
        value, gradient = self._asked(self._measured.gradient, simulation)
        if not (math.isfinite(value) and np.isfinite(gradient).all()):
            raise FailedSimulationError(f"the value of the measure is {value}")
        return value, gradient if self._box is None else gradient / self._box[1]

    def residuals(self, simulation: Any) -> Array:
        """Return the differences that the measure squares, or raise FailedSimulationError."""
        assert self._measured.residuals is not None, "Objective refuses measures without"
        return self._asked(self._measured.residuals, simulation).ravel()

    def residual_slopes(self, simulation: Any, directions: Array) -> Array:
        """Return how fast the residuals change as a simulation moves; exactly, of squares."""
        slopes = self._measured.residual_slopes
        if slopes is None:
            return super().residual_slopes(simulation, directions)
        if self._box is not None:
            directions = directions / self._box[1][:, np.newaxis]
        return slopes(self._checked(simulation), directions)

    def _asked(self, function: Callable[[Array], T], simulation: Any) -> T:
        """Return the result of a function of the measure for a valid simulation."""
        Q = self._checked(simulation)
        try:
            return function(Q)
        except ValueError as error:
            raise FailedSimulationError(str(error)) from error

    def _checked(self, simulation: Any) -> Array:
        if simulation is None:
            raise FailedSimulationError("no simulation")
        if isinstance(simulation, BaseException):
            raise FailedSimulationError(f"{type(simulation).__name__}: {simulation}")
        if np.iscomplexobj(simulation):  # Python's root of a negative number
            raise FailedSimulationError("the simulation is complex")
        Q = as_points(simulation, "Q")
        # Swapped columns would be scored as if they were not.
        check_column_names(self._columns, self._name, column_names(simulation), "the simulation")
        if Q.size == 0:
            raise FailedSimulationError("the simulation is empty")
        if Q.shape[1] != self.experiment.shape[1]:
            raise ValueError(
                f"a simulation has shape {Q.shape} and its experiment {self.experiment.shape}; "
                "they must have the same number of coordinates"
            )
        if self._box is not None:
            low, extent = self._box
            with np.errstate(over="ignore", invalid="ignore"):  # reported by the measure
                Q = (Q - low) / extent
        return Q

    def _covered(self, match: PcmMatch) -> float:
        """Return the value of a match; too short a simulation is FailedSimulationError."""
        least = 0.0 if self.criterion.part == "simulation" else self.criterion.min_coverage
        if match.mapped == "Q" and match.coverage < least:
            raise FailedSimulationError(
                f"the simulation has {match.coverage:.3g} of the experiment's length, "
                f"min_coverage is {least:g}"
            )
        return match.value


class NumberTerm(Term):
    """A number; differences are in units of sigma, or else of the number itself."""

    scale = 1.0
    residual_count = 1
    y = 0
    names = ()
    has_gradient = can_be_thinned = True

    def _prepare(self, experiment: Any) -> None:
        self.experiment = np.array(experiment, dtype=np.float64).reshape(1, 1)
        self._target = float(self.experiment[0, 0])
        if not math.isfinite(self._target):
            raise ValueError(f"{self.label.argument}: the experiment is {self._target}")
        self.height = self.sigma or abs(self._target) or 1.0
        self.extent = np.array([abs(self._target) or 1.0])

    def value(self, simulation: Any) -> float:
        """Return the difference, or its square, in units of sigma or of the number."""
        difference = float(self.residuals(simulation)[0])
        return difference**2 if self.is_least_squares else abs(difference)

    def value_and_gradient(self, simulation: Any) -> tuple[float, Array]:
        """Return the value and its derivative by the number."""
        difference = float(self.residuals(simulation)[0])
        if self.is_least_squares:
            return difference**2, np.array([[2.0 * difference / self.height]])
        return abs(difference), np.array([[np.sign(difference) / self.height]])

    def residuals(self, simulation: Any) -> Array:
        """Return the difference."""
        if simulation is None or isinstance(simulation, BaseException):
            raise FailedSimulationError(str(simulation) if simulation else "no simulation")
        value = as_points(simulation, "Q")
        if value.size != 1:
            raise ValueError(
                f"a simulation has shape {value.shape} and its experiment is a number; "
                "give the case a response"
            )
        if not np.isfinite(value).all():
            raise FailedSimulationError(f"the simulation is {value[0, 0]}")
        return np.array([(float(value[0, 0]) - self._target) / self.height])


def _moved(curve: Array, y: int, by: float | Array) -> Array:
    """Return the curve, moved along a coordinate."""
    moved = curve.copy()
    moved[:, y] += by
    return moved
