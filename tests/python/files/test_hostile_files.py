"""Files made to take all memory or time: right data or an error, within 1 GiB and seconds.

A separate process reads them, one after the other, with a limit of memory.
"""

from __future__ import annotations

import contextlib
import json
import os
import struct
import subprocess
import sys
import threading
import zipfile
from collections.abc import Iterator
from pathlib import Path

import openpyxl
import pytest

import curvewise
from curvewise.commands import main
from curvewise.files import csv_curves, curve_files
from curvewise.studies import Study, StudyError

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="neither devices nor limits")

READ = """\
import json, resource, sys, time
resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
from curvewise import read_curve
for file in sys.argv[1:]:
    begin = time.process_time()
    try:
        said = read_curve(file).tolist()
    except (ValueError, OSError, MemoryError) as error:
        said = str(error)
    print(json.dumps([file, said, time.process_time() - begin]), flush=True)
"""
POINTS = [[1.0, 2.0], [3.0, 4.0]]


def workbook(file: Path, sheet: str) -> str:
    """Write a workbook whose sheet is this XML."""
    openpyxl.Workbook().save(file)
    with zipfile.ZipFile(file) as parts:
        kept = {name: parts.read(name) for name in parts.namelist()}
    kept["xl/worksheets/sheet1.xml"] = sheet.encode()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as parts:
        for name, content in kept.items():
            parts.writestr(name, content)
    return str(file)


def sheet_of(rows: str, before: str = "") -> str:
    name = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    data = f'<worksheet xmlns="{name}"><sheetData>{rows}</sheetData></worksheet>'
    return f'<?xml version="1.0"?>{before}{data}'


def row(number: int, *cells: str) -> str:
    return f'<row r="{number}">{"".join(cells)}</row>'


def cell(place: str, value: object) -> str:
    return f'<c r="{place}"><v>{value}</v></c>'


TWO = row(1, cell("A1", 1), cell("B1", 2)) + row(2, cell("A2", 3), cell("B2", 4))
LAUGHS = "".join(f'<!ENTITY a{i + 1} "{f"&a{i};" * 10}">' for i in range(9))
SHEETS = {
    "far": (sheet_of(TWO + row(1048576, cell("XFD1048576", 7))), POINTS),
    "row": (sheet_of(TWO + row(10**12, cell("A1000000000000", 7))), "more than 1,048,576 rows"),
    "column": (sheet_of(TWO + row(3, cell("ZZZZZZ3", 7))), "is damaged, or no workbook"),
    "bomb": (sheet_of(TWO + " " * (70 << 20)), "unpacks to 70 MiB, which no workbook"),
    "deep": (sheet_of(TWO + "<a>" * 30_000 + "</a>" * 30_000), POINTS),
    "laughs": (
        sheet_of(
            TWO + row(3, cell("A3", "&a9;"), cell("B3", 7)),
            f'<!DOCTYPE w [<!ENTITY a0 "ha">{LAUGHS}]>',
        ),
        "is damaged, or no workbook",
    ),
}


def hostile(folder: Path, slow: bool) -> Iterator[tuple[str, object]]:
    """Make files, each with its expected result: points, or words of an error."""
    if slow:
        (folder / "long.csv").write_bytes(b"1,2\n" * 2**26)
        yield str(folder / "long.csv"), "takes more memory than there is; give a part of it"
        wide = "".join(row(i, cell(f"XFD{i}", 7)) for i in range(3, 3000))
        yield workbook(folder / "wide.xlsx", sheet_of(TWO + wide)), "or 33,554,432 cells; delete"
    for name, (sheet, expected) in list(SHEETS.items())[:: 1 if slow else 3]:
        yield workbook(folder / f"{name}.xlsx", sheet), expected
    for kind in ("csv", "xlsx", "mat"):
        link = folder / f"link.{kind}"
        link.symlink_to("/dev/zero")
        yield str(link), "is a device or a pipe; give a regular file"
    os.mkfifo(folder / "pipe.xlsx")
    yield str(folder / "pipe.xlsx"), "is a device or a pipe"
    for name, content, size, words in (
        ("line.csv", b"1," * 2**20, 0, "line 1 has 2,097,152 characters, and at most 1,048,576"),
        ("zero.csv", b"1,2\n3,4\n", 2**32, "line 3 has a zero byte"),
        ("large.csv", b"1,2\n3,4\n", 2**40, "has 1,048,576 MiB, and at most 4,096 MiB are read"),
        ("large.xlsx", b"", 2**40, "has 1,048,576 MiB"),
        ("quote.csv", b'"' + b"1,2\n3,4\n" * 10_000, 0, "line 1, column 1: "),
    ):
        with (folder / name).open("wb") as file:
            file.write(content)
            file.truncate(max(len(content), size))
        yield str(folder / name), words
    head = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H2s", 0x100, b"IM")
    array = struct.pack("<4I", 6, 8, 6, 0) + struct.pack("<2I2i", 5, 8, 2**30, 1)
    array += struct.pack("<2I", 0x10001, ord("x")) + struct.pack("<2I", 9, 2**31 - 8)
    (folder / "array.mat").write_bytes(head + struct.pack("<2I", 14, 2**31 - 8) + array)
    yield str(folder / "array.mat"), "is damaged, or not a .mat file"


@pytest.mark.parametrize("slow", [False, pytest.param(True, marks=pytest.mark.nightly)])
def test_each_ends_with_its_points_or_a_word(tmp_path: Path, slow: bool) -> None:
    expected = dict(hostile(tmp_path, slow))
    done = subprocess.run(
        [sys.executable, "-c", READ, *expected],
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert [file for file, *_ in found] == list(expected)
    for file, said, seconds in found:
        if isinstance(expected[file], str):
            assert isinstance(said, str), file
            assert expected[file] in said
            assert said.startswith(file)
        else:
            assert said == expected[file], file
        assert seconds < 20, file


def test_what_does_not_fit_into_memory_is_said(tmp_path: Path, monkeypatch, capsys) -> None:
    def read(*_: object) -> None:
        raise MemoryError

    file = tmp_path / "loop.csv"
    file.write_text("1,2\n")
    monkeypatch.setattr(curve_files, "read_csv_columns", read)
    assert main(["compare", str(file), str(file)]) == 1
    assert "loop.csv takes more memory than there is; give a part" in capsys.readouterr().err


STUDY = """\
[[tests]]
file = "{file}"
[tests.output]
file = "{output}"
[model]
command = ["true"]
templates = "deck.inp"
timeout = 9
success = {{ file = "{log}", text = "done" }}
[parameters]
a = [0, 1]
"""


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (
            {"file": "/dev/zero"},
            r"line 2: tests\[1\].file cannot be used: /dev/zero is a device or",
        ),
        ({"output": "/dev/zero"}, "line 4: tests.* is '/dev/zero'; give a path inside the run's"),
        ({"output": "../out.csv"}, r"line 4: tests.*file is '\.\./out\.csv'; give a path inside"),
        ({"log": "a/../../log"}, r"line 9: model\.success\.file is 'a/\.\./\.\./log'; give a path"),
    ],
)
def test_a_study_reads_files_and_what_is_in_a_runs_folder(tmp_path: Path, wrong, message) -> None:
    (tmp_path / "test.csv").write_text("0,1\n1,2\n")
    (tmp_path / "deck.inp").write_text("<<a>>\n")
    right = {"file": "test.csv", "output": "results/out.csv", "log": "deck.sta"}
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(**right))
    Study.read(study)
    study.write_text(STUDY.format(**{**right, **wrong}))
    with pytest.raises(StudyError, match=message):
        Study.read(study)


def test_a_curve_may_come_through_a_pipe(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for lines, words in (("1,2\n3,4\n", None), ("1,2\n" * 2**20, "at most 2 MiB are read")):
        writer = threading.Thread(target=_write, args=(pipe, lines))
        writer.start()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(csv_curves, "LARGEST_OF_PIPE", 2**21)
            if words is None:
                assert curvewise.read_curve(pipe).tolist() == [[1.0, 2.0], [3.0, 4.0]]
            else:
                with pytest.raises(ValueError, match=words):
                    curvewise.read_curve(pipe)
        writer.join()


def _write(pipe: Path, lines: str) -> None:
    with contextlib.suppress(BrokenPipeError), pipe.open("w") as stream:
        stream.write(lines)


def test_a_study_is_a_regular_file(tmp_path: Path, capsys) -> None:
    with pytest.raises(StudyError, match="/dev/zero is a device or a pipe; give a regular file"):
        Study.read("/dev/zero")
    with (tmp_path / "study.toml").open("wb") as file:
        file.truncate(2**34)
    assert main(["identify", str(tmp_path / "study.toml")]) == 1
    assert "study.toml has 16,384 MiB, and at most 16 MiB are read" in capsys.readouterr().err
