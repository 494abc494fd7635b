"""The numpy reference of what compares curves in a plane against hand calculation: closed forms.

As in `test_reference.py`, nothing is compared with the compiled library.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise import reference

CROSSED = [(0.0, 1.0), (1.0, -1.0)], [(0.0, -1.0), (1.0, 1.0)]
CROSSINGS: tuple[Any, ...] = ("rearrange", "split")


# area


@pytest.mark.parametrize("spacing", ["distance", "x", "arc_length", "matched"])
@pytest.mark.parametrize("crossing", ["rearrange", "split"])
def test_area_between_parallel_lines_is_the_gap(spacing: Any, crossing: Any) -> None:
    x = np.array([0.0, 0.3, 1.1, 1.9, 2.0, 4.0])
    P, Q = np.column_stack([x, x / 2]), np.array([(0.0, 3.0), (4.0, 5.0)])
    options: Any = {"spacing": spacing, "crossing": crossing}
    assert reference.area(P, Q, **options) == pytest.approx(12.0, rel=1e-14)
    assert reference.area(P, P, **options) == 0.0


def test_area_where_curves_cross() -> None:
    assert reference.area(*CROSSED) == 2.0
    assert reference.area(*CROSSED, crossing="split") == 1.0
    assert reference.area(*CROSSED, crossing="split", squared=True) == 1.0
    quads = {way: reference.area_quads(*CROSSED, crossing=way).quads.tolist() for way in CROSSINGS}
    assert quads["split"] == [[[0, 1], [1, -1], [1, 1], [0, -1]]]
    assert quads["rearrange"] == [[[0, 1], [1, 1], [1, -1], [0, -1]]]


def test_area_where_curves_run_against_each_other() -> None:
    # The sides that cross are those between the curves.
    P, Q = [(0.0, 0.0), (2.0, 0.0)], [(2.0, 2.0), (0.0, 2.0)]
    assert reference.area(P, Q) == 4.0
    assert reference.area(P, Q, crossing="split") == 2.0
    quads = {way: reference.area_quads(P, Q, crossing=way).quads.tolist() for way in CROSSINGS}
    assert quads["split"] == [[[0, 0], [2, 0], [0, 2], [2, 2]]]
    assert quads["rearrange"] == [[[2, 0], [0, 0], [0, 2], [2, 2]]]


def test_split_area_by_hand() -> None:
    # y = 3 - x against y = x on [0, 2]: they cross at x = 1.5, gaps of 3 and 1 at the ends.
    P, Q = [(0, 3), (2, 1)], [(0, 0), (2, 2)]
    assert reference.area(P, Q, crossing="split") == pytest.approx(2.25 + 0.25, rel=1e-14)
    assert reference.area(P, Q, crossing="split", squared=True) == pytest.approx(6.25, rel=1e-14)


def test_quadrilaterals_by_hand() -> None:
    # Q's segment of length 4 is cut at its middle, then its first half at (1, 0).
    P = [(0, 1), (1, 2), (2, 1), (4, 1)]
    quads, areas = reference.area_quads([(0, 0), (4, 0)], P)
    assert quads[:, 3].tolist() == [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
    assert quads[:, 0].tolist() == [[0.0, 1.0], [1.0, 2.0], [2.0, 1.0]]
    assert areas.tolist() == [1.5, 1.5, 2.0]
    assert reference.area(P, [(0, 0), (4, 0)], squared=True) == 8.5


def test_spacing_chooses_which_segment_is_cut() -> None:
    P = [(0, 10), (1, 10), (2, 10), (3, 10)]
    Q = [(0, 0), (1, 9), (4, 9)]
    steep, _ = reference.area_quads(P, Q)
    flat, _ = reference.area_quads(P, Q, spacing="x")
    assert [0.5, 4.5] in steep[:, 2].tolist()
    assert [2.5, 9.0] in flat[:, 2].tolist()


def test_equal_segments_are_cut_in_order_wherever_the_curves_are() -> None:
    Q = np.array([(0.0, 0.0), (0.1, 0.0), (0.2, 0.0), (0.3, 0.0)])
    P = np.column_stack([np.linspace(0.0, 0.3, 6), np.ones(6)])
    for shift in (0.0, 0.7, 10.1):
        quads, _ = reference.area_quads(P + shift, Q + shift)
        cuts = (quads[:, 3, 0] - shift).tolist()
        assert cuts == pytest.approx([0.0, 0.05, 0.1, 0.15, 0.2], abs=1e-12)


def test_area_by_arc_length_does_not_depend_on_sampling() -> None:
    # They do not cross: where they do, the value of either `crossing` depends on the sampling.
    P, Q = np.array([(0, 0), (2, 1), (3, 5)], float), np.array([(0, 1), (1, 3), (2, 7)], float)
    middle = np.insert(P, 2, 0.25 * P[1] + 0.75 * P[2], axis=0)
    repeated = Q[[0, 0, 1, 1, 2, 2]]
    for crossing in ("rearrange", "split"):
        options: Any = {"spacing": "arc_length", "crossing": crossing}
        area = reference.area(P, Q, **options)
        assert area > 1
        assert reference.area(middle, Q, **options) == pytest.approx(area, rel=1e-12)
        assert reference.area(P, repeated, **options) == pytest.approx(area, rel=1e-12)
    assert len(reference.area_quads(P, Q, spacing="arc_length").areas) == 3


def test_area_by_arc_length_of_a_curve_without_length() -> None:
    quads, areas = reference.area_quads([(0, 0), (2, 0)], [(1, 1)] * 3, spacing="arc_length")
    assert quads[:, 1].tolist() == [[0.0, 0.0], [2.0, 0.0]]
    assert areas.tolist() == [0.0, 1.0]


def test_areas_of_large_curves_are_scaled_back() -> None:
    stretch = np.array([2.0**505, 2.0**4])
    P, Q = np.array(CROSSED)
    assert reference.area(P * stretch, Q * stretch) == 2.0 * 2.0**509
    assert reference.area(P * stretch, Q * stretch, squared=True) == 4.0 * 2.0**1018
    quads, areas = reference.area_quads(P * stretch, Q * stretch)
    np.testing.assert_array_equal(quads, reference.area_quads(P, Q).quads * stretch)
    assert areas.tolist() == [2.0**510]


# pcm


def test_pcm_of_parallel_lines_is_their_distance_times_the_length() -> None:
    # Scaled by P's box: x from 0 to 2 becomes 0 to 1, y is not scaled.
    assert reference.pcm([(0, 0), (1, 0), (2, 0)], [(0, 3), (2, 3)]) == 3.0
    match = reference.pcm_match([(0, 0), (2, 0)], [(-1, 1), (5, 1)], offsets="continuous")
    # The longer has length 3, and its part nearest to P starts at 0.5 (x = 0): the distance is 1.
    assert match.mapped == "P"
    assert match.coverage == pytest.approx(1 / 3)
    assert match.value == pytest.approx(1.0, rel=1e-12)
    assert match.offset == pytest.approx(0.5, abs=1e-5)
    np.testing.assert_allclose(match.points, [(0, 1), (2, 1)], atol=1e-5)


def test_pcm_of_a_run_of_the_curves_own_vertices(data_dir: Path) -> None:
    loop = np.loadtxt(data_dir / "loops" / "tr1180_tct_3pct.csv", delimiter=",")[::8]
    part = loop[5:17]
    grid, exact = reference.pcm_match(loop, part), reference.pcm(loop, part, offsets="continuous")
    scaled = reference.normalize(loop)[0]
    T, S = (np.hypot(*np.diff(c, axis=0).T).sum() for c in (scaled, scaled[5:17]))
    assert grid.mapped == "Q"
    assert grid.coverage == pytest.approx(S / T, rel=1e-12)
    assert 0 < grid.value <= S * (T - S) / 398
    assert exact <= 1e-12 * S
    assert reference.pcm(loop, part, offsets=1) > grid.value


def test_continuous_pcm_finds_the_minimum_between_the_grid() -> None:
    rng = np.random.default_rng(6)
    for _ in range(5):
        P, Q = rng.normal(size=(5, 2)).cumsum(0), rng.normal(size=(9, 2)).cumsum(0)
        exact = reference.pcm(P, Q, offsets="continuous")
        assert exact <= reference.pcm(P, Q)
        finest = reference.pcm(P, Q, offsets=100_000)
        assert exact <= finest
        assert exact == pytest.approx(finest, rel=1e-4)


# curve_length


def test_curve_length_by_hand() -> None:
    # P's vertices lie at 0, 1/2 and 1 of its length, where Q is at (2, 0), (2, 2) and (2, 4).
    P, Q = [(1, 0), (1, 2), (1, 4)], [(2, 0), (2, 4)]
    expected = [[math.log(2), 0.0]] * 3
    np.testing.assert_allclose(reference.curve_length_residuals(P, Q), expected, rtol=1e-15)
    assert reference.curve_length(P, Q) == pytest.approx(math.sqrt(3) * math.log(2), rel=1e-15)
    assert reference.curve_length(P, P) == 0.0


@pytest.mark.parametrize(("scale", "divisor"), [("mean", 0.5), ("mean_abs", 1.5), ("range", 4.0)])
def test_scales_of_curve_length(scale: Any, divisor: float) -> None:
    P = np.array([(-2.0, -2.0), (1.0, 1.0), (2.0, 2.0), (1.0, 1.0)])
    Q = P + np.array([1.0, 0.0])
    residuals = reference.curve_length_residuals(P, Q, scale=scale)
    assert residuals[0].tolist() == pytest.approx([math.log1p(1 / divisor), 0.0], rel=1e-15)
    # A negative mean scales like a positive one.
    np.testing.assert_array_equal(residuals, reference.curve_length_residuals(-P, -Q, scale=scale))


def test_a_scale_of_0_names_the_way_out() -> None:
    P = np.array([(1.0, 0.0), (1.0, 3.0), (1.0, -3.0)])
    Q = P + np.array([0.0, 1.0])
    with pytest.raises(ValueError, match=r"the mean of P's y is 0 to rounding; use scale='mean_ab"):
        reference.curve_length(P, Q)
    with pytest.raises(ValueError, match=r"the range of P's x is 0; use scale='mean' or"):
        reference.curve_length(P, Q, scale="range")
    assert reference.curve_length(P, Q, scale="mean_abs") > 0
    with pytest.raises(ValueError, match=r"P's x is 0 throughout.*add the same constant to x"):
        reference.curve_length(P - np.array([1.0, 0.0]), Q, scale="mean_abs")


def test_pointwise_measures_and_normalize_by_hand() -> None:
    P, Q = [(0, 1), (4, 1)], [(1, 3), (4, -3)]
    assert reference.sum_of_squares(P, Q) == 21.0
    assert reference.mse(P, Q) == 5.25
    assert reference.mae(P, Q) == 1.75
    scaled = reference.normalize(P, Q, [[-4, 2]])
    assert [curve.tolist() for curve in scaled] == [
        [[0.0, 0.0], [1.0, 0.0]],
        [[0.25, 2.0], [1.0, -4.0]],
        [[-1.0, 1.0]],
    ]
    assert reference.normalize([2, 4])[0].tolist() == [0.0, 1.0]
