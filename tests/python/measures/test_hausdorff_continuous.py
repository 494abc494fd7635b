"""The Hausdorff distance of lines: closed forms, 40 digits, dense points, and the reference."""

from __future__ import annotations

import re
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import hausdorff_continuous as hausdorff
from curvewise import reference

ULPS = 2.0**-46  # what the docstring promises, of the largest coordinate


def largest(*curves):
    return max(float(np.abs(curve).max()) for curve in curves)


def lengths(curve):
    return np.linalg.norm(np.diff(curve, axis=0), axis=1)


def drawn(seed, n, m, dim):
    """Curves of normal numbers, of small whole ones, or one next to the other."""
    rng = np.random.default_rng(seed)
    P, Q = rng.normal(size=(n, dim)), rng.normal(size=(m, dim))
    if seed % 3 == 1:
        P, Q = np.round(2 * P), np.round(2 * Q)
    elif seed % 3 == 2:
        P = np.cumsum(P, axis=0)
        Q = np.resize(P, (m, dim)) + 0.3 * Q
    return P, Q


def distances_by_brute_force(points, curve):
    """How far points are from a curve: each from each edge."""
    starts, along = (curve[:-1], np.diff(curve, axis=0)) if len(curve) > 1 else (curve, 0 * curve)
    squares = np.sum(along**2, axis=1)
    share = np.einsum("ijk,jk->ij", points[:, None] - starts, along)
    share = np.clip(share / np.where(squares > 0, squares, 1), 0, 1)[..., None]
    return np.linalg.norm(points[:, None] - starts - share * along, axis=2).min(axis=1)


def test_the_square_without_its_bottom():
    square = [(0, 0), (10, 0), (10, 6), (0, 6), (0, 0)]
    open_square = [(0, 0), (0, 6), (10, 6), (10, 0)]
    assert curvewise.hausdorff(square, open_square) == 0.0  # of the vertices
    assert hausdorff(square, open_square) == 5.0
    assert hausdorff(square, open_square, directed=True) == 5.0
    assert hausdorff(open_square, square, directed=True) == 0.0
    found = curvewise.hausdorff_continuous_points(square, open_square)
    assert found.distance == 5.0
    assert found.distances.tolist() == [5.0, 0.0]
    assert found.points[0, 0].tolist() == [5.0, 0.0]
    assert found.points[0, 1].tolist() in ([0.0, 0.0], [10.0, 0.0])
    directed = curvewise.hausdorff_continuous_points(square, open_square, directed=True)
    assert directed.parameters.tolist() == found.parameters[:1].tolist()
    assert directed.distances.tolist() == [5.0]


@pytest.mark.parametrize(
    ("P", "Q", "of_p", "of_q"),
    [
        ([(0, 0)], [(3, 4)], 5.0, 5.0),
        ([0], [3], 3.0, 3.0),
        ([(5, 3)], [(0, 0), (10, 0)], 3.0, np.sqrt(34)),
        ([(0, 0), (10, 0)], [(0, 2), (10, 3)], 30 / np.sqrt(101), 3.0),
        ([0, 10], [4, 6], 4.0, 0.0),
        ([0, 4], [6, 10], 6.0, 6.0),
        # Between the vertices (2, 1) and (9, 1).
        ([(0, 0), (10, 0)], [(2, 1), (2, 9), (9, 9), (9, 1)], np.sqrt(13.25), 9.0),
        # Between a vertex and a line: t^2 + 1 = ((8 - t) / sqrt(2))^2 on the x-axis.
        (
            [(0, 0), (8, 0)],
            [(0, 1), (-9, 1), (-9, 9), (-1, 9), (8, 0)],
            np.hypot(1, -8 + np.sqrt(126)),
            np.sqrt(162),
        ),
        ([(0, 0, 0), (0, 0, 2)], [(3, 4, 0), (3, 4, 9)], 5.0, np.sqrt(74)),
    ],
)
def test_closed_forms(P, Q, of_p, of_q):
    for one, other, value in ((P, Q, of_p), (Q, P, of_q)):
        assert hausdorff(one, other, directed=True) == pytest.approx(value, rel=1e-15, abs=0)
        theirs = reference.hausdorff_continuous(one, other, directed=True)
        assert theirs == pytest.approx(value, rel=4e-15, abs=0)
    assert hausdorff(P, Q) == hausdorff(Q, P) == pytest.approx(max(of_p, of_q), rel=1e-15, abs=0)


def farthest_in_many_digits(P, Q, mp):
    """The directed distance by all places where it can be, in the arithmetic of mpmath."""
    P, Q = ([[mp.mpf(float(x)) for x in point] for point in curve] for curve in (P, Q))

    def dot(a, b):
        return mp.fsum(x * y for x, y in zip(a, b, strict=True))

    def minus(a, b):
        return [x - y for x, y in zip(a, b, strict=True)]

    edges = list(pairwise(Q)) or [(Q[0], Q[0])]

    def square_to_edge(z, edge):
        along, w = minus(edge[1], edge[0]), minus(z, edge[0])
        length = dot(along, along)
        share = min(max(dot(w, along) / length, 0), 1) if length else 0
        off = [x - share * y for x, y in zip(w, along, strict=True)]
        return dot(off, off)

    best = mp.mpf(0)
    for x, y in list(pairwise(P)) or [(P[0], P[0])]:
        u = minus(y, x)
        quadratics = [(dot(u, u), dot(u, minus(x, z)), dot(minus(x, z), minus(x, z))) for z in Q]
        for start, end in edges:
            along, w = minus(end, start), minus(x, start)
            if length := dot(along, along):
                k, c = dot(u, along) / length, dot(w, along) / length
                across = [a - k * b for a, b in zip(u, along, strict=True)]
                off = [a - c * b for a, b in zip(w, along, strict=True)]
                quadratics.append((dot(across, across), dot(across, off), dot(off, off)))
        places = {mp.mpf(0), mp.mpf(1)}
        for first, second in combinations(quadratics, 2):
            a, b, c = (one - other for one, other in zip(first, second, strict=True))
            tiny = mp.mpf(10) ** -30  # equal quadratics differ by rounding
            if abs(a) > tiny and b * b - a * c >= 0:
                root = mp.sqrt(b * b - a * c)
                places |= {(-b - root) / a, (-b + root) / a}
            elif abs(b) > tiny:
                places.add(-c / (2 * b))
        for t in places:
            if 0 <= t <= 1:
                z = [a + t * b for a, b in zip(x, u, strict=True)]
                best = max(best, min(square_to_edge(z, edge) for edge in edges))
    return mp.sqrt(best)


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_forty_digits(dim, rounds):
    mp = pytest.importorskip("mpmath", reason="no mpmath: pip install mpmath").mp
    with mp.workdps(40):
        for seed in range(rounds(40)):
            n, m = 1 + seed % 4, 1 + seed // 4 % 4
            P, Q = drawn(seed, n, m, dim)
            for one, other in ((P, Q), (Q, P)):
                right = farthest_in_many_digits(one, other, mp)
                found = hausdorff(one, other, directed=True)
                assert abs(found - right) <= ULPS * largest(P, Q)
                assert abs(reference.hausdorff_continuous(one, other, directed=True) - right) <= (
                    ULPS * largest(P, Q)
                )


@settings(max_examples=60)
@given(
    seed=st.integers(0, 9999),
    n=st.integers(1, 19),
    m=st.integers(1, 19),
    dim=st.sampled_from([1, 2, 3, 4, 7]),
)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_it_is_that_of_the_reference(seed, n, m, dim):
    P, Q = drawn(seed, n, m, dim)
    ways = []
    for one, other in ((P, Q), (Q, P)):
        value = hausdorff(one, other, directed=True)
        theirs = reference.hausdorff_continuous(one, other, directed=True)
        assert value == pytest.approx(theirs, rel=1e-14, abs=ULPS * largest(P, Q))
        ways.append(value)
    both = hausdorff(P, Q)
    assert both == hausdorff(Q, P) == max(ways)
    assert reference.hausdorff_continuous(P, Q) == pytest.approx(both, abs=ULPS * largest(P, Q))
    assert hausdorff(P, P) <= ULPS * largest(P)


@settings(max_examples=60)
@given(
    seed=st.integers(0, 9999),
    n=st.integers(1, 150),  # over three levels of boxes
    m=st.integers(1, 150),
    dim=st.integers(1, 4),
)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_the_points_attain_it_and_none_is_farther(seed, n, m, dim):
    P, Q = drawn(seed, n, m, dim)
    found = curvewise.hausdorff_continuous_points(P, Q)
    assert found.distance == found.distances.max() == hausdorff(P, Q)
    rounding = 2 * ULPS * largest(P, Q)
    share = np.linspace(0, 1, 21)[:, None]
    for way, (from_, to) in enumerate(((P, Q), (Q, P))):
        assert found.distances[way] == hausdorff(from_, to, directed=True)
        places = found.parameters[way]
        assert (places >= 0).all()
        assert (places <= [n - 1, m - 1]).all()
        far, near = found.points[way] if way == 0 else found.points[way][::-1]
        # The point is as far from the other curve as reported, and so is the point nearest to it.
        value = found.distances[way]
        assert np.linalg.norm(far - near) == pytest.approx(value, rel=1e-14, abs=rounding)
        (checked,) = distances_by_brute_force(far[None], to)
        assert checked == pytest.approx(value, rel=1e-14, abs=rounding)
        # Distances change at most as fast as places, so dense points show that no point is farther.
        if len(from_) > 1:
            dense = np.concatenate([x + share * (y - x) for x, y in pairwise(from_)])
            at_points = distances_by_brute_force(dense, to).max()
            assert at_points <= value + rounding
            assert value <= at_points + lengths(from_).max() / 40 + rounding


@settings(max_examples=40)
@given(seed=st.integers(0, 9999), n=st.integers(3, 40), m=st.integers(3, 40))
def test_sampling_direction_and_place_do_not_matter(seed, n, m):
    P, Q = drawn(seed, n, m, 2)
    value = hausdorff(P, Q)
    rounding = 4 * ULPS * largest(P, Q)
    denser = np.empty((2 * n - 1, 2))
    denser[::2], denser[1::2] = P, (P[1:] + P[:-1]) / 2
    assert hausdorff(denser, Q) == pytest.approx(value, abs=rounding)
    assert hausdorff(P[::-1], Q) == pytest.approx(value, abs=rounding)
    assert hausdorff(P[:, ::-1], Q[:, ::-1]) == pytest.approx(value, abs=rounding)
    assert hausdorff(P + 1e6, Q + 1e6) == pytest.approx(value, abs=4 * ULPS * 1e6)
    assert hausdorff(P * 2.0**600, Q * 2.0**600) == pytest.approx(2.0**600 * value, rel=1e-14)
    assert hausdorff(P * 2.0**-600, Q * 2.0**-600) == pytest.approx(2.0**-600 * value, rel=1e-14)
    assert hausdorff(P * 2.0**40, Q * 2.0**40) == 2.0**40 * value
    assert value <= curvewise.frechet_continuous(P, Q) + rounding
    longest = max(lengths(P).max(), lengths(Q).max())
    assert abs(value - curvewise.hausdorff(P, Q)) <= longest / 2 + rounding


def test_beyond_the_range_of_a_double():
    P, Q = [(-1e308, 0), (-1e308, 1)], [(1e308, 0), (1e308, 1)]
    assert hausdorff(P, Q) == np.inf
    assert hausdorff([(0, 0), (1e-310, 0)], [(0, 0), (4e-310, 0)]) == pytest.approx(
        3e-310, rel=1e-9
    )


def test_layouts_and_kinds_of_curves():
    rng = np.random.default_rng(3)
    P, Q = rng.normal(size=(2, 40, 3))
    value = hausdorff(P, Q)
    for one in (np.asfortranarray(P), P.tolist(), np.repeat(P, 2, axis=0)[::2]):
        assert hausdorff(one, Q) == value
    assert hausdorff(P[:, 0], Q[:, 0]) == hausdorff(P[:, :1], Q[:, :1])
    single = P.astype(np.float32)
    assert hausdorff(single, Q) == hausdorff(single.astype(np.float64), Q)


def test_many_curves():
    rng = np.random.default_rng(4)
    curves = [rng.normal(size=(n, 2)).cumsum(axis=0) for n in (2, 9, 17, 30)]
    for directed in (False, True):
        matrix = curvewise.cdist(curves, measure="hausdorff_continuous", directed=directed)
        values = [[hausdorff(P, Q, directed=directed) for Q in curves] for P in curves]
        np.testing.assert_array_equal(matrix, values)
        cut = curvewise.cdist(
            curves, measure="hausdorff_continuous", directed=directed, cutoff=values[0][2]
        )
        expected = np.where(np.array(values) > values[0][2], np.inf, values)
        np.testing.assert_array_equal(cut, expected)
    index = curvewise.Index(curves, "hausdorff_continuous")
    distances, places = index.kneighbors([curves[1] + 0.1], n_neighbors=1)
    assert places.tolist() == [[1]]
    assert distances[0, 0] == hausdorff(curves[1] + 0.1, curves[1])


@pytest.mark.parametrize("module", [curvewise, reference])
@pytest.mark.parametrize(
    ("P", "Q", "message"),
    [
        (np.empty((0, 2)), [(0, 0)], "P has shape (0, 2); hausdorff_continuous needs at least 1"),
        ([(0, 0)], [(0, np.nan)], "Q[0, 1] is nan"),
        ([(0, 0)], [(0, 0, 0)], "P has shape (1, 2) and Q has shape (1, 3); both need the same"),
    ],
)
@pytest.mark.filterwarnings("ignore::curvewise.LayoutWarning")
def test_errors(module, P, Q, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        module.hausdorff_continuous(P, Q)
