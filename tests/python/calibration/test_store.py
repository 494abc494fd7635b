"""The store of simulations: shared runs, different models, and processes that die."""

from __future__ import annotations

import contextlib
import functools
import os
import sqlite3
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
from test_resuming import BOUNDS, EXPERIMENT, QUICK, X, assert_same, line, runs_of

from curvewise.calibration import (
    SDRM,
    CommandModel,
    Criterion,
    DifferentialEvolution,
    Objective,
    SimulationStore,
    cross_validate,
    identify,
    rescore,
)
from curvewise.calibration.models.pool import Outcome
from curvewise.calibration.records.evaluation import Evaluation

SHORT = {"progress": False, "method": SDRM(maxiter=3)}
LONG = {"progress": False, "method": SDRM(maxiter=8)}


def fragile_line(parameters):
    if parameters["a"] > 8.0:
        raise ValueError("too steep")
    return None if parameters["a"] < 1.0 else line(parameters)


class Counted:
    """A model that counts its runs and describes itself."""

    def __init__(self, model, identity="line"):
        self.model, self.identity, self.runs = model, identity, 0

    def __call__(self, parameters):
        self.runs += 1
        return self.model(parameters)


def test_a_finished_search_runs_nothing_again(tmp_path):
    for model in (line, fragile_line):
        counted = Counted(model, model.__name__)
        first = identify(counted, EXPERIMENT, BOUNDS, store=tmp_path / "s.db", **QUICK)
        assert counted.runs == first.evaluations
        again = identify(counted, EXPERIMENT, BOUNDS, store=tmp_path / "s.db", **QUICK)
        assert counted.runs == first.evaluations
        assert_same(first, again)
        assert_same(first, identify(model, EXPERIMENT, BOUNDS, **QUICK))
        assert np.array_equal(first.history.seconds, again.history.seconds)


def test_runs_are_shared_by_measures_methods_and_weights(tmp_path):
    """The first region is the same for all: five runs of it are made once."""
    counted = Counted(line)
    keywords = {"progress": False, "method": SDRM(maxiter=1), "store": tmp_path / "s.db"}
    identify(counted, EXPERIMENT, BOUNDS, measure="area", **keywords)
    assert counted.runs == 5
    identify(counted, EXPERIMENT, BOUNDS, measure=Criterion("dtw", weights=[3.0]), **keywords)
    assert counted.runs == 5
    keywords["method"] = DifferentialEvolution(maxiter=1, popsize=4, after=SDRM(maxiter=1))
    identify(counted, EXPERIMENT, BOUNDS, **keywords)
    assert counted.runs > 5
    assert runs_of(tmp_path / "s.db") == counted.runs


def test_workers_fill_the_store_too(tmp_path):
    keywords = {**QUICK, "store": SimulationStore(tmp_path / "s.db", version="1")}
    two = identify(fragile_line, EXPERIMENT, BOUNDS, workers=2, **keywords)
    assert_same(two, identify(fragile_line, EXPERIMENT, BOUNDS, **keywords))


def test_rescore_runs_nothing_and_gives_the_objective(tmp_path):
    counted = Counted(fragile_line)
    found = identify(counted, EXPERIMENT, BOUNDS, store=tmp_path / "s.db", **SHORT)
    runs = counted.runs
    again = rescore(
        tmp_path / "s.db", EXPERIMENT, Criterion("dtw", weights=[2.0], metric="cityblock")
    )
    assert counted.runs == runs
    objective = Objective(EXPERIMENT, Criterion("dtw", weights=[2.0], metric="cityblock"))
    for row in again.history:
        curve = None if row.failed else line({"a": row.a, "b": row.b})
        assert row.value == objective(curve)
    assert again.value == again.history.value.min() == objective(again.simulations[0])
    assert len(again.failures) == again.history.failed.sum() == len(found.failures)
    same = rescore(tmp_path / "s.db", EXPERIMENT, model=counted)
    assert (same.value, same.parameters) == (found.value, found.parameters)


def test_rescore_wants_to_know_which_model(tmp_path):
    file = tmp_path / "s.db"
    with pytest.raises(FileNotFoundError, match="there is no store"):
        rescore(file, EXPERIMENT)
    for version in ("1", "2"):
        store = SimulationStore(file, version=version)
        identify(line, EXPERIMENT, BOUNDS, store=store, **SHORT)
    with pytest.raises(ValueError, match=r"runs of 2 models \(line, version 1; line, version 2\)"):
        rescore(file, EXPERIMENT)
    with pytest.raises(ValueError, match="has no runs of line, version 3; it has those of: line"):
        rescore(SimulationStore(file, version="3"), EXPERIMENT, model=line)
    one = rescore(SimulationStore(file, version="1"), EXPERIMENT, model=line)
    assert one.value == rescore(file, EXPERIMENT, model="line, version 2").value


# Another model.


def read_curve(folder):
    return np.loadtxt(folder / "out.txt")


def command_model(folder, slope="<<a>>", read=read_curve, **keywords):
    (folder / "deck.py").write_text(
        f"open('out.txt', 'w').write('0 <<b>>\\n1 ' + str({slope} + <<b>>) + '\\n')"
    )
    command = [sys.executable, "-S", "deck.py"]
    return CommandModel(
        folder / "deck.py", command, read, parameters=["a", "b"], timeout=60, **keywords
    )


def test_an_edited_template_is_another_model(tmp_path):
    """And so are another command, environment and reading function."""
    file = tmp_path / "s.db"
    keywords = {"method": "nelder-mead", "progress": False, "max_runs": 2, "store": file}
    one = identify(command_model(tmp_path), EXPERIMENT, BOUNDS, **keywords)
    assert runs_of(file) == 2
    same = command_model(tmp_path)
    assert same.identity == command_model(tmp_path).identity
    assert_same(one, identify(same, EXPERIMENT, BOUNDS, **keywords))
    assert runs_of(file) == 2
    edited = command_model(tmp_path, slope="2 * <<a>>")
    two = identify(edited, EXPERIMENT, BOUNDS, **keywords)
    assert one.simulations[0][1, 1] != two.simulations[0][1, 1]
    with SimulationStore(file) as store:
        assert len(store) == 4
        assert store.models() == [same.identity, edited.identity]

    def twice(folder):
        return 2.0 * read_curve(folder)

    others = [
        command_model(tmp_path, read=twice),
        command_model(tmp_path, read=functools.partial(np.multiply, 2.0)),
        command_model(tmp_path, environment={"THREADS": "1"}),
    ]
    identities = {model.identity for model in (same, edited, *others)}
    assert len(identities) == 5


def with_source(source):
    names = {"np": np, "X": X}
    exec(source, names)
    return names["model"]


def test_a_function_needs_a_version_and_keeps_to_it(tmp_path):
    file = tmp_path / "s.db"
    wanted = r"which state of line its runs are of; give store=SimulationStore\(path, version='1'\)"
    with pytest.raises(ValueError, match=wanted):
        identify(line, EXPERIMENT, BOUNDS, store=file, **SHORT)
    for version in (2, ""):
        with pytest.raises(ValueError, match=f"version is {version!r}; give a text"):
            SimulationStore(file, version=version)
    keywords = {**SHORT, "store": SimulationStore(file, version="1")}
    source = "def model(p):\n    return np.column_stack((X, p['a'] * X + p['b']))\n"
    identify(with_source(source), EXPERIMENT, BOUNDS, **keywords)
    commented = source.replace("\n    r", "\n    '''A line.'''\n\n    # With a comment.\n    r")
    identify(with_source(commented), EXPERIMENT, BOUNDS, **keywords)
    for changed in (source.replace("* X", "* X * X"), source.replace("p['b']", "2 * p['b']")):
        with pytest.raises(ValueError, match="model, version 1, whose code or data were others"):
            identify(with_source(changed), EXPERIMENT, BOUNDS, **keywords)
        other = {**SHORT, "store": SimulationStore(file, version=changed)}
        identify(with_source(changed), EXPERIMENT, BOUNDS, **other)


def test_the_data_of_a_model_count(tmp_path):
    def scaled(factor, parameters):
        return factor * line(parameters)

    keywords = {**SHORT, "store": SimulationStore(tmp_path / "s.db", version="1")}
    for factor in (np.array([1.0, 1.0]), np.array([1.0, 1.0])):
        identify(functools.partial(scaled, factor), EXPERIMENT, BOUNDS, **keywords)
    with pytest.raises(ValueError, match=r"partial of .*scaled, version 1, whose code or data"):
        identify(functools.partial(scaled, np.array([1.0, 2.0])), EXPERIMENT, BOUNDS, **keywords)


def in_module(source):
    names = {"np": np, "X": X, "__name__": "some.module", "calls": [], "RUNS": 0}
    exec(source, names)
    return names["model"]


def test_the_functions_that_a_model_calls_count(tmp_path):
    """Variables of its module count, through any number of calls; its records of runs do not."""
    source = """
def law(slope, p):
    return slope(p) * X
def slope(p):
    return p["a"]
def model(p):
    global RUNS
    RUNS += 1
    calls.append(dict(p))
    return np.column_stack((X, law(slope, p) + p["b"]))
def other():
    return 1
"""
    keywords = {**SHORT, "store": SimulationStore(tmp_path / "s.db", version="1")}
    identify(in_module(source), EXPERIMENT, BOUNDS, **keywords)
    for same in (source, source.replace("return 1", "return 2")):
        identify(in_module(same), EXPERIMENT, BOUNDS, **keywords)
    for changed in (
        source.replace('return p["a"]', 'return 2.0 * p["a"]'),
        source.replace("* X", "* X**2"),
    ):
        with pytest.raises(ValueError, match="model, version 1, whose code or data were others"):
            identify(in_module(changed), EXPERIMENT, BOUNDS, **keywords)


def test_what_a_version_is_for(tmp_path, recwarn):
    """A table in a dict is not detected, because a model may count its runs with it; the version
    detects it.
    """

    def made(table):
        def model(p):
            table["runs"] = table.get("runs", 0) + 1
            return line({"a": table["factor"] * p["a"], "b": p["b"]})

        return model

    one, two = (SimulationStore(tmp_path / "s.db", version=version) for version in "12")
    first = identify(made({"factor": 1.0}), EXPERIMENT, BOUNDS, store=one, **SHORT)
    stale = identify(made({"factor": 0.5}), EXPERIMENT, BOUNDS, store=one, **SHORT)
    fresh = identify(made({"factor": 0.5}), EXPERIMENT, BOUNDS, store=two, **SHORT)
    assert (stale.runs, stale.parameters) == (0, first.parameters)
    assert fresh.runs > 0
    assert fresh.parameters["a"] == pytest.approx(2.0 * first.parameters["a"], rel=1e-3)
    assert not recwarn.list


# Folds, views, failures, files.


def test_folds_of_a_cross_validation_share_runs(tmp_path):
    def loops(parameters):
        return [line(parameters), line(parameters) ** 2, line(parameters)[:20]]

    counted = Counted(loops)
    experiments = loops({"a": 2.0, "b": 1.0})
    keywords = {**SHORT, "store": tmp_path / "s.db"}
    shared = cross_validate(counted, experiments, BOUNDS, **keywords)
    asked = sum(fold.identification.evaluations for fold in shared.folds)
    assert counted.runs <= asked - 2 * 5  # the first region of every fold is the same
    alone = cross_validate(loops, experiments, BOUNDS, **SHORT)
    assert str(shared) == str(alone)


def test_failures_are_kept_until_they_are_forgotten(tmp_path):
    counted = Counted(fragile_line)
    keywords = {**SHORT, "store": tmp_path / "s.db"}
    found = identify(counted, EXPERIMENT, BOUNDS, **keywords)
    raised = [message for _, message in found.failures if "too steep" in message]
    assert raised
    with SimulationStore(tmp_path / "s.db") as store:
        messages = {run.message.partition(" (")[0] for run in store.runs("line")}
        assert messages == {"", "ValueError: too steep"}
        assert store.forget_failures() == len(raised)
    runs = counted.runs
    assert_same(found, identify(counted, EXPERIMENT, BOUNDS, **keywords))
    assert counted.runs == runs + len(raised)


def test_other_files_are_refused(tmp_path):
    (tmp_path / "text.db").write_text("a,b\n" * 1000)
    with pytest.raises(ValueError, match=r"text\.db is not a store; give the name of a file"):
        SimulationStore(tmp_path / "text.db").models()
    with sqlite3.connect(tmp_path / "other.db") as other:
        other.execute("CREATE TABLE t (x)")
    other.close()
    with pytest.raises(ValueError, match=r"other\.db is not a store of this version"):
        SimulationStore(tmp_path / "other.db").models()
    with pytest.raises(OSError, match="cannot be opened"):
        SimulationStore(tmp_path / "no" / "folder.db").models()
    assert not (tmp_path / "no").exists()


def test_a_store_is_made_when_it_is_used_and_opened_again(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    assert repr(store) == f"SimulationStore({str(tmp_path / 's.db')!r}, version='1')"
    assert not store.path.exists()
    for _ in range(2):
        with store:
            assert (len(store), store.models(), store.searches()) == (0, [], {})
    again = SimulationStore(store)
    assert (again.path, again.version) == (store.path, "1")
    assert SimulationStore(store, version="2").version == "2"
    with store:  # a search has a separate connection
        identify(line, EXPERIMENT, BOUNDS, store=store, **SHORT)
        assert store.models() == ["line, version 1"]


def test_what_is_new_is_written_at_once_after_a_pause(tmp_path, monkeypatch):
    """What a killed search loses is what came within the pause after it last wrote."""
    file = tmp_path / "s.db"
    outcome = Outcome([EXPERIMENT], "", 1.0)

    def written():
        with contextlib.closing(sqlite3.connect(file)) as other:
            counts = (f"SELECT count(*) FROM {table}" for table in ("runs", "evaluations"))
            return [other.execute(count).fetchone()[0] for count in counts]

    with SimulationStore(file) as store:
        search = store.begin_search("{}", "{}")
        monkeypatch.setattr("curvewise.calibration.records.store._PAUSE", 1e9)
        store.save("line", {"a": 1.0}, outcome)
        store.add_evaluation(search, Evaluation(1, (1.0,), 0.0, failed=False, seconds=1.0))
        assert written() == [0, 0]
        monkeypatch.setattr("curvewise.calibration.records.store._PAUSE", -1.0)
        store.add_evaluation(search, Evaluation(2, (2.0,), 0.0, failed=False, seconds=1.0))
        assert written() == [1, 2]
        store.save("line", {"a": 2.0}, outcome)
        assert written() == [2, 2]


# Processes.

SCRIPT = """
    import sys, time
    sys.path.insert(0, {folder!r})
    from test_store import BOUNDS, EXPERIMENT, LONG, line
    from curvewise.calibration import identify

    class Slow:
        identity = "slow line"

        def __call__(self, parameters):
            time.sleep(0.01)
            print("run", flush=True)
            return line(parameters)

    found = identify(Slow(), EXPERIMENT, BOUNDS, store=sys.argv[1], **LONG)
    print(found.value.hex(), found.evaluations)
"""


def started(script, file):
    return subprocess.Popen(
        [sys.executable, str(script), str(file)], stdout=subprocess.PIPE, text=True
    )


@pytest.fixture
def script(tmp_path):
    file = tmp_path / "slow.py"
    file.write_text(textwrap.dedent(SCRIPT).format(folder=os.path.dirname(__file__)))
    return file


@pytest.mark.nightly
def test_killed_and_resumed_is_as_if_it_had_run_through(tmp_path, script):
    file = tmp_path / "s.db"
    process = started(script, file)
    deadline = time.monotonic() + 60
    while process.poll() is None and process.stdout.readline():
        if runs_of(file) > 9:
            break
        assert time.monotonic() < deadline
    process.kill()  # SIGKILL
    process.communicate()
    saved = runs_of(file)
    resumed = started(script, file)
    out, _ = resumed.communicate(timeout=60)
    *runs, result = out.splitlines()
    whole = identify(line, EXPERIMENT, BOUNDS, **LONG)
    assert result.split() == [whole.value.hex(), str(whole.evaluations)]
    assert 9 < saved < whole.evaluations
    assert len(runs) == whole.evaluations - saved
    database = sqlite3.connect(file)
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    database.close()


def test_two_processes_on_one_store(tmp_path, script):
    file = tmp_path / "s.db"
    both = [started(script, file) for _ in range(2)]
    outputs = [process.communicate(timeout=60)[0].splitlines() for process in both]
    whole = identify(line, EXPERIMENT, BOUNDS, **LONG)
    for *_, result in outputs:
        assert result.split() == [whole.value.hex(), str(whole.evaluations)]
    assert runs_of(file) == whole.evaluations
