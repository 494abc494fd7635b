"""The common part of two curves against all pairs of sections, and the reference."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import CommonPart, reference

Array = npt.NDArray[np.float64]
HALVES = st.integers(0, 6).map(lambda k: k / 2)
CURVES = st.lists(st.tuples(HALVES, HALVES), min_size=1, max_size=6).map(np.array)


def edges_of(P: Array, **ground: Any) -> list[float]:
    return [curvewise.frechet(P[i : i + 1], P[i + 1 : i + 2], **ground) for i in range(len(P) - 1)]


def best_of_all_sections(P: Array, Q: Array, distance: float, **ground: Any) -> CommonPart:
    """Return the longest section; among equals P's ends first, then Q's begins, and ends, first."""
    edges = edges_of(P, **ground)
    found = [
        (-sum(edges[i : k - 1]), k, i, j, last)
        for i in range(len(P))
        for k in range(i + 1, len(P) + 1)
        for j in range(len(Q))
        for last in range(j + 1, len(Q) + 1)
        if curvewise.frechet(P[i:k], Q[j:last], **ground) <= distance
    ]
    if not found:
        return CommonPart(0.0, slice(0, 0), slice(0, 0))
    length, k, i, j, last = min(found)
    return CommonPart(-length, slice(i, k), slice(j, last))


@settings(max_examples=150, deadline=None)
@given(CURVES, CURVES, HALVES, st.sampled_from(["cityblock", "chebyshev"]))
def test_the_longest_of_all_sections(P: Array, Q: Array, distance: float, metric: Any) -> None:
    expected = best_of_all_sections(P, Q, distance, metric=metric)
    for package in (curvewise, reference):
        assert package.common_part(P, Q, distance, metric=metric) == expected


@pytest.mark.parametrize("ground", [{}, {"metric": "minkowski", "p": 3}, {"metric": "haversine"}])
@pytest.mark.parametrize("dim", [2, 3])
def test_random_walks_are_those_of_the_reference(ground: dict[str, Any], dim: int) -> None:
    if ground.get("metric") == "haversine" and dim == 3:
        return
    rng = np.random.default_rng(dim)
    for n, m in ((1, 1), (40, 33), (129, 70), (33, 260)):
        P, Q = (np.cumsum(rng.normal(size=(size, dim)), axis=0) for size in (n, m))
        Q[: n // 2] = P[n // 3 : n // 3 + len(Q[: n // 2])] + rng.normal(0, 0.1, Q[: n // 2].shape)
        distance = 5e4 if "haversine" in ground.values() else 0.5
        found = curvewise.common_part(P, Q, distance, **ground)
        of_reference = reference.common_part(P, Q, distance, **ground)
        assert (found.of_p, found.of_q) == (of_reference.of_p, of_reference.of_q)
        assert found.length == pytest.approx(of_reference.length, rel=1e-13)
        if n > 1:
            assert found.length > 0.0
            assert curvewise.frechet(P[found.of_p], Q[found.of_q], **ground) <= distance


def test_two_tracks_on_the_sphere() -> None:
    road = np.column_stack([np.linspace(8.0, 8.1, 201), np.full(201, 47.0)])
    other = np.vstack([np.add(road[60:150], (0, 1e-5)), [[8.2, 47.2]]])
    part = curvewise.common_part(road, other, 5.0, metric="haversine")
    assert (part.of_p, part.of_q) == (slice(60, 150), slice(0, 90))
    assert part.length == pytest.approx(
        89 * 0.0005 * np.pi / 180 * 6_371_008.8 * np.cos(0.8203), 1e-3
    )


def test_an_exact_distance_is_within() -> None:
    P, Q = [(0.0, 0.0), (1.0, 0.0)], [(0.1, 0.3), (1.1, 0.3)]
    limit = curvewise.frechet(P, Q)
    for package in (curvewise, reference):
        assert package.common_part(P, Q, limit).length == 1.0
        assert package.common_part(P, Q, np.nextafter(limit, 0)).length == 0.0
        assert package.common_part(P, Q, np.inf).length == 1.0


@pytest.mark.parametrize("exponent", [-1000, -520, 520, 1000])
def test_the_ends_of_the_range(exponent: int) -> None:
    P, Q = np.array([(0.0, 0), (3, 4), (6, 8)]), np.array([(0.0, 1), (3, 5), (9, 9)])
    for package in (curvewise, reference):
        part = package.common_part(
            np.ldexp(P, exponent), np.ldexp(Q, exponent), float(np.ldexp(1.0, exponent))
        )
        assert part == CommonPart(float(np.ldexp(5.0, exponent)), slice(0, 2), slice(0, 2))


def test_what_is_refused() -> None:
    for package in (curvewise, reference):
        for distance in (-1.0, np.nan):
            with pytest.raises(ValueError, match=r"^distance is .*; give a number >= 0$"):
                package.common_part([0, 1], [0, 1], distance)
        with pytest.raises(ValueError, match=r"common_part needs at least 1 point$"):
            package.common_part(np.zeros((0, 2)), np.eye(2), 1.0)
        with pytest.raises(ValueError, match=r"^Q\[1, 0\] is nan; curves must be finite$"):
            package.common_part(np.eye(2), [(0, 0), (np.nan, 1)], 1.0)
