"""Files as test machines write them: does a fit, or a comparison, get them right or ask once?

    python messy_files.py                # files of its own
    python messy_files.py --cases DIR    # and those of a folder of cases, such as ../shared/cases

Each file is given to `curvewise fit FILE` and to `curvewise compare REFERENCE FILE`. The outcome is
"right", or a question or warning, whose message has to name the options that then give the right
result. The answer is what the person knows who made the test: an area, a length, which columns are
meant. Right parameters are within TOLERANCES of the truth. Two curves are alike if paired points
are at most NEAR of the height apart on average. Writes the table and the transcript, with the first
lines of both outputs, to results/messy_files.md. Two minutes on one core.
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
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from places import RESULTS

from curvewise import read_curve
from curvewise.commands import main as curvewise
from curvewise.materials import ChabocheVoce

__all__ = ["FILES", "Messy", "Outcome", "outcome_of_compare", "outcome_of_fit", "written"]

ONE, TWO = ChabocheVoce(backstresses=1), ChabocheVoce(backstresses=2)
TRUTH = dict(zip(TWO.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0, 6e3, 40.0), strict=True))
TRUTH_OF_ONE = {name: TRUTH[name] for name in ONE.names}
TOLERANCES = {"E": 0.01, "yield": 0.03, "Q": 0.2, "b": 0.25, "C1": 0.1, "gamma1": 0.1}
NEAR = 0.01
AREA, LENGTH = 38.5, 12.5  # mm², mm
_HEADS = ("file", "what is messy", "command", "outcome", "found")
SHOWN = 2  # lines of the standard output


class Messy(NamedTuple):
    """A file, and what is known of it.

    Attributes
    ----------
    name : str
        Of the file.
    about : str
        What is messy.
    write : callable
        Takes the path, and writes the file.
    answers : tuple of list of str
        The options that answer the questions, in their order; those of one question together.
    backstresses : int
        Of the material that made it.
    reference : callable, or None
        Writes what it is compared with; None if nothing has its strains.
    is_fitted : bool
        Whether it is a test of the material.
    given : tuple of str
        The options that a user gives at once.
    """

    name: str
    about: str
    write: Callable[[Path], object]
    answers: tuple[list[str], ...] = ()
    backstresses: int = 1
    reference: Callable[[Path], object] | None = None
    is_fitted: bool = True
    given: tuple[str, ...] = ()


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


def test_of_steel() -> np.ndarray:
    """Return strain and stress of two cycles, with scatter of 1 MPa."""
    turns = (0.0, 0.01, -0.01, 0.01, -0.01)
    strain = np.interp(np.arange(401) / 100, range(5), turns)
    scatter = np.random.default_rng(1).normal(0.0, 1.0, strain.size)
    scatter[0] = 0.0
    return np.column_stack((strain, ONE.stress(strain, TRUTH_OF_ONE) + scatter))


TEST = test_of_steel()


def lines(rows: np.ndarray, separator: str = ",", decimal: str = ".") -> str:
    """Return numbers as lines of text."""
    texts = (separator.join(f"{number:.7g}" for number in row) for row in rows)
    return "\n".join(texts).replace(".", decimal) + "\n"


def plain(path: Path) -> object:
    """Write the test as it should be."""
    return text(f"strain,stress\n{lines(TEST)}")(path)


def text(content: str, encoding: str = "utf-8") -> Callable[[Path], object]:
    """Return what writes a text."""
    return lambda path: path.write_bytes(content.encode(encoding))


def workbook(path: Path) -> None:
    """Write a workbook whose first sheet has the conditions of the test, the second the test."""
    from openpyxl import Workbook

    book = Workbook()
    first = book.active
    first.title = "Conditions"
    for row in (("Operator", "jd"), ("Temperature", 21.5), ("Rate", 0.001)):
        first.append(row)
    second = book.create_sheet("Data")
    second.append(("Strain [mm/mm]", "Stress [MPa]"))
    for row in TEST.tolist():
        second.append(row)
    book.save(path)


def with_toe() -> np.ndarray:
    """Return the test with a slack of 0.05 % that is taken up over the first 60 MPa."""
    slack = 5e-4 * (1.0 - np.exp(-np.arange(len(TEST)) / 1.0))
    return TEST + np.column_stack((slack, np.zeros(len(TEST))))


def some_cycles() -> np.ndarray:
    """Return cycles 1, 2, 5 and 10 of a test of ten, with the number of the cycle."""
    strain = np.interp(np.arange(10 * 80 + 1) / 20, np.arange(41), [0.0, *[0.01, 0, -0.01, 0] * 10])
    stress = ONE.stress(strain, TRUTH_OF_ONE)
    number = np.minimum(np.arange(len(strain)) // 80 + 1, 10)
    return np.column_stack((number, strain, stress))[np.isin(number, (1, 2, 5, 10))]


def gaps(rows: np.ndarray) -> str:
    """Return lines, of which some have no stress."""
    made = lines(rows).splitlines()
    for i in range(7, len(made), 50):
        made[i] = f"{made[i].partition(',')[0]},----"
    return "\n".join(made) + "\n"


TIME = np.arange(len(TEST)) * 0.05
FORCE = np.column_stack((LENGTH * TEST[:, 0], AREA * TEST[:, 1] / 1e3))  # mm, kN
FILES = (
    Messy("plain.csv", "as it should be", plain),
    Messy(
        "semicolons.csv",
        "decimal commas, semicolons, German names, per cent",
        text("Dehnung [%];Spannung [MPa]\n" + lines(TEST * (100.0, 1.0), ";", ",")),
        (["--factors", "0.01", "1"],),
    ),
    Messy(
        "table_above.csv",
        "BOM, a table of results above the data",
        text(
            '"Operator","jd"\n"Area","38.5","mm2"\n\n"Results"\n"","Max load","Modulus"\n'
            '"","(kN)","(MPa)"\n"1","20.81","205432"\n\n"Raw data"\n"Strain","Stress"\n'
            '"(mm/mm)","(MPa)"\n' + lines(TEST),
            "utf-8-sig",
        ),
        (["--from", "Raw data"],),
    ),
    Messy(
        "ksi.txt",
        "tabs, a row of units, stress in ksi",
        text("Strain\tStress\nin/in\tksi\n" + lines(TEST / (1.0, 6.894757), "\t")),
        (["--factors", "1", "ksi"],),
    ),
    Messy(
        "kn_mm.csv",
        "extension in mm and force in kN",
        text("Extension (mm),Load (kN)\n" + lines(FORCE)),
        (["--gauge-length", f"{LENGTH}", "--area", f"{AREA}"],),
    ),
    Messy(
        "voltage.csv",
        "time and voltage first",
        text(
            "Time (s),Voltage (V),Strain (-),Stress (MPa)\n"
            + lines(np.column_stack((TIME, TEST[:, 1] / 100.0, TEST)))
        ),
        (["--columns", "Strain (-)", "Stress (MPa)"],),
    ),
    Messy(
        "offset.csv",
        "extensometer not zeroed: +0.08 %",
        text("strain,stress\n" + lines(TEST + np.array((8e-4, 0.0)))),
        (["--zero"],),
    ),
    Messy("toe.csv", "a toe", text("strain,stress\n" + lines(with_toe())), (["--toe"],)),
    Messy("gbk.csv", "GBK, Chinese names", text("应变,应力(MPa)\n" + lines(TEST), "gbk")),
    Messy("sheets.xlsx", "two sheets, the second has the data", workbook, (["--sheet", "Data"],)),
    Messy(
        "missing.csv",
        "missing values: ----",
        text("strain,stress\n" + gaps(TEST)),
        (["--skip-invalid"],),
    ),
    Messy(
        "twice.csv",
        "every row twice",
        text("strain,stress\n" + lines(np.repeat(TEST, 2, axis=0))),
    ),
    Messy(
        "cycles.csv",
        "cycles 1, 2, 5 and 10 alone",
        text("Cycle,Strain,Stress\n" + lines(some_cycles())),
        (["--columns", "Strain", "Stress", "--cycle-column", "Cycle"],),
    ),
)


NOT_COMPARED = ("cycles.csv",)


def cases_of(folder: Path) -> Iterator[Messy]:
    """Yield the cases of a folder whose truth is TRUTH, and those that its scripts describe."""

    def copied(name: str) -> Callable[[Path], object]:
        return lambda path: path.write_bytes((folder / name).read_bytes())

    clean = copied("clean.csv")
    known: dict[str, tuple[list[str], ...]] = {
        "clean.csv": (),
        "percent_units_row.csv": (["--factors", "0.01", "1"],),
        "microstrain_units_row.csv": (["--factors", "1e-06", "1"],),
        "kn.csv": (["--area", f"{AREA}"],),
    }
    small = read_curve(folder / "percent_units_row.csv", factors=(0.01, 1.0))
    for name, answers in known.items():
        reference = clean if name == "clean.csv" else text("strain,stress\n" + lines(small))
        yield Messy(name, "of the folder", copied(name), answers, 2, reference)
    columns = ["--columns", "Strain 1 (%)", "Stress (MPa)", "--factors", "0.01", "1"]
    about = "of the folder: time, counters, temperature"
    yield Messy("lcf_cycles.csv", about, copied("lcf_cycles.csv"), (columns,), 2)
    yield from tables_of(folder)
    strain = np.interp(np.arange(601) / 120, range(6), (0, 0.01, -0.01, 0.01, -0.01, 0.01))
    stress = TWO.stress(strain, TRUTH) + np.random.default_rng(0).normal(0.0, 2.0, 601)
    for more, load in ((2e-4, 0), (5e-4, 0), (1e-3, 0), (0, 10), (0, -20), (0.02, 0)):
        moved = np.column_stack((strain + more, stress + load))
        about = f"offset.py: strain {more:+g}, stress {load:+g}"
        write = text("strain,stress\n" + lines(moved))
        yield Messy("offset.csv", about, write, (["--zero"],), 2, clean)
    slack = 5e-4 * (1.0 - np.exp(-np.arange(601)))
    write = text("strain,stress\n" + lines(np.column_stack((strain + slack, stress))))
    yield Messy("toe.csv", "toe.py", write, (["--toe"],), 2, clean)
    random = np.random.default_rng(0)
    path = np.interp(np.linspace(0, 5, 200_000), range(6), (0, 0.01, -0.01, 0.01, -0.01, 0.01))
    noise = random.normal(0, 1e-5, path.size), random.normal(0, 3, path.size)
    dense = np.column_stack((path + noise[0], TWO.stress(path, TRUTH) + noise[1]))
    write = text("strain,stress\n" + lines(dense))
    yield Messy("dense.csv", "dense_noise.py: 200,000 rows", write, (), 2)


def tables_of(folder: Path) -> Iterator[Messy]:
    """Yield tables of the folder and of its `field`, each with its right points."""
    results, instron = (
        (folder / name).read_bytes() for name in ("results_row.csv", "instron_results_table.csv")
    )
    below = instron.decode("utf-8-sig").splitlines()[-10:]
    points = [[float(cell.strip('"')) for cell in row.split(",")][-2:] for row in below]
    columns = ["--columns", "Strain 1", "Tensile stress"]
    two = "Red,,Blue,\nX,Y,X,Y\n0,1,0.5,10\n1,2,1.5,20\n2,4,,\n3,8,,\n"
    minus = "\u2212"
    tables: tuple[tuple[str, str, bytes | str, tuple[list[str], ...] | list[str], Any], ...] = (
        (
            "results_row.csv",
            "a row of results above",
            results,
            (["--from", "Strain"],),
            [(0.1, 1), (0.2, 2), (0.3, 3)],
        ),
        (
            "instron.csv",
            "instron_results_table.csv",
            instron,
            (["--from", "Raw Data"], columns),
            points,
        ),
        (
            "sep.csv",
            "field/20: Excel's line sep=;",
            '"sep=;"\na;b;\n1;2;\n3;4,5;\n',
            (),
            [(1, 2), (3, 4.5)],
        ),
        (
            "dates.csv",
            "field/21: dates, three rows of names",
            "DATE;STRAIN;FORCE\n;%;KN\n;a;a\n15.07.2024 08:00:01;0,10;1,50\n"
            "15.07.2024 08:00:02;0,20;2,75\n15.07.2024 08:00:03;0,30;4,00\n",
            (["--columns", "STRAIN", "FORCE"],),
            [(0.1, 1.5), (0.2, 2.75), (0.3, 4)],
        ),
        (
            "two.csv",
            "field/22: two curves beside each other",
            two,
            ["--columns-b", "3", "4"],
            [(0.5, 10), (1.5, 20)],
        ),
        (
            "minus.csv",
            "field/40: a minus of U+2212",
            f"strain;stress\n{minus}0,5;{minus}150,5\n{minus}0,2;{minus}60,5\n0;0\n0,2;60,5\n",
            (),
            [(-0.5, -150.5), (-0.2, -60.5), (0, 0), (0.2, 60.5)],
        ),
    )
    for name, about, content, answers, right in tables:
        body = content if isinstance(content, bytes) else content.encode()
        reference = text("a,b\n" + lines(np.array(right)))
        asked, given = (answers, []) if isinstance(answers, tuple) else ((), answers)
        made = Messy(name, about, partial(_put, body), asked, 1, reference, False)
        yield made._replace(given=tuple(given))


def _put(content: bytes, path: Path) -> None:
    path.write_bytes(content)


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
            f"`compare`, whose questions and warnings are then answered. The first {SHOWN} lines "
            "of the standard output follow the standard error.",
            "\n".join([f"| {' | '.join(_HEADS)} |", "|---|---|---|---|---|", *rows]),
            "## Transcript\n\nRuns without a question or a warning are left out.",
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
        (RESULTS / "messy_files.md").write_text(page, encoding="utf-8")
    print(page.partition("## Transcript")[0].strip())
    return int(not all(one.verdict.startswith("right") for _, one in outcomes))


if __name__ == "__main__":
    raise SystemExit(main())
