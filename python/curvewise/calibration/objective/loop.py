"""One experiment, and the value of a simulation beside it.

The experiment is checked and scaled once. What is wrong with it is an error then; what is wrong
with a simulation later is a `FailedSimulationError`, from which an objective makes a penalty. Cost:
that of the measure.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...curves.inputs import Array, check_column_names, column_names
from ...curves.named_curve import known_names
from ...curves.scaling import box
from ...curves.several_curves import as_points
from ...measures import normalize
from ...measures.results import PcmMatch
from .common_x import check_common_x, y_column
from .loop_measure import Measure, Part, functions, gradient_of

__all__ = ["FailedSimulationError", "Loop"]


class FailedSimulationError(Exception):
    """A simulation has no value; the message says why."""


class Loop:
    """One experiment, checked and scaled, ready to be compared with simulations."""

    def __init__(
        self,
        experiment: Any,
        name: str,
        measure: Measure,
        scaled: bool,
        options: dict[str, Any],
        part: Part,
        min_coverage: float,
    ) -> None:
        self.experiment = as_points(experiment, name).copy()
        self._columns = column_names(experiment)
        self.names = known_names(experiment)
        self.can_be_thinned = measure != "sum_of_squares"
        self._name = "the experiment" if name == "P" else name
        self._min_coverage = 0.0 if part == "simulation" else min_coverage
        try:
            (P,) = normalize(self.experiment)  # refuses what is empty or not finite
            self._box = box(self.experiment) if scaled else None
            self._P = P if scaled else self.experiment
            extent = np.ptp(self.experiment, axis=0)
            self.extent = np.where(extent > 0, extent, 1.0)
            self.y = self._P.shape[1] - 1  # the column that noise is in
            if measure == "sum_of_squares":
                over = options.get("over", 0)
                check_common_x(self._P, over)
                self.y = y_column(over)
            self.height = 1.0 if self._box is None else float(self._box[1][self.y])
            self._value, self._residuals = functions(measure, self._P, options, part)
            self._gradient = gradient_of(measure, self._P, options, part)
            # Fails here, not at the first simulation, for an experiment or option it refuses.
            value = self._value(_moved_up(self._P, self.y))
            self.scale = value.value if isinstance(value, PcmMatch) else value
        except ValueError as error:
            prefix = "" if name == "P" else f"{name}, as P: "
            raise ValueError(f"{prefix}{error}") from error
        if not math.isfinite(self.scale):
            raise ValueError(f"{name}: the measure overflows; give the curve in larger units")
        self.residual_count = 0 if self._residuals is None else self._residuals(self._P).size

    def value(self, simulation: Any) -> float:
        """Return the value of the measure, or raise FailedSimulationError."""
        Q = self._checked(simulation)
        try:
            value = self._value(Q)
        except ValueError as error:
            raise FailedSimulationError(str(error)) from error
        if isinstance(value, PcmMatch):
            value = self._covered(value)
        if not math.isfinite(value):
            raise FailedSimulationError(f"the value of the measure is {value}")
        return value

    @property
    def has_gradient(self) -> bool:
        """Whether there is a gradient that is of use to a minimisation."""
        return self._gradient is not None

    def value_and_gradient(self, simulation: Any) -> tuple[float, Array]:
        """Return the value and its derivative by the simulation's coordinates."""
        assert self._gradient is not None, "see has_gradient"
        Q = self._checked(simulation)
        try:
            value, gradient = self._gradient(Q)
        except ValueError as error:
            raise FailedSimulationError(str(error)) from error
        if not (math.isfinite(value) and np.isfinite(gradient).all()):
            raise FailedSimulationError(f"the value of the measure is {value}")
        return value, gradient if self._box is None else gradient / self._box[1]

    def of_move(self, distance: float) -> float:
        """Return the measure of a simulation that is off by a distance in y everywhere."""
        moved = self.experiment.copy()
        moved[:, self.y] += distance
        return self.value(moved)

    def residuals(self, simulation: Any) -> Array:
        """Return the differences that the measure squares, or raise FailedSimulationError."""
        assert self._residuals is not None, "Objective refuses measures without"
        Q = self._checked(simulation)
        try:
            return self._residuals(Q).ravel()
        except ValueError as error:
            raise FailedSimulationError(str(error)) from error

    def _checked(self, simulation: Any) -> Array:
        if simulation is None:
            raise FailedSimulationError("no simulation")
        if isinstance(simulation, BaseException):
            raise FailedSimulationError(f"{type(simulation).__name__}: {simulation}")
        if np.iscomplexobj(simulation):  # what Python makes of a root of a negative number
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
        if match.mapped == "Q" and match.coverage < self._min_coverage:
            raise FailedSimulationError(
                f"the simulation has {match.coverage:.3g} of the experiment's length, "
                f"min_coverage is {self._min_coverage:g}"
            )
        return match.value


def _moved_up(curve: Array, y: int) -> Array:
    """Return the curve, moved along a coordinate by its extent there."""
    moved = curve.copy()
    moved[:, y] += np.ptp(moved[:, y]) or 1.0
    return moved
