"""What the commands are told of their files: once for all, for each, or for one of two."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openpyxl
import pytest

from curvewise import read_curve
from curvewise.commands import main
from curvewise.commands.command_line import _parser
from curvewise.commands.reading import said_of_each, said_of_two
from curvewise.files.file_options import READING, Reading
from curvewise.materials import ChabocheVoce, JohnsonCook
from curvewise.studies import Study, StudyError
from curvewise.studies.keys import described
from curvewise.studies.measured_tests import Columns

STEEL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(STEEL.names, (206e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(121) / 40, range(4), (0.0, 0.02, -0.02, 0.02))
LOOP = np.column_stack((STRAIN, STEEL.stress(STRAIN, MADE_OF)))
KNOWN = ("Q=-50", "b=8", "gamma1=400")


def three_files(folder: Path) -> list[str]:
    """Write the loop as text, as text below a table of results, and as a sheet."""
    e, s = LOOP.T
    plain, below, book = (folder / name for name in ("plain.csv", "below.csv", "sheet.xlsx"))
    plain.write_text("Strain;Stress\n" + "".join(f"{x!r};{y!r}\n" for x, y in LOOP.tolist()))
    rows = "".join(f"{i},{x!r},{y!r}\n" for i, (x, y) in enumerate(np.c_[100 * e, s].tolist()))
    below.write_text("Max,Modulus\n1.0,2.0\n\nRecord\nTime,Strain,Stress\n(s),(%),(MPa)\n" + rows)
    workbook = openpyxl.Workbook()
    workbook.active.title = "about"
    sheet = workbook.create_sheet("data")
    sheet.append(["Extension", "Force"])
    for row in np.c_[e, s / 1000.0].tolist():
        sheet.append(row)
    workbook.save(book)
    return list(map(str, (plain, below, book)))


RATES = (1e-3, 1.0, 1e3)
COOK = {"E": 200e3, "A": 350.0, "B": 275.0, "n": 0.36, "C": 0.022}


@pytest.fixture
def pulled(tmp_path: Path) -> list[str]:
    """Write tension tests at three rates of strain."""
    strain = np.linspace(0.0, 0.08, 161)
    files = []
    for rate in RATES:
        stress = JohnsonCook(rate=rate, reference_rate=1e-3).stress(strain, COOK)
        files.append(str(tmp_path / f"at_{rate:g}.csv"))
        np.savetxt(files[-1], np.c_[strain, stress], delimiter=",", header="strain,stress")
    return files


def test_fit_takes_a_rate_for_each_file(tmp_path: Path, pulled: list[str], capsys) -> None:
    said = ["--material", "johnson-cook", "--fix", "E=200e3", "--output", str(tmp_path / "out")]
    rates = [word for rate in RATES for word in ("--rate", str(rate))]
    reference = ["--reference-rate", "1e-3"]
    cards = ["--card", "ls-dyna", "--accept-undetermined"]
    assert main(["fit", *pulled, *said, *rates, *reference, *cards]) == 0
    rows = (tmp_path / "out" / "parameters.csv").read_text().splitlines()[1:]
    found = {name: float(value) for name, _, value, *_ in (row.split(",") for row in rows)}
    assert found == pytest.approx(COOK, rel=1e-3)
    (card,) = (tmp_path / "out").glob("*.k")
    assert "0.001" in card.read_text()
    for given, message in (
        (["--rate", "1", "--rate", "2"], "--rate is given 2 times for 3 files; give it once for"),
        (["--rate", "1", "--material", "swift"], "--rate is an option of johnson-cook; leave it"),
        (["--rate", "-1"], "a rate of strain is -1"),
        ([*reference, "--material", "swift"], "--reference-rate is an option of johnson-cook;"),
    ):
        assert main(["fit", *pulled, *said, *given]) == 1
        assert message in capsys.readouterr().err


def test_a_study_has_a_rate_for_each_test(tmp_path: Path, pulled: list[str]) -> None:
    def study(*lines: str, material: str = "johnson-cook", first: str = "rate = 0.001") -> Study:
        tests = [
            f"[[tests]]\nfile = {Path(file).name!r}\n{line}\n"
            for file, line in zip(pulled, (first, "rate = 1.0", "rate = 1e3"), strict=True)
        ]
        path = tmp_path / "study.toml"
        path.write_text(
            "\n".join([*tests, f"[model]\nmaterial = {material!r}", *lines])
            + '\n[parameters]\nE = 200e3\n[search]\nmeasure = "sum_of_squares"\n'
        )
        return Study.read(path)

    found = study("reference_rate = 1e-3").run(progress=False)
    assert found.fit is not None
    assert found.fit.parameters == pytest.approx(COOK, rel=1e-3)
    for lines, options, message in (
        ((), {"material": "swift"}, "is a rate of strain, and swift has none"),
        ((), {"first": ""}, "needs a rate, because another test has one"),
        ((), {"first": "rate = 0"}, "a number above 0"),
        (("reference_rate = -1",), {}, "a number above 0"),
        (("reference_rate = 1",), {"material": "swift"}, "is no option of swift"),
    ):
        with pytest.raises(StudyError, match=message):
            study(*lines, **options)


def test_fit_takes_an_option_for_each_file(tmp_path: Path, capsys) -> None:
    files = three_files(tmp_path)
    columns = [
        *("--columns", "1", "2"),
        *("--columns", "strain", "STRESS"),
        *("--columns", "1", "2"),
    ]
    factors = ["--factors", "1", "1", "--factors", "%", "MPa", "--factors", "1", "GPa"]
    said = ["--backstresses", "1", "--fix", *KNOWN, "--output", str(tmp_path / "out")]
    assert main(["fit", *files, *columns, *factors, *said, "--from", "Record"]) == 1
    assert "plain.csv has no line that contains 'Record'" in capsys.readouterr().err
    begins = ["--from", "Strain", "--from", "Record", "--from", "Extension"]
    assert main(["fit", *files, *columns, *factors, *said, *begins]) == 1
    assert "the sheets of the workbook are 'about', 'data'" in capsys.readouterr().err
    sheets = ["--sheet", "data"]
    assert main(["fit", *files, *columns, *factors, *said, *begins, *sheets]) == 1
    assert "sheet is 'data', and" in capsys.readouterr().err
    both = files[:2]
    assert main(["fit", *both, *columns[:6], *factors[:6], *said, *begins[:4]]) == 0
    found = capsys.readouterr().out
    assert "E                     206000" in found


def test_options_for_each_are_as_many_as_the_files() -> None:
    parse = _parser().parse_args
    given = parse(["fit", "a", "b", "--columns", "1", "2", "--sheet", "x", "--sheet", "y"])
    first, second = said_of_each(given, 2)
    assert (first.columns, first.reading) == (["1", "2"], Reading(sheet="x"))
    assert (second.columns, second.reading) == (["1", "2"], Reading(sheet="y"))
    with pytest.raises(ValueError, match="--sheet is given 2 times for 3 files; give it once for"):
        said_of_each(given, 3)
    flags = parse(["fit", "a", "b", "--skip-invalid", "--header-row", "3"])
    assert {one.reading for one in said_of_each(flags, 2)} == {
        Reading(skip_invalid=True, header_row=3)
    }


def test_compare_takes_an_option_for_both_or_for_one_of_two() -> None:
    given = ["--columns", "1", "2", "--columns-a", "3", "4", "--until", "Mean", "--decimal-b", ","]
    given += ["--factors", "%", "ksi", "--factors-b", "1", "2", "--skip-invalid-b"]
    a, b = said_of_two(_parser().parse_args(["compare", "a", "b", *given]))
    assert (a.columns, b.columns) == (["3", "4"], ["1", "2"])
    assert a.reading == Reading(until="Mean")
    assert b.reading == Reading(until="Mean", decimal=",", skip_invalid=True)
    assert (a.numbers(), b.numbers()) == ([0.01, 6.894757], [1.0, 2.0])
    assert a.numbers("ksi") == [0.01, 1.0]


def test_compare_reads_each_file_as_it_is_told(tmp_path: Path, capsys) -> None:
    plain, below, book = three_files(tmp_path)
    of_a = ["--columns-a", "strain", "stress", "--from-a", "Record", "--factors-a", "%", "1"]
    of_b = ["--sheet-b", "data", "--factors-b", "1", "GPa"]
    assert (
        main(["compare", below, book, *of_a, *of_b, "--measures", "area", "--preset", "raw"]) == 0
    )
    area = float(capsys.readouterr().out.split("area")[1].split()[0])
    assert area < 1e-9
    assert (
        main(["compare", below, plain, "--columns", "straim", "stress", "--from-a", "Record"]) == 1
    )
    assert "did you mean 'Strain'?" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("header", "said"),
    [
        (
            "Time [s];U [V]",
            "'Time [s]', which seems to be a time, and the stress is in column 'U [V]",
        ),
        ("Zeit;Spannung\ns;V", "seems to be a time, and the stress is in column 'Spannung [V]'"),
        ("Elapsed (s);Load cell (mV)", "'Elapsed (s)', which seems to be a time, and"),
        ("t;F", "the strain is in column 't', which seems to be a time; name others: --columns"),
        ("Strain;Voltage", "--factors 1 F2 with F2 = MPa per volt"),
    ],
)
def test_time_and_voltage_are_asked_about(tmp_path: Path, capsys, header: str, said: str) -> None:
    file = tmp_path / "raw.csv"
    file.write_text(header + "\n" + "".join(f"{x!r};{y!r}\n" for x, y in LOOP.tolist()))
    assert main(["fit", str(file), "--output", str(tmp_path / "out")]) == 1
    assert said in capsys.readouterr().err
    text = f'[[tests]]\nfile = "{file}"\n[model]\nmaterial = "chaboche-voce"\nbackstresses = 1\n'
    (tmp_path / "study.toml").write_text(text)
    with pytest.raises(StudyError, match=r"factors = \[1, (F2|1)\]"):
        Study.read(tmp_path / "study.toml")


def test_a_study_takes_the_same_options(tmp_path: Path) -> None:
    _, below, _ = three_files(tmp_path)
    keys = 'columns = ["strain", "stress"]\nfactors = ["%", 1]\nfrom = "Record"\nencoding = "utf-8"'
    study = f'[[tests]]\nfile = "{below}"\n{keys}\n[model]\nmaterial = "chaboche-voce"\n'
    (tmp_path / "study.toml").write_text(study)
    test = Study.read(tmp_path / "study.toml").tests[0]
    read = read_curve(below, ["strain", "stress"], factors=[0.01, 1], from_="Record")
    np.testing.assert_array_equal(test.experiment, read)
    assert {option.word for option in READING} <= set(described(Columns))
    for right, wrong, message in (
        ('from = "Record"', "header_row = 0", "header_row is 0; give at least 1"),
        (
            'from = "Record"',
            'from = "Record"\nheader_row = 4',
            "cannot be read: from is 'Record' and",
        ),
        (
            '"%", 1',
            '"stone", 1',
            "factors cannot be used: the factor is 'stone'; give a number, or",
        ),
        ('"utf-8"', '"klingon"', "cannot be read: encoding is 'klingon'"),
    ):
        (tmp_path / "study.toml").write_text(study.replace(right, wrong))
        with pytest.raises(StudyError, match=message):
            Study.read(tmp_path / "study.toml")
