"""Known parameters: numbers and bounds, their units, and parameters that one cycle cannot
determine.
"""

from __future__ import annotations

import logging
import re
from pathlib import Path

import numpy as np
import pytest

from curvewise.calibration import OutsideModelError, identify
from curvewise.commands import main
from curvewise.commands.command_line import _parser
from curvewise.commands.fit import _in_units
from curvewise.fitting import fit_material
from curvewise.materials import ChabocheVoce, YoshidaUemori
from curvewise.studies import Study, StudyError

STEEL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(STEEL.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0), strict=True))
STRAIN = np.interp(np.arange(361) / 40, range(10), (0.0, *(0.01, -0.01) * 4, 0.01))
TEST = np.column_stack((STRAIN, STEEL.stress(STRAIN, MADE_OF)))


@pytest.fixture
def command(tmp_path: Path) -> list[str]:
    """The command for the test, without the known parameters."""
    np.savetxt(tmp_path / "t.csv", TEST, delimiter=",", header="strain,stress", comments="")
    output = ["--output", str(tmp_path / "out")]
    return ["fit", str(tmp_path / "t.csv"), "--backstresses", "1", *output]


def parsed(*given: str) -> tuple[dict[str, float], dict[str, object]]:
    return _in_units(_parser().parse_args(["fit", "t.csv", *given]))


def test_numbers_and_bounds_may_have_a_unit() -> None:
    given = [
        "--fix",
        "E=206GPa",
        "b=1",
        "yield=-.5e2 N/mm²",
        "--bounds",
        "Q=-10:20",
        "C1=1GPa:90GPa",
    ]
    fixed, bounds = parsed(*given)
    assert fixed == {"E": 206e3, "b": 1.0, "yield": -50.0}
    assert bounds["Q"] == (-10.0, 20.0)
    assert (bounds["C1"].low, bounds["C1"].high) == (1e3, 90e3)
    fixed, bounds = parsed("--fix", "E=206842.71MPa", "b=2", "--units", "ksi")
    assert fixed == {"E": pytest.approx(30e3, rel=1e-6), "b": 2.0}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["--fix", "E"], "expected NAME=VALUE, for example E=206e3 or E=206GPa; got 'E'"),
        (["--fix", "E=206 stones"], "got 'E=206 stones'"),
        (["--fix", "E=1e"], "got 'E=1e'"),
        (["--fix", "E=nan"], "got 'E=nan'"),
        (["--bounds", "Q=0"], "expected NAME=LOW:HIGH, for example Q=0:200; got 'Q=0'"),
        (["--bounds", "Q=0-200"], "got 'Q=0-200'"),
        (["--bounds", "Q=0:1:2"], "got 'Q=0:1:2'"),
    ],
)
def test_what_is_written_otherwise_is_refused(command, capsys, given, message) -> None:
    with pytest.raises(SystemExit) as ended:
        main([*command, *given])
    assert ended.value.code == 2
    assert message in " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["--bounds", "Q=200:0"], "--bounds Q is 200:0; give low below high"),
        (
            ["--bounds", "q=0:200"],
            "bounds has no parameter of the material: 'q'; did you mean 'Q'?",
        ),
        (["--fix", "e=1"], "--fix has no parameter of the material: 'e'; did you mean 'E'?"),
        (
            ["--fix", "Q=1", "--bounds", "Q=0:200"],
            "'Q' is in --fix and in --bounds; give one of them",
        ),
        (["--fix", "E=206"], "E is 206 MPa, and the tests show .* (GPa for MPa?)"),
        (["--fix", "E=29878"], "a factor of 6.8"),
        (["--fix", "E=29878"], "(ksi for MPa?)"),
        (["--bounds", "E=20e6:40e6"], "(psi for MPa?)"),
        (["--fix", "yield=0.31"], "yield is 0.31 MPa, and the largest stress of the tests is 5"),
        (["--fix", "yield=310e6"], "yield is 3.1e+08 MPa, and the largest stress of the tests"),
        (["--bounds", "yield=0.1:0.5"], "yield is 0.5 MPa, and the largest stress"),
    ],
)
def test_wrong_units_and_names_are_asked_about(command, capsys, given, message) -> None:
    assert main([*command, *given]) == 1
    pattern = re.escape(message).replace(r"\.\*", ".*").replace(r"\ ", " ")
    assert re.search(pattern, capsys.readouterr().err)


def test_bounds_that_are_given_are_kept_and_others_read_off(command, capsys) -> None:
    assert main([*command, "--fix", "E=206GPa", "--bounds", "Q=0:40", "b=5:20"]) == 0
    out = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line}
    *_, q = (line.split() for line in out.splitlines() if line.startswith("Q  "))
    assert float(q[1]) <= 40.0
    assert [float(one) for one in q[2:4]] == [0.0, 40.0]  # and not widened to 400
    assert rows["E"]
    fit = fit_material(TEST, STEEL, fixed={"E": 206e3}, bounds={"Q": (50, 120)}, progress=False)
    for name, value in MADE_OF.items():
        assert fit.parameters[name] == pytest.approx(value, rel=0.02), name


def test_a_parameter_that_stays_below_another_may_be_given() -> None:
    sheet = YoshidaUemori()
    bounds = sheet.bounds_from(TEST)
    assert list({**bounds, "Y": (100.0, 300.0)}) == list(sheet.names)
    fit = fit_material(
        TEST, sheet, bounds={"Y": (100.0, 300.0)}, fixed={"E": 206e3}, max_runs=10, progress=False
    )
    assert 100.0 <= fit.parameters["Y"] <= 300.0


def test_one_cycle_proposes_to_fit_its_size_and_does_so(command, capsys) -> None:
    assert main([*command, "--cycles", "last"]) == 0
    out = capsys.readouterr().out
    assert "the last cycle shows the sum of yield and Q alone" in out
    proposed = re.search(r"\((--fix \S+ \S+)\)", out)[1]
    assert proposed == "--fix Q=0 b=1"
    assert main([*command, "--cycles", "last", *proposed.split()]) == 0
    out = capsys.readouterr().out
    assert "the sum of yield and Q alone" not in out
    size = float(next(line.split()[1] for line in out.splitlines() if line.startswith("yield ")))
    path = 2 * 8 * 0.01 * 0.6  # about the plastic strain before the cycle
    assert size == pytest.approx(310.0 + 90.0 * (1.0 - np.exp(-12.0 * path)), abs=12.0)
    assert main([*command, "--fix", "E=206e3"]) == 0
    assert "the sum of yield and Q alone" not in capsys.readouterr().out


def test_refusals_of_a_model_are_bounds(caplog) -> None:
    x = np.linspace(0.0, 1.0, 20)

    def model(p: dict[str, float]) -> np.ndarray:
        if p["a"] + p["b"] < 0.4:
            raise OutsideModelError("a + b must be at least 0.4")
        return np.column_stack((x, p["a"] * x + p["b"] * x**2))

    made = model({"a": 0.3, "b": 0.2})
    bounds = {"a": (-1.0, 1.0), "b": (-1.0, 1.0)}
    with caplog.at_level(logging.DEBUG, logger="curvewise.calibration"):
        found = identify(model, made, bounds, method="de", max_runs=60, progress=False)
    assert found.failures == ()
    assert found.outside == int(found.history.failed.sum()) > 0
    assert f", {found.outside} outside of the model's own bounds" in str(found)
    assert "failed" not in str(found)
    assert not [record for record in caplog.records if "failed" in record.getMessage()]


def test_the_report_says_which_bounds_these_are(tmp_path: Path) -> None:
    fit = fit_material(TEST, STEEL, progress=False)
    assert fit.found.outside > 0
    assert fit.found.failures == ()
    page = fit.write(tmp_path)[1].read_text(encoding="utf-8")
    assert "No evaluation has failed." in page
    assert re.search(r"were outside of the model&#x27;s own bounds, the first: Q is -", page)
    with pytest.raises(OutsideModelError, match="give Q > -yield"):
        fit.model({**MADE_OF, "Q": -400.0})


def test_a_study_checks_units_too(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "t.csv", TEST, delimiter=",", header="strain,stress", comments="")
    text = '[[tests]]\nfile = "t.csv"\n[model]\nmaterial = "chaboche-voce"\n[parameters]\nE = 206\n'
    (tmp_path / "study.toml").write_text(text)
    with pytest.raises(StudyError, match=r"E is 206 MPa, and the tests show .*GPa for MPa"):
        Study.read(tmp_path / "study.toml")
