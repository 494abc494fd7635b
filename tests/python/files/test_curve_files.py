"""Reading curves from workbooks and MATLAB files, units, and columns of each file."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import scipy.io

from curvewise import read_curve
from curvewise.files.column_choice import TimeColumnWarning

POINTS = [[0.0, 0.0], [0.001, 199.5], [-0.0005, -1e-05]]


@pytest.fixture
def book(tmp_path: Path) -> Path:
    """A workbook as a test machine exports it: title, names, units, numbers, empty rows."""
    rows = [["Test 7", None, None], ["time", "strain", "stress"], ["s", "-", "MPa"]]
    rows += [[i, *point] for i, point in enumerate(POINTS)] + [[None] * 3, [None, "end", None]]
    file = tmp_path / "test.xlsx"
    with pd.ExcelWriter(file) as writer:
        pd.DataFrame([["nothing"]]).to_excel(writer, sheet_name="about", header=False, index=False)
        pd.DataFrame(rows[:-1]).to_excel(writer, sheet_name="data", header=False, index=False)
        pd.DataFrame(rows).to_excel(writer, sheet_name="bad", header=False, index=False)
    return file


@pytest.mark.parametrize("sheet", [2, "data"])
@pytest.mark.parametrize("columns", [["strain", "stress"], [2, 3], [" strain ", "3"]])
def test_a_sheet_is_read_by_names_and_numbers(book: Path, sheet, columns) -> None:
    assert read_curve(book, columns, sheet=sheet).tolist() == POINTS


def test_the_default_is_the_first_two_columns(book: Path) -> None:
    expected = [[i, point[0]] for i, point in enumerate(POINTS)]
    with pytest.warns(TimeColumnWarning, match=r"sheet 'data' are time and strain; name those "):
        assert read_curve(str(book), sheet=2).tolist() == expected
    assert read_curve(str(book), sheet="2", columns=[1, 2]).tolist() == expected


@pytest.mark.parametrize(
    ("columns", "sheet", "message"),
    [
        (None, None, "sheet 'about' holds no numbers"),
        (None, 4, "no sheet 4; its sheets are about, data, bad; by number, give 1 to 3"),
        (None, "date", "no sheet 'date'; its sheets are about, data, bad"),
        (["force"], 2, "sheet 'data' has no column 'force'; its columns are time, strain, stress"),
        (["strain", "stress"], 3, r"row 8, column 2 \(strain\): 'end' is not a number"),
        (["time", "strain"], 3, r"row 8, column 1 \(time\): the cell is missing"),
    ],
)
def test_errors_of_a_workbook_name_the_place(book: Path, columns, sheet, message) -> None:
    with pytest.raises(ValueError, match=message):
        read_curve(book, columns, sheet=sheet)


def test_variables_matrices_and_structures_of_matlab(tmp_path: Path) -> None:
    file = tmp_path / "test.mat"
    strain, stress = np.array(POINTS).T
    content = {
        "name": "test 7",
        "strain": strain[:, np.newaxis],
        "machine": {"stress": stress, "gain": 2.0},
        "both": np.array(POINTS),
        "long": np.arange(9),
    }
    scipy.io.savemat(file, content)
    assert read_curve(file, ["strain", "machine.stress"]).tolist() == POINTS
    assert read_curve(file, ["both(:,1)", "both(:,2)"]).tolist() == POINTS
    assert read_curve(file, [1, "4"]).tolist() == POINTS
    with pytest.raises(ValueError, match="strain has 3 values and long has 9"):
        read_curve(file, ["strain", "long"])
    with pytest.raises(ValueError, match=r"its columns are strain, machine.stress, both\(:,1\)"):
        read_curve(file, ["stress"])


def test_matlab_files_that_cannot_be_read(tmp_path: Path) -> None:
    file = tmp_path / "test.mat"
    file.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + bytes([0, 2, ord("I"), ord("M")]))
    with pytest.raises(ValueError, match=r"of version 7\.3; save it in MATLAB with"):
        read_curve(file)
    file.write_text("strain,stress\n0,0\n" * 100)
    with pytest.raises(ValueError, match=r"not a \.mat file that scipy reads"):
        read_curve(file)
    scipy.io.savemat(file, {"name": "test 7"})
    with pytest.raises(ValueError, match="holds no real arrays"):
        read_curve(file)
    scipy.io.savemat(file, {"x": np.array([1.0, np.nan])})
    with pytest.raises(ValueError, match=r"x\(2\) is nan; curves must be finite"):
        read_curve(file)
    with pytest.raises(FileNotFoundError):
        read_curve(tmp_path / "none.mat")


def test_factors_change_units(tmp_path: Path) -> None:
    file = tmp_path / "test.csv"
    file.write_text("0.1,2\n0.3,4\n")
    assert read_curve(file, factors=[0.01, 1e-6]).tolist() == [[0.001, 2e-6], [0.003, 4e-6]]
    with pytest.raises(ValueError, match=r"factors has shape \(1,\); .* gives 2 columns"):
        read_curve(file, factors=[2.0])
    with pytest.raises(ValueError, match="each must be finite and not 0"):
        read_curve(file, factors=[0.0, 1.0])
    with pytest.raises(ValueError, match=r"sheet is 1, and .*test\.csv is no workbook"):
        read_curve(file, sheet=1)


def test_a_missing_package_is_named(book: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r'pandas and openpyxl: pip install "curvewise\[curves'):
        read_curve(book)
