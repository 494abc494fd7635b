"""spacing="matched": its guarantees for any curves, and the effect of sampling and noise on real
loops.

test_planar.py compares it with the reference, as it does for the other spacings.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]

PROFILE = settings(derandomize=True, deadline=None)
EIGHTHS = st.integers(-512, 512).map(lambda k: k / 8)
POWERS_OF_TWO = st.integers(-40, 40).map(lambda k: 2.0**k)
POINTS = st.lists(st.tuples(EIGHTHS, EIGHTHS) | st.tuples(st.just(1.0), st.just(-2.0)), min_size=2)
CURVES = POINTS.map(np.array)

RAISED = np.array((0.0, 0.05))

# Smooth loops, sampled densely: the points that thinning removes are negligible.
TENSION_COMPRESSION = (
    "dp780_tct_3pct",
    "dp780_tct_6pct",
    "eddq_tct_3pct",
    "eddq_tct_5pct",
    "tr1180_tct_3pct",
)


def matched(P: Any, Q: Any, **options: Any) -> float:
    return curvewise.area(P, Q, spacing="matched", **options)


@given(CURVES, CURVES, st.booleans())
@PROFILE
def test_it_is_never_negative_and_0_for_a_curve_and_itself(
    P: Array, Q: Array, squared: bool
) -> None:
    assert matched(P, Q, squared=squared) >= 0.0
    assert matched(P, P, squared=squared) == 0.0
    assert reference.area(P, P, spacing="matched", squared=squared) == 0.0


@given(CURVES, CURVES, EIGHTHS, POWERS_OF_TWO, POWERS_OF_TWO)
@PROFILE
def test_it_does_not_depend_on_place_and_units(
    P: Array, Q: Array, eighths: float, width: float, height: float
) -> None:
    area = matched(P, Q)
    extent = float(np.prod(np.ptp(np.vstack((P, Q)), axis=0)))
    # Areas of a piece may cancel: its error is that of the areas that do.
    tolerance = {"rel": 1e-12, "abs": 1e-12 * extent}
    away = np.array((eighths, -eighths))
    assert matched(P + away, Q + away) == pytest.approx(area, **tolerance)
    # A direction in which both curves have zero extent does not have units.
    if extent > 0:
        units = (width, height)
        assert matched(P * units, Q * units) == pytest.approx(area * width * height, rel=1e-12)


@given(CURVES, CURVES)
@PROFILE
def test_its_quadrilaterals_add_up(P: Array, Q: Array) -> None:
    quads, areas = curvewise.area_quads(P, Q, spacing="matched")
    assert quads.shape == (len(areas), 4, 2)
    extent = float(np.prod(np.ptp(np.vstack((P, Q)), axis=0)))
    assert areas.sum() == pytest.approx(matched(P, Q), rel=1e-12, abs=1e-12 * extent)
    np.testing.assert_array_equal(quads[0, [0, 3]], [P[0], Q[0]])
    np.testing.assert_array_equal(quads[-1, [1, 2]], [P[-1], Q[-1]])
    # Each begins where the last ended.
    np.testing.assert_array_equal(quads[1:, [0, 3]], quads[:-1, [1, 2]])


def test_crossing_does_not_act() -> None:
    rng = np.random.default_rng(1)
    P, Q = rng.normal(size=(2, 30, 2)).cumsum(axis=1)
    assert matched(P, Q, crossing="split") == matched(P, Q)


def test_areas_of_a_piece_cancel() -> None:
    # A zigzag of 1 % about the line: a hundred triangles to a piece, as many above as below.
    x = np.linspace(0.0, 1.0, 1001)
    zigzag = np.column_stack((x, 0.01 * (-1.0) ** np.arange(1001)))
    zigzag[[0, -1], 1] = 0.0
    line = np.array([(0.0, 0.0), (1.0, 0.0)])
    assert curvewise.area(line, zigzag, spacing="arc_length", crossing="split") > 4e-3
    assert matched(line, zigzag) < 2e-4
    assert matched(line, zigzag + RAISED) == pytest.approx(0.05, rel=1e-2)


def test_where_curves_cross_each_side_counts() -> None:
    assert matched([(0, 1), (1, -1)], [(0, -1), (1, 1)]) == pytest.approx(1.0, rel=1e-12)


def test_a_simulation_that_ends_early_is_not_like_its_test() -> None:
    turns = np.array([(0.0, 0.0), (0.5, 1.0), (1.0, 1.1), (0.5, 0.0), (0.0, -0.1), (0.5, 0.9)])
    at = np.linspace(0, 5, 200)
    test = np.column_stack([np.interp(at, np.arange(6), turns[:, c]) for c in (0, 1)])
    raised = matched(test, test + 1.2 * RAISED)  # by 5 % of its height
    assert matched(test, test[:80]) > 2 * raised
    assert matched(test, test[:2]) > 2 * raised


def test_it_does_not_depend_on_further_vertices_on_the_segments(
    rounds: Callable[[int], int],
) -> None:
    for seed in range(rounds(60)):
        rng = np.random.default_rng([5, seed])
        P, Q = (rng.normal(size=(n, 2)).cumsum(axis=0) for n in rng.integers(2, 40, 2))
        area = matched(P, Q)
        more_p, more_q = inserted(rng, P, seed), inserted(rng, Q, 2 * seed % 31)
        assert matched(more_p, more_q) == pytest.approx(area, rel=1e-11)
        extent = float(np.prod(np.ptp(P, axis=0)))
        assert matched(P, more_p) == pytest.approx(0.0, abs=1e-12 * extent)


def inserted(rng: np.random.Generator, curve: Array, count: int) -> Array:
    """Return a curve with `count` more vertices, on its segments."""
    for at in rng.integers(1, len(curve), count):
        h = rng.uniform()
        curve = np.insert(curve, at, (1 - h) * curve[at - 1] + h * curve[at], axis=0)
    return curve


def test_a_long_protocol_has_more_pieces() -> None:
    t = np.linspace(0.0, 200 * np.pi, 10_001)
    cycles = np.column_stack((np.sin(t), np.sin(t - 0.5)))
    raised = matched(cycles, cycles + 2 * RAISED)
    assert raised == pytest.approx(0.1 * np.abs(np.diff(cycles[:, 0])).sum(), rel=0.02)
    assert matched(cycles, cycles[::2]) < 0.02 * raised


@pytest.fixture(scope="module", params=TENSION_COMPRESSION)
def loop(request: pytest.FixtureRequest, data_dir: Path) -> Array:
    """Return a measured loop, scaled by its box."""
    points = np.loadtxt(data_dir / "loops" / f"{request.param}.csv", delimiter=",")
    return curvewise.normalize(points)[0]


def thinnings(loop: Array) -> dict[str, Array]:
    n = len(loop)
    rng = np.random.default_rng(n)
    lengths = np.concatenate(([0.0], np.hypot(*np.diff(loop, axis=0).T).cumsum()))
    even = np.linspace(0.0, lengths[-1], 1000)
    return {
        "every second point": loop[::2],
        "every tenth point": loop[::10],
        "three points of ten": loop[np.sort(rng.choice(n, 3 * n // 10, replace=False))],
        "dense, then sparse": np.vstack((loop[: n // 2], loop[n // 2 :: 10])),
        "even steps": np.column_stack([np.interp(even, lengths, loop[:, c]) for c in (0, 1)]),
    }


def test_thinning_is_nothing_beside_a_shift(loop: Array) -> None:
    shift = matched(loop, loop + RAISED)
    assert shift == pytest.approx(0.05 * np.abs(np.diff(loop[:, 0])).sum(), rel=0.05)
    for how, thinned in thinnings(loop).items():
        assert matched(loop, thinned) < 0.02 * shift, how
        assert matched(loop, thinned + RAISED) == pytest.approx(shift, rel=0.02), how


def test_noise_does_not_drown_a_shift(loop: Array) -> None:
    shift = matched(loop, loop + RAISED)
    rng = np.random.default_rng(len(loop))
    for deviation in ((0.0, 0.02), (0.01, 0.01)):
        noisy = loop + rng.normal(size=loop.shape) * deviation
        assert matched(loop, noisy + RAISED) == pytest.approx(shift, rel=0.25), deviation
        assert matched(noisy, loop[::10] + RAISED) == pytest.approx(shift, rel=0.25), deviation
        assert matched(loop, noisy) < 0.4 * shift, deviation


def test_a_few_outliers_do_not_drown_a_shift(loop: Array) -> None:
    shift = matched(loop, loop + RAISED)
    rng = np.random.default_rng(len(loop))
    spikes = loop.copy()
    spikes[rng.choice(len(loop), 5, replace=False), 1] += 0.3
    assert matched(loop, spikes + RAISED) == pytest.approx(shift, rel=0.25)


def test_a_curve_that_oscillates_is_matched_within_a_band() -> None:
    n = 700  # sides of its box: 35,000 samples, in a band
    zigzag = np.column_stack([np.linspace(0, 1, n), np.arange(n) % 2])
    moved = zigzag + np.array((0.0, 0.01))
    assert curvewise.area(zigzag, zigzag, spacing="matched") == 0.0
    assert curvewise.area(zigzag, moved, spacing="matched") == pytest.approx(0.01, rel=0.02)
