"""One nearest neighbour by DTW on packaged data sets: accuracy and time, next to aeon and tslearn.

    python benchmarks/speed/classification.py [--sets GunPoint ...] [--shares 0.1]

The data sets come with aeon and tslearn, so the script needs no network. Each classifier fits the
training part and predicts the test part, on one thread, without a window and with a window of each
share of the points. The script ends with an error if a prediction differs. The times are CPU times
of one call each, after a first call that compiles.
"""

from __future__ import annotations

import timing  # before numpy: it sets the number of threads

# isort: split
import argparse
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from aeon.classification.distance_based import KNeighborsTimeSeriesClassifier as OfAeon
from aeon.datasets import load_classification
from tslearn.datasets import CachedDatasets
from tslearn.neighbors import KNeighborsTimeSeriesClassifier as OfTslearn

import curvewise
import curvewise.sklearn

SETS = ("ACSF1", "ArrowHead", "BasicMotions", "GunPoint", "ItalyPowerDemand", "OSULeaf", "Trace")
Parts = tuple[Any, Any, Any, Any]


def parts_of(name: str) -> Parts:
    """Return known series and classes, and new series and classes; shape (k, n, d)."""
    if name == "Trace":
        found: Parts = CachedDatasets().load_dataset("Trace")
        return found
    known, new = (load_classification(name, split=part) for part in ("train", "test"))
    return known[0].swapaxes(1, 2), known[1], new[0].swapaxes(1, 2), new[1]


def classifiers(n: int, window: int | None) -> dict[str, tuple[Any, Callable[[Any], Any]]]:
    """Return each classifier, with the function that converts series to its input."""
    options = {"metric": "sqeuclidean", "window": window}
    share = {} if window is None else {"window": (window + 0.5) / n}
    band = {} if window is None else {"sakoe_chiba_radius": window}
    with_band = None if window is None else "sakoe_chiba"
    return {
        "curvewise": (
            curvewise.sklearn.CurveKNeighborsClassifier(1, options=options),
            np.ascontiguousarray,
        ),
        "aeon": (
            OfAeon(n_neighbors=1, distance="dtw", distance_params=share),
            lambda X: np.ascontiguousarray(X.swapaxes(1, 2)),
        ),
        "tslearn": (
            OfTslearn(
                1, metric="dtw", metric_params={"global_constraint": with_band, **band}, n_jobs=1
            ),
            np.ascontiguousarray,
        ),
    }


def row_of(name: str, share: float | None) -> list[str]:
    """Return a row of the table; compare the predictions."""
    known, y, new, z = parts_of(name)
    n = known.shape[1]
    window = None if share is None else int(share * n)
    predicted, seconds = {}, {}
    for package, (classifier, converted) in classifiers(n, window).items():
        classifier.fit(converted(known), y)
        asked = converted(new)
        classifier.predict(asked[:2])  # compiles
        begin = time.process_time()
        predicted[package] = np.asarray(classifier.predict(asked))
        seconds[package] = time.process_time() - begin
    for package, found in predicted.items():
        if not np.array_equal(found, predicted["curvewise"]):
            differ = np.count_nonzero(found != predicted["curvewise"])
            raise SystemExit(f"{package} predicts {differ} other classes: {name}, window {window}")
    own = seconds.pop("curvewise")
    return [
        name,
        f"{len(known)} / {len(new)}",
        f"{n} x {known.shape[2]}",
        "none" if window is None else str(window),
        f"{np.mean(predicted['curvewise'] == z):.4f}",
        f"{own:.3f}",
        *(f"{taken / own:.0f}" for taken in seconds.values()),
    ]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sets", nargs="+", default=list(SETS))
    parser.add_argument("--shares", type=float, nargs="*", default=[0.1])
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    rows = []
    for name in given.sets:
        for share in (None, *given.shares):
            rows.append(row_of(name, share))
            print("  ".join(rows[-1]), flush=True)
    header = ["set", "known / new", "points", "window", "accuracy", "curvewise s"]
    header += ["aeon", "tslearn"]
    timing.print_table("1-NN by DTW, times as multiples of curvewise's", header, rows)


if __name__ == "__main__":
    main()
