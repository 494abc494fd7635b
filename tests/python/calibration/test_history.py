"""The history file: a search that is replayed, interrupted by a signal, or killed."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

from curvewise.calibration import SDRM, DifferentialEvolution, identify
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.records.history import History, append_ending, read_history

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


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("method", ["sdrm+de", "trust-region", "least-squares", "nelder-mead"])
def test_a_finished_search_is_replayed_from_its_file(tmp_path, method, workers):
    keywords = {"measure": "curve_length", "method": method, "progress": False}
    if method == "sdrm+de":
        keywords["method"] = QUICK["method"]
    file = tmp_path / "history.csv"
    first = identify(fragile_line, EXPERIMENT, BOUNDS, history=file, workers=workers, **keywords)
    text = file.read_bytes()
    calls = []

    def counted(parameters):
        calls.append(parameters)
        return fragile_line(parameters)

    again = identify(counted, EXPERIMENT, BOUNDS, history=file, **keywords)
    assert_same(first, again)
    assert again.history.seconds == pytest.approx(first.history.seconds, rel=1e-5)
    assert len(calls) <= 1  # the simulation at the optimum, which need not be in the file
    assert file.read_bytes() == text


def test_history_file_can_be_read_by_pandas(tmp_path):
    import pandas as pd

    file = tmp_path / "history.csv"
    found = identify(fragile_line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    table = pd.read_csv(file, comment="#").sort_values("evaluation")
    for name in ("evaluation", "a", "b", "value", "failed"):
        # pandas' own reading of decimals is off by an ulp at times
        assert np.allclose(table[name], found.history[name], rtol=1e-15, atol=0)
    assert "ValueError: too steep" in set(table.message)


@pytest.mark.parametrize("method", ["sdrm+de", "least-squares"])
@pytest.mark.parametrize("cut", [0, 1, 30])
def test_half_a_line_at_the_end_is_cut_off(tmp_path, method, cut):
    keywords = {"measure": "curve_length", "method": method, "progress": False}
    if method == "sdrm+de":
        keywords["method"] = QUICK["method"]
    file = tmp_path / "history.csv"
    whole = identify(line, EXPERIMENT, BOUNDS, history=file, **keywords)
    lines = file.read_bytes().splitlines(keepends=True)
    kept = 12
    file.write_bytes(b"".join(lines[: 2 + kept]) + lines[2 + kept][:cut])
    again = identify(line, EXPERIMENT, BOUNDS, history=file, **keywords)
    assert_same(whole, again)
    assert len(file.read_bytes().splitlines()) == len(lines)


def test_an_ending_for_which_there_was_no_room_is_written_later(tmp_path):
    file = tmp_path / "history.csv"
    identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    whole = file.read_bytes()
    file.write_bytes(whole[:-20])
    append_ending(file, '{"converged": true}')
    _, _, evaluations, ending = read_history(file)
    assert ending == '{"converged": true}'
    assert len(evaluations) == whole.count(b"\n") - 3


def test_a_history_of_another_search_is_refused(tmp_path):
    file = tmp_path / "history.csv"
    identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    for other, word in [
        ({"measure": "dtw"}, "its measure is 'area', not 'dtw'"),
        ({"seed": 1}, "its seed is 0, not 1"),
        ({"crossing": "split"}, "its options"),
        ({"weights": [2.0]}, "its weights"),
    ]:
        with pytest.raises(ValueError, match=word):
            identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK, **other)
    with pytest.raises(ValueError, match="its experiments is"):
        identify(line, EXPERIMENT * [1, -1], BOUNDS, history=file, **QUICK)
    file.write_text("strain,stress\n0,0\n")
    with pytest.raises(ValueError, match="is not a history"):
        identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)


def test_a_spoilt_line_is_reported(tmp_path):
    file = tmp_path / "history.csv"
    identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    lines = file.read_text().splitlines(keepends=True)
    lines[4] = "3,what,1,2,0,0.1,,\n"
    file.write_text("".join(lines))
    with pytest.raises(ValueError, match="line 5 is damaged, by its checksum; delete the line"):
        identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    lines[1] = lines[1].replace("value", "other")
    file.write_text("".join(lines))
    with pytest.raises(ValueError, match="line 2 is not the header of a history"):
        identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)


def test_no_damage_goes_unnoticed(tmp_path):
    """What a damaged file holds is refused, or is what was written."""
    file = tmp_path / "history.csv"
    settings, names = {"seed": 0, "bounds": {"a": [0, 1]}}, ("a", "b")
    rng = random.Random(6)
    history = History(file, settings, names)
    curves = (np.arange(6.0).reshape(3, 2),)
    for number in range(1, 9):
        point = (rng.random(), rng.random())
        failed = number % 3 == 0
        message = 'it said: "no",\nand ended' if failed else ""
        kept = None if failed else curves
        history.write(Evaluation(number, point, rng.random(), failed, 0.25, message, kept))
    history.close()
    content = file.read_bytes()
    written = read_back(file, settings, names)
    assert len(written) == 8
    refused = 0
    for _ in range(1000):
        damaged = bytearray(content)
        place = rng.randrange(len(damaged))
        if rng.random() < 0.5:
            damaged[place] = rng.choice(b'0123456789,.-\n"ae \xff\0')
        else:
            del damaged[place : place + rng.choice([1, 1, 2, 60, 300])]
        file.write_bytes(damaged)
        found = read_back(file, settings, names)
        if found is None:
            refused += 1
        else:
            assert set(found) <= set(written)
    assert 600 < refused < 1000


def read_back(file, settings, names):
    """Return what a history holds, or None where it is refused in words."""
    try:
        history = History(file, settings, names)
    except ValueError as error:
        if str(file) not in str(error):
            raise
        return None
    history.close()
    return [repr(evaluation) for evaluation in history.saved.values()]


SLOW_SCRIPT = """
    import signal, sys, time
    import numpy as np
    from curvewise.calibration import SDRM, DifferentialEvolution, identify

    X = np.linspace(0.0, 1.0, 25)

    def line(parameters):
        time.sleep(0.02)
        return np.column_stack((X, parameters["a"] * X + parameters["b"]))

    if __name__ == "__main__":
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
        try:
            identify(
                line, line({"a": 2.0, "b": 1.0}), {"a": (0.0, 10.0), "b": (-5.0, 5.0)},
                workers=int(sys.argv[1]), history=sys.argv[2],
                method=DifferentialEvolution(maxiter=3, after=SDRM(maxiter=3)),
            )
        except KeyboardInterrupt:
            sys.exit(42)
"""


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
def test_interrupted_and_resumed_is_as_if_it_had_run_through(tmp_path, workers, target):
    script, file = tmp_path / "slow.py", tmp_path / "history.csv"
    script.write_text(textwrap.dedent(SLOW_SCRIPT))
    process = subprocess.Popen(
        [sys.executable, str(script), str(workers), str(file)],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 60
    while not (file.exists() and file.read_bytes().count(b"\n") > 2 + 15):
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.01)
    (os.kill if target == "process" else os.killpg)(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 42, errors
    assert "Traceback" not in errors
    assert not processes_left(process.pid)

    saved = file.read_bytes().count(b"\n") - 2
    resumed = identify(line, EXPERIMENT, BOUNDS, history=file, **QUICK)
    assert 15 < saved < resumed.evaluations
    # Beside the evaluations: title, header, and how the search ended.
    assert file.read_bytes().count(b"\n") - 3 == resumed.evaluations
    assert_same(resumed, identify(line, EXPERIMENT, BOUNDS, **QUICK))


@pytest.mark.skipif(os.name != "posix", reason="kills a process by a signal")
def test_workers_end_when_their_parent_is_killed(tmp_path):
    script, file = tmp_path / "slow.py", tmp_path / "history.csv"
    script.write_text(textwrap.dedent(SLOW_SCRIPT))
    command = [sys.executable, str(script), "2", str(file)]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    deadline = time.monotonic() + 60
    while not (file.exists() and file.read_bytes().count(b"\n") > 5):
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    process.kill()
    process.wait()
    while (left := processes_left(process.pid)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not left
