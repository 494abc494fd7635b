"""Areas of closed curves: all beginnings of Q, and with crossing="polygon" against fractions."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.plotting import plot_area

Array = npt.NDArray[np.float64]
POLYGON: dict[str, Any] = {"closed": True, "crossing": "polygon"}
OF_QUADS: list[dict[str, Any]] = [
    {"closed": True},
    {"closed": True, "crossing": "split", "squared": True},
    {"closed": True, "spacing": "x", "crossing": "split"},
    {"closed": True, "spacing": "arc_length"},
    {"closed": True, "spacing": "matched"},
    {"closed": True, "spacing": "matched", "squared": True},
]


def exact(P: Array, Q: Array) -> Fraction:
    """Return the area inside one polygon by the nonzero rule, slab by slab between all x."""
    edges = [
        (*min(a, b), *max(a, b), polygon, 1 if a < b else -1)
        for polygon, curve in enumerate((P, Q))
        for points in [[tuple(map(Fraction, point)) for point in np.asarray(curve).tolist()]]
        for a, b in zip(points, points[1:] + points[:1], strict=True)
        if a[0] != b[0]
    ]
    lines = [(x0, x1, y0, (y1 - y0) / (x1 - x0), *which) for x0, y0, x1, y1, *which in edges]
    xs = {x for line in lines for x in line[:2]}
    for (a0, a1, ay, slope, *_), (b0, b1, by, other, *_) in combinations(lines, 2):
        if slope != other:
            x = (by - other * b0 - ay + slope * a0) / (slope - other)
            if max(a0, b0) < x < min(a1, b1):
                xs.add(x)
    total = Fraction(0)
    for low, high in pairwise(sorted(xs)):
        x = (low + high) / 2
        levels = sorted((y + s * (x - x0), p, w) for x0, x1, y, s, p, w in lines if x0 < x < x1)
        windings = [0, 0]
        for (y, polygon, winding), (above, *_) in pairwise(levels):
            windings[polygon] += winding
            if (windings[0] != 0) != (windings[1] != 0):
                total += (high - low) * (above - y)
    return total


COORDINATES = st.integers(-12, 12).map(lambda k: k / 4)
CURVES = st.lists(st.tuples(COORDINATES, COORDINATES), min_size=2, max_size=8).map(np.array)


@given(CURVES, CURVES, st.integers(0, 7))
@settings(derandomize=True, deadline=None)
def test_what_polygons_promise(P: Array, Q: Array, k: int) -> None:
    value = curvewise.area(P, Q, **POLYGON)
    close = pytest.approx(value, rel=1e-13, abs=1e-13)
    assert float(exact(P, Q)) == close
    assert reference.area(P, Q, **POLYGON) == close
    assert curvewise.area(Q, P, **POLYGON) == close
    assert curvewise.area(np.roll(P, k, axis=0)[::-1], Q, **POLYGON) == close
    assert curvewise.area(np.vstack([P, P[:1]]), Q, **POLYGON) == close
    assert curvewise.area(P[:, ::-1], Q[:, ::-1], **POLYGON) == close
    assert curvewise.area(np.vstack([P, P, P]), Q, **POLYGON) == close  # three times around
    assert curvewise.area(P * (2, 4), Q * (2, 4), **POLYGON) == pytest.approx(
        8 * value, rel=1e-13, abs=1e-12
    )
    assert curvewise.area(P, np.roll(P, k, axis=0), **POLYGON) == 0.0
    quads, areas = curvewise.area_quads(P, Q, **POLYGON)
    assert areas.sum() == close
    corners = np.moveaxis(quads, 1, 0)
    by_corners = np.ptp(corners[:2, :, 0], axis=0) * (corners[2:] - corners[1::-1])[:, :, 1].sum(0)
    np.testing.assert_allclose(by_corners / 2, areas, atol=1e-13)


@pytest.mark.parametrize("n", [3, 10, 20])
def test_random_polygons_that_cross_themselves(n: int) -> None:
    rng = np.random.default_rng(n)
    for _ in range(5):
        P, Q = rng.normal(size=(n, 2)), rng.normal(size=(n + 2, 2))
        value = curvewise.area(P, Q, **POLYGON)
        assert value == pytest.approx(float(exact(P, Q)), rel=1e-12)
        far = [np.add(curve, (2.0**30, -(2.0**33))) for curve in (P, Q)]
        moved = float(exact(*far))
        for package in (curvewise, reference):
            assert package.area(*far, **POLYGON) == pytest.approx(moved, rel=1e-12)


def test_closed_forms() -> None:
    square, bow = [(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 0), (2, 2), (2, 0), (0, 2)]
    assert curvewise.area(square, bow, **POLYGON) == 2.0
    assert curvewise.area(square, np.add(square, 5), **POLYGON) == 8.0
    assert curvewise.area(square, [(1, 1), (3, 3)], **POLYGON) == 4.0
    # Two turns of a pentagram: its centre is inside.
    star = [(np.cos(t), np.sin(t)) for t in np.arange(5) * 0.8 * np.pi]
    centre = [(0.1, 0), (0, 0.1), (-0.1, 0), (0, -0.1)]
    outside = curvewise.area(star, [(5, 5), (6, 5), (5, 6)], **POLYGON)
    assert curvewise.area(star, centre, **POLYGON) == pytest.approx(outside - 0.5 - 0.02)
    turns = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns)])
    assert curvewise.area(circle, 2 * circle, **POLYGON) == pytest.approx(3 * np.pi, rel=1e-5)


@pytest.mark.parametrize("exponent", [-1000, -520, 500])
def test_the_ends_of_the_range(exponent: int) -> None:
    rng = np.random.default_rng(1)
    P, Q = rng.normal(size=(9, 2)), rng.normal(size=(7, 2))
    for package in (curvewise, reference):
        for options in (POLYGON, {"closed": True}):
            with np.errstate(under="ignore"):
                expected = np.ldexp(package.area(P, Q, **options), 2 * exponent)
                value = package.area(np.ldexp(P, exponent), np.ldexp(Q, exponent), **options)
            assert value == pytest.approx(expected, rel=1e-13)


def from_every_point(P: Array, Q: Array, closed: bool, **options: Any) -> float:
    """Return the least area of open curves that end where they begin."""
    assert closed
    P, Q = (C[:-1] if np.array_equal(C[0], C[-1]) else C for C in (P, Q))
    P = np.vstack([P, P[:1]])
    starts = (np.roll(Q, -k, axis=0) for k in range(len(Q)))
    return min(curvewise.area(P, np.vstack([R, R[:1]]), **options) for R in starts)


@pytest.mark.parametrize("options", OF_QUADS, ids=str)
def test_the_least_area_over_the_beginnings_of_q(options: dict[str, Any]) -> None:
    rng = np.random.default_rng(len(str(options)))
    sizes = [(2, 2), (2, 5), (6, 3), (9, 9), (17, 12), (12, 30)]
    sizes = sizes[:4] if options.get("spacing") == "matched" else sizes * 2
    for number, (n, m) in enumerate(sizes):
        P, Q = rng.normal(size=(n, 2)), rng.normal(size=(m, 2))
        if number % 2:
            P, Q = np.rint(2 * P) + [[0, 0.5]] * n, np.rint(2 * Q)  # ties
            P = np.vstack([P, P[:1]])
        value = curvewise.area(P, Q, **options)
        assert value == from_every_point(P, Q, **options)
        assert reference.area(P, Q, **options) == pytest.approx(value, rel=1e-12, abs=1e-300)
        if "squared" not in options:
            quads, areas = curvewise.area_quads(P, Q, **options)
            if options.get("spacing") != "matched":
                assert areas.sum() == pytest.approx(value, rel=1e-13)
            of_reference = reference.area_quads(P, Q, **options)
            assert of_reference.areas.sum() == pytest.approx(areas.sum(), rel=1e-12)
            assert quads.shape == of_reference.quads.shape


def test_a_loop_cut_at_other_points() -> None:
    turns = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    loop = np.column_stack([np.cos(turns), np.sin(turns) + 0.2 * np.sin(2 * turns)])
    for crossing in ("rearrange", "split", "polygon"):
        options: Any = {"closed": True, "crossing": crossing}
        assert curvewise.area(loop, np.roll(loop, 17, axis=0), **options) == 0.0
    assert curvewise.area(loop, np.roll(loop, 17, axis=0)) > 1.0


@pytest.mark.parametrize("options", [POLYGON, *OF_QUADS[:2]], ids=str)
def test_batches(options: dict[str, Any]) -> None:
    rng = np.random.default_rng(3)
    curves = [rng.normal(size=(n, 2)) for n in range(3, 13)]
    matrix = curvewise.cdist(curves, curves, "area", workers=2, **options)
    np.fill_diagonal(
        expected := np.array([[curvewise.area(P, Q, **options) for Q in curves] for P in curves]),
        0.0,
    )
    assert matrix.tolist() == expected.tolist()
    assert curvewise.Prepared(curves[0], "area", **options)(curves[1]) == expected[0, 1]
    nearest = curvewise.Index(curves, "area", **options).kneighbors(curves[:2], 3)
    np.testing.assert_array_equal(nearest[0], np.sort(expected[:2])[:, :3])
    if options is POLYGON:
        condensed = curvewise.pdist(curves, "area", **options)
        assert condensed.tolist() == expected[np.triu_indices(len(curves), 1)].tolist()
    else:
        with pytest.raises(ValueError, match="pdist needs a symmetric measure, and 'area', closed"):
            curvewise.pdist(curves, "area", **options)


def test_compare_and_plot() -> None:
    figure = pytest.importorskip("matplotlib.figure")
    square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    for crossing, value in (("polygon", 4.0), ("split", 4.0)):
        options = {"area": {"closed": True, "crossing": crossing}}
        compared = curvewise.compare(
            square,
            np.roll(np.add(square, (0, 1)), 2, axis=0),
            preset="raw",
            measures=["area"],
            options=options,
        )
        assert compared["area"] == value
        assert compared.deviations["area"].mean == pytest.approx(value / 4)
        assert compared.plot()
        axes = figure.Figure().subplots()
        drawn = plot_area(square, np.add(square, (0, 1)), axes, **options["area"]).between
        assert len(drawn.get_paths()) == len(
            curvewise.area_quads(square, np.add(square, (0, 1)), **options["area"]).quads
        )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"crossing": "polygon"}, r"^crossing='polygon' is for closed curves; add closed=True$"),
        (POLYGON | {"squared": True}, r"^crossing='polygon' has no squared; leave out squared="),
        (
            {"closed": True, "spacing": "function"},
            r"^closed=True has no spacing='function'; choose",
        ),
    ],
)
def test_what_is_refused(options: dict[str, Any], message: str) -> None:
    for package in (curvewise, reference):
        with pytest.raises(ValueError, match=message):
            package.area(np.eye(2), np.eye(2), **options)
    with pytest.raises(ValueError, match=message):
        curvewise.cdist([np.eye(2)], [np.eye(2)], "area", **options)
    with pytest.raises(ValueError, match="has no gradient with closed=True"):
        curvewise.value_and_gradient(np.eye(2), np.eye(2), "area", closed=True)
