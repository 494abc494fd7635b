"""An index of z-normalised curves, as the page on nearest curves makes it, against brute force."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise.curves import z_normalized

Array = npt.NDArray[np.float64]


def curves(seed: int, count: int, dim: int) -> list[Array]:
    """Return shapes of five kinds at any level and scale, some constant, some in a coordinate."""
    rng = np.random.default_rng(seed)
    shapes = np.random.default_rng(0).normal(size=(5, 60, dim)).cumsum(axis=1)
    made = []
    for i in range(count):
        points = 30 + int(rng.integers(30))
        shape = shapes[i % 5, :points] + rng.normal(size=(points, dim)) / 5
        made.append(shape * 10.0 ** rng.uniform(-8, 3) + 10.0 ** rng.uniform(-3, 5))
    made[3][:] = made[3][0]
    made[4][:, 0] = -1e9
    return [curve[:, 0].copy() for curve in made] if dim == 1 else made


@pytest.mark.parametrize("dim", [1, 2])
@pytest.mark.parametrize(
    ("measure", "options"),
    [
        ("dtw", {}),
        ("dtw", {"metric": "sqeuclidean", "window": 0.2}),
        ("frechet", {}),
        ("frechet_continuous", {}),
        ("msm", {}),
    ],
)
def test_neighbours_are_those_of_all_normalised_curves(
    measure: str, options: dict[str, Any], dim: int
) -> None:
    known, asked = curves(1, 40, dim), curves(2, 6, dim)
    index = curvewise.Index([z_normalized(curve) for curve in known[:30]], measure, **options)
    index.add([z_normalized(curve) for curve in known[30:]])
    distances, places = index.kneighbors([z_normalized(curve) for curve in asked], 7)
    function = getattr(curvewise, measure)
    for P, found, where in zip(asked, distances, places, strict=True):
        values = [function(z_normalized(P), z_normalized(Q), **options) for Q in known]
        order = np.argsort(values, kind="stable")[:7]
        assert where.tolist() == order.tolist()
        assert found.tolist() == [values[j] for j in order]


def test_the_nearest_window_is_the_run_that_subsequence_finds() -> None:
    (P, Q) = (
        np.random.default_rng(seed).normal(size=n).cumsum() for seed, n in ((1, 30), (2, 300))
    )
    windows = [z_normalized(window) for window in np.lib.stride_tricks.sliding_window_view(Q, 30)]
    index = curvewise.Index(windows, "dtw", window=3)
    ((distance,),), ((place,),) = index.kneighbors([z_normalized(P)], 1)
    (run,) = curvewise.subsequence(P, Q, window=3, normalize=True)
    assert (distance, place) == (run.distance, run.start)


def test_the_option_normalize_is_that_of_dtw() -> None:
    P, *known = curves(3, 6, 1)
    options: dict[str, Any] = {"step_pattern": "symmetric2", "normalize": True}
    ((distance,),), ((place,),) = curvewise.Index(known, "dtw", **options).kneighbors([P], 1)
    assert distance == curvewise.dtw(P, known[place], **options)
