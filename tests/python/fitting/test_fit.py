"""A material fitted to tests, as a function and from the shell."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from curvewise.commands import main
from curvewise.fitting import MaterialFit, fit_material
from curvewise.materials import ChabocheVoce
from curvewise.solvers import read_card

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(121) / 40, range(4), (0.0, 0.02, -0.02, 0.02))
STRESS = MATERIAL.stress(STRAIN, MADE_OF)
LOOP = np.column_stack((STRAIN, STRESS + np.random.default_rng(3).normal(0.0, 2.0, STRESS.shape)))


@pytest.fixture(scope="module")
def fit() -> MaterialFit:
    return fit_material(LOOP, MATERIAL, progress=False)


def test_it_finds_what_made_the_loop_and_says_how_well(fit: MaterialFit) -> None:
    for name, (low, high) in fit.uncertainty.intervals.items():
        value = MADE_OF[name]
        assert low - 0.5 * (high - low) < value < high + 0.5 * (high - low), name
    assert fit.parameters["C1"] == pytest.approx(80e3, rel=0.05)
    assert "weakest direction" in str(fit)


def test_files_hold_what_was_found(fit: MaterialFit, tmp_path: Path) -> None:
    written = fit.write(tmp_path / "new", names=["bar 1"])
    assert [path.name for path in written] == ["parameters.csv", "report.html", "fit.png"]
    with written[0].open(newline="", encoding="utf-8") as file:
        rows = {row["parameter"]: row for row in csv.DictReader(file)}
    assert {name: float(row["value"]) for name, row in rows.items()} == fit.parameters
    assert float(rows["C1"]["interval_low"]) == fit.uncertainty.intervals["C1"][0]
    assert "<html" in written[1].read_text(encoding="utf-8")


def test_the_card_has_the_parameters(fit: MaterialFit, tmp_path: Path) -> None:
    path = tmp_path / "card.inp"
    path.write_text(fit.card("abaqus", name="STEEL"), encoding="utf-8")
    assert read_card(path).parameters == fit.parameters


def test_what_is_known_is_not_searched_for(tmp_path: Path) -> None:
    fit = fit_material(LOOP, MATERIAL, fixed={"E": 210e3}, progress=False)
    assert fit.parameters["E"] == 210e3
    assert "E" not in fit.uncertainty.intervals
    table = fit.write(tmp_path)[0].read_text(encoding="utf-8")
    assert "E,stress,210000.0,,,," in table
    with pytest.raises(ValueError, match="fixed has no parameter of the material: 'e'"):
        fit_material(LOOP, MATERIAL, fixed={"e": 1.0})


def write_test(path: Path, header: str = "strain,stress", factor: float = 1.0) -> str:
    np.savetxt(path, LOOP * (factor, 1.0), delimiter=",", header=header, comments="")
    return str(path)


def test_the_command_goes_from_a_file_to_a_card(tmp_path: Path, capsys) -> None:
    test = write_test(tmp_path / "loop.csv", "Strain (%),Stress (MPa)", 100.0)
    command = ["fit", test, "--factors", "0.01", "1", "--backstresses", "1"]
    output = tmp_path / "out"
    assert main([*command, "--card", "abaqus", "--output", str(output)]) == 0
    assert "card_abaqus.txt" in capsys.readouterr().out
    found = read_card(output / "card_abaqus.txt").parameters
    assert found["C1"] == pytest.approx(80e3, rel=0.05)


@pytest.mark.parametrize(
    ("header", "factor", "message"),
    [
        ("Strain (%),Stress", 100.0, "'Strain (%)', which seems to be in per cent"),
        ("strain,stress", 100.0, "strains of up to 2, which is 200 %"),
    ],
)
def test_strains_in_per_cent_are_asked_about(header, factor, message, tmp_path, capsys) -> None:
    test = write_test(tmp_path / "loop.csv", header, factor)
    assert main(["fit", test, "--output", str(tmp_path / "out")]) == 1
    assert message in capsys.readouterr().err
