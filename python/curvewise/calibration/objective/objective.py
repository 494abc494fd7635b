"""From simulations to one number: the weighted sum of a measure over several loops.

The experiments are checked and scaled once, when an objective is made; what is wrong with them is
an error then. What is wrong with a simulation later is no error: an optimiser tries parameters at
which the model fails, and has to be told that they are bad, so a failed simulation has a finite,
large value. A simulation of the wrong shape is an error: the model is hooked up wrongly, which no
parameters will cure. Cost: that of the measure, for every loop.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..._docstrings import filled, listed
from ..._names import meant
from ..._options import Preset
from ...curves.inputs import Array
from ...curves.several_curves import curve_list
from ...curves.thinning import thinned_rows
from ...measures import registry
from ...measures.registry import PRESETS, default_measures
from .loop import FailedSimulationError, Loop
from .loop_measure import (
    Measure,
    Part,
    check_part,
    condition_of,
    measure_name,
    unknown_options_explained,
)
from .loops import Loops

__all__ = ["LEAST_SQUARES", "MEASURES", "Objective", "Score"]

MEASURES = (*registry.MEASURES, "sum_of_squares")
# Those that are made of differences whose squares are added up.
LEAST_SQUARES = (
    *(name for name, info in registry.MEASURES.items() if info.residuals),
    "sum_of_squares",
)

# A fraction of the value of simulations that are wrong by their loops' heights. The smallest value
# of an objective is 0, for a perfect model, so no tolerance relative to it alone is ever met.
_NEGLIGIBLE = 1e-7

# A failed loop has this many times the value of a simulation that is wrong by the loop's height.
_FAILURE = 1e6


class Score(NamedTuple):
    """What an objective makes of one set of simulations.

    Attributes
    ----------
    value : float
        The weighted sum of the terms.
    terms : ndarray, shape (loops,)
        The value of the measure, or the penalty, for every loop.
    failures : tuple of str
        For every failed loop a line that says why.
    """

    value: float
    terms: Array
    failures: tuple[str, ...]


@filled(measures=listed(MEASURES))
class Objective(Loops):
    """The weighted sum of a measure over one or several loops; what an optimiser minimises.

    Parameters
    ----------
    experiments : array_like, shape (n, d), or sequence of such
        One measured curve or several. A list whose items are points or numbers is one curve;
        several series are arrays of shape (n, 1).
    measure : {measures} or callable
        A measure by its name, or a function of the experiment, the simulation and the options
        that returns a float; where it raises ValueError the simulation has failed.
        "sum_of_squares" sums squared differences of y, the simulation interpolated linearly at
        the experiment's x, which must not turn back. Of loops that have a third column, such as
        time or the step, ``over=2`` compares y at the same time instead; of a model that is driven
        by the experiment's own x, as a material point by the measured strains,
        ``over="points"`` compares y point by point.
    preset : {"scaled", "paper", "raw"}
        As for :func:`curvewise.compare`. "scaled" scales curves by their experiment's box, so
        that loops, and x and y, count alike, and takes area with ``spacing="matched"``, which
        hardly depends on the simulation's increments; "paper" has Algorithm 1. sum_of_squares and
        functions are given the curves as they are in the other two.
    weights : sequence of float, optional
        A factor for every loop, not negative; 1 if not given.
    failure_value : float, optional
        The term of a loop whose simulation failed, finite and positive. By default 10⁶ times
        what the measure gives for a simulation that is its experiment moved up by its own
        height, which fits every measure and unit.
    min_coverage : float, default 0.5
        For "pcm": a simulation shorter than this fraction of its experiment's length (both
        scaled) counts as failed, since partial curve mapping scores a piece of the curve well.
        An experiment that is a piece of its simulation is what it is made for, and passes.
    part : {"experiment", "simulation"}
        Which curve may be a piece of the other, with "pcm" and with "dtw" that has an open end.
        "experiment": a test that starts late or stops early, against the whole simulation.
        "simulation": a model of the first branch alone, against the whole loop; dtw is then that
        of the simulation to the experiment, and "pcm" has no `min_coverage`.
    **options
        Options of the measure, which override the preset's.

    Attributes
    ----------
    experiments : tuple of ndarray
        As given, in float64 and of shape (n, d).
    measure : str
        The measure's name; of a callable its ``__name__``, or its type's.
    condition : Condition or None
        Whether it is computed on scaled curves, and its options, the preset's included; None for
        "sum_of_squares" and for a function.
    weights, failure_value, scales : ndarray, shape (loops,)
        The factors; the terms of failed loops; the values, by measure, of simulations that are
        wrong by the loop's height.
    failures : int
        How many simulations have failed so far, counted by loop.

    Raises
    ------
    ValueError
        An unknown measure, preset, part or option; an experiment that the measure refuses; a
        wrong number of weights; a part for a measure of whole curves.
    TypeError
        An experiment does not hold real numbers; an option that the measure does not have.

    Notes
    -----
    A call takes the time and memory of the measure for every loop. The paper's section 3 sums
    over loops with equal weights.

    Examples
    --------
    >>> from curvewise.calibration import Objective
    >>> objective = Objective([(0, 0), (1, 2), (2, 0)], "area", preset="raw")
    >>> objective([(0, 1), (1, 3), (2, 1)])
    2.0
    >>> objective(None), objective.failures  # a simulation that failed
    (4000000.0, 1)
    """

    def __init__(
        self,
        experiments: Any,
        measure: Measure = "area",
        *,
        preset: Preset = "scaled",
        weights: Sequence[float] | None = None,
        failure_value: float | None = None,
        min_coverage: float = 0.5,
        part: Part = "experiment",
        **options: Any,
    ) -> None:
        if not callable(measure) and measure not in MEASURES:
            raise ValueError(
                f"unknown measure {measure!r}; choose from {', '.join(MEASURES)}"
                f"{meant([measure], MEASURES)}"
            )
        if preset not in PRESETS:
            raise ValueError(
                f"unknown preset {preset!r}; choose from {', '.join(PRESETS)}"
                f"{meant([preset], PRESETS)}"
            )
        if not 0.0 <= min_coverage <= 1.0:
            raise ValueError(f"min_coverage is {min_coverage}; it must be from 0 to 1")
        self.measure = measure_name(measure)
        self._measure = measure
        self._has_residuals = measure in LEAST_SQUARES
        self.preset = preset
        self.options = dict(options)
        self.min_coverage = min_coverage
        self.part = part
        self.failures = 0
        condition = condition_of(preset, measure)
        options = {**condition.options, **options}
        has_condition = not callable(measure) and measure in PRESETS[preset]
        self.condition = condition._replace(options=options) if has_condition else None
        check_part(part, measure, options)
        curves = curve_list(experiments)
        names = ["P"] if len(curves) == 1 else [f"experiments[{i}]" for i in range(len(curves))]
        with unknown_options_explained(measure, self.options):
            self._loops = [
                Loop(curve, name, measure, condition.scaled, options, part, min_coverage)
                for curve, name in zip(curves, names, strict=True)
            ]
        self.experiments = tuple(loop.experiment for loop in self._loops)
        self.weights = _checked_weights(weights, len(self._loops))
        self.scales = np.array([loop.scale for loop in self._loops])
        self.failure_value = _checked_failure_value(failure_value, self.scales)

    def __call__(self, simulations: Any) -> float:
        """Return the weighted sum of the terms.

        Parameters
        ----------
        simulations : array_like, or sequence of array_like
            A curve for every experiment, in the same order; None or an exception in the place
            of one that failed, or of all of them.
        """
        return self.score(simulations).value

    def terms(self, simulations: Any) -> Array:
        """Return the value of the measure for every loop, without the weights."""
        return self.score(simulations).terms

    def score(self, simulations: Any) -> Score:
        """Return value and terms, and why simulations failed; count those in `failures`.

        Raises
        ------
        ValueError
            The number of simulations, their dimension, or the names of their columns are not those
            of the experiments.
        TypeError
            A simulation does not hold real numbers.
        """
        score = self.predicted(simulations)
        self.failures += len(score.failures)
        return score

    def predicted(self, simulations: Any) -> Score:
        """Return what `score` returns, but count nothing: for curves no model has computed."""
        terms = np.empty(len(self._loops))
        failures = []
        for i, simulation in enumerate(self._matched(simulations)):
            try:
                terms[i] = self._loops[i].value(simulation)
            except FailedSimulationError as error:
                terms[i] = self.failure_value[i]
                failures.append(self._located(str(error), i))
        return Score(float(self.weights @ terms), terms, tuple(failures))

    def value_and_gradient(self, simulations: Any) -> tuple[float, list[Array]]:
        """Return what `predicted` returns as value, and its derivative by every coordinate.

        The derivative is that of the measure with its path held; 0 for loops that fail.

        Parameters
        ----------
        simulations
            As for a call.

        Returns
        -------
        value : float
        gradients : list of ndarray
            Of each simulation's shape.
        """
        total = 0.0
        gradients = []
        for i, simulation in enumerate(self._matched(simulations)):
            try:
                value, gradient = self._loops[i].value_and_gradient(simulation)
            except FailedSimulationError:
                value, gradient = self.failure_value[i], np.zeros(np.shape(simulation))
            total += float(self.weights[i] * value)
            gradients.append(self.weights[i] * gradient)
        return total, gradients

    def thinned(self, most: int) -> Objective | None:
        """Return the objective of about so many points a test at most; None if all have no more.

        Its terms are weighted so that a simulation that is wrong by a loop's height costs the same.
        """
        rows = [thinned_rows(curve, most) for curve in self.experiments]
        pairs = list(zip(self.experiments, rows, strict=True))
        if all(len(kept) == len(curve) for curve, kept in pairs):
            return None
        thinned = self.of_other_tests([curve[kept] for curve, kept in pairs])
        thinned.weights = self.weights * self.scales / thinned.scales
        thinned.failure_value = self.failure_value * thinned.scales / self.scales
        return thinned

    def residuals(self, simulations: Any) -> Array:
        """Return what `scipy.optimize.least_squares` squares and adds up.

        That is the differences whose squares make up the terms, loop after loop, each times the
        square root of the loop's weight. Those of a failed loop are equal and add up to its
        failure value (squared for curve_length, whose value is the root of a sum).

        Parameters
        ----------
        simulations
            As for a call.

        Raises
        ------
        ValueError
            The measure is not "curve_length" or "sum_of_squares"; as for `score`.
        """
        if not self._has_residuals:
            raise ValueError(
                f"measure {self.measure!r} is not a sum of squares; "
                f"least squares needs {' or '.join(map(repr, LEAST_SQUARES))}"
            )
        parts = []
        for i, simulation in enumerate(self._matched(simulations)):
            loop = self._loops[i]
            try:
                part = loop.residuals(simulation)
            except FailedSimulationError:
                total = self.failure_value[i]
                total = total if self.measure == "sum_of_squares" else total**2
                part = np.full(loop.residual_count, math.sqrt(total / loop.residual_count))
            parts.append(math.sqrt(self.weights[i]) * part)
        return np.concatenate(parts)

    @property
    def negligible(self) -> float:
        """Differences of the value below this do not count."""
        return _NEGLIGIBLE * float(self.weights @ self.scales)

    @property
    def is_least_squares(self) -> bool:
        """Whether the value is a weighted sum of squares of `residuals`."""
        return self.measure == "sum_of_squares" and self._has_residuals

    @property
    def has_function(self) -> bool:
        """Whether the measure is a function of the user's."""
        return callable(self._measure)

    def fitted(self, simulations: Any) -> list[Array] | None:
        """Return the experiments with the simulated y, where y is compared at a common x."""
        if self.measure != "sum_of_squares" or not self._has_residuals:
            return None
        fitted = []
        for loop, simulation in zip(self._loops, self._matched(simulations), strict=True):
            points = loop.experiment.copy()
            points[:, loop.y] += loop.height * loop.residuals(simulation)
            fitted.append(points)
        return fitted

    def of_other_tests(self, experiments: Sequence[Array]) -> Objective:
        """Return the same objective of other experiments, one for each."""
        return self._like(experiments, self._measure, self.part, self.options)

    def by_measure(self, simulations: Any) -> dict[str, float]:
        """Return the value of simulations under every measure that the curves' dimension allows.

        This objective's own measure with its options, the others with the preset's; nan where one
        refuses.
        """
        values = {}
        for name in default_measures(self.experiments[0]):
            if name == self.measure:
                values[name] = self.predicted(simulations).value
                continue
            part = self.part if name == "pcm" else "experiment"
            try:
                score = self._like(self.experiments, name, part, {}).predicted(simulations)
            except ValueError:  # e.g. curve_length, raw, of a loop centred on zero
                values[name] = math.nan
                continue
            values[name] = math.nan if score.failures else score.value
        if self.measure not in values:
            values[self.measure] = self.predicted(simulations).value
        return values

    def _like(
        self,
        experiments: Sequence[Array],
        measure: Measure,
        part: Part,
        options: Mapping[str, Any],
    ) -> Objective:
        """Return an objective of the same preset and weights."""
        return Objective(
            list(experiments),
            measure,
            preset=self.preset,
            weights=self.weights.tolist(),
            min_coverage=self.min_coverage,
            part=part,
            **options,
        )


def _checked_weights(weights: Sequence[float] | None, count: int) -> Array:
    if weights is None:
        return np.ones(count)
    array = np.asarray(weights, dtype=np.float64)
    if array.shape != (count,):
        raise ValueError(f"weights has shape {array.shape}; give one for each of {count} loops")
    if not (np.isfinite(array).all() and (array >= 0).all() and array.any()):
        raise ValueError("weights must be finite, not negative, and not all 0")
    return array


def _checked_failure_value(failure_value: float | None, scales: Array) -> Array:
    if failure_value is None:
        return _FAILURE * scales
    if not 0.0 < failure_value < math.inf:
        raise ValueError(f"failure_value is {failure_value}; it must be finite and above 0")
    return np.full(len(scales), float(failure_value))
