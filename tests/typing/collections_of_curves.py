"""A user's file with every collection of curves; `mypy --strict` and pyright must accept it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd

import curvewise
from curvewise.sklearn import CurveKMedoids, CurveKNeighborsClassifier

table = pd.DataFrame({"id": [1, 1, 2, 2], "x": [0.0, 1.0, 0.0, 2.0], "y": [0.0, 1.0, 1.0, 2.0]})
arrays = [np.array([[0.0, 1.0], [1, 2], [3, 2], [4, 5]]), np.array([[0.0, 1.0], [2, 1], [4, 4]])]


def generated() -> Iterator[npt.NDArray[np.float64]]:
    yield from arrays


groups = table.groupby("id")[["x", "y"]]
matrix: Any = curvewise.cdist(groups)
matrix = curvewise.pdist(groups, "frechet")
matrix = curvewise.cdist({label: group[["x", "y"]] for label, group in table.groupby("id")})
matrix = curvewise.cdist([group[["x", "y"]] for _, group in table.groupby("id")])
matrix = curvewise.cdist(dict(table.items()))
matrix = curvewise.cdist(pd.Series(arrays, index=["a", "b"]))
matrix = curvewise.cdist({"a": arrays[0], "b": arrays[1]}.values())
matrix = curvewise.cdist(map(np.asarray, arrays))

distances: npt.NDArray[np.float64] = curvewise.cdist(arrays)
distances = curvewise.cdist(tuple(arrays), generated())
distances = curvewise.pdist(curve for curve in arrays)
distances = curvewise.pdist(np.zeros((3, 4, 2), dtype=np.float32))
distances = curvewise.pdist(np.zeros((3, 4, 2), dtype=np.int64))
distances = curvewise.cdist([[1, 2, 3], [1, 2]])
distances = curvewise.cdist([[(0, 1), (2, 3)], [(0.5, 1)]])
distances = curvewise.cdist([np.arange(4), np.zeros(3, dtype=np.float32)])
for name in curvewise.available_measures():
    distances = curvewise.cdist(arrays, measure=name, cutoff=np.float64(3))

for curves in (groups, arrays, generated()):
    index = curvewise.Index(curves)
    found: Any = index.kneighbors(arrays, np.int64(1))
index.add(generated())
model = CurveKNeighborsClassifier(1).fit(arrays, ["a", "b"])
labels: Any = model.predict(generated())
labels = CurveKMedoids(2).fit_predict(arrays)
