"""Executors of the caller's: the same bits wherever the model runs."""

from __future__ import annotations

import os
import signal
import threading
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from test_resuming import BOUNDS, EXPERIMENT, assert_same, fragile_line, line

from curvewise.calibration import SDRM, SimulationStore, TrustRegion, identify
from curvewise.calibration.models.forward import SingleModel
from curvewise.calibration.models.pool import ModelPool, Outcome
from curvewise.calibration.problem.simulator import Dispatch, Simulator

KEYWORDS = {"method": SDRM(maxiter=3), "progress": False}
STARTS = {
    "method": TrustRegion(most_starts=4, starts_at_once=3),
    "measure": "curve_length",
    "progress": False,
}


def deadly(parameters):
    os._exit(3)


def deadly_line(parameters):
    if parameters["a"] > 7.0:
        deadly(parameters)
    return line(parameters)


def refused_line(parameters):
    if parameters["a"] > 7.0:
        raise ValueError("too steep")
    return line(parameters)


class Handed(Executor):
    """Calls nothing: its futures are filled in by the test, through `outcomes`."""

    def __init__(self):
        self.given = []

    def submit(self, function, *arguments):
        future = Future()
        self.given.append((future, arguments[-1]["parameters"]["a"]))
        future.set_running_or_notify_cancel()
        return future

    def end(self, a):
        (future,) = [future for future, of in self.given if of == a]
        future.set_result(Outcome([[0.0, a]], "", 0.0))


@pytest.fixture(scope="module")
def dask_executor():
    distributed = pytest.importorskip(
        "distributed", reason='no dask: pip install "curvewise[dask]"'
    )
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client.get_executor()


def test_dask_threads_processes_and_none_give_the_same_bits(dask_executor):
    alone = identify(fragile_line, EXPERIMENT, BOUNDS, **KEYWORDS)
    assert alone.failures
    assert_same(alone, identify(fragile_line, EXPERIMENT, BOUNDS, workers=2, **KEYWORDS))
    with ProcessPoolExecutor(2) as processes, ThreadPoolExecutor(2) as threads:
        for executor in (dask_executor, processes, threads):
            found = identify(fragile_line, EXPERIMENT, BOUNDS, executor=executor, **KEYWORDS)
            assert_same(alone, found)
        assert processes.submit(abs, -1).result() == 1  # left as it was


def test_an_executor_fills_a_store(dask_executor, tmp_path):
    keywords = {**KEYWORDS, "store": SimulationStore(tmp_path / "s.db", version="1")}
    found = identify(line, EXPERIMENT, BOUNDS, executor=dask_executor, **keywords)
    again = identify(line, EXPERIMENT, BOUNDS, **keywords)
    assert again.runs == 0
    assert_same(found, again)


def test_executors_that_are_none_and_that_break():
    with pytest.raises(TypeError, match="executor is int; give one as concurrent"):
        identify(line, EXPERIMENT, BOUNDS, executor=3, **KEYWORDS)
    threads = ThreadPoolExecutor(1)
    with pytest.raises(ValueError, match="workers is 2, but the executor"):
        identify(line, EXPERIMENT, BOUNDS, executor=threads, workers=2, **KEYWORDS)
    threads.shutdown()
    with ProcessPoolExecutor(1) as processes:
        with pytest.raises(ValueError, match="cannot be sent to the executor's processes"):
            identify(lambda p: line(p), EXPERIMENT, BOUNDS, executor=processes, **KEYWORDS)
        with pytest.raises(RuntimeError, match="the executor has broken down"):
            identify(deadly, EXPERIMENT, BOUNDS, executor=processes, **KEYWORDS)


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT")
def test_ctrl_c_gives_nothing_more_to_an_executor(tmp_path):
    started, go_on = [], threading.Event()

    def slow(parameters):
        started.append(parameters)
        if len(started) == 2:
            os.kill(os.getpid(), signal.SIGINT)
            go_on.wait(5.0)
        return line(parameters)

    with ThreadPoolExecutor(1) as threads:
        with pytest.raises(KeyboardInterrupt):
            identify(slow, EXPERIMENT, BOUNDS, executor=threads, **KEYWORDS)
        go_on.set()
        threads.submit(abs, -1).result()  # earlier work has ended
    assert len(started) == 2
    found = identify(line, EXPERIMENT, BOUNDS, **KEYWORDS)
    assert np.isfinite(found.value)


@pytest.mark.parametrize("most", [7, 13])
def test_starts_give_the_same_bits_on_any_number_of_workers(most):
    """And in any order of arrival; all runs count, and no run exceeds a limit."""
    alone = identify(fragile_line, EXPERIMENT, BOUNDS, max_runs=most, **STARTS)
    assert alone.evaluations == most
    order = np.random.default_rng(2)

    def late(parameters):
        made.append(parameters)
        time.sleep(order.uniform(0.0, 0.002))
        return fragile_line(parameters)

    for workers in (1, 2, 8):
        made: list[dict[str, float]] = []
        with ThreadPoolExecutor(workers) as threads:
            found = identify(late, EXPERIMENT, BOUNDS, executor=threads, max_runs=most, **STARTS)
        assert_same(alone, found)
        assert len(made) == found.runs == found.evaluations
    assert_same(
        alone, identify(fragile_line, EXPERIMENT, BOUNDS, workers=2, max_runs=most, **STARTS)
    )


def test_a_run_that_kills_its_process_is_one_failure_among_starts():
    found = identify(deadly_line, EXPERIMENT, BOUNDS, workers=2, **STARTS)
    without = identify(refused_line, EXPERIMENT, BOUNDS, **STARTS)
    assert found.history.failed.any()
    for name in ("a", "b", "value", "failed"):
        assert np.array_equal(found.history[name], without.history[name])
    assert {message for _, message in found.failures} == {"the worker process died"}


def test_what_is_begun_is_saved_before_it_is_asked_for(tmp_path):
    """And asked for it is not run again."""
    executor = Handed()
    pool = ModelPool(Dispatch([line]), executor=executor)
    with pool, SimulationStore(tmp_path / "s.db", version="1") as store:
        simulator = Simulator(pool, SingleModel(line, 1), store)
        simulator.begin([{"a": 1.0}, {"a": 2.0}, {"a": 3.0}])
        executor.end(2.0)
        executor.end(3.0)
        ((place, outcome),) = simulator.run([{"a": 3.0}])
        assert (place, outcome.simulations) == (0, [[0.0, 3.0]])
        assert (len(store), simulator.runs) == (2, 2)
        executor.end(1.0)
        simulator.keep_finished()
        assert len(store) == 3
        found = dict(simulator.run([{"a": 1.0}, {"a": 2.0}]))
        assert [found[i].simulations for i in (0, 1)] == [[[0.0, 1.0]], [[0.0, 2.0]]]
    assert (simulator.runs, simulator.looked_up) == (3, 0)
    assert sorted(a for _, a in executor.given) == [1.0, 2.0, 3.0]


def test_what_is_begun_is_cancelled_where_a_search_ends():
    executor = Handed()
    executor.submit = lambda *_: executor.given.append(Future()) or executor.given[-1]
    with ModelPool(line, executor=executor) as pool:
        pool.begin([{"a": 1.0}])
    assert executor.given[0].cancelled()
