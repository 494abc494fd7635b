"""simplify against the reference, exact decisions on every edge, and closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise.curves import simplify
from curvewise.curves.named_curve import NamedCurve
from curvewise.curves.simplification import EdgeMeasure
from curvewise.reference.simplification import simplified_rows

Array = npt.NDArray[np.float64]
MEASURES: tuple[EdgeMeasure, ...] = ("frechet", "hausdorff")

COORDINATES = st.integers(-6, 6).map(lambda k: k / 2)
TOLERANCES = st.sampled_from([0.0, 0.25, 0.5, 1.0, 1.25, 2.0, 6.0])


@st.composite
def curves(draw: Any) -> Array:
    d = draw(st.integers(1, 4))
    points = np.array(draw(st.lists(st.tuples(*[COORDINATES] * d), min_size=1, max_size=9)))
    ways: list[Array] = [points, np.cumsum(points, axis=0)]
    forward = points.copy()
    forward[:, 0] = np.arange(len(points))
    return draw(st.sampled_from([*ways, forward]))


def rows_of(curve: Any, tolerance: float, measure: EdgeMeasure = "frechet") -> list[int]:
    points, rows = simplify(curve, tolerance, measure=measure, return_rows=True)
    assert rows.dtype == np.int64
    assert np.array_equal(points, np.asarray(curve, dtype=float).reshape(len(curve), -1)[rows])
    return list(rows)


@given(curves(), TOLERANCES, st.sampled_from(MEASURES))
@settings(derandomize=True, deadline=None, max_examples=300)
def test_the_reference(curve: Array, tolerance: float, measure: EdgeMeasure) -> None:
    assert rows_of(curve, tolerance, measure) == simplified_rows(curve, tolerance, measure)


@given(curves(), TOLERANCES, st.sampled_from(MEASURES), st.integers(-700, 700))
@settings(derandomize=True, deadline=None)
def test_what_it_promises(
    curve: Array, tolerance: float, measure: EdgeMeasure, exponent: int
) -> None:
    rows = rows_of(curve, tolerance, measure)
    assert rows[0] == 0
    assert rows[-1] == len(curve) - 1
    assert len(curve) < 2 or (np.diff(rows) > 0).all()
    if measure == "frechet":
        assert curvewise.frechet_within(curve, curve[rows], tolerance)
        assert len(rows_of(curve[::-1], tolerance)) == len(rows)
        assert len(rows_of(curve, 2 * tolerance)) <= len(rows)
    else:
        assert curvewise.hausdorff_continuous(curve, curve[rows]) <= tolerance * (1 + 1e-15)
    scaled = np.ldexp(curve, exponent)
    assert rows_of(scaled, float(np.ldexp(tolerance, exponent)), measure) == rows


def fewest(curve: Array, tolerance: float) -> list[int]:
    """Return the rows by a decision on every edge, in quadratic time."""
    last = len(curve) - 1
    edges, following = {last: 0}, {}
    for i in range(last - 1, -1, -1):
        ends = [
            j
            for j in range(i + 1, last + 1)
            if curvewise.frechet_within(curve[i : j + 1], curve[[i, j]], tolerance)
        ]
        following[i] = max(ends, key=lambda j: (-edges[j], j))
        edges[i] = edges[following[i]] + 1
    rows = [0]
    while rows[-1] < last:
        rows.append(following[rows[-1]])
    return rows


@pytest.mark.parametrize("d", [1, 2, 3, 5])
@pytest.mark.parametrize("kind", ["walk", "track", "noisy line", "loop"])
def test_every_edge_of_long_curves(d: int, kind: str) -> None:
    """Wedges, cones and witnesses leave out no edge that is within the tolerance."""
    random = np.random.default_rng(d)
    for tolerance in (0.3, 1.0, 4.0):
        steps = random.normal(size=(120, d))
        curve = np.cumsum(steps, axis=0)
        if kind == "track":
            curve = np.cumsum(curve / np.linalg.norm(curve, axis=1, keepdims=True), axis=0)
        elif kind == "noisy line":
            curve = 0.2 * steps + np.linspace(0, 30, 120)[:, np.newaxis]
        elif kind == "loop":
            angle = np.linspace(0, 4 * np.pi, 120)[:, np.newaxis]
            curve = 6 * np.cos(angle + np.arange(d)) + 0.1 * steps
        assert rows_of(curve, tolerance) == fewest(curve, tolerance)


def test_closed_forms() -> None:
    line = np.column_stack([np.arange(50.0), 3 * np.arange(50.0)])
    for measure in MEASURES:
        assert rows_of(line, 0.0, measure) == [0, 49]
        assert rows_of([(1.0, 2.0)], 0.0, measure) == [0]
        assert rows_of([1.0, 1.0], 0.0, measure) == [0, 1]
        assert rows_of([(0, 0), (4, 1), (8, 0)], 1.0, measure) == [0, 2]
        assert rows_of([(0, 0), (4, 1), (8, 0)], np.nextafter(1.0, 0), measure) == [0, 1, 2]
        assert rows_of(line[::-1] ** 2, np.inf, measure) == [0, 49]
    # A polygon on a circle of radius 1: an edge over k sides is 1 - cos(pi k / 60) from the arc.
    angle = np.linspace(0, 2 * np.pi, 61)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    for k in (4, 6, 10):
        tolerance = 1 - np.cos(np.pi * k / 60) + 1e-12
        assert len(rows_of(circle, tolerance)) == 60 // k + 1
    # There and back: half the way back, or only the distance from the edge.
    there_and_back = [0.0, 9.0, 5.0, 10.0]
    assert rows_of(there_and_back, 2.0) == [0, 3]
    assert rows_of(there_and_back, np.nextafter(2.0, 0)) == [0, 1, 2, 3]
    assert rows_of(there_and_back, 0.0, "hausdorff") == [0, 3]


def test_fewest_points_are_fewer() -> None:
    """Douglas and Peucker split at the farthest point, although its neighbour alone would do."""
    track = np.array([(0, 0), (1, 4), (5, 4.1), (9, 4), (10, 0)])
    assert rows_of(track, 0.2) == [0, 1, 3, 4]
    assert rows_of(track, 0.2, "hausdorff") == [0, 1, 2, 3, 4]


def test_names_times_and_columns_remain() -> None:
    times = np.arange(5.0)
    track = NamedCurve(np.array([(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)], dtype=float), ["x", "y"])
    kept, rows = simplify(track, 0.5, return_rows=True)
    assert isinstance(kept, NamedCurve)
    assert kept.column_names == ("x", "y")
    assert times[rows].tolist() == [0, 2, 4]
    assert simplify([0.0, 1.0, 2.0], 0.0).shape == (2, 1)


@pytest.mark.parametrize(
    ("curve", "tolerance", "options", "message"),
    [
        ([(0, 0), (1, np.nan)], 1, {}, r"curve\[1, 1\] is nan; curves must be finite"),
        (np.empty((0, 2)), 1, {}, r"curve has shape \(0, 2\); at least 1 point is needed"),
        ([(0, 0), (1, 1)], -1, {}, "tolerance is -1; give a number >= 0"),
        ([(0, 0), (1, 1)], np.nan, {}, "tolerance is nan; give a number >= 0"),
        ([(0, 0), (1, 1)], "1 m", {}, "tolerance is '1 m'; give a number >= 0"),
        ([(0, 0), (1, 1)], 1, {"measure": "Frechet"}, "unknown measure 'Frechet'; choose from"),
    ],
)
def test_errors(curve: Any, tolerance: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        simplify(curve, tolerance, **options)


def test_longitudes_that_jump() -> None:
    with pytest.warns(UserWarning, match="shift its longitudes by 360 behind the jump"):
        simplify([(179, 0), (-179, 0)], 0.1)
