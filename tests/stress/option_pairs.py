"""Options against their definitions: python tests/stress/option_pairs.py [pairs] [seed].

Each kind of option is drawn `pairs` times: areas of closed curves against every beginning of Q, the
areas of polygons and of functions of x against fractions, points that are skipped against curves
without them, relaxed and open ends against the best of all sections, common parts against all
sections, and independent coordinates against a table for each. Every hundredth pair has sizes
across the strips of the kernels. A tenth of the pairs is drawn for frechet_continuous of closed
curves, against decisions in whole numbers (up to 7 points) and against open curves from beginnings
that cover all of Q (up to 12 points). A hundredth of the pairs is drawn for the Hausdorff distance
of lines, in 40 digits (mpmath). CURVEWISE_ISA chooses the level. 100,000 pairs take about an hour.
Then the script prints times, next to those without the option.
"""

from __future__ import annotations

import contextlib
import importlib
import math
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import curvewise
from curvewise.installation import build_info

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python" / "measures"))
closed_area = importlib.import_module("test_closed_area")
function_area = importlib.import_module("test_function_area")
hausdorff = importlib.import_module("test_hausdorff_continuous")
closed_continuous = importlib.import_module("test_closed_continuous")
relaxed = importlib.import_module("test_relax")
whole_numbers = importlib.import_module("curvewise.reference.frechet_continuous")

Array = npt.NDArray[np.float64]
Rng = np.random.Generator
METRICS = ("euclidean", "sqeuclidean", "cityblock", "chebyshev")


def curves(rng: Rng, least: int = 1, most: int = 9, dim: int = 2) -> tuple[Array, Array]:
    """Return normal curves, or curves of halves with ties; sometimes long ones."""
    if rng.integers(100) == 0:
        most = min(260, 30 * most)
    P, Q = (rng.normal(size=(int(rng.integers(least, most + 1)), dim)) for _ in range(2))
    return (np.rint(2 * P) / 2, np.rint(2 * Q) / 2) if rng.integers(2) else (P, Q)


def of_all_beginnings(rng: Rng) -> bool:
    P, Q = curves(rng, least=2, most=8)
    options = {
        "closed": True,
        "spacing": str(rng.choice(["distance", "x", "arc_length"])),
        "crossing": str(rng.choice(["rearrange", "split"])),
        "squared": bool(rng.integers(2)),
    }
    expected = closed_area.from_every_point(P, Q, **options)
    return bool(curvewise.area(P, Q, **options) == expected)


def of_polygons(rng: Rng) -> bool:
    size = 9 if rng.integers(100) == 0 else 5
    P, Q = (rng.normal(size=(int(rng.integers(2, size + 1)), 2)) for _ in range(2))
    if rng.integers(2):
        P, Q = np.rint(2 * P), np.rint(2 * Q)
    expected = float(closed_area.exact(P, Q))
    value = curvewise.area(P, Q, closed=True, crossing="polygon")
    return math.isclose(value, expected, rel_tol=1e-12, abs_tol=1e-13)


def of_functions(rng: Rng) -> bool:
    size = 70 if rng.integers(1000) == 0 else 6
    P, Q = (function_area.function(rng, int(rng.integers(2, size + 1))) for _ in range(2))
    low, high = (f(end(C[:, 0]) for C in (P, Q)) for f, end in ((max, np.min), (min, np.max)))
    if not low < high:
        return True
    squared = bool(rng.integers(2))
    expected = float(function_area.exact(P, Q, squared))
    value = curvewise.area(P, Q, spacing="function", squared=squared)
    size_of_y = max(np.abs(P[:, 1]).max(), np.abs(Q[:, 1]).max())
    room = 1e-15 * size_of_y * math.sqrt(expected + size_of_y)
    return abs(value - expected) <= 1e-13 * expected + room


SKIPPED: list[tuple[str, dict[str, Any], int]] = [
    *(("dtw", {"metric": metric}, 1) for metric in METRICS),
    ("frechet", {}, 1),
    *((name, {}, 1) for name in ("erp", "edr", "lcss", "msm", "twe", "wdtw")),
    ("area", {"crossing": "split"}, 2),
    ("area", {"closed": True, "crossing": "polygon"}, 2),
    *((name, {}, 1) for name in ("sum_of_squares", "mse", "mae")),
]


def of_gaps(rng: Rng) -> bool:
    name, options, least = SKIPPED[rng.integers(len(SKIPPED))]
    measure = getattr(curvewise, name)
    P, Q = curves(rng, least=least, most=12)
    pointwise = least == 1 and name in ("sum_of_squares", "mse", "mae")
    if pointwise:
        Q = rng.normal(size=P.shape)
    with_gaps, without = [], []
    for points in (P, Q):
        lost = rng.uniform(size=len(points)) < 0.3
        lost[:least] = False
        with_gaps.append(
            np.where(lost[:, np.newaxis] & (rng.uniform(size=2) < 0.7), np.nan, points)
        )
        without.append(with_gaps[-1][~np.isnan(with_gaps[-1]).any(axis=1)])
    if pointwise:
        kept = ~np.isnan(with_gaps[0] + with_gaps[1]).any(axis=1)
        without = [C[kept] for C in with_gaps]
    value, expected = measure(*with_gaps, missing="skip", **options), measure(*without, **options)
    return bool(value == expected)


def of_relaxed_ends(rng: Rng) -> bool:
    P, Q = curves(rng)
    relax = tuple(map(int, rng.integers(0, 4, 4)))
    options = {"metric": METRICS[rng.integers(4)], "penalty": float(rng.choice([0.0, 0.5]))}
    expected = relaxed.least_over_parts(P, Q, relax, **options)
    return math.isclose(curvewise.dtw(P, Q, relax=relax, **options), expected, rel_tol=1e-12)


def of_open_ends(rng: Rng) -> bool:
    """Compare with the least over all sections of Q."""
    P, Q = curves(rng, most=7)
    pattern = str(rng.choice(["symmetric1", "asymmetric", "symmetric2", "symmetricP1"]))
    options: dict[str, Any] = {"step_pattern": pattern, "metric": METRICS[rng.integers(4)]}
    begin, end = bool(rng.integers(2)), bool(rng.integers(2))
    if pattern.startswith("symmetric") and pattern != "symmetric1":  # sections by their weights
        options["normalize"] = True
        begin, end = False, True
    starts = range(len(Q)) if begin else [0]
    stops = range(1, len(Q) + 1) if end else [len(Q)]
    expected = math.inf
    for first, last in ((i, j) for i in starts for j in stops if i < j):
        with contextlib.suppress(ValueError):  # no path
            expected = min(expected, curvewise.dtw(P, Q[first:last], **options))
    if expected == math.inf:
        return True
    value = curvewise.dtw(P, Q, open_begin=begin, open_end=end, **options)
    return math.isclose(value, expected, rel_tol=1e-12)


def of_independent_coordinates(rng: Rng) -> bool:
    P, Q = curves(rng, dim=int(rng.integers(1, 5)))
    metric, weight = METRICS[rng.integers(4)], int(rng.integers(1, 3))
    radius = int(rng.integers(1, 6)) if rng.integers(2) else None
    penalty = float(rng.choice([0.0, 0.5]))
    expected = 0.0
    for x, y in zip(P.T.tolist(), Q.T.tolist(), strict=True):
        costs = [[(a - b) ** 2 if metric == "sqeuclidean" else abs(a - b) for b in y] for a in x]
        expected += of_costs(costs, weight, penalty, radius)
    options: dict[str, Any] = {"metric": metric, "window": radius, "penalty": penalty}
    options |= {"step_pattern": f"symmetric{weight}", "dependent": False}
    return math.isclose(curvewise.dtw(P, Q, **options), expected, rel_tol=1e-12)


def of_costs(costs: list[list[float]], weight: int, penalty: float, radius: int | None) -> float:
    """Return dtw of a table of distances, by its definition."""
    n, m = len(costs), len(costs[0])
    reach = math.inf if radius is None or 1 in (n, m) else radius * (max(n, m) - 1)
    before = [math.inf] * m
    for i, row in enumerate(costs):
        here = [math.inf] * m
        for j, cost in enumerate(row):
            if abs(i * (m - 1) - j * (n - 1)) > reach:
                continue
            diagonal = before[j - 1] if j else math.inf
            beside = min(before[j], here[j - 1] if j else math.inf)
            least = min(beside + cost + penalty, diagonal + weight * cost)
            here[j] = cost if i == j == 0 else least
        before = here
    return before[-1]


def of_common_parts(rng: Rng) -> bool:
    """Compare with all pairs of sections."""
    n, m = map(int, rng.integers(1, 6, 2))
    P, Q = rng.integers(0, 4, (n, 2)) / 2.0, rng.integers(0, 4, (m, 2)) / 2.0
    metric, distance = METRICS[2 + rng.integers(2)], float(rng.integers(0, 4)) / 2
    edges = [curvewise.dtw(P[i : i + 1], P[i + 1 : i + 2], metric=metric) for i in range(n - 1)]
    found = curvewise.common_part(P, Q, distance, metric=metric)
    expected = -1.0
    for i in range(n):
        for k in range(i + 1, n + 1):
            for j in range(m):
                for last in range(j + 1, m + 1):
                    if curvewise.frechet(P[i:k], Q[j:last], metric=metric) <= distance:
                        expected = max(expected, sum(edges[i : k - 1]))
    if expected < 0.0:
        return len(P[found.of_p]) == len(Q[found.of_q]) == 0
    near = curvewise.frechet(P[found.of_p], Q[found.of_q], metric=metric) <= distance
    return near and found.length == expected == sum(edges[found.of_p][: len(P[found.of_p]) - 1])


def of_decisions_around(rng: Rng) -> bool:
    """Compare with decisions in whole numbers, with the value and with the double below it."""
    P, Q = (C[:7] for C in curves(rng, most=7, dim=int(rng.integers(1, 4))))
    low, value = curvewise.frechet_continuous(P, Q, closed=True, bounds=True)
    below = math.nextafter(value, 0.0)
    suffices = [whole_numbers._leads_around(P, Q, radius) for radius in (below, value)]
    is_exact = value == 0 or not whole_numbers._leads_around(P, Q, value, strictly=True)
    return suffices == [value == 0, True] and low == (value if is_exact else below)


def of_beginnings_between_points(rng: Rng) -> bool:
    """Compare with open curves: from where the matching begins, and from places all over Q.

    With another beginning, the distance changes by no more than the way between the two.
    """
    size, dim = int(rng.integers(3, 13)), int(rng.integers(1, 4))
    P, Q = (rng.normal(size=(n, dim)) for n in (size, int(rng.integers(3, 13))))
    value = curvewise.frechet_continuous(P, Q, closed=True)
    found = curvewise.frechet_continuous_path(P, Q, closed=True)
    once = np.concatenate([P, P[:1]])

    def is_within(begin: float, distance: float) -> bool:
        place = closed_continuous.points_at(np.concatenate([Q, Q[:1]]), np.array([begin]))
        turned = np.roll(Q, -int(begin) - 1, axis=0)
        return curvewise.frechet_within(once, np.concatenate([place, turned, place]), distance)

    def is_above(first: float, last: float, way: float) -> bool:
        """Return whether the distance is above 0.98 of the value from all of a part of an edge."""
        middle = (first + last) / 2
        if not is_within(middle, 0.98 * value + way / 2):
            return True
        if way < 0.01 * value:
            return False
        return is_above(first, middle, way / 2) and is_above(middle, last, way / 2)

    attained = is_within(found.parameters[0, 1] % len(Q), value * (1 + 1e-12))
    edges = np.linalg.norm(np.roll(Q, -1, axis=0) - Q, axis=1).tolist()
    return attained and all(is_above(j, j + 1.0 - 1e-15, way) for j, way in enumerate(edges))


def of_lines(rng: Rng) -> bool:
    from mpmath import mp

    dim, seed = int(rng.integers(1, 4)), int(rng.integers(10**9))
    P, Q = hausdorff.drawn(seed, 1 + seed % 4, 1 + seed // 4 % 4, dim)
    with mp.workdps(40):
        right = hausdorff.farthest_in_many_digits(P, Q, mp)
    room = hausdorff.ULPS * hausdorff.largest(P, Q)
    return bool(abs(curvewise.hausdorff_continuous(P, Q, directed=True) - right) <= room)


KINDS: dict[str, tuple[Callable[[Rng], bool], float]] = {
    "area, closed": (of_all_beginnings, 1.0),
    "area, closed, polygon": (of_polygons, 1.0),
    "area, function": (of_functions, 1.0),
    "missing": (of_gaps, 1.0),
    "relax": (of_relaxed_ends, 1.0),
    "open ends": (of_open_ends, 1.0),
    "common_part": (of_common_parts, 1.0),
    "dtw, not dependent": (of_independent_coordinates, 1.0),
    "frechet_continuous, closed, in whole numbers": (of_decisions_around, 0.1),
    "frechet_continuous, closed, all beginnings": (of_beginnings_between_points, 0.1),
    "hausdorff_continuous, 40 digits": (of_lines, 0.01),
}


def wrong_pairs(pairs: int, seed: int) -> int:
    warnings.simplefilter("ignore")
    wrong = 0
    for number, (name, (is_right, share)) in enumerate(KINDS.items()):
        rng = np.random.default_rng([seed, number])
        count, bad = max(1, round(share * pairs)), 0
        for pair in range(count):
            state = rng.bit_generator.state
            if not is_right(rng):
                bad += 1
                print(f"{name}, pair {pair}: {state['state']}")
        print(f"{name}: {count} pairs, {bad} wrong", flush=True)
        wrong += bad
    return wrong


def milliseconds(measure: Callable[..., Any], *given: Any, **options: Any) -> float:
    """Return the processor time of a call, the least of five."""
    times = []
    for _ in range(5):
        begun = time.process_time()
        measure(*given, **options)
        times.append(1e3 * (time.process_time() - begun))
    return min(times)


def print_times(n: int, rng: Rng) -> None:
    """Print times of loops and functions of n and 0.9 n points, without and with each option."""
    turns = [np.linspace(0, 2 * np.pi, size, endpoint=False) for size in (n, 9 * n // 10)]
    P, Q = (np.column_stack([np.cos(t), np.sin(2 * t)]) for t in turns)
    Q = np.roll(Q, n // 3, axis=0) + rng.normal(0, 0.01, Q.shape)
    F, G = (np.column_stack([t, np.sin(t)]) for t in turns)
    gaps = np.where(rng.uniform(size=(n, 1)) < 0.1, np.nan, P)
    area, dtw = curvewise.area, curvewise.dtw
    polygon: dict[str, Any] = {"closed": True, "crossing": "polygon"}
    open_ends = {"open_begin": True, "open_end": True}
    print(
        f"{n} points, ms of processor: area {milliseconds(area, P, Q):.3f}, "
        f"closed {milliseconds(area, P, Q, closed=True):.3f}, "
        f"polygon {milliseconds(area, P, Q, **polygon):.3f}, "
        f"of x {milliseconds(area, F, G):.3f}, function "
        f"{milliseconds(area, F, G, spacing='function'):.3f}; "
        f"dtw {milliseconds(dtw, P, Q):.3f}, "
        f"skip {milliseconds(dtw, gaps, Q, missing='skip'):.3f}, "
        f"relax {milliseconds(dtw, P, Q, relax=(5, 5, 5, 5)):.3f}, "
        f"open ends {milliseconds(dtw, P, Q, **open_ends):.3f}; "
        f"hausdorff {milliseconds(curvewise.hausdorff, P, Q):.3f}, "
        f"of lines {milliseconds(curvewise.hausdorff_continuous, P, Q):.3f}; "
        f"frechet, whole table {milliseconds(curvewise.frechet, P, Q, prune=False):.3f}, "
        f"common_part {milliseconds(curvewise.common_part, P, Q, 0.05):.3f}"
    )


if __name__ == "__main__":
    pairs, seed = (*map(int, sys.argv[1:]), *(100_000, 0)[len(sys.argv) - 1 :])
    print(f"level {build_info()['active']}")
    found = wrong_pairs(pairs, seed)
    for n in (100, 1000):
        print_times(n, np.random.default_rng(seed))
    sys.exit(found > 0)
