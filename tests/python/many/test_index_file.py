"""Indexes in files: the same bits after `save` and `open`, and errors that say what is wrong."""

from __future__ import annotations

import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import Index

KNIGHT = curvewise.StepPattern(
    [(1, 1, 2, -1), (1, 0, 0, 1 / 3), (2, 2, 1, -1), (2, 0, 0, 0.1), (3, 1, 1, -1), (3, 0, 0, 1)]
)
CASES: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {}),
    ("dtw", {"window": np.int64(9), "metric": "minkowski", "p": 3.3000000000000003}),
    ("dtw", {"window": 0.1 + 0.2, "step_pattern": "symmetric2", "normalize": np.True_}),
    ("dtw", {"step_pattern": KNIGHT}),
    ("dtw", {"relax": (1, 2, 0, 3)}),
    ("dtw", {"metric": "haversine"}),
    ("frechet", {"prune": False}),
    ("frechet_continuous", {}),
    ("erp", {"gap": np.float32(0.1)}),
    ("area", {"spacing": "arc_length"}),
    ("curve_length", {"scale": "range"}),
    ("hausdorff", {"metric": "chebyshev"}),
]


def random_curves(count: int) -> list[np.ndarray]:
    random = np.random.default_rng(5)
    return [random.normal(size=(n, 2)).cumsum(axis=0) for n in random.integers(12, 20, count)]


def assert_equal(ours: Index, theirs: Index, X: Any) -> None:
    np.testing.assert_array_equal(ours.indices, theirs.indices)
    for asked, count in ((X, len(theirs)), (None, len(theirs) - 1)):
        for one, other in zip(
            ours.kneighbors(asked, count), theirs.kneighbors(asked, count), strict=True
        ):
            assert type(one) is type(other)
            assert one.tobytes() == other.tobytes() if isinstance(one, np.ndarray) else True
            np.testing.assert_array_equal(one, other)
            if isinstance(one, pd.DataFrame):
                pd.testing.assert_frame_equal(one, other)


@pytest.mark.parametrize(("measure", "options"), CASES)
def test_an_opened_index_has_the_same_answers(measure, options, tmp_path):
    curves = random_curves(20)
    index = Index(curves[:12], measure, **options)
    index.remove([0, 7, 11])
    index.save(tmp_path / "index")
    opened = Index.open(tmp_path / "index")
    assert opened._options == index._options
    for _ in range(2):
        assert_equal(opened, index, curves[15:])
        for one in (index, opened):
            one.add(curves[12:15])
            one.remove([one.indices[0], one.indices[-2]])
        opened.save(tmp_path / "index")  # over its own points
    assert_equal(Index.open(str(tmp_path / "index")), index, curves[15:])
    assert_equal(pickle.loads(pickle.dumps(opened)), index, curves[15:])
    assert os.listdir(tmp_path) == ["index"]


@pytest.mark.parametrize(
    "labels",
    [
        ["ramp", "Wärme", "\ud800", "", "peak"],
        [5, -(10**12), 0, 7, 1],
        [("a", 1), ("a", 2), ("b", None), (), ("c", ("d", 0.1))],
        [0.1 + 0.2, float("inf"), 1e-320, -0.5, 2.5],
        [True, "x", None, 3.5, 4],
    ],
)
def test_labels(labels, tmp_path):
    curves = random_curves(8)
    index = Index(dict(zip(labels, curves, strict=False)))
    for label in (None, labels[3]):
        if label is not None:
            index.remove([label])
        index.save(tmp_path / "Index für Ölpumpen")
        opened = Index.open(tmp_path / "Index für Ölpumpen")
        assert_equal(opened, index, dict(zip("abc", curves[5:], strict=True)))
        with pytest.raises(ValueError, match="which another curve has"):
            opened.add({labels[1]: curves[0]})
    opened.remove(labels[:2])
    opened.add({labels[0]: curves[0]})
    assert opened.indices.tolist() == [2, 4, 5]


def test_labels_of_an_index_of_pandas(tmp_path):
    curves = random_curves(5)
    index = Index(pd.Series(curves, index=pd.Index([4, 3, 2, 1, 0])), "frechet")
    index.save(tmp_path / "index")
    assert_equal(Index.open(tmp_path / "index"), index, curves[:2])


def test_an_opened_index_reads_curves_as_the_first_one(tmp_path):
    rows = np.random.default_rng(1).normal(size=(4, 2, 30))
    index = Index(rows, layout="channels_first")
    index.save(tmp_path / "index")
    assert_equal(Index.open(tmp_path / "index"), index, rows)
    Index([], "frechet").save(tmp_path / "none")
    none = Index.open(tmp_path / "none")
    assert (len(none), repr(none)) == (0, "Index(<0 curves>, 'frechet')")
    none.add([[1.0, 2.0]])
    assert none.kneighbors([[1.0]], 1)[0].tolist() == [[1.0]]


def test_reference_systems(tmp_path):
    pyproj = pytest.importorskip("pyproj", reason='no pyproj: pip install "curvewise[geo]"')
    index = Index(random_curves(3))
    index._crs = pyproj.CRS.from_epsg(25832)
    index.save(tmp_path / "index")
    assert Index.open(tmp_path / "index")._crs == index._crs


SCRIPT = """
import sys, hashlib
import numpy as np
import curvewise
index = curvewise.Index.open(sys.argv[1])
distances, indices = index.kneighbors(n_neighbors=3)
print(hashlib.sha256(distances.tobytes() + indices.tobytes()).hexdigest())
"""


def test_another_process_opens_it(tmp_path):
    import hashlib

    index = Index(random_curves(30), "frechet", metric="cityblock")
    index.remove([4])
    index.save(tmp_path / "index")
    distances, indices = index.kneighbors(n_neighbors=3)
    ours = hashlib.sha256(distances.tobytes() + indices.tobytes()).hexdigest()
    run = [sys.executable, "-c", SCRIPT, str(tmp_path / "index")]
    others = [subprocess.Popen(run, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    for other in others:
        assert other.communicate()[0].strip() == ours


@pytest.mark.skipif(not Path("/proc/self/smaps").exists(), reason="only Linux has smaps")
def test_points_are_those_of_the_file(tmp_path):
    """The points of an opened index are clean pages of the file, which processes share."""
    Index(np.random.default_rng(2).normal(size=(2000, 250, 2))).save(tmp_path / "index")
    opened = Index.open(tmp_path / "index")
    regions = re.split(r"\n(?=[0-9a-f]+-[0-9a-f]+ )", Path("/proc/self/smaps").read_text())
    (region,) = [region for region in regions if str(tmp_path / "index") in region]
    kilobytes = {name: int(number) for name, number in re.findall(r"(\w+): +(\d+) kB", region)}
    assert kilobytes["Rss"] >= 2000 * 500 * 8 // 1024
    assert kilobytes["Private_Dirty"] == kilobytes["Shared_Dirty"] == 0
    assert len(opened) == 2000


def test_refusals_of_files(tmp_path):
    path = tmp_path / "index"
    with pytest.raises(FileNotFoundError, match=r"cannot open .*index"):
        Index.open(path)
    with pytest.raises(IsADirectoryError):
        Index.open(tmp_path)
    with pytest.raises(FileNotFoundError, match=r"cannot write .*there"):
        Index([[0.0]]).save(tmp_path / "no" / "there")
    path.write_bytes(b"")
    with pytest.raises(ValueError, match=r"index is not an index of curvewise$"):
        Index.open(path)
    Index([[0.0, 1.0, 2.0]]).save(path)
    whole = path.read_bytes()
    for k in range(0, len(whole), 7):
        for damaged in (whole[:k], whole[:k] + bytes([whole[k] ^ 4]) + whole[k + 1 :]):
            path.write_bytes(damaged)
            with pytest.raises(ValueError, match=f"^{path} (is|has|was)"):
                Index.open(path)
    Index([[0.0]])._index.save(os.fsencode(path), b"")
    with pytest.raises(ValueError, match="does not name the measure of its index, because a C"):
        Index.open(path)


def test_what_cannot_be_written_leaves_the_old_file(tmp_path):
    path = tmp_path / "index"
    Index([[0.0]], "dtw").save(path)
    index = Index({pd.Timestamp("2026-11-29"): [1.0]})
    with pytest.raises(TypeError, match=r"^save cannot write the label Timestamp\(.*; give text"):
        index.save(path)
    index = Index({Fraction(1, 3): [1.0]})  # which no float is
    with pytest.raises(TypeError, match=r"^save cannot write the label Fraction\(1, 3\); "):
        index.save(path)
    index = Index([[1.0]])
    index._options = {"window": object()}
    with pytest.raises(TypeError, match=r"^save cannot write the option window=<object"):
        index.save(path)
    assert Index.open(path).kneighbors([[0.0]], 1)[0].tolist() == [[0.0]]
    assert os.listdir(tmp_path) == ["index"]


KILLED = """
import sys
import numpy as np
import curvewise
index = curvewise.Index(np.arange(2_000_000.0).reshape(1000, 1000, 2))
print("ready", flush=True)
while True:
    index.save(sys.argv[1])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_killed_save_leaves_a_whole_file(tmp_path):
    path = tmp_path / "index"
    Index([[7.0]]).save(path)
    for delay in (0.0, 0.05, 0.1):
        process = subprocess.Popen(
            [sys.executable, "-c", KILLED, str(path)], stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        time.sleep(delay)
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        assert len(Index.open(path)) in (1, 1000)


def test_saving_while_others_change_and_search(tmp_path):
    curves = {f"curve {j}": np.full((50, 1), float(j)) for j in range(200)}
    names = list(curves)
    index = Index({name: curves[name] for name in names[:5]})
    is_done = threading.Event()
    failures: list[BaseException] = []

    def save_and_open() -> None:
        try:
            while not is_done.is_set():
                index.save(tmp_path / "index")
                opened = Index.open(tmp_path / "index")
                distances, nearest = opened.kneighbors(curves, 1)
                for name, own, label in zip(curves, distances[0], nearest[0], strict=True):
                    assert (own == 0.0) == (label == name)
                index.kneighbors(n_neighbors=2)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=save_and_open) for _ in range(2)]
    for thread in threads:
        thread.start()
    for j in range(5, 200):
        index.add({names[j]: curves[names[j]]})
        if j % 2:
            index.remove([names[j - 3]])
    is_done.set()
    for thread in threads:
        thread.join()
    assert not failures
