"""Studies of a material instead of a solver: the results of curvewise fit, from a file."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from curvewise.commands import main
from curvewise.fitting import MaterialFit, fit_material
from curvewise.materials import ChabocheVoce
from curvewise.solvers import read_card
from curvewise.studies import Study, StudyError

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(201) / 40, range(6), (0.0, 0.02, -0.02, 0.02, -0.02, 0.02))
NOISE = np.random.default_rng(3).normal(0.0, 2.0, STRAIN.shape)
LOOP = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF) + NOISE))
STUDY = """\
[[tests]]
file = "loop.csv"
[model]
material = "chaboche-voce"
backstresses = 1
cards = ["abaqus"]
name = "STEEL"
[parameters]
E = 200e3
"""
PAGE = Path(__file__).parents[3] / "docs" / "how_to" / "run_a_study.md"


def write(folder: Path, text: str = STUDY, loop: np.ndarray = LOOP) -> Path:
    np.savetxt(folder / "loop.csv", loop, delimiter=",", header="strain,stress", comments="")
    file = folder / "study.toml"
    file.write_text(text)
    return file


def fitted(**options: object) -> MaterialFit:
    return fit_material(LOOP, MATERIAL, progress=False, **options)  # type: ignore[arg-type]


def test_the_study_finds_what_fit_finds_and_writes_the_same_files(tmp_path: Path, capsys) -> None:
    file = write(tmp_path)
    assert main(["identify", str(file)]) == 0
    printed = capsys.readouterr()
    assert "evaluated" not in printed.err  # a line for each batch is for solvers
    assert "not determined:" in printed.out or "all parameters are determined" in printed.out
    fit = fitted(fixed={"E": 200e3})
    fit.write(tmp_path / "fit")
    results = tmp_path / "study_results"
    written = (results / "parameters.csv").read_text(encoding="utf-8")
    assert written == (tmp_path / "fit" / "parameters.csv").read_text(encoding="utf-8")
    assert read_card(results / "card_abaqus.inp").parameters == fit.parameters
    assert "*MATERIAL, NAME=STEEL" in (results / "card_abaqus.inp").read_text(encoding="utf-8")
    found = json.loads((results / "result.json").read_text())["found"]["sum_of_squares"]
    assert {n: row["value"] for n, row in found["parameters"].items()} == fit.parameters
    assert {"fit.png", "report.html", "result.csv", "simulation_loop.csv"} <= {
        path.name for path in results.iterdir()
    }
    assert not (results / "loops.png").exists()


def test_a_study_that_has_run_looks_everything_up(tmp_path: Path) -> None:
    first, second = (Study.read(write(tmp_path)).run(progress=False) for _ in range(2))
    runs = [found.identifications["sum_of_squares"].runs for found in (first, second)]
    assert runs[0] > 20
    assert runs[1] == 0
    assert str(first) == str(second)
    followed = first.uncertainties["sum_of_squares"].runs
    assert followed > 0
    assert Study.read(tmp_path / "study.toml").stored_runs() == runs[0] + followed
    other = write(tmp_path, STUDY.replace("backstresses = 1", "backstresses = 2"))
    assert Study.read(other).stored_runs() == 0


def test_the_check_runs_once_and_keeps_no_folder(tmp_path: Path) -> None:
    checked = Study.read(write(tmp_path)).check()
    assert checked.folders == ()
    assert list(checked.values) == ["sum_of_squares"]
    assert not (tmp_path / "study_check").exists()
    assert "measured      201 points" in str(checked)


def test_bounds_of_ones_own_beside_those_of_the_tests(tmp_path: Path) -> None:
    own = 'yield = { bounds = [250, 350], start = 320 }\nQ = [-90, 10]\nC1 = "200 * gamma1"\n'
    text = STUDY.replace("E = 200e3\n", own)
    with pytest.raises(StudyError, match=r"parameters\.C1 .*'gamma1' has no value|gamma1"):
        Study.read(write(tmp_path, text))
    study = Study.read(write(tmp_path, text.replace('C1 = "200 * gamma1"\n', "")))
    read_off = MATERIAL.bounds_from(LOOP)
    assert list(study.bounds) == list(MATERIAL.names)
    assert study.bounds["E"] == read_off["E"]
    assert study.bounds["yield"] == (250.0, 350.0)
    assert study.search.start["yield"] == 320.0
    assert study.search.start["Q"] == pytest.approx(-40.0)
    nothing = Study.read(write(tmp_path, STUDY[: STUDY.index("[parameters]")]))
    assert dict(nothing.bounds) == dict(read_off)


def test_the_last_cycle_weights_and_another_measure(tmp_path: Path) -> None:
    text = STUDY.replace('name = "STEEL"', 'cycles = "last"\naccept_undetermined = true')
    study = Study.read(write(tmp_path, text))
    np.testing.assert_array_equal(study.tests[0].experiment, LOOP[120:])
    text = text.replace("[parameters]", '[search]\nmeasure = "area"\nmax_runs = 4\n[parameters]')
    found = Study.read(write(tmp_path, text)).run(progress=False)
    assert list(found.identifications) == ["area"]
    assert found.fit is not None
    several = text.replace('measure = "area"', 'measures = ["area", "sum_of_squares"]')
    several = several.replace('cards = ["abaqus"]\n', "")
    found = Study.read(write(tmp_path, several)).run(progress=False)
    assert found.fit is None
    assert (tmp_path / "study_results" / "loops.png").exists()
    unsure = text.replace("max_runs = 4", "max_runs = 4\nuncertainty = false")
    Study.read(write(tmp_path, unsure)).run(progress=False)
    table = (tmp_path / "study_results" / "parameters.csv").read_text(encoding="utf-8")
    assert "E,MPa,200000.0,,,," in table


@pytest.mark.parametrize(
    ("right", "wrong", "message"),
    [
        ("-voce", "-voc", "line 4: model.material is 'chaboche-voc'; did you mean 'chaboche-voce'"),
        (
            'material = "chaboche-voce"',
            'command = ["ccx"]\nmaterial = "chaboche-voce"',
            "line 5: model.material stands beside command; give one of them, a solver or a",
        ),
        (
            'material = "chaboche-voce"\n',
            "",
            'line 3: model has no command; give ["ccx", "-i", "deck"], say, or a material in its',
        ),
        ("backstresses = 1", "backstresses = 300", "line 3: model cannot be: backstresses is 300"),
        (
            "backstresses = 1",
            'growth = "power"',
            "line 5: model.growth is no option of chaboche-voce (its own: backstresses, modulus)",
        ),
        (
            "backstresses = 1",
            'modulus = "decayin"',
            "line 5: model.modulus is 'decayin'; did you mean 'decaying'?",
        ),
        ("backstresses = 1", "backstress = 1", "line 5: model.backstress is not a known key; did"),
        ('["abaqus"]', '["abaqs"]', "line 6: model.cards is 'abaqs'; did you mean 'abaqus'?"),
        (
            "E = 200e3",
            "yeild = [1, 2]",
            "line 9: parameters.yeild is no parameter of chaboche-voce; did you mean 'yield'?",
        ),
        (
            "[model]",
            'output = { file = "out.csv" }\n[model]',
            "line 3: tests[1].output is about what a solver writes, and [model] has a material",
        ),
        (
            '[[tests]]\nfile = "loop.csv"',
            "[[tests]]\nnumber = 3",
            "line 2: tests[1].number is a number, and a material is driven by a curve",
        ),
        (
            '"loop.csv"',
            '"loop.csv"\nfactors = [100, 1]',
            "line 1: tests[1] cannot drive a material: has strains of up to 2, which is 200 %",
        ),
        (
            "[parameters]",
            '[search]\nmeasures = ["area", "dtw"]\n[parameters]',
            "line 6: model.cards are of one fit, and [search] has several measures",
        ),
        (
            "[model]",
            "[models.a]",
            "line 4: models.a.material is for all tests, in [model]; there are no several",
        ),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, right: str, wrong: str, message: str) -> None:
    assert STUDY.count(right) == 1
    with pytest.raises(StudyError) as caught:
        Study.read(write(tmp_path, STUDY.replace(right, wrong)))
    begin = f"{tmp_path}/study.toml, {message}"
    assert any(problem.startswith(begin) for problem in caught.value.problems)


def test_a_test_without_a_cycle_and_an_elastic_one(tmp_path: Path) -> None:
    cut = STUDY.replace('name = "STEEL"', 'cycles = "last"')
    said = r"tests\[1\] cannot drive a material: "
    with pytest.raises(StudyError, match=f"{said}the curve lacks a complete cycle"):
        Study.read(write(tmp_path, cut, LOOP[:70]))
    with pytest.raises(StudyError, match=f"{said}is elastic"):
        Study.read(write(tmp_path, STUDY, np.array([(0.0, 0.0), (5e-4, 100.0), (1e-3, 200.0)])))


def test_the_study_of_the_page(tmp_path: Path) -> None:
    blocks = re.findall(r"^```toml\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    study = Study.read(write(tmp_path, blocks[1]))
    assert study.material is not None
    assert study.material.cards == ("abaqus", "calculix")
