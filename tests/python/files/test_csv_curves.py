"""Reading curves from files as test machines, spreadsheets and solvers write them."""

from __future__ import annotations

import codecs
import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from curvewise import read_curve
from curvewise.files import csv_curves
from curvewise.files.column_choice import TimeColumnWarning

POINTS = [[0.0, 0.0], [0.001, 199.5], [-0.0005, -1e-05]]


@pytest.fixture
def read(tmp_path, monkeypatch):
    """Write text or bytes to loop.csv in the working directory and read it."""
    monkeypatch.chdir(tmp_path)

    def write_and_read(content, columns=None):
        data = content if isinstance(content, bytes) else content.encode()
        (tmp_path / "loop.csv").write_bytes(data)
        return read_curve("loop.csv", columns)

    return write_and_read


def message(read, content, columns=None):
    """Return what a ValueError says; it must be one line."""
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as caught:
        read(content, columns)
    return str(caught.value)


@pytest.mark.parametrize(
    "content",
    [
        "0,0\n0.001,199.5\n-0.0005,-1E-05\n",
        "strain,stress\n0,0\n0.001,199.5\n-0.0005,-1E-05",
        "0, 0\n0.001 , 199.5\n -0.0005,\t-1e-5",
        "0;0\n0.001;199.5\n-5.e-4;-.00001",
        "0;0\n0,001;199,5\n-0,0005;-1E-05\n",
        "strain, true;stress, MPa\n0;0\n+0,001;+199,5\n-0,0005;-1E-05\n",
        "0\t0\n0.001\t199.5\n-0.0005\t-1E-05\n",
        "0\t0\n0,001\t199,5\n-0,0005\t-0,00001\n",
        "0 0\n0.001   199.5\n   -0.0005 -1E-05  \n",
        "0 0\n0,001 199,5\n-0,0005 -1E-05\n",
        "strain stress\n0 0\n0,001 199,5\n-0,0005 -0,00001",
        "0 \t 0\n0.001\t199.5\n-0.0005 \t-1E-05\n",
        "0,0\r0.001,199.5\r-0.0005,-1E-05\r",
        "e,s\r\n0,0\r\n0.001,199.5\r\n-0.0005,-1E-05\r\n",
        "e,s\r0,0\r\n0.001,199.5\n-0.0005,-1E-05",
        "# a comment, 1, 2\n0,0\n% 5,5\n\n  // 6,6\n0.001,199.5\n   \n#\n-0.0005,-1E-05\n\n\n",
        "0,0,7,open\n0.001,199.5,,\n-0.0005,-1E-05\n",
        "e,s,note\n0,0,start\n0.001,199.5,\n-0.0005,-1E-05,end\n,,\n,,\n",
        '"e","s"\n"0","0"\n"0.001","199.5"\n"-0.0005","-1E-05"\n',
        '"e";"s"\n"0";"0"\n"0,001";"199,5"\n"-0,0005";"-1E-05"\n',
        'e,s,note\n0,0,"a, b"\n0.001,"199.5","c ""d"""\n-0.0005, "-1E-05",\n',
        '"true strain" "true stress"\n0 "0"\n0.001 199.5\n-0.0005 -1E-05',
        '"strain\n[-]","stress\n[MPa]"\n0,0\n0.001,199.5\n-0.0005,-1E-05',
        "Tensile test of a sheet\n\nstrain;stress\n-;MPa\n0;0\n0,001;199,5\n-0,0005;-1E-05",
        "true strain  true stress\n0 0\n0.001 199.5\n-0.0005 -1E-05",
        "strain\tstress\n0 0\n0.001 199.5\n-0.0005 -1E-05",
        codecs.BOM_UTF8 + b"0,0\n0.001,199.5\n-0.0005,-1E-05\n",
        codecs.BOM_UTF8 + b"e,s\n0,0\n0.001,199.5\n-0.0005,-1E-05\n",
        codecs.BOM_UTF8 + "ε,σ\n0,0\n0.001,199.5\n-0.0005,-1E-05\n".encode(),
        "e;Längung\n0;0\n0,001;199,5\n-0,0005;-1E-05\n".encode("latin-1"),
        "e\ts\r\n0\t0\r\n0,001\t199,5\r\n-0,0005\t-1E-05\r\n".encode("utf-16"),
    ],
)
def test_every_layout_gives_the_same_points(read, content):
    curve = read(content)
    assert curve.dtype == np.float64
    np.testing.assert_array_equal(curve, POINTS)


@pytest.mark.parametrize("content", ["0\n1.5\n-2e3\n", "force\n0\n1.5\n-2e3", "0\r1.5\r\r-2e3"])
def test_one_column_is_a_curve_in_one_dimension(read, content):
    np.testing.assert_array_equal(read(content), [[0.0], [1.5], [-2000.0]])


def test_a_single_point_keeps_both_dimensions(read):
    assert read("1,2").shape == (1, 2)
    assert read("1").shape == (1, 1)


def test_a_comma_between_digits_alone_separates_columns(read):
    np.testing.assert_array_equal(read("1,5\n2,5\n"), [[1.0, 5.0], [2.0, 5.0]])


def test_columns_by_name_and_by_number(read):
    content = "temperature,strain,stress,T\n1,0.1,100,7\n2,0.2,200,8\n"
    np.testing.assert_array_equal(read(content), [[1.0, 0.1], [2.0, 0.2]])
    expected = [[100.0, 0.1], [200.0, 0.2]]
    np.testing.assert_array_equal(read(content, ["stress", "strain"]), expected)
    np.testing.assert_array_equal(read(content, [3, 2]), expected)
    np.testing.assert_array_equal(read(content, ["3", "strain"]), expected)
    np.testing.assert_array_equal(read(content, [np.int64(4)]), [[7.0], [8.0]])
    assert read(content, [" stress ", 1, "temperature", 1]).shape == (2, 4)


@pytest.mark.parametrize(
    "name",
    ["time", "Time [s]", "time_s", "t", "t (s)", "Step Time", "Zeit/s", "Time, s", "TIMESTAMP"],
)
def test_a_first_column_of_time_is_not_taken_without_a_word(read, name):
    header = f'"{name}";strain;stress [MPa]\n'
    with pytest.warns(TimeColumnWarning) as caught:
        values = read(header + "0;1;2\n1;2;3\n")
    np.testing.assert_array_equal(values, [[0.0, 1.0], [1.0, 2.0]])
    assert str(caught[0].message) == (
        f"the first two of the 3 columns of loop.csv are {name} and strain; name those wanted, for "
        "example columns=['strain', 'stress [MPa]']"
    )
    read(header + "0;1;2\n", [1, 2])  # asked for


def test_columns_that_are_called_strain_and_stress_are_the_example(read):
    header = "Total Time (s);Cycle;Force (kN);Strain 1 (%);;Stress\n"
    with pytest.warns(TimeColumnWarning, match=r"columns=\['Strain 1 \(%\)', 'Stress'\]"):
        read(header + "0;1;2;3;;4\n1;2;3;4;;5\n")


@pytest.mark.parametrize(
    "header",
    ["T;strain;stress", "lifetime;a;b", "thickness;a;b", "timeout;a;b", "a;time;b", "time;force"],
)
def test_what_is_not_called_time_and_files_without_a_choice_are_read_quietly(read, header):
    cells = header.count(";") + 1
    read(f"{header}\n{';'.join('0' * cells)}\n{';'.join('1' * cells)}\n")


def test_columns_that_are_not_asked_for_may_hold_anything(read):
    content = "12.03.2024;a;0;1,5\n12.03.2024;;0,001;nan\nx;b;0,002;n/a\n"
    np.testing.assert_array_equal(read(content, [3]), [[0.0], [0.001], [0.002]])


def test_empty_cells_at_the_end_of_a_line_are_no_surplus(read):
    for content in ("1,2\n3,4,,\n", "1,2,\n3,4\n", "e,s\n1,2\n3,4,\n", "1\t2\n3\t4\t\n"):
        assert read(content).tolist() == [[1.0, 2.0], [3.0, 4.0]]
    assert read("e,s,note\n1,2\n3,4,spoilt\n").tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_names_come_from_the_fullest_header_line(read):
    content = "Test 12b,,\nstrain,stress,note\n-,MPa,-\n0,0,\n1,2,\n"
    np.testing.assert_array_equal(read(content, ["stress"]), [[0.0], [2.0]])


def test_a_latin_1_header_names_its_column(read):
    curve = read("Weg;Kraft °\n0;1\n".encode("latin-1"), ["Kraft °"])
    np.testing.assert_array_equal(curve, [[1.0]])


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("e,stress\n0,0\n1,abc\n", "loop.csv, line 3, column 2 (stress): 'abc' is not a number"),
        ("0,0\n1,abc\n", "loop.csv, line 2, column 2: 'abc' is not a number"),
        ("# c\n\ne,s\r\n0,0\r1,abc", "loop.csv, line 5, column 2 (s): 'abc' is not a number"),
        ("e;s\n0;0\n1;1.23,5\n", "loop.csv, line 3, column 2 (s): '1.23,5' is not a number"),
        ("0,0\n1_0,1", "loop.csv, line 2, column 1: '1_0' is not a number"),
        ("0,0\n0x1F,1", "loop.csv, line 2, column 1: '0x1F' is not a number"),
        ('0,0\n"1,5a",1', "loop.csv, line 2, column 1: '1,5a' is not a number"),
        ('0,0\n1,"2', "loop.csv, line 2, column 2: '\"2' is not a number"),
        ("0,0\n#N/A,1", "loop.csv, line 2, column 1: '#N/A' is not a number"),
        ("0,0\n#DIV/0!,1", "loop.csv, line 2, column 1: '#DIV/0!' is not a number"),
        ("0,0\n1,", "loop.csv, line 2, column 2: the cell is missing"),
        ("Test of a sheet\n0,0\n1,\n", "loop.csv, line 3, column 2: the cell is missing"),
        ("0,5\n0,6;2\n0,7;3", "loop.csv, line 1, column 2: the cell is missing"),
        ("e,s\n0,0\n1", "loop.csv, line 3, column 2 (s): the cell is missing"),
        ("0\t0\n\t1", "loop.csv, line 2, column 1: the cell is missing"),
        ("0\t\t5\n1\t\t6", "loop.csv, line 1, column 2: the cell is missing"),
        ("e,s\n0.1\n0.2", "loop.csv, line 2, column 2 (s): the cell is missing"),
        ("0 0\n1", "loop.csv, line 2, column 2: the cell is missing"),
        ("0.1\n0.2,7", "loop.csv, line 1, column 2: the cell is missing"),
        ("0,0\n1,NaN", "loop.csv, line 2, column 2: 'NaN' is nan; curves must be finite"),
        ("0,0\n-inf,1", "loop.csv, line 2, column 1: '-inf' is -inf; curves must be finite"),
        ("0,0\n1,1e999", "loop.csv, line 2, column 2: '1e999' is inf; curves must be finite"),
        ("nan,0", "loop.csv, line 1, column 1: 'nan' is nan; curves must be finite"),
        ("1\n" * 300 + "5 6", "loop.csv, line 301, column 1: '5 6' is not a number"),
        ("1\n" * 300 + "5,6", "loop.csv, line 301 has 2 cells, and 1 is expected"),
        (
            "0;0\n0,5;1\n0.6;2",
            "loop.csv: line 2 has a number with a comma and line 3 one with a point; "
            "use one decimal sign",
        ),
        (
            "0.5;1\n0.6;1,234",
            "loop.csv: line 2 has a number with a comma and line 1 one with a point; "
            "use one decimal sign",
        ),
        ("0,0\n1," + "x" * 99, f"loop.csv, line 2, column 2: '{'x' * 37}...' is not a number"),
        ('0,0\n1,"' + "x" * 200_000, "loop.csv, line 2, column 2: '\"" + "x" * 36 + "...' is not"),
        ("1,2\n2,5,3\n3,4", "loop.csv, line 2 has 3 cells, and 2 are expected by the lines above"),
        ("e,s\n1,2\n2,5,3", "loop.csv, line 3 has 3 cells, and 2 are expected by the lines above"),
        ("1,2,a\n" * 300 + "2,5,3,a", "loop.csv, line 301 has 4 cells, and 3 are expected"),
        ("1 2\n1 2 3", "loop.csv, line 2 has 3 cells, and 2 are expected by the lines above"),
        ("", "loop.csv holds no numbers; a curve is one point per line"),
        (
            "# 1,2\n",
            "loop.csv: no line is made of numbers; the first with a digit is line 1, '# 1,",
        ),
        ("strain,stress\n", "loop.csv holds no numbers; a curve is one point per line"),
        (b"PK\x03\x04\0", "loop.csv is damaged, or not a text file: line 1 has a zero byte; save"),
    ],
)
def test_the_place_of_a_bad_cell_is_named(read, content, expected):
    assert message(read, content).startswith(expected)


@pytest.mark.parametrize(
    ("content", "columns", "expected"),
    [
        (
            "e_true,Sigma_true\n0,0\n",
            ["strain"],
            "loop.csv has no column 'strain'; its columns are e_true, Sigma_true; "
            "by number, give 1 to 2",
        ),
        ("0,0\n", ["e"], "loop.csv has no column 'e'; it has no header; by number, give 1 to 2"),
        (
            "true strain  true stress\n0 0\n",
            ["strain"],
            "loop.csv has no column 'strain'; it has no header; by number, give 1 to 2",
        ),
        ("0,0\n", [3], "loop.csv has no column 3; columns are numbered 1 to 2"),
        (
            "e,s\n0,0\n",
            [5000 * "9"],
            f"loop.csv has no column '{5000 * '9'}'; its columns are e, s; by number, give 1 to 2",
        ),
        ("0,0\n", ["0"], "loop.csv has no column 0; columns are numbered 1 to 2"),
        ("0,0\n", [-1], "loop.csv has no column -1; columns are numbered 1 to 2"),
        ("e,e\n0,0\n", ["e"], "loop.csv has several columns 'e'; give its number, from 1"),
        (",s\n0,0\n", [""], "loop.csv has no column ''; its columns are s; by number, give 1 to 2"),
        ("0,0\n", [], "columns is empty; name at least one column"),
    ],
)
def test_an_unknown_column_lists_those_there_are(read, content, columns, expected):
    assert message(read, content, columns) == expected


@pytest.mark.parametrize("columns", ["strain", [1.5]])
def test_columns_of_a_wrong_type(read, columns):
    with pytest.raises(TypeError):
        read("strain,stress\n0,0\n", columns)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_curve(tmp_path / "no.csv")
    with pytest.raises(OSError, match=str(tmp_path.name)):
        read_curve(tmp_path)


CELLS = ["1", "-2.5", "1e5", "+3", ".5", "5.", "1e-400", " 1 ", "1_0", "nan", "1e999", "", "abc"]
CELLS += ["1,5", "0x10", "1e", "1d5", "1j", "True", "1 2", "-", "#", "\xa01", "\x0b1", "1\x1c"]


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    separator=st.sampled_from([";", "\t", ",", " "]),
    rows=st.lists(
        st.lists(st.sampled_from(CELLS[:6]) | st.sampled_from(CELLS), min_size=1, max_size=3),
        min_size=1,
        max_size=5,
    ),
)
def test_numpys_parser_and_the_careful_one_agree(tmp_path, monkeypatch, separator, rows):
    path = tmp_path / "loop.csv"
    path.write_bytes("\n".join(separator.join(row) for row in rows).encode())

    def outcome():
        try:
            return read_curve(path).tolist()
        except ValueError as error:
            return str(error)

    either = outcome()
    with monkeypatch.context() as patch:
        patch.setattr(csv_curves, "_parse_fast", lambda table, chosen: None)
        assert outcome() == either


@pytest.mark.parametrize("separator", [",", ";", "\t", " "])
def test_large_plain_files_take_numpys_parser(read, monkeypatch, separator):
    monkeypatch.setattr(csv_curves, "_parse_cell_by_cell", None)
    expected = np.random.default_rng(1).normal(size=(20_000, 2))
    text = "\n".join(f"{x!r}{separator}{y!r}" for x, y in expected.tolist())
    np.testing.assert_array_equal(read(f"e{separator}s\n{text}"), expected)
    if separator != ",":
        np.testing.assert_array_equal(read(text.replace(".", ",")), expected)


def test_real_loops(data_dir):
    shapes = {path.name: read_curve(path).shape for path in (data_dir / "loops").glob("*.csv")}
    assert shapes == {
        "dp780_tct_3pct.csv": (4340, 2),
        "dp780_tct_6pct.csv": (7816, 2),
        "eddq_tct_3pct.csv": (2801, 2),
        "eddq_tct_5pct.csv": (5566, 2),
        "resslab_cyclic_2pct.csv": (634, 2),
        "resslab_random_protocol.csv": (1087, 2),
        "tr1180_tct_3pct.csv": (4657, 2),
    }
    first, last = read_curve(data_dir / "loops" / "dp780_tct_3pct.csv")[[0, -1]]
    np.testing.assert_array_equal([first, last], [[-2.32e-05, 3.41432], [0.02958, 888.48691]])
    loop = data_dir / "loops" / "resslab_random_protocol.csv"
    np.testing.assert_array_equal(read_curve(loop, ["e_true", "Sigma_true"]), read_curve(loop))
    assert read_curve(loop)[-1].tolist() == [-0.0018056680212382, -1.3272782815720348]


def test_the_papers_curves(data_dir):
    tests, models = (
        sorted((data_dir / "paper" / name).glob("*.csv")) for name in ("test", "model")
    )
    assert {read_curve(path, ["strain", "stress_MPa"]).shape for path in tests} == {(155, 2)}
    assert {read_curve(path, ["strain", "stress_MPa"]).shape for path in models} == {(102, 2)}
    true, noise = (
        read_curve(data_dir / "paper" / f"load_unload_{name}.txt") for name in ("true", "noise")
    )
    assert true.shape == noise.shape == (150, 2)
    np.testing.assert_array_equal(true[:, 0], noise[:, 0])
    assert 0.04 < (true - noise)[:, 1].std() < 0.06


def test_values_survive_a_round_trip_through_json_and_back(read):
    expected = np.random.default_rng(2).normal(size=(50, 3)) * 10.0 ** np.arange(-150, 150, 100)
    rows = json.loads(json.dumps(expected.tolist()))
    text = "\n".join(",".join(map(repr, row)) for row in rows)
    np.testing.assert_array_equal(read(text, [1, 2, 3]), expected)
