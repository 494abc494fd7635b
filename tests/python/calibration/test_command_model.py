"""CommandModel: small Python scripts in the place of a solver, and CalculiX where it is installed.

Whether processes have ended is told by a named pipe that they hold open: its reader sees the end
of the file when the last of them is gone, without asking for process ids, which are reused.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import CommandModel, SolverError, identify
from curvewise.calibration.command_model import _placeholders

SOLVER = "open('curve.txt', 'w').write('0 0\\n1 <<E>>\\n')\n"

posix = pytest.mark.skipif(os.name != "posix", reason="process groups are POSIX's")


def read_curve(folder: Path) -> Any:
    return np.loadtxt(folder / "curve.txt")


def python_model(folder: Path, script: str, **options: Any) -> CommandModel:
    """Return a model whose solver is a Python script with the placeholder <<E>>."""
    template = folder / "solver.py"
    template.write_text(script)
    scratch = folder / "scratch"
    scratch.mkdir(exist_ok=True)
    settings = {"read": read_curve, "parameters": ["E"], "timeout": 60.0, "scratch": scratch}
    settings.update(options)
    return CommandModel(template, [sys.executable, "solver.py"], **settings)


def filled(folder: Path, text: str, value: float | str) -> str:
    """Return a line of a deck as the solver gets it."""
    deck = folder / "deck.inp"
    deck.write_text(text)
    model = CommandModel(
        deck,
        [sys.executable, "-c", ""],
        lambda run: np.frombuffer((run / "deck.inp").read_bytes(), np.uint8).astype(float),
        parameters=["E"],
        timeout=60,
    )
    return bytes(model({"E": value}).astype(np.uint8)).decode()


class Pipe:
    """A named pipe, and what the solver's processes do with it."""

    HOLD = "pipe = open({path!r}, 'wb', buffering=0); pipe.write(b'.')"

    def __init__(self, folder: Path) -> None:
        self.path = folder / "pipe"
        os.mkfifo(self.path)
        self._reader = os.open(self.path, os.O_RDONLY | os.O_NONBLOCK)
        self._started = 0

    @property
    def hold(self) -> str:
        return self.HOLD.format(path=str(self.path))

    def started(self) -> int:
        """Return how many processes have opened the pipe so far."""
        self._listen()
        return self._started

    def all_gone(self, processes: int) -> bool:
        """Return whether so many processes have opened the pipe and all are gone."""
        wait_until(self._listen)
        os.close(self._reader)
        return self._started == processes

    def _listen(self) -> bool:
        """Count who has opened the pipe; return whether nobody holds it."""
        try:
            data = os.read(self._reader, 100)
        except BlockingIOError:
            return False
        self._started += len(data)
        return not data


def wait_until(condition: Any, seconds: float = 20.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.01)


def parent_and_child(pipe: Pipe) -> str:
    """Return a solver that starts another one, which ignores SIGTERM, and never ends."""
    child = f"import signal, time; signal.signal(15, signal.SIG_IGN); {pipe.hold}; time.sleep(600)"
    return (
        f"import subprocess, sys, time\n{pipe.hold}\n# <<E>>\n"
        f"subprocess.Popen([sys.executable, '-c', {child!r}])\n"
        "print('iteration 1', flush=True)\ntime.sleep(600)\n"
    )


def test_a_run_returns_the_curve_and_leaves_nothing_behind(tmp_path: Path) -> None:
    model = python_model(tmp_path, SOLVER)
    assert model({"E": 205000.5}).tolist() == [[0.0, 0.0], [1.0, 205000.5]]
    assert list((tmp_path / "scratch").iterdir()) == []


def test_a_list_of_curves_stays_one(tmp_path: Path) -> None:
    model = python_model(tmp_path, SOLVER, read=lambda run: [read_curve(run), [1, 2]])
    curves = model({"E": 3})
    assert [curve.tolist() for curve in curves] == [[[0.0, 0.0], [1.0, 3.0]], [1.0, 2.0]]


def test_keep_keeps_deck_and_log(tmp_path: Path) -> None:
    model = python_model(tmp_path, SOLVER + "print('done')\n", keep=True)
    model({"E": 7.0})
    (folder,) = (tmp_path / "scratch").iterdir()
    assert "1 7.0" in (folder / "solver.py").read_text()
    assert (folder / "command.log").read_text() == "done\n"


def test_the_environment_is_added_to(tmp_path: Path) -> None:
    script = (
        "import os\nassert os.environ['PATH']\n"
        "open('curve.txt', 'w').write(f\"0 0\\n<<E>> {os.environ['THREADS']}\\n\")\n"
    )
    model = python_model(tmp_path, script, environment={"THREADS": "1"})
    assert model({"E": 2.0}).tolist() == [[0.0, 0.0], [2.0, 1.0]]


@pytest.mark.parametrize(
    ("text", "value", "expected"),
    [
        ("*ELASTIC\n<<E>>, 0.3", 0.1, "*ELASTIC\n0.1, 0.3"),
        ("<<E>>", np.float64(2.5), "2.5"),
        ("<<E>>", 3, "3.0"),
        ("<< E : .3e >>,", 205000.0, "2.050e+05,"),
        ("|<<E:10>>|", 205000.0, "|205000.000|"),
        ("|<<E:10>>|", -1.0 / 3.0, "|-0.3333333|"),
        ("|<<E:10>>|", -1.23456789e-12, "|-1.235e-12|"),
        ("|<<E:8>>|", 1.0, "|1.000000|"),
        ("|<<E:20>>|", 0.1, "| 0.10000000000000001|"),
        ("|<<E:10.2f>>|", 1.5, "|      1.50|"),
        ("<<E>>;<<E:.1f>>", 1.0, "1.0;1.0"),
        ("<<E>>", "400, 0\n500, 0.1", "400, 0\n500, 0.1"),
    ],
)
def test_placeholders_are_filled(tmp_path: Path, text: str, value: Any, expected: str) -> None:
    assert filled(tmp_path, text, value) == expected


def test_what_solvers_write_with_signs_is_left_alone(tmp_path: Path) -> None:
    deck = "$ LS-DYNA &E\n** Abaqus <E>\n{E} %E% #E ${E} $E\n! APDL\n 1 << 2 >\n"
    assert filled(tmp_path, deck + "<<E>>", 1.0) == deck + "1.0"


def test_bytes_and_line_ends_survive(tmp_path: Path) -> None:
    template = tmp_path / "deck.inp"
    template.write_bytes(b"** M\xfcller\r\n<<E>>\r\n")
    model = CommandModel(
        template,
        [sys.executable, "-c", ""],
        lambda run: np.array([(run / "deck.inp").read_bytes() == b"** M\xfcller\r\n2.0\r\n"]),
        parameters=["E"],
        timeout=60,
    )
    assert model({"E": 2.0}).tolist() == [1.0]


@pytest.mark.parametrize(
    ("text", "value", "message"),
    [
        ("1\n<<E:8.3e>>", -1.0, r"deck.inp, line 2: <<E:8.3e>>: -1.000e\+00 is longer than"),
        ("<<E:>6.2f>>", 12345.0, "12345.00 is longer than the field"),
        ("<<E:4>>", -1e-9, "does not fit; widen the field"),
        ("<<E:.3f>>", "text", "line 1"),
        ("<<E>>", float("nan"), "parameter E is nan; parameters must be finite"),
    ],
)
def test_values_that_do_not_fit_are_refused(
    tmp_path: Path, text: str, value: Any, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        filled(tmp_path, text, value)


def test_placeholders_are_what_stands_between_two_brackets_of_a_line() -> None:
    rng = random.Random(4)
    for _ in range(3000):
        text = "".join(rng.choices("<>\nE", [6, 6, 1, 2], k=rng.randrange(40)))
        expected = [match.span() for match in re.finditer("<<(.*?)>>", text)]
        assert list(_placeholders(text)) == expected, text


def test_open_brackets_take_linear_time(tmp_path: Path) -> None:
    text = "<<" * 300_000  # read again for each of them, they would take an hour
    assert filled(tmp_path, f"<<E>>\n{text}", 1.5) == f"1.5\n{text}"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<<E>>\n<<nu>>", "deck.inp, line 2: <<nu>> is no parameter; the parameters are E"),
        ("0.3", "no template has a placeholder <<E>>"),
        ("<<E*2>>", r"<<E\*2>> is malformed"),
        ("<<>>", "<<>> is malformed"),
        ("<<E:ten>>", "<<E:ten>> has no format of a number"),
        ("<<E:d>>", "<<E:d>> has no format of a number"),
    ],
)
def test_wrong_placeholders_are_found_before_the_first_run(
    tmp_path: Path, text: str, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        filled(tmp_path, text, 1.0)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"command": "ccx -i deck"}, ValueError, "give a list"),
        ({"command": []}, ValueError, "give a list"),
        ({"command": ["no-such-solver"]}, FileNotFoundError, "no program 'no-such-solver'"),
        ({"timeout": 0}, ValueError, "positive number of seconds"),
        ({"timeout": float("nan")}, ValueError, "positive number of seconds"),
        ({"parameters": "E"}, ValueError, "give a list of names"),
        ({"scratch": "no-such-folder"}, FileNotFoundError, "no folder 'no-such-folder'"),
        ({"template_files": "no-such-deck"}, FileNotFoundError, "no template 'no-such-deck'"),
        ({"template_files": ["deck.inp", "deck.inp"]}, ValueError, "two templates"),
        ({"template_files": ["command.log"]}, ValueError, "as the log is"),
    ],
)
def test_wrong_arguments_are_refused(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: dict[str, Any],
    error: type[Exception],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("deck.inp").write_text("<<E>>")
    right = {
        "template_files": "deck.inp",
        "command": [sys.executable],
        "read": read_curve,
        "parameters": ["E"],
        "timeout": 1.0,
    }
    with pytest.raises(error, match=message):
        CommandModel(**{**right, **arguments})


def test_parameters_of_a_call_are_checked(tmp_path: Path) -> None:
    model = python_model(tmp_path, SOLVER)
    with pytest.raises(ValueError, match="got parameters G; the model's are E"):
        model({"G": 1.0})
    with pytest.raises(ValueError, match="got parameters E, G; the model's are E"):
        model({"E": 1.0, "G": 1.0})


def test_an_exit_code_keeps_the_log(tmp_path: Path) -> None:
    script = "import sys\nprint('negative volume <<E>>')\nprint('stop', file=sys.stderr)\n"
    model = python_model(tmp_path, script + "sys.exit(3)\n")
    with pytest.raises(SolverError, match=r"ended with exit code 3 after .* s; log: ") as caught:
        model({"E": 1.5})
    log = Path(str(caught.value).rpartition("log: ")[2])
    assert set(log.read_text().splitlines()) == {"negative volume 1.5", "stop"}
    assert (log.parent / "solver.py").exists()
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
    log = Path(str(caught.value).rpartition("log: ")[2])
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
    """Run a call that uses `model` in a process of its own, which says when it is interrupted."""
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


@pytest.mark.parametrize(
    ("curve", "message"),
    [
        ("0 0\n1 garbage", "ValueError"),
        ("0 0\n1 nan", "the curve is not finite"),
        ("", "the curve is empty"),
    ],
)
@pytest.mark.filterwarnings("ignore:loadtxt:UserWarning")  # of the empty file
def test_garbage_is_an_error(tmp_path: Path, curve: str, message: str) -> None:
    model = python_model(tmp_path, f"# <<E>>\nopen('curve.txt', 'w').write({curve!r})\n")
    with pytest.raises(SolverError, match=f"the results cannot be read: .*{message}.*log: "):
        model({"E": 1.0})
    assert len(list((tmp_path / "scratch").iterdir())) == 1


def test_no_result_is_an_error(tmp_path: Path) -> None:
    model = python_model(tmp_path, "# <<E>>\n")
    with pytest.raises(SolverError, match=r"FileNotFoundError.*curve.txt"):
        model({"E": 1.0})


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


def test_two_at_a_time(tmp_path: Path) -> None:
    # Each run waits for the other's mark: neither would end if they ran one after the other.
    script = (
        "import os, time\nmarks = {folder!r}\nopen(marks + '/<<E>>', 'w').close()\n"
        "while len(os.listdir(marks)) < 2: time.sleep(0.01)\n" + SOLVER
    )
    marks = tmp_path / "marks"
    marks.mkdir()
    model = python_model(tmp_path, script.replace("{folder!r}", repr(str(marks))))
    with ProcessPoolExecutor(2) as pool:
        curves = list(pool.map(model, [{"E": 1.0}, {"E": 2.0}]))
    assert [curve[1, 1] for curve in curves] == [1.0, 2.0]


def test_an_identification_goes_on_after_failures(tmp_path: Path) -> None:
    script = (
        "import sys\nE = <<E>>\nif E > 8: sys.exit('too stiff')\n"
        "open('curve.txt', 'w').write(f'0 0\\n1 {E if E > 2 else float(\"nan\")}\\n')\n"
    )
    found = identify(
        python_model(tmp_path, script),
        [(0.0, 0.0), (1.0, 5.0)],
        {"E": (0.0, 10.0)},
        method="de",
        method_options={"popsize": 10, "maxiter": 3},
        workers=2,
        progress=False,
    )
    assert found.parameters["E"] == pytest.approx(5.0, abs=0.5)
    reasons = " ".join(message for _, message in found.failures)
    assert "ended with exit code 1" in reasons
    assert "the curve is not finite" in reasons
    assert len(list((tmp_path / "scratch").iterdir())) == len(found.failures)


SEARCH = "identify(model, [(0.0, 0.0), (1.0, 5.0)], {'E': (0.0, 10.0)}, workers=2, progress=False)"


@posix
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
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
def test_nor_one_that_was_started_in_the_background(tmp_path: Path, how: signal.Signals) -> None:
    """There, SIGINT is ignored."""
    pipe = Pipe(tmp_path)
    with interrupted(tmp_path, parent_and_child(pipe), SEARCH, "SIG_IGN") as process:
        wait_until(lambda: pipe.started() == 4)
        process.send_signal(how)
        process.communicate(timeout=60)
    assert pipe.all_gone(processes=4)
    wait_until(lambda: not list((tmp_path / "scratch").iterdir()))


CCX = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed: apt calculix-ccx"
)

CUBE = """*NODE,NSET=ALL
1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1
*ELEMENT,TYPE=C3D8,ELSET=CUBE
1,1,2,3,4,5,6,7,8
*MATERIAL,NAME=STEEL
*ELASTIC
<<E:.6g>>,0.3
*PLASTIC
<<yield:.6g>>,0.
<<hardened:.6g>>,1.
*SOLID SECTION,ELSET=CUBE,MATERIAL=STEEL
*BOUNDARY
1,1,3\n4,1\n4,3\n5,1,2\n8,1\n2,2,3\n3,3\n6,2
*STEP,INC=100
*STATIC,DIRECT
0.1,1.
*BOUNDARY
2,1,1,0.01\n3,1,1,0.01\n6,1,1,0.01\n7,1,1,0.01
*EL PRINT,ELSET=CUBE
S
*END STEP
"""


def axial_stress(folder: Path) -> Any:
    """Return strain and axial stress at the first integration point, for every increment."""
    rows = [line.split() for line in (folder / "deck.dat").read_text().splitlines()]
    stress = [float(row[2]) for row in rows if row[:2] == ["1", "1"]]
    return np.column_stack([np.linspace(0.001, 0.01, len(stress)), stress])


def calculix(
    tmp_path: Path, deck: str = CUBE, command: Sequence[str] = ("ccx", "-i", "deck")
) -> CommandModel:
    template = tmp_path / "deck.inp"
    template.write_text(deck)
    return CommandModel(
        template,
        command,
        axial_stress,
        parameters=["E", "yield", "hardened"],
        timeout=60,
        environment={"OMP_NUM_THREADS": "1"},
        scratch=tmp_path,
    )


@CCX
def test_calculix_follows_linear_hardening(tmp_path: Path) -> None:
    E, H = 200e3, 2000.0
    curve = calculix(tmp_path)({"E": E, "yield": 300.0, "hardened": 300.0 + H})
    strain = np.linspace(0.001, 0.01, 10)
    stress = np.minimum(E * strain, (300.0 + H * strain) / (1.0 + H / E))
    np.testing.assert_allclose(curve, np.column_stack([strain, stress]), rtol=1e-5)


@CCX
def test_calculix_that_diverges_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match="ccx ended with exit code 201") as caught:
        calculix(tmp_path)({"E": 200e3, "yield": 300.0, "hardened": -250e3})
    assert "no convergence" in Path(str(caught.value).rpartition("log: ")[2]).read_text()


@CCX
@posix
def test_calculix_that_is_killed_is_an_error(tmp_path: Path) -> None:
    long_run = CUBE.replace("INC=100", "INC=1000000").replace("0.1,1.", "1e-6,1.")
    model = calculix(tmp_path, long_run, ["sh", "-c", "echo $$ > pid; exec ccx -i deck"])
    with ThreadPoolExecutor(1) as pool:
        run = pool.submit(model, {"E": 200e3, "yield": 300.0, "hardened": 2300.0})
        # deck.sta appears when the first increment is computed.
        wait_until(lambda: list(tmp_path.glob("curvewise_*/deck.sta")))
        (pid,) = tmp_path.glob("curvewise_*/pid")
        os.kill(int(pid.read_text()), signal.SIGKILL)
        with pytest.raises(SolverError, match="was killed by signal 9"):
            run.result()
