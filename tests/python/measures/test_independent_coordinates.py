"""dtw with dependent=False: the sum over the coordinates, each with a path of its own."""

from __future__ import annotations

import numpy as np
import pytest

import curvewise
from curvewise import reference

RANDOM = np.random.default_rng(57)
OPTIONS = [
    {},
    {"metric": "sqeuclidean", "window": 0.4},
    {"metric": "minkowski", "p": 3.0},
    {"step_pattern": "symmetric2", "normalize": True},
    {"penalty": 0.5, "open_end": True, "step_pattern": "symmetric2"},
    {"relax": (1, 0, 2, 1)},
    {"closed": True},
]


@pytest.mark.parametrize("d", [1, 2, 3, 4, 7])
@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_it_is_the_sum_over_the_coordinates(options: dict, d: int) -> None:
    P, Q = RANDOM.normal(size=(9, d)), RANDOM.normal(size=(11, d))
    right = 0.0
    for c in range(d):
        right += curvewise.dtw(P[:, c], Q[:, c], **options)
    found = curvewise.dtw(P, Q, dependent=False, **options)
    assert found == right == pytest.approx(reference.dtw(P, Q, dependent=False, **options))
    if d == 1:
        assert found == curvewise.dtw(P, Q, **options)
    assert curvewise.cdist([P], [Q], "dtw", dependent=False, **options).tolist() == [[found]]


def test_it_is_at_most_the_dependent_value_of_city_blocks() -> None:
    P, Q = RANDOM.normal(size=(30, 3)), RANDOM.normal(size=(20, 3))
    options = {"metric": "cityblock"}
    assert curvewise.dtw(P, Q, dependent=False, **options) < curvewise.dtw(P, Q, **options)


def test_a_cutoff_holds_for_the_sum() -> None:
    P, Q = RANDOM.normal(size=(9, 2)), RANDOM.normal(size=(9, 2))
    value = curvewise.dtw(P, Q, dependent=False)
    assert curvewise.dtw(P, Q, dependent=False, cutoff=value) == value
    assert curvewise.dtw(P, Q, dependent=False, cutoff=np.nextafter(value, 0)) == np.inf
    with pytest.raises(ValueError, match="cutoff is -1"):
        curvewise.dtw(P, Q, dependent=False, cutoff=-1.0)


def test_a_coordinate_above_the_cutoff_counts_where_others_may_be_negative() -> None:
    pattern = curvewise.StepPattern([(1, 1, 1, -1), (1, 0, 0, -2)])  # the distance counts negative
    P, Q = np.array([[5.0, 0.0], [1.0, 9.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])
    parts = [curvewise.dtw(P[:, c], Q[:, c], step_pattern=pattern) for c in (0, 1)]
    total = curvewise.dtw(P, Q, dependent=False, step_pattern=pattern, cutoff=sum(parts))
    assert total == sum(parts)
    assert min(parts) < 0


def test_many_curves() -> None:
    curves = [RANDOM.normal(size=(n, 2)) for n in (5, 8, 6)]
    square = curvewise.cdist(curves, dependent=False)
    assert square[0, 1] == curvewise.dtw(curves[0], curves[1], dependent=False)
    assert (
        curvewise.pdist(curves, dependent=False).tolist() == square[np.triu_indices(3, 1)].tolist()
    )
    holes = [np.vstack([curve, [np.nan, 0.0]]) for curve in curves]
    with pytest.warns(UserWarning, match="nan"):
        assert (curvewise.cdist(holes, dependent=False, missing="skip") == square).all()


@pytest.mark.parametrize("module", [curvewise, reference])
def test_metrics_of_whole_points_are_refused(module) -> None:
    track = [[0.0, 0.0], [1.0, 1.0]]
    with pytest.raises(ValueError, match=r"each coordinate alone, unlike metric='haversine'; give"):
        module.dtw(track, track, metric="haversine", dependent=False)
    with pytest.raises(ValueError, match=r"each coordinate alone, unlike a user-defined metric"):
        module.dtw(track, track, metric=np.zeros((2, 2)), dependent=False)
    with pytest.raises(ValueError, match="same number of coordinates"):
        module.dtw(track, [[0.0, 0.0, 0.0]], dependent=False)
    with pytest.raises(TypeError, match="no option 'dependent'"):
        curvewise.cdist([track], measure="frechet", dependent=False)
