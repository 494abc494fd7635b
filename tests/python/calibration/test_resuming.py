"""What a store makes of a search that is replayed, interrupted by a signal, or killed."""

from __future__ import annotations

import csv
import os
import signal
import sqlite3
import subprocess
import sys
import textwrap

import numpy as np
import pytest
from solver_scripts import wait_until

from curvewise.calibration import SDRM, Criterion, DifferentialEvolution, SimulationStore, identify
from curvewise.commands import command_line as cli

X = np.linspace(0.0, 1.0, 25)
BOUNDS = {"a": (0.0, 10.0), "b": (-5.0, 5.0)}
QUICK = {"method": DifferentialEvolution(maxiter=3, after=SDRM(maxiter=3)), "progress": False}


def line(parameters):
    return np.column_stack((X, parameters["a"] * X + parameters["b"]))


def fragile_line(parameters):
    if parameters["a"] > 8.0:
        raise ValueError("too steep")
    return line(parameters)


EXPERIMENT = line({"a": 2.0, "b": 1.0})


def assert_same(one, other):
    """The same result, bit for bit, but for the time it took."""
    assert one.parameters == other.parameters
    assert one.value == other.value
    assert one.measures == other.measures
    assert one.failures == other.failures
    assert (one.converged, one.message) == (other.converged, other.message)
    for name in one.history.dtype.names:
        if name != "seconds":
            assert np.array_equal(one.history[name], other.history[name]), name
    for P, Q in zip(one.simulations, other.simulations, strict=True):
        assert np.array_equal(P, Q)


def runs_of(file):
    """Return how many runs a store holds."""
    with SimulationStore(file) as store:
        return len(store)


def keywords_of(method):
    chosen = QUICK["method"] if method == "sdrm+de" else method
    return {"measure": "curve_length", "method": chosen, "progress": False}


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("method", ["sdrm+de", "trust-region", "least-squares", "nelder-mead"])
@pytest.mark.nightly("(de|squares|region)-2")
def test_a_finished_search_is_replayed_from_its_store(tmp_path, method, workers):
    store = SimulationStore(tmp_path / "s.db", version="1")
    keywords = {"store": store, **keywords_of(method)}
    first = identify(fragile_line, EXPERIMENT, BOUNDS, workers=workers, **keywords)
    with store:
        written = repr(store.searches())
    again = identify(fragile_line, EXPERIMENT, BOUNDS, **keywords)
    assert_same(first, again)
    assert again.runs == 0
    assert np.array_equal(again.history.seconds, first.history.seconds)
    with store:
        assert repr(store.searches()) == written


def test_a_search_is_written_as_a_table(tmp_path, capsys):
    import pandas as pd

    store = SimulationStore(tmp_path / "s.db", version="1")
    found = identify(fragile_line, EXPERIMENT, BOUNDS, store=store, **QUICK)
    one, two = tmp_path / "one.csv", tmp_path / "two.csv"
    with store:
        store.to_csv(one)
    table = pd.read_csv(one, dtype=str)  # pandas reads decimals to a few ulps
    assert list(table) == [*found.history.dtype.names, "message"]
    assert any("ValueError: too steep" in str(message) for message in table.message)
    rows = list(csv.DictReader(one.read_text().splitlines()))
    for name in found.history.dtype.names:
        assert np.array_equal(table[name].astype(float), found.history[name])
        assert np.array_equal([float(row[name]) for row in rows], found.history[name])
    command = ["report", str(store.path), "--csv", str(two)]
    assert cli.main(command) == 0
    assert two.read_bytes() == one.read_bytes()
    identify(fragile_line, EXPERIMENT, BOUNDS, store=store, measure="dtw", **QUICK)
    assert cli.main(command) == 1
    assert "has not one search; name one of its searches: 1, 2" in capsys.readouterr().err
    assert cli.main([*command, "--search", "2"]) == 0
    assert two.read_bytes() != one.read_bytes()
    with store, pytest.raises(ValueError, match="has not search 3; name one of its searches: 1"):
        store.to_csv(two, search=3)


@pytest.mark.parametrize("method", ["sdrm+de", "least-squares"])
@pytest.mark.parametrize("kept", [0, 1, 12])
def test_what_a_store_lacks_is_run_again(tmp_path, method, kept):
    store = SimulationStore(tmp_path / "s.db", version="1")
    keywords = {"store": store, **keywords_of(method)}
    whole = identify(line, EXPERIMENT, BOUNDS, **keywords)
    with sqlite3.connect(store.path) as database:
        database.execute("DELETE FROM runs WHERE rowid > ?", (kept,))
        database.execute("DELETE FROM evaluations WHERE number > ?", (kept,))
    database.close()
    again = identify(line, EXPERIMENT, BOUNDS, **keywords)
    assert_same(whole, again)
    assert again.runs == whole.runs - kept
    assert runs_of(store.path) == whole.runs


def test_an_ending_for_which_there_was_no_room_is_written_later(tmp_path, monkeypatch, caplog):
    def full(*_):
        raise OSError("the store s.db cannot be written: the disk is full")

    store = SimulationStore(tmp_path / "s.db", version="1")
    with monkeypatch.context() as patch:
        patch.setattr(SimulationStore, "end_search", full)
        found = identify(line, EXPERIMENT, BOUNDS, store=store, **QUICK)
        assert "how the search ended could not be written down: the store s.db" in caplog.text
        with pytest.raises(OSError, match=r"s\.db cannot be written"):
            found.record()
    with store:
        assert store.searches()[1].ending is None
    found.record()
    with store:
        assert store.searches()[1].ending.parameters == found.parameters


def test_another_search_has_a_number_of_its_own(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    identify(line, EXPERIMENT, BOUNDS, store=store, **QUICK)
    others = [{"measure": "dtw"}, {"seed": 1}, {"crossing": "split"}]
    others += [{"measure": Criterion(weights=[2.0])}]
    others += [{"measure": Criterion("pcm", part="simulation")}]
    for number, other in enumerate(others, 2):
        found = identify(line, EXPERIMENT, BOUNDS, store=store, **QUICK, **other)
        assert_same(found, identify(line, EXPERIMENT, BOUNDS, **QUICK, **other))
        assert found.runs < found.evaluations
        with store:
            assert len(store.searches()) == number
    identify(line, EXPERIMENT * [1, -1], BOUNDS, store=store, **QUICK)
    with store:
        searches = store.searches()
        assert len(searches) == 7
        assert len({record.settings["experiments"] for record in searches.values()}) == 2
        assert searches[3].settings["seed"] == 1


SLOW_SCRIPT = """
    import signal, sys, time
    import numpy as np
    from curvewise.calibration import SDRM, DifferentialEvolution, identify

    X = np.linspace(0.0, 1.0, 25)

    class SlowLine:
        identity = "slow line"

        def __call__(self, parameters):
            time.sleep(0.02)
            return np.column_stack((X, parameters["a"] * X + parameters["b"]))

    if __name__ == "__main__":
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
        try:
            identify(
                SlowLine(), np.column_stack((X, 2.0 * X + 1.0)),
                {"a": (0.0, 10.0), "b": (-5.0, 5.0)},
                workers=int(sys.argv[1]), store=sys.argv[2],
                method=DifferentialEvolution(maxiter=3, after=SDRM(maxiter=3)),
            )
        except KeyboardInterrupt:
            sys.exit(42)
"""


class SlowLine:
    """The script's model, which another process continues with."""

    identity = "slow line"

    def __call__(self, parameters):
        return line(parameters)


def started(folder, workers, more_than, **streams):
    """Start the script in a separate process group; return it and its store with some runs."""
    script, file = folder / "slow.py", folder / "s.db"
    script.write_text(textwrap.dedent(SLOW_SCRIPT))
    command = [sys.executable, str(script), str(workers), str(file)]
    process = subprocess.Popen(command, text=True, start_new_session=True, **streams)
    wait_until(lambda: process.poll() is not None or runs_of(file) > more_than, 60.0)
    assert process.poll() is None, process.stderr and process.stderr.read()
    return process, file


def processes_left(group):
    """Tell whether a process group has any process."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT to a process group")
@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("target", ["process", "group"])
@pytest.mark.nightly("process-1", "group")
def test_interrupted_and_resumed_is_as_if_it_had_run_through(tmp_path, workers, target):
    process, file = started(tmp_path, workers, 15, stderr=subprocess.PIPE)
    (os.kill if target == "process" else os.killpg)(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 42, errors
    assert "Traceback" not in errors
    assert not processes_left(process.pid)

    saved = runs_of(file)
    resumed = identify(SlowLine(), EXPERIMENT, BOUNDS, store=file, **QUICK)
    assert 15 < saved < resumed.evaluations
    assert resumed.runs == resumed.evaluations - saved
    with SimulationStore(file) as store:
        (record,) = store.searches().values()
    assert len(record.evaluations) == resumed.evaluations
    assert_same(resumed, identify(line, EXPERIMENT, BOUNDS, **QUICK))


@pytest.mark.skipif(os.name != "posix", reason="kills a process by a signal")
def test_workers_end_when_their_parent_is_killed(tmp_path):
    process, _ = started(tmp_path, 2, 3, stderr=subprocess.DEVNULL)
    process.kill()
    process.wait()
    wait_until(lambda: not processes_left(process.pid), 60.0)
