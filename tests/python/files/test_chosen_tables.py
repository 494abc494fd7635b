"""Which table of a file is read, under which names of columns, and in which encoding."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from curvewise import read_curve
from curvewise.files.column_choice import TimeColumnWarning
from curvewise.files.column_units import factor_of

# What a machine puts above its record: names and a row of numbers, then the record with units.
RESULTS = """"Operator","A. N. Other"
"Gauge length","50","mm"

"Results"
"","Maximum force","Modulus"
"","(kN)","(MPa)"
"1","12.5","70000"

"Record"
"Time","Force","Strain 1","Stress"
"(sec)","(kN)","(%)","(MPa)"
"0.0","0.0","0.0","0.5"
"0.1","0.1","0.1","70.5"
"0.2","0.2","0.2","140.5"
"""
RECORD = [[0.0, 0.5], [0.1, 70.5], [0.2, 140.5]]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "record.csv"
    path.write_text(RESULTS, encoding="utf-8")
    return path


def as_workbook(path: Path, text: str = RESULTS, title: str = "record") -> Path:
    """Write the cells of a text into the second of two sheets."""
    book = openpyxl.Workbook()
    book.active.title = "about"
    book.active.append(["a note"])
    sheet = book.create_sheet(title)
    for line in text.splitlines():
        cells = [cell.strip('"') for cell in line.split(",")]
        sheet.append([float(c) if re.fullmatch(r"[\d.]+", c) else c or None for c in cells])
    book.save(path)
    return path


@pytest.mark.parametrize("begin", [{"from_": "Record"}, {"from_": "Time"}, {"header_row": 10}])
def test_a_table_below_the_results_is_read(file: Path, tmp_path: Path, begin) -> None:
    read = read_curve(file, ["Strain 1", "Stress"], **begin)
    assert read.tolist() == RECORD
    assert read.column_names == ("Strain 1 [%]", "Stress [MPa]")
    book = as_workbook(tmp_path / "record.xlsx")
    assert read_curve(book, [3, 4], sheet="record", **begin).tolist() == RECORD


def test_what_stands_above_the_table_is_said_to_be_in_the_way(file: Path) -> None:
    with pytest.raises(
        ValueError, match=r"line 9, .*'Record' is not a number; if a second table.*fr"
    ):
        read_curve(file)
    file.write_text("a,b\n1,2\n\ne,s\n0,1\n")
    with pytest.raises(ValueError, match=r"second table; begin with it \(from\)"):
        read_curve(file)
    assert read_curve(file, from_="e,s").tolist() == [[0, 1]]


@pytest.mark.parametrize(
    ("begin", "message"),
    [
        ({"from_": "Rekord"}, "no line that contains 'Rekord'"),
        ({"from_": ""}, "from is empty"),
        ({"header_row": 3}, "line 3 is empty, or below the end"),
        ({"header_row": 99}, "line 99 is empty, or below the end"),
        ({"header_row": 14}, "no line is made of numbers|holds no numbers"),
        ({"header_row": 0}, "header_row is 0; rows are numbered from 1"),
        ({"header_row": 3, "from_": "Record"}, "give one of them"),
        ({"encoding": "klingon"}, "encoding is 'klingon', which Python does not know"),
        ({"encoding": "hex"}, "encoding is 'hex', which Python does not know"),
    ],
)
def test_a_wrong_begin_is_refused(file: Path, begin, message) -> None:
    with pytest.raises(ValueError, match=message):
        read_curve(file, ["Strain 1", "Stress"], **begin)


def test_names_may_stand_in_a_comment_and_be_numbers(tmp_path: Path) -> None:
    file = tmp_path / "made.txt"
    file.write_text("# made by a script\n# strain stress\n0 1\n0.1 2\n")
    assert read_curve(file, ["stress", "strain"], header_row=2).tolist() == [[1, 0], [2, 0.1]]
    file.write_text("10;20\n0;1\n2;3\n")
    assert read_curve(file, header_row=1).tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize(
    "asked",
    [
        ["strain1", "STRESS"],
        ["Strain 1 (%)", "stress_mpa"],
        ["strain_1", "Stress [GPa]"],
        [" STRAIN-1 ", "stress / MPa"],
    ],
)
def test_capitals_blanks_and_units_of_a_name_do_not_count(file: Path, tmp_path, asked) -> None:
    assert read_curve(file, asked).tolist() == RECORD
    assert read_curve(as_workbook(tmp_path / "a.xlsx"), asked, sheet=2).tolist() == RECORD


def test_a_name_to_the_letter_is_preferred(tmp_path: Path) -> None:
    file = tmp_path / "two.csv"
    file.write_text("Strain;strain;Strain (%)\n1;2;3\n")
    assert read_curve(file, ["strain", "Strain", "Strain (%)"]).tolist() == [[2, 1, 3]]
    with pytest.raises(
        ValueError, match=r"several columns like 'STRAIN': 'Strain' and 'strain' and .* 1 or 2 or 3"
    ):
        read_curve(file, ["STRAIN"])
    file.write_text("STRAIN;n\n1;2\n\nstrain;n\n3;4\n")
    assert read_curve(file, ["strain"]).tolist() == [[3]]  # the second table
    assert read_curve(file, ["STRAIN"], until="strain").tolist() == [[1]]


@pytest.mark.parametrize(
    ("asked", "hint"),
    [
        ("strain", r"'strain'; did you mean 'Strain 1'\? \(its columns are Time, Force"),
        ("Strian 1", r"'Strian 1'; did you mean 'Strain 1'\?"),
        ("str", r"did you mean 'Strain 1' or 'Stress'\?"),
        ("width", r"no column 'width'; its columns are Time"),
    ],
)
def test_a_wrong_name_is_answered_with_near_ones(file: Path, asked, hint) -> None:
    with pytest.raises(ValueError, match=hint):
        read_curve(file, [asked], from_="Record")


def test_chinese_names_in_gbk_are_read(tmp_path: Path) -> None:
    file = tmp_path / "gbk.csv"
    text = "应变,应力(MPa),温度 ℃\n0,1,20\n0.1,2,20\n"
    file.write_bytes(text.encode("gbk"))
    assert read_curve(file, ["应变", "应力"]).tolist() == [[0, 1], [0.1, 2]]
    assert read_curve(file, ["应变"], encoding="gb18030").tolist() == [[0], [0.1]]


@pytest.mark.parametrize(
    "name", ["Größe", "µm/m", "déformation à °C", "mm²", "Kraft in °", "Dehnung ±", "ÜBERGRÖSSE"]
)
def test_western_names_are_not_taken_for_gbk(tmp_path: Path, name: str) -> None:
    file = tmp_path / "western.csv"
    file.write_bytes(f"{name};s\n0;1\n".encode("cp1252"))
    assert read_curve(file, [name]).column_names[0].startswith(name)


def test_an_encoding_that_is_given_is_taken(tmp_path: Path) -> None:
    file = tmp_path / "russian.csv"
    for encoding in ("cp1251", "koi8-r", "utf-16-le", "utf-8"):
        file.write_bytes("деформация;напряжение\n0;1\n".encode(encoding))
        assert read_curve(file, ["деформация"], encoding=encoding).tolist() == [[0]]
    file.write_bytes("напряжение;s\n0;1\n".encode("cp1251"))
    with pytest.raises(ValueError, match=r"russian.csv is not text in the encoding 'utf-8'"):
        read_curve(file, encoding="utf-8")
    with pytest.raises(ValueError, match="is a workbook; leave encoding out"):
        read_curve(as_workbook(tmp_path / "a.xlsx"), encoding="gbk")


def test_all_sheets_are_named_where_the_first_has_no_curve(tmp_path: Path) -> None:
    book = as_workbook(tmp_path / "two.xlsx")
    with pytest.raises(ValueError, match=r"holds no numbers.*'about', 'record': name the one with"):
        read_curve(book)
    with pytest.raises(ValueError, match=r"has no column 'q'.*by number, give 1 to 4$"):
        read_curve(book, ["q"], sheet="record")


def test_a_strict_workbook_is_read(tmp_path: Path) -> None:
    """What Excel writes as "Strict Open XML" has other namespaces, which openpyxl does not know."""
    names = {
        b"http://schemas.openxmlformats.org/officeDocument/2006/": b"officeDocument/",
        b"http://schemas.openxmlformats.org/spreadsheetml/2006/": b"spreadsheetml/",
        b"http://schemas.openxmlformats.org/drawingml/2006/": b"drawingml/",
    }
    book, strict = as_workbook(tmp_path / "usual.xlsx"), tmp_path / "strict.xlsx"
    with zipfile.ZipFile(book) as parts, zipfile.ZipFile(strict, "w") as written:
        for name in parts.namelist():
            content = parts.read(name)
            for usual, rest in names.items():
                content = content.replace(usual, b"http://purl.oclc.org/ooxml/" + rest)
            written.writestr(name, content)
    with pytest.warns(UserWarning, match="invalid specification"):  # openpyxl sees no sheet in it
        assert openpyxl.load_workbook(io.BytesIO(strict.read_bytes())).sheetnames == []
    asked = ["Strain 1", "Stress"]
    read = read_curve(strict, asked, sheet="record")
    assert read.tolist() == read_curve(book, asked, sheet="record").tolist() == RECORD


def test_time_is_told_from_its_unit(tmp_path: Path) -> None:
    file = tmp_path / "machine.csv"
    file.write_text("Elapsed;U;Strain;Stress\ns;V;-;MPa\n0;1;2;3\n")
    with pytest.warns(TimeColumnWarning, match="are Elapsed and U"):
        read_curve(file)


@pytest.mark.parametrize(
    ("unit", "units", "factor"),
    [("%", "MPa", 0.01), ("kN", "MPa", 1e3), ("ksi", "ksi", 1), ("GPa", "ksi", 1e3 / 6.894757)],
)
def test_a_factor_may_be_a_unit(unit: str, units: str, factor: float) -> None:
    assert np.isclose(factor_of(unit, units), factor, rtol=1e-12)
    with pytest.raises(ValueError, match="the factor is 'stone'; give a number, or a unit"):
        factor_of("stone")
    with pytest.raises(ValueError, match="'MPa', which cannot be converted to 'stone'"):
        factor_of("MPa", "stone")


def test_a_file_of_matlab_has_no_rows_to_begin_with(tmp_path: Path) -> None:
    import scipy.io

    scipy.io.savemat(tmp_path / "a.mat", {"e": np.arange(3.0), "s": np.arange(3.0)})
    with pytest.raises(ValueError, match=r"from is 'e', and .*a.mat is a file of MATLAB"):
        read_curve(tmp_path / "a.mat", from_="e")
    assert read_curve(tmp_path / "a.mat", ["S"]).tolist() == [[0], [1], [2]]
