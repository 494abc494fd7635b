"""The numpy reference against what does not come from it: hand calculation, enumeration, data.

Every other test takes the reference as the truth, so here nothing is compared with the compiled
library. Values come from closed forms, from enumerating all warping paths of short curves, from
two other packages (the golden data) and from the tables of the paper.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest

from curvewise import reference
from curvewise._options import Metric

Array = npt.NDArray[np.float64]
Step = tuple[int, int]

GEOS_P = [(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)]
GEOS_Q = [(0, 4), (4, 4), (5, 1)]
CROSSED = [(0.0, 1.0), (1.0, -1.0)], [(0.0, -1.0), (1.0, 1.0)]
CROSSINGS: tuple[Any, ...] = ("rearrange", "split")
MEASURES = ("area", "pcm", "frechet", "dtw", "curve_length")


def warping_paths(n: int, m: int, open_begin: bool = False) -> Iterator[list[Step]]:
    """Yield every path to (n - 1, m - 1)."""
    if n == 1 and (m == 1 or open_begin):
        yield [(0, m - 1)]
    for i, j in ((n - 1, m), (n, m - 1), (n - 1, m - 1)):
        if i >= 1 and j >= 1 and not (n == 1 and open_begin):
            yield from ([*path, (n - 1, m - 1)] for path in warping_paths(i, j, open_begin))


def path_cost(ground: Array, path: list[Step], weight: float = 1.0) -> float:
    """Return the sum of ground distances along a path, diagonal steps `weight` times."""
    cost = float(ground[path[0]])
    for (i, j), cell in itertools.pairwise(path):
        cost += float(ground[cell]) * (weight if cell == (i + 1, j + 1) else 1.0)
    return cost


def leash(ground: Array, path: list[Step]) -> float:
    return max(float(ground[cell]) for cell in path)


def ground_by_hand(P: Array, Q: Array, metric: str) -> Array:
    norm: Callable[[Array], Any] = {
        "euclidean": lambda delta: math.sqrt(sum(delta**2)),
        "sqeuclidean": lambda delta: sum(delta**2),
        "cityblock": lambda delta: sum(abs(delta)),
        "chebyshev": lambda delta: max(abs(delta)),
        "minkowski": lambda delta: math.sqrt(sum(delta**2)),  # of order 2, the default
    }[metric]
    return np.array([[norm(p - q) for q in Q] for p in P])


def integer_pairs(seed: int, count: int, longest: int) -> Iterator[tuple[Array, Array]]:
    """Yield curves on a small integer grid, on which ties abound and most sums are exact."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        n, m = rng.integers(1, longest + 1, 2)
        d = rng.integers(1, 4)
        yield rng.integers(-3, 4, (n, d)).astype(float), rng.integers(-3, 4, (m, d)).astype(float)


# dtw and frechet against the enumeration of all paths


@pytest.mark.parametrize("metric", get_args(Metric))
@pytest.mark.parametrize(("step_pattern", "weight"), [("symmetric1", 1.0), ("symmetric2", 2.0)])
def test_dtw_is_the_cheapest_of_all_warping_paths(
    metric: Any, step_pattern: Any, weight: float
) -> None:
    options = {"metric": metric, "step_pattern": step_pattern}
    for P, Q in integer_pairs(1, 40, 5):
        ground = ground_by_hand(P, Q, metric)
        best = min(path_cost(ground, path, weight) for path in warping_paths(len(P), len(Q)))
        assert reference.dtw(P, Q, **options) == pytest.approx(best, rel=1e-14)
        found = reference.dtw_path(P, Q, **options)
        path = [(int(i), int(j)) for i, j in found.path]
        assert path in warping_paths(len(P), len(Q))
        assert path_cost(ground, path, weight) == found.distance


@pytest.mark.parametrize("metric", get_args(Metric))
def test_frechet_is_the_shortest_leash_of_all_couplings(metric: Any) -> None:
    for P, Q in integer_pairs(2, 60, 5):
        ground = ground_by_hand(P, Q, metric)
        best = min(leash(ground, path) for path in warping_paths(len(P), len(Q)))
        assert reference.frechet(P, Q, metric=metric) == best
        found = reference.frechet_path(P, Q, metric=metric)
        path = [(int(i), int(j)) for i, j in found.path]
        assert path in warping_paths(len(P), len(Q))
        assert leash(ground, path) == found.distance == best


@pytest.mark.parametrize("open_begin", [False, True])
@pytest.mark.parametrize("open_end", [False, True])
def test_open_ends_match_a_part_of_q(open_begin: bool, open_end: bool) -> None:
    for P, Q in integer_pairs(3, 40, 5):
        ground = ground_by_hand(P, Q, "cityblock")
        ends = range(1, len(Q) + 1) if open_end else [len(Q)]
        costs = [
            min(path_cost(ground, path) for path in warping_paths(len(P), m, open_begin))
            for m in ends
        ]
        options: Any = {"metric": "cityblock", "open_begin": open_begin, "open_end": open_end}
        found = reference.dtw_path(P, Q, **options)
        assert found.distance == min(costs) == reference.dtw(P, Q, **options)
        assert found.path[-1, 1] == ends[int(np.argmin(costs))] - 1
        assert path_cost(ground, [(int(i), int(j)) for i, j in found.path]) == found.distance
        assert found.path[0, 0] == 0
        assert open_begin or found.path[0, 1] == 0


@pytest.mark.parametrize("window", [0, 1, 2])
def test_the_window_admits_only_paths_in_the_band(window: int) -> None:
    for P, Q in integer_pairs(4, 60, 5):
        n, m = len(P), len(Q)
        reach = window * (max(n, m) - 1) if min(n, m) > 1 else math.inf

        def inside(cell: Step, n: int = n, m: int = m, reach: float = reach) -> bool:
            return abs(cell[0] * (m - 1) - cell[1] * (n - 1)) <= reach

        ground = ground_by_hand(P, Q, "cityblock")
        paths = [path for path in warping_paths(n, m) if all(map(inside, path))]
        if not paths:
            words = f"window=0 admits no path between {n} and {m} points; use at least 1"
            with pytest.raises(ValueError, match=words):
                reference.dtw(P, Q, window=window)
            continue
        best = min(path_cost(ground, path) for path in paths)
        assert reference.dtw(P, Q, metric="cityblock", window=window) == best
        table = reference.dtw_table(P, Q, metric="cityblock", window=window)
        assert all(inside((i, j)) for i, j in np.argwhere(np.isfinite(table)))


def test_minkowski_is_the_cube_root_of_cubes() -> None:
    P, Q = np.random.default_rng(5).normal(size=(2, 9, 3))
    expected = float(sum(abs(P[0] - Q[0]) ** 3)) ** (1 / 3)
    assert reference.dtw(P[:1], Q[:1], metric="minkowski", p=3) == pytest.approx(
        expected, rel=1e-14
    )


@pytest.mark.parametrize(
    ("p", "metric"),
    [(1, "cityblock"), (2, "euclidean"), (None, "euclidean"), (math.inf, "chebyshev")],
)
def test_minkowski_of_a_named_order_is_that_metric(p: float | None, metric: Any) -> None:
    P, Q = np.random.default_rng(6).normal(size=(2, 9, 3))
    for table in (reference.dtw_table, reference.frechet_table):
        np.testing.assert_array_equal(
            table(P, Q, metric="minkowski", p=p), table(P, Q, metric=metric)
        )


def test_ties_go_to_the_diagonal_then_up_then_left() -> None:
    diagonal = [[0, 0], [1, 1], [2, 2]]
    assert reference.dtw_path([0, 0, 0], [0, 0, 0]).path.tolist() == diagonal
    assert reference.frechet_path([0, 0, 0], [0, 0, 0]).path.tolist() == diagonal
    # To (1, 1): 3 from above, 3 from the left, 4 along the diagonal.
    up = reference.dtw_path([0, 1], [0, -1], step_pattern="symmetric2")
    assert up.path.tolist() == [[0, 0], [0, 1], [1, 1]]
    # Before (2, 2) the leash is 5 above and on the left, 10 on the diagonal.
    up = reference.frechet_path([0, 5, 0], [0, -5, 0])
    assert up.path.tolist() == [[0, 0], [0, 1], [1, 2], [2, 2]]
    # With an open end the first of two equal columns is taken.
    assert reference.dtw_path([1], [3, 1, 1], open_begin=True, open_end=True).path.tolist() == [
        [0, 1]
    ]


def test_frechet_of_the_pair_on_which_geos_errs() -> None:
    assert reference.frechet(GEOS_P, GEOS_Q) == 5.0
    assert reference.frechet(GEOS_Q, GEOS_P) == 5.0


@pytest.mark.parametrize("scale", [2.0**600, 2.0**1020, 2.0**-600, 2.0**-1040])
def test_magnitudes_at_the_ends_of_the_range(scale: float) -> None:
    P, Q = np.array(GEOS_P, dtype=float), np.array(GEOS_Q, dtype=float)
    assert reference.frechet(P * scale, Q * scale) == 5.0 * scale
    assert reference.frechet_table(P * scale, Q * scale)[-1, -1] == 5.0 * scale
    assert reference.dtw(P * scale, Q * scale) == pytest.approx(
        scale * reference.dtw(P, Q), rel=1e-12, abs=5e-324
    )
    degree_2 = reference.dtw(P * scale, Q * scale, metric="sqeuclidean")
    assert degree_2 == (math.inf if scale > 1 else 0.0)
    for name in ("pcm", "curve_length"):
        measure = getattr(reference, name)
        assert measure(P * scale, Q * scale) == pytest.approx(measure(P, Q), rel=1e-12)


def test_areas_of_large_curves_are_scaled_back() -> None:
    stretch = np.array([2.0**505, 2.0**4])
    P, Q = np.array(CROSSED)
    assert reference.area(P * stretch, Q * stretch) == 2.0 * 2.0**509
    assert reference.area(P * stretch, Q * stretch, squared=True) == 4.0 * 2.0**1018
    quads, areas = reference.area_quads(P * stretch, Q * stretch)
    np.testing.assert_array_equal(quads, reference.area_quads(P, Q).quads * stretch)
    assert areas.tolist() == [2.0**510]


def test_a_coordinate_far_smaller_than_the_other_still_counts() -> None:
    P, Q = np.array(GEOS_P, dtype=float), np.array(GEOS_Q, dtype=float)
    stretch = np.array([2.0**-700, 2.0**700])
    for measure in (reference.pcm, reference.curve_length):
        assert measure(P * stretch, Q * stretch) == pytest.approx(measure(P, Q), rel=1e-12)
    scaled = zip(
        reference.normalize(P * stretch, Q * stretch), reference.normalize(P, Q), strict=True
    )
    for found, expected in scaled:
        np.testing.assert_array_equal(found, expected)


def test_pcm_beyond_the_range_of_a_double_is_inf() -> None:
    P, Q = np.array(GEOS_P) * 1e-200, np.array(GEOS_Q) * 1e200
    match = reference.pcm_match(P, Q)
    assert (match.value, match.mapped, match.coverage) == (math.inf, "P", 0.0)
    assert np.isnan(match.points).all()


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


# The rest


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


# What other programs and the paper say


@pytest.fixture(scope="module")
def golden(data_dir: Path) -> dict[str, dict[str, Any]]:
    """Return, by name, a pair of curves and what two other packages give for it."""
    text = (data_dir / "golden" / "expected.json").read_text()
    with np.load(data_dir / "golden" / "cases.npz") as curves:
        return {
            name: {"P": curves[f"{name}/P"], "Q": curves[f"{name}/Q"], **expected}
            for name, expected in json.loads(text)["values"].items()
        }


def golden_values(case: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any], float]]:
    """Yield measure, options and value of all that a case has."""
    cubic: dict[str, Any] = {"metric": "minkowski", "p": 3}
    for metric, value in case["dtw"].items():
        yield "dtw", cubic if metric == "minkowski_p3" else {"metric": metric}, value
    yield "dtw", {"step_pattern": "symmetric2"}, case["dtw_symmetric2_euclidean"]
    metrics: dict[str, dict[str, Any]] = {
        "1": {"metric": "cityblock"},
        "2": {},
        "3": cubic,
        "inf": {"metric": "chebyshev"},
    }
    for p, value in case["frechet"].items():
        yield "frechet", metrics[p], value
    for measure in ("area", "curve_length"):
        if case.get(measure) is not None:
            yield measure, {}, case[measure]


def test_golden_values(golden: dict[str, dict[str, Any]]) -> None:
    count = 0
    for name, case in golden.items():
        for measure, options, expected in golden_values(case):
            found = getattr(reference, measure)(case["P"], case["Q"], **options)
            assert found == pytest.approx(expected, rel=1e-12), (name, measure, options)
            count += 1
    assert count == 11 * (5 + 1 + 4) + 9 + 8


def test_curve_length_of_circles_around_the_origin(golden: dict[str, dict[str, Any]]) -> None:
    # The mean of y is rounding, and what is divided by it noise: the golden value is null.
    circles = golden["circles_c5_c6"]
    assert circles["curve_length"] is None
    with pytest.raises(ValueError, match=r"the mean of P's y is 0 to rounding; use scale='mean_ab"):
        reference.curve_length(circles["P"], circles["Q"])


@pytest.mark.parametrize("row", MEASURES)
def test_table_4_of_the_paper(data_dir: Path, row: str) -> None:
    def loop(kind: str, number: int) -> Array:
        path = data_dir / "paper" / kind / f"{'' if kind == 'test' else row + '_'}loop_{number}.csv"
        return np.loadtxt(path, delimiter=",", skiprows=1)

    totals = dict.fromkeys(("area", "frechet", "dtw", "curve_length"), 0.0)
    for number in range(1, 6):
        P, Q = loop("test", number), loop("model", number)
        p, q = reference.normalize(P, Q)
        totals["area"] += reference.area(P, Q, spacing="x")
        totals["frechet"] += reference.frechet(p, q)
        totals["dtw"] += reference.dtw(p, q, step_pattern="symmetric2")
        totals["curve_length"] += reference.curve_length(P, Q)
    table = json.loads((data_dir / "paper" / "tables.json").read_text())["table_4_without_noise"]
    printed = dict(zip(table["columns"], table[row], strict=True))
    assert totals["area"] == pytest.approx(printed["area"], rel=0.015)
    assert round(totals["frechet"], 2) == printed["frechet"]
    assert round(totals["dtw"], 1) == printed["dtw"]
    assert round(totals["curve_length"], 1) == printed["curve_length"]
