"""What `curvewise compare` asks of two files: units that differ, and beginnings beside zero."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from curvewise.commands import main
from curvewise.materials import ChabocheVoce

STEEL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(STEEL.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0), strict=True))
STRAIN = np.interp(np.arange(401) / 100, range(5), (0.0, 0.01, -0.01, 0.01, -0.01))
TEST = np.column_stack((STRAIN, STEEL.stress(STRAIN, MADE_OF)))
KSI = 6.894757
B = "--factors-b"


def written(name: str, header: str, points: np.ndarray) -> str:
    """Write a file into the present folder."""
    rows = "".join(f"{x!r},{y!r}\n" for x, y in points.tolist())
    Path(name).write_text(f"{header}\n{rows}", encoding="utf-8")
    return name


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)


def compared(*options: str) -> int:
    return main(["compare", "a.csv", "b.csv", "--measures", "frechet", "--json", *options])


@pytest.mark.parametrize(
    ("a", "b", "factors", "answer"),
    [
        ("strain,stress", "Strain (%),Stress", (100.0, 1.0), "--factors-b 0.01 1"),
        ("Strain (%),Stress", "strain,stress", (0.01, 1.0), "--factors-a 0.01 1"),
        ("strain,stress", "strain,Stress [ksi]", (1.0, 1 / KSI), "--factors-b 1 6.894757"),
        (
            "strain,stress (MPa)",
            "strain,stress (psi)",
            (1.0, 1e3 / KSI),
            "--factors-b 1 0.006894757",
        ),
        ("strain,stress (ksi)", "strain,stress (MPa)", (1.0, KSI), "--factors-b 1 0.1450377"),
        ("x,Load (kN)", "x,Load (N)", (1.0, 1e3), "--factors-b 1 0.001"),
        ("u (mm),F (N)", "u (in),F (N)", (1 / 25.4, 1.0), "--factors-b 25.4 1"),
        ("time (s),y", "time (ms),y", (1e3, 1.0), "--factors-b 0.001 1"),
        ("ε (-),σ (MPa)", "ε (µm/m),σ (GPa)", (1e6, 1e-3), "--factors-b 1e-06 1000"),
    ],
)
def test_units_that_differ_are_asked_about(a, b, factors, answer, capsys) -> None:
    scale = np.array((1.0, KSI if "ksi" in a else 1.0))
    points = TEST / scale if "%" not in a else TEST * (100.0, 1.0)
    written("a.csv", a, points)
    written("b.csv", b, points * factors)
    assert compared() == 1
    said = capsys.readouterr().err
    assert "seem to be in different units" in said
    assert answer in said
    assert compared(*answer.split()) == 0
    assert json.loads(capsys.readouterr().out)["values"]["frechet"] < 1e-4
    assert compared("--factors", "1", "1") == 0  # the numbers as they are
    assert json.loads(capsys.readouterr().out)["values"]["frechet"] > 0.1


def test_a_force_needs_an_area_and_an_extension_a_gauge_length(capsys) -> None:
    written("a.csv", "strain,stress", TEST)
    written("b.csv", "Extension (mm),Load (kN)", TEST * (12.5, 38.5e-3))
    assert compared() == 1
    assert "give --gauge-length-b, in mm and --area-b, in mm²" in capsys.readouterr().err
    assert compared("--gauge-length-b", "12.5", "--area-b", "38.5") == 0
    assert json.loads(capsys.readouterr().out)["values"]["frechet"] < 1e-6


@pytest.mark.parametrize(
    ("a", "b", "factor"),
    [
        ("strain,stress", "strain,stress", 6.9),  # nothing names a unit
        ("strain (-),stress (MPa)", "strain,stress", 2.0),
        ("strain (%),stress", "strain (%),stress", 3.0),
        ("strain,stress", "Strain (%),stress", 1.0),  # both are in per cent
        ("x,y", "x (%),y (kN)", 1.0),
    ],
)
def test_units_that_agree_are_not_asked_about(a, b, factor, capsys) -> None:
    written("a.csv", a, TEST)
    written("b.csv", b, TEST * (1.0, factor))
    assert compared() == 0
    assert not capsys.readouterr().err


def test_tests_of_two_amplitudes_are_asked_about_per_cent(capsys) -> None:
    written("a.csv", "strain,stress", TEST)
    written("b.csv", "strain (%),stress", TEST * (40.0, 0.7))
    assert compared() == 1
    assert "--factors-b 0.01 1" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("moved", "words", "options"),
    [
        ((8e-4, 0.0), "does not begin at zero", ["--zero-b"]),
        ((0.0, 20.0), "The first points of b.csv are beside the elastic line", ["--zero-b"]),
        (None, "begins with a toe", ["--toe"]),
    ],
)
def test_a_beginning_beside_zero_is_a_warning(moved, words, options, capsys) -> None:
    slack = 5e-4 * (1.0 - np.exp(-np.arange(len(TEST))))
    toe = np.column_stack((slack, np.zeros(len(TEST))))
    written("a.csv", "strain,stress", TEST)
    written("b.csv", "strain,stress", TEST + (toe if moved is None else moved))
    assert compared() == 0
    said = capsys.readouterr().err
    assert words in said
    assert options[0] in said
    assert "Python" not in said
    assert said.count("\n") == 1
    assert compared(*options) == 0
    assert not capsys.readouterr().err


@pytest.mark.parametrize("header", ["x,y", "time (s),stress"])
def test_other_curves_have_no_beginning_to_warn_of(header, capsys) -> None:
    written("a.csv", header, TEST)
    written("b.csv", header, TEST + np.array((8e-4, 0.0)))
    assert compared() == 0
    assert not capsys.readouterr().err


def test_two_curves_that_begin_beside_zero_alike_are_not_warned_of(capsys) -> None:
    for name in ("a.csv", "b.csv"):
        written(name, "strain,stress", TEST + np.array((8e-4, 0.0)))
    assert compared() == 0
    assert not capsys.readouterr().err


def test_a_first_column_of_cycles_is_asked_about(capsys) -> None:
    numbers = np.repeat([1.0, 2.0], 201)[: len(TEST)]
    rows = "".join(f"{n:g},{x!r},{y!r}\n" for n, (x, y) in zip(numbers, TEST.tolist(), strict=True))
    Path("b.csv").write_text("Total Cycles,Strain (%),Stress\n" + rows)
    assert main(["fit", "b.csv"]) == 1
    said = capsys.readouterr().err
    assert "--columns 'Strain (%)' Stress, and --cycle-column 'Total Cycles' if" in said
    assert "Of these, the strain is in column 'Strain (%)'" in said  # the next question
    assert "--factors 0.01 1" in said
    written("a.csv", "strain,stress", TEST)
    assert compared() == 1
    said = capsys.readouterr().err
    assert "--columns-b 'Strain (%)' Stress" in said
    assert "--cycle-column" not in said  # which compare does not have
