"""Raw machine files: thousands separators, quotation marks, long headers, lines below the data."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import openpyxl
import pytest
import scipy.io

from curvewise import read_curve
from curvewise.commands import main
from curvewise.studies import Study


@pytest.fixture
def read(tmp_path: Path):
    """Write a text to loop.csv and read it."""

    def write_and_read(content: str, columns=None, **keywords):
        (tmp_path / "loop.csv").write_text(content, encoding="utf-8")
        return read_curve(tmp_path / "loop.csv", columns, **keywords).tolist()

    return write_and_read


@pytest.fixture
def sheet(tmp_path: Path):
    """Write rows to a workbook and return its name."""

    def written(*rows: list) -> Path:
        book = openpyxl.Workbook()
        for row in rows:
            book.active.append(row)
        book.save(tmp_path / "loop.xlsx")
        return tmp_path / "loop.xlsx"

    return written


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("e;s\n0,5;1.000,5\n1;2.000.000\n", [[0.5, 1000.5], [1, 2e6]]),
        ("e;s\n1.000;100\n0,5;3\n", [[1000, 100], [0.5, 3]]),
        ("e;s;n\n1.000;100;0,5\n2.000;3;1,5\n", [[1000, 100], [2000, 3]]),  # by another column
        ("e;s\n1.000;100\n2.000;3\n", [[1, 100], [2, 3]]),
        ("e;s;at\n1,234;1;12.30\n2,345;2;12.31\n", [[1.234, 1], [2.345, 2]]),
        ("e;s;at\n1.234;1;12.30\n2.345;2;12,31\n", [[1.234, 1], [2.345, 2]]),
        ("e;s\n-1.000,5E+02;+12.345\n", [[-100050, 12345]]),
        ("e;s\n1,234.5;1\n0.5;2\n", [[1234.5, 1], [0.5, 2]]),
        ('e,s\n"0,5","1,25"\n1,"2,5"\n', [[0.5, 1.25], [1, 2.5]]),
        ('"0,5"\n"1,25"\n', [[0.5], [1.25]]),
        ("e,s\n1.5D-03,2d5\n-.5D0,1.D+2\n", [[0.0015, 2e5], [-0.5, 100]]),
        ("e;s\n1,5D-03;2\n", [[0.0015, 2]]),
        ("e,s,,\n1,2,,\n3,4,,\n", [[1, 2], [3, 4]]),
        ("Width;12,5\nThickness;1,5\n\ne;s\n%;N\n0;0\n0,1;1\n", [[0, 0], [0.1, 1]]),
        ("text;x\n" * 250 + "e;s\n0;0\n1;1\n", [[0, 0], [1, 1]]),
        ("e;s\n\u22120,5;\u2013150\n0;1E\u221203\n", [[-0.5, -150], [0, 0.001]]),
        (
            "e;s\n1\u202f000;2'000,5\n1 001;2\u2019010\n500;9\n",
            [[1000, 2000.5], [1001, 2010], [500, 9]],
        ),
        ("1\u00a0000\n2\u2009000\n", [[1000], [2000]]),
        ("0.5,1 250\n0.6,2 250\n", [[0.5, 1250], [0.6, 2250]]),
        ("a,b\n1\u00a0000,2\n", [[1000, 2]]),
        ("a b\n1 000\n2 500\n", [[1, 0], [2, 500]]),
        ('"sep=|"\na|b\n1|2\n', [[1, 2]]),
        ("Red,,Blue,\nX,Y,X,Y\n0,1,.5,10\n1,2,,\n2,4,,\n", [[0, 1], [1, 2], [2, 4]]),
    ],
)
def test_numbers_of_machines_are_read(read, content, expected) -> None:
    assert read(content) == expected


def test_numbers_of_columns_say_what_blanks_separate(read) -> None:
    content = "1 250.5\n2 251.5\n3 249\n"
    with pytest.raises(ValueError, match=r"or give columns=\[1, 2\] if they are cells"):
        read(content)
    assert read(content, [1, 2]) == [[1, 250.5], [2, 251.5], [3, 249]]
    assert read("0 0\n" + content) == [[0, 0], [1, 250.5], [2, 251.5], [3, 249]]


def test_the_names_asked_for_choose_the_table(read) -> None:
    content = "Load;Modulus\n20,81;205432\n\nRaw data\nStrain;Stress\n%;MPa\n0;1\n2;3\n"
    assert read(content, ["Strain", "Stress"]) == [[0, 1], [2, 3]]
    with pytest.raises(
        ValueError, match="line 5: 'Strain, Stress' seems to be the header of a sec"
    ):
        read(content, skip_invalid=True)
    assert read(content, ["Modulus"], until="Raw data") == [[205432]]


def test_a_curve_beside_a_longer_one_ends_before_it(read, sheet) -> None:
    rows = [["x", "y", "x", "y"], [0, 1, 0.5, 10], [1, 2, 1.5, 20], [2, 4, "", ""], [3, 8, "", ""]]
    text = "\n".join(",".join(map(str, row)) for row in rows)
    assert read(text, [3, 4]) == [[0.5, 10], [1.5, 20]]
    book = sheet(*([cell if cell != "" else None for cell in row] for row in rows))
    assert read_curve(book, [3, 4]).tolist() == [[0.5, 10], [1.5, 20]]
    rows[2][2:] = "", ""
    rows[4][2:] = 2.5, 30
    text = "\n".join(",".join(map(str, row)) for row in rows)
    with pytest.raises(ValueError, match=r"line 3, column 3 \(x\): the cell is missing"):
        read(text, [3, 4])
    with pytest.warns(UserWarning, match="2 of 4 lines left out, .* the first is line 3"):
        assert read(text, [3, 4], skip_invalid=True) == [[0.5, 10], [2.5, 30]]
    book = sheet(*([cell if cell != "" else None for cell in row] for row in rows))
    with pytest.raises(ValueError, match=r"row 3, column 3 \(x\): the cell is missing"):
        read_curve(book, [3, 4])


def test_dashes_and_apostrophes_of_windows_are_read(tmp_path: Path) -> None:
    file = tmp_path / "loop.csv"
    file.write_bytes("e;s\n–0,5;1’250\n0;1\n".encode("cp1252"))
    assert read_curve(file).tolist() == [[-0.5, 1250], [0, 1]]
    file.write_bytes(b"e\x81\xe9;s\n0;1\n")
    assert read_curve(file, ["e\x81\xe9"]).tolist() == [[0]]


def test_the_names_asked_for_choose_the_line_of_a_header(read) -> None:
    content = "Operator;Smith;7a\nGauge;50\nDate;today\nstrain;stress\n%;MPa\n0;1\n2;3\n"
    assert read(content, ["stress", "strain"]) == [[1, 0], [3, 2]]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("e,s\n0,000009,8,760\n0,1,9,1\n", "line 2 has 4 cells, and 2 are expected by the lines a"),
        ("e;s\n1;2;3\n", r"line 2 has 3 cells, and 2 are .*no header with #"),
        ('e,s\n"1,234",1\n', r"'1,234' may be 1\.234 or 1234; say which is the decimal sign \(dec"),
        ("e;s\n1,234;5.678\n", "line 2 has a number with a comma and line 2 one with a point; use"),
        ("e;s\n0,5;1.00\n", "a number with a comma and line 2 one with a point"),
        ("e;s\n1.000.000;1\n0.5;2\n", r"'0\.5' has another decimal sign than a number above"),
        ("e;s\n1;2\nMean;3\n", r"line 3, .*correct it, end the curve before it \(until\), or lea"),
        ("5 mm\n6 mm,\n", "'mm' is not a number"),
        ("a;1;x\nb;n/a;x\nc;2;7\n", "line 1, column 1: 'a' is not a number"),
        ("a1,b2\nx3,y4\n", "no line is made of numbers; the first with a digit is line 1, 'a1,b2'"),
        ("e;s\n0,1 %;10 MPa\n0,2;20\n", "line 2, column 1 .*'0,1 %' is not a number; correct it"),
        ("e;s\n(5);(10)\n0,2;20\n", r"line 2, column 1 .*'\(5\)' is not a number"),
        ("e;s\nn/a;n/a\n0,2;20\n", "line 2, column 1 .*'n/a' is not a number"),
        (
            "1\u00a0000,2\n2\u00a0000,3\n",
            "line 1: the commas of '1.*,2' may separate cells or stand in",
        ),
        ("1 000,5\n2 000,5\n", "line 1: the blanks of '1 000,5' may stand between thousands or"),
        ("0,05,1,25\n0,10,2,50\n", "the commas of '0,05,1,25' may .*say which is the decimal sign"),
        ("force\n0,5\n0,6\n", "line 2: the commas of '0,5' may separate cells or stand in numbers"),
        (
            "a,b\n5,6\n\ne,s\n0,1\n",
            "line 4: 'e, s' seems to be the header of a second table; begin",
        ),
        ("e;s\n0;1\n;\n1;\n", r"line 4, column 2 \(s\): the cell is missing"),
        ('"5 mm"\n', "no line is made of numbers; the first with a digit is line 1, '\"5 mm\"'"),
    ],
)
def test_what_is_refused_says_what_to_do(read, content, message) -> None:
    with pytest.raises(ValueError, match=message):
        read(content)


def test_the_decimal_sign_can_be_given(read) -> None:
    quoted = 'e,s\n"1,234",1\n"2,345",2\n'
    assert read(quoted, decimal=",") == [[1.234, 1], [2.345, 2]]
    assert read(quoted, decimal=".") == [[1234, 1], [2345, 2]]
    assert read("1,5\n2,5\n", decimal=",") == [[1.5], [2.5]]
    assert read("1.000;2\n", decimal=",") == [[1000, 2]]
    assert read("0.5;1\n0.6;1,234\n", decimal=".") == [[0.5, 1], [0.6, 1234]]
    with pytest.raises(ValueError, match=r"'0\.5' is not a number"):
        read("0.5;1\n", decimal=",")
    with pytest.raises(ValueError, match="decimal is ';'; choose from"):
        read("1;2\n", decimal=";")


def test_a_curve_ends_before_the_row_that_is_named(read) -> None:
    content = "Mean of 2\ne;s\n0;1\n1;2\nMean;1,5;9;9;9\ne;s\n7;8\n"
    assert read(content, until="Mean") == [[0, 1], [1, 2]]
    assert read("e;s\n0;1\n1;2\n", until="Mean") == [[0, 1], [1, 2]]
    assert read("e;s\n0;1\n\n# Cycle 2\n1;2\n", until="Cycle 2") == [[0, 1]]
    with pytest.raises(ValueError, match="until is empty; give a text"):
        read(content, until="")


def test_rows_that_are_not_numbers_are_left_out_and_counted(read) -> None:
    content = "e;s\n0;1\ne;s\n%;MPa\n1;nan\n2;\n3;4\nMean;1;9;9\n"
    with pytest.warns(UserWarning, match="4 of 6 lines left out, not made of .* is line 3") as said:
        assert read(content, skip_invalid=True) == [[0, 1], [3, 4]]
    assert len(said) == 1
    assert read("0;1\n1;2\n", skip_invalid=True) == [[0, 1], [1, 2]]
    with pytest.raises(ValueError, match="no line of 2 consists of finite numbers"):
        read("e;s\n1;a\n2;a\n", skip_invalid=True)
    with pytest.raises(ValueError, match="line 3 has 3 cells"):  # may be a decimal comma
        read("e,s\n0,1\n0,5,1\n", skip_invalid=True)
    with pytest.raises(ValueError, match="use one decimal sign"):
        read("0,5;1\n0.6;1\n", skip_invalid=True)


def test_a_sheet_is_read_by_the_same_options(sheet) -> None:
    rows = (["e", "s"], [0, "1.000,5"], ["0,5", "-"], [1, 2], ["Mean", 3])
    file = sheet(*rows)
    with pytest.warns(UserWarning, match=r"'Sheet': 1 of 3 rows left out, .* first is row 3"):
        values = read_curve(file, until="Mean", skip_invalid=True)
    assert values.tolist() == [[0, 1000.5], [1, 2]]
    assert read_curve(sheet(["e", "s"], ["0,5", "1"], ["1", "2"])).tolist() == [[0.5, 1], [1, 2]]
    with pytest.raises(ValueError, match=r"row 2, column 1 .*: '1,3 %' is not a number"):
        read_curve(sheet(["e", "s"], ["1,3 %", -0.9], ["2,0", "0,5"], [-1.9, 0.9]))
    with pytest.raises(ValueError, match=r"row 2, column 1 .*: '0,1 MPa' is not a number"):
        read_curve(sheet(["e", "s"], ["0,1 MPa", "0,2"], [1, 2]))
    assert read_curve(sheet(["e", "s"], ["\u22120,1", "1 000"], [1, 2])).tolist()[0] == [-0.1, 1000]
    with pytest.raises(ValueError, match=r"no row is made of numbers; .* is row 2, '5 mm'"):
        read_curve(sheet(["e"], ["5 mm"]))


def test_formulas_that_nobody_has_computed_are_no_empty_cells(sheet) -> None:
    for rows in (
        (["e", "s"], [0, 1], [1, 2], ["=A2+2", "=B2*3"]),
        (["e", "s"], [0, "=A2*2"], [1, "=A3*2"]),
        (["e", "s"], ["=1+1", "=2+2"], [1, 2]),
    ):
        with pytest.raises(ValueError, match=r"column \d \([es]\): '=.*' is not a number; correct"):
            read_curve(sheet(*rows))
    computed = sheet(["e", "s", "sum"], [0, 1, "=A2+B2"], [1, 2, "=A3+B3"])
    assert read_curve(computed).tolist() == [[0, 1], [1, 2]]


def test_rows_of_matlab_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    file = tmp_path / "loop.mat"
    scipy.io.savemat(file, {"e": np.array([0, np.nan, 2]), "s": np.array([1, 2, 3])})
    with pytest.warns(UserWarning, match="1 of 3 rows left out, not made of .* first is row 2"):
        assert read_curve(file, ["e", "s"], skip_invalid=True).tolist() == [[0, 1], [2, 3]]


def test_the_command_line_has_the_options(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("A.csv").write_text('e,s\n"1,000","0"\n-,-\n"2,500",1\n"3,000",3\nMean,2\n')
    Path("B.csv").write_text("e;s\n1000;0\n2500;1\n3000;3\nMean;5\n")
    command = ["compare", "A.csv", "B.csv", "--json", "--measures", "dtw"]
    options = ["--decimal", ".", "--until", "Mean", "--skip-invalid"]
    assert main([*command, *options]) == 0
    done = capsys.readouterr()
    assert json.loads(done.out)["values"] == {"dtw": 0.0}
    said = "A.csv: 1 of 4 lines left out, not made of finite numbers; the first is line 3"
    assert done.err == f"curvewise: {said}\n"
    assert main([*command, *options, "--decimal", ",", "--decimal-b", "."]) == 0
    assert json.loads(capsys.readouterr().out)["values"]["dtw"] > 0


def test_a_study_has_the_options(tmp_path: Path) -> None:
    (tmp_path / "test.csv").write_text('e,s\n"1,000",0\n-,-\n"2,500",1\nMean,2\n')
    (tmp_path / "deck.inp").write_text("<<a>>\n")
    (tmp_path / "study.toml").write_text(
        '[[tests]]\nfile = "test.csv"\ndecimal = "."\nuntil = "Mean"\nskip_invalid = true\n'
        '[tests.output]\nfile = "out.csv"\n[parameters]\na = [0, 1]\n'
        '[model]\ncommand = ["true"]\ntemplates = "deck.inp"\ntimeout = 9\n'
        '[search]\nmeasure = "dtw"\n'
    )
    with pytest.warns(UserWarning, match="1 of 3 lines left out"):
        study = Study.read(tmp_path / "study.toml")
    assert study.tests[0].experiment.tolist() == [[1000, 0], [2500, 1]]
