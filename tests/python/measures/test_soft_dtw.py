"""soft_dtw: against its reference, closed forms, its limit, and how it must behave."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise
from curvewise import reference, soft_dtw, soft_dtw_divergence, value_and_gradient

GAMMAS = [1e-6, 0.1, 1.0, 1e4]


def walk(n: int, seed: int, d: int = 2) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, d)).cumsum(axis=0)


def paths(n: int, m: int) -> int:
    """The number of warping paths, Delannoy's."""
    return sum(math.comb(n - 1, k) * math.comb(m - 1, k) * 2**k for k in range(min(n, m)))


@pytest.mark.parametrize("gamma", GAMMAS)
@pytest.mark.parametrize(
    ("n", "m", "d"),
    [(1, 1, 1), (1, 5, 2), (7, 1, 3), (2, 3, 7), (31, 33, 2), (63, 65, 1), (66, 128, 4)],
)
@pytest.mark.nightly("66-128-4", "63-65-1.*(1e-06|10000)")
def test_the_value_is_the_references(n, m, d, gamma) -> None:
    P, Q = walk(n, 1, d), walk(m, 2, d)
    for window in (None, 3, 0.4):
        ours = soft_dtw(P, Q, gamma=gamma, window=window)
        theirs = reference.soft_dtw(P, Q, gamma=gamma, window=window)
        # A sum of costs less gamma times a logarithm: each is rounded, whatever is left of both.
        hard = curvewise.dtw(P, Q, metric="sqeuclidean", window=window)
        assert abs(ours - theirs) < 1e-12 * hard + 1e-15 * gamma * (n + m)


@pytest.mark.parametrize(("n", "m"), [(1, 1), (1, 9), (4, 4), (30, 20), (257, 3), (300, 300)])
def test_where_all_costs_are_0_the_paths_are_counted(n: int, m: int) -> None:
    assert soft_dtw(np.zeros(n), np.zeros(m), gamma=2.0) == pytest.approx(
        -2.0 * math.log(paths(n, m)), rel=1e-13
    )


def test_a_single_point_is_matched_to_all() -> None:
    assert soft_dtw([1.0], [1.0, 3.0, 0.0], gamma=0.7) == pytest.approx(5.0, rel=1e-14)


@pytest.mark.parametrize("n", [40, 255, 257, 600])
def test_as_gamma_falls_it_becomes_dtw(n: int) -> None:
    P, Q = walk(n, 3), walk(n + 5, 4)
    hard = curvewise.dtw(P, Q, metric="sqeuclidean")
    for gamma in (1e-6, 1e-30, 1e-200):
        # All paths together weigh no more than if each cost as little as the best.
        most = gamma * math.log(3) * (2 * n + 4)
        assert -most - 1e-12 * hard <= soft_dtw(P, Q, gamma=gamma) - hard <= 1e-12 * hard
    soft = value_and_gradient(P, Q, "soft_dtw", gamma=1e-9)[1]
    along_a_path = value_and_gradient(P, Q, "dtw", metric="sqeuclidean")[1]
    np.testing.assert_allclose(soft, along_a_path, atol=1e-9 * np.abs(soft).max())


@pytest.mark.parametrize("exponent", [-1000, -600, -500, -100, 0, 100, 500, 600, 1000])
def test_no_gamma_overflows(exponent: int) -> None:
    """From the least of all up, for curves of any size."""
    P, Q = (np.ldexp(C, exponent) for C in (walk(9, 3), walk(12, 4)))
    hard, slopes = value_and_gradient(P, Q, "dtw", metric="sqeuclidean")
    for gamma in (5e-324, 1e-310, 2.0**-1000, 1e-300):
        found = value_and_gradient(P, Q, "soft_dtw", gamma=gamma)
        most = gamma * math.log(3) * 2 * (len(P) + len(Q))
        assert hard * (1 - 1e-12) - most <= found[0] <= hard * (1 + 1e-12)
        assert found[0] == soft_dtw(P, Q, gamma=gamma)
        if hard > 1e6 * most:
            np.testing.assert_allclose(found[1], slopes, atol=1e-5 * np.abs(slopes).max())
        assert soft_dtw(0 * P, 0 * Q, gamma=gamma) == pytest.approx(0.0, abs=most)
    for gamma in (1e300, 1e306):
        most = gamma * math.log(3) * (len(P) + len(Q))
        assert hard - most <= soft_dtw(P, Q, gamma=gamma) <= hard


@given(
    st.integers(1, 12), st.integers(1, 12), st.integers(1, 4), st.integers(0, 10**6),
    st.sampled_from(GAMMAS),
)  # fmt: skip
def test_symmetry_motions_reversal_and_units(n, m, d, seed, gamma) -> None:
    P, Q = walk(n, seed, d), walk(m, seed + 1, d)
    value = soft_dtw(P, Q, gamma=gamma)
    assert soft_dtw(Q, P, gamma=gamma) == value
    about = {"rel": 1e-10, "abs": 1e-10 * max(gamma, 1)}
    assert soft_dtw(P[::-1], Q[::-1], gamma=gamma) == pytest.approx(value, **about)
    assert soft_dtw(P + 8.0, Q + 8.0, gamma=gamma) == pytest.approx(value, **about)
    assert soft_dtw(P * 4.0, Q * 4.0, gamma=gamma * 16.0) == 16.0 * value
    rounding = 1e-15 * gamma * (n + m)
    assert value <= curvewise.dtw(P, Q, metric="sqeuclidean") * (1 + 1e-12) + rounding


@pytest.mark.parametrize("factor", [2.0**300, 2.0**-300, 2.0**510])
def test_large_and_small_curves(factor: float) -> None:
    P, Q = walk(20, 5), walk(30, 6)
    value, slopes = value_and_gradient(P, Q, "soft_dtw", gamma=0.5)
    gamma = min(0.5 * factor**2, 1e308)
    if gamma < 1e308:
        large = value_and_gradient(P * factor, Q * factor, "soft_dtw", gamma=gamma)
        assert large[0] == value * factor**2
        np.testing.assert_array_equal(large[1], slopes * factor)
    else:
        assert math.isfinite(soft_dtw(P * factor, Q * factor, gamma=gamma))


def test_with_slopes_at_every_size_around_a_strip() -> None:
    """Strips have 64 rows, and the root of the number of rows from 4096 on."""
    for n, m in ((63, 70), (64, 64), (65, 30), (128, 129), (129, 2), (200, 1)):
        P, Q = walk(n, 7, 1), walk(m, 8, 1)
        for window in (None, 5):
            value, slopes = value_and_gradient(P, Q, "soft_dtw", window=window)
            assert value == soft_dtw(P, Q, window=window)
            direction = walk(m, 9, 1)
            h = 1e-6
            ahead, behind = (soft_dtw(P, Q + step * direction, window=window) for step in (h, -h))
            scale = max(np.abs(slopes * direction).sum(), 1.0)
            assert abs((slopes * direction).sum() - (ahead - behind) / (2 * h)) < 1e-6 * scale


@pytest.mark.nightly
def test_slopes_of_more_rows_than_the_least_strips_hold() -> None:
    P, Q = walk(5000, 7, 1), walk(300, 8, 1)
    value, slopes = value_and_gradient(P, Q, "soft_dtw")
    assert value == soft_dtw(P, Q)
    swapped = curvewise.values_and_gradients(Q[None], P[None], "soft_dtw")
    assert swapped[0][0] == value
    np.testing.assert_allclose(swapped[1][0], slopes, rtol=1e-9, atol=1e-9 * np.abs(slopes).max())


def test_slopes_by_both_curves_add_up_to_0() -> None:
    """A motion of both curves together changes nothing."""
    P, Q = walk(90, 1)[None], walk(70, 2)[None]
    _, by_P, by_Q = curvewise.values_and_gradients(P, Q, "soft_dtw", gamma=0.3)
    assert np.abs(by_P.sum(axis=1) + by_Q.sum(axis=1)).max() < 1e-11 * np.abs(by_Q).sum()


def test_every_level_gives_the_same_bits() -> None:
    program = (
        "import curvewise, numpy as np\n"
        "P, Q = np.random.default_rng(1).normal(size=(2, 150, 3)).cumsum(1)\n"
        "for gamma in (1e-9, 1.0):\n"
        "    found = curvewise.values_and_gradients(P[None], Q[None], 'soft_dtw', gamma=gamma)\n"
        "    print([part.tobytes().hex() for part in found])\n"
    )
    levels = curvewise.installation.build_info()["instruction_sets"]
    printed = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "CURVEWISE_ISA": level},
            capture_output=True, text=True, check=True,
        ).stdout
        for level in levels
    }  # fmt: skip
    assert len(printed) == 1


def test_the_divergence_is_0_of_equal_curves_and_not_negative() -> None:
    P, Q = walk(30, 1), walk(20, 2)
    for gamma in GAMMAS:
        assert soft_dtw_divergence(P, P, gamma=gamma) == 0.0
        apart = soft_dtw_divergence(P, Q, gamma=gamma)
        assert apart > 0.0
        assert apart == soft_dtw_divergence(Q, P, gamma=gamma)
        assert apart == pytest.approx(reference.soft_dtw_divergence(P, Q, gamma=gamma), rel=1e-9)


@pytest.mark.parametrize("gamma", [0, -1, math.nan, math.inf, "a"])
@pytest.mark.parametrize("module", [curvewise, reference], ids=["compiled", "reference"])
def test_gamma_is_a_finite_number_above_0(module, gamma) -> None:
    with pytest.raises(ValueError, match=rf"gamma is '?{gamma}'?; give a finite number > 0"):
        module.soft_dtw([0.0, 1.0], [2.0], gamma=gamma)


def test_errors() -> None:
    with pytest.raises(ValueError, match="P has shape \\(0,\\); soft_dtw needs at least 1 point"):
        soft_dtw([], [1.0])
    with pytest.raises(ValueError, match="window=0 admits no path between 2 and 3 points"):
        soft_dtw([0.0, 1.0], [1.0, 2.0, 3.0], window=0)
    with pytest.raises(ValueError, match=r"Q\[1\] is nan"):
        soft_dtw([0.0, 1.0], [1.0, math.nan])
