"""Studies that are right: checked, run, interrupted and resumed, from Python and from the shell.

A Python script replaces the solver: it writes the stress of an elastic-plastic bar.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import TrustRegion, identify
from curvewise.calibration.methods import METHODS
from curvewise.commands import main
from curvewise.materials import MATERIALS
from curvewise.materials.options import material_options
from curvewise.studies import Study, StudyError
from curvewise.studies.curve_sources import Quantity
from curvewise.studies.keys import described
from curvewise.studies.material_models import MaterialModel
from curvewise.studies.measured_tests import MeasuredTest, Output
from curvewise.studies.parameters import SearchedParameter
from curvewise.studies.reading import ResultsFolder, StudyFile
from curvewise.studies.search_settings import SearchSettings
from curvewise.studies.solver_models import SolverModel, Success
from curvewise.studies.study_model import DeckTable

STRAIN = np.linspace(0.0, 0.01, 26)
TRUE = {"E": 2.0e5, "sy": 400.0}

DECK = """\
{wait}E, sy = <<E>>, <<sy>>
with open("out.csv", "w") as file:
    print("time,strain,force", file=file)
    for i in range(26):
        strain = 0.01 * i / 25
        print(i, strain, 12.5 * min(E * strain, sy + 0.02 * E * strain), sep=",", file=file)
"""
STUDY = f"""\
title = "a bar"
[[tests]]
name = "tension"
file = "test.csv"
columns = {{ e = "Strain [%]", s = "Stress [Pa]" }}
x = "e / 100"
y = "s / 1e6"
[tests.output]
file = "out.csv"
columns = {{ e = "strain", f = "force" }}
x = "e"
y = "f / 12.5"
[model]
command = ['{sys.executable}', "-I", "-S", "deck.py"]
templates = "deck.py"
timeout = 60
[parameters]
E = [1e5, 3e5]
sy = {{ bounds = [200, 600], start = 300 }}
[search]
max_runs = 9
uncertainty = false
"""


@dataclass(frozen=True, kw_only=True, repr=False)
class Patient(TrustRegion, name="patient", keeps_curves=True, needs_squares=False):
    """Takes its time."""

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        return 100 * self.starts + parameters


PATIENT = Patient()


def stress(p: dict[str, float]) -> Any:
    return np.minimum(p["E"] * STRAIN, p["sy"] + 0.02 * p["E"] * STRAIN)


def measured() -> Any:
    return stress(TRUE) + NOISE


def model(p: dict[str, float]) -> Any:
    return np.column_stack((STRAIN, 12.5 * stress(p) / 12.5))


# A test that is matched to the last bit would not have noise.
NOISE = np.random.default_rng(3).normal(0.0, 0.1, STRAIN.size)


def study_file(folder: Path, text: str = STUDY, wait: str = "") -> Path:
    rows = [
        f"{100.0 * e!r};{1e6 * s!r}"
        for e, s in zip(STRAIN.tolist(), measured().tolist(), strict=True)
    ]
    lines = ["Machine 7", "Strain [%];Stress [Pa]", *rows]
    (folder / "test.csv").write_text("\n".join(lines))
    (folder / "deck.py").write_text(DECK.replace("{wait}", wait))
    file = folder / "study.toml"
    file.write_text(text)
    return file


def test_a_study_is_what_identify_finds(tmp_path: Path) -> None:
    found = Study.read(study_file(tmp_path)).run(progress=False)
    (one,) = found.identifications.values()
    expected = identify(
        model,
        np.column_stack((STRAIN, measured())),
        {"E": (1e5, 3e5), "sy": (200.0, 600.0)},
        start={"E": 2e5, "sy": 300.0},
        max_runs=9,
        progress=False,
    )
    assert one.parameters == pytest.approx(expected.parameters, rel=1e-6)
    assert one.parameters == pytest.approx(TRUE, rel=1e-3)
    assert str(found) == str(one)


def test_results_are_the_same_in_every_file(tmp_path: Path) -> None:
    text = STUDY.replace("uncertainty = false", "uncertainty = 20\nstore = 'runs.db'")
    study = Study.read(study_file(tmp_path, f'{text}[results]\nfolder = "out"\n'))
    found = study.run(progress=False)
    (one,) = found.identifications.values()
    folder = tmp_path / "out"
    assert sorted(file.name for file in folder.iterdir()) == [
        "loops.png",
        "result.csv",
        "result.json",
        "simulation_tension.csv",
    ]
    from_json = json.loads((folder / "result.json").read_text())
    values = {name: row["value"] for name, row in from_json["found"]["area"]["parameters"].items()}
    assert values == one.parameters
    header, *rows = (folder / "result.csv").read_text().splitlines()
    assert header.startswith("measure,parameter,value,low,high,standard_error,interval_low")
    assert [row.split(",")[:3] for row in rows] == [
        ["area", name, repr(value)] for name, value in one.parameters.items()
    ]
    curve = np.loadtxt(folder / "simulation_tension.csv", delimiter=",")
    np.testing.assert_allclose(curve, one.simulations[0], rtol=1e-9)
    assert (tmp_path / "runs.db").exists()
    assert "weakest direction" in str(found)


def test_names_may_have_any_character(tmp_path: Path) -> None:
    """Control characters, and what means something to JSON, to CSV or in a picture."""
    name = "".join(map(chr, [*range(32), 127])) + '"\\,;$x^^$'
    escaped = "".join(f"\\U{ord(character):08x}" for character in name)
    text = STUDY.replace('"tension"', f'"{escaped}"').replace('"a bar"', f'"{escaped}"')
    study = Study.read(study_file(tmp_path, text))
    study.run(progress=False)
    result = json.loads((tmp_path / "study_results" / "result.json").read_text(encoding="utf-8"))
    assert (result["tests"], result["title"]) == ([name], name)
    assert (tmp_path / "study_results" / "loops.png").exists()


def test_a_check_runs_once_and_says_what_it_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = study_file(tmp_path)
    assert main(["identify", str(file), "--check"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("one run with E = 200000, sy = 300\n")
    assert "measured       26 points, e / 100 0 to 0.01, s / 1e6 " in printed
    assert "simulated      26 points, e / 100 0 to 0.01, s / 1e6 0 to 340\n" in printed
    assert "the study takes at least 6 runs: " in printed
    assert "look:" not in printed
    (folder,) = (tmp_path / "study_check").iterdir()
    assert "E, sy = 200000.0, 300.0" in (folder / "deck.py").read_text()
    assert Study.read(file).stored_runs() == 1
    found = Study.read(file).run(progress=False)
    (one,) = found.identifications.values()
    assert one.runs == one.evaluations - 1  # the check's run was the first of the search


def test_a_check_asks_the_method_how_many_runs_it_takes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An unknown one, by its name in the file."""
    monkeypatch.setitem(METHODS, "patient", PATIENT)
    text = STUDY.replace("max_runs = 9", 'method = { name = "patient", starts = 7 }')
    printed = str(Study.read(study_file(tmp_path, text)).check())
    assert "the study takes at least 702 runs: " in printed


def test_a_check_sees_other_units(tmp_path: Path) -> None:
    text = STUDY.replace('y = "s / 1e6"', 'y = "s"')
    printed = str(Study.read(study_file(tmp_path, text)).check())
    asked = "look: s of the test is 1.29e+06 times that of the simulation; different units?"
    assert f"{asked} see factors" in printed


@pytest.mark.parametrize(
    ("right", "wrong", "asked"),
    [
        ('x = "e"\ny = "f / 12.5"', 'x = "f / 12.5"\ny = "e"', "swapped columns? see columns"),
        ('y = "f / 12.5"', 'y = "-f / 12.5"', "another direction? see y"),
        ('y = "f / 12.5"', 'y = "0 * f"', "does not change; another quantity? see columns"),
    ],
)
def test_a_check_and_a_search_ask_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], right: str, wrong: str, asked: str
) -> None:
    assert right in STUDY
    path = study_file(tmp_path, STUDY.replace(right, wrong))
    assert asked in str(Study.read(path).check())
    assert main(["identify", str(path)]) == 0
    said = capsys.readouterr().err.splitlines()[0]
    assert said.startswith("curvewise: the first simulation does not look like its test: ")
    assert asked.partition(" see")[0] in said


@pytest.mark.parametrize(
    ("right", "wrong", "message"),
    [
        ('f = "force"', 'f = "load"', "out.csv has no column 'load'; its columns are time, st"),
        ('file = "out.csv"', 'file = "out.frd"', "the run has written no out.frd; it has written "),
        (
            'file = "out.csv"',
            'file = "gone.csv"',
            "the run has written no gone.csv; it has written",
        ),
        ('"-S", "deck.py"', '"-S", "none.py"', "can't open file"),
        ("timeout = 60", 'timeout = 60\nsuccess = "N o r m a l"', "command.log does not hold 'N o"),
    ],
)
def test_a_check_says_why_a_run_has_no_curve(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], right: str, wrong: str, message: str
) -> None:
    text = STUDY.replace(right, wrong)
    if wrong.endswith('frd"'):
        text = text.replace('{ e = "strain", f = "force" }', '{ e = "D1", f = "F1" }')
    assert main(["identify", str(study_file(tmp_path, text)), "--check"]) == 1
    assert message in capsys.readouterr().err


def test_what_a_search_warns_of_is_said_before_it_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = STUDY.replace("max_runs = 9", "max_runs = 1").replace("[200, 600]", "[20, 600]")
    assert main(["identify", str(study_file(tmp_path, text))]) == 0
    said, evaluated = capsys.readouterr().err.splitlines()
    assert said.startswith("curvewise: the bounds of sy (20 to 600) go over more than a decade: ")
    assert "1 evaluated, best " in evaluated


def test_several_measures_share_runs(tmp_path: Path) -> None:
    text = STUDY.replace("[search]", '[search]\nmeasures = ["area", "sum_of_squares"]')
    found = Study.read(study_file(tmp_path, text)).run(progress=False)
    assert list(found.identifications) == ["area", "sum_of_squares"]
    assert found.several is not None
    assert str(found) == found.several.table()
    assert (tmp_path / "study_results" / "simulation_tension_area.csv").exists()


CASES = (
    STUDY.replace('name = "tension"', 'name = "tension"\nmeasure = "sum_of_squares"\nsigma = 2.0')
    + """
[[tests]]
name = "strength"
number = 440.0
weight = 2
[tests.output]
file = "out.csv"
columns = { f = "force" }
value = "max(f) / 12.5"
"""
)


def test_a_test_may_be_a_number(tmp_path: Path) -> None:
    study = Study.read(study_file(tmp_path, CASES))
    printed = str(study.check())
    assert "strength: measured 440, simulated 340\n" in printed
    (found,) = study.run(progress=False).identifications.values()
    assert found.parameters == pytest.approx(TRUE, rel=1e-3)
    assert list(found.measures) == ["tension", "strength"]


TWO_MODELS = (
    STUDY.replace("[tests.output]", 'model = "bar"\n[tests.output]').replace(
        "[model]", "[models.bar]"
    )
    + f"""
[models.half]
command = ['{sys.executable}', "-I", "-S", "half.py"]
templates = ["half.py"]
timeout = 60
[models.half.values]
half = "E / two"
two = "2"
"""
)


def test_a_value_is_made_of_those_before_it(tmp_path: Path) -> None:
    (tmp_path / "half.py").write_text("<<half>>")
    with pytest.raises(StudyError, match=r"line 30: models.half.values.half uses 'two', which"):
        Study.read(study_file(tmp_path, TWO_MODELS))


def test_tests_may_have_models_of_their_own(tmp_path: Path) -> None:
    (tmp_path / "half.py").write_text("print('y', <<half>>, sep='\\n', file=open('y.csv', 'w'))")
    text = TWO_MODELS.replace('half = "E / two"\ntwo = "2"', 'two = "2"\nhalf = "E / two"')
    text += '[[tests]]\nnumber = 1e5\nmodel = "half"\n'
    text += 'output = { file = "y.csv", columns = { y = "y" }, value = "y" }\n'
    (found,) = Study.read(study_file(tmp_path, text)).run(progress=False).identifications.values()
    assert found.parameters["E"] == pytest.approx(2e5, rel=1e-3)


def test_tables_and_tied_parameters_reach_the_deck(tmp_path: Path) -> None:
    text = STUDY.replace("[parameters]", "[parameters]\nn = 3").replace(
        "[search]", 'G = "E / (2 * (1 + n))"\n[search]'
    )
    text += """
[model.tables.hardening]
over = "p"
points = [0, 0.5]
line = ["sy * (1 + p)", "p"]
format = ".1f"
"""
    file = study_file(tmp_path, text, wait='table = """<<hardening>>"""  # <<G>>\n')
    study = Study.read(file)
    study.check()
    (folder,) = (tmp_path / "study_check").iterdir()
    first, second, *_ = (folder / "deck.py").read_text().splitlines()
    assert (first, second) == ('table = """300.0, 0.0', '450.0, 0.5"""  # 25000.0')


def test_another_formula_is_another_model(tmp_path: Path) -> None:
    study = Study.read(study_file(tmp_path))
    study.check()
    file = study_file(tmp_path, STUDY.replace('y = "f / 12.5"', 'y = "f / 12.6"'))
    assert Study.read(file).stored_runs() == 0


posix = pytest.mark.skipif(os.name != "posix", reason="signals are POSIX's")


# A solver that says when it begins, and waits where more runs have begun than there may be.
HELD = """\
import os, time
with open({folder!r} + "/begun", "a") as file:
    file.write(".")
while os.path.getsize({folder!r} + "/begun") > int(open({folder!r} + "/allowed").read()):
    time.sleep(0.01)
"""


@posix
@pytest.mark.nightly
def test_a_study_that_is_interrupted_and_killed_ends_with_the_same_bits(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folders = [tmp_path / "straight", tmp_path / "interrupted"]
    for folder in folders:
        folder.mkdir()
        (folder / "allowed").write_text("1000")
        study_file(folder, wait=HELD.replace("{folder!r}", repr(str(folder))))
    straight, interrupted = folders
    Study.read(straight / "study.toml").run(progress=False)
    for runs, how in ((3, signal.SIGINT), (4, signal.SIGKILL)):
        code, text = stopped(interrupted, runs, how)
        assert code == (130 if how == signal.SIGINT else -9)
        if how == signal.SIGINT:
            assert "3 runs in " in text
            assert "The same command goes on from there: curvewise identify study.toml" in text
    assert main(["identify", str(interrupted / "study.toml")]) == 0
    assert "study.db holds" in capsys.readouterr().out
    for name in ("result.json", "result.csv", "simulation_tension.csv"):
        one, other = (folder / "study_results" / name for folder in folders)
        assert one.read_bytes() == other.read_bytes(), name


def stopped(folder: Path, runs: int, how: signal.Signals) -> tuple[int, str]:
    """Run the study, and send a signal while it waits for the run after `runs` more."""
    begun = folder / "begun"
    before = begun.stat().st_size if begun.exists() else 0
    (folder / "allowed").write_text(f"{before + runs}")
    code = (  # what a shell starts in the background ignores SIGINT, and so do its children
        "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "from curvewise.commands import main; sys.exit(main(['identify', 'study.toml']))"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ) as process:
        deadline = time.monotonic() + 120
        while not begun.exists() or begun.stat().st_size <= before + runs:
            assert process.poll() is None, process.communicate()
            assert time.monotonic() < deadline, "waited in vain"
            time.sleep(0.02)
        process.send_signal(how)
        if how == signal.SIGKILL:  # its solver continues: let it end
            (folder / "allowed").write_text("1000")
        output, _ = process.communicate(timeout=60)
    (folder / "allowed").write_text("1000")
    return process.returncode, output.decode()


ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = sorted(path.parent for path in (ROOT / "examples" / "studies").glob("*/study.toml"))
GUIDE = ROOT / "docs" / "how_to" / "run_a_study.md"
PAGE = ROOT / "docs" / "reference" / "study_file.md"


@pytest.fixture
def solvers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Replace missing solvers by programs that fail; return the installed ones."""
    programs = {"ccx", "abaqus", "ls-dyna"}
    here = {program for program in programs if shutil.which(program)}
    for program in programs - here:
        (tmp_path / program).write_text("#!/bin/sh\nexit 1\n")
        (tmp_path / program).chmod(0o755)
    monkeypatch.setenv("PATH", f"{os.environ['PATH']}{os.pathsep}{tmp_path}")
    return here


@posix
@pytest.mark.parametrize("folder", EXAMPLES, ids=lambda folder: folder.name)
def test_the_examples_are_right(
    folder: Path,
    solvers: set[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    request: pytest.FixtureRequest,
) -> None:
    """Those of CalculiX are run once, where it is."""
    if "CURVEWISE_DATA" in (folder / "study.toml").read_text():
        monkeypatch.setenv("CURVEWISE_DATA", str(request.getfixturevalue("data_dir")))
    study = Study.read(shutil.copytree(folder, tmp_path / folder.name) / "study.toml")
    if folder.name.endswith("calculix") and "ccx" in solvers:
        assert all(len(read.simulation) > 20 for read in study.check().read)


@posix
@pytest.mark.usefixtures("solvers")
def test_the_study_of_the_page_is_right(tmp_path: Path) -> None:
    block, _ = re.findall(r"^```toml\n(.*?)^```$", GUIDE.read_text(), re.MULTILINE | re.DOTALL)
    folder = shutil.copytree(ROOT / "examples" / "studies" / "tension_calculix", tmp_path / "study")
    (folder / "study.toml").write_text(block)
    assert Study.read(folder / "study.toml").title == "tension test"


# The sections of the page, and what describes the keys that each has.
SECTIONS = {
    "## Top level": (StudyFile,),
    "## `[[tests]]`": (MeasuredTest,),
    "## `[tests.output]`": (Output, Quantity),
    "## `[parameters]`": (SearchedParameter,),
    "## `[model]`": (SolverModel, Success, DeckTable),
    "## A material": (MaterialModel,),
    "## `[search]`": (SearchSettings,),
    "## `[results]`": (ResultsFolder,),
}


@pytest.mark.parametrize("heading", SECTIONS)
def test_the_page_has_every_key_and_no_other(heading: str) -> None:
    """The first cells of a section's table, and the contents of { key = value } there."""
    _, _, section = PAGE.read_text().partition(f"\n{heading}")
    section = re.split(r"^##", section, maxsplit=1, flags=re.MULTILINE)[0]
    cells = re.findall(r"^\| (`[a-z_`, ]+`) \|", section, re.MULTILINE)
    named = {name for cell in cells for name in re.findall(r"\w+", cell)}
    for inner in re.findall(r"\{ ([^}]*) \}", section):
        named.update(re.findall(r"\b([a-z_]+) = ", inner))
    kinds = SECTIONS[heading]
    known = {key for kind in kinds for key in described(kind)}
    if MaterialModel in kinds:
        known |= set(material_options(MATERIALS.values()))
    assert named == known
