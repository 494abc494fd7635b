"""Points left out at the ends of dtw: by all pairs of parts, the reference, and errors."""

from __future__ import annotations

import pickle
import re
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import StepPattern, reference
from curvewise.calibration import Criterion, Objective

SIZES = [(1, 1), (1, 9), (9, 1), (2, 2), (17, 23), (30, 8), (257, 13), (256, 5)]
ENDS = st.tuples(*[st.sampled_from([0, 1, 2, 5, 400])] * 4)


def curves(seed, n, m, dim):
    rng = np.random.default_rng(seed)
    return rng.integers(0, 9, (n, dim)) / 2, rng.integers(0, 9, (m, dim)) / 2


def least_over_parts(P, Q, relax, **options):
    """Return the least over what may be left out: of one curve at each end."""
    n, m = len(P), len(Q)
    starts = [(i, 0) for i in range(min(relax[0], n - 1) + 1)]
    starts += [(0, j) for j in range(min(relax[2], m - 1) + 1)]
    ends = [(i, m) for i in range(n - min(relax[1], n - 1), n + 1)]
    ends += [(n, j) for j in range(m - min(relax[3], m - 1), m + 1)]
    return min(
        curvewise.dtw(P[first[0] : last[0]], Q[first[1] : last[1]], **options)
        for first, last in product(starts, ends)
        if first[0] < last[0] and first[1] < last[1]
    )


def test_a_last_point_is_left_out():
    found = curvewise.dtw_path([2, 2, 2], [2, 5, 5, 5, 5], relax=(0, 0, 0, 1))
    assert found.distance == 9.0
    assert found.path[-1].tolist() == [2, 3]
    assert curvewise.dtw([9, 2, 2, 2], [2, 2, 5], relax=(1, 0, 0, 1)) == 0.0


@settings(max_examples=40)
@given(
    seed=st.integers(0, 9999),
    n=st.integers(1, 7),
    m=st.integers(1, 7),
    relax=ENDS,
    penalty=st.sampled_from([0.0, 0.5]),
)
def test_the_value_is_the_least_over_all_parts(seed, n, m, relax, penalty):
    P, Q = curves(seed, n, m, 2)
    value = curvewise.dtw(P, Q, relax=relax, penalty=penalty)
    assert value == pytest.approx(least_over_parts(P, Q, relax, penalty=penalty), rel=1e-12)
    for cutoff in (value, 0.999 * value):
        expected = value if value <= cutoff else np.inf
        found = curvewise.dtw(P, Q, relax=relax, penalty=penalty, cutoff=cutoff)
        assert found == expected


@settings(max_examples=40)
@given(
    seed=st.integers(0, 9999),
    size=st.sampled_from(SIZES),
    relax=ENDS,
    metric=st.sampled_from(["euclidean", "sqeuclidean", "cityblock", "chebyshev"]),
    dim=st.sampled_from([1, 2, 3, 4, 7]),
    penalty=st.sampled_from([0.0, 0.3]),
)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_values_paths_and_tables_are_those_of_the_reference(
    seed, size, relax, metric, dim, penalty
):
    P, Q = curves(seed, *size, dim)
    options = {"relax": relax, "metric": metric, "penalty": penalty}
    value = curvewise.dtw(P, Q, **options)
    assert value == reference.dtw(P, Q, **options)
    found, right = (module.dtw_path(P, Q, **options) for module in (curvewise, reference))
    assert found.distance == right.distance == value
    np.testing.assert_array_equal(found.path, right.path)
    tables = [module.dtw_table(P, Q, **options) for module in (curvewise, reference)]
    np.testing.assert_array_equal(*tables)
    assert tables[0][tuple(found.path[-1])] == value
    assert curvewise.dtw_info(P, Q, **options).value == value


@settings(max_examples=25)
@given(seed=st.integers(0, 9999), n=st.integers(1, 20), m=st.integers(1, 20), relax=ENDS)
def test_ends_change_places_with_the_curves_and_with_their_direction(seed, n, m, relax):
    P, Q = curves(seed, n, m, 2)
    exact = {"metric": "cityblock"}  # sums of halves
    p0, p1, q0, q1 = relax
    value = curvewise.dtw(P, Q, relax=relax, **exact)
    assert value == curvewise.dtw(Q, P, relax=(q0, q1, p0, p1), **exact)
    assert value == curvewise.dtw(P[::-1], Q[::-1], relax=(p1, p0, q1, q0), **exact)
    assert value <= curvewise.dtw(P, Q, **exact)


@pytest.mark.parametrize("dim", [1, 2])
def test_all_points_of_one_curve_are_those_of_open_ends(dim):
    P, Q = curves(4, 12, 30, dim)
    for begin, end in ((True, False), (False, True), (True, True)):
        relax = (0, 0, 30 * begin, 30 * end)
        assert curvewise.dtw(P, Q, relax=relax) == curvewise.dtw(
            P, Q, open_begin=begin, open_end=end
        )


def test_none_and_zeros_are_the_plain_distance():
    P, Q = curves(5, 12, 30, 2)
    for relax in (None, (0, 0, 0, 0), [0] * 4, np.zeros(4, dtype=np.int64)):
        assert curvewise.dtw(P, Q, relax=relax) == curvewise.dtw(P, Q)
        assert curvewise.dtw(P, Q, relax=relax, step_pattern="symmetric2", normalize=True) > 0
    assert curvewise.dtw(P, Q, relax=np.array([1, 2, 3, 4])) == curvewise.dtw(
        P, Q, relax=[1, 2, 3, 4]
    )
    assert curvewise.dtw(P, Q, relax=(10**30,) * 4) == curvewise.dtw(P, Q, relax=(99,) * 4)


def test_long_paths_are_found_in_parts():
    rng = np.random.default_rng(5)
    Q = rng.normal(size=3000).cumsum()
    P = np.concatenate([Q[2:] + 0.01 * rng.normal(size=2998), [Q[-1] + 50.0] * 3])
    found = curvewise.dtw_path(P, Q, relax=(0, 5, 5, 0))
    costs = np.abs(P[found.path[:, 0]] - Q[found.path[:, 1]])
    assert found.distance == curvewise.dtw(P, Q, relax=(0, 5, 5, 0)) == np.add.accumulate(costs)[-1]
    assert found.path[0].tolist() == [0, 2]
    assert found.path[-1].tolist() == [2997, 2999]


def test_many_curves():
    rng = np.random.default_rng(6)
    some = [rng.normal(size=n).cumsum() for n in (20, 31, 40)]
    for relax in ((3, 2, 3, 2), (0, 1, 4, 0)):
        options = {"relax": relax}
        values = [[curvewise.dtw(P, Q, **options) for Q in some] for P in some]
        np.testing.assert_array_equal(curvewise.cdist(some, measure="dtw", **options), values)
        distances, _ = curvewise.Index(some, "dtw", **options).kneighbors(some, n_neighbors=3)
        np.testing.assert_array_equal(distances, np.sort(values, axis=1))
    assert curvewise.pdist(some, "dtw", relax=(3, 2, 3, 2))[0] == curvewise.dtw(
        some[0], some[1], relax=(3, 2, 3, 2)
    )
    with pytest.raises(ValueError, match="pdist"):
        curvewise.pdist(some, "dtw", relax=(0, 1, 4, 0))


def test_the_gradient_is_that_of_the_path():
    rng = np.random.default_rng(7)
    P, Q = (rng.normal(size=(n, 2)).cumsum(axis=0) for n in (15, 20))
    options = {"relax": (3, 2, 3, 2)}
    value, gradient = curvewise.value_and_gradient(P, Q, "dtw", **options)
    assert value == curvewise.dtw(P, Q, **options)
    change = 1e-6 * rng.normal(size=Q.shape)
    slope = (gradient * change).sum()
    both = [curvewise.dtw(P, Q + sign * change, **options) for sign in (1, -1)]
    assert (both[0] - both[1]) / 2 == pytest.approx(slope, rel=1e-4)
    path = curvewise.dtw_path(P, Q, **options).path
    left_out = np.setdiff1d(np.arange(len(Q)), path[:, 1])
    assert len(left_out) > 0
    assert not gradient[left_out].any()


def test_own_distances():
    P, Q = curves(8, 9, 12, 2)
    distances = np.abs(P[:, None] - Q[None]).sum(axis=2)
    relax = (2, 1, 0, 3)
    expected = curvewise.dtw_path(P, Q, metric="cityblock", relax=relax)
    found = curvewise.dtw_path(P, Q, metric=distances, relax=relax)
    assert found.distance == expected.distance
    np.testing.assert_array_equal(found.path, expected.path)
    infinite = np.full((9, 12), np.inf)
    ours, theirs = (
        module.dtw_path(P, Q, metric=infinite, relax=relax) for module in (curvewise, reference)
    )
    assert ours.distance == theirs.distance == np.inf
    np.testing.assert_array_equal(ours.path, theirs.path)


ADVICE = "give four whole numbers >= 0, or None"


@pytest.mark.parametrize("module", [curvewise, reference])
@pytest.mark.parametrize("function", ["dtw", "dtw_path", "dtw_table"])
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"relax": 1}, f"relax is 1; {ADVICE}"),
        ({"relax": "1234"}, f"relax is '1234'; {ADVICE}"),
        ({"relax": (1, 2, 3)}, f"relax is (1, 2, 3); {ADVICE}"),
        ({"relax": (1, 2, 3, -4)}, f"relax is -4; {ADVICE}"),
        ({"relax": (1, 2, 3.0, 4)}, f"relax is 3.0; {ADVICE}"),
        ({"relax": (True, 0, 0, 0)}, f"relax is True; {ADVICE}"),
        (
            {"relax": (1, 0, 0, 0), "step_pattern": "symmetric2"},
            "relax needs step_pattern='symmetric1'",
        ),
        (
            {"relax": (1, 0, 0, 0), "step_pattern": StepPattern.named("symmetric1")},
            "relax needs step_pattern='symmetric1'",
        ),
        ({"relax": (1, 0, 0, 0), "window": 3}, "relax cannot be combined with window"),
        ({"relax": (1, 0, 0, 0), "window": 0.5}, "relax cannot be combined with window"),
        (
            {"relax": (1, 0, 0, 0), "open_end": True},
            "relax cannot be combined with open_begin and open_end",
        ),
    ],
)
def test_errors(module, function, options, message):
    P, Q = curves(9, 5, 6, 2)
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        getattr(module, function)(P, Q, **options)


@pytest.mark.parametrize("module", [curvewise, reference])
def test_it_is_not_normalised_and_not_for_loops(module):
    P, Q = curves(9, 5, 6, 2)
    with pytest.raises(ValueError, match=r"^relax cannot be combined with normalize$"):
        module.dtw(P, Q, relax=(1, 0, 0, 0), normalize=True)
    with pytest.raises(
        ValueError, match=r"^closed=True has no relax; leave out relax=\(1, 0, 0, 0\)"
    ):
        module.dtw(P, Q, relax=(1, 0, 0, 0), closed=True)


def test_a_criterion_with_relaxed_ends_goes_to_other_processes():
    criterion = Criterion("dtw", preset="raw", relax=(1, 2, 3, 4))
    assert pickle.loads(pickle.dumps(criterion)).options == {"relax": (1, 2, 3, 4)}
    P, Q = curves(10, 12, 15, 2)
    assert Objective(P, criterion)(Q) == curvewise.dtw(P, Q, relax=(1, 2, 3, 4))
