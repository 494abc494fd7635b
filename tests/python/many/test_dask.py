"""Blocks on a scheduler of dask have the bits of the local matrix, and outlive their workers."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import curvewise

if TYPE_CHECKING:
    from distributed import Client

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
pytestmark = pytest.mark.skipif(
    find_spec("distributed") is None, reason='no dask: pip install "curvewise[dask]"'
)

Curves = list[np.ndarray[Any, np.dtype[np.float64]]]
CASES: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {}),
    ("dtw", {"window": 20, "step_pattern": "symmetric2", "metric": "cityblock"}),
    ("dtw", {"open_begin": True, "open_end": True}),
    ("frechet", {}),
    ("area", {}),
    ("area", {"spacing": "arc_length"}),
    ("pcm", {"offsets": 20}),
    ("curve_length", {"scale": "mean_abs"}),
]
THREADS = {"scheduler": "threads", "num_workers": 2}


def walks(count: int, seed: int = 0, shortest: int = 5, longest: int = 30) -> Curves:
    random = np.random.default_rng(seed)
    lengths = random.integers(shortest, longest, count)
    return [random.normal(size=(n, 2)).cumsum(axis=0) for n in lengths]


def mean_gap(P: Any, Q: Any, *, power: float = 1.0) -> float:
    """Return something that is not symmetric, and not 0 on the diagonal."""
    return float(np.abs(P).sum() ** power - Q[0, 0])


def slowly(P: Any, Q: Any, *, folder: Path) -> float:
    """Compare slowly, and leave a file that says which process began with which pair."""
    (folder / f"{os.getpid()} {P[0, 0].hex()} {Q[0, 0].hex()}").touch()
    time.sleep(0.01)
    return curvewise.frechet(P, Q)


def begun(folder: Path) -> dict[int, set[str]]:
    """Return the pairs that each process began with."""
    pairs: dict[int, set[str]] = {}
    for file in folder.iterdir():
        process, _, pair = file.name.partition(" ")
        pairs.setdefault(int(process), set()).add(pair)
    return pairs


@pytest.mark.parametrize(("measure", "options"), CASES)
@pytest.mark.parametrize("block", [1, 3, 7, 100, None])
def test_blocks_have_the_bits_of_the_local_matrix(
    measure: str, options: dict[str, Any], block: int | None
) -> None:
    import dask.array

    XA, XB = walks(10), walks(7, seed=1)
    for curves in ((XA,), (XA, XB), (XA, XA)):
        local = curvewise.cdist(*curves, measure=measure, **options)
        lazy = curvewise.dask.cdist(*curves, measure=measure, block=block, **options)
        assert isinstance(lazy, dask.array.Array)
        assert (lazy.shape, lazy.dtype) == (local.shape, local.dtype)
        assert np.array_equal(lazy.compute(**THREADS), local)


def test_the_earlier_curve_is_p_above_and_below_the_diagonal() -> None:
    curves = walks(10, shortest=20, longest=21)
    both = curvewise.cdist(curves, curves, "area", crossing="split")
    assert (both != both.T).any()  # equal but for rounding, so that the order can be seen
    lazy = curvewise.dask.cdist(curves, measure="area", crossing="split", block=7)
    local = curvewise.cdist(curves, measure="area", crossing="split")
    assert np.array_equal(lazy.compute(**THREADS), local)


def test_blocks_in_processes() -> None:
    XA, XB = walks(5), walks(4, seed=1)
    computed = curvewise.dask.cdist(XA, XB, "frechet", block=2).compute(
        scheduler="processes", num_workers=1
    )
    assert np.array_equal(computed, curvewise.cdist(XA, XB, "frechet"))


def test_options_of_single_pairs_may_have_their_defaults() -> None:
    curves, defaults = walks(4), {"closed": False, "dependent": True}
    lazy = curvewise.dask.cdist(curves, measure="dtw", **defaults)
    assert np.array_equal(lazy.compute(**THREADS), curvewise.cdist(curves, measure="dtw"))
    triangle = curvewise.dask.pdist(curves, "dtw", **defaults)
    assert np.array_equal(triangle.compute(**THREADS), curvewise.pdist(curves, "dtw"))
    curvewise.dask.kneighbors(curves, curves, 1, **defaults)
    with pytest.raises(TypeError, match=r"^dtw has closed=True for one pair, in curvewise\.cdist "):
        curvewise.dask.pdist(curves, "dtw", closed=True)


def test_a_cutoff() -> None:
    curves = walks(9)
    cutoff = float(np.median(curvewise.pdist(curves)))
    local = curvewise.cdist(curves, cutoff=cutoff)
    assert np.isinf(local).any()
    computed = curvewise.dask.cdist(curves, cutoff=cutoff, block=4).compute(**THREADS)
    assert np.array_equal(computed, local)


@pytest.mark.parametrize("others", [None, walks(3, seed=1)])
def test_a_callable(others: Curves | None) -> None:
    curves = walks(6)
    local = curvewise.cdist(curves, others, mean_gap, power=2.0)
    lazy = curvewise.dask.cdist(curves, others, mean_gap, block=4, power=2.0)
    assert np.array_equal(lazy.compute(**THREADS), local)


def test_other_inputs() -> None:
    stack = np.arange(60.0).reshape(5, 6, 2)[::-1] ** 1.5
    computed = curvewise.dask.cdist(stack, block=2).compute(**THREADS)
    assert np.array_equal(computed, curvewise.cdist(stack))
    flat = [[0, 1, 2, 3], [0, 0, 3, 3], (0, 3, 0)]
    computed = curvewise.dask.cdist(flat, block=2).compute(**THREADS)
    assert np.array_equal(computed, curvewise.cdist(flat))
    for curves in (([], flat), (flat, []), ([],)):
        computed = curvewise.dask.cdist(*curves).compute(**THREADS)
        assert computed.shape == curvewise.cdist(*curves).shape


def test_each_pair_of_a_symmetric_measure_is_computed_once_and_each_piece_is_one_task() -> None:
    lazy = curvewise.dask.cdist(walks(10), block=2)
    tasks = list(dict(lazy.dask).values())
    assert len(tasks) == 5 + 5 * 5
    assert sum("transpose" in repr(task) for task in tasks) == 5 * 4 / 2
    lazy = curvewise.dask.cdist(walks(10), walks(4), block=2)
    assert len(dict(lazy.dask)) == 5 + 2 + 5 * 2


def test_the_block_size_follows_the_points() -> None:
    long, short = [np.zeros((8000, 2))] * 9, [np.ones((100, 2))] * 700
    assert curvewise.dask.cdist(long).chunks == ((4, 4, 1), (4, 4, 1))
    assert curvewise.dask.cdist(short).chunks == ((320, 320, 60), (320, 320, 60))


def test_a_curve_changed_later_changes_nothing() -> None:
    curves = walks(4)
    local = curvewise.cdist(curves)
    lazy = curvewise.dask.cdist(curves, block=2)
    curves[0][:] = 0.0
    assert np.array_equal(lazy.compute(**THREADS), local)


def refused(**changes: Any) -> dict[str, Any]:
    return {"XA": walks(4), "XB": walks(3, seed=1), "measure": "dtw", **changes}


BROKEN = walks(4)
BROKEN[2][1, 0] = np.nan
STILL = [*walks(2), np.ones((5, 2))]
REFUSED = [
    refused(XA=3),
    refused(XA=BROKEN),
    refused(XB=BROKEN),
    refused(XA=BROKEN, XB=None),
    refused(XB=[*walks(2), [[1.0, 2.0, 3.0]]]),
    refused(XA=[*walks(2), [[1.0, 2.0, 3.0]]], XB=None),
    refused(XB=[*walks(2), [1.0, 2.0]]),
    refused(XB=[*walks(2), [[1.0, 2.0]]], measure="area"),
    refused(XA=np.ones((3, 4, 3)), XB=None, measure="frechet", metric="manhattan"),
    refused(XA=np.ones((3, 4, 3)), XB=None, measure="area"),
    refused(XA=STILL, measure="pcm"),
    refused(XB=STILL, measure="curve_length", scale="mean_abs"),
    refused(XA=[[(-1, 1), (1, -1)]], XB=None, measure="curve_length"),
    refused(measure="euclidean"),
    refused(measure="dtw", window=-1),
    refused(measure="dtw", window=0),
    refused(measure="pcm", offsets=0),
    refused(measure="dtw", metric="frechet"),
    refused(measure="dtw", offsets=3),
    refused(cutoff=-1.0),
]


@pytest.mark.parametrize("arguments", REFUSED)
def test_what_cdist_refuses_is_refused_at_once_in_its_words(arguments: dict[str, Any]) -> None:
    with pytest.raises((ValueError, TypeError)) as local:
        curvewise.cdist(**arguments)
    with pytest.raises(local.type) as lazy:
        curvewise.dask.cdist(**arguments)
    assert str(lazy.value) == str(local.value)


def test_without_dask() -> None:
    code = "import sys; sys.modules['dask'] = None; import curvewise, curvewise.dask"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    last_line = done.stderr.strip().splitlines()[-1]
    message = 'curvewise.dask needs dask: pip install "curvewise[dask]"'
    assert last_line == f"ImportError: {message}"


@pytest.mark.parametrize("block", [0, -1, 2.0, True, "3"])
def test_block_out_of_range(block: Any) -> None:
    with pytest.raises(ValueError, match="block") as caught:
        curvewise.dask.cdist(walks(2), block=block)
    assert str(caught.value) == f"block is {block!r}; give a whole number >= 1, or None"


@pytest.mark.parametrize("name", ["out", "progress", "workers"])
def test_what_only_the_local_cdist_has(name: str) -> None:
    with pytest.raises(TypeError, match=f"no '{name}': the scheduler"):
        curvewise.dask.cdist(walks(2), **{name: 1})


@pytest.fixture
def client() -> Iterator[Client]:
    """Two worker processes of one thread each, which a nanny starts again when they end."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(
            n_workers=2,
            processes=True,
            threads_per_worker=1,
            dashboard_address=":0",
            silence_logs=50,
        ) as cluster,
        Client(cluster) as client,
    ):
        yield client


@pytest.mark.nightly
def test_a_cluster(client: Client) -> None:
    XA, XB = walks(12, longest=80), walks(9, seed=1, longest=80)
    for measure, options in CASES:
        for curves in ((XA,), (XA, XB)):
            lazy = curvewise.dask.cdist(*curves, measure=measure, block=4, **options)
            local = curvewise.cdist(*curves, measure=measure, **options)
            assert np.array_equal(lazy.compute(), local)
    assert len(client.scheduler_info()["workers"]) == 2


SCRIPT = """
import os, signal, sys, threading, time
import numpy as np
import curvewise.dask

signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
walks = [np.random.default_rng(k).normal(size=(300_000, 2)).cumsum(axis=0) for k in range(4)]
lazy = curvewise.dask.cdist(walks, block=1, metric="minkowski", p=3)  # minutes a block
threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
try:
    lazy.compute(scheduler="threads", num_workers=2)
except KeyboardInterrupt:
    print("interrupted", flush=True)
def running():
    modules = [frame.f_globals["__name__"] for frame in sys._current_frames().values()]
    return "curvewise.many.pairwise" in modules
if sys.argv[1] == "stay":
    while running():
        time.sleep(0.01)
    print("idle", flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="os.kill sends SIGINT on POSIX systems only")
@pytest.mark.parametrize(("then", "output"), [("leave", ""), ("stay", "idle\n")])
@pytest.mark.nightly("stay")
def test_ctrl_c_ends_the_blocks_that_have_begun(then: str, output: str) -> None:
    """The process ends, too, which waits for its threads."""
    run = subprocess.run(
        [sys.executable, "-c", SCRIPT, then], capture_output=True, text=True, timeout=60, check=True
    )
    assert run.stdout == "interrupted\n" + output


@pytest.mark.nightly
def test_cancelling_ends_the_blocks_that_have_begun(client: Client) -> None:
    long = [np.random.default_rng(k).normal(size=(300_000, 2)).cumsum(axis=0) for k in range(2)]
    future = client.compute(curvewise.dask.cdist(long, block=1, metric="minkowski", p=3))
    while not any(client.processing().values()):
        time.sleep(0.01)
    time.sleep(0.3)
    future.cancel()
    # The workers are free again: they compute new tasks.
    few = walks(3)
    found = client.compute(curvewise.dask.cdist(few)).result(timeout=60)
    assert np.array_equal(found, curvewise.cdist(few))


@pytest.mark.nightly
def test_a_worker_killed_in_the_middle_loses_nothing(client: Client, tmp_path: Path) -> None:
    curves = walks(20)
    # 25 blocks of 16 pairs, a sixth of a second each: some are done, one is half done.
    lazy = curvewise.dask.cdist(curves, measure=slowly, block=4, folder=tmp_path)
    victim, _ = client.run(os.getpid).values()
    future = client.compute(lazy)
    deadline = time.monotonic() + 20
    while len(begun(tmp_path).get(victim, ())) < 40:
        assert time.monotonic() < deadline, "the worker to be killed did not get that far"
        time.sleep(0.01)
    assert not future.done()
    os.kill(victim, signal.SIGKILL)
    computed = future.result(timeout=60)
    assert np.array_equal(computed, curvewise.cdist(curves, measure="frechet"))
    pairs = begun(tmp_path)
    lost = pairs.pop(victim)
    assert len(lost) < 400
    assert lost <= set().union(*pairs.values())


@pytest.mark.parametrize(("measure", "options"), [("dtw", {"window": 30}), ("area", {})])
@pytest.mark.parametrize("block", [1, 3, 50])
def test_neighbours_are_those_of_one_index(measure, options, block):
    import dask

    random = np.random.default_rng(4)
    curves = [random.normal(size=(n, 2)).cumsum(axis=0) for n in random.integers(10, 30, 14)]
    curves[9] = curves[2]  # equal distances, in different blocks
    X, count = curves[:4], 5
    expected = curvewise.Index(curves, measure, **options).kneighbors(X, count)
    lazy = curvewise.dask.kneighbors(X, curves, count, measure, block=block, **options)
    for found, part in zip(dask.compute(*lazy, scheduler="threads"), expected, strict=True):
        np.testing.assert_array_equal(found, part)
    assert lazy[0].shape == lazy[1].shape == (4, count)
    assert lazy[1].dtype == np.int64


def test_neighbours_are_refused_at_once():
    for call, message in [
        (lambda: curvewise.dask.kneighbors([[0]], [[0], [1]], 3), "n_neighbors is 3; give .* 1 to"),
        (lambda: curvewise.dask.kneighbors([[0]], [[0], [np.nan]], 1), r"XB\[1\]\[0\] is nan"),
        (lambda: curvewise.dask.kneighbors([[0]], [[0]], 1, "far"), "unknown measure 'far'"),
    ]:
        with pytest.raises(ValueError, match=message):
            call()
