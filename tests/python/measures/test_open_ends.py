"""Open ends of dtw with every step pattern: by all parts, by R's dtw, and by the reference."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import StepPattern, reference
from curvewise._options import StepPatternName

NAMES = [name for name in get_args(StepPatternName) if name != "symmetric1"]
PER = {name: StepPattern.named(name).normalization for name in NAMES}
BY_ROWS = [name for name in NAMES if PER[name] == "N"]
WEIGHTED = [name for name in NAMES if PER[name] != "NA"]
ENDS = [{"open_end": True}, {"open_begin": True}, {"open_begin": True, "open_end": True}]

# dtw-python 1.9.0, open.end=TRUE: distance, normalised distance, and the last index of C.
A = np.array([0.0, 1.0, 3.0, 2.5, 4.0, 6.0, 5.0, 5.5])
C = np.array([7.0, 1.0, 0.5, 0.0, 2.0, 4.0, 3.0, 5.0, 6.5, 5.0, 5.0, 9.0, 2.0, 6.0])
OF_R: dict[str, tuple[float, float, int]] = {
    "symmetric2": (14.5, 0.7631578947368421, 10),
    "asymmetric": (10.5, 1.3125, 7),
    "symmetricP0": (14.5, 0.7631578947368421, 10),
    "symmetricP05": (15.0, 0.7894736842105263, 10),
    "symmetricP1": (19.0, 1.0, 10),
    "symmetricP2": (23.0, 1.2105263157894737, 10),
    "asymmetricP0": (9.5, 1.1875, 9),
    "asymmetricP05": (10.666666666666668, 1.3333333333333335, 9),
    "asymmetricP1": (12.0, 1.5, 9),
    "asymmetricP2": (13.833333333333332, 1.7291666666666665, 10),
    "typeIc": (11.5, 1.4375, 9),
    "typeId": (19.0, 1.0, 10),
    "typeIcs": (12.0, 1.5, 9),
    "typeIds": (19.5, 1.0263157894736843, 10),
    "typeIIc": (10.0, 1.25, 10),
    "typeIId": (15.5, 0.8157894736842105, 10),
    "typeIIIc": (10.5, 1.3125, 9),
    "typeIVc": (9.5, 1.1875, 9),
    "rigid": (18.5, 2.3125, 7),
    "mori2006": (28.0, 2.5454545454545454, 10),
}
# The same with open.begin=TRUE and both, for the pattern whose steps all go by one row.
ASYMMETRIC_OF_R = [(8.0, 1.0, 12, 13), (3.5, 0.4375, 3, 9)]


def curves(seed, n, m, dim):
    rng = np.random.default_rng(seed)
    return rng.integers(0, 9, (n, dim)) / 2, rng.integers(0, 9, (m, dim)) / 2


@pytest.mark.parametrize("name", OF_R)
def test_open_ends_are_those_of_r(name):
    distance, normalized, last = OF_R[name]
    options = {"step_pattern": name, "open_end": True}
    assert curvewise.dtw(A, C, **options) == pytest.approx(distance, rel=1e-12)
    assert curvewise.dtw(A, C, **options, normalize=True) == pytest.approx(normalized, rel=1e-12)
    path = curvewise.dtw_path(A, C, **options).path
    assert path[0].tolist() == [0, 0]
    assert path[-1].tolist() == [7, last]


@pytest.mark.parametrize(
    ("ends", "right"), [(ENDS[1], ASYMMETRIC_OF_R[0]), (ENDS[2], ASYMMETRIC_OF_R[1])]
)
def test_open_beginnings_are_those_of_r(ends, right):
    options = {"step_pattern": "asymmetric", **ends}
    path = curvewise.dtw_path(A, C, **options).path
    found = (
        curvewise.dtw(A, C, **options),
        curvewise.dtw(A, C, **options, normalize=True),
        path[0, 1],
        path[-1, 1],
    )
    assert found == right


def test_all_patterns_with_a_weight_are_tested():
    assert sorted(OF_R) == sorted(WEIGHTED)
    assert "asymmetric" in BY_ROWS
    assert len(BY_ROWS) >= 9


@pytest.mark.parametrize("name", ["symmetric1", "symmetric2", "asymmetricP05", "asymmetric"])
def test_a_beginning_of_a_record_matches(name):
    P, Q = [0.0, 1, 2, 3], [0.0, 1, 2, 3, 9, 9]
    found = curvewise.dtw_path(P, Q, step_pattern=name, open_end=True)
    assert found.distance == 0.0
    assert found.path.tolist() == [[i, i] for i in range(4)]
    np.testing.assert_array_equal(found.warped(P), [0, 1, 2, 3, np.nan, np.nan])


@settings(max_examples=25)
@given(
    name=st.sampled_from(BY_ROWS),
    seed=st.integers(0, 9999),
    n=st.integers(1, 7),
    m=st.integers(1, 9),
    ends=st.sampled_from(ENDS),
    penalty=st.sampled_from([0.0, 0.5]),
)
def test_patterns_by_rows_take_the_cheapest_part(name, seed, n, m, ends, penalty):
    P, Q = curves(seed, n, m, 2)
    options = {"step_pattern": name, "penalty": penalty}
    firsts = range(m) if "open_begin" in ends else [0]
    lasts = range(m) if "open_end" in ends else [m - 1]
    parts = [
        curvewise.dtw(P, Q[first : last + 1], **options)
        for first in firsts
        for last in lasts
        if first <= last
    ]
    value = curvewise.dtw(P, Q, **options, **ends)
    assert value == pytest.approx(min(parts), rel=1e-12)
    assert curvewise.dtw(P, Q, **options, **ends, normalize=True) == value / n


@settings(max_examples=25)
@given(
    name=st.sampled_from(WEIGHTED),
    seed=st.integers(0, 9999),
    n=st.integers(1, 7),
    m=st.integers(1, 9),
)
def test_an_open_end_is_where_the_cost_by_weight_is_least(name, seed, n, m):
    P, Q = curves(seed, n, m, 2)
    options = {"step_pattern": name, "normalize": True}
    parts = [curvewise.dtw(P, Q[: last + 1], **options) for last in range(m)]
    value = curvewise.dtw(P, Q, **options, open_end=True)
    assert value == pytest.approx(min(parts), rel=1e-12)
    for cutoff in (value, 0.999 * value):
        expected = value if value <= cutoff else np.inf
        assert curvewise.dtw(P, Q, **options, open_end=True, cutoff=cutoff) == expected


@pytest.mark.parametrize("name", WEIGHTED)
@settings(max_examples=2)
@given(
    seed=st.integers(0, 9999),
    size=st.sampled_from([(1, 1), (1, 9), (9, 1), (17, 23), (30, 8), (258, 13)]),
    ends=st.sampled_from(ENDS),
    metric=st.sampled_from(["euclidean", "sqeuclidean", "cityblock"]),
    dim=st.sampled_from([1, 2, 3]),
    penalty=st.sampled_from([0.0, 0.3]),
)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_values_paths_and_tables_are_those_of_the_reference(
    name, seed, size, ends, metric, dim, penalty
):
    if name not in BY_ROWS:
        ends = {"open_end": True}
    P, Q = curves(seed, *size, dim)
    options = {"step_pattern": name, "metric": metric, "penalty": penalty, **ends}
    assert curvewise.dtw(P, Q, **options) == reference.dtw(P, Q, **options)
    both = [module.dtw(P, Q, **options, normalize=True) for module in (curvewise, reference)]
    assert both[0] == both[1]
    found, right = (module.dtw_path(P, Q, **options) for module in (curvewise, reference))
    assert found.distance == right.distance
    np.testing.assert_array_equal(found.path, right.path)
    tables = [module.dtw_table(P, Q, **options) for module in (curvewise, reference)]
    np.testing.assert_array_equal(*tables)
    if found.distance < np.inf:
        assert found.distance == tables[0][-1, found.path[-1, 1]]


@pytest.mark.parametrize("ends", ENDS)
def test_long_paths_are_found_in_parts(ends):
    rng = np.random.default_rng(5)
    Q = rng.normal(size=3000).cumsum()
    P = Q[400:2400] + 0.01 * rng.normal(size=2000)
    options = {"step_pattern": "asymmetric", **ends}
    found = curvewise.dtw_path(P, Q, **options)
    costs = np.abs(P[found.path[:, 0]] - Q[found.path[:, 1]])
    assert found.distance == curvewise.dtw(P, Q, **options) == np.add.accumulate(costs)[-1]
    np.testing.assert_array_equal(found.path[:, 0], np.arange(2000))
    steps = np.diff(found.path[:, 1])
    assert steps.min() >= 0
    assert steps.max() <= 2
    if len(ends) == 2:
        assert abs(found.path[0, 1] - 400) < 5
        assert abs(found.path[-1, 1] - 2399) < 5


def test_infinite_distances_have_a_path_that_the_steps_admit():
    P = np.zeros((3, 1))
    distances = np.full((3, 4), np.inf)
    options = {"step_pattern": "asymmetric", "open_begin": True, "open_end": True}
    ours = curvewise.dtw_path(P, np.zeros((4, 1)), metric=distances, **options)
    theirs = reference.dtw_path(P, np.zeros((4, 1)), metric=distances, **options)
    assert ours.distance == theirs.distance == np.inf
    np.testing.assert_array_equal(ours.path, theirs.path)
    assert len(ours.path) == 3


def test_many_curves():
    rng = np.random.default_rng(6)
    some = [rng.normal(size=n).cumsum() for n in (20, 31, 40)]
    options = {"step_pattern": "asymmetric", "open_end": True}
    values = [[curvewise.dtw(P, Q, **options) for Q in some] for P in some]
    np.testing.assert_array_equal(curvewise.cdist(some, measure="dtw", **options), values)
    index = curvewise.Index(some, "dtw", **options)
    distances, places = index.kneighbors(some, n_neighbors=3)
    np.testing.assert_array_equal(distances, np.sort(values, axis=1))
    np.testing.assert_array_equal(places[:, 0], [0, 1, 2])
    with pytest.raises(ValueError, match="pdist"):
        curvewise.pdist(some, "dtw", **options)
