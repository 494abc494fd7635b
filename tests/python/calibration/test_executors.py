"""Executors of the caller's: the same bits wherever the model runs."""

from __future__ import annotations

import os
import signal
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from test_resuming import BOUNDS, EXPERIMENT, assert_same, fragile_line, line

from curvewise.calibration import SDRM, SimulationStore, identify

KEYWORDS = {"method": SDRM(maxiter=3), "progress": False}


def deadly(parameters):
    os._exit(3)


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
    with pytest.raises(ValueError, match="workers is 2 beside an executor"):
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
        threads.submit(abs, -1).result()  # what was given to it before has ended
    assert len(started) == 2
    found = identify(line, EXPERIMENT, BOUNDS, **KEYWORDS)
    assert np.isfinite(found.value)
