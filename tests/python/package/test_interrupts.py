"""Ctrl-C, progress and threads during a long call.

No test asserts a time; the interrupted calls would continue for half a minute and more.
(benchmarks/speed/interrupts.py measures the latencies.)
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import curvewise


def random_walk(n: int, dim: int = 2, seed: int = 0) -> np.ndarray:
    return np.random.default_rng([n, dim, seed]).normal(size=(n, dim)).cumsum(axis=0)


LONG = random_walk(300_000), random_walk(300_000, seed=1)
MANY = [random_walk(100, seed=seed) for seed in range(200)] * 50
ENDLESS = np.broadcast_to(np.array([1.0, 2.0]), (10**10, 2))  # takes no memory
# All places on a circle are as far from what lies at its centre, so that no offset is left out.
ANGLES = np.linspace(0, 2 * np.pi, 1001)
CIRCLE = np.column_stack((np.cos(ANGLES), np.sin(ANGLES)))
CENTRE = 1e-3 * CIRCLE[::-7]
ZIGZAG = np.column_stack((np.arange(20_001) % 2, np.zeros(20_001)))

MANY_ALIKE = curvewise.Index([LONG[0][: 300 + i] for i in range(200)] * 10)
MANY_AREA = curvewise.Index(MANY, "pcm")

LONG_CALLS: dict[str, Callable[[], object]] = {
    "dtw": lambda: curvewise.dtw(*LONG),
    "dtw, 2 workers": lambda: curvewise.dtw(*LONG, workers=2),
    "dtw, many coordinates": lambda: curvewise.dtw(
        random_walk(3000, 2000), random_walk(3000, 2000), metric="minkowski", p=3
    ),
    "frechet, 3 workers": lambda: curvewise.frechet(*LONG, metric="minkowski", p=3, workers=3),
    "dtw_path": lambda: curvewise.dtw_path(*LONG, workers=2),
    "frechet_path": lambda: curvewise.frechet_path(*LONG),
    "pcm": lambda: curvewise.pcm(ZIGZAG, ZIGZAG[:10_001], offsets="continuous"),
    "pcm_match": lambda: curvewise.pcm_match(*LONG, offsets=10**6),
    "pdist": lambda: curvewise.pdist(MANY, metric="minkowski", p=3),
    "pdist, 2 workers": lambda: curvewise.pdist(MANY, metric="minkowski", p=3, workers=2),
    "cdist, one pair": lambda: curvewise.cdist(LONG[:1], LONG[1:], workers=2),
    "cdist, pcm": lambda: curvewise.cdist(MANY, measure="pcm", workers=2),
    "cdist, callable": lambda: curvewise.cdist(MANY, measure=lambda P, Q: curvewise.pcm(P, Q)),
    "Prepared": lambda: curvewise.Prepared(LONG[0], "dtw")(LONG[1]),
    "kneighbors": lambda: MANY_ALIKE.kneighbors(n_neighbors=1999),
    "kneighbors, 2 workers": lambda: MANY_ALIKE.kneighbors(n_neighbors=1999, workers=2),
    "radius_neighbors": lambda: MANY_AREA.radius_neighbors(radius=1.0),
    "subsequence": lambda: curvewise.subsequence(*LONG, k=3),
    "matrix_profile": lambda: curvewise.matrix_profile(LONG[0], 100, workers=2),
    "matrix_profile, dtw": lambda: curvewise.matrix_profile(LONG[0][:9000], 300, window=30),
    "dtw_mean": lambda: curvewise.dtw_mean(LONG, initial=LONG[0], workers=2),
    "medoid": lambda: curvewise.medoid(MANY, "frechet", metric="minkowski", p=3),
    "Prepared, few points": lambda: curvewise.Prepared(
        random_walk(3000, 2000), "dtw", metric="minkowski", p=3
    )(random_walk(2000, 2000)),
    "cdist, many offsets": lambda: curvewise.cdist([CIRCLE], [CENTRE], "pcm", offsets=10**9),
    "simplify": lambda: curvewise.curves.simplify(ZIGZAG, 0.5),
    "sum_of_squares": lambda: curvewise.sum_of_squares(ENDLESS, ENDLESS),
    "frechet_continuous": lambda: curvewise.frechet_continuous(*LONG),
    "value_and_gradient": lambda: curvewise.value_and_gradient(*LONG, "frechet"),
    "Prepared, list": lambda: curvewise.Prepared(LONG[0], "dtw")([LONG[1]] * 3, workers=2),
}


@pytest.fixture
def interrupted_soon() -> Iterator[None]:
    timer = threading.Timer(0.3, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    yield
    timer.join()


@pytest.mark.skipif(os.name != "posix", reason="os.kill sends SIGINT on POSIX systems only")
@pytest.mark.usefixtures("interrupted_soon")
@pytest.mark.parametrize("name", LONG_CALLS)
def test_ctrl_c_ends_a_long_call(name):
    threads = threading.active_count()
    with pytest.raises(KeyboardInterrupt):
        LONG_CALLS[name]()
    P, Q = random_walk(400), random_walk(300)
    assert curvewise.dtw(P, Q) == curvewise.reference.dtw(P, Q)
    assert threading.active_count() <= threads


@pytest.mark.skipif(os.name != "posix", reason="sends SIGUSR1")
def test_a_handler_that_raises_nothing_does_not_end_the_call():
    heard: list[int] = []
    before = signal.signal(signal.SIGUSR1, lambda number, frame: heard.append(number))
    P, Q = random_walk(18_000), random_walk(18_000, seed=1)
    timer = threading.Timer(0.1, os.kill, [os.getpid(), signal.SIGUSR1])
    timer.start()
    try:
        value = curvewise.dtw(P, Q)
        timer.join()
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert heard == [signal.SIGUSR1]
    assert value == curvewise.dtw(P, Q, workers=2)


class EnoughError(Exception):
    """What progress raises to end a call."""


class Recorder:
    """Keeps what progress reports."""

    def __init__(self) -> None:
        self.calls: list[tuple[int, int]] = []

    def __call__(self, done: int, total: int) -> None:
        self.calls.append((done, total))


@pytest.mark.parametrize("workers", [1, 2])
def test_progress_counts_cells(workers):
    X = [random_walk(n, seed=n) for n in range(300, 340)]
    sizes = np.arange(300, 340)
    total = int((sizes.sum() ** 2 - (sizes**2).sum()) // 2)
    record = Recorder()
    curvewise.pdist(X, workers=workers, progress=record)
    assert {of for _, of in record.calls} == {total}
    done = [so_far for so_far, _ in record.calls]
    assert done == sorted(done)
    assert done[-1] == total
    assert done.count(total) == 1


def test_progress_inside_one_long_pair():
    inside = set()

    def two_of_them(done: int, total: int) -> None:
        if 0 < done < total:
            inside.add(done)
        if len(inside) == 2:
            raise EnoughError

    with pytest.raises(EnoughError):
        curvewise.cdist(LONG[:1], LONG[1:], progress=two_of_them)


@pytest.mark.parametrize("measure", ["area", "pcm", "curve_length", lambda P, Q: 0.0])
def test_progress_of_other_measures_counts_points(measure):
    X = [random_walk(n, seed=n) for n in (50, 60, 70)]
    record = Recorder()
    curvewise.cdist(X, X[:2], measure, progress=record)
    assert record.calls[-1] == (2 * 180 + 3 * 110,) * 2


def test_abandoned_pairs_count_as_done():
    X = [random_walk(1000, seed=seed) for seed in range(10)]
    record = Recorder()
    curvewise.pdist(X, cutoff=0.0, progress=record)
    assert record.calls[-1] == (45_000_000, 45_000_000)


@pytest.mark.parametrize("workers", [1, 2])
def test_what_progress_raises_ends_the_call(workers):
    def enough(done: int, total: int) -> None:
        raise EnoughError(f"{done} of {total}")

    with pytest.raises(EnoughError, match="of 90000000000"):
        curvewise.cdist(LONG[:1], LONG[1:], workers=workers, progress=enough)


def test_progress_bar(capsys):
    curvewise.pdist([random_walk(300, seed=seed) for seed in range(60)], progress=True)
    assert "100%" in capsys.readouterr().err


def test_progress_bar_without_tqdm(monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    with pytest.raises(ImportError, match=r'pip install "curvewise\[progress\]"'):
        curvewise.pdist([random_walk(3)], progress=True)


def test_concurrent_calls():
    """Eight threads at once, on the same arrays; on free-threaded Python truly so."""
    X = [random_walk(n, seed=n) for n in (3, 50, 257, 600)]
    prepared = curvewise.Prepared(X[2], "frechet")

    def call(k: int) -> object:
        P, Q = X[k % 4], X[(k // 4) % 4]
        return (
            curvewise.dtw(P, Q, workers=1 + k % 2),
            curvewise.frechet_path(P, Q).path.tolist(),
            curvewise.pcm(P, Q),
            curvewise.area(P, Q),
            prepared(Q),
            curvewise.pdist(X, workers=1 + k % 3).tolist(),
        )

    expected = [call(k) for k in range(64)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(call, range(64))) == expected


def test_another_thread_runs_meanwhile():
    """The lock is released: a thread counts while the main thread is inside one call."""
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    curvewise.dtw(LONG[0][:15_000], LONG[1][:15_000])
    after = counted
    stop.set()
    thread.join()
    assert after - before > 100


def test_calls_on_other_threads_do_not_take_the_signal():
    """A call on a worker thread runs to its end; Python gives KeyboardInterrupt to the main one."""
    code = """
import os, signal, threading, time
import numpy as np, curvewise
P = np.random.default_rng(0).normal(size=(20_000, 2)).cumsum(axis=0)
values = []
thread = threading.Thread(target=lambda: values.append(curvewise.dtw(P, P[::-1])))
thread.start()
try:
    time.sleep(0.1)
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(60)
except KeyboardInterrupt:
    thread.join()
    print("interrupted", values == [curvewise.dtw(P, P[::-1])])
"""
    if os.name != "posix":
        pytest.skip("os.kill sends SIGINT on POSIX systems only")
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stdout == "interrupted True\n", run.stderr
