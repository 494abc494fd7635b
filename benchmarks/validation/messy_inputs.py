"""The messy files, each with the truth and the answers of the person who made the test.

`FILES` are made here; :func:`cases_of` reads a folder, such as ../shared/cases.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from curvewise import read_curve
from curvewise.materials import ChabocheVoce

__all__ = ["FILES", "NOT_COMPARED", "TRUTH", "TRUTH_OF_ONE", "Messy", "cases_of", "plain"]

ONE, TWO = ChabocheVoce(backstresses=1), ChabocheVoce(backstresses=2)
TRUTH = dict(zip(TWO.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0, 6e3, 40.0), strict=True))
TRUTH_OF_ONE = {name: TRUTH[name] for name in ONE.names}
AREA, LENGTH = 38.5, 12.5  # mm², mm


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
