"""Files as test machines write them: does a fit, or a comparison, get them right or ask once?

    python messy_files.py                # files of its own
    python messy_files.py --cases DIR    # and those of a folder of cases, such as ../shared/cases

Each file is given to `curvewise fit FILE` and to `curvewise compare REFERENCE FILE`. The outcome is
"right", or a question or warning, whose message has to name the options that then give the right
result. The answer is what the person knows who made the test: an area, a length, which columns are
meant. Right parameters are within TOLERANCES of the truth. Two curves are alike if paired points
are at most NEAR of the height apart on average. With --cases, writes the table to
results/messy_files.md. Prints the table and the transcript, with the first lines of both outputs.
Two minutes on one core.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import io
import json
import logging
import os
import shlex
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from messy_inputs import FILES, NOT_COMPARED, TRUTH, TRUTH_OF_ONE, Messy, cases_of, plain
from places import RESULTS

from curvewise.commands import main as curvewise

__all__ = ["FILES", "Messy", "Outcome", "outcome_of_compare", "outcome_of_fit", "written"]

TOLERANCES = {"E": 0.01, "yield": 0.03, "Q": 0.2, "b": 0.25, "C1": 0.1, "gamma1": 0.1}
NEAR = 0.01
_HEADS = ("file", "what is messy", "command", "outcome", "found")
SHOWN = 2  # lines of the standard output


class Run(NamedTuple):
    """A command line, its exit status, and what it has printed."""

    command: list[str]
    status: int
    out: str
    err: str

    def __str__(self) -> str:
        """Return the command and the status, the standard error and the first lines of output."""
        begin = f"$ {shlex.join(['curvewise', *self.command])}    # status {self.status}"
        return "\n".join([begin, *self.err.splitlines(), *self.out.splitlines()[:SHOWN]])


class Outcome(NamedTuple):
    """What a command has made of a file.

    Attributes
    ----------
    verdict : str
        "right", "right after 1 question", or what is wrong.
    runs : list of Run
        In their order.
    found : str
        The numbers.
    """

    verdict: str
    runs: list[Run]
    found: str

    @property
    def is_shown(self) -> bool:
        """Whether it has a question or a warning, or is wrong."""
        return len(self.runs) > 1 or not self.verdict.startswith("right")

    def in_a_block(self) -> str:
        """Return the runs as a block of Markdown."""
        return "\n".join(["```text", *map(str, self.runs), "```"])


def run(command: Sequence[str]) -> Run:
    """Run a command line."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = curvewise(list(command))
        except SystemExit as end:  # of argparse
            status = int(end.code or 0)
    return Run(list(command), status, out.getvalue(), err.getvalue().strip())


def _asked(messy: Messy, command: list[str], suffix: str = "") -> tuple[str, list[Run]]:
    """Run a command and answer its questions and warnings; return what is wrong, and the runs."""
    runs = [run(command)]
    for answer in messy.answers:
        first = "\n".join(runs[-1].out.splitlines()[:SHOWN])
        said = f"{runs[-1].err}\n{first}"
        # A toe is cut from both curves.
        flags = {one: one if one == "--toe" else f"{one}{suffix}" for one in answer if "--" in one}
        if unnamed := [flag for flag in flags.values() if flag not in said]:
            is_silent = runs[-1].status == 0
            return ("" if is_silent else f"asks without {', '.join(unnamed)}"), runs
        command = [*command, *(flags.get(one, one) for one in answer)]
        runs.append(run(command))
    return "no way out" if runs[-1].status else "", runs


def _said(runs: Sequence[Run]) -> str:
    """Return in words how many questions and warnings came before the right result."""
    asked = sum(one.status != 0 for one in runs)
    counts = {"question": asked, "warning": len(runs) - 1 - asked}
    words = [f"{n} {one}{'s' if n > 1 else ''}" for one, n in counts.items() if n]
    return " after ".join(["right", *[" and ".join(words)] * bool(words)])


def outcome_of_fit(messy: Messy) -> Outcome:
    """Write a file into the present folder and fit it."""
    path = Path(messy.name)
    messy.write(path)
    truth = TRUTH_OF_ONE if messy.backstresses == 1 else TRUTH
    given = ["--backstresses", "1"] if messy.backstresses == 1 else []
    wrong, runs = _asked(messy, ["fit", messy.name, *given])
    if wrong:
        return Outcome(wrong, runs, "")
    with Path("fit", "parameters.csv").open(encoding="utf-8") as table:
        found = {row["parameter"]: float(row["value"]) for row in csv.DictReader(table)}
    said = ", ".join(f"{name} {found[name]:.4g}" for name in TOLERANCES)
    far = [n for n, share in TOLERANCES.items() if abs(found[n] / truth[n] - 1.0) > share]
    return Outcome(f"WRONG {', '.join(far)}" if far else _said(runs), runs, said)


def outcome_of_compare(messy: Messy, reference: Callable[[Path], object]) -> Outcome:
    """Write a file into the present folder and compare it with the right one."""
    messy.write(Path(messy.name))
    reference(Path("reference.csv"))
    command = ["compare", "reference.csv", messy.name, "--measures", "frechet", *messy.given]
    wrong, runs = _asked(messy, command, suffix="-b")
    if wrong:
        return Outcome(wrong, runs, "")
    deviation = json.loads(run([*runs[-1].command, "--json"]).out)["deviations"]["frechet"]
    share = deviation["mean"] / deviation["height"]
    verdict = _said(runs) if share <= NEAR else "WRONG"
    return Outcome(verdict, runs, f"mean deviation {100 * share:.2g} %")


def outcomes_of(files: Iterable[Messy]) -> Iterator[tuple[Messy, Outcome]]:
    """Yield what the commands make of each file."""
    for messy in files:
        print(messy.name, messy.about, file=sys.stderr, flush=True)
        if messy.is_fitted:
            yield messy, outcome_of_fit(messy)
        if messy.reference is not None:
            yield messy, outcome_of_compare(messy, messy.reference)


def written(outcomes: Sequence[tuple[Messy, Outcome]]) -> str:
    """Return the page: the count, the table, the transcript."""
    right = sum(one.verdict.startswith("right") for _, one in outcomes)
    rows = [
        f"| {messy.name} | {messy.about} | {one.runs[0].command[0]} | {one.verdict} | {one.found} |"
        for messy, one in outcomes
    ]
    known = ", ".join(f"{name} {value:g}" for name, value in TRUTH.items())
    return "\n\n".join(
        [
            "# Messy files",
            f"{right} of {len(outcomes)} right. Made by `messy_files.py`. The steel has {known}; "
            "tests made by the script lack C2 and gamma2. Each file is given to `fit` and to "
            "`compare`, whose questions and warnings are then answered.",
            "\n".join([f"| {' | '.join(_HEADS)} |", "|---|---|---|---|---|", *rows]),
            "## Transcript\n\nRuns without a question or a warning are left out. The first "
            f"{SHOWN} lines of the standard output follow the standard error.",
            *(
                "```text\n" + "\n".join(map(str, one.runs)) + "\n```"
                for _, one in outcomes
                if one.is_shown
            ),
            "",
        ]
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--cases", type=Path, help="a folder of cases")
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)
    cases = list(cases_of(arguments.cases.resolve())) if arguments.cases else []
    own = [one._replace(reference=None if one.name in NOT_COMPARED else plain) for one in FILES]
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        outcomes = list(outcomes_of([*own, *cases]))
        os.chdir(RESULTS)
    page = written(outcomes)
    if cases:
        table = page.partition("## Transcript")[0].rstrip() + "\n"
        (RESULTS / "messy_files.md").write_text(table, encoding="utf-8")
    print(page)
    return int(not all(one.verdict.startswith("right") for _, one in outcomes))


if __name__ == "__main__":
    raise SystemExit(main())
