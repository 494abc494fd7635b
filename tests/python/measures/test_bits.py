"""dtw and frechet equal the numpy reference bit for bit: distances, paths and tables.

Pairs come in families, one for each way in which a strip sweep could go wrong. These are random
walks with every option, small integer grids with ties in almost every comparison, sizes at the
edges of SIMD vectors and strips, and magnitudes at the ends of the range of a double. Every pair is
checked against the reference. Separately, its path must be valid: its steps, its ends, and a sum
(DTW) or maximum (Fréchet) of ground distances along it that is the distance itself.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise import reference
from curvewise._options import CoordinateMetric

Array = npt.NDArray[np.float64]
Options = dict[str, Any]

DIMENSIONS = (1, 2, 3, 4, 7)

# Computed in exactly the same way by kernel and reference; orders 1, 2 and inf have the names of
# other metrics.
EXACT_GROUNDS: tuple[Options, ...] = (
    {},
    *({"metric": metric} for metric in get_args(CoordinateMetric)),
    {"metric": "minkowski", "p": 1},
    {"metric": "minkowski", "p": 2.0},
    {"metric": "minkowski", "p": np.inf},
)

# Vector widths are 2, 4 and 8, strips 32 rows for tables and 256 for the rest.
EDGE_SIZES = tuple(
    size + offset for size in (2, 4, 8, 16, 32, 64, 256, 512) for offset in (-1, 0, 1)
)

MAGNITUDES = (1e300, 1.7e308, 1e155, 2.0**500, 2.0**-500, 1e-160, 1e-300, 1e-310, 1e-320, 5e-324)


@dataclass(frozen=True)
class Pair:
    """Two curves with the options to compare them under."""

    P: Array
    Q: Array
    ground: Options
    warping: Options

    def __str__(self) -> str:
        return f"shapes {self.P.shape}, {self.Q.shape}, {self.ground}, {self.warping}"


def random_warping(rng: np.random.Generator, n: int, m: int) -> Options:
    """Return one of the combinations of step pattern, window and open ends that dtw takes."""
    match rng.integers(5):
        case 0:
            return {}
        case 1:
            return {"step_pattern": "symmetric2"}
        case 2:
            return {"open_begin": bool(rng.integers(2)), "open_end": bool(rng.integers(2))}
        case _:
            narrowest = 0 if n == m or min(n, m) == 1 else 1
            window = narrowest + int(rng.choice([0, 1, 2, 5, max(n, m) // 2, max(n, m), 10**9]))
            pattern = "symmetric1" if rng.integers(2) else "symmetric2"
            return {"window": window, "step_pattern": pattern}


def random_pair(
    rng: np.random.Generator, P: Array, Q: Array, grounds: tuple[Options, ...] = EXACT_GROUNDS
) -> Pair:
    if P.shape[1] == 1 and rng.integers(2):  # d = 1 is also given as a flat array
        P, Q = P[:, 0], Q[:, 0]
    ground = grounds[rng.integers(len(grounds))]
    return Pair(P, Q, ground, random_warping(rng, len(P), len(Q)))


def random_size(rng: np.random.Generator) -> int:
    """Return 1 to 300, nine times out of ten at most 40."""
    return int(rng.integers(1, 301 if rng.integers(10) == 0 else 41))


def walks(rng: np.random.Generator) -> Pair:
    d = rng.choice(DIMENSIONS)
    n, m = random_size(rng), random_size(rng)
    P = np.cumsum(rng.normal(size=(n, d)), axis=0)
    return random_pair(rng, P, np.cumsum(rng.normal(size=(m, d)), axis=0))


def grids(rng: np.random.Generator) -> Pair:
    d = rng.choice(DIMENSIONS)
    top = rng.choice([1, 2, 5])
    P = rng.integers(0, top + 1, (random_size(rng), d)).astype(float)
    return random_pair(rng, P, rng.integers(0, top + 1, (random_size(rng), d)).astype(float))


def edges(rng: np.random.Generator) -> Pair:
    d = rng.choice(DIMENSIONS)
    size = rng.choice(EDGE_SIZES) if rng.integers(4) else rng.integers(250, 1100)
    long = rng.integers(-4, 5, (size, d)) * rng.choice([1.0, 0.1])
    short = rng.integers(-4, 5, (rng.integers(1, 20), d)) * 0.7
    return random_pair(rng, *((long, short) if rng.integers(2) else (short, long)))


def bands(rng: np.random.Generator) -> Pair:
    """Return long curves under a narrow window, which moves across the strips."""
    n, m = rng.integers(100, 600, 2)
    P, Q = (rng.choice([0.0, 0.3, 0.6], (size, 2)) for size in (n, m))
    pattern = "symmetric1" if rng.integers(2) else "symmetric2"
    window = int(rng.choice([1, 2, 3, 8, 40]))
    return Pair(P, Q, {}, {"window": window, "step_pattern": pattern})


def extremes(rng: np.random.Generator) -> Pair:
    d = rng.choice(DIMENSIONS)
    if rng.integers(2):  # one magnitude for all
        magnitudes = np.full(3, rng.choice(MAGNITUDES))
    else:
        magnitudes = rng.choice([*MAGNITUDES, 1.0, 0.0], 3)
    sides = (rng.integers(1, 25), rng.integers(1, 25))
    P, Q = (rng.uniform(-1, 1, (n, d)) * rng.choice(magnitudes, (n, d)) for n in sides)
    return random_pair(rng, P, Q)


FAMILIES = {
    "walks": (walks, 1000),
    "grids": (grids, 1000),
    "edges": (edges, 600),
    "bands": (bands, 50),
    "extremes": (extremes, 800),
}
CHUNK = 50


def pairs(family: str, chunk: int) -> Iterator[Pair]:
    draw, _ = FAMILIES[family]
    for number in range(chunk * CHUNK, (chunk + 1) * CHUNK):
        yield draw(np.random.default_rng([list(FAMILIES).index(family), number]))


def same(found: Array, expected: Array) -> bool:
    return found.dtype == expected.dtype and np.array_equal(found, expected)


def differences(pair: Pair) -> list[str]:
    """Return the names of the functions whose results differ from the reference's."""
    P, Q = pair.P, pair.Q
    found = []
    for name, options in (("frechet", pair.ground), ("dtw", {**pair.ground, **pair.warping})):
        path = getattr(curvewise, f"{name}_path")(P, Q, **options)
        table = getattr(curvewise, f"{name}_table")(P, Q, **options)
        distance = getattr(curvewise, name)(P, Q, **options)
        expected = getattr(reference, f"{name}_path")(P, Q, **options)
        if type(distance) is not float or distance != expected.distance:
            found.append(name)
        if path.distance != expected.distance or not same(path.path, expected.path):
            found.append(f"{name}_path")
        if not same(table, getattr(reference, f"{name}_table")(P, Q, **options)):
            found.append(f"{name}_table")
    return found


@pytest.mark.parametrize(
    ("family", "chunk"),
    [(name, chunk) for name, (_, count) in FAMILIES.items() for chunk in range(count // CHUNK)],
)
@pytest.mark.nightly("bands|[1-9]$|10$")  # by day the first of every family that is not slow
def test_distance_path_and_table_equal_the_reference(family: str, chunk: int) -> None:
    found = [(str(pair), names) for pair in pairs(family, chunk) if (names := differences(pair))]
    assert not found


def test_the_families_hold_at_least_2000_pairs() -> None:
    assert sum(count for _, count in FAMILIES.values()) >= 2000


def ground_distances(pair: Pair, path: npt.NDArray[np.int64]) -> Array:
    """Return d(P[i], Q[j]) along a path, the squares added in the order of coordinates."""
    P, Q = (curve.reshape(len(curve), -1) for curve in (pair.P, pair.Q))
    metric = pair.ground.get("metric", "euclidean")
    if metric == "minkowski":
        metric = {1: "cityblock", 2: "euclidean", np.inf: "chebyshev"}[pair.ground.get("p", 2)]
    delta = np.abs(P[path[:, 0]] - Q[path[:, 1]])
    squares = functools.reduce(np.add, (column * column for column in delta.T))
    by_metric: dict[str, Callable[[], Array]] = {
        "euclidean": lambda: np.sqrt(squares),
        "sqeuclidean": lambda: squares,
        "cityblock": lambda: functools.reduce(np.add, delta.T),
        "chebyshev": lambda: delta.max(axis=1),
    }
    return by_metric[metric]()


def path_faults(pair: Pair, path: npt.NDArray[np.int64], options: Options) -> list[str]:
    n, m = len(pair.P), len(pair.Q)
    steps = np.diff(path, axis=0)
    faults = []
    if path.dtype != np.int64 or path.ndim != 2 or path.shape[1] != 2:
        faults.append("shape or type")
    if not np.all((steps >= 0) & (steps <= 1)) or not np.all(steps.any(axis=1)):
        faults.append("steps")
    if path[0, 0] != 0 or (path[0, 1] != 0 and not options.get("open_begin")):
        faults.append("begin")
    if path[-1, 0] != n - 1 or (path[-1, 1] != m - 1 and not options.get("open_end")):
        faults.append("end")
    window = options.get("window")
    if window is not None and min(n, m) > 1:
        away = np.abs(path[:, 0] * (m - 1) - path[:, 1] * (n - 1))
        if int(away.max()) > int(window) * (max(n, m) - 1):
            faults.append("window")
    return faults


def cost_along(pair: Pair, path: npt.NDArray[np.int64]) -> float:
    """Return the sum, in path order, of step weight times ground distance."""
    costs = ground_distances(pair, path)
    diagonal = pair.warping.get("step_pattern") == "symmetric2"
    weights = 1.0 + diagonal * np.diff(path, axis=0).all(axis=1)
    total = float(costs[0])
    for term in weights * costs[1:]:
        total += float(term)
    return total


@pytest.mark.parametrize("family", ["walks", "grids", "edges", "bands"])
def test_the_path_attains_the_distance_to_the_bit(
    family: str, rounds: Callable[[int], int]
) -> None:
    chunks = range(rounds(min(6, FAMILIES[family][1] // CHUNK)))
    for pair in (pair for chunk in chunks for pair in pairs(family, chunk)):
        coupling = curvewise.frechet_path(pair.P, pair.Q, **pair.ground)
        assert path_faults(pair, coupling.path, {}) == [], pair
        assert ground_distances(pair, coupling.path).max() == coupling.distance, pair
        warping = curvewise.dtw_path(pair.P, pair.Q, **pair.ground, **pair.warping)
        assert path_faults(pair, warping.path, pair.warping) == [], pair
        assert cost_along(pair, warping.path) == warping.distance, pair


@pytest.mark.parametrize("family", ["walks", "extremes"])
def test_minkowski_agrees_to_rounding(family: str, rounds: Callable[[int], int]) -> None:
    orders = tuple({"metric": "minkowski", "p": p} for p in (3, 1.5, 7.25))
    draw, _ = FAMILIES[family]
    for number in range(rounds(60)):
        rng = np.random.default_rng([100, number])
        pair = draw(rng)
        P, Q, ground, warping = pair.P, pair.Q, orders[rng.integers(3)], pair.warping
        for name, options in (("frechet", ground), ("dtw", {**ground, **warping})):
            expected = getattr(reference, f"{name}_table")(P, Q, **options)
            table = getattr(curvewise, f"{name}_table")(P, Q, **options)
            np.testing.assert_allclose(table, expected, rtol=1e-12, atol=0, err_msg=str(pair))
            distance = getattr(curvewise, name)(P, Q, **options)
            assert getattr(curvewise, f"{name}_path")(P, Q, **options).distance == distance
            assert distance == pytest.approx(getattr(reference, name)(P, Q, **options), rel=1e-12)


def test_a_pair_on_which_geos_is_wrong() -> None:
    P = [(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)]
    Q = [(0, 4), (4, 4), (5, 1)]
    assert curvewise.frechet(P, Q) == reference.frechet(P, Q) == 5.0
