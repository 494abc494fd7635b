"""CommandModel, with small Python scripts instead of a solver."""

from __future__ import annotations

import re
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from solver_scripts import SOLVER, python_model, read_curve

from curvewise.calibration import CommandModel, DifferentialEvolution, SolverError, identify


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
    ("arguments", "error", "message"),
    [
        ({"command": "ccx -i deck"}, ValueError, "give a list"),
        ({"command": []}, ValueError, "give a list"),
        (
            {"command": ["no-such-solver"]},
            FileNotFoundError,
            "program 'no-such-solver' does not exist",
        ),
        ({"timeout": 0}, ValueError, "positive number of seconds"),
        ({"timeout": float("nan")}, ValueError, "positive number of seconds"),
        ({"parameters": "E"}, ValueError, "give a list of names"),
        (
            {"scratch": "no-such-folder"},
            FileNotFoundError,
            "folder 'no-such-folder' does not exist",
        ),
        (
            {"template_files": "no-such-deck"},
            FileNotFoundError,
            "template 'no-such-deck' does not exist",
        ),
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
    with pytest.raises(SolverError, match=r"FileNotFoundError.*curve.txt") as caught:
        model({"E": 1.0})
    first = str(caught.value).splitlines()[0]
    assert re.search(r"\(\S*solver_scripts.py, line \d+, in read_curve\); log: ", first)


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
        method=DifferentialEvolution(popsize=10, maxiter=3),
        workers=2,
        progress=False,
    )
    assert found.parameters["E"] == pytest.approx(5.0, abs=0.5)
    reasons = " ".join(message for _, message in found.failures)
    assert "ended with exit code 1" in reasons
    assert "the curve is not finite" in reasons
    assert len(list((tmp_path / "scratch").iterdir())) == len(found.failures)
