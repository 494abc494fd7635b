"""The command line: usage, exit statuses, and what becomes of errors and of the output."""

from __future__ import annotations

import json
import os
import re
import sys
import warnings

import pytest
from command_runs import USAGE, assert_failed, python

import curvewise
from curvewise.commands import main


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


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ([], "command"),
        (["bogus"], "bogus"),
        (["compare", "A.csv"], "B"),
        (["compare", "A.csv", "B.csv", "--preset", "best"], "'paper'"),
        (["compare", "A.csv", "B.csv", "--measures", "area", "ssim"], "ssim"),
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


def test_help_version_and_info(output):
    out = output("--help")
    assert all(command in out for command in ("compare", "demo", "selfcheck", "info"))
    assert output("--version") == f"curvewise {curvewise.__version__}\n"
    out = output("info")
    information = dict(re.split("  +", line, maxsplit=1) for line in out.splitlines())
    expected = curvewise.installation.build_info()
    for key in ("version", "compiler", "eigen", "active"):
        assert information[key] == expected[key]
    assert information["instruction sets"].split() == expected["instruction_sets"]


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


def test_a_warning_is_said_without_its_line_of_python(run, monkeypatch):
    def warned():
        warnings.warn("test.csv: 3 lines left out", stacklevel=1)
        return {}

    monkeypatch.setattr("curvewise.commands.info.build_info", warned)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        assert run("info") == (0, "", "curvewise: test.csv: 3 lines left out\n")


def test_a_mistake_in_the_program_keeps_its_traceback(files, monkeypatch):
    monkeypatch.setattr("curvewise.commands.compare.compare", lambda *args, **kwargs: None)
    with pytest.raises(AttributeError):
        main(["compare", *files])


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
        done = python("-m", "curvewise", argument, env=environment, stdout=output)
    assert (done.returncode, done.stderr) == (141, "")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_full_disk_is_reported_once():
    with open("/dev/full", "w") as output:
        done = python("-m", "curvewise", "info", stdout=output)
    assert done.returncode == 1
    assert done.stderr == ("curvewise: the output cannot be written: No space left on device\n")


def test_a_terminal_without_utf_8_does_not_matter(tmp_path):
    path = tmp_path / "Längung.csv"
    path.write_text("0,0\n1,1\n")
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    done = python("-m", "curvewise", "compare", str(path), str(path), env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert r"L\xe4ngung.csv, 2 points" in done.stdout
