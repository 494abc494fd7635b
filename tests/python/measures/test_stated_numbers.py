"""Numbers that the documentation states of the measures, and that no other test holds.

Each test names the page or the docstring that states its number.
"""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import curvewise


@pytest.mark.parametrize("exponent", [-400, -511, -525, -540, -600])
def test_small_differences_beside_large_coordinates(exponent: int) -> None:
    """docs/project/test_evidence.md: 2^-511 and about 2^-538."""
    rng = np.random.default_rng(4)
    for measure in (curvewise.dtw, curvewise.frechet):
        for _ in range(50):
            small = np.ldexp(rng.uniform(1.0, 2.0, 2), exponent)
            P, Q = np.array([[1.0, 1.0], [0.0, 0.0]]), np.array([[1.0, 1.0], small])
            exact = np.ldexp(np.sqrt(np.sum(np.ldexp(small, -exponent) ** 2)), exponent)
            found = measure(P, Q)
            if exponent >= -511:
                assert found == pytest.approx(exact, rel=1e-15)
            elif exponent >= -538:
                assert found == pytest.approx(exact, rel=1e-2)
                assert found > 0.0
            else:
                assert found == 0.0
            assert measure(P, Q, metric="cityblock") == small.sum()
            assert measure(P, Q, metric="chebyshev") == small.max()
            # Without large numbers next to them, no difference is too small.
            assert measure(P[1:], Q[1:]) == pytest.approx(exact, rel=1e-15)


def test_the_mean_of_a_centred_loop_is_no_scale() -> None:
    """The docstring of curve_length: 22.5 and 0.17 where means are 0.1 % of ranges."""
    loop, _ = curvewise.datasets.hysteresis_pair()
    P = loop - loop.mean(axis=0) + 1e-3 * np.ptp(loop, axis=0)
    Q = P * [1.0, 1.01]
    assert round(curvewise.curve_length(P, Q, scale="mean"), 1) == 22.5
    assert round(curvewise.curve_length(P, Q, scale="mean_abs"), 2) == 0.17


def test_what_offsets_of_pcm_may_miss() -> None:
    """The docstrings of pcm and of its match: S (T - S) / (2 (offsets - 1)), and 1e-12 S."""
    rng = np.random.default_rng(6)
    for _ in range(20):
        P, Q = (rng.normal(size=(n, 2)).cumsum(axis=0) for n in (14, 9))
        lengths = [np.hypot(*(np.diff(C, axis=0) / np.ptp(P, axis=0)).T).sum() for C in (P, Q)]
        S, T = sorted(lengths)
        best = curvewise.pcm_match(P, Q, offsets="continuous")
        assert best.tolerance == pytest.approx(max(1e-12 * S, 1e-13 * best.value), rel=1e-9)
        assert best.coverage == pytest.approx(S / T, rel=1e-12)
        for offsets in (5, 200):
            grid = curvewise.pcm_match(P, Q, offsets=offsets)
            assert grid.tolerance == pytest.approx(S * (T - S) / (2 * (offsets - 1)), rel=1e-9)
            assert -best.tolerance <= grid.value - best.value <= grid.tolerance
        assert curvewise.pcm(P, Q, offsets="continuous") <= curvewise.pcm(P, Q)


def test_the_ellipsoid_of_the_earth_is_within_6_parts_in_1000_of_the_sphere() -> None:
    """measures/haversine.md: by the radii of curvature of WGS 84, north and east."""
    equator, flattening = 6378137.0, 1 / 298.257223563
    square = flattening * (2 - flattening)
    up = np.radians(np.linspace(0, 90, 91))
    east = equator / np.sqrt(1 - square * np.sin(up) ** 2)
    north = east**3 * (1 - square) / equator**2
    wrong = np.abs(6371008.8 / np.concatenate([east, north]) - 1).max()
    assert 0.005 < wrong <= 0.006


@pytest.mark.nightly
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_memory_of_the_gradient_of_soft_dtw() -> None:
    """docs/how_to/use_gradients.md: 40 MB for curves of 10,000 points."""
    program = (
        "import numpy as np, curvewise, re\n"
        "P, Q = np.random.default_rng(1).normal(size=(2, 10000, 1)).cumsum(1)\n"
        "peak = lambda: int(re.search(r'VmHWM:\\s*(\\d+)', open('/proc/self/status').read())[1])\n"
        "curvewise.value_and_gradient(P[:50], Q[:50], 'soft_dtw')\n"
        "before = peak()\n"
        "curvewise.value_and_gradient(P, Q, 'soft_dtw')\n"
        "print((peak() - before) / 1000)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert 20 < float(run.stdout) < 45
