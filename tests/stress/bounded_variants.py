"""An index, cutoffs and pruning against brute force: 10^5 pairs of random curves.

    python tests/stress/bounded_variants.py

The script tests every variant of dtw and frechet that has bounds, on the plane and on the globe. It
also tests hausdorff and edit distances, which do not. For groups of curves, it computes the nearest
5, all within a radius, and batches with a cutoff. It compares each with the table of all values
without pruning, with ==. The exit status is 1 if anything differs. Half a minute.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np

import curvewise

GLOBE = {"metric": "haversine"}
WINDOW = {"window": 6}
SYMMETRIC = {"step_pattern": "symmetric2"}
OPEN = {"open_begin": True, "open_end": True}
VARIANTS: list[tuple[Any, dict[str, Any]]] = [
    (measure, {"metric": metric})
    for measure in ("dtw", "frechet")
    for metric in ("euclidean", "sqeuclidean", "cityblock", "chebyshev", "haversine")
]
VARIANTS += [
    ("dtw", {**ground, **options})
    for ground in ({}, GLOBE)
    for options in (
        WINDOW,
        SYMMETRIC,
        {**SYMMETRIC, **WINDOW},
        {**SYMMETRIC, "normalize": True},
        OPEN,
        {"open_end": True},
    )
]
VARIANTS += [("hausdorff", GLOBE), ("lcss", {**GLOBE, "epsilon": 2e5}), ("erp", {})]
KEPT, ASKED, ROUNDS = 60, 20, 4


def curves(rng: np.random.Generator, count: int) -> list[Any]:
    """Make walks about a few centres, some on whole degrees, some about the line of 180."""
    centres = rng.uniform([-178, -60], [179, 60], size=(6, 2))
    centres[0, 0] = 179.5
    made = []
    for _ in range(count):
        n = int(rng.integers(1, 70))
        walk = rng.normal(scale=rng.choice([0.01, 0.3]), size=(n, 2)).cumsum(axis=0)
        curve = centres[rng.integers(6)] + walk
        made.append(np.clip(curve.round() if rng.random() < 0.3 else curve, [-360, -90], [360, 90]))
    return made


def differences(rng: np.random.Generator, measure: Any, options: dict[str, Any]) -> int:
    """Return how many answers differ from brute force."""
    kept, asked = curves(rng, KEPT), curves(rng, ASKED)
    whole = {**options, "prune": False} if measure in ("dtw", "frechet") else options
    table = curvewise.cdist(asked, kept, measure, **whole)
    wrong = int(not np.array_equal(table, curvewise.cdist(asked, kept, measure, **options)))
    cutoff = float(np.quantile(table, 0.3))
    cut = curvewise.cdist(asked, kept, measure, cutoff=cutoff, **options)
    wrong += int(not np.array_equal(cut, np.where(table <= cutoff, table, np.inf)))
    index = curvewise.Index(kept, measure, **options)
    distances, places = index.kneighbors(asked, n_neighbors=5)
    order = np.argsort(table, axis=1, kind="stable")
    wrong += int(not np.array_equal(places, order[:, :5]))
    wrong += int(not np.array_equal(distances, np.take_along_axis(table, order[:, :5], axis=1)))
    for row, ranks, near in zip(
        table, order, index.radius_neighbors(asked, cutoff)[1], strict=True
    ):
        wrong += int(not np.array_equal(near, ranks[row[ranks] <= cutoff]))
    return wrong


def main() -> int:
    """Compare all variants; return the exit status."""
    all_wrong = 0
    for number, (measure, options) in enumerate(VARIANTS):
        wrong = sum(
            differences(np.random.default_rng([number, k]), measure, options) for k in range(ROUNDS)
        )
        print(f"{measure:10s} {options}: {KEPT * ASKED * ROUNDS} pairs, {wrong} differ", flush=True)
        all_wrong += wrong
    print(f"{len(VARIANTS) * KEPT * ASKED * ROUNDS} pairs, {all_wrong} differ")
    return 1 if all_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
