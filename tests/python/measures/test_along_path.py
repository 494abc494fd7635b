"""Curves on each other's index, the mapping, and the average, against their definitions."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise
from curvewise.measures.results import Alignment

RNG = np.random.default_rng(56)
P, Q = RNG.normal(size=(2, 40)).cumsum(axis=1)
KNIGHT = curvewise.StepPattern([(1, 1, 1, -1), (1, 0, 0, 1), (2, 1, 3, -1), (2, 0, 0, 1)])


def partners(path: np.ndarray, j: int, onto: int) -> list[int]:
    return [pair[1 - onto] for pair in path.tolist() if pair[onto] == j]


def expected(path, values, by, onto, size):
    """Every point by itself: its partners, or the nearest matched points on both sides."""
    known = {}
    for j in range(size):
        if them := partners(path, j, onto):
            known[j] = values[them[0]] if by == "first" else np.mean(values[them], axis=0)
    rows = np.full((size, *np.shape(values)[1:]), np.nan)
    for j in range(size):
        below = max((k for k in known if k <= j), default=None)
        above = min((k for k in known if k >= j), default=None)
        if below is not None and above is not None:
            share = 0.0 if below == above else (j - below) / (above - below)
            rows[j] = (1 - share) * known[below] + share * known[above]
    return rows


@st.composite
def monotone_paths(draw):
    steps = draw(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)).filter(any), max_size=30))
    begin = draw(st.tuples(st.integers(0, 4), st.integers(0, 4)))
    path = np.cumsum([begin, *steps], axis=0).astype(np.int64)
    behind = draw(st.tuples(st.integers(0, 4), st.integers(0, 4)))
    return path, path[-1] + 1 + behind


@given(monotone_paths(), st.sampled_from(["mean", "first"]), st.sampled_from(["Q", "P"]))
def test_values_are_those_of_the_partners(drawn, by, onto):
    path, (n, m) = drawn
    rng = np.random.default_rng(n)
    curves = rng.normal(size=(n, 3)), rng.normal(size=(m, 3))
    alignment = Alignment(0.0, path, curves)
    k = "PQ".index(onto)
    values = curves[1 - k]
    found = alignment.warped(values, by=by, onto=onto)
    np.testing.assert_allclose(
        found, expected(path, values, by, k, (n, m)[k]), rtol=1e-13, atol=1e-13
    )
    np.testing.assert_array_equal(
        alignment.warped(values[:, 1], by=by, onto=onto), found[:, 1], strict=True
    )


@given(monotone_paths(), st.sampled_from(["mean", "first"]), st.sampled_from(["Q", "P"]))
def test_the_mapping_is_that_of_the_indices(drawn, by, onto):
    path, (n, m) = drawn
    alignment = Alignment(0.0, path, (np.zeros((n, 1)), np.zeros((m, 1))))
    k = "PQ".index(onto)
    mapping = alignment.mapping(by=by, onto=onto)
    size, other = (n, m)[k], (n, m)[1 - k]
    at_points = expected(path, np.arange(float(other)), by, k, size)
    np.testing.assert_allclose(mapping(np.arange(size)), at_points, rtol=1e-13)
    halves = mapping(np.arange(size - 1) + 0.5)
    np.testing.assert_allclose(halves, (at_points[:-1] + at_points[1:]) / 2, rtol=1e-13)
    assert np.isnan(mapping([-0.25, size - 0.75])).all()
    inside = mapping(np.arange(size))[~np.isnan(at_points)]
    assert (np.diff(inside) >= 0).all()
    assert mapping(path[0, k]).shape == ()


@given(monotone_paths(), st.sampled_from([0, 0.25, 0.5, 1]))
def test_the_average_is_that_of_each_pair(drawn, weight):
    path, (n, m) = drawn
    rng = np.random.default_rng(m)
    A, B = rng.normal(size=(n, 2)), rng.normal(size=(m, 2))
    found = Alignment(0.0, path, (A, B)).average(A, B, weight=weight)
    pairs = [(1 - weight) * A[i] + weight * B[j] for i, j in path]
    np.testing.assert_array_equal(found, pairs, strict=True)


@pytest.mark.parametrize(
    "alignment",
    [
        curvewise.dtw_path(P, Q),
        curvewise.dtw_path(P, Q, step_pattern="symmetricP1"),
        curvewise.frechet_path(P, Q),
        curvewise.edit_path(P, Q, "erp"),
        curvewise.reference.dtw_path(P, Q),
    ],
)
def test_every_measure_with_a_path_has_them(alignment):
    path = alignment.path
    np.testing.assert_allclose(
        alignment.warped(P), expected(path, P, "mean", 1, len(Q)), rtol=1e-13, atol=1e-14
    )
    np.testing.assert_array_equal(
        alignment.average(P, Q), 0.5 * P[path[:, 0]] + 0.5 * Q[path[:, 1]], strict=True
    )


def test_a_shifted_peak_comes_back():
    time = np.linspace(0.0, 1.0, 201)
    early, late = (np.exp(-(((time - centre) / 0.05) ** 2)) for centre in (0.4, 0.6))
    alignment = curvewise.dtw_path(early, late, step_pattern="symmetric2")
    np.testing.assert_allclose(alignment.warped(early), late, atol=0.05)
    assert alignment.warped(time)[np.argmax(late)] == pytest.approx(0.4, abs=0.01)
    assert np.max(alignment.average(early, late)) == pytest.approx(1.0, abs=1e-3)
    assert np.max((early + late) / 2) < 0.52  # without the path


def test_steps_over_several_points_are_interpolated():
    alignment = curvewise.dtw_path([0, 1, 2], [0, 1, 9, 9, 2], step_pattern=KNIGHT)
    assert alignment.path.tolist() == [[0, 0], [1, 1], [2, 4]]
    np.testing.assert_allclose(alignment.warped([0, 1, 2]), [0, 1, 4 / 3, 5 / 3, 2])


def test_points_beyond_an_open_end_are_nan():
    alignment = curvewise.dtw_path([1, 2], [9, 1, 2, 9], open_begin=True, open_end=True)
    np.testing.assert_array_equal(alignment.warped([1, 2]), [np.nan, 1, 2, np.nan])
    # The reference does not keep the curves: its path alone says how many points there are.
    alignment = curvewise.reference.dtw_path([1, 2], [9, 1, 2, 9], open_begin=True, open_end=True)
    np.testing.assert_array_equal(alignment.warped([1, 2]), [np.nan, 1, 2])


@pytest.mark.parametrize("layout", [np.asfortranarray, lambda A: A[::2], lambda A: A.tolist()])
def test_layouts(layout):
    A = RNG.normal(size=(20, 4)).cumsum(axis=0)
    given = layout(A)
    plain = np.array(given)
    alignment = curvewise.dtw_path(plain, A[5:])
    np.testing.assert_array_equal(alignment.warped(given), alignment.warped(plain))
    np.testing.assert_array_equal(
        alignment.average(given, A[5:]), alignment.average(plain, A[5:].copy())
    )


def test_errors():
    alignment = curvewise.dtw_path([0, 1, 2], [0, 2])

    def refused(call, message, kind=ValueError):
        with pytest.raises(kind, match="^" + re.escape(message)):
            call()

    refused(
        lambda: alignment.warped([0, 1]),
        "P has 2 rows, but the path is that of 3 points; give one row for each point",
    )
    refused(
        lambda: alignment.warped([0, 1, 2], onto="P"),
        "Q has 3 rows, but the path is that of 2 points; give one row for each point",
    )
    refused(lambda: alignment.warped([0, 1, 2], by="last"), "unknown by 'last'; choose from mean")
    refused(lambda: alignment.warped([0, 1, 2], onto="R"), "unknown onto 'R'; choose from Q, P")
    refused(lambda: alignment.mapping(onto="R"), "unknown onto 'R'; choose from Q, P")
    refused(lambda: alignment.mapping(by="last"), "unknown by 'last'; choose from mean, first")
    refused(
        lambda: alignment.average([0, 1, 2], [[0, 1], [2, 3]]),
        "P has 1 columns and Q has 2; give the same columns",
    )
    for weight in (-0.5, 1.5, "half", float("nan")):
        refused(
            lambda weight=weight: alignment.average([0, 1, 2], [0, 2], weight=weight),
            f"weight is {weight!r}; give a number between 0 and 1",
        )
    refused(lambda: alignment.warped(["a", "b", "c"]), "P has dtype <U1", TypeError)
    nowhere = curvewise.dtw_path([0, 1, 2, 3], [0, 1], step_pattern="symmetricP2")
    assert nowhere.distance == np.inf
    message = "the path is empty: the step pattern admits none between these curves"
    refused(lambda: nowhere.warped([0, 1, 2, 3]), message)
    refused(nowhere.mapping, message)
    refused(lambda: nowhere.average([0, 1, 2, 3], [0, 1]), message)
    nowhere = curvewise.reference.dtw_path([0, 1, 2, 3], [0, 1], step_pattern="symmetricP2")
    refused(lambda: nowhere.warped([0, 1, 2, 3]), message)
    refused(nowhere.mapping, message)
