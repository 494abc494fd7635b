"""A solver's process: how it ends, or is ended, with all that it has started."""

from __future__ import annotations

import contextlib
import pickle
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from solver_scripts import (
    SOLVER,
    Pipe,
    parent_and_child,
    posix,
    python_model,
    read_curve,
    wait_until,
)

from curvewise.calibration import CommandModel, SolverError
from curvewise.calibration.models.process import end_of_log


def log_of(error: SolverError) -> Path:
    return Path(str(error).splitlines()[0].rpartition("log: ")[2])


@pytest.mark.parametrize(
    ("lines", "quoted"),
    [
        ([], []),
        (["stop"], ["stop"]),
        (["", "x" * 500, "", "diverged \xb2"], ["x" * 120, "diverged \ufffd"]),
        ([f"increment {i}" for i in range(20000)], [f"increment {i}" for i in range(19994, 20000)]),
        (
            ["*ERROR reading *ELASTIC:", " <<E>>", "info", *"abcdef"],
            ["*ERROR reading *ELASTIC:", " <<E>>", "...", *"abcdef"],
        ),
        ([*"abcdef", "some error"], [*"bcdef", "some error"]),
    ],
)
def test_the_end_of_a_log_is_quoted(tmp_path: Path, lines: list[str], quoted: list[str]) -> None:
    log = tmp_path / "command.log"
    log.write_text("\n".join(lines), encoding="latin-1")
    assert end_of_log(log).split("\n  | ") == ["", *quoted]


def test_an_exit_code_keeps_the_log(tmp_path: Path) -> None:
    script = "import sys\nprint('negative volume <<E>>')\nprint('stop', file=sys.stderr)\n"
    model = python_model(tmp_path, script + "sys.exit(3)\n")
    with pytest.raises(SolverError, match=r"ended with exit code 3 after .* s; log: ") as caught:
        model({"E": 1.5})
    log = log_of(caught.value)
    assert set(log.read_text().splitlines()) == {"negative volume 1.5", "stop"}
    assert (log.parent / "solver.py").exists()
    assert {"  | negative volume 1.5", "  | stop"} == set(str(caught.value).splitlines()[1:])
    assert pickle.loads(pickle.dumps(caught.value)).args == caught.value.args


def test_a_program_that_prints_without_end_is_stopped(tmp_path: Path) -> None:
    script = "# <<E>>\nimport sys\nwhile True: sys.stdout.write('x' * 2**20)\n"
    model = python_model(tmp_path, script, timeout=600)
    with pytest.raises(SolverError, match="printed more than 64 MiB and was stopped") as caught:
        model({"E": 1.0})
    log = Path(str(caught.value).rpartition("the first of it: ")[2])
    assert log.read_bytes() == b"x" * 2**20


@posix
def test_a_killed_solver_is_an_error(tmp_path: Path) -> None:
    model = python_model(tmp_path, "import os\nos.kill(os.getpid(), 9)  # <<E>>\n")
    with pytest.raises(SolverError, match=r"was killed by signal 9 after .* s; log: "):
        model({"E": 1.0})


@posix
def test_a_time_out_ends_the_whole_process_group(tmp_path: Path) -> None:
    pipe = Pipe(tmp_path)
    model = python_model(tmp_path, parent_and_child(pipe), timeout=3.0)
    with pytest.raises(SolverError, match="took longer than 3 s and was stopped") as caught:
        model({"E": 1.0})
    assert pipe.all_gone(processes=2)
    log = log_of(caught.value)
    assert log.read_text() == "iteration 1\n"


@posix
def test_what_a_solver_leaves_running_is_ended(tmp_path: Path) -> None:
    pipe = Pipe(tmp_path)
    child = f"import time; {pipe.hold}; open('up', 'w').close(); time.sleep(600)"
    script = (
        "import os, subprocess, sys, time\n"
        f"subprocess.Popen([sys.executable, '-c', {child!r}])\n"
        "while not os.path.exists('up'): time.sleep(0.01)\n" + SOLVER
    )
    model = python_model(tmp_path, script)
    assert model({"E": 4.0}).tolist() == [[0.0, 0.0], [1.0, 4.0]]
    assert pipe.all_gone(processes=1)


@contextlib.contextmanager
def interrupted(
    folder: Path, solver: str, call: str, handler: str = "default_int_handler"
) -> Iterator[subprocess.Popen[bytes]]:
    """Run a call that uses `model` in a separate process, which reports when it is interrupted."""
    (folder / "solver.py").write_text(solver)
    scratch = folder / "scratch"
    scratch.mkdir()
    script = folder / "script.py"
    script.write_text(
        "import signal, sys\n"
        "from curvewise.calibration import CommandModel, identify\n"
        f"model = CommandModel({str(folder / 'solver.py')!r}, [sys.executable, 'solver.py'],\n"
        f"    print, parameters=['E'], timeout=600, scratch={str(scratch)!r})\n"
        "if __name__ == '__main__':\n"
        # What a shell starts in the background ignores SIGINT, and so do its children.
        f"    signal.signal(signal.SIGINT, signal.{handler})\n"
        f"    try:\n        {call}\n"
        "    except KeyboardInterrupt:\n        print('interrupted')\n"
    )
    with subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE) as process:
        try:
            yield process
        finally:
            process.kill()


@posix
def test_ctrl_c_ends_the_solver_and_removes_the_folder(tmp_path: Path) -> None:
    pipe = Pipe(tmp_path)
    with interrupted(tmp_path, parent_and_child(pipe), "model({'E': 1.0})") as process:
        wait_until(lambda: pipe.started() == 2)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=60)
    assert output == b"interrupted\n"
    assert pipe.all_gone(processes=2)
    assert list((tmp_path / "scratch").iterdir()) == []


@posix
def test_a_program_that_has_gone_is_an_error(tmp_path: Path) -> None:
    program = tmp_path / "solver"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    template = tmp_path / "deck.inp"
    template.write_text("<<E>>")
    model = CommandModel(template, [str(program)], read_curve, parameters=["E"], timeout=60)
    program.unlink()
    with pytest.raises(SolverError, match=r"solver did not start: .*; folder: ") as caught:
        model({"E": 1.0})
    shutil.rmtree(str(caught.value).rpartition("folder: ")[2])


SEARCH = "identify(model, [(0.0, 0.0), (1.0, 5.0)], {'E': (0.0, 10.0)}, workers=2, progress=False)"


@posix
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
@pytest.mark.nightly("9")
def test_no_solver_outlives_an_identification(tmp_path: Path, how: signal.Signals) -> None:
    pipe = Pipe(tmp_path)
    with interrupted(tmp_path, parent_and_child(pipe), SEARCH) as process:
        wait_until(lambda: pipe.started() == 4)
        process.send_signal(how)
        output, _ = process.communicate(timeout=60)
    assert output == (b"interrupted\n" if how == signal.SIGINT else b"")
    assert pipe.all_gone(processes=4)
    wait_until(lambda: not list((tmp_path / "scratch").iterdir()))


@posix
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
@pytest.mark.nightly("15")
def test_nor_one_that_was_started_in_the_background(tmp_path: Path, how: signal.Signals) -> None:
    """There, SIGINT is ignored."""
    pipe = Pipe(tmp_path)
    with interrupted(tmp_path, parent_and_child(pipe), SEARCH, "SIG_IGN") as process:
        wait_until(lambda: pipe.started() == 4)
        process.send_signal(how)
        process.communicate(timeout=60)
    assert pipe.all_gone(processes=4)
    wait_until(lambda: not list((tmp_path / "scratch").iterdir()))
