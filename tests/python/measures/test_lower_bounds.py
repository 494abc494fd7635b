"""LB_Keogh, LB_Improved and LB_Kim against their definitions, and against dtw to the last bit."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise._options import BoundMetric

METRICS = list(get_args(BoundMetric))
OF_SUMS = ("sqeuclidean", "cityblock")


def pair(n: int, m: int, d: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return walks, points of a lattice, or curves that differ in last bits."""
    random = np.random.default_rng(seed)
    P, Q = random.normal(size=(n, d)).cumsum(axis=0), random.normal(size=(m, d)).cumsum(axis=0)
    kind = seed % 4
    if kind == 1:
        P, Q = np.round(P), np.round(Q)
    elif kind == 2:
        Q = P[random.integers(0, n, m)] * (1 + 2.0**-52 * random.integers(-2, 3, (m, d)))
    elif kind == 3:
        P, Q = 1e9 + P, 1e9 + Q
    return P, Q


def bounds(P, Q, metric, window) -> list[tuple[str, dict]]:
    named = {"metric": metric}
    listed = [("lb_keogh", {**named, "window": window}), ("lb_kim", named)]
    if np.ndim(P) == 1 or P.shape[1] == 1 or metric in OF_SUMS:
        listed.append(("lb_improved", {**named, "window": window}))
    return listed


@settings(deadline=None, max_examples=200)
@given(
    st.integers(1, 25),
    st.integers(1, 25),
    st.sampled_from([1, 2, 3]),
    st.sampled_from(METRICS),
    st.sampled_from([None, 1, 2, 5, 40, 0.1, 0.3]),
    st.integers(0, 2**32),
)
def test_they_are_their_definitions_and_below_dtw(n, m, d, metric, window, seed):
    P, Q = pair(n, m, d, seed)
    if isinstance(window, float):
        window = window if int(window * max(n, m)) > 0 else None
    value = curvewise.dtw(P, Q, metric=metric, window=window)
    for name, options in bounds(P, Q, metric, window):
        bound = getattr(curvewise, name)(P, Q, **options)
        expected = getattr(reference, name)(P, Q, **options)
        assert 0.0 <= bound <= value
        if name == "lb_improved":
            assert bound == pytest.approx(expected, rel=1e-13)
            keogh = curvewise.lb_keogh(P, Q, **options)
            assert bound >= keogh * (1 - 1e-13)
        else:
            assert bound == expected
        scaled = getattr(curvewise, name)(np.ldexp(P, 501), np.ldexp(Q, 501), **options)
        power = 1002 if metric == "sqeuclidean" else 501
        assert scaled == np.ldexp(bound, power)
        tiny = getattr(curvewise, name)(np.ldexp(P, -900), np.ldexp(Q, -900), **options)
        assert tiny <= curvewise.dtw(
            np.ldexp(P, -900), np.ldexp(Q, -900), metric=metric, window=window
        )


def test_a_diagonal_alone_is_the_whole_distance():
    P, Q = pair(12, 12, 2, 0)
    for metric in METRICS:
        value = curvewise.dtw(P, Q, metric=metric, window=0)
        assert curvewise.lb_keogh(P, Q, metric=metric, window=0) == value
    assert curvewise.lb_keogh([1.0, 5.0], [9.0, 2.0, 3.0]) == 1.0  # 5 and 9 enclose nothing of it
    assert curvewise.lb_kim([1.0, 5.0], [9.0, 2.0, 3.0]) == 8.0


def test_worked_examples():
    P, Q = [0.0, 8.0, 0.0], [1.0, 2.0, 5.0]
    assert curvewise.lb_keogh(P, Q) == 1.0 + 3.0 + 1.0
    assert curvewise.lb_improved(P, Q) == pytest.approx(5.0)  # H is 1, 5, 1
    assert curvewise.lb_keogh(Q, P) == 0.0
    assert curvewise.lb_improved(Q, P, metric="sqeuclidean") == pytest.approx(1 + 9 + 1)
    assert curvewise.lb_kim(P, Q, metric="sqeuclidean") == 25.0  # of the last points
    plane = [[0.0, 0.0], [9.0, 1.0]], [[3.0, 4.0], [3.0, 5.0]]
    assert curvewise.lb_keogh(*plane) == 5.0 + np.sqrt(36.0 + 9.0)
    assert curvewise.lb_kim(*plane) == np.sqrt(36.0 + 16.0)
    assert curvewise.lb_kim(*plane, metric="chebyshev") == 6.0


def test_batches_and_windows_of_cdist():
    curves = [pair(14, 14, 1, seed)[0] for seed in range(0, 24, 4)]
    table = curvewise.cdist(curves, curves, curvewise.lb_keogh, window=0.2)
    assert (table <= curvewise.cdist(curves, curves, window=0.2)).all()
    assert table[2, 3] == curvewise.lb_keogh(curves[2], curves[3], window=2)
    assert (table != table.T).any()


@pytest.mark.parametrize("module", [curvewise, reference])
@pytest.mark.parametrize("name", ["lb_keogh", "lb_improved", "lb_kim"])
def test_errors(module, name):
    function = getattr(module, name)
    for P, Q, options, message in [
        ([1.0, np.nan], [1.0], {}, r"^P\[1\] is nan; curves must be finite"),
        ([1.0], np.zeros((0, 1)), {}, rf"^Q has shape \(0, 1\); {name} needs at least 1 point"),
        ([[0.0, 1.0]], [1.0], {}, "both need the same number of coordinates"),
        ([0.0], [1.0], {"metric": "minkowski"}, "unknown metric 'minkowski'; choose from euclid"),
        ([0.0], [1.0], {"metric": "manhattan"}, "did you mean 'cityblock'?"),
    ]:
        with pytest.raises(ValueError, match=message):
            function(P, Q, **options)
    if name != "lb_kim":
        with pytest.raises(ValueError, match="window is -1; give a whole number >= 0"):
            function([0.0, 1.0], [1.0, 2.0], window=-1)
        with pytest.raises(ValueError, match="window=0 admits no path between 2 and 3 points"):
            function([0.0, 1.0], [1.0, 2.0, 3.0], window=0)
    if name == "lb_improved":
        with pytest.raises(ValueError, match="of 2 coordinates needs metric='sqeuclidean' or 'ci"):
            function([[0.0, 1.0]], [[1.0, 2.0]])
