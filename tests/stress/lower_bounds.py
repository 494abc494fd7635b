"""LB_Keogh, LB_Improved and LB_Kim of random pairs, against their definitions and against dtw.

    python tests/stress/lower_bounds.py --pairs 100000

With dtaidistance or tslearn installed, their LB_Keogh counts, too.
"""

from __future__ import annotations

import argparse
import warnings
from importlib.util import find_spec
from typing import get_args

import numpy as np

import curvewise
from curvewise import reference
from curvewise._options import BoundMetric


def drawn(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    n, m = random.integers(1, 40, 2).tolist()
    d = int(random.integers(1, 4))
    P, Q = random.normal(size=(n, d)).cumsum(axis=0), random.normal(size=(m, d)).cumsum(axis=0)
    kind = random.integers(5)
    if kind == 1:
        P, Q = np.round(P), np.round(Q)
    elif kind == 2:
        Q = P[random.integers(0, n, m)] * (1 + 2.0**-52 * random.integers(-2, 3, (m, d)))
    elif kind == 3:
        P, Q = 1e12 + P, 1e12 + Q
    elif kind == 4:
        power = int(random.integers(-1070, 500))
        P, Q = np.ldexp(P, power), np.ldexp(Q, power)
    return P, Q


def of_peers(P: np.ndarray, Q: np.ndarray, window: int) -> float:
    """Return the largest difference from other packages, for curves of equal lengths."""
    ours = np.sqrt(curvewise.lb_keogh(P, Q, metric="sqeuclidean", window=window))
    others = []
    if find_spec("dtaidistance") is not None:
        from dtaidistance.dtw import lb_keogh

        others.append(lb_keogh(P[:, 0], Q[:, 0], window=window + 1))
    if find_spec("tslearn") is not None:
        from tslearn.metrics import lb_keogh as of_tslearn

        others.append(of_tslearn(P, Q, radius=window))
    return max((abs(ours - theirs) / max(ours, 1.0) for theirs in others), default=0.0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    random = np.random.default_rng(given.seed)
    warnings.simplefilter("ignore", curvewise.LayoutWarning)
    above = other = 0
    of_rounding = peers = 0.0
    for count in range(given.pairs):
        P, Q = drawn(random)
        metric = random.choice(get_args(BoundMetric))
        window = random.choice([None, 1, 3, 9])
        value = curvewise.dtw(P, Q, metric=metric, window=window)
        named = {"metric": metric, "window": window}
        for name in ("lb_keogh", "lb_kim", "lb_improved"):
            if name == "lb_improved" and P.shape[1] > 1 and metric in ("euclidean", "chebyshev"):
                continue
            options = {"metric": metric} if name == "lb_kim" else named
            bound = getattr(curvewise, name)(P, Q, **options)
            above += not 0.0 <= bound <= value
            if np.abs(P).max() > 1e-100 and np.abs(P).max() < 1e100:  # the reference's range
                expected = getattr(reference, name)(P, Q, **options)
                if name == "lb_improved":
                    of_rounding = max(of_rounding, abs(bound - expected) / max(expected, 1e-300))
                else:
                    other += bound != expected
        if count % 50 == 0:
            p, q = random.normal(size=(2, 30, 1)).cumsum(axis=1)
            peers = max(peers, of_peers(p, q, int(random.integers(1, 9))))
    print(
        f"{given.pairs} pairs: above dtw {above}, not the definition {other}, lb_improved "
        f"{of_rounding:.1e}, other packages {peers:.1e}"
    )
    assert above == other == 0
    assert of_rounding < 1e-12
    assert peers < 1e-12


if __name__ == "__main__":
    main()
