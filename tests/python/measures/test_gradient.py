"""The derivatives of measures by Q: against differences, homogeneity, and errors without
derivatives.
"""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

import curvewise
from curvewise import reference, value_and_gradient
from curvewise._options import CoordinateMetric

GROUND = [
    *({"metric": metric} for metric in get_args(CoordinateMetric)),
    {"metric": "minkowski", "p": 3},
    {"metric": "minkowski", "p": 1},
    {"metric": "minkowski", "p": np.inf},
]
CASES = [
    *[("dtw", options) for options in ({}, *GROUND)],
    *[("frechet", options) for options in ({}, *GROUND)],
    ("dtw", {"step_pattern": "symmetric2"}),
    ("dtw", {"step_pattern": "symmetric2", "normalize": True, "window": 6}),
    ("dtw", {"open_begin": True, "open_end": True}),
    ("area", {}),
    ("area", {"spacing": "x"}),
    ("area", {"crossing": "split"}),
    ("area", {"spacing": "x", "crossing": "split", "squared": True}),
    ("area", {"squared": True}),
    ("area", {"spacing": "matched"}),
    ("area", {"spacing": "matched", "squared": True}),
    *[("curve_length", {"scale": scale}) for scale in ("mean", "mean_abs", "range")],
]


CHAIN = [
    ("dtw", {}),
    ("area", {"crossing": "split"}),
    ("area", {"spacing": "matched"}),
    ("frechet", {}),
]


def wiggle(n: int, seed: int, d: int = 2) -> np.ndarray:
    """An uneven curve without ties: a random walk, away from zero on average."""
    return np.random.default_rng(seed).normal(0.3, 1.0, (n, d)).cumsum(axis=0)


@pytest.mark.parametrize(
    ("measure", "options"),
    CASES,
    ids=lambda part: part if isinstance(part, str) else "-".join(map(str, part.values())),
)
@pytest.mark.parametrize(("n", "m", "seed"), [(9, 14, 1), (14, 9, 2), (11, 11, 3)])
@pytest.mark.nightly("(14-9-2|11-11-3)-(dtw|frechet|area-matched)", "matched-True")
def test_gradients_are_limits_of_differences(measure, options, n, m, seed) -> None:
    P, Q = wiggle(n, seed), wiggle(m, seed + 10)
    value, gradient = value_and_gradient(P, Q, measure, **options)
    expected, differences = reference.value_and_gradient(P, Q, measure, **options)
    assert value == pytest.approx(expected, rel=1e-12)
    assert gradient.shape == Q.shape
    assert np.abs(gradient).max() > 0
    np.testing.assert_allclose(gradient, differences, atol=1e-7 * np.abs(differences).max())


def test_crossing_quadrilaterals_of_every_kind() -> None:
    """Four random points at a time: simple, rearranged either way, split either way."""
    random = np.random.default_rng(5)
    for _ in range(30):
        P, Q = random.normal(size=(2, 2, 2))
        for crossing in ("rearrange", "split"):
            ours = value_and_gradient(P, Q, "area", crossing=crossing)[1]
            theirs = reference.value_and_gradient(P, Q, "area", crossing=crossing)[1]
            np.testing.assert_allclose(ours, theirs, atol=1e-6 * np.abs(theirs).max())


@pytest.mark.parametrize("d", [1, 3])
@pytest.mark.parametrize("measure", ["dtw", "frechet", "sum_of_squares"])
def test_other_dimensions(measure: str, d: int) -> None:
    P, Q = wiggle(9, 1, d), wiggle(9, 2, d)
    gradient = value_and_gradient(P, Q, measure)[1]
    differences = reference.value_and_gradient(P, Q, measure)[1]
    np.testing.assert_allclose(gradient, differences, atol=1e-7 * np.abs(differences).max())
    if d == 1:
        assert value_and_gradient(P[:, 0], Q[:, 0], measure)[1].tolist() == gradient[:, 0].tolist()


def test_the_value_is_the_measures_own() -> None:
    P, Q = curvewise.datasets.hysteresis_pair()
    for measure in ("dtw", "frechet", "area", "curve_length"):
        assert value_and_gradient(P, Q, measure)[0] == getattr(curvewise, measure)(P, Q)
    options = {"step_pattern": "symmetric2", "normalize": True}
    assert value_and_gradient(P, Q, "dtw", **options)[0] == curvewise.dtw(P, Q, **options)
    assert value_and_gradient(P, P + 1, "sum_of_squares")[0] == curvewise.sum_of_squares(P, P + 1)


@pytest.mark.parametrize("factor", [2.0**300, 2.0**-300, 2.0**-600])
@pytest.mark.parametrize(
    ("measure", "options", "degree"),
    [
        ("dtw", {}, 1),
        ("frechet", {}, 1),
        ("frechet_continuous", {}, 1),
        ("area", {"crossing": "split"}, 2),
        ("area", {"spacing": "matched"}, 2),
        ("curve_length", {}, 0),
        ("sum_of_squares", {}, 2),
    ],
)
def test_large_and_small_curves(measure, options, degree, factor) -> None:
    P, Q = wiggle(9, 1), wiggle(9, 2)
    gradient = value_and_gradient(P, Q, measure, **options)[1]
    scaled = value_and_gradient(P * factor, Q * factor, measure, **options)[1]
    np.testing.assert_allclose(scaled, gradient * factor ** (degree - 1), rtol=1e-9)


def test_gradients_where_areas_overflow() -> None:
    P, Q = wiggle(9, 1) * 2.0**600, wiggle(9, 2) * 2.0**600
    for spacing in ("distance", "matched"):
        gradient = value_and_gradient(P * 2.0**-600, Q * 2.0**-600, "area", spacing=spacing)[1]
        value, scaled = value_and_gradient(P, Q, "area", spacing=spacing)
        assert value == np.inf
        np.testing.assert_allclose(scaled, gradient * 2.0**600, rtol=1e-9)


def test_gradients_where_the_continuous_distance_overflows() -> None:
    P = wiggle(9, 1)
    size = 1.7e308 / np.abs(P).max()
    expected = value_and_gradient(P, -P, "frechet_continuous")[1]
    value, gradient = value_and_gradient(P * size, -P * size, "frechet_continuous")
    assert value == np.inf
    np.testing.assert_allclose(gradient, expected, rtol=1e-9)


def test_along_a_loop_the_derivative_is_that_of_the_model() -> None:
    """The chain rule through a model of 61 points with one parameter, against differences."""
    strain = np.interp(np.arange(61) / 20, [0, 1, 2, 3], [0, 0.02, -0.02, 0.02])

    def model(yield_stress: float) -> np.ndarray:
        stress = curvewise.datasets.kinematic_hardening(strain, yield_stress=yield_stress)
        return np.column_stack((strain, stress))

    test, _ = curvewise.datasets.hysteresis_pair()
    box = np.ptp(test, axis=0)
    P, h = test / box, 1e-4
    dQ = (model(310 + h) - model(310 - h)) / box / (2 * h)
    for measure, options in CHAIN:
        function = getattr(curvewise, measure)
        gradient = value_and_gradient(P, model(310) / box, measure, **options)[1]
        values = [function(P, model(310 + s) / box, **options) for s in (h, -h)]
        assert np.sum(gradient * dQ) == pytest.approx((values[0] - values[1]) / (2 * h), rel=1e-5)


def test_where_there_is_no_derivative() -> None:
    P = wiggle(9, 1)
    for measure in ("dtw", "frechet", "sum_of_squares", "curve_length"):
        value, gradient = value_and_gradient(P, P, measure)
        assert value == 0.0
        assert not gradient.any()
    # A tie of two pairs: one of the two counts.
    gradient = value_and_gradient([0.0, 1.0], [0.5, 1.5], "frechet")[1]
    assert sorted(gradient.tolist()) == [0.0, 1.0]
    # The same tie of two vertices twice: the derivative is that of one of both pairs.
    assert np.abs(value_and_gradient([0, 2], [1, 3], "frechet_continuous")[1]).sum() == 1.0
    # Chebyshev with two equal coordinates: the first.
    assert value_and_gradient([[0, 0]], [[2, -2]], metric="chebyshev")[1].tolist() == [[1, 0]]


def test_errors() -> None:
    P = wiggle(5, 1)
    with pytest.raises(ValueError, match="unknown measure 'pcm'; choose from area, curve_length"):
        value_and_gradient(P, P, "pcm")
    with pytest.raises(ValueError, match="unknown measure 'pcm'; choose from area, curve_length"):
        reference.value_and_gradient(P, P, "pcm")
    with pytest.raises(ValueError, match="area has no gradient with spacing='arc_length'"):
        value_and_gradient(P, P, "area", spacing="arc_length")
    with pytest.raises(TypeError, match="sum_of_squares has no options, but window given"):
        value_and_gradient(P, P, "sum_of_squares", window=3)
    with pytest.raises(TypeError, match="dtw has no option 'foo'"):
        value_and_gradient(P, P, "dtw", foo=3)
    with pytest.raises(ValueError, match=r"Q\[0, 1\] is nan"):
        value_and_gradient(P, [[0.0, np.nan]])
    with pytest.raises(ValueError, match="needs equal shapes"):
        value_and_gradient(P, P[1:], "sum_of_squares")


def test_strided_and_integer_curves() -> None:
    P, Q = wiggle(9, 1), wiggle(12, 2)
    expected = value_and_gradient(P, Q)[1]
    assert (value_and_gradient(P, np.asfortranarray(Q))[1] == expected).all()
    assert (value_and_gradient(P, Q[::-1].copy()[::-1])[1] == expected).all()
    assert value_and_gradient([0, 1], [0, 3])[1].tolist() == [0.0, 1.0]
