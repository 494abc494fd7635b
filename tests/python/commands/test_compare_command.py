"""compare: its output for two files, and its errors for files that it cannot use."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
from command_runs import MEASURES, PNG, USAGE, assert_failed, numbers

import curvewise
from curvewise import read_curve


@pytest.fixture
def compared(output):
    """Compare two files and return the JSON object."""
    return lambda *arguments: json.loads(output("compare", *arguments, "--json"))


def test_compare_prints_files_points_and_values(output, files):
    out = output("compare", *files)
    assert "P  A.csv, 40 points, columns strain, stress\n" in out
    assert "Q  B.csv, 30 points, columns 1, 2\npreset scaled\n" in out
    expected = curvewise.compare(read_curve("A.csv"), read_curve("B.csv"))
    assert str(expected) in out
    assert list(numbers(out)) == MEASURES
    for name, found in expected.deviations.items():
        assert f"\n{name:<12}  {found}\n" in out


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_compare_json_is_one_object(compared, files, preset):
    loaded = compared(*files, "--preset", preset)
    expected = curvewise.compare(read_curve("A.csv"), read_curve("B.csv"), preset=preset)
    assert loaded == {
        "files": ["A.csv", "B.csv"],
        "columns": [["strain", "stress"], ["1", "2"]],
        "factors": [None, None],
        "prepared": [[], []],
        "preset": preset,
        "n": [40, 30],
        "values": expected.to_dict(),
        "refusals": {},
        "deviations": {name: found._asdict() for name, found in expected.deviations.items()},
    }


def test_a_value_beyond_the_range_of_a_double_is_null_in_json(output, compared, files):
    for name, offset in (("A.csv", 0.0), ("B.csv", 1.5e308)):
        np.savetxt(name, np.full((3, 1), offset), delimiter=",")
    loaded = compared(*files, "--preset", "raw")
    assert loaded["values"] == {"frechet": 1.5e308, "dtw": None}
    assert loaded["deviations"]["frechet"]["largest"] == 1.5e308
    assert "dtw      inf\n" in output("compare", *files, "--preset", "raw")


def test_options_of_area_and_dtw_replace_those_of_the_preset(run, compared, files):
    P, Q = map(read_curve, files)
    given = ("--preset", "raw", "--measures", "area", "dtw")
    assert compared(*files, *given, "--spacing", "x", "--crossing", "split")["values"] == {
        "area": curvewise.area(P, Q, spacing="x", crossing="split"),
        "dtw": curvewise.dtw(P, Q),
    }
    for window in (12, 0.3):
        values = compared(*files, *given, "--window", str(window))["values"]
        assert values["dtw"] == curvewise.dtw(P, Q, window=window)
    for window in ("1.5", "wide"):
        status, _, error = run("compare", *files, *given, "--window", window)
        assert status == USAGE
        assert f"{window} is neither an integer nor between 0 and 1" in error
    assert run("compare", *files, "--spacing", "even")[0] == USAGE
    assert_failed(run("compare", *files, "--window", "-1"), "window is -1; give a whole number")
    of_area = ("--measures", "area", "--window", "5")
    assert_failed(run("compare", *files, *of_area), "options are given for 'dtw'")


def test_loops_may_begin_elsewhere(run, compared, files):
    turn = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    loop = np.column_stack([np.cos(turn), np.sin(turn)])
    np.savetxt("A.csv", loop, delimiter=",")
    np.savetxt("B.csv", np.roll(loop, 11, axis=0), delimiter=",")
    for preset in ("raw", "scaled"):
        values = compared(*files, "--closed", "--preset", preset)["values"]
        assert list(values) == MEASURES
        assert values["frechet"] == values["dtw"] == values["area"] == 0.0
        assert compared(*files, "--preset", preset)["values"]["area"] > 0.1
    values = compared(*files, "--closed", "--measures", "pcm", "frechet")["values"]
    assert values["frechet"] == 0.0
    polygon = ("--closed", "--crossing", "polygon", "--preset", "raw")
    assert compared(*files, *polygon, "--measures", "area")["values"]["area"] == 0.0
    of_pcm = ("--closed", "--measures", "pcm")
    assert_failed(run("compare", *files, *of_pcm), "--closed applies to area, dtw, frechet, ")
    given = ("--closed", "--window", "3")
    assert_failed(run("compare", *files, *given), "closed=True has no window; leave out window=3")


def test_measures_are_those_asked_for(compared, files):
    assert list(compared(*files, "--measures", "dtw", "area")["values"]) == ["dtw", "area"]


def test_every_measure_of_compare_can_be_asked_for(output, files):
    out = output("compare", *files, "--measures", *MEASURES)
    assert list(curvewise.compare(*map(read_curve, files)).values) == MEASURES == list(numbers(out))


def test_columns_are_chosen_in_both_files(run, compared, files):
    Path("A.csv").write_text("t,strain,stress\n0,0,0\n1,1,1\n2,2,0\n")
    Path("B.csv").write_text("stress;strain;t\n0;0;0\n2;1;1\n0;2;2\n")
    loaded = compared(*files, "--preset", "raw", "--columns", "strain", "stress")
    assert loaded["columns"] == [["strain", "stress"]] * 2
    expected = curvewise.compare([(0, 0), (1, 1), (2, 0)], [(0, 0), (1, 2), (2, 0)], preset="raw")
    assert loaded["values"] == expected.to_dict()
    values = compared(*files, "--preset", "raw", "--columns", "stress")["values"]
    assert values == {"frechet": 1.0, "dtw": 1.0}
    _, out, _ = run("compare", *files, "--json", "--columns", "1", "2", "3")  # speaks of time
    assert list(json.loads(out)["values"]) == ["frechet", "dtw"]


def test_factors_change_the_units_of_each_file(run, output, compared, files):
    P, Q = map(read_curve, files)
    np.savetxt("A.csv", P * [100.0, 1e6], delimiter=",", header="strain,stress", comments="")
    given = ("--preset", "raw", "--factors-a", "0.01", "1e-6")
    out = output("compare", *files, *given)
    assert "P  A.csv, 40 points, columns strain × 0.01, stress × 1e-06\n" in out
    assert "Q  B.csv, 30 points, columns 1, 2\n" in out
    loaded = compared(*files, *given, "--factors-b", "1", "-1")
    assert loaded["factors"] == [[0.01, 1e-6], [1.0, -1.0]]
    scaled = read_curve("A.csv", factors=[0.01, 1e-6])
    assert loaded["values"]["dtw"] == curvewise.dtw(scaled, Q * [1.0, -1.0])
    assert_failed(
        run("compare", *files, "--factors-b", "2"),
        "--factors-b has shape (1,); B.csv gives 2 columns, and each needs one",
    )
    assert run("compare", *files, "--factors-a", "1", "stone")[0] == USAGE


def test_sheets_of_workbooks(run, compared, files):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    P, Q = map(read_curve, files)
    with pandas.ExcelWriter("loops.xlsx") as book:
        for sheet, curve in (("about", P[:3]), ("test", P), ("2024", Q)):
            frame = pandas.DataFrame(curve, columns=["strain", "stress"])
            frame.to_excel(book, sheet_name=sheet, index=False)
    book = ["loops.xlsx"] * 2
    # A workbook's cells have 16 digits.
    expected = pytest.approx(curvewise.compare(P, Q).to_dict(), rel=1e-12)
    for sheets in (("test", "2024"), ("2", "3")):
        loaded = compared(*book, "--sheet-a", sheets[0], "--sheet-b", sheets[1])
        assert loaded["values"] == expected
    assert compared("loops.xlsx", "B.csv", "--sheet-a", "test")["values"] == expected
    assert_failed(run("compare", *book, "--sheet-b", "4"), "its sheets are about, test, 2024")


def test_time_is_not_compared_with_strain_without_a_word(run, output, files):
    Path("A.csv").write_text("Time [s],strain [%],stress,force\n0,0,0,0\n1,1,1,1\n")
    assert_failed(
        run("compare", *files),
        "the first two of the 4 columns of A.csv are Time [s] and strain [%]; name those wanted: "
        "--columns-a 'strain [%]' stress\n",
    )
    columns = ("--columns", "strain [%]", "stress", "--columns-b", "1", "2")
    assert "columns strain [%], stress\n" in output("compare", *files, *columns)
    output("compare", *files, "--columns", "1", "2")  # asked for
    for name in files:
        np.savetxt(name, np.column_stack([np.arange(5), [(0, 1), (2, 2), (1, 2), (0, 1), (0, 3)]]))
    status, _, error = run("compare", *files, "--columns", "1", "2", "3")
    assert status == 0
    assert error.startswith("curvewise: column 1 of 3 counts as a coordinate, and looks like time")
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "magic"),
    [("out.png", PNG), ("out.pdf", b"%PDF"), ("out.svg", b"<?xml"), ("no_ending", PNG)],
)
@pytest.mark.nightly("pdf|svg")
def test_compare_writes_the_picture_it_was_asked_for(output, files, name, magic):
    out = output("compare", *files, "--measures", "dtw", "--plot", name)
    assert out.endswith(f"\npicture: {name}\n")
    assert Path(name).read_bytes().startswith(magic)


def test_a_picture_does_not_disturb_the_json(compared, files):
    assert compared(*files, "--measures", "dtw", "--plot", "out.png")["n"] == [40, 30]
    assert os.path.getsize("out.png") > 10_000


def test_bad_data_is_one_line_with_its_place(run, files):
    Path("B.csv").write_text("strain,stress\n0,0\n1,abc\n")
    assert_failed(run("compare", *files), "B.csv, line 3, column 2 (stress): 'abc' is not a number")
    assert_failed(run("compare", "A.csv", "no.csv"), "no.csv: No such file or directory")
    assert_failed(run("compare", "A.csv", "."), ".: Is a directory")
    assert_failed(
        run("compare", *files, "--columns", "strain", "force"),
        "A.csv has no column 'force'; its columns are strain, stress",
    )


def test_curves_that_cannot_be_compared_are_named_by_their_files(run, files):
    Path("B.csv").write_text("1,1\n1,1\n")
    assert_failed(
        run("compare", "B.csv", "A.csv", "--measures", "pcm", "curve_length"),
        "P has zero length (all its points are equal); ",
        "(P is B.csv, Q is A.csv)",
    )
    Path("B.csv").write_text("1,1\n")
    area = ("--measures", "area")
    assert_failed(run("compare", *files, *area), "Q has shape (1, 2); ", "(P is A.csv, Q is B.csv)")


@pytest.mark.skipif(not os.path.exists("/proc/self/mem"), reason="a file that cannot be read")
def test_a_file_that_ends_in_an_error_while_it_is_read_is_named(run, files):
    assert_failed(run("compare", "/proc/self/mem", *files[1:]), "/proc/self/mem: Input/output err")


@pytest.mark.parametrize("name", ["no_such_folder/out.png", "."])
def test_a_picture_that_cannot_be_written(run, files, name):
    assert_failed(run("compare", *files, "--measures", "dtw", "--plot", name), name)


def test_an_unknown_kind_of_picture(run, files):
    result = run("compare", *files, "--plot", "out.xyz")
    assert_failed(result, "xyz", "png")
    assert not os.path.exists("out.xyz")


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("dp780_tct_3pct.csv", "dp780_tct_6pct.csv"),
        ("resslab_cyclic_2pct.csv", "resslab_random_protocol.csv"),
    ],
)
@pytest.mark.nightly("resslab")
def test_real_loops(output, data_dir, tmp_path, first, second):
    pair = [str(data_dir / "loops" / name) for name in (first, second)]
    picture = tmp_path / "out.png"
    out = output("compare", *pair, "--plot", str(picture))
    values = numbers(out)
    assert list(values) == MEASURES
    assert all(0.0 < value < np.inf for value in values.values())
    assert picture.read_bytes().startswith(PNG)


def test_compare_writes_bare_values_for_an_optimiser(output, files):
    out = output("compare", *files, "--measures", "dtw", "area", "--output", "f.txt")
    assert "dtw" in out
    expected = curvewise.compare(*map(read_curve, files))
    assert list(map(float, Path("f.txt").read_text().split())) == [
        expected["dtw"],
        expected["area"],
    ]


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_compare_writes_residuals_for_least_squares(output, files, preset):
    keywords = ["--preset", preset, "--measures", "curve_length"]
    output("compare", *files, *keywords, "--output", "f.txt", "--residuals")
    residuals = np.loadtxt("f.txt")
    P, Q = map(read_curve, files)
    assert residuals.shape == (2 * len(P),)
    value = curvewise.compare(P, Q, preset=preset)["curve_length"]
    assert np.linalg.norm(residuals) == pytest.approx(value, rel=1e-14)


def test_compare_writes_no_output_where_it_fails(run, files):
    np.savetxt("B.csv", np.zeros((3, 2)))
    assert_failed(run("compare", *files, "--output", "f.txt"), "B.csv")
    assert not os.path.exists("f.txt")
    status, _, error = run("compare", *files, "--residuals")
    assert status == USAGE
    assert "--residuals needs --output FILE" in error


def test_a_measure_without_a_value_does_not_hide_the_others(run, output, compared, files):
    np.savetxt("A.csv", [(0, 0), (2, 0), (4, 0)], delimiter=",")
    P, Q = map(read_curve, files)
    words = curvewise.compare(P, Q).refusals["curve_length"]
    assert f"\ncurve_length  no value: {words}\n" in output("compare", *files)
    loaded = compared(*files)
    assert loaded["refusals"] == {"curve_length": words}
    assert loaded["values"]["curve_length"] is None
    assert loaded["values"]["frechet"] == curvewise.compare(P, Q)["frechet"]
    output("compare", *files, "--plot", "out.png")
    assert Path("out.png").read_bytes().startswith(PNG)


def test_a_measure_that_was_asked_for_and_has_no_value_is_a_failure(run, files):
    np.savetxt("A.csv", [(0, 0), (2, 0), (4, 0)], delimiter=",")
    result = run("compare", *files, "--measures", "frechet", "curve_length")
    assert_failed(result, "curve_length has no value: P's y is 0")
    assert list(numbers(result[1])) == ["frechet"]
    # An optimiser needs every number.
    assert_failed(run("compare", *files, "--output", "f.txt"), "curve_length has no value: P's y")
    assert not Path("f.txt").exists()
