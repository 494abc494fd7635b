"""The command line: what it prints, where, and its exit status."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import curvewise
from curvewise import read_curve
from curvewise.commands import command_line as cli

MEASURES = ["area", "pcm", "frechet", "dtw", "curve_length"]
USAGE = 2
PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture
def files(tmp_path, monkeypatch):
    """Two curves in the plane, in a folder that is the working directory."""
    monkeypatch.chdir(tmp_path)
    experiment, simulation = (curve[:40] for curve in curvewise.datasets.hysteresis_pair())
    np.savetxt("A.csv", experiment, delimiter=",", header="strain,stress", comments="")
    np.savetxt("B.csv", simulation[:30], delimiter=";")
    return ["A.csv", "B.csv"]


@pytest.fixture
def run(capsys):
    """Run the command line in this process; return its status, output and error output."""

    def call(*arguments):
        try:
            status = cli.main(arguments)
        except SystemExit as stopped:
            status = stopped.code
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return call


def python(*arguments, **options):
    command = [sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, **options)


def numbers(text):
    """Return the values that a printed table gives, by name."""
    return {name: float(value) for name, value in re.findall(r"^(\w+) {2,}(\S+)$", text, re.M)}


def assert_failed(result, *parts):
    """Status 1, nothing but one line on standard error, which holds all `parts`."""
    status, _, error = result
    assert status == 1
    assert error.startswith("curvewise: ")
    assert error.count("\n") == 1
    for part in parts:
        assert part in error


def test_compare_prints_files_points_and_values(run, files):
    status, out, error = run("compare", *files)
    assert (status, error) == (0, "")
    assert "P  A.csv, 40 points, columns strain, stress\n" in out
    assert "Q  B.csv, 30 points, columns 1, 2\npreset scaled\n" in out
    expected = curvewise.compare(read_curve("A.csv"), read_curve("B.csv"))
    assert str(expected) in out
    assert list(numbers(out)) == MEASURES
    for name, found in expected.deviations.items():
        assert f"\n{name:<12}  {found}\n" in out


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_compare_json_is_one_object(run, files, preset):
    status, out, error = run("compare", *files, "--json", "--preset", preset)
    assert (status, error) == (0, "")
    expected = curvewise.compare(read_curve("A.csv"), read_curve("B.csv"), preset=preset)
    assert json.loads(out) == {
        "files": ["A.csv", "B.csv"],
        "columns": [["strain", "stress"], ["1", "2"]],
        "factors": [None, None],
        "preset": preset,
        "n": [40, 30],
        "values": expected.to_dict(),
        "deviations": {name: found._asdict() for name, found in expected.deviations.items()},
    }


def test_a_value_beyond_the_range_of_a_double_is_null_in_json(run, files):
    for name, offset in (("A.csv", 0.0), ("B.csv", 1.5e308)):
        np.savetxt(name, np.full((3, 1), offset), delimiter=",")
    _, out, _ = run("compare", *files, "--json", "--preset", "raw")
    assert json.loads(out)["values"] == {"frechet": 1.5e308, "dtw": None}
    assert json.loads(out)["deviations"]["frechet"]["largest"] == 1.5e308
    status, out, _ = run("compare", *files, "--preset", "raw")
    assert status == 0
    assert "dtw      inf\n" in out


def test_options_of_area_and_dtw_replace_those_of_the_preset(run, files):
    P, Q = map(read_curve, files)
    given = ("--json", "--preset", "raw", "--measures", "area", "dtw")
    _, out, _ = run("compare", *files, *given, "--spacing", "x", "--crossing", "split")
    assert json.loads(out)["values"] == {
        "area": curvewise.area(P, Q, spacing="x", crossing="split"),
        "dtw": curvewise.dtw(P, Q),
    }
    for window in ("12", "0.3"):
        _, out, _ = run("compare", *files, *given, "--window", window)
        expected = curvewise.dtw(P, Q, window=float(window) if "." in window else int(window))
        assert json.loads(out)["values"]["dtw"] == expected
    for window in ("1.5", "wide"):
        status, _, error = run("compare", *files, *given, "--window", window)
        assert status == USAGE
        assert f"{window} is no whole number, and not between 0 and 1" in error
    assert run("compare", *files, "--spacing", "even")[0] == USAGE
    assert_failed(run("compare", *files, "--window", "-1"), "window is -1; give a whole number")
    of_area = ("--measures", "area", "--window", "5")
    assert_failed(run("compare", *files, *of_area), "options are given for 'dtw'")


def test_measures_are_those_asked_for(run, files):
    _, out, _ = run("compare", *files, "--measures", "dtw", "area", "--json")
    assert list(json.loads(out)["values"]) == ["dtw", "area"]


def test_every_measure_of_compare_can_be_asked_for(run, files):
    status, out, _ = run("compare", *files, "--measures", *MEASURES)
    assert status == 0
    assert list(curvewise.compare(*map(read_curve, files)).values) == MEASURES == list(numbers(out))


def test_columns_are_chosen_in_both_files(run, files):
    with open("A.csv", "w") as file:
        file.write("t,strain,stress\n0,0,0\n1,1,1\n2,2,0\n")
    with open("B.csv", "w") as file:
        file.write("stress;strain;t\n0;0;0\n2;1;1\n0;2;2\n")
    _, out, _ = run("compare", *files, "--json", "--preset", "raw", "--columns", "strain", "stress")
    values = json.loads(out)["values"]
    assert json.loads(out)["columns"] == [["strain", "stress"]] * 2
    expected = curvewise.compare([(0, 0), (1, 1), (2, 0)], [(0, 0), (1, 2), (2, 0)], preset="raw")
    assert values == expected.to_dict()
    _, out, _ = run("compare", *files, "--json", "--preset", "raw", "--columns", "stress")
    assert json.loads(out)["values"] == {"frechet": 1.0, "dtw": 1.0}
    _, out, _ = run("compare", *files, "--json", "--preset", "raw", "--columns", "1", "2", "3")
    assert list(json.loads(out)["values"]) == ["frechet", "dtw"]


def test_factors_change_the_units_of_each_file(run, files):
    P, Q = map(read_curve, files)
    np.savetxt("A.csv", P * [100.0, 1e6], delimiter=",", header="strain,stress", comments="")
    given = ("--preset", "raw", "--factors-a", "0.01", "1e-6")
    status, out, error = run("compare", *files, *given)
    assert (status, error) == (0, "")
    assert "P  A.csv, 40 points, columns strain × 0.01, stress × 1e-06\n" in out
    assert "Q  B.csv, 30 points, columns 1, 2\n" in out
    _, out, _ = run("compare", *files, *given, "--factors-b", "1", "-1", "--json")
    assert json.loads(out)["factors"] == [[0.01, 1e-6], [1.0, -1.0]]
    scaled = read_curve("A.csv", factors=[0.01, 1e-6])
    assert json.loads(out)["values"]["dtw"] == curvewise.dtw(scaled, Q * [1.0, -1.0])
    assert_failed(
        run("compare", *files, "--factors-b", "2"),
        "factors has shape (1,); B.csv gives 2 columns, and each needs one",
    )
    assert run("compare", *files, "--factors-a", "1", "MPa")[0] == USAGE


def test_sheets_of_workbooks(run, files):
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
        _, out, _ = run("compare", *book, "--json", "--sheet-a", sheets[0], "--sheet-b", sheets[1])
        assert json.loads(out)["values"] == expected
    _, out, _ = run("compare", "loops.xlsx", "B.csv", "--json", "--sheet-a", "test")
    assert json.loads(out)["values"] == expected
    assert_failed(run("compare", *book, "--sheet-b", "4"), "its sheets are about, test, 2024")


def test_time_is_not_compared_with_strain_without_a_word(run, files):
    with open("A.csv", "w") as file:
        file.write("Time [s],strain [%],stress,force\n0,0,0,0\n1,1,1,1\n")
    assert_failed(
        run("compare", *files),
        "the first two of the 4 columns of A.csv are Time [s] and strain [%]; name those wanted: "
        "--columns 'strain [%]' stress\n",
    )
    columns = ("--columns", "strain [%]", "stress", "--columns-b", "1", "2")
    status, out, error = run("compare", *files, *columns)
    assert (status, error) == (0, "")
    assert "columns strain [%], stress\n" in out
    assert run("compare", *files, "--columns", "1", "2")[0] == 0  # asked for
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
def test_compare_writes_the_picture_it_was_asked_for(run, files, name, magic):
    status, out, error = run("compare", *files, "--plot", name)
    assert (status, error) == (0, "")
    assert out.endswith(f"\npicture: {name}\n")
    with open(name, "rb") as file:
        assert file.read(len(magic)) == magic


def test_a_picture_does_not_disturb_the_json(run, files):
    status, out, _ = run("compare", *files, "--json", "--plot", "out.png")
    assert status == 0
    assert json.loads(out)["n"] == [40, 30]
    assert os.path.getsize("out.png") > 10_000


def test_demo_prints_five_measures_and_writes_a_picture(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, error = run("demo")
    assert (status, error) == (0, "")
    assert "241 points" in out
    assert "151 points" in out
    expected = curvewise.compare(*curvewise.datasets.hysteresis_pair())
    assert str(expected) in out
    assert list(numbers(out)) == MEASURES
    assert out.endswith("\npicture: curvewise_demo.png\n")
    assert (tmp_path / "curvewise_demo.png").read_bytes().startswith(PNG)


def test_demo_writes_where_it_is_told(run, tmp_path):
    output = tmp_path / "here.svg"
    status, out, _ = run("demo", "--output", str(output))
    assert status == 0
    assert str(output) in out
    assert output.read_bytes().startswith(b"<?xml")


def test_without_matplotlib_a_picture_fails_first_and_the_rest_works(run, files, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    for arguments in (["demo"], ["compare", *files, "--plot", "out.png"]):
        result = run(*arguments)
        assert_failed(result, 'pip install "curvewise[plot]"')
        assert result[1] == ""
    assert run("compare", *files)[0] == 0


def test_matplotlib_is_imported_for_pictures_only(files):
    code = (
        "import sys; from curvewise.commands import main; main(sys.argv[1:]);"
        "assert not any(name.startswith('matplotlib') for name in sys.modules)"
    )
    done = python("-c", code, "compare", *files)
    assert (done.returncode, done.stderr) == (0, "")


def test_bad_data_is_one_line_with_its_place(run, files):
    with open("B.csv", "w") as file:
        file.write("strain,stress\n0,0\n1,abc\n")
    assert_failed(run("compare", *files), "B.csv, line 3, column 2 (stress): 'abc' is not a number")
    assert_failed(run("compare", "A.csv", "no.csv"), "no.csv: No such file or directory")
    assert_failed(run("compare", "A.csv", "."), ".: Is a directory")
    assert_failed(
        run("compare", *files, "--columns", "strain", "force"),
        "A.csv has no column 'force'; its columns are strain, stress",
    )


def test_curves_that_cannot_be_compared_are_named_by_their_files(run, files):
    with open("B.csv", "w") as file:
        file.write("1,1\n1,1\n")
    assert_failed(
        run("compare", "B.csv", "A.csv"),
        "P has zero length (all its points are equal); ",
        "(P is B.csv, Q is A.csv)",
    )
    with open("B.csv", "w") as file:
        file.write("1,1\n")
    assert_failed(run("compare", *files), "Q has shape (1, 2); ", "(P is A.csv, Q is B.csv)")


@pytest.mark.parametrize("name", ["no_such_folder/out.png", "."])
def test_a_picture_that_cannot_be_written(run, files, name):
    assert_failed(run("compare", *files, "--plot", name), name)


def test_an_unknown_kind_of_picture(run, files):
    result = run("compare", *files, "--plot", "out.xyz")
    assert_failed(result, "xyz", "png")
    assert not os.path.exists("out.xyz")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ([], "command"),
        (["bogus"], "bogus"),
        (["compare", "A.csv"], "B"),
        (["compare", "A.csv", "B.csv", "--preset", "best"], "'paper'"),
        (["compare", "A.csv", "B.csv", "--measures", "area", "lcss"], "lcss"),
        (["compare", "A.csv", "B.csv", "--measures"], "--measures"),
        (["compare", "A.csv", "B.csv", "--columns"], "--columns"),
        (["info", "more"], "more"),
    ],
)
def test_wrong_usage_is_status_2(run, files, arguments, part):
    status, out, error = run(*arguments)
    assert (status, out) == (USAGE, "")
    assert error.startswith("usage: curvewise")
    assert part in error


def test_help_version_and_info(run):
    status, out, _ = run("--help")
    assert status == 0
    assert all(command in out for command in ("compare", "demo", "selfcheck", "info"))
    assert run("--version") == (0, f"curvewise {curvewise.__version__}\n", "")
    status, out, error = run("info")
    assert (status, error) == (0, "")
    information = dict(re.split("  +", line, maxsplit=1) for line in out.splitlines())
    expected = curvewise.installation.build_info()
    assert information["version"] == expected["version"]
    assert information["compiler"] == expected["compiler"]
    assert information["eigen"] == expected["eigen"]
    assert information["instruction sets"].split() == expected["instruction_sets"]
    assert information["active"] == expected["active"]


@pytest.mark.parametrize(("equal", "expected"), [(True, 0), (False, 1)])
def test_selfcheck_reports_what_it_found(run, monkeypatch, equal, expected):
    def report(stream):
        print("dtw baseline", file=stream)
        return equal

    monkeypatch.setattr("curvewise.commands.kernel_check.run", report)
    assert run("selfcheck") == (expected, "dtw baseline\n", "")


def test_selfcheck_passes_on_this_machine(run):
    status, out, error = run("selfcheck")
    assert (status, error) == (0, "")
    assert curvewise.installation.build_info()["active"] in out


@pytest.mark.parametrize(
    ("error", "status", "message"),
    [
        (KeyboardInterrupt(), 130, ""),
        (MemoryError("dtw_table needs 74.5 GiB"), 1, "curvewise: dtw_table needs 74.5 GiB\n"),
        (MemoryError(), 1, "curvewise: not enough memory\n"),
        (ValueError("two\nlines"), 1, "curvewise: two lines (P is A.csv, Q is B.csv)\n"),
    ],
)
def test_what_ends_a_comparison(run, files, monkeypatch, error, status, message):
    def fail(*args, **kwargs):
        raise error

    monkeypatch.setattr("curvewise.commands.compare.compare", fail)
    assert run("compare", *files) == (status, "", message)


def test_a_sentence_of_our_own_reaches_people_as_it_is(run, monkeypatch):
    def fail(*_):
        raise OSError("the store s.db cannot be used: database is locked")

    monkeypatch.setattr("curvewise.calibration.report.records_of", fail)
    expected = "curvewise: the store s.db cannot be used: database is locked\n"
    assert run("report", "s.db") == (1, "", expected)


def test_a_mistake_in_the_program_keeps_its_traceback(files, monkeypatch):
    monkeypatch.setattr("curvewise.commands.compare.compare", lambda *args, **kwargs: None)
    with pytest.raises(AttributeError):
        cli.main(["compare", *files])


def test_as_a_module_with_real_exit_statuses(files):
    good = python("-m", "curvewise", "compare", *files, "--json")
    assert (good.returncode, good.stderr) == (0, "")
    assert json.loads(good.stdout)["files"] == files
    bad = python("-m", "curvewise", "compare", "A.csv", "no.csv")
    assert (bad.returncode, bad.stdout) == (1, "")
    assert bad.stderr == "curvewise: no.csv: No such file or directory\n"
    usage = python("-m", "curvewise", "compare")
    assert (usage.returncode, usage.stdout) == (USAGE, "")
    assert usage.stderr.startswith("usage: curvewise compare")


@pytest.mark.skipif(os.name != "posix", reason="a pipe closed by its reader, as a shell makes it")
@pytest.mark.parametrize("argument", ["info", "--help"])
def test_a_closed_pipe_ends_it_quietly(argument):
    reader, writer = os.pipe()
    os.close(reader)
    # Buffered, as a user has it: unbuffered, argparse itself ignores that its help went nowhere.
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}
    with open(writer, "w") as output:
        done = subprocess.run(
            [sys.executable, "-m", "curvewise", argument],
            env=environment,
            stdout=output,
            stderr=subprocess.PIPE,
            timeout=60,
        )
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_full_disk_is_reported_once():
    with open("/dev/full", "w") as output:
        done = subprocess.run(
            [sys.executable, "-m", "curvewise", "info"],
            stdout=output,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
        )
    assert done.returncode == 1
    assert done.stderr == ("curvewise: the output cannot be written: No space left on device\n")


def test_a_terminal_without_utf_8_does_not_matter(tmp_path):
    path = tmp_path / "Längung.csv"
    path.write_text("0,0\n1,1\n")
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    done = python("-m", "curvewise", "compare", str(path), str(path), env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert r"L\xe4ngung.csv, 2 points" in done.stdout


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("dp780_tct_3pct.csv", "dp780_tct_6pct.csv"),
        ("resslab_cyclic_2pct.csv", "resslab_random_protocol.csv"),
    ],
)
def test_real_loops(run, data_dir, tmp_path, first, second):
    pair = [str(data_dir / "loops" / name) for name in (first, second)]
    picture = tmp_path / "out.png"
    status, out, error = run("compare", *pair, "--plot", str(picture))
    assert (status, error) == (0, "")
    values = numbers(out)
    assert list(values) == MEASURES
    assert all(0.0 < value < np.inf for value in values.values())
    assert picture.read_bytes().startswith(PNG)


def test_compare_writes_bare_values_for_an_optimiser(run, files):
    status, out, error = run("compare", *files, "--measures", "dtw", "area", "--output", "f.txt")
    assert (status, error) == (0, "")
    assert "dtw" in out
    expected = curvewise.compare(*map(read_curve, files))
    with open("f.txt") as file:
        assert [float(line) for line in file] == [expected["dtw"], expected["area"]]


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_compare_writes_residuals_for_least_squares(run, files, preset):
    keywords = ["--preset", preset, "--measures", "curve_length"]
    status, _, error = run("compare", *files, *keywords, "--output", "f.txt", "--residuals")
    assert (status, error) == (0, "")
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
