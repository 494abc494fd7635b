"""``curvewise identify study.toml``: check, run and resume a study.

The imports of this module are light; scipy is imported when a study runs. If standard error is not
a terminal, as in a batch job, the bar is replaced by a line for every batch of runs.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import warnings
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

from .shown import failures_unlogged

if TYPE_CHECKING:
    from ..calibration import Progress
    from ..studies import Study

__all__ = ["add_identify"]


def add_identify(commands: Any) -> None:
    """Add the command to a parser's commands."""
    command = commands.add_parser(
        "identify",
        help="identify the parameters of a solver's model, from a study file (TOML)",
        description="Find the parameters with which a solver's curves are most like the measured "
        "ones, as a study file says (docs/reference/study_file.md has its keys). Ctrl-C ends it; "
        "the same command again goes on where it was.",
    )
    command.set_defaults(run=_identify)
    command.add_argument("study", metavar="STUDY.toml", help="the study file")
    command.add_argument(
        "--check",
        action="store_true",
        help="check the file, run the solver once, and say what was read and how long it will take",
    )


def _identify(arguments: argparse.Namespace) -> int:
    from ..calibration import SolverError
    from ..studies import Study, StudyError

    try:
        study = Study.read(arguments.study)
        if arguments.check:
            print(study.check())
            return 0
        return _run(study)
    except StudyError as error:
        for problem in error.problems:
            print("curvewise:", problem, file=sys.stderr)
        return 1
    except (SolverError, RuntimeError) as error:
        print("curvewise:", error, file=sys.stderr)
        return 1


def _run(study: Study) -> int:
    title = f"{study.title}: " if study.title else ""
    known = study.stored_runs()
    held = f"; {study.search.store.name} holds {_runs(known)}, looked up" if known else ""
    print(
        f"{title}{len(study.tests)} test{'s' if len(study.tests) > 1 else ''}, "
        f"{len(study.bounds)} parameters, {' and '.join(study.search.measures)}{held}",
        flush=True,
    )
    if len(study.tests) > 1:
        print(", ".join(f"curve {i}: {test.name}" for i, test in enumerate(study.tests)))
    is_terminal = sys.stderr.isatty()
    is_short = study.material is not None  # lines are useless for hundreds of runs in seconds
    quiet = is_terminal or is_short or len(study.search.measures) > 1
    try:
        with warnings.catch_warnings(), failures_unlogged() if is_short else nullcontext():
            warnings.simplefilter("always", UserWarning)
            found = study.run(progress=is_terminal, callback=None if quiet else _Reported())
    except KeyboardInterrupt:
        print(
            f"\ncurvewise: interrupted; {_runs(study.stored_runs())} in {study.search.store}. "
            f"The same command goes on from there: curvewise identify {study.path}",
            file=sys.stderr,
        )
        return 130
    print(f"\n{found}\n\nresults: {study.results}")
    return 0


def _runs(count: int) -> str:
    return "1 run" if count == 1 else f"{count} runs"


class _Reported:
    """Prints a line for every batch of runs, and never ends the search."""

    def __init__(self) -> None:
        self._begin = time.monotonic()
        self._best = math.inf

    def __call__(self, progress: Progress) -> None:
        seconds = time.monotonic() - self._begin
        line = f"{seconds:8.0f} s  {progress.evaluations:5d} evaluated, best {progress.value:.5g}"
        if progress.value < self._best:
            self._best = progress.value
            values = (f"{name} {value:.5g}" for name, value in progress.parameters.items())
            line += f": {', '.join(values)}"
        print(line, file=sys.stderr, flush=True)
