"""sbd and derivative dtw on random pairs, against their definitions.

    python tests/stress/shapes_and_slopes.py --pairs 100000

Definitions are written out here, with numpy alone; with aeon installed, its distances count too.
"""

from __future__ import annotations

import argparse
from importlib.util import find_spec

import numpy as np

import curvewise
from curvewise.curves import derivative, z_normalized


def slopes(curve: np.ndarray) -> np.ndarray:
    before, here, after = curve[:-2], curve[1:-1], curve[2:]
    return ((here - before) + (after - before) / 2.0) / 2.0


def shape(P: np.ndarray, Q: np.ndarray) -> float:
    sums = sum(np.correlate(p, q, "full") for p, q in zip(P.T, Q.T, strict=True))
    return float(1.0 - np.max(sums) / (np.linalg.norm(P) * np.linalg.norm(Q)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    random = np.random.default_rng(given.seed)
    of_sbd = of_aeon = 0.0
    wrong = 0
    for count in range(given.pairs):
        n, m, d = (*random.integers(3, 60, 2).tolist(), int(random.integers(1, 5)))
        P, Q = random.normal(size=(n, d)).cumsum(axis=0), random.normal(size=(m, d)).cumsum(axis=0)
        of_sbd = max(of_sbd, abs(curvewise.sbd(P, Q) - shape(P, Q)))
        ours = curvewise.dtw(derivative(P), derivative(Q), metric="sqeuclidean")
        wrong += not np.array_equal(derivative(P), slopes(P))
        wrong += ours != curvewise.dtw(slopes(P), slopes(Q), metric="sqeuclidean")
        if count % 100 == 0 and find_spec("aeon") is not None:
            from aeon.distances import ddtw_distance, sbd_distance

            of_aeon = max(of_aeon, abs(ours / ddtw_distance(P.T, Q.T) - 1.0))
            p, q = P[:, 0], Q[:, 0]
            value = curvewise.sbd(z_normalized(p), z_normalized(q))
            of_aeon = max(of_aeon, abs(value - sbd_distance(p, q, standardize=True)))
    print(f"{given.pairs} pairs: sbd {of_sbd:.1e}, other slopes {wrong}, aeon {of_aeon:.1e}")
    assert max(of_sbd, of_aeon) < 1e-11
    assert wrong == 0


if __name__ == "__main__":
    main()
