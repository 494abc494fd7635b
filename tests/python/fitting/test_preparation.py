"""Prepared tests, in Python, by the commands and by studies, and the messages about them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from curvewise import compare, read_curve
from curvewise.commands import main
from curvewise.curves import engineering_to_true, shift_to_origin
from curvewise.fitting import fit_material, prepare
from curvewise.fitting.recorded_cycles import checked_numbers, driven_test, whole_record
from curvewise.materials import ChabocheVoce
from curvewise.studies import Study, StudyError

STEEL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(STEEL.names, (206e3, 310.0, 90.0, 2.0, 90e3, 600.0), strict=True))
KNOWN = {"Q": 90.0, "b": 2.0}
STRAIN = np.interp(np.arange(601) / 200, range(4), (0.0, 0.02, -0.02, 0.02))
NOISE = np.random.default_rng(4).normal(0.0, 1.0, STRAIN.size)
TEST = np.column_stack((STRAIN, STEEL.stress(STRAIN, MADE_OF) + NOISE))
TOE = np.column_stack((STRAIN + 4e-4 * (1.0 - np.exp(-np.arange(601) / 1.5)), TEST[:, 1]))


def engineering(test: np.ndarray) -> np.ndarray:
    strain = np.expm1(test[:, 0])
    return np.column_stack((strain, test[:, 1] / (1.0 + strain)))


def written(file: Path, header: str, columns: np.ndarray) -> Path:
    rows = "".join(";".join(map(repr, row)) + "\n" for row in columns.tolist())
    file.write_text(f"{header}\n{rows}", encoding="utf-8")
    return file


def test_steps_are_those_of_the_functions_in_their_order() -> None:
    moved = TEST + np.array((3e-4, 15.0))
    raw = np.column_stack((25.0 * moved[:, 0], 38.5 * moved[:, 1]))
    done = prepare(raw, area=38.5, gauge_length=25.0, zero=True, toe=(120, 220), true=True)
    begun = shift_to_origin(raw / (25.0, 38.5))
    expected = engineering_to_true(shift_to_origin(begun, elastic=(120, 220), cut=True))
    np.testing.assert_allclose(done.curve, expected, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(done.before, moved, rtol=1e-12)
    assert [step.split()[0] for step in done.steps] == [
        "stress",
        "strain",
        "zero:",
        "toe:",
        "true:",
    ]
    assert "a strain of 0.0003 and a stress of" in str(done)
    assert f"{len(TEST) - len(done)} points before it are left out" in str(done)
    assert done.cycle_numbers is None
    assert prepare(TEST).steps == ()


@pytest.mark.parametrize(
    ("header", "strain", "stress", "options"),
    [
        ("e;F [kN]", 1.0, 38.5e-3, {"area": 38.5}),
        ("dL (mm);F (N)", 12.5, 20.0, {"area": 20, "gauge_length": 12.5}),
        ("dL [µm];F\n;lbf", 50e3, 10 / 4.448222, {"area": 10, "gauge_length": 50}),
        ("e;F", 1.0, 38.5, {"area": 38.5}),
    ],
)
def test_units_of_forces_and_extensions_are_converted(
    tmp_path: Path, header, strain, stress, options
) -> None:
    file = written(tmp_path / "raw.csv", header, TEST * (strain, stress))
    done = prepare(read_curve(file), **options)
    np.testing.assert_allclose(done.curve, TEST, rtol=1e-6)
    assert done.column_names[1] == "stress [MPa]"
    ksi = prepare(read_curve(file), **options, units="ksi").curve[:, 1]
    has_unit = "F;" not in header and not header.endswith("F")
    np.testing.assert_allclose(ksi, TEST[:, 1] / (6.894757 if has_unit else 1.0), rtol=1e-6)


@pytest.mark.parametrize(
    ("header", "options", "message"),
    [
        ("e;s [MPa]", {"area": 20}, r"column 's \[MPa\]' is not a force; leave area out"),
        ("e [%];F", {"gauge_length": 20}, r"column 'e \[%\]' is not a length"),
        ("e;F [N]", {"area": 20, "units": "stone"}, "cannot be converted to 'stone'"),
        ("e;F", {"area": 0}, "area is 0; give the cross section, a number above 0"),
        ("e;F", {"area": np.inf}, "area is inf; give the cross section"),
        ("e;F", {"gauge_length": -1.0}, "gauge_length is -1.0; give a length"),
        ("e;s", {"toe": [100.0]}, "toe has 1 stresses; give two, low and high, or none"),
        ("e;s", {"cycle_numbers": [1, 2]}, r"cycle_numbers has shape \(2,\); the test has 601"),
    ],
)
def test_what_cannot_be_prepared_is_refused(tmp_path: Path, header, options, message) -> None:
    file = written(tmp_path / "raw.csv", header, TEST)
    with pytest.raises(ValueError, match=message):
        prepare(read_curve(file), **options)


def test_fit_says_what_it_did_and_shows_it(tmp_path: Path, capsys) -> None:
    raw = engineering(TOE) * (100.0, 38.5e-3)
    file = written(tmp_path / "raw.csv", "Strain [%];Force [kN]", raw)
    command = ["fit", str(file), "--backstresses", "1", "--fix", "Q=90", "b=2"]
    command += ["--output", str(tmp_path / "out")]
    assert main(command) == 1
    said = capsys.readouterr().err
    assert "give --factors 0.01 1 and give --area, in mm², or --factors 1 1" in said
    command += ["--factors", "%", "1"]
    assert main([*command, "--area", "38.5", "--toe", "--true"]) == 0
    out = capsys.readouterr().out
    for step in ("Preparation of raw.csv", "area of 38.5 mm²", "toe: strains are sh", "true: eng"):
        assert step in out
    page = (tmp_path / "out/report.html").read_text(encoding="utf-8")
    assert page.count("Preparation of raw.csv</h2>") == 1
    assert "area of 38.5 mm²" in page
    figures = json.loads(re.search(r'id="figures">(.*?)</script>', page, re.S)[1])
    before, after = figures[0]["data"]
    assert (before["name"], after["name"]) == ("before", "after")
    assert max(before["x"]) <= 0.01 + before["x"][0]
    assert before["y"][0] == pytest.approx(TOE[0, 1], rel=1e-6)
    assert after["y"][0] > 100.0
    rows = (tmp_path / "out/parameters.csv").read_text(encoding="utf-8").splitlines()
    found = {row.split(",")[0]: float(row.split(",")[2]) for row in rows[1:]}
    assert found["yield"] == pytest.approx(310.0, abs=4.0)
    assert found["E"] == pytest.approx(206e3, rel=0.01)


def test_compare_and_a_study_prepare_as_python_does(tmp_path: Path, capsys) -> None:
    raw = engineering(TEST) * (12.5, 38.5)
    file = written(tmp_path / "raw.csv", "dL [mm];F [N]", raw)
    true = written(tmp_path / "true.csv", "strain;stress", TEST)
    options = ["--area-a", "38.5", "--gauge-length-a", "12.5", "--true-a"]
    assert main(["compare", str(file), str(true), *options, "--json", "--preset", "raw"]) == 0
    loaded = json.loads(capsys.readouterr().out)
    assert loaded["values"]["frechet"] < 1e-9
    assert [len(steps) for steps in loaded["prepared"]] == [3, 0]
    assert main(["compare", str(file), str(true), *options]) == 0
    assert "   strain = dL [mm] / gauge length of 12.5 mm\n" in capsys.readouterr().out

    keys = "area = 38.5\ngauge_length = 12.5\ntrue = true\ntoe = [120, 220]\nzero = false"
    text = f'[[tests]]\nfile = "raw.csv"\n{keys}\n[model]\nmaterial = "chaboche-voce"\n'
    (tmp_path / "study.toml").write_text(f"{text}backstresses = 1\n[parameters]\nQ = 90\nb = 2\n")
    study = Study.read(tmp_path / "study.toml")
    done = prepare(read_curve(file), area=38.5, gauge_length=12.5, toe=(120, 220), true=True)
    np.testing.assert_array_equal(study.tests[0].prepared.curve, done.curve)
    found = study.run(progress=False)
    fit = fit_material(done, STEEL, fixed=KNOWN, progress=False)
    assert found.fit.parameters == fit.parameters
    assert str(found.fit) == str(fit)
    folder = tmp_path / "study_results"
    assert "toe: strains" in (folder / "report.html").read_text(encoding="utf-8")
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    assert result["prepared"] == {"raw": list(done.steps)}


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("area = 0", "area is 0; give a number above 0"),
        ("toe = 120", r"toe is 120; give true, or \[low, high\], two stresses"),
        ("area = 20", r"cannot be used: area is 20, and column 'stress \[MPa\]' is not a force"),
        ('cycle_column = "cycle"', "has no column 'cycle'"),
    ],
)
def test_wrong_keys_of_a_study_are_named(tmp_path: Path, line: str, message: str) -> None:
    written(tmp_path / "test.csv", "strain;stress [MPa]", TEST)
    (tmp_path / "study.toml").write_text(
        f'[[tests]]\nfile = "test.csv"\n{line}\n[model]\nmaterial = "chaboche-voce"\n'
    )
    with pytest.raises(StudyError, match=message):
        Study.read(tmp_path / "study.toml")


def test_a_prepared_test_is_a_curve_and_a_picture() -> None:
    done = prepare(TOE, toe=True)
    assert done.shape == (len(done), 2)
    assert compare(done, done.curve, measures=["frechet"])["frechet"] == 0.0
    assert len(done[::10]) == len(done.curve[::10])
    figure = done.plot()
    before, after = figure.axes[0].lines
    assert before.get_xdata()[0] == TOE[0, 0]
    assert after.get_ydata()[0] == done.curve[0, 1]


# ---- records of some cycles alone

PER_CYCLE = 80
CYCLES = 20
LONG = np.concatenate(
    [[0.0], *[np.interp(np.arange(1, 81) / 20, [0, 1, 3, 4], [0, 6e-3, -6e-3, 0])] * CYCLES]
)
COUNT = np.concatenate(([1], np.repeat(np.arange(1, CYCLES + 1), PER_CYCLE)))
RECORD = np.column_stack((LONG, STEEL.stress(LONG, MADE_OF)))
KEPT = np.isin(COUNT, [1, 2, 5, 10, 20])


def test_the_material_runs_through_cycles_that_are_left_out() -> None:
    done = prepare(RECORD[KEPT], cycle_numbers=COUNT[KEPT])
    assert "5 (1, 2, 5, 10, 20); the 15 that it leaves out" in str(done)
    driven = driven_test(done, "tests[0]", "all", 100_000)
    np.testing.assert_array_equal(driven.path[driven.compared], RECORD[KEPT])
    assert len(driven.path) == KEPT.sum() + 15 * 3
    simulated = STEEL.stress(driven.path[:, 0], MADE_OF)[driven.compared]
    np.testing.assert_allclose(simulated, RECORD[KEPT, 1], rtol=1e-9, atol=1e-6)
    joined = STEEL.stress(RECORD[KEPT, 0], MADE_OF)
    assert np.abs(joined - RECORD[KEPT, 1]).max() > 10.0  # the earlier fit


def test_their_hardening_is_found() -> None:
    done = prepare(RECORD[KEPT], cycle_numbers=COUNT[KEPT])
    fit = fit_material(done, STEEL, fixed={"E": 206e3}, progress=False)
    for name, value in MADE_OF.items():
        assert fit.parameters[name] == pytest.approx(value, rel=0.05), name
    last = driven_test(done, "tests[0]", "last", 300)
    simulated = STEEL.stress(last.path[:, 0], MADE_OF)[last.compared]
    np.testing.assert_allclose(simulated, last.path[last.compared, 1], rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize(("begin", "first"), [(0, 0), (20, 0), (50, 0), (0, 2)])
def test_any_begin_of_a_cycle_will_do(begin: int, first: int) -> None:
    """Cycles are counted from anywhere, from 0 or 1; the first of them may be left out."""
    count = np.concatenate((np.zeros(begin), (np.arange(len(LONG) - begin)) // PER_CYCLE + 1))
    kept = np.isin(count, [0, 1, 2, 9]) & (count >= first)
    done = prepare(RECORD[kept], cycle_numbers=count[kept])
    driven = driven_test(done, "tests[0]", "all", 100_000)
    simulated = STEEL.stress(driven.path[:, 0], MADE_OF)[driven.compared]
    np.testing.assert_allclose(simulated, RECORD[kept, 1], rtol=1e-9, atol=1e-6)


def test_a_whole_record_stays_as_it_is() -> None:
    assert whole_record(RECORD) is RECORD
    done = prepare(RECORD, cycle_numbers=COUNT)
    assert whole_record(done) is done
    assert "the record has all 20 from 1 to 20" in str(done)
    path, compared = driven_test(done, "tests[0]", "all", 100_000)
    assert compared == slice(None)
    np.testing.assert_array_equal(path, RECORD)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ([1, 2, 1], "falls from 2 to 1 at point 2"),
        ([1, np.nan, 2], "negative or not finite"),
        ([-1, 0, 1], "negative or not finite"),
        ([1, 2, 1e6], "leaves out 999,997 cycles, and at most 100,000"),
    ],
)
def test_wrong_numbers_of_cycles_are_refused(numbers, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        checked_numbers(numbers, 3)


def test_a_counter_within_the_cycle_is_read() -> None:
    assert checked_numbers([0.0, 0.5, 0.9999999, 1.0, 1.25, 4.0], 6).tolist() == [0, 0, 1, 1, 1, 4]


def test_a_last_cycle_that_was_not_recorded_is_refused() -> None:
    kept = KEPT & ~((COUNT == 20) & (np.arange(len(COUNT)) > len(COUNT) - 60))
    done = prepare(RECORD[kept], cycle_numbers=COUNT[kept])
    with pytest.raises(ValueError, match=r"tests\[0\]: its last complete cycle was not recorded"):
        driven_test(done, "tests[0]", "last", 300)


def test_fit_and_a_study_take_the_column_of_cycles(tmp_path: Path, capsys) -> None:
    columns = np.column_stack((COUNT, 100.0 * RECORD[:, 0], RECORD[:, 1]))[KEPT]
    file = written(tmp_path / "lcf.csv", "Cycle;Strain (%);Stress (MPa)", columns)
    command = ["fit", str(file), "--columns", "strain", "stress", "--factors", "%", "1"]
    command += ["--cycle-column", "cycle", "--backstresses", "1", "--fix", "E=206e3", "gamma1=600"]
    assert main([*command, "--output", str(tmp_path / "out")]) == 0
    out = capsys.readouterr().out
    assert "the 15 that it leaves out are run through" in out
    assert float(out.split("\nQ ")[1].split()[0]) == pytest.approx(90.0, rel=0.02)
    keys = 'columns = ["strain", "stress"]\nfactors = [0.01, 1]\ncycle_column = "cycle"'
    (tmp_path / "study.toml").write_text(
        f'[[tests]]\nfile = "lcf.csv"\n{keys}\n[model]\nmaterial = "chaboche-voce"\n'
        "backstresses = 1\n[parameters]\nE = 206e3\ngamma1 = 600\n"
    )
    found = Study.read(tmp_path / "study.toml").run(progress=False)
    assert found.fit.parameters["Q"] == pytest.approx(90.0, rel=0.02)
