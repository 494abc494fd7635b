"""The result of a search: parameters, values under every measure, and reports.

Everything here is computed from the simulations that the search has kept; only `uncertainty` may
run the model again, and says beforehand how often.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...comparing.deviations import Deviation, deviation
from ...curves.inputs import Array
from ...drawing.loops import loops_and_convergence
from ...measures.registry import Condition
from ...showing.result import Result, Table
from ..objective.criterion import Part
from ..problem.execution import Execution
from ..problem.problem import Problem
from ..problem.tables import measure_table, parameter_table
from ..records.evaluation import Evaluation
from ..records.recorder import Recorder
from ..records.search_record import Agreement, Doubt, Ending, SearchRecord
from ..report.notes import Note
from ..report.page import write_report
from ..report.shown_search import ShownSearch
from ..report.uncertainty_summary import summary_of
from ..report.verdict import Verdict, verdict_of
from ..uncertainty.determined import determined_by_linear_theory
from ..uncertainty.sensitivity import Optimum, design_runs, optimum_surfaces
from ..uncertainty.uncertainty import Uncertainty, uncertainty_of

if TYPE_CHECKING:
    from ...drawing.picture import Picture

__all__ = ["Identification"]

# Slopes with more numbers than this (16 MB) are not written down.
_MOST_SLOPES = 2_000_000


@dataclass(frozen=True, eq=False)
class Identification(Result):
    """Identified parameters and how they were found.

    Attributes
    ----------
    parameters : dict of str to float
        The best parameters found.
    value : float
        The objective there.
    measures : dict of str to float
        The optimum under every measure that the curves' dimension allows: the identification's
        own with its options, the others with the preset's; nan where a measure refuses.
    simulations : tuple of ndarray
        The simulated curves at the optimum.
    experiments : tuple of ndarray
        The measured curves.
    history : numpy.recarray
        Every evaluation: its number, the parameters, value, failed and seconds.
    failures : tuple of (int, str)
        The number of every evaluation that failed, and the reason.
    converged : bool
        True if the method met its tolerances and no unintended bound stopped it.
    message : str
        How the search ended, as its method says it.
    agreement : Agreement or None
        How many starts agree, of how many, and within which fraction of the value; None for
        methods without starts.
    reason : str
        Why the search has not converged, in plain words; "" where it has.
    method, seed, bounds, measure, preset, part
        The arguments of the call.
    runs : int
        Number of model runs of this search; the others were read from the store.
    problem, execution, runs_with_curves, recorder
        The problem, the runner of the models, the runs with known curves, and the record of the
        search, for later evaluations.
    condition : Condition or None
        Whether the measure is computed on scaled curves, and its options, including the preset's;
        None for "sum_of_squares" and for a function.
    """

    parameters: dict[str, float]
    value: float
    measures: dict[str, float]
    simulations: tuple[Array, ...] = field(repr=False)
    experiments: tuple[Array, ...] = field(repr=False)
    history: np.recarray[Any, Any] = field(repr=False)
    failures: tuple[tuple[int, str], ...] = field(repr=False)
    converged: bool
    message: str
    method: str
    seed: int
    bounds: dict[str, tuple[float, float]]
    measure: str
    preset: str
    runs: int
    problem: Problem = field(repr=False)
    execution: Execution = field(repr=False)
    runs_with_curves: tuple[tuple[Array, Evaluation], ...] = field(repr=False)
    part: Part
    condition: Condition | None = field(repr=False)
    recorder: Recorder = field(repr=False)
    agreement: Agreement | None = field(default=None, repr=False)
    reason: str = field(default="", repr=False)

    @property
    def deviations(self) -> tuple[Deviation | None, ...]:
        """How far each simulation is from its experiment, in units of y, as the measure sees it.

        Computed when asked for. None for curve_length, sum_of_squares and functions, and where a
        simulation has failed. See :class:`curvewise.comparing.deviations.Deviation`.
        """
        if self.condition is None or len(self.simulations) < len(self.experiments):
            return (None,) * len(self.experiments)
        pairs = zip(self.experiments, self.simulations, strict=True)
        return tuple(self._deviation(self.condition, *pair) for pair in pairs)

    def _deviation(self, condition: Condition, P: Array, Q: Array) -> Deviation | None:
        try:
            return deviation(self.measure, condition, P, Q, part=self.part)
        except ValueError:  # the measure refuses the simulation, which the objective calls failed
            return None

    @property
    def evaluations(self) -> int:
        """How many parameter sets were evaluated."""
        return len(self.history)

    picture_shows = "The loops at the optimum, and the convergence"

    @property
    def outside(self) -> int:
        """How many parameter sets were outside of the model's own bounds (OutsideModelError)."""
        return int(self.history.failed.sum()) - len(self.failures)

    def parts(self) -> Sequence[Table | str]:
        """Return the verdict, the parameters, the measures, the deviations, and the runs."""
        deviations = [
            f"curve {k}: {one}" for k, one in enumerate(self.deviations) if one is not None
        ]
        if deviations:
            deviations.insert(0, f"deviation of {self.measure}, in units of y")
        failed = f", {len(self.failures)} failed" if self.failures else ""
        if outside := self.outside:
            failed += f", {outside} outside of the model's own bounds"
        return [
            str(self.verdict),
            parameter_table(self.problem.space, self.parameters),
            measure_table(self.measures, self.measure, self.preset),
            *(["\n".join(deviations)] if deviations else []),
            f"{self.method}, seed {self.seed}: {self.evaluations} evaluations{failed}",
        ]

    @property
    def verdict(self) -> Verdict:
        """What is said first: how far off, which parameters can be used, whether it converged.

        Its ``lines`` are those at the head of the text and of the page. By what :meth:`uncertainty`
        has given last, or else by linear theory where that takes no runs of the model. Cost: a
        warping path for each loop, and that of `uncertainty`.
        """
        record = self.recorder.record()
        if record.ending is None:
            record = replace(record, ending=Ending.from_json(self.ending().to_json()))
        return verdict_of(ShownSearch(record))

    @property
    def uncertainty_runs(self) -> int:
        """Number of model runs for derivatives: 0, or 2 for every parameter.

        `uncertainty` also runs a model with a Jacobian, about ten times for each parameter.
        """
        return design_runs(self.problem, self._unit, self.simulations, self.runs_with_curves)

    @property
    def determined(self) -> dict[str, bool] | None:
        """Whether the tests determine each parameter, as far as can be said without noise.

        A parameter is determined if it is at no bound, and half its interval by linear theory is
        within 25 % of its value and of its bounds' range. None if that would take runs
        (`uncertainty_runs`).
        """
        return None if self.uncertainty_runs else determined_by_linear_theory(self._optimum())

    def uncertainty(
        self,
        *,
        sigma: float | Sequence[float] | None = None,
        level: float = 0.95,
        samples: int = 0,
        seed: int = 0,
    ) -> Uncertainty:
        """Estimate how precisely the tests determine the parameters.

        Parameters
        ----------
        sigma : float or sequence of float, optional
            The standard deviation of the noise in y, of all loops or of each. The noise is then
            white, and x is exact. By default the residuals are taken as the noise, in x and in y,
            with their correlation.
        level : float, default 0.95
            The probability of the intervals.
        samples : int, default 0
            Number of bootstrap samples of the noise, at least 20 and preferably 1000. 0 derives the
            errors from the sensitivities, at once: exact for sums of squares, close for "area" and
            "dtw", and a rough guide for other measures.
        seed : int, default 0
            Seed of the samples.

        Returns
        -------
        Uncertainty
            Errors, intervals, correlations, sensitivities and the undetermined parameters; prints
            as a table, plots itself.

        Raises
        ------
        ValueError
            If the level, sigma or number of samples is out of range. If there are fewer points than
            parameters.

        Notes
        -----
        Runs of the model: `uncertainty_runs`, which is 0 after "trust-region" and "sdrm". Time:
        about 30 evaluations of the measure for each parameter, and for each sample. Sensitivities
        assume linear curves. For a model with a ``jacobian``, each interval end is therefore
        computed on the nonlinear model, in about 3 to 6 runs and at most 15. The end is where its
        curves have moved as far as at the end of the linear interval. An interval then need not be
        symmetric, and is never narrower than the linear one. Correlated residuals indicate model
        error. Intervals are then those of a bootstrap-t by circular shifts of the residuals, on the
        linearised model. For a model without a ``jacobian``, intervals that are a large part of the
        bounds only mean "not determined". Sources: see the modules of
        ``curvewise.calibration.uncertainty``.

        Examples
        --------
        >>> import numpy as np
        >>> from curvewise.calibration import identify
        >>> x = np.linspace(0, 1, 50)
        >>> def line(p):
        ...     return np.column_stack((x, p["slope"] * x + p["intercept"]))
        >>> test = line({"slope": 2.0, "intercept": 1.0})
        >>> test[:, 1] += np.random.default_rng(1).normal(0.0, 0.1, 50)
        >>> found = identify(
        ...     line,
        ...     test,
        ...     {"slope": (0, 10), "intercept": (-5, 5)},
        ...     measure="sum_of_squares",
        ...     method="trust-region",
        ...     progress=False,
        ... )
        >>> errors = found.uncertainty().standard_errors
        >>> {name: round(error, 3) for name, error in errors.items()}
        {'slope': 0.043, 'intercept': 0.025}
        """
        runs = self.uncertainty_runs
        computed = uncertainty_of(
            self._optimum(), sigma=sigma, level=level, samples=samples, seed=seed, runs=runs
        )
        # What cannot be written now, report() says: it writes it once more.
        with suppress(OSError, ValueError):
            self._take_down(computed)
        return computed

    def report(
        self,
        path: str | os.PathLike[str],
        *,
        uncertainty: Uncertainty | None = None,
        notes: Sequence[Note] = (),
    ) -> None:
        """Write a report of the identification as one HTML page.

        The page opens without a network. It has a verdict in words, tests and simulations to zoom
        into, residuals by branch, convergence, parameters with intervals and correlations, the
        weakest directions, failures, versions, and the settings to repeat the search. ``curvewise
        report store.db`` writes a bitwise identical file from the store.

        Parameters
        ----------
        path : path-like
            The file; an existing file is replaced.
        uncertainty : Uncertainty, optional
            The uncertainty to show. The default is the last result of :meth:`uncertainty`. If that
            has not been called, it is called, unless derivatives need runs of the model
            (`uncertainty_runs`): then the page omits intervals.
        notes : sequence of Note
            Sections on the preparation of the tests.

        Raises
        ------
        ImportError
            If plotly is missing: ``pip install "curvewise[report]"``.
        ValueError
            As for :meth:`uncertainty`.
        OSError
            If the file cannot be written.

        Notes
        -----
        About 2 MB, mostly plotly.js, and at most 5 MB: every k-th point of many or long curves is
        drawn. Time: that of `uncertainty`, and of a warping path for every loop.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import numpy as np
        >>> from curvewise.calibration import identify
        >>> x = np.linspace(0, 1, 20)
        >>> def line(p):
        ...     return np.column_stack((x, p["slope"] * x))
        >>> found = identify(line, line({"slope": 2.0}), {"slope": (0, 10)}, progress=False)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     found.report(Path(folder, "report.html"))
        ...     Path(folder, "report.html").stat().st_size < 5e6
        True
        """
        write_report(path, [self.record(uncertainty)], notes)

    def record(self, uncertainty: Uncertainty | None = None) -> SearchRecord:
        """Record the uncertainty as far as it is known, and return the search's record.

        Parameters
        ----------
        uncertainty : Uncertainty, optional
            As for :meth:`report`.

        Raises
        ------
        OSError, ValueError
            If the store of the search cannot be written.
        """
        ending = self.recorder.ending
        is_known = ending is not None and ending.uncertainty is not None
        if uncertainty is None and not is_known and self._has_surfaces:
            uncertainty = self.uncertainty()
        self._take_down(uncertainty)
        return self.recorder.record()

    def take_down_doubts(self, doubts: Sequence[Doubt]) -> None:
        """Write down which parameters are not to be used, for the verdict.

        Parameters
        ----------
        doubts : sequence of Doubt
            Those of whoever knows the model and the tests; they replace earlier ones.

        Raises
        ------
        OSError, ValueError
            If the store of the search cannot be written.
        """
        self.recorder.end(replace(self.recorder.ending or self.ending(), doubts=tuple(doubts)))

    def _take_down(self, uncertainty: Uncertainty | None) -> None:
        """Record how the search ended, with the known uncertainty."""
        ending = self.recorder.ending or self.ending()
        if uncertainty is not None:
            ending = replace(ending, uncertainty=summary_of(uncertainty))
        self.recorder.end(ending)

    def ending(self) -> Ending:
        """Return the ending to record, without the uncertainty."""
        unit = slopes = None
        if self._has_surfaces:
            optimum = self._optimum()
            if optimum.surfaces.slopes.size <= _MOST_SLOPES:
                unit, slopes = self._unit, optimum.surfaces.slopes
        return Ending(
            converged=bool(self.converged),
            message=self.message,
            parameters=dict(self.parameters),
            value=float(self.value),
            measures={name: float(value) for name, value in self.measures.items()},
            deviations=[one and list(one) for one in self.deviations],
            simulations=self.simulations,
            unit=unit,
            slopes=slopes,
            agreement=self.agreement,
            reason=self.reason,
        )

    @property
    def _has_surfaces(self) -> bool:
        """Whether the curves around the optimum are known without runs of the model."""
        return len(self.simulations) == len(self.experiments) and not self.uncertainty_runs

    @property
    def _unit(self) -> Array:
        return self.problem.space.unit_of(self.parameters)

    def _optimum(self) -> Optimum:
        return optimum_surfaces(
            self.problem, self.execution, self._unit, self.simulations, self.runs_with_curves
        )

    def plot(self, *, names: Sequence[str] | None = None) -> Picture:
        """Return a matplotlib Figure of the loops and of the convergence.

        Parameters
        ----------
        names : sequence of str, optional
            What the coordinates are called on the axes; by default what the experiments' columns
            were called, else x and y.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        ValueError
            Another number of names than of coordinates.
        """
        return loops_and_convergence(
            self.experiments,
            self.simulations,
            self.history,
            f"{self.measure} ({self.preset})",
            self.problem.objective.axes(names),
            self.problem.objective.titles,
        )
