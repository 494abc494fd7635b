"""Units of tests that are fitted: what names, rows of units and moduli say of them is asked about.

The same test is written in many units: it is fitted as it was, or there is a question with the
factors that make it so.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from curvewise import read_curve
from curvewise.commands import main
from curvewise.files.column_units import unit_of
from curvewise.fitting import UnitsWarning, fit_material
from curvewise.fitting.units_of_tests import doubt_of, warn_of_units
from curvewise.materials import ChabocheVoce
from curvewise.studies import Study, StudyError

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (206e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(121) / 40, range(4), (0.0, 0.02, -0.02, 0.02))
LOOP = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF)))

STRAINS = {"": 1.0, "-": 1.0, "mm/mm": 1.0, "%": 1e-2, "mm/m": 1e-3, "µm/m": 1e-6, "μm/m": 1e-6}
STRESSES = {"": 1.0, "MPa": 1.0, "N/mm²": 1.0, "Pa": 1e-6, "kPa": 1e-3, "GPa": 1e3, "ksi": 6.894757}
HEADERS = (
    "strain [{}];stress [{}]\n",
    "strain ({});stress ({})\n",
    "strain;stress\n{};{}\n",
    "strain;stress\n[{}];[{}]\n",
    "Test 1\n\nstrain;stress\n({});({})\n\n",
)


def written(file: Path, header: str, strain: str, stress: str) -> Path:
    """Write the loop in these units, as a text or as a sheet."""
    points = LOOP / (STRAINS[strain], STRESSES[stress])
    lines = header.format(strain, stress).splitlines()
    if file.suffix == ".xlsx":
        book = openpyxl.Workbook()
        for row in [*(line.split(";") for line in lines), *points.tolist()]:
            book.active.append(row)
        book.save(file)
    else:
        rows = [f"{x!r};{y!r}" for x, y in points.tolist()]
        file.write_text("\n".join([*lines, *rows]), encoding="utf-8")
    return file


@pytest.mark.parametrize("header", HEADERS)
@pytest.mark.parametrize("ending", ["csv", pytest.param("xlsx", marks=pytest.mark.nightly)])
def test_units_of_names_and_of_rows_are_asked_about(tmp_path: Path, header, ending) -> None:
    for strain, in_strain in STRAINS.items():
        for stress, in_mpa in STRESSES.items():
            test = read_curve(written(tmp_path / f"loop.{ending}", header, strain, stress))
            doubt = doubt_of(test, "MPa")
            if in_strain == in_mpa == 1.0:
                assert doubt is None, (strain, stress)
            else:
                factors = [float(factor) for factor in doubt.factors]
                assert factors == pytest.approx([in_strain, in_mpa], rel=1e-6), (strain, stress)


@pytest.mark.parametrize(
    ("factors", "units", "expected"),
    [
        ((1, 1), "MPa", None),
        ((1, 1e6), "Pa", None),
        ((1, 0.145), "ksi", None),
        ((1, 1e6), "of a scale", None),
        ((1, 0.02), "MPa", None),  # a polymer's
        ((1e6, 1), "MPa", ("1e-06", "1", "as it would be with strains in µm/m")),
        ((1, 1e6), "MPa", ("1", "1e-06", "as it would be with stresses in Pa")),
        ((1, 1e-3), "MPa", ("1", "1000", "stresses in GPa or kN/mm² or strains in mm/m")),
        ((1, 1), "Pa", ("1", "1000000", "as it would be with stresses in MPa")),
        ((1, 1e-15), "MPa", ("F1", "F2", "outside 1 to 1,000 GPa")),
    ],
)
def test_a_modulus_that_no_usual_material_has_is_asked_about(factors, units, expected) -> None:
    doubt = doubt_of(LOOP * factors, units)
    if expected is None:
        assert doubt is None
    else:
        assert doubt.factors == expected[:2]
        assert expected[2] in doubt.found


def test_what_is_no_test_is_refused_elsewhere() -> None:
    assert doubt_of([[0.0, 1.0, 2.0]], "MPa") is None
    assert doubt_of(np.zeros((5, 2)), "MPa") is None


@pytest.fixture
def fitted(monkeypatch: pytest.MonkeyPatch) -> list[np.ndarray]:
    """The tests that the command would fit, instead of the search."""
    found: list[np.ndarray] = []

    def fit(tests: list[np.ndarray], *_: object, units: str, **__: object) -> None:
        warn_of_units(tests, units)
        found.extend(tests)
        raise ValueError("fitted")

    monkeypatch.setattr("curvewise.fitting.fit_material", fit)
    return found


def test_the_command_asks_with_the_option_that_answers(tmp_path: Path, capsys, fitted) -> None:
    file = str(written(tmp_path / "loop.csv", HEADERS[2], "%", "kPa"))
    assert main(["fit", file]) == 1
    said = capsys.readouterr().err
    assert f"curvewise: {file}: the strain is in column 'strain [%]', which seems to be in " in said
    found = re.search(r"give --factors (\S+) (\S+), or --factors 1 1 if its units are right", said)
    assert not fitted
    main(["fit", file, "--factors", *found.groups()])
    assert capsys.readouterr().err == "curvewise: fitted\n"
    np.testing.assert_allclose(fitted[0], LOOP)


def test_a_force_needs_an_area_and_an_extension_a_length(tmp_path: Path, capsys) -> None:
    file = tmp_path / "loop.csv"
    np.savetxt(file, LOOP * (50.0, 0.0385), delimiter=";", header="%;kN", comments="")
    file.write_text("Extension;Force\nmm;kN\n" + file.read_text().split("\n", 1)[1])
    assert main(["fit", str(file), "--output", str(tmp_path / "out")]) == 1
    said = capsys.readouterr().err
    assert "'Extension [mm]', which seems to be a length, and the stress is in column" in said
    assert "'Force [kN]', which seems to be a force; give --gauge-length, in mm and give" in said
    assert "--area, in mm², or --factors 1 1 if its units are right" in said


def test_a_soft_material_is_fitted_if_its_units_are_said_to_be_right(
    tmp_path: Path, capsys, fitted
) -> None:
    file = tmp_path / "rubber.csv"
    np.savetxt(file, LOOP * (1.0, 1e-4), delimiter=",", header="strain,stress", comments="")
    assert main(["fit", str(file)]) == 1
    assert "or --factors 1 1 if its units are right" in capsys.readouterr().err
    main(["fit", str(file), "--factors", "1", "1"])
    assert capsys.readouterr().err == "curvewise: fitted\n"
    np.testing.assert_allclose(fitted[0], LOOP * (1.0, 1e-4))


def test_python_is_warned(tmp_path: Path) -> None:
    test = read_curve(written(tmp_path / "loop.csv", HEADERS[2], "mm/m", "MPa"))
    with (
        pytest.warns(UnitsWarning, match=r"loop.csv: the strain is in column 'strain \[mm/m\]'"),
        pytest.raises(ValueError, match="strains of up to 20"),
    ):
        fit_material([LOOP, test], MATERIAL, progress=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fit = fit_material(test * (1e-3, 1.0), MATERIAL, max_runs=3, progress=False)
    assert fit.modulus_read == pytest.approx(206e3, rel=1e-3)


STUDY = """\
[[tests]]
file = "loop.csv"
{}
[model]
material = "chaboche-voce"
"""


def test_a_study_asks_with_the_key_that_answers(tmp_path: Path) -> None:
    written(tmp_path / "loop.csv", HEADERS[0], "µm/m", "MPa")
    file = tmp_path / "study.toml"
    file.write_text(STUDY.format(""))
    with pytest.raises(
        StudyError, match=r"line 1: tests\[1\] the strain is in column 'strain \[µm/m\]"
    ) as caught:
        Study.read(file)
    found = re.search(r"give (factors = \[1e-06, 1\]), or factors = \[1, 1\]", str(caught.value))
    file.write_text(STUDY.format(found[1]))
    assert Study.read(file).material.modulus_read == pytest.approx(206e3, rel=1e-3)
    formulas = 'columns = { e = 1, s = 2 }\nx = "e / 1e6"\ny = "s"'
    file.write_text(STUDY.format(formulas))
    assert Study.read(file).material.modulus_read == pytest.approx(206e3, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("Strain (%)", "%"),
        ("strain_percent", "percent"),
        ("stress_MPa", "mpa"),
        ("Spannung [N/mm²]", "n/mm2"),
        ("Force / kN", "kn"),
        ("sigma, GPa", "gpa"),
        ("Kraft in kN", "kn"),
        ("microstrain", "microstrain"),
        ("N", ""),
        ("Channel N", ""),
        ("strain (true)", ""),
        ("stress min", ""),
        ("strain (%) × 0.01", ""),
    ],
)
def test_units_are_told_from_names(name: str, unit: str) -> None:
    assert unit_of(name) == unit


def test_a_row_of_units_is_on_the_axes(tmp_path: Path) -> None:
    file = tmp_path / "loop.csv"
    file.write_text("time;strain;force\n(s);%;kN\n0;1;2\n1;2;3\n")
    assert read_curve(file, ["strain", "force"]).column_names == ("strain [%]", "force [kN]")
    changed = read_curve(file, ["strain", "force"], factors=[0.01, 1])
    assert changed.column_names == ("strain [%] × 0.01", "force [kN]")
    file.write_text("strain;force\nsteel;S355\n0;1\n")
    assert read_curve(file).column_names == ("strain", "force")
