"""Files as test machines write them: does a fit, or a comparison, get them right or ask once?

    python messy_files.py                # files of its own
    python messy_files.py --cases DIR    # and those of a folder of cases, such as ../shared/cases

Each file is given to `curvewise fit FILE` and to `curvewise compare REFERENCE FILE`. The outcome is
"right", or a question, whose message has to name the options that then give the right result. The
answer is what the person knows who made the test: an area, a length, which columns are meant. Right
parameters are within TOLERANCES of the truth. Two curves are alike if the discrete Fréchet distance
of the scaled curves is at most NEAR. Writes the table, and every message in full, to its output. A
minute on one core; without noise in the machine's load the output is the same in every run.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import io
import json
import logging
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from curvewise.commands import main as curvewise
from curvewise.materials import ChabocheVoce

__all__ = ["FILES", "Messy", "Outcome", "outcome_of_compare", "outcome_of_fit", "written"]

ONE, TWO = ChabocheVoce(backstresses=1), ChabocheVoce(backstresses=2)
TRUTH = dict(zip(TWO.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0, 6e3, 40.0), strict=True))
TRUTH_OF_ONE = {name: TRUTH[name] for name in ONE.names}
TOLERANCES = {"E": 0.01, "yield": 0.03, "Q": 0.2, "b": 0.25, "C1": 0.1, "gamma1": 0.1}
NEAR = 0.02
AREA, LENGTH = 38.5, 12.5  # mm², mm
MOST_QUESTIONS = 3


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
    is_compared : bool
        Whether it has the strains of the reference, so that the curves can be compared.
    """

    name: str
    about: str
    write: Callable[[Path], object]
    answers: tuple[list[str], ...] = ()
    backstresses: int = 1
    is_compared: bool = True


class Outcome(NamedTuple):
    """What a command has made of a file.

    Attributes
    ----------
    verdict : str
        "right", "right after 1 question", or what is wrong.
    messages : list of str
        The questions, in full.
    found : str
        The numbers.
    """

    verdict: str
    messages: list[str]
    found: str


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
    Messy("plain.csv", "as it should be", text(f"strain,stress\n{lines(TEST)}")),
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
        (["--factors", "mm", "kN", "--gauge-length", f"{LENGTH}", "--area", f"{AREA}"],),
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
        is_compared=False,
    ),
)


def cases_of(folder: Path) -> Iterator[Messy]:
    """Yield the cases of a folder whose truth is TRUTH, and those that its scripts describe."""

    def copied(name: str) -> Callable[[Path], object]:
        return lambda path: path.write_bytes((folder / name).read_bytes())

    known: dict[str, tuple[list[str], ...]] = {
        "clean.csv": (),
        "percent_units_row.csv": (["--factors", "0.01", "1"],),
        "microstrain_units_row.csv": (["--factors", "1e-6", "1"],),
        "kn.csv": (["--area", f"{AREA}"],),
    }
    for name, answers in known.items():
        yield Messy(name, "of the folder", copied(name), answers, backstresses=2, is_compared=False)
    strain = np.interp(np.arange(601) / 120, range(6), (0, 0.01, -0.01, 0.01, -0.01, 0.01))
    stress = TWO.stress(strain, TRUTH) + np.random.default_rng(0).normal(0.0, 2.0, 601)
    for more, load in ((2e-4, 0), (5e-4, 0), (1e-3, 0), (0, 10), (0, -20), (0.02, 0)):
        moved = np.column_stack((strain + more, stress + load))
        about = f"offset.py: strain {more:+g}, stress {load:+g}"
        write = text("strain,stress\n" + lines(moved))
        yield Messy("offset.csv", about, write, (["--zero"],), 2, is_compared=False)
    slack = 5e-4 * (1.0 - np.exp(-np.arange(601)))
    write = text("strain,stress\n" + lines(np.column_stack((strain + slack, stress))))
    yield Messy("toe.csv", "toe.py", write, (["--toe", "150", "280"],), 2, is_compared=False)
    random = np.random.default_rng(0)
    path = np.interp(np.linspace(0, 5, 200_000), range(6), (0, 0.01, -0.01, 0.01, -0.01, 0.01))
    noise = random.normal(0, 1e-5, path.size), random.normal(0, 3, path.size)
    dense = np.column_stack((path + noise[0], TWO.stress(path, TRUTH) + noise[1]))
    write = text("strain,stress\n" + lines(dense))
    yield Messy("dense.csv", "dense_noise.py: 200,000 rows", write, (), 2, is_compared=False)


def run(command: Sequence[str]) -> tuple[int, str, str]:
    """Run a command line; return its status and what it prints."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = curvewise(list(command))
        except SystemExit as end:  # of argparse
            status = int(end.code or 0)
    return status, out.getvalue(), err.getvalue().strip()


def _asked(
    messy: Messy, command: list[str], suffix: str = ""
) -> tuple[str, list[str], list[str], str]:
    """Run a command, answer its questions; return what is wrong, messages, options, output."""
    messages: list[str] = []
    options: list[str] = []
    for answer in (*messy.answers, None):
        status, out, err = run([*command, *options])
        if status == 0:
            return "", messages, options, out
        messages.append(err)
        if answer is None:
            break
        flags = [one for one in answer if one.startswith("--")]
        if unnamed := [flag for flag in flags if flag not in err]:
            return f"asks without {', '.join(unnamed)}", messages, options, out
        options += [f"{one}{suffix}" if one.startswith("--") else one for one in answer]
    return "no way out", messages, options, ""


def _said(messages: Sequence[str]) -> str:
    count = len(messages)
    return "right" + (f" after {count} question{'s' if count > 1 else ''}" if count else "")


def outcome_of_fit(messy: Messy, folder: Path) -> Outcome:
    """Write a file and fit it."""
    path = folder / messy.name
    messy.write(path)
    truth = TRUTH_OF_ONE if messy.backstresses == 1 else TRUTH
    command = ["fit", str(path), "--output", str(folder / "fit")]
    wrong, messages, _, _ = _asked(messy, [*command, "--backstresses", str(messy.backstresses)])
    if wrong:
        return Outcome(wrong, messages, "")
    with (folder / "fit" / "parameters.csv").open(encoding="utf-8") as table:
        found = {row["parameter"]: float(row["value"]) for row in csv.DictReader(table)}
    said = ", ".join(f"{name} {found[name]:.4g}" for name in TOLERANCES)
    far = [n for n, share in TOLERANCES.items() if abs(found[n] / truth[n] - 1.0) > share]
    return Outcome(f"WRONG {', '.join(far)}" if far else _said(messages), messages, said)


def outcome_of_compare(messy: Messy, folder: Path) -> Outcome:
    """Write a file and compare it with the plain one."""
    path, reference = folder / messy.name, folder / "reference.csv"
    messy.write(path)
    FILES[0].write(reference)
    command = ["compare", str(reference), str(path), "--json", "--measures", "frechet"]
    wrong, messages, _, out = _asked(messy, command, suffix="-b")
    if wrong:
        return Outcome(wrong, messages, "")
    distance = json.loads(out)["values"]["frechet"]
    is_near = distance <= NEAR
    return Outcome(_said(messages) if is_near else "WRONG", messages, f"frechet {distance:.3g}")


def written(outcomes: Sequence[tuple[Messy, str, Outcome]]) -> str:
    """Return the table, and below it the messages."""
    rows = [
        "| file | what is messy | command | outcome | found |\n|---|---|---|---|---|",
        *(
            f"| {messy.name} | {messy.about} | {command} | {one.verdict} | {one.found} |"
            for messy, command, one in outcomes
        ),
    ]
    asked = [
        f"{messy.name}, {command}:\n    " + "\n    ".join(message.splitlines())
        for messy, command, one in outcomes
        for message in one.messages
    ]
    return "\n".join(rows) + "\n\n" + "\n".join(asked)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--cases", type=Path, help="a folder of cases")
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)
    outcomes = []
    with tempfile.TemporaryDirectory() as name:
        for messy in (*FILES, *(cases_of(arguments.cases) if arguments.cases else ())):
            print(messy.name, messy.about, file=sys.stderr, flush=True)
            outcomes.append((messy, "fit", outcome_of_fit(messy, Path(name))))
            if messy.is_compared:
                outcomes.append((messy, "compare", outcome_of_compare(messy, Path(name))))
    print(written(outcomes).replace(f"{name}/", ""))
    wrong = sum(not one.verdict.startswith("right") for *_, one in outcomes)
    print(f"\n{len(outcomes) - wrong} of {len(outcomes)} right")
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
