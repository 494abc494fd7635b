"""The rectangular tube, against distances at densely sampled points and closed forms."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise
from curvewise import tube
from curvewise.comparing.tube import _distances


def sampled(points: np.ndarray, curve: np.ndarray, steps: int) -> np.ndarray:
    """Return Chebyshev distances of points to points of the segments, one after the other."""
    share = np.linspace(0.0, 1.0, steps + 1)[:, np.newaxis]
    parts = [a + share * (b - a) for a, b in pairwise(curve)] or [curve]
    on_curve = np.concatenate(parts)
    return np.array([np.abs(on_curve - point).max(axis=1).min() for point in points])


@given(
    seed=st.integers(0, 2**32 - 1),
    n=st.sampled_from([1, 2, 3, 63, 64, 65, 130]),
    m=st.sampled_from([1, 2, 64, 65, 66, 129, 200]),
    kind=st.sampled_from(["noise", "walk", "grid"]),
)
def test_distances_are_those_to_the_segments(seed, n, m, kind):
    random = np.random.default_rng(seed)
    curves = [random.normal(size=(count, 2)) for count in (n, m)]
    if kind == "walk":
        curves = [np.cumsum(curve, axis=0) for curve in curves]
    if kind == "grid":  # segments without extent, horizontal, vertical and diagonal ones
        curves = [np.rint(curve) for curve in curves]
    points, curve = curves
    found = _distances(points, curve)
    longest = np.abs(np.diff(curve, axis=0)).max(initial=0.0)
    expected = sampled(points, curve, 200)
    assert (found <= expected + 1e-12).all()
    assert (found >= expected - longest / 400.0 - 1e-12).all()


def test_a_function_of_time_is_in_the_tube_as_csv_compare_has_it():
    t = np.linspace(0.0, 1.0, 101)
    P = np.column_stack((t, 3.0 * t))
    # About a rising line the upper border is that of the rectangles' upper left corners.
    for dx, dy, shift in ((0.1, 0.2, 0.5), (0.05, 0.1, 0.25)):
        assert 3.0 * dx + dy == pytest.approx(shift)
        inner = np.column_stack((t, 3.0 * t + 0.999 * shift))[20:80]
        outer = np.column_stack((t, 3.0 * t + 1.001 * shift))[20:80]
        assert len(tube(P, inner, dx, dy).outside) == 0
        assert len(tube(P, outer, dx, dy).outside) == 60


def test_the_tolerance_itself_is_inside_in_spite_of_rounding():
    x = np.arange(10) / 10.0
    P = np.column_stack((x, x * 0.7))
    for dy in (0.1, 0.2, 0.3, 1e-3):
        at_border = P + np.array([0.0, dy])
        flat = np.column_stack((x, np.full(10, 1.1)))
        assert tube(flat, flat + np.array([0.0, dy]), 0.01, dy)
        assert tube(flat, flat - np.array([0.0, dy]), 0.01, dy)
        assert not tube(flat, flat + np.array([0.0, 1.000001 * dy]), 0.01, dy)
        assert tube(P, at_border, 0.01, dy)


def test_what_is_outside_is_listed_for_both_curves():
    P = [(0.0, 0.0), (1.0, 0.0), (2.0, 5.0), (3.0, 0.0), (4.0, 0.0)]
    Q = [(0.0, 0.0), (0.5, 0.3), (1.0, 0.0), (3.0, 0.0), (4.0, 0.0)]
    found = tube(P, Q, 0.1, 0.1)
    assert not found
    assert found.outside.tolist() == [1]
    assert found.missed.tolist() == [2]  # the peak, over which an edge of Q passes
    assert found.largest == pytest.approx(47.0)  # from (0.5, 0.3)
    assert found.place == (2.0, 5.0)
    assert found.first == (0.5, 0.3)
    assert str(found) == (
        "points outside the tube of ±0.1, ±0.1: 1 of Q, 1 of P; first at (0.5, 0.3), largest "
        "deviation 47 of the tolerance at (2, 5)"
    )
    only_p = tube(P, [(0, 0), (4, 0)], 0.1, 0.1)
    assert only_p.first == only_p.place == (2.0, 5.0)
    within = tube(P, Q, 1.0, 6.0)
    assert within
    assert str(within).startswith("within the tube of ±1, ±6; largest deviation 0.8")
    assert within.first == ()
    assert json.loads(json.dumps(found.to_dict()))["outside"] == [1]


def test_a_curve_that_ends_early_is_missed():
    t = np.linspace(0.0, 1.0, 11)
    P = np.column_stack((t, t))
    found = tube(P, P[:8], 0.05, 0.05)
    assert len(found.outside) == 0
    assert found.missed.tolist() == [8, 9, 10]
    assert tube(P, P[::-1], 1e-9, 1e-9).largest == 0.0  # the order does not count


def test_units_and_place_do_not_matter():
    P, Q = curvewise.datasets.hysteresis_pair()
    expected = tube(P, Q, 0.001, 50.0)
    scale, shift = np.array([100.0, 1e6]), np.array([3.0, -1e9])
    found = tube(P * scale + shift, Q * scale + shift, 0.1, 50e6)
    assert found.outside.tolist() == expected.outside.tolist()
    assert found.missed.tolist() == expected.missed.tolist()
    assert found.largest == pytest.approx(expected.largest, rel=1e-9)


def test_wrong_arguments():
    P = [(0.0, 0.0), (1.0, 1.0)]
    for dx in (0, -1.0, np.inf, np.nan, "1"):
        with pytest.raises(ValueError, match=r"dx is .*; a tolerance must be above 0"):
            tube(P, P, dx, 1.0)
    with pytest.raises(ValueError, match=r"dy is 0; a tolerance must be above 0"):
        tube(P, P, 1.0, 0)
    with pytest.raises(ValueError, match=r"P has shape \(2, 3\); a tube needs x and y"):
        tube(np.ones((2, 3)), np.ones((2, 3)), 1.0, 1.0)
    with pytest.raises(ValueError, match=r"P has shape \(2,\); a tube needs x and y"):
        tube([1.0, 2.0], [1.0, 2.0], 1.0, 1.0)
    for far in (1e300, 1e15):
        with pytest.raises(ValueError, match=r"a coordinate is .* tolerances; pass larger dx and"):
            tube(P, [(0.0, far), (1.0, -far)], 1.0, 1.0)
    with pytest.raises(ValueError, match=r"a coordinate is inf tolerances; pass larger dx and dy"):
        tube(P, P, 1e-320, 1.0)
    with pytest.raises(ValueError, match=r"Q\[1, 0\] is nan"):
        tube(P, [(0.0, 0.0), (np.nan, 1.0)], 1.0, 1.0)
    with pytest.raises(ValueError, match=r"P has shape \(0, 2\)"):
        tube(np.empty((0, 2)), P, 1.0, 1.0)
    with pytest.raises(ValueError, match=r"Q has shape \(0, 2\)"):
        tube(P, np.empty((0, 2)), 1.0, 1.0)
