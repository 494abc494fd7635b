"""Tests that do not begin at zero strain and stress, or with a toe: reported, with a remedy."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from curvewise import read_curve
from curvewise.commands import main
from curvewise.curves import shift_to_origin
from curvewise.fitting import BeginningWarning, fit_material
from curvewise.fitting.beginnings import check_beginnings, cut_toe
from curvewise.materials import ChabocheVoce

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
KNOWN = {name: MADE_OF[name] for name in ("E", "Q", "b", "C1", "gamma1")}
POINTS = 300
STRAIN = np.interp(np.arange(3 * POINTS + 1) / POINTS, range(4), (0.0, 0.02, -0.02, 0.02))
CLEAN = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF)))
TEST = CLEAN + np.random.default_rng(3).normal(0.0, 1.0, CLEAN.shape) * (5e-6, 2.0)
OFFSETS = [(2e-4, 0.0), (-5e-4, 0.0), (1e-3, 0.0), (0.0, 60.0), (0.0, -60.0), (0.02, 0.0)]
SMALL = [(6e-5, 0.0), (-1e-4, 0.0), (0.0, 15.0), (0.0, -20.0)]


def moved(test: np.ndarray, strain: float, stress: float) -> np.ndarray:
    """Return a test whose strain and stress were not zeroed."""
    return test + np.array([strain, stress])


def with_toe(test: np.ndarray, slack: float = 5e-4, points: float = 3.0) -> np.ndarray:
    """Return a test whose specimen takes up slack in its first points."""
    late = slack * (1.0 - np.exp(-np.arange(len(test)) / points))
    return test + late[:, np.newaxis] * (np.sign(test[POINTS // 2, 0]), 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_begins_at_zero_is_not_spoken_of(sign: float) -> None:
    for test in (CLEAN, TEST, CLEAN[5:], CLEAN[POINTS:], CLEAN[: POINTS // 2 + 60]):
        assert check_beginnings([sign * test], "MPa") == ""
    rough = CLEAN + np.random.default_rng(2).normal(0.0, 1.0, CLEAN.shape) * (1e-4, 20.0)
    assert check_beginnings([sign * rough], "MPa") == ""


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("offset", OFFSETS)
def test_an_offset_is_refused_and_the_remedy_removes_it(offset, sign: float) -> None:
    test = moved(sign * TEST, *offset)
    seen = f"at a strain of {test[0, 0]:.4g} and a stress of {test[0, 1]:.4g} ksi, a strain of"
    with pytest.raises(ValueError, match=r"tests\[1\] does not begin at zero: ") as refusal:
        check_beginnings([TEST, test], "ksi")
    assert seen in str(refusal.value)
    assert "--zero" in str(refusal.value)
    assert "shift_to_origin(test)" in str(refusal.value)
    assert check_beginnings([shift_to_origin(test)], "MPa") == ""


@pytest.mark.parametrize("offset", SMALL)
def test_a_small_offset_is_spoken_of(offset) -> None:
    said = check_beginnings([TEST, moved(TEST, *offset)], "MPa")
    assert said.startswith("The first points of tests[1] are beside the elastic line through zero")
    assert "--zero" in said


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("shift", [0.0, 3e-4])
def test_a_toe_is_refused_and_the_remedy_cuts_it(sign: float, shift: float) -> None:
    test = moved(with_toe(sign * TEST), sign * shift, 0.0)
    with pytest.raises(ValueError, match=r"tests\[0\] begins with a toe: ") as refusal:
        check_beginnings([test], "MPa")
    assert "--toe" in str(refusal.value)
    remedy = re.search(r"Python: (.*)\)$", str(refusal.value))
    assert remedy is not None
    for made in (
        cut_toe(test),
        eval(remedy[1], {"shift_to_origin": shift_to_origin, "test": test}),
    ):
        assert check_beginnings([made], "MPa") == ""
        np.testing.assert_allclose(made[-POINTS:], sign * TEST[-POINTS:], rtol=0.0, atol=5e-5)
    assert "may begin with a toe" in check_beginnings([with_toe(sign * TEST, 2e-4)], "MPa")
    # The straight part points at zero, but the toe is still there.
    with pytest.raises(ValueError, match="begins with a toe"):
        check_beginnings([sign * shift_to_origin(sign * test, elastic=(120, 220))], "MPa")


def test_part_of_a_longer_test_begins_with_a_turn_or_is_refused() -> None:
    assert check_beginnings([CLEAN[2 * POINTS :]], "MPa") == ""
    with pytest.raises(ValueError, match="to which no loading from zero strain and stress leads"):
        check_beginnings([CLEAN[POINTS + 100 :]], "MPa")
    with pytest.raises(ValueError, match="to which no loading from zero strain and stress leads"):
        check_beginnings([moved(CLEAN[POINTS:], -CLEAN[POINTS, 0], 0.0)], "MPa")
    fit = fit_material(  # its beginning is not compared
        moved(CLEAN[POINTS // 2 :], -1e-3, 0.0),
        MATERIAL,
        cycles="last",
        fixed=KNOWN,
        max_runs=2,
        progress=False,
    )
    assert fit.beginning == ""


def test_measured_loops_are_fitted_as_they_are(data_dir: Path) -> None:
    files = [*data_dir.glob("loops/*_tct_*"), *data_dir.glob("cyclic/eddq*")]
    files += data_dir.glob("paper/test/*.csv")
    assert len(files) > 12
    check_beginnings([read_curve(file) for file in files], "MPa")
    names = [*data_dir.glob("loops/resslab*"), *data_dir.glob("cyclic/resslab*")]
    check_beginnings([read_curve(file, ["e_true", "Sigma_true"]) for file in names], "MPa")
    machine = read_curve(data_dir / "cyclic/lcf_machine_3cycles.csv", ["Strain 1 (%)", "Stress"])
    check_beginnings([machine * (0.01, 1.0)], "MPa")


def test_the_fit_warns_or_reports() -> None:
    test = moved(TEST, 2e-4, 0.0)
    with pytest.warns(BeginningWarning, match="does not begin at zero") as warned:
        fit = fit_material(test, MATERIAL, fixed=KNOWN, max_runs=5, progress=False)
    assert warned[0].filename == __file__
    assert str(warned[0].message) in str(fit)
    fit = fit_material(moved(TEST, 0.0, -20.0), MATERIAL, fixed=KNOWN, max_runs=5, progress=False)
    assert "first points of tests[0] are beside the elastic line" in str(fit)


def test_an_offset_is_a_doubt_of_the_verdict_and_the_report(tmp_path: Path) -> None:
    test = moved(TEST, 0.0, -20.0)
    fit = fit_material(test, MATERIAL, fixed=KNOWN, max_runs=5, progress=False)
    assert fit.doubts[0].names == ()
    check, use = fit.verdict.lines[1:3]
    assert check.startswith("Check first: The first points of tests[0]")
    assert "--zero" in check
    assert use.startswith("Use, once this is settled: ")
    assert str(fit).count("beside the elastic line") == 1
    _, report, _ = fit.write(tmp_path)
    assert "Check first" in report.read_text(encoding="utf-8")
    right = fit_material(TEST, MATERIAL, fixed=KNOWN, max_runs=5, progress=False)
    assert not any(line.startswith("Check first") for line in right.verdict.lines)


@pytest.mark.nightly("flags0|flags1")
@pytest.mark.parametrize(
    ("test", "flags"),
    [
        (moved(TEST, 5e-4, -20.0), ["--zero"]),
        (with_toe(TEST), ["--toe"]),
        (moved(with_toe(TEST), 0.0, 40.0), ["--zero", "--toe", "120", "220"]),
    ],
)
def test_the_command_has_the_remedies(test, flags, tmp_path: Path, capsys) -> None:
    file = tmp_path / "loop.csv"
    np.savetxt(file, test, delimiter=",", header="strain,stress", comments="")
    command = ["fit", str(file), "--backstresses", "1", "--fix", "Q=-50", "b=8"]
    command += ["--output", str(tmp_path)]
    assert main(command) == 1
    asked = capsys.readouterr().err
    assert flags[0] in asked or flags[0] == "--zero"
    assert "(--no-zero)" in asked
    assert main([*command, *flags]) == 0
    rows = (tmp_path / "parameters.csv").read_text(encoding="utf-8").splitlines()[1:]
    for name, _, _, low, high, *_ in (row.split(",") for row in rows):
        if not low:  # given
            continue
        middle, half = 0.5 * (float(low) + float(high)), 0.5 * (float(high) - float(low))
        assert abs(MADE_OF[name] - middle) < 2.0 * half, name
    if flags == ["--zero"]:
        assert main([*command, "--no-zero"]) == 0
    assert main([*command, "--toe", "120"]) == 1
    assert "toe has 1 stresses; give two, low and high, or none" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fixed": {"E": 206.0}}, "E is 206 MPa, and the tests show a modulus of .* a factor of 9"),
        ({"fixed": {"E": 206e6}}, r"a factor of 1\d\d\d; give it .*kPa for MPa\?"),
        ({"fixed": {"E": 1.4}}, r"other units\?"),
        ({"bounds": {"E": (100.0, 300.0)}}, "E is 300 MPa, and the tests show"),
    ],
)
def test_a_modulus_in_another_unit_is_asked_about(options, message) -> None:
    if "bounds" in options:
        options = {"bounds": {**MATERIAL.bounds_from(TEST), **options["bounds"]}}
    with pytest.raises(ValueError, match=message):
        fit_material(TEST, MATERIAL, progress=False, **options)


def test_parameters_that_move_no_stress_are_refused_in_words(monkeypatch) -> None:
    monkeypatch.setattr("curvewise.fitting.material_fit.check_units", lambda *_: None)
    with pytest.raises(ValueError, match="no parameter that is searched for moves the stress"):
        fit_material(TEST, MATERIAL, fixed={"E": 1.0}, max_runs=5, progress=False)
    elastic = {"E": 200e3, "yield": 1e6}
    with pytest.raises(ValueError, match=r"\(Q, b, C1, gamma1\).* check E, yield"):
        fit_material(TEST, MATERIAL, fixed=elastic, max_runs=5, progress=False)
