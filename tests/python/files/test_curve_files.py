"""Reading curves from workbooks and MATLAB files, units, and columns of each file."""

from __future__ import annotations

import contextlib
import io
import re
import subprocess
import sys
import warnings
import zipfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.io

from curvewise import read_curve
from curvewise.files import mat_curves, mat_process
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


def _cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def _without_types(data: bytes) -> bytes:
    """Take a part out of a workbook, whose check sums stay right."""
    packed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(packed, "w") as new:
        for part in old.namelist():
            if part != "[Content_Types].xml":
                new.writestr(part, old.read(part))
    return packed.getvalue()


@pytest.mark.parametrize(
    ("damaged", "why"),
    [
        (_cut, "BadZipFile: File is not a zip file"),
        (_without_types, "KeyError: .*Content_Types"),
        (lambda data: data.replace(b"xl/", b"yl/"), "KeyError: 'zip'"),
        (lambda data: b"", "ValueError: Excel file format cannot be determined"),
        (lambda data: b"strain,stress\n0,1\n", "ValueError: Excel file format cannot be determ"),
    ],
)
def test_a_damaged_workbook_is_one_sentence(book: Path, damaged, why: str) -> None:
    book.write_bytes(damaged(book.read_bytes()))
    message = rf"^{re.escape(str(book))} is damaged, or no workbook \({why}[^\n]*\); open it in a "
    with pytest.raises(ValueError, match=message):
        read_curve(book)


@pytest.mark.parametrize("keep", [0, 100, 200, 250, 300])
@pytest.mark.nightly("100|250|300")
def test_a_damaged_mat_file_is_one_sentence(tmp_path: Path, keep: int) -> None:
    file = tmp_path / "test.mat"
    scipy.io.savemat(file, {"x": np.arange(9.0), "y": np.arange(9.0)})
    file.write_bytes(file.read_bytes()[:keep])
    message = r" is damaged, or not a \.mat file that scipy reads \(\w+: [^\n]*\); save"
    with pytest.raises(ValueError, match=f"^{re.escape(str(file))}{message}"):
        read_curve(file)


def test_a_mat_file_that_crashes_its_reader_does_not_end_this_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = tmp_path / "crash.py"
    script.write_text("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n")
    monkeypatch.setattr(mat_curves, "_SCRIPT", str(script))
    file = tmp_path / "test.mat"
    file.touch()
    with pytest.raises(ValueError, match=r"damaged: scipy's reader ended with status -11 on it; s"):
        read_curve(file)


@pytest.fixture
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have whole .mat files read by mat_process.py without half a second for a process."""

    def run(command: list[str], **_: object) -> subprocess.CompletedProcess[bytes]:
        output = io.TextIOWrapper(io.BytesIO())
        with contextlib.redirect_stdout(output), warnings.catch_warnings():
            mat_process.main(command[-1])
        return subprocess.CompletedProcess(command, 0, output.buffer.getvalue())

    monkeypatch.setattr(mat_curves, "subprocess", SimpleNamespace(run=run))


@pytest.mark.usefixtures("in_this_process")
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
    with pytest.raises(FileNotFoundError):
        read_curve(tmp_path / "none.mat")


@pytest.mark.usefixtures("in_this_process")
def test_matlab_files_without_a_curve(tmp_path: Path) -> None:
    file = tmp_path / "test.mat"
    scipy.io.savemat(file, {"name": "test 7"})
    with pytest.raises(ValueError, match="holds no real arrays"):
        read_curve(file)
    scipy.io.savemat(file, {"x": np.array([1.0, np.nan])})
    with pytest.raises(ValueError, match=r"x\(2\) is nan; curves must be finite"):
        read_curve(file)


def test_factors_change_units(tmp_path: Path) -> None:
    file = tmp_path / "test.csv"
    file.write_text("0.1,2\n0.3,4\n")
    assert read_curve(file, factors=[0.01, 1e-6]).tolist() == [[0.001, 2e-6], [0.003, 4e-6]]
    with pytest.raises(ValueError, match=r"factors has shape \(1,\); .* gives 2 columns"):
        read_curve(file, factors=[2.0])
    with pytest.raises(ValueError, match="each must be finite and not 0"):
        read_curve(file, factors=[0.0, 1.0])
    with pytest.raises(ValueError, match=r"sheet is 1, and .*test\.csv is not a workbook"):
        read_curve(file, sheet=1)


def test_a_missing_package_is_named(book: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r'pandas and openpyxl: pip install "curvewise\[curves'):
        read_curve(book)
