"""k-Shape beside tslearn's KShape, from the same first centres.

    python tests/stress/k_shape.py --seeds 5

Needs tslearn and aeon, whose packages contain the data sets. tslearn stops when the sum of squared
distances rises, and curvewise when the sum of distances does not fall. Labels therefore differ for
some first centres. Both sums are printed.
"""

from __future__ import annotations

import argparse
import warnings
from pathlib import Path

import numpy as np
import tslearn
from aeon.datasets import load_classification
from tslearn.clustering import KShape

import curvewise
from curvewise.curves import z_normalized
from curvewise.many.shape_means import shape_distances

SETS = {"ItalyPowerDemand": 2, "ArrowHead": 3, "GunPoint": 2, "OSULeaf": 6, "Trace": 4}


def curves_of(name: str) -> np.ndarray:
    if name == "Trace":
        folder = Path(tslearn.__file__).parent / ".cached_datasets"
        X = np.load(folder / "Trace.npz")["X_train"][:, :, 0]
    else:
        X = load_classification(name, split="train")[0]
        X = X[:, 0]
    return np.array([z_normalized(x) for x in X])[:, :, np.newaxis]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=2)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    for name, count in SETS.items():
        X = curves_of(name)
        equal, sums = 0, []
        for seed in range(given.seeds):
            first = X[np.random.default_rng(seed).choice(len(X), count, replace=False)]
            theirs = KShape(count, init=first.copy()).fit(X)
            ours = curvewise.sklearn.CurveKMeans(
                count, measure="sbd", init=lambda X, n, random, first=first: list(first), n_init=1
            ).fit(X)
            equal += np.array_equal(ours.labels_, theirs.labels_)
            of_theirs = shape_distances(list(X), list(theirs.cluster_centers_)).min(axis=1).sum()
            sums.append(f"{ours.inertia_:.4f} ({of_theirs:.4f})")
        print(f"{name}: {equal} of {given.seeds} labels equal; sums {', '.join(sums)}", flush=True)


if __name__ == "__main__":
    main()
