"""Step patterns at random, with weights of any sign: against the reference, and all their paths."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, get_args

import numpy as np
import pytest

import curvewise
import curvewise.plotting
from curvewise import Alignment, StepPattern, reference
from curvewise._core import is_symmetric
from curvewise._options import StepPatternName

WEIGHTS = (-2.0, -1.0, -0.5, 0.0, 0.25, 1 / 3, 1.0, 2.0)
METRICS = ("euclidean", "sqeuclidean", "cityblock", "chebyshev")
NORMALIZATIONS = ("NA", "N", "M", "N+M")
Generator = np.random.Generator
Cells = list[tuple[int, int, float]]


def random_step(rng: Generator) -> Cells:
    """Return where a step begins, and the cells that it visits, with their weights."""
    rows, columns = map(int, rng.choice([(1, 1), (1, 0), (0, 1), (1, 2), (2, 1), (2, 2), (0, 2)]))
    cells = [(rows, columns, -1.0)]
    for _ in range(rng.integers(0, 3)):
        rows, columns = int(rng.integers(0, rows + 1)), int(rng.integers(0, columns + 1))
        cells.append((rows, columns, float(rng.choice(WEIGHTS))))
    return [*cells, (0, 0, float(rng.choice(WEIGHTS)))]


def random_pattern(rng: Generator) -> StepPattern:
    """Return a pattern; one in three is symmetric, and one in three has only positive weights."""
    steps = [random_step(rng) for _ in range(rng.integers(2, 5))]
    if rng.integers(0, 3) == 0:
        steps += [[(columns, rows, weight) for rows, columns, weight in step] for step in steps]
    is_positive = rng.integers(0, 3) == 0
    rows = []
    for number, (begin, *cells) in enumerate(steps):
        rows.append((number, *begin))
        rows += [(number, i, j, abs(w) if is_positive else w) for i, j, w in cells]
    return StepPattern(rows, NORMALIZATIONS[rng.integers(0, 4)])


def random_curves(rng: Generator, count: int, longest: int, dim: int) -> list[Any]:
    # Of few different coordinates, so that distances are equal now and then.
    return [rng.integers(-3, 4, (rng.integers(1, longest), dim)) / 2 for _ in range(count)]


def pattern_of(given: Any) -> StepPattern:
    return given if isinstance(given, StepPattern) else StepPattern.named(given)


def has_negative_weight(pattern: StepPattern) -> bool:
    return any(weight < 0 for step in pattern.steps() for *_, weight in step[1:])


class Setting(NamedTuple):
    """Options, curves, and their distances by the reference."""

    options: dict[str, Any]
    queries: list[Any]
    curves: list[Any]
    distances: Any  # of queries and curves
    among: Any  # of the curves

    @classmethod
    def of(cls, rng: Generator, pattern: Any, *, may_normalize: bool) -> Setting:
        options: dict[str, Any] = {"step_pattern": pattern, "metric": METRICS[rng.integers(0, 4)]}
        options |= {"penalty": float(rng.choice([0.0, 0.0, 0.5]))}
        options |= {"window": [None, None, 2, 0.6][rng.integers(0, 4)]}
        options |= {"normalize": may_normalize and bool(rng.integers(0, 2))}
        dim = int(rng.integers(1, 3))
        queries, curves = random_curves(rng, 2, 9, dim), random_curves(rng, 5, 9, dim)

        def table(rows: list[Any]) -> Any:
            return np.array([[reference.dtw(P, Q, **options) for Q in curves] for P in rows])

        return cls(options, queries, curves, table(queries), table(curves))

    def limits(self, rng: Generator) -> Iterator[float]:
        """Yield a distance itself and a number near it, negative only if distances may be."""
        least = -np.inf if has_negative_weight(pattern_of(self.options["step_pattern"])) else 0.0
        finite = self.distances[np.isfinite(self.distances)]
        for limit in (*rng.permutation(finite)[:1], rng.uniform(-5, 15)):
            yield max(float(limit), least)


def check_batches(given: Setting, rng: Generator) -> None:
    options, queries, curves = given.options, given.queries, given.curves
    np.testing.assert_array_equal(curvewise.cdist(queries, curves, **options), given.distances)
    np.testing.assert_array_equal(curvewise.cdist(curves, **options), given.among)
    np.testing.assert_array_equal(
        [curvewise.Prepared(P, "dtw", **options)(Q) for P in queries for Q in curves],
        given.distances.ravel(),
    )
    triangle = given.among[np.triu_indices(len(curves), 1)]
    if is_symmetric("dtw", options):
        np.testing.assert_array_equal(curvewise.pdist(curves, "dtw", **options), triangle)
    for limit in given.limits(rng):
        cut = np.where(given.distances > limit, np.inf, given.distances)
        found = curvewise.cdist(queries, curves, cutoff=limit, **options)
        np.testing.assert_array_equal(found, cut)
        found = [[curvewise.dtw(P, Q, cutoff=limit, **options) for Q in curves] for P in queries]
        np.testing.assert_array_equal(found, cut)
        found = curvewise.cdist(curves, cutoff=limit, **options)
        np.testing.assert_array_equal(found, np.where(given.among > limit, np.inf, given.among))


def check_index(given: Setting, rng: Generator) -> None:
    index = curvewise.Index(given.curves, "dtw", **given.options)
    order = np.argsort(given.distances, axis=1, kind="stable")
    count = int(rng.integers(1, len(given.curves) + 1))
    distances, places = index.kneighbors(given.queries, count)
    np.testing.assert_array_equal(places, order[:, :count])
    np.testing.assert_array_equal(
        distances, np.take_along_axis(given.distances, order[:, :count], axis=1)
    )
    for limit in given.limits(rng):
        distances, places = index.radius_neighbors(given.queries, limit)
        for row, by_distance, near, found in zip(
            given.distances, order, places, distances, strict=True
        ):
            expected = by_distance[row[by_distance] <= limit]
            np.testing.assert_array_equal(near, expected)
            np.testing.assert_array_equal(found, row[expected])


def check_paths(given: Setting) -> None:
    of_path = {name: value for name, value in given.options.items() if name != "normalize"}
    for P, Q in zip(given.queries, given.curves, strict=False):
        for prune in (True, False):
            found = curvewise.dtw(P, Q, prune=prune, **given.options)
            assert found == reference.dtw(P, Q, **given.options)
        check_same_path(P, Q, of_path)


def check_same_path(P: Any, Q: Any, options: dict[str, Any]) -> None:
    """Check that both have one path and one table."""
    ours, theirs = (module.dtw_table(P, Q, **options) for module in (curvewise, reference))
    np.testing.assert_array_equal(ours, theirs)
    assert not np.isnan(ours).any()
    found, expected = (module.dtw_path(P, Q, **options) for module in (curvewise, reference))
    assert found.distance == expected.distance == ours[-1, -1]
    np.testing.assert_array_equal(found.path, expected.path)
    check_is_of_pattern(found, (len(P), len(Q)), options)


def check_is_of_pattern(found: Alignment, sizes: tuple[int, int], options: dict[str, Any]) -> None:
    """Check that a path has the ends of both curves, or that it is empty, and its value inf."""
    if len(found.path) == 0:
        assert found.path.shape == (0, 2)
        assert found.distance == np.inf
        pattern = pattern_of(options["step_pattern"])
        assert options["window"] is not None or not is_reached(pattern, *sizes)
    else:
        assert found.path[0].tolist() == [0, 0]
        assert found.path[-1].tolist() == [size - 1 for size in sizes]


def is_reached(pattern: StepPattern, n: int, m: int) -> bool:
    """Return whether steps of the pattern lead from the first cell to the last."""
    reached = np.zeros((n, m), dtype=np.bool_)
    reached[0, 0] = True
    for i, j in np.ndindex(n, m):
        for (rows, columns, _), *_ in pattern.steps():
            if rows <= i and columns <= j:
                reached[i, j] |= reached[i - rows, j - columns]
    return bool(reached[-1, -1])


def check_all(seed: int, pattern: Any = None) -> None:
    rng = np.random.default_rng(seed)
    own = random_pattern(rng) if pattern is None else pattern
    given = Setting.of(rng, own, may_normalize=pattern_of(own).normalization != "NA")
    check_batches(given, rng)
    check_index(given, rng)
    check_paths(given)


def test_all_calls_are_brute_force(rounds: Callable[[int], int]) -> None:
    for seed in range(rounds(60)):
        check_all(seed)


@pytest.mark.nightly
def test_all_calls_are_brute_force_for_many_patterns() -> None:
    for seed in range(100, 700):
        check_all(seed)


def test_all_calls_are_brute_force_for_named_patterns() -> None:
    for seed, name in enumerate(get_args(StepPatternName)):
        check_all(seed, name)


def all_sums(steps: list[Cells], ground: Any, i: int, j: int) -> Iterator[tuple[float, Any]]:
    """Yield of each path to a cell its cost and the cells from which on its steps go.

    A cell of infinite distance that takes part makes a path infinite, whatever its weight.
    """
    if i == j == 0:
        yield float(ground[0, 0]), [(0, 0)]
    for (rows, columns, _), *cells in steps:
        if rows > i or columns > j:
            continue
        for cost, path in all_sums(steps, ground, i - rows, j - columns):
            total = cost
            for back, across, weight in cells:
                distance = float(ground[i - back, j - across])
                if weight != 0:
                    total += np.inf if distance == np.inf else weight * distance
            yield (np.inf if cost == np.inf or np.isnan(total) else total), [*path, (i, j)]


def random_ground(rng: Generator) -> Any:
    """Return distances; some are infinite, or, now and then, near the largest double."""
    ground = rng.integers(0, 5, rng.integers(1, 5, 2)).astype(float)
    if rng.integers(0, 3) == 0:
        ground *= 2.0**1021
    ground[rng.random(ground.shape) < rng.choice([0.0, 0.15, 0.4])] = np.inf
    return ground


def check_distances_of_infinite_cells(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pattern, ground = random_pattern(rng), random_ground(rng)
    P, Q = (np.arange(count, dtype=float) for count in ground.shape)
    paths = list(all_sums(pattern.steps(), ground, len(P) - 1, len(Q) - 1))
    least = min((cost for cost, _ in paths), default=np.inf)
    options = {"step_pattern": pattern, "metric": ground, "window": None}
    assert curvewise.dtw(P, Q, **options) == reference.dtw(P, Q, **options) == least
    check_same_path(P, Q, options)
    found = curvewise.dtw_path(P, Q, **options)
    assert found.distance == least
    assert len(found.path) > 0 if paths else len(found.path) == 0
    if not paths:
        return
    cells = [tuple(cell) for cell in found.path.tolist()]
    # Cells in between are in the path too.
    assert any(cost == least and set(path) <= set(cells) for cost, path in paths)


def test_an_infinite_distance_is_on_no_finite_path(rounds: Callable[[int], int]) -> None:
    for seed in range(rounds(1000)):
        check_distances_of_infinite_cells(seed)


@pytest.mark.parametrize("name", ["symmetric2", "symmetricP0", "typeIc"])
def test_a_cutoff_of_the_least_double_gives_up_no_quotient(name: Any) -> None:
    least = float(np.nextafter(0.0, 1.0))
    for n, m, times in np.ndindex(5, 5, 6):
        ground = np.zeros((n + 3, m + 3))
        ground[0, 0] = times * least
        P, Q = (np.zeros(count) for count in ground.shape)
        options: dict[str, Any] = {"metric": ground, "step_pattern": name, "normalize": True}
        value = curvewise.dtw(P, Q, **options)
        assert curvewise.dtw(P, Q, **options, cutoff=least) == (value if value <= least else np.inf)


def test_negative_limits_are_for_distances_that_may_be_negative() -> None:
    P, Q = [0.0, 1.0], [0.0, 3.0]
    pattern = StepPattern([(1, 1, 1, -1), (1, 0, 0, -1)])
    assert curvewise.dtw(P, Q, step_pattern=pattern) == -2.0
    for cutoff, expected in ((-1.0, -2.0), (-2.0, -2.0), (-2.5, np.inf)):
        assert curvewise.dtw(P, Q, step_pattern=pattern, cutoff=cutoff) == expected
        assert curvewise.cdist([P], [Q], step_pattern=pattern, cutoff=cutoff) == expected
        assert curvewise.cdist([P], [Q], lambda *_: -2.0, cutoff=cutoff) == expected
        _, places = curvewise.Index([Q], step_pattern=pattern).radius_neighbors([P], cutoff)
        assert len(places[0]) == (expected < 0)
    positive = StepPattern([(1, 1, 1, -1), (1, 0, 0, 1)])
    for options in ({}, {"step_pattern": positive}, {"step_pattern": "typeIa"}):
        for call in (
            lambda options: curvewise.dtw(P, Q, cutoff=-1, **options),
            lambda options: curvewise.cdist([P], [Q], cutoff=-1, **options),
            lambda options: curvewise.pdist([P, Q], cutoff=-1, **options),
        ):
            with pytest.raises(ValueError, match=r"^cutoff is -1; give a number >= 0, or None$"):
                call(options)
        with pytest.raises(ValueError, match=r"^radius is -1; give a number >= 0$"):
            curvewise.Index([Q], **options).radius_neighbors([P], -1)
    with pytest.raises(ValueError, match=r"^cutoff is nan; give a number, or None$"):
        curvewise.dtw(P, Q, cutoff=np.nan, step_pattern=pattern)


def test_pictures_of_an_alignment_without_a_path(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    from matplotlib.figure import Figure

    P, Q = [0.0, 1.0, 2.0, 3.0], [0.0, 2.0, 3.0]
    found = curvewise.dtw_path(P, Q, step_pattern="rigid")
    assert found.path.shape == (0, 2)
    assert "inf" in str(found)
    assert found.plot().axes
    artists = curvewise.plotting.plot_alignment(P, Q, Figure().subplots(), step_pattern="rigid")
    assert len(artists.between.get_segments()) == 0
    _, line = curvewise.plotting.plot_table(P, Q, Figure().subplots(), step_pattern="rigid")
    assert len(line.get_xydata()) == 0
    with pytest.raises(ValueError, match="step_pattern admits no path between 4 and 3 points"):
        curvewise.plotting.animate_alignment(P, Q, tmp_path / "a.gif", step_pattern="rigid")
