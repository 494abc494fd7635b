"""The objective: a weighted sum of terms, one for each experiment.

The experiments are checked and scaled once, when an objective is created; invalid experiments raise
an error then. A failed simulation does not raise an error later: an optimiser also tries parameters
at which the model fails. A failed simulation therefore has a finite, large value. A simulation of
the wrong shape is an error, because the model is connected wrongly whatever its parameters. Cost:
that of the measure, for every term.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.named_curve import known_file
from ...curves.several_curves import as_points, curve_list, digest
from ...curves.thinning import thinned_rows
from ...measures.registry import Condition, default_measures
from .criterion import LEAST_SQUARES, Criterion, Measure, Part, criterion_of
from .terms import CurveTerm, FailedSimulationError, Label, Term

__all__ = ["Objective", "Score", "objectives_of"]

# A fraction of the value of simulations that are wrong by their loops' heights. The smallest value
# of an objective is 0, for a perfect model, so no tolerance relative to it alone is ever met.
_NEGLIGIBLE = 1e-7


class Score(NamedTuple):
    """The value of one set of simulations, with failures.

    Attributes
    ----------
    value : float
        The weighted sum of the terms.
    terms : ndarray, shape (experiments,)
        The value of the measure, or the penalty, for every experiment.
    failures : tuple of str
        For every failed simulation a line with the reason.
    """

    value: float
    terms: Array
    failures: tuple[str, ...]


class Objective:
    """A weighted sum of terms, one for each experiment, for minimisation.

    Parameters
    ----------
    experiments : array_like, shape (n, d), or sequence of such
        One measured curve or several. A list whose items are points or numbers is one curve;
        several series are arrays of shape (n, 1).
    measure : str, callable or Criterion, default "area"
        The comparison of each experiment with its simulation: see :class:`Criterion`.
    **options
        Options of the measure, if `measure` is not a criterion.

    Attributes
    ----------
    experiments : tuple of ndarray
        The experiments as float64 arrays of shape (n, d); a number has the shape (1, 1).
    criterion : Criterion or None
        The criterion of all terms; None if each has its own, as cases have.
    measure, preset : str
        Their names; for cases the names of all, joined by " + ".
    measures : list of str or callable
        The measure of every term.
    weights, failure_value, scales : ndarray, shape (experiments,)
        The factors; the values of failed simulations; the values, by measure, of simulations that
        deviate by their experiment's range of y.
    failures : int
        Number of failed simulations so far, counted by experiment.
    titles, names, sigmas, extents, y_columns : list
        An item for every experiment. `titles` has its file, number or case name, `names` the names
        of its columns (if known), and `sigmas` the noise (if given). `extents` has the extent in
        each coordinate (for a number, the number itself), `y_columns` the column with noise.
    residual_counts, residual_factors : list of int, ndarray
        For every experiment: the number of residuals, and the factor that turns a difference in y
        into a residual of "sum_of_squares".
    is_least_squares : bool
        Whether the value is a weighted sum of squares of `residuals`.
    is_area_of_pieces : bool
        Whether the value adds up absolute areas of sections: "area" with ``spacing="matched"``.
    is_sum_of_distances : bool
        Whether the value adds up distances of points: "dtw" without options.
    is_largest_distance : bool
        Whether the value is a discrete Fréchet distance, or a mean of several.
    has_function : bool
        Whether a measure is a user-defined function, which cannot be recorded.
    has_gradient : bool
        Whether a gradient exists that is useful for minimisation.
    can_be_thinned : bool
        Whether some of the points of tests and simulations suffice for an estimate. False if y is
        compared at each point of the test, which costs little anyway.

    Raises
    ------
    ValueError
        If the measure rejects an experiment, or the number of weights is wrong; as for
        :class:`Criterion`.
    TypeError
        If an experiment does not hold real numbers, or the measure does not have an option.

    Notes
    -----
    A call takes the time and memory of the measure for every experiment. The paper's section 3
    sums over loops with equal weights.

    Examples
    --------
    >>> from curvewise.calibration import Criterion, Objective
    >>> objective = Objective([(0, 0), (1, 2), (2, 0)], Criterion("area", preset="raw"))
    >>> objective([(0, 1), (1, 3), (2, 1)])
    2.0
    >>> objective(None), objective.failures  # a simulation that failed
    (4000000.0, 1)
    """

    def __init__(self, experiments: Any, measure: Measure = "area", **options: Any) -> None:
        criterion = criterion_of(measure, options)
        curves = curve_list(experiments)
        count = len(curves)
        weights = criterion.weights or (1.0,) * count
        if len(weights) != count:
            raise ValueError(
                f"weights has shape ({len(weights)},); give one for each of {count} loops"
            )
        files = [known_file(curve) for curve in curves]
        titles = [f if f and files.count(f) == 1 else f"Loop {i}" for i, f in enumerate(files)]
        labels = [Label(titles[0], "P", "")]
        if count > 1:
            labels = [
                Label(title, f"experiments[{i}]", f"loop {i}: ") for i, title in enumerate(titles)
            ]
        self._sum_up(
            [
                CurveTerm(curve, criterion, label, weight)
                for curve, label, weight in zip(curves, labels, weights, strict=True)
            ],
            criterion,
        )

    @classmethod
    def of_terms(cls, terms: Sequence[Term], criterion: Criterion | None = None) -> Objective:
        """Return the sum of terms; with their criterion, where they have the same."""
        objective = cls.__new__(cls)
        objective._sum_up(terms, criterion)
        return objective

    def _sum_up(self, terms: Sequence[Term], criterion: Criterion | None) -> None:
        self._terms, self.criterion = tuple(terms), criterion
        self.failures = 0
        self.experiments = tuple(term.experiment for term in terms)
        self.weights = np.array([term.weight for term in terms])
        self.scales = np.array([term.scale for term in terms])
        self.failure_value = np.array([term.failure_value for term in terms])
        self.measures = [term.criterion.measure for term in terms]
        self.measure = " + ".join(dict.fromkeys(term.criterion.name for term in terms))
        self.preset = " + ".join(dict.fromkeys(term.criterion.preset for term in terms))
        self.titles = [term.label.title for term in terms]
        self.names = [term.names for term in terms]
        self.extents = [term.extent for term in terms]
        self.y_columns = [term.y for term in terms]
        self.sigmas = [term.sigma for term in terms]
        self.residual_counts = [term.residual_count for term in terms]
        heights = np.array([term.height for term in terms])
        self.residual_factors: Array = np.sqrt(self.weights) / heights
        self.is_least_squares = all(term.is_least_squares for term in terms)
        self.is_area_of_pieces = all(term.is_area_of_pieces for term in terms)
        self.is_sum_of_distances = all(term.is_sum_of_distances for term in terms)
        self.is_largest_distance = (
            self.condition is not None and self.measure == "frechet" and not self.condition.options
        )
        self.has_function = any(callable(term.criterion.measure) for term in terms)
        self.has_gradient = all(term.has_gradient for term in terms)
        self.can_be_thinned = all(term.can_be_thinned for term in terms)

    def __call__(self, simulations: Any) -> float:
        """Return the weighted sum of the terms.

        Parameters
        ----------
        simulations : array_like, or sequence of array_like
            A curve for every experiment, in the same order. None or an exception replaces a failed
            one, or all of them.
        """
        return self.score(simulations).value

    def terms(self, simulations: Any) -> Array:
        """Return the value of the measure for every experiment, without the weights."""
        return self.score(simulations).terms

    def score(self, simulations: Any) -> Score:
        """Return value and terms, and why simulations failed; count those in `failures`.

        Raises
        ------
        ValueError
            If the number of simulations, their dimension, or the names of their columns differ from
            those of the experiments.
        TypeError
            If a simulation does not hold real numbers.
        """
        score = self.predicted(simulations)
        self.failures += len(score.failures)
        return score

    def predicted(self, simulations: Any) -> Score:
        """Return what `score` returns, but count nothing: for curves no model has computed."""
        terms = np.empty(len(self._terms))
        failures = []
        for i, simulation in enumerate(self._matched(simulations)):
            try:
                terms[i] = self._terms[i].value(simulation)
            except FailedSimulationError as error:
                terms[i] = self.failure_value[i]
                failures.append(f"{self._terms[i].label.prefix}{error}")
        return Score(float(self.weights @ terms), terms, tuple(failures))

    def value_and_gradient(self, simulations: Any) -> tuple[float, list[Array]]:
        """Return the value of `predicted`, and its derivative by every coordinate.

        The derivative is that of the measure with its path held; 0 for simulations that fail.

        Parameters
        ----------
        simulations
            As for a call.

        Returns
        -------
        value : float
        gradients : list of ndarray
            The gradient of each simulation, in its shape.
        """
        total = 0.0
        gradients = []
        for i, simulation in enumerate(self._matched(simulations)):
            try:
                value, gradient = self._terms[i].value_and_gradient(simulation)
            except FailedSimulationError:
                value, gradient = self.failure_value[i], np.zeros(np.shape(simulation))
            total += float(self.weights[i] * value)
            gradients.append(self.weights[i] * gradient)
        return total, gradients

    def thinned(self, most: int) -> Objective | None:
        """Return the objective with about `most` points per test, or None.

        Return None if no test has more points. The terms are weighted so that a simulation that
        deviates by a loop's range of y costs the same.
        """
        rows = [thinned_rows(curve, most) for curve in self.experiments]
        pairs = list(zip(self._terms, rows, strict=True))
        if all(len(kept) == len(term.experiment) for term, kept in pairs):
            return None
        return self.of_terms([term.thinned(kept) for term, kept in pairs], self.criterion)

    def residuals(self, simulations: Any) -> Array:
        """Return what `scipy.optimize.least_squares` squares and adds up.

        That is the differences whose squares make up the terms, one term after the other, each
        times the square root of the term's weight. Those of a failed simulation are equal and add
        up to its failure value (squared for curve_length, whose value is the root of a sum).

        Parameters
        ----------
        simulations
            As for a call.

        Raises
        ------
        ValueError
            If the measure is not "curve_length" or "sum_of_squares"; as for `score`.
        """
        if any(measure not in LEAST_SQUARES for measure in self.measures):
            raise ValueError(
                f"measure {self.measure!r} is not a sum of squares; "
                f"least squares needs {' or '.join(map(repr, LEAST_SQUARES))}"
            )
        pairs = zip(self._terms, self._matched(simulations), strict=True)
        return np.concatenate(
            [math.sqrt(term.weight) * term.residuals_or_penalty(Q) for term, Q in pairs]
        )

    def residual_slopes(self, simulations: Any, directions: Sequence[Array]) -> Array:
        """Return the derivatives of `residuals`, shape (m, k), as simulations move.

        Parameters
        ----------
        simulations
            As for a call; all must have succeeded.
        directions : sequence of ndarray, shape (n, d, k)
            The direction in which each simulation moves.
        """
        parts = zip(self._terms, self._matched(simulations), directions, strict=True)
        return np.concatenate(
            [math.sqrt(term.weight) * term.residual_slopes(Q, along) for term, Q, along in parts]
        )

    @property
    def negligible(self) -> float:
        """Differences of the value below this do not count."""
        return _NEGLIGIBLE * float(self.weights @ self.scales)

    def fitted(self, simulations: Any) -> list[Array | None]:
        """Return each experiment with the simulated y; None if y is not compared at a common x."""
        pairs = zip(self._terms, self._matched(simulations), strict=True)
        return [term.fitted(one) if term.is_least_squares else None for term, one in pairs]

    def of_other_tests(self, experiments: Sequence[Array]) -> Objective:
        """Return the same objective of other experiments, one for each."""
        pairs = zip(self._terms, experiments, strict=True)
        return self.of_terms([term.of(other) for term, other in pairs], self.criterion)

    def by_measure(self, simulations: Any) -> dict[str, float]:
        """Return the value of simulations under every measure that the curves' dimension allows.

        This objective's own measure keeps its options; the others use the preset's. A value is nan
        if the measure rejects the simulation. If each term has its own criterion, the result has
        the weighted terms by name, with nan for failed ones.
        """
        own = self.predicted(simulations)
        if self.criterion is None:
            failed = own.terms >= self.failure_value
            values = np.where(failed, np.nan, self.weights * own.terms)
            return dict(zip(self.titles, values.tolist(), strict=True))
        by_name = {}
        for name in default_measures(self.experiments[0]):
            by_name[name] = own.value if name == self.measure else self._under(name, simulations)
        return {**by_name, self.measure: own.value}

    def _under(self, measure: str, simulations: Any) -> float:
        """Return the value under another measure; nan where it refuses."""
        criterion = self.criterion
        assert criterion is not None, "by_measure asks it of terms with the same"
        try:
            other = Criterion(
                measure,
                preset=criterion.preset,
                part=criterion.part if measure == "pcm" else "experiment",
                min_coverage=criterion.min_coverage,
                weights=criterion.weights,
            )
            score = Objective(list(self.experiments), other).predicted(simulations)
        except ValueError:  # e.g. curve_length, raw, of a loop centred on zero
            return math.nan
        return math.nan if score.failures else score.value

    @property
    def part(self) -> Part:
        """Which curve may be a piece of the other; "experiment" where each term has its own."""
        return "experiment" if self.criterion is None else self.criterion.part

    @property
    def condition(self) -> Condition | None:
        """Whether the measure is computed on scaled curves, and its options with the preset's.

        None for "sum_of_squares", for a function, and if each term has its own criterion.
        """
        if self.criterion is None or not self.criterion.is_of_the_registry:
            return None
        return self.criterion.condition

    @property
    def settings(self) -> dict[str, Any]:
        """The settings for a record, as JSON values; functions by their names."""
        shared = self.criterion
        return {
            "measure": self.measure,
            "preset": self.preset,
            "criterion": None if shared is None else shared.settings,
            "cases": [term.settings for term in self._terms] if shared is None else None,
            "weights": self.weights.tolist(),
            "experiments": digest(self.experiments),
        }

    def axes(self, names: Sequence[str] | None = None) -> list[tuple[str, ...]]:
        """Return for each experiment what its coordinates are called, as given or as columns."""
        return [term.axes(names) for term in self._terms]

    def _matched(self, simulations: Any) -> list[Any]:
        """Return one simulation for every experiment."""
        count = len(self._terms)
        if simulations is None or isinstance(simulations, BaseException):
            return [simulations] * count
        curves = curve_list(simulations)
        if len(curves) != count:
            raise ValueError(
                f"there are {len(curves)} simulations and {count} experiments; "
                "the model must return a curve for every experiment"
            )
        return curves


def objectives_of(experiments: Any, measures: Sequence[Measure] | None) -> dict[str, Objective]:
    """Return an objective for each of several measures, by its name.

    Parameters
    ----------
    experiments
        As for `Objective`.
    measures
        Names, functions or criteria; by default every measure that the curves' dimension allows.
    """
    if measures is None:
        measures = list(default_measures(as_points(curve_list(experiments)[0], "P")))
    criteria = [criterion_of(measure, {}) for measure in measures]
    names = [criterion.name for criterion in criteria]
    if not names or len(set(names)) != len(names):
        raise ValueError(f"measures is {list(measures)}; give at least one, and none twice")
    return {c.name: Objective(experiments, c) for c in criteria}
