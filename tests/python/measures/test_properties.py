"""What the measures promise for any curves, on curves that hypothesis makes up.

Coordinates are small multiples of 1/8, so that differences, sums and products of them are exact:
where the mathematics says "equal", the test says ==.
"""

from __future__ import annotations

import math
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import curvewise
from curvewise._options import CoordinateMetric

Array = npt.NDArray[np.float64]

PROFILE = settings(derandomize=True, deadline=None)

METRICS = st.sampled_from(get_args(CoordinateMetric))
NORMS = st.sampled_from(["euclidean", "sqeuclidean", "cityblock", "chebyshev"])
EXACT_METRICS = st.sampled_from(["sqeuclidean", "cityblock", "chebyshev"])
STEP_PATTERNS = st.sampled_from(["symmetric1", "symmetric2"])
POWERS_OF_TWO = st.integers(-40, 40).map(lambda k: 2.0**k)
SPACINGS = st.sampled_from(["distance", "x", "arc_length"])
CROSSINGS = st.sampled_from(["rearrange", "split"])
EIGHTHS = st.integers(-512, 512).map(lambda k: k / 8)


@st.composite
def groups(draw: st.DrawFn, count: int, least: int = 1, dim: int | None = None) -> list[Array]:
    """Draw `count` curves of one dimension, each of `least` to 12 points."""
    d = dim or draw(st.sampled_from([1, 2, 3, 5]))
    entries = draw(st.sampled_from([EIGHTHS, st.integers(-2, 2).map(float)]))
    points = st.lists(entries, min_size=d, max_size=d)
    return [np.array(draw(st.lists(points, min_size=least, max_size=12))) for _ in range(count)]


def planar_pairs() -> st.SearchStrategy[list[Array]]:
    """Draw two curves in the plane, both longer than a single point."""
    return groups(2, least=2, dim=2).filter(lambda pair: all(np.ptp(c, axis=0).any() for c in pair))


def longest_edge(*curves: Array) -> float:
    edges = [np.linalg.norm(np.diff(curve, axis=0), axis=1) for curve in curves]
    return max((float(edge) for lengths in edges for edge in lengths), default=0.0)


@given(groups(2), METRICS)
@PROFILE
def test_frechet_is_symmetric_and_0_for_a_curve_and_itself(pair: list[Array], metric: Any) -> None:
    P, Q = pair
    assert curvewise.frechet(P, Q, metric=metric) == curvewise.frechet(Q, P, metric=metric)
    assert curvewise.frechet(P, P, metric=metric) == 0.0


@given(groups(2), METRICS, STEP_PATTERNS, st.none() | st.integers(1, 12))
@PROFILE
def test_dtw_is_symmetric_and_0_for_a_curve_and_itself(
    pair: list[Array], metric: Any, pattern: Any, window: int | None
) -> None:
    P, Q = pair
    options: dict[str, Any] = {"metric": metric, "step_pattern": pattern, "window": window}
    assert curvewise.dtw(P, Q, **options) == curvewise.dtw(Q, P, **options)
    assert curvewise.dtw(P, P, **options) == 0.0
    path = curvewise.dtw_path(P, P, **options)
    assert path.distance == 0.0


@given(groups(3), st.sampled_from(["euclidean", "cityblock", "chebyshev"]))
@PROFILE
def test_frechet_obeys_the_triangle_inequality(curves: list[Array], metric: Any) -> None:
    P, Q, R = curves
    around = curvewise.frechet(P, Q, metric=metric) + curvewise.frechet(Q, R, metric=metric)
    assert curvewise.frechet(P, R, metric=metric) <= around * (1 + 1e-15)


@given(groups(2), NORMS, STEP_PATTERNS, EIGHTHS, POWERS_OF_TWO)
@PROFILE
def test_translation_and_powers_of_two_change_no_bit(
    pair: list[Array], metric: Any, pattern: Any, shift: float, factor: float
) -> None:
    P, Q = pair
    distance = curvewise.dtw(P, Q, metric=metric, step_pattern=pattern)
    leash = curvewise.frechet(P, Q, metric=metric)
    table = curvewise.frechet_table(P, Q, metric=metric)
    moved = P + shift, Q + shift
    assert curvewise.dtw(*moved, metric=metric, step_pattern=pattern) == distance
    assert curvewise.frechet(*moved, metric=metric) == leash
    scaled = P * factor, Q * factor
    power = factor**2 if metric == "sqeuclidean" else factor
    assert curvewise.dtw(*scaled, metric=metric, step_pattern=pattern) == distance * power
    assert curvewise.frechet(*scaled, metric=metric) == leash * power
    assert np.array_equal(curvewise.frechet_table(*scaled, metric=metric), table * power)


@given(groups(2), st.sampled_from([-1000, -520, -499, 499, 520, 1010]))
@PROFILE
def test_the_ends_of_the_range_lose_no_bit(pair: list[Array], exponent: int) -> None:
    P, Q = pair
    factor = 2.0**exponent
    scaled = P * factor, Q * factor
    assert curvewise.frechet(*scaled) == curvewise.frechet(P, Q) * factor
    assert curvewise.dtw(*scaled) == curvewise.dtw(P, Q) * factor
    path = curvewise.dtw_path(P, Q).path
    assert np.array_equal(curvewise.dtw_path(*scaled).path, path)


@given(groups(2), NORMS, EXACT_METRICS)
@PROFILE
def test_reversal(pair: list[Array], metric: Any, exact: Any) -> None:
    P, Q = pair
    backward = P[::-1], Q[::-1]
    assert curvewise.frechet(*backward, metric=metric) == curvewise.frechet(P, Q, metric=metric)
    assert curvewise.dtw(*backward, metric=exact) == curvewise.dtw(P, Q, metric=exact)
    open_begin = curvewise.dtw(*backward, metric=exact, open_begin=True)
    assert open_begin == curvewise.dtw(P, Q, metric=exact, open_end=True)


@given(groups(2), st.data())
@PROFILE
def test_repeated_points_do_not_change_frechet(pair: list[Array], data: st.DataObject) -> None:
    P, Q = pair
    counts = data.draw(st.lists(st.integers(1, 3), min_size=len(P), max_size=len(P)))
    repeated = np.repeat(P, counts, axis=0)
    assert curvewise.frechet(repeated, Q) == curvewise.frechet(P, Q)
    assert curvewise.frechet(Q, repeated) == curvewise.frechet(P, Q)


@given(groups(2), st.integers(1, 4))
@PROFILE
def test_subdivision_changes_frechet_by_at_most_the_longest_edge(
    pair: list[Array], parts: int
) -> None:
    """Both values lie between the continuous distance and that plus their longest edge."""
    P, Q = pair
    fractions = np.arange(len(P) * parts - parts + 1) / parts
    columns = [np.interp(fractions, np.arange(len(P)), column) for column in P.T]
    fine = np.column_stack(columns)
    coarse, refined = curvewise.frechet(P, Q), curvewise.frechet(fine, Q)
    assert coarse <= refined + longest_edge(P, Q) + 1e-12
    assert refined <= coarse + longest_edge(fine, Q) + 1e-12
    ends = max(np.linalg.norm(P[0] - Q[0]), np.linalg.norm(P[-1] - Q[-1]))
    assert min(coarse, refined) >= ends * (1 - 1e-15)


@given(groups(2), NORMS, STEP_PATTERNS)
@PROFILE
def test_a_wider_window_never_gives_more(pair: list[Array], metric: Any, pattern: Any) -> None:
    P, Q = pair
    narrowest = 0 if len(P) == len(Q) or min(len(P), len(Q)) == 1 else 1
    values = [
        curvewise.dtw(P, Q, metric=metric, step_pattern=pattern, window=window)
        for window in range(narrowest, max(len(P), len(Q)) + 2)
    ]
    assert values == sorted(values, reverse=True)
    assert values[-1] == curvewise.dtw(P, Q, metric=metric, step_pattern=pattern)
    assert math.isfinite(values[0])


@given(groups(2), NORMS)
@PROFILE
def test_every_freedom_of_the_path_lowers_dtw(pair: list[Array], metric: Any) -> None:
    P, Q = pair
    closed = curvewise.dtw(P, Q, metric=metric)
    begin = curvewise.dtw(P, Q, metric=metric, open_begin=True)
    end = curvewise.dtw(P, Q, metric=metric, open_end=True)
    both = curvewise.dtw(P, Q, metric=metric, open_begin=True, open_end=True)
    assert both <= min(begin, end) <= max(begin, end) <= closed
    assert closed <= curvewise.dtw(P, Q, metric=metric, step_pattern="symmetric2")
    assert closed >= curvewise.frechet(P, Q, metric=metric)
    last_row = curvewise.dtw_table(P, Q, metric=metric, open_begin=True)[-1]
    assert both == last_row.min()


@given(groups(2), st.integers(0, 11), st.integers(1, 12))
@PROFILE
def test_a_piece_is_found_with_both_ends_open(pair: list[Array], first: int, count: int) -> None:
    P = pair[0]
    piece = P[first : first + count]
    assume(len(piece) > 0)
    found = curvewise.dtw_path(piece, P, open_begin=True, open_end=True)
    assert found.distance == 0.0
    assert np.array_equal(P[found.path[:, 1]], piece[found.path[:, 0]])


@given(groups(2, least=2, dim=2), SPACINGS, CROSSINGS, st.booleans())
@PROFILE
def test_area_is_symmetric_never_negative_and_0_for_a_curve_and_itself(
    pair: list[Array], spacing: Any, crossing: Any, squared: bool
) -> None:
    P, Q = pair
    options: dict[str, Any] = {"spacing": spacing, "crossing": crossing, "squared": squared}
    area = curvewise.area(P, Q, **options)
    assert area >= 0.0
    assert curvewise.area(P, P, **options) == 0.0
    if spacing != "arc_length":  # which scales by P's box
        assert curvewise.area(Q, P, **options) == pytest.approx(area, rel=1e-12)


@given(groups(2, least=2, dim=2), SPACINGS, CROSSINGS, EIGHTHS, POWERS_OF_TWO)
@PROFILE
def test_area_does_not_depend_on_the_place_and_scales(
    pair: list[Array], spacing: Any, crossing: Any, eighths: float, factor: float
) -> None:
    P, Q = pair
    options: dict[str, Any] = {"spacing": spacing, "crossing": crossing}
    area = curvewise.area(P, Q, **options)
    if spacing != "arc_length":  # whose cuts are not at dyadic fractions: exact but for rounding
        shift = np.array([eighths, -eighths])
        assert curvewise.area(P + shift, Q + shift, **options) == area
    assert curvewise.area(P * factor, Q * factor, **options) == area * factor**2


@given(groups(2, least=2, dim=2), SPACINGS, CROSSINGS)
@PROFILE
def test_area_is_the_sum_of_its_quadrilaterals(
    pair: list[Array], spacing: Any, crossing: Any
) -> None:
    P, Q = pair
    options: dict[str, Any] = {"spacing": spacing, "crossing": crossing}
    quads, areas = curvewise.area_quads(P, Q, **options)
    assert quads.shape == (len(areas), 4, 2)
    if spacing != "arc_length":
        assert len(areas) == max(len(P), len(Q)) - 1
    squared = curvewise.area(P, Q, **options, squared=True)
    assert curvewise.area(P, Q, **options) == pytest.approx(math.fsum(areas), rel=1e-14)
    assert squared == pytest.approx(math.fsum(areas**2), rel=1e-14)
    if crossing == "rearrange":
        diagonals = quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]
        twice = diagonals[0][:, 0] * diagonals[1][:, 1] - diagonals[0][:, 1] * diagonals[1][:, 0]
        np.testing.assert_allclose(areas, np.abs(twice) / 2, rtol=1e-9, atol=1e-9)


@given(planar_pairs(), st.just(200) | st.integers(1, 50) | st.just("continuous"))
@PROFILE
def test_pcm_match_agrees_with_pcm(pair: list[Array], offsets: Any) -> None:
    P, Q = pair
    match = curvewise.pcm_match(P, Q, offsets=offsets)
    assert match.value == curvewise.pcm(P, Q, offsets=offsets) >= 0.0
    assert 0.0 < match.coverage <= 1.0 + 1e-12
    assert match.offset >= 0.0
    scaled = curvewise.normalize(P, P, Q)[1:]
    shorter, longer = scaled if match.mapped == "P" else scaled[::-1]
    lengths = [np.hypot(*np.diff(curve, axis=0).T) for curve in (shorter, longer)]
    S, T = lengths[0].sum(), lengths[1].sum()
    assert match.coverage == pytest.approx(S / T, rel=1e-12)
    assert match.offset <= max(T - S, 0.0) * (1 + 1e-12) + 1e-15
    extent = np.where(np.ptp(P, axis=0) > 0, np.ptp(P, axis=0), 1.0)
    points = (match.points - P.min(axis=0)) / extent
    gaps = np.hypot(*(points - shorter).T)
    area = float((0.5 * (gaps[1:] + gaps[:-1]) * lengths[0]).sum())
    assert area == pytest.approx(match.value, rel=1e-9, abs=1e-12)


@given(planar_pairs(), EIGHTHS, POWERS_OF_TWO)
@PROFILE
def test_pcm_does_not_depend_on_place_and_scale(
    pair: list[Array], shift: float, factor: float
) -> None:
    P, Q = pair
    value = curvewise.pcm(P, Q)
    assert curvewise.pcm(P + shift, Q + shift) == value
    if np.ptp(P, axis=0).all():  # a direction in which P's extent is zero is not scaled
        assert curvewise.pcm(P * (factor, 8.0), Q * (factor, 8.0)) == value
    assert curvewise.pcm(P, P) == pytest.approx(0.0, abs=1e-12)
    assert curvewise.pcm(P, Q, offsets="continuous") <= value


@given(planar_pairs(), st.sampled_from(["mean_abs", "range"]), POWERS_OF_TWO)
@PROFILE
def test_curve_length_is_the_norm_of_its_residuals(
    pair: list[Array], scale: Any, factor: float
) -> None:
    P, Q = pair
    assume(np.ptp(P, axis=0).all())  # neither the range nor the mean of |x| is 0
    value = curvewise.curve_length(P, Q, scale=scale)
    residuals = curvewise.curve_length_residuals(P, Q, scale=scale)
    assert residuals.shape == P.shape
    assert (residuals >= 0).all()
    assert value == pytest.approx(math.hypot(*residuals.ravel()), rel=1e-14)
    assert curvewise.curve_length(P, P, scale=scale) == pytest.approx(0.0, abs=1e-12)
    assert curvewise.curve_length(P * factor, Q * factor, scale=scale) == value


@given(planar_pairs(), st.sampled_from([-960, 0, 960]), st.sampled_from([-960, 0, 960]))
@PROFILE
def test_each_coordinate_has_a_range_of_its_own(pair: list[Array], x: int, y: int) -> None:
    """Where each is divided by its own extent, the two may be hundreds of decades apart."""
    P, Q = pair
    assume(np.ptp(P, axis=0).all())
    scaled = P * (2.0**x, 2.0**y), Q * (2.0**x, 2.0**y)
    boxes = curvewise.normalize(*scaled), curvewise.normalize(P, Q)
    assert np.array_equal(np.vstack(boxes[0]), np.vstack(boxes[1]))
    assert curvewise.pcm(*scaled) == curvewise.pcm(P, Q)
    for scale in ("mean_abs", "range"):
        expected = curvewise.curve_length(P, Q, scale=scale)
        assert curvewise.curve_length(*scaled, scale=scale) == expected


@given(groups(1), st.data())
@PROFILE
def test_pointwise_measures(curves: list[Array], data: st.DataObject) -> None:
    P = curves[0]
    entries = st.lists(EIGHTHS, min_size=P.size, max_size=P.size)
    Q = np.array(data.draw(entries)).reshape(P.shape)
    total = curvewise.sum_of_squares(P, Q)
    assert total == ((P - Q) ** 2).sum() == curvewise.sum_of_squares(Q, P)
    assert curvewise.mse(P, Q) == total / P.size
    assert curvewise.mae(P, Q) == np.abs(P - Q).sum() / P.size
    assert curvewise.mse(P, P) == curvewise.mae(P, P) == 0.0
    assert curvewise.dtw(P, Q, metric="sqeuclidean") <= total
    huge = 2.0**1016  # the sum of the differences overflows, their mean does not
    assert curvewise.mae(P * huge, Q * huge) == curvewise.mae(P, Q) * huge
    large = 2.0**504
    assert curvewise.mse(P * large, Q * large) == curvewise.mse(P, Q) * large * large


@given(groups(2), EIGHTHS, POWERS_OF_TWO)
@PROFILE
def test_normalize_maps_p_to_the_unit_box(pair: list[Array], shift: float, factor: float) -> None:
    P, Q = pair
    scaled_p, scaled_q = curvewise.normalize(P, Q)
    extent = np.ptp(P, axis=0)
    assert (scaled_p.min(axis=0) == 0.0).all()
    assert np.array_equal(scaled_p.max(axis=0), np.where(extent > 0, 1.0, 0.0))
    expected = (Q - P.min(axis=0)) / np.where(extent > 0, extent, 1.0)
    assert np.array_equal(scaled_q, expected)
    if (extent > 0).all():
        again = curvewise.normalize((P + shift) * factor, (Q + shift) * factor)
        assert np.array_equal(again[1], scaled_q)
