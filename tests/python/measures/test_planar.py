"""area, pcm, curve_length and the pointwise measures against the reference and their properties.

Kernel and reference agree to 1e-12 relative, on random curves and on the measured loops. Beyond
that: what the measures promise (a piece of a loop is found on it; areas do not depend on where, how
large and in which direction the curves lie).
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]
Options = dict[str, Any]
Pair = tuple[Array, Array]

CROSSINGS = ("rearrange", "split")
AREA_OPTIONS: list[Options] = [
    {"spacing": spacing, "crossing": crossing}
    for spacing, crossing in itertools.product(("distance", "x", "arc_length"), CROSSINGS)
]
PCM_OPTIONS: list[Options] = [{}, {"offsets": 1}, {"offsets": 2}, {"offsets": 37}]
SCALES = ("mean", "mean_abs", "range")
LOOPS = (
    "dp780_tct_3pct",
    "dp780_tct_6pct",
    "eddq_tct_3pct",
    "eddq_tct_5pct",
    "resslab_cyclic_2pct",
    "resslab_random_protocol",
    "tr1180_tct_3pct",
)


def close(found: Any, expected: Any) -> None:
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=0)


def walk(rng: np.random.Generator, n: int) -> Array:
    return np.cumsum(rng.normal(size=(n, 2)), axis=0)


def random_pairs(count: int) -> list[Pair]:
    """Return walks, shapes on a grid with ties and repeated points, and curves of odd scales."""
    pairs = []
    for number in range(count):
        rng = np.random.default_rng([7, number])
        n, m = rng.integers(2, 60, 2)
        P, Q = walk(rng, n), walk(rng, m)
        if number % 3 == 1:
            P, Q = (rng.choice([0.0, 1.0, 2.0, 3.0], (size, 2)) for size in (n, m))
            P[0], Q[0] = (0, 1), (3, 3)  # so that neither curve is a single point
            P[-1], Q[-1] = (2, 2), (1, 0)
        elif number % 3 == 2:
            scale = rng.choice(10.0 ** np.arange(-12, 13), 2)
            P, Q = P * scale + 3 * scale, Q * scale + 3 * scale
        pairs.append((P, Q))
    return pairs


PAIRS = random_pairs(300)


def read_curve(file: Path) -> Array:
    with file.open() as lines:
        header = int(not next(lines)[0].lstrip("-").isdigit())
    return np.asarray(np.loadtxt(file, delimiter=",", skiprows=header))


@pytest.fixture(scope="session")
def loops(data_dir: Path) -> dict[str, Array]:
    return {name: read_curve(data_dir / "loops" / f"{name}.csv") for name in LOOPS}


@pytest.fixture(scope="session")
def loop_pairs(loops: dict[str, Array]) -> list[Pair]:
    """Return measured pairs, thinned unevenly to a few hundred points."""
    names = [("dp780_tct_3pct", "dp780_tct_6pct"), ("eddq_tct_5pct", "eddq_tct_3pct")]
    names += [("resslab_cyclic_2pct", "resslab_random_protocol")]
    names += [("tr1180_tct_3pct", "dp780_tct_3pct")]
    thin = {name: loop[:: len(loop) // 250] for name, loop in loops.items()}
    return [(thin[a], thin[b][: -len(thin[b]) // 5]) for a, b in names]


@pytest.fixture(scope="session", params=["random", "measured"])
def all_pairs(request: pytest.FixtureRequest, rounds: Callable[[int], int]) -> list[Pair]:
    if request.param == "random":  # does not need the data
        return PAIRS[: rounds(len(PAIRS))]
    measured: list[Pair] = request.getfixturevalue("loop_pairs")
    return measured


@pytest.mark.nightly
def test_matched_area_equals_the_reference(all_pairs: list[Pair]) -> None:
    compare_areas(all_pairs[:30], {"spacing": "matched"})  # the reference fills a table for each


@pytest.mark.parametrize("options", AREA_OPTIONS, ids=lambda options: "-".join(options.values()))
def test_area_equals_the_reference(all_pairs: list[Pair], options: Options) -> None:
    compare_areas(all_pairs, options)


def compare_areas(pairs: list[Pair], options: Options) -> None:
    for P, Q in pairs:
        close(curvewise.area(P, Q, **options), reference.area(P, Q, **options))
        squared = curvewise.area(P, Q, **options, squared=True)
        close(squared, reference.area(P, Q, **options, squared=True))
        found = curvewise.area_quads(P, Q, **options)
        expected = reference.area_quads(P, Q, **options)
        largest = np.abs(np.vstack((P, Q))).max(axis=0)
        assert found.quads.shape == expected.quads.shape
        np.testing.assert_array_less(np.abs(found.quads - expected.quads) / largest, 1e-12)
        np.testing.assert_allclose(
            found.areas, expected.areas, rtol=1e-12, atol=1e-14 * np.prod(largest)
        )


@pytest.mark.parametrize("options", PCM_OPTIONS, ids=str)
def test_pcm_equals_the_reference(all_pairs: list[Pair], options: Options) -> None:
    for P, Q in all_pairs:
        close(curvewise.pcm(P, Q, **options), reference.pcm(P, Q, **options))


def test_pcm_match_equals_the_reference(all_pairs: list[Pair]) -> None:
    for P, Q in all_pairs:
        found, expected = curvewise.pcm_match(P, Q), reference.pcm_match(P, Q)
        assert found.value == curvewise.pcm(P, Q)
        assert found.mapped == expected.mapped
        close(found.value, expected.value)
        close(found.offset, expected.offset)
        close(found.coverage, expected.coverage)
        assert found.tolerance == pytest.approx(expected.tolerance, rel=1e-9, abs=1e-13)
        largest = np.abs(np.vstack((P, Q))).max(axis=0)
        np.testing.assert_array_less(np.abs(found.points - expected.points) / largest, 1e-10)


def test_continuous_pcm_equals_the_reference(rounds: Callable[[int], int]) -> None:
    for P, Q in PAIRS[: rounds(24)]:
        found = curvewise.pcm_match(P, Q, offsets="continuous")
        expected = reference.pcm_match(P, Q, offsets="continuous")
        assert found.value == curvewise.pcm(P, Q, offsets="continuous")
        shorter = min(length_in_box(P, P), length_in_box(Q, P))
        assert found.value == pytest.approx(expected.value, rel=1e-12, abs=2e-12 * shorter)
        assert found.tolerance == pytest.approx(expected.tolerance, rel=1e-9, abs=1e-27)
        # A grid is at most as far from the minimum as it reports.
        for offsets in (1, 7, 200):
            match = curvewise.pcm_match(P, Q, offsets=offsets)
            assert expected.value <= match.value + 2e-12 * shorter
            assert match.value <= expected.value + match.tolerance + 2e-12 * shorter


@pytest.mark.parametrize("scale", SCALES)
def test_curve_length_equals_the_reference(all_pairs: list[Pair], scale: Any) -> None:
    for P, Q in all_pairs:
        found = curvewise.curve_length(P, Q, scale=scale)
        close(found, reference.curve_length(P, Q, scale=scale))
        residuals = curvewise.curve_length_residuals(P, Q, scale=scale)
        assert residuals.shape == (len(P), 2)
        expected = reference.curve_length_residuals(P, Q, scale=scale)
        np.testing.assert_allclose(residuals, expected, rtol=1e-12, atol=1e-13)
        close(np.linalg.norm(residuals), found)


@pytest.mark.parametrize("name", ["sum_of_squares", "mse", "mae"])
def test_pointwise_measures_equal_the_reference(all_pairs: list[Pair], name: str) -> None:
    measure, expected = getattr(curvewise, name), getattr(reference, name)
    for P, Q in all_pairs:
        k = min(len(P), len(Q))
        for a, b in ((P[:k], Q[:k]), (P[:k, 0], Q[:k, 1]), (P[:k].reshape(1, -1),) * 2):
            close(measure(a, b), expected(a, b))
            assert measure(a, b) == measure(b, a)
    delta = PAIRS[0][0][:5] - 1.0
    close(curvewise.mse(delta + 1, np.ones((5, 2))), np.mean(delta**2))
    close(curvewise.mae(delta + 1, np.ones((5, 2))), np.mean(np.abs(delta)))


def test_normalize_equals_the_reference(all_pairs: list[Pair]) -> None:
    for P, Q in all_pairs:
        flat = [(P[:, 0], Q[:, 1], P[:3, 1])]
        level = [(P * (1, 0) + (0, 5), Q)]  # no extent in y: subtracted, not divided
        for curves in [(P,), (P, Q), (P, Q, P[:2], Q[1:]), *flat, *level]:
            found, expected = curvewise.normalize(*curves), reference.normalize(*curves)
            assert [a.shape for a in found] == [np.shape(curve) for curve in curves]
            for a, b in zip(found, expected, strict=True):
                np.testing.assert_allclose(a, b, rtol=1e-12, atol=1e-15)
            assert found[0].min() == 0.0
            assert found[0].max() == 1.0


def length_in_box(curve: Array, P: Array) -> float:
    """Return the length of a curve after scaling by P's box."""
    extent = np.ptp(P, axis=0)
    steps = np.diff(curve, axis=0) / np.where(extent > 0, extent, 1.0)
    return float(np.sqrt((steps**2).sum(axis=1)).sum())


def synthetic_loops() -> dict[str, Array]:
    angle = np.linspace(0, 2 * np.pi, 181)
    ellipse = np.column_stack((0.02 * np.cos(angle), 500 * np.sin(angle)))
    repeated = np.repeat(ellipse, np.arange(181) % 4 + 1, axis=0)
    return {
        "ellipse": ellipse,
        "repeated": repeated,
        "zigzag": np.column_stack((np.abs(np.arange(90) % 20 - 10.0), np.arange(90) ** 1.5)),
        "walk": walk(np.random.default_rng(3), 150),
        "grid": np.random.default_rng(4).integers(0, 5, (120, 2)) + 0.0,
    }


def runs(rng: np.random.Generator, loop: Array, count: int) -> list[Array]:
    """Return runs of consecutive vertices, short and long, all longer than zero."""
    found: list[Array] = []
    while len(found) < count:
        first, last = np.sort(rng.choice(len(loop), 2, replace=False))
        run = loop[first : last + 1] if len(found) % 3 else loop[first : first + 5]
        if np.ptp(run, axis=0).any():
            found.append(run)
    return found


def check_pieces(loop: Array, count: int) -> None:
    """Check that runs of a loop's own vertices are found to within the error of the offsets."""
    for run in runs(np.random.default_rng(11), loop, count):
        S, T = length_in_box(run, loop), length_in_box(loop, loop)
        grid = curvewise.pcm(loop, run)
        exact = curvewise.pcm(loop, run, offsets="continuous")
        assert grid <= S * (T - S) / 398 + 1e-12
        assert exact < 1e-9
        assert exact <= grid
        S, T = length_in_box(run, run), length_in_box(loop, run)
        assert curvewise.pcm(run, loop) <= S * (T - S) / 398 + 1e-12
        assert curvewise.pcm(run, loop, offsets="continuous") < 1e-9 * max(1.0, T)


@pytest.mark.parametrize("name", list(synthetic_loops()))
def test_a_piece_of_a_synthetic_loop_maps_onto_it(name: str, rounds: Callable[[int], int]) -> None:
    check_pieces(synthetic_loops()[name], count=rounds(60))


@pytest.mark.parametrize("name", LOOPS)
def test_a_piece_of_a_measured_loop_maps_onto_it(
    loops: dict[str, Array], name: str, rounds: Callable[[int], int]
) -> None:
    check_pieces(loops[name], count=rounds(4))
    check_pieces(loops[name][:: 1 + len(loops[name]) // 1200], count=rounds(30))


def test_continuous_pcm_is_never_above_the_grid(all_pairs: list[Pair]) -> None:
    for P, Q in all_pairs:
        exact = curvewise.pcm(P, Q, offsets="continuous")
        assert exact <= curvewise.pcm(P, Q)
        S = min(length_in_box(P, P), length_in_box(Q, P))
        assert exact <= curvewise.pcm(P, Q, offsets=1999) + 1e-12 * S


def test_more_offsets_than_fit_into_memory_are_searched() -> None:
    P, Q = walk(np.random.default_rng(1), 30), walk(np.random.default_rng(2), 20)
    exact = curvewise.pcm(P, Q, offsets="continuous")
    close(curvewise.pcm(P, Q, offsets=10**12), exact)


def test_a_vertical_curve_is_not_scaled_in_x() -> None:
    P, Q = (np.array([(x, 0.0), (x, 10.0)]) for x in (2.0, 2.25))
    assert curvewise.pcm(P, Q) == pytest.approx(0.25, rel=1e-12)


def evenly_spaced(curve: Array, n: int) -> Array:
    """Return n points at equal arc length along a polyline."""
    s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))))
    at = np.linspace(0.0, s[-1], n)
    return np.column_stack([np.interp(at, s, coordinate) for coordinate in curve.T])


def evenly_spaced_pairs() -> dict[str, Pair]:
    angle = np.linspace(0.0, 2 * np.pi, 101)
    circle = np.column_stack((np.cos(angle), np.sin(angle)))
    few = np.linspace(0.0, 2 * np.pi, 64)
    ring = 1.7 * np.column_stack((np.cos(few), np.sin(few)))
    line = np.linspace((0.0, 0.0), (1.0, 2.0), 50)
    # Off the circle's axes: on them a quadrilateral is simple or complex by rounding alone.
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]) + 0.07
    loop = np.array([(0, 0), (1, 3), (3, 4), (0.5, -2), (-1, -2.5), (1, 3.2)]) * 1.0
    return {
        "circles": (circle, ring),
        "circle_and_square": (circle, evenly_spaced(square, 37)),
        "lines": (line, np.linspace((0.3, 0.1), (1.4, 2.5), 33)),
        "lines_of_opposite_sense": (line, np.linspace((1.4, 2.5), (0.3, 0.1), 7)),
        "loops": (evenly_spaced(loop, 203), evenly_spaced(1.1 * loop + (0.1, -0.2), 90)),
    }


def rotation(degrees: float) -> Array:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([(c, s), (-s, c)])


@pytest.mark.parametrize("crossing", ["rearrange", "split"])
@pytest.mark.parametrize("name", list(evenly_spaced_pairs()))
def test_area_does_not_depend_on_place_size_or_direction(name: str, crossing: Any) -> None:
    P, Q = evenly_spaced_pairs()[name]
    area = curvewise.area(P, Q, crossing=crossing)
    for shift in ((0.1, -0.3), (7.0, 1.0 / 3.0), (-2.7, 5.1)):
        close(curvewise.area(P + shift, Q + shift, crossing=crossing), area)
    for factor in (3.0, 0.07, 1e-9, 12345.678, 1e120):
        scaled = curvewise.area(P * factor, Q * factor, crossing=crossing)
        close(scaled / factor / factor, area)
    for degrees in (10.0, 33.3, 45.0, 90.0, 137.0, 211.5, 299.9):
        turn = rotation(degrees)
        close(curvewise.area(P @ turn, Q @ turn, crossing=crossing), area)
        close(curvewise.area(P @ turn + (0.7, 1.9), Q @ turn + (0.7, 1.9), crossing=crossing), area)


# A vertex of Q lies on the line through an edge of P: rounding makes quadrilaterals complex.
JUMPED = [
    ([(0, 0), (2, 3)], [(2, 1), (2, 3), (2, 0), (1, 0)]),
    ([(1, 0), (2, 1)], [(5, 2), (5, 4), (3, 3), (0, 2)]),
    ([(2, 2), (0, 0), (5, 3)], [(1, 2), (5, 3), (5, 5), (2, 5), (3, 5)]),
    ([(0, 2), (3, 4), (3, 0), (1, 0), (3, 2)], [(2, 2), (3, 0), (0, 2), (1, 1)]),
]


@pytest.mark.parametrize("module", [curvewise, reference])
@pytest.mark.parametrize(("P", "Q"), JUMPED)
def test_split_areas_do_not_jump(module: Any, P: Any, Q: Any) -> None:
    options: Any = {"spacing": "arc_length", "crossing": "split"}
    area = module.area(P, Q, **options)
    rng = np.random.default_rng(0)
    for _ in range(20):
        p, q = (np.array(C, float) + rng.uniform(-1e-13, 1e-13, np.shape(C)) for C in (P, Q))
        assert module.area(p, q, **options) == pytest.approx(area, rel=1e-11)
    # Vertices stay in the order in which they face each other.
    quads = module.area_quads(P, Q, **options).quads
    assert np.array_equal(quads[1:, [0, 3]], quads[:-1, [1, 2]])


def test_split_areas_jump_where_the_definition_does() -> None:
    # Another segment is the longest; P's box has a height.
    P = [(0, 0), (1, 0), (2, 2), (3, 3)]
    areas = [curvewise.area(P, [(0, 1), (x, 2), (2, 1)], crossing="split") for x in (1 - 1e-9, 1)]
    assert areas == pytest.approx([3.0, 3.5], rel=1e-8)
    Q = [(2, 2), (4, 2), (2, 3)]
    options: Any = {"spacing": "arc_length", "crossing": "split"}
    areas = [curvewise.area([(0, 0), (2, y)], Q, **options) for y in (0, 1e-9)]
    assert areas == pytest.approx([5.5224077, 5.0], rel=1e-8)


def inserted(rng: np.random.Generator, curve: Array, count: int) -> Array:
    """Return a curve with `count` more vertices, on its segments."""
    for at in rng.integers(1, len(curve), count):
        h = rng.uniform()
        curve = np.insert(curve, at, (1 - h) * curve[at - 1] + h * curve[at], axis=0)
    return curve


def test_area_by_arc_length_does_not_depend_on_the_sampling() -> None:
    x = np.linspace(0.0, 4.0, 30)
    P, Q = np.column_stack((x, np.sin(x))), np.column_stack((x[::3], np.sin(x[::3]) + 1.3))
    area = curvewise.area(P, Q, spacing="arc_length")
    for seed in range(40):
        rng = np.random.default_rng(seed)
        more_p, more_q = inserted(rng, P, seed), inserted(rng, Q, 2 * seed % 31)
        close(curvewise.area(more_p, more_q, spacing="arc_length"), area)
