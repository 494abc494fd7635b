"""A study: an identification that a file describes.

`Study.read` checks the whole file; `check` runs the solver once; `run` searches. Every run of the
solver is stored at once. The same call after an interruption therefore continues from the stored
runs, and ends with bitwise identical results.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

import numpy as np

from ..calibration import (
    Identification,
    Progress,
    SeveralMeasures,
    Uncertainty,
    identify,
    identify_each,
)
from ..drawing.figures import matplotlib_required
from ..fitting import MaterialFit
from .compatibility import check_together
from .contents import Contents
from .dry_run import DryRun, dry_run
from .reading import read_contents
from .result_files import StudyResult, write_results
from .toml_source import Source

__all__ = ["Study"]


class Study(Contents):
    r"""An identification that a file describes.

    Made by :meth:`read`.

    Attributes
    ----------
    path : Path
        The file.
    title : str
        Its title.
    tests : tuple of MeasuredTest
        The measured curves.
    models : mapping of str to SolverModel, or to MaterialModel
        The models of the tests.
    bounds : mapping
        The parameters, as :func:`curvewise.calibration.identify` takes them.
    search : SearchSettings
        The settings of the search.
    results : Path
        The folder for results.

    Examples
    --------
    >>> import sys, tempfile
    >>> from pathlib import Path
    >>> from curvewise.studies import Study
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "test.csv").write_text("x,y\n0,0\n1,2\n2,4\n3,6\n")
    ...     deck = "print('x,y', '0,0', '3,%r' % (3 * <<E>>), sep='\\n', file=open('out.csv', 'w'))"
    ...     _ = Path(folder, "deck.py").write_text(deck)
    ...     file = Path(folder, "study.toml")
    ...     _ = file.write_text(f'''
    ... [[tests]]
    ... file = "test.csv"
    ... output = {{ file = "out.csv" }}
    ... [model]
    ... command = ['{sys.executable}', "deck.py"]
    ... templates = "deck.py"
    ... timeout = 60
    ... [parameters]
    ... E = [0, 10]
    ... [search]
    ... uncertainty = false
    ... ''')
    ...     found = Study.read(file).run(progress=False)
    >>> round(found.identifications["area"].parameters["E"], 3)
    2.0
    """

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Study:
        """Read a study file, the curves of its tests and its templates, and check all of it.

        Parameters
        ----------
        path : path-like
            The file; paths in it are relative to its own folder.

        Returns
        -------
        Study
            Ready to be checked and run.

        Raises
        ------
        StudyError
            Something is wrong; the message names every problem with its line and key.
        OSError
            The file cannot be read.
        ImportError
            With Python 3.10 tomli is missing: ``pip install "curvewise[calibration]"``.

        Notes
        -----
        The time is that of reading the curves. Nothing is run.

        Examples
        --------
        As for the class.
        """
        source = Source(path)
        contents = read_contents(source)
        check_together(contents, source)
        source.raise_problems()
        return cls(**vars(contents))

    def check(self) -> DryRun:
        """Run every model once, at the start of the search, and report the data read.

        Returns
        -------
        DryRun
            The kept decks, the data read from the results, the value of the measure, and the least
            time of the study; prints as a table.

        Raises
        ------
        SolverError
            If a run failed, or its output cannot be read.

        Notes
        -----
        The run is stored: the search does not repeat it.

        Examples
        --------
        >>> from curvewise.studies import Study
        >>> print(Study.read("study.toml").check())  # doctest: +SKIP
        """
        return dry_run(self)

    def run(
        self, *, progress: bool = True, callback: Callable[[Progress], Any] | None = None
    ) -> StudyResult:
        """Run the search, or continue an interrupted one, and write the results.

        Parameters
        ----------
        progress : bool, default True
            Whether to show a bar (tqdm).
        callback : callable, optional
            As for :func:`curvewise.calibration.identify`; not with several measures.

        Returns
        -------
        StudyResult
            The identifications with their uncertainties; the folder `results` has them as files.

        Raises
        ------
        RuntimeError
            If no run of the first batch succeeds; the message has the first reason.
        ImportError
            If scipy, tqdm or matplotlib is missing: ``pip install "curvewise[calibration,plot]"``.
        KeyboardInterrupt
            If Ctrl-C is pressed, after the solvers have been stopped. The store holds the finished
            runs.

        Notes
        -----
        The time is the solver's. A resumed study with the same file, decks and program gives
        bitwise identical results.

        Examples
        --------
        As for the class.
        """
        with matplotlib_required():  # before the work rather than after it
            import_module("matplotlib.figure")
        self.results.mkdir(parents=True, exist_ok=True)
        found = self._searched(progress, callback)
        uncertainties = {}
        samples = self.search.uncertainty
        if samples is not None:
            uncertainties = {n: one.uncertainty(samples=samples) for n, one in found[0].items()}
        results = StudyResult(found[0], uncertainties, found[1], self._fit(found[0], uncertainties))
        write_results(self, results)
        return results

    def stored_runs(self) -> int:
        """Return how many runs of the study's models its store holds."""
        if not self.search.store.exists():
            return 0
        with self.store as store:
            known = [self.identity(model).text for model in self.study_models().values()]
            return sum(1 for identity in known for _ in store.runs(identity))

    def _fit(
        self, found: Mapping[str, Identification], uncertainties: Mapping[str, Uncertainty]
    ) -> MaterialFit | None:
        """Return the fit of a material by one measure, as `fit_material` does."""
        model = self.material
        if model is None or model.driven is None or len(found) > 1:
            return None
        ((measure, one),) = found.items()
        tests = tuple(np.asarray(test.experiment) for test in self.tests)
        fit = MaterialFit(
            model.driven,
            tests,
            one,
            uncertainties.get(measure),
            model.modulus_read,
            model.units,
            beginning=model.beginning,
            cycles=model.cycles,
            prepared=tuple(test.prepared for test in self.tests if test.prepared is not None),
        )
        one.take_down_doubts(fit.doubts)
        return fit

    def _searched(
        self, progress: bool, callback: Callable[[Progress], Any] | None
    ) -> tuple[dict[str, Identification], SeveralMeasures | None]:
        keywords: dict[str, Any] = {
            **self.search.keywords,
            "store": self.store,
            "progress": progress,
            "start": self.search.start or None,
        }
        models = self.study_models()
        if self.has_cases:
            found = identify(self.cases(models), bounds=self.bounds, callback=callback, **keywords)
            return {found.measure: found}, None
        (model,) = models.values()
        tests = [test.experiment for test in self.tests]
        measures = [self.criterion(measure) for measure in self.search.measures]
        if len(measures) > 1:
            several = identify_each(model, tests, self.bounds, measures=measures, **keywords)
            return dict(several), several
        (measure,) = measures
        found = identify(model, tests, self.bounds, measure=measure, callback=callback, **keywords)
        return {found.measure: found}, None
