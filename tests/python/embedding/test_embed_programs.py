"""The programs of docs/embedding/programs.md: whole tasks in C++, C and Fortran.

The examples are built once (conftest.py); what each prints is compared with Python.
"""

from __future__ import annotations

import itertools
import math
import re

import numpy as np
import pytest
from programs import MARKS, ROOT, compiler, loop, numbers, output, run

import curvewise

pytestmark = MARKS


def drawn(corners: list[tuple[float, float]], per_edge: int) -> np.ndarray:
    """Return the stroke of gesture.cpp."""
    edges = np.array(corners, float)
    t = np.arange(per_edge)[:, None] / per_edge
    lines = [a + t * (b - a) for a, b in itertools.pairwise(edges)]
    return np.concatenate([*lines, edges[-1:]])


def test_gesture(examples) -> None:
    templates = {
        "square": drawn([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], 16),
        "triangle": drawn([(0, 0), (4, 0), (2, 4), (0, 0)], 16),
        "zigzag": drawn([(0, 0), (1, 4), (2, 0), (3, 4), (4, 0)], 16),
    }
    live = drawn([(0.125, 0), (4.25, 0.25), (2, 3.5), (0, 0.25)], 32)
    distances = {name: curvewise.dtw(one, live, window=0.25) for name, one in templates.items()}
    best = min(distances, key=lambda name: distances[name])
    assert output(examples / "gesture") == f"{best} {distances[best]:.17g}\nunknown\n"


def track(number: int, shift: float = 0.0) -> np.ndarray:
    """Return the track of track_server.cpp and track_index.c."""
    i = np.arange(24)
    return np.column_stack([i, number + (i * number % 7) / 8.0 + shift])


def test_track_server(examples) -> None:
    distances = [curvewise.frechet(track(40, 0.25), track(number)) for number in range(64)]
    assert numbers(output(examples / "track_server")) == {
        "tracks": 64,
        "worse": 0,
        "nearest": np.argmin(distances),
        "distance": min(distances),
    }


@pytest.mark.parametrize(("gain", "status", "verdict"), [(1.0, 0, "PASS"), (1.25, 1, "FAIL")])
def test_test_bench(gain, status, verdict, examples) -> None:
    measured = loop(65, 0.5)
    measured[:, 1] *= gain
    done = run(examples / "test_bench", str(gain))
    assert (done.returncode, done.stdout.splitlines()[-1]) == (status, verdict)
    found = re.findall(r"^(\w+) +(\S+)( exceeds its limit)?", done.stdout, re.MULTILINE)
    expected = curvewise.compare(loop(129, 0.5), measured).to_dict()
    assert {name: float(value) for name, value, _ in found} == expected
    assert all(exceeds == "" for *_, exceeds in found) == (status == 0)


def test_stop_button(examples) -> None:
    P, Q = (
        np.column_stack([np.arange(n), np.arange(n) * k % 17]) for n, k in ((1000, 3), (800, 5))
    )
    printed = output(examples / "stop_button")
    assert numbers(printed) == {"dtw": curvewise.dtw(P, Q), "progress": 1.0}
    assert printed.endswith("\nstopped before the work was done\n")


def test_containers(examples) -> None:
    points = np.array([(0, 0), (1, 1.5), (2, 2.25), (3, 2.5)])
    other = np.array([(0, 0.25), (1.5, 1.75), (3, 2.25)])
    found = numbers(output(examples / "containers"))
    value = curvewise.dtw(points, other)
    assert found.pop("span", None) in (None, curvewise.dtw(points[:3], other))
    assert found == {
        **dict.fromkeys(("points_and_array", "vector_of_arrays", "members_of_structs"), value),
        "backwards": curvewise.dtw(points, other[::-1]),
        "one_dimension": curvewise.dtw([0, 1, 4, 2], [0, 0, 1, 4, 2]),
        "column_major": value,
        "floats": value,
    }


def history(n: int, slope: float, step: float) -> np.ndarray:
    t = np.arange(n) / (n - 1)
    u = 4.0 * t * (1.0 - t)
    return np.column_stack([u, slope * u * (1.0 - 0.25 * u) + np.where(t > 0.5, -step, step)])


def test_post_processor(examples) -> None:
    measured, simulated = history(65, 312.0, 44.0), history(129, 300.0, 40.0)
    i, j = curvewise.dtw_path(measured, simulated).path.T
    gaps = np.abs(measured[i, 1] - simulated[j, 1])
    assert numbers(output(examples / "post_processor")) == {
        **curvewise.compare(measured, simulated).to_dict(),
        "increment": j[np.argmax(gaps)],
        "force_gap": gaps.max(),
    }


def test_track_index(examples) -> None:
    index = curvewise.Index([track(k) for k in range(40)], "frechet", metric="chebyshev")
    distances, indices = (found[0] for found in index.kneighbors([track(20, 0.25)], 3))
    lines = [f"nearest {i} {d:.17g}" for i, d in zip(indices, distances, strict=True)]
    near = index.radius_neighbors([track(20, 0.25)], 2.0)
    lines += [
        f"within 2: {i} {d:.17g}"
        for i, d in zip(near[1][0], near[0][0], strict=True)
        if i != indices[0]
    ]
    assert output(examples / "track_index").splitlines() == [*lines, "tracks 39"]
    assert len(lines) > 4


def test_plug_in(examples) -> None:
    reference = [0, 1, 4, 9, 4, 1, 0]
    signals = {"late": [0, 0, 0, 1, 4, 9, 4, 1, 0], "weak": [0, 1, 3, 7, 3, 1], "flat": [5, 5]}
    scores = {
        name: curvewise.dtw(reference, signal, step_pattern="symmetric2", normalize=True)
        for name, signal in signals.items()
    }
    printed = output(examples / "plug_in")
    assert numbers(printed) == {
        name: score if score <= 1.0 else math.inf for name, score in scores.items()
    }
    assert printed.endswith(" has shape (0, 1); dtw needs at least 1 point\n")


def test_stress_control(examples) -> None:
    compiler("gfortran")
    found = numbers(output(examples / "stress_control"))
    assert found.pop("dtw") < 1e-12
    assert found == pytest.approx({"yield": 250.0, "C1": 60e3, "gamma1": 300.0}, rel=1e-9)


def test_batches(examples) -> None:
    compiler("gfortran")
    simulated = [loop(33, 0.125 * i) for i in range(1, 13)]
    tested = [loop(65, 0.25 * i + 0.0625) for i in range(1, 4)]
    table = curvewise.cdist(tested, simulated, "dtw", step_pattern="symmetric2")
    *best, reported, nearest, within, count = output(examples / "batches").splitlines()
    for i, line in enumerate(best):
        assert line.split()[:4] == ["test", f"{i + 1}", "best", f"{np.argmin(table[i]) + 1}"]
        assert float(line.split()[4]) == table[i].min()
    assert reported == "reported all of the work"
    order = np.argsort(table, axis=1, kind="stable")[:, :2] + 1
    assert nearest == " ".join(["nearest", *map(str, order.ravel())])
    assert within == " ".join(["within", *map(str, order[1])])
    assert count == "simulations 12"


def test_the_page_shows_every_program() -> None:
    page = (ROOT / "docs" / "embedding" / "programs.md").read_text(encoding="utf-8")
    shown = re.findall(r"^```{literalinclude} \.\./\.\./cpp/examples/(\S+)$", page, re.MULTILINE)
    assert sorted(shown) == sorted(path.name for path in (ROOT / "cpp" / "examples").iterdir())
