"""The shape-based distance against its definition, and against aeon."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.curves import z_normalized


def pair(n: int, m: int, d: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    return random.normal(size=(n, d)), random.normal(size=(m, d)) * 10.0 ** (seed % 13 - 6)


def by_correlate(P: np.ndarray, Q: np.ndarray) -> float:
    sums = sum(np.correlate(p, q, "full") for p, q in zip(P.T, Q.T, strict=True))
    return float(1.0 - np.max(sums) / (np.linalg.norm(P) * np.linalg.norm(Q)))


@settings(deadline=None, max_examples=120)
@given(
    st.integers(1, 40), st.integers(1, 40), st.sampled_from([1, 2, 3, 4, 7]), st.integers(0, 2**32)
)
def test_value_is_the_definition(n, m, d, seed):
    P, Q = pair(n, m, d, seed)
    value = curvewise.sbd(P, Q)
    assert value == pytest.approx(by_correlate(P, Q), abs=1e-13)
    assert value == pytest.approx(reference.sbd(P, Q), abs=1e-13)
    assert value == pytest.approx(curvewise.sbd(Q, P), abs=1e-13)
    assert 0.0 <= value <= 2.0
    assert curvewise.sbd(P, 3.0 * P) == pytest.approx(0.0, abs=1e-14)
    assert curvewise.sbd(np.asfortranarray(P), Q[::-1][::-1]) == value


@pytest.mark.parametrize("module", [curvewise, reference])
def test_closed_forms(module):
    assert module.sbd([2.0], [-3.0]) == 2.0  # no shift but 0 is left
    assert module.sbd([1.0, 0.0], [0.0, -1.0]) == 1.0  # they need not overlap
    assert module.sbd([0.0, 0.0], [1.0]) == 1.0
    assert module.sbd([0.0, 0.0], [0.0]) == 0.0
    shifted = np.concatenate([np.zeros(9), [1.0, 5.0, 2.0]])
    assert module.sbd([1.0, 5.0, 2.0], shifted) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("scale", [1e-300, 1e-170, 1e170, 1e300])
def test_extreme_scales_count_for_nothing(scale):
    P, Q = pair(12, 9, 2, 1)
    assert curvewise.sbd(P * scale, Q) == pytest.approx(curvewise.sbd(P, Q), rel=1e-13)


@pytest.mark.skipif(find_spec("aeon") is None, reason='no aeon: pip install "curvewise[aeon]"')
def test_value_is_aeons():
    from aeon.distances import sbd_distance

    for seed in range(20):
        P, Q = (curve[:, 0] for curve in pair(31, 31, 1, seed))
        value = curvewise.sbd(z_normalized(P), z_normalized(Q))
        assert value == pytest.approx(sbd_distance(P, Q, standardize=True), abs=1e-12)


@pytest.mark.parametrize("module", [curvewise, reference])
@pytest.mark.parametrize(
    ("P", "Q", "error", "message"),
    [
        ([[0.0, 1.0]] * 3, [1.0, 2.0], ValueError, r"both need the same number of coordinates"),
        ([1.0, np.nan], [1.0], ValueError, r"^P\[1\] is nan; curves must be finite"),
        ([1.0], [1.0, np.inf], ValueError, r"^Q\[1\] is inf; curves must be finite"),
        ([1.0], np.zeros((0, 1)), ValueError, r"^Q has shape \(0, 1\); sbd needs at least 1 point"),
        (["a"], [1.0], TypeError, "^P has dtype <U1; a curve holds real numbers"),
    ],
)
def test_errors(module, P, Q, error, message):
    with pytest.raises(error, match=message):
        module.sbd(P, Q)
