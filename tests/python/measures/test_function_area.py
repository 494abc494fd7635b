"""spacing="function": the integral of the difference of two functions of x, against fractions.

Every double is a rational number, so that the integral of two piecewise linear functions has an
exact value; kernel and reference may differ from it by rounding only.
"""

from __future__ import annotations

import itertools
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]
OPTIONS: dict[str, Any] = {"spacing": "function"}


def segments(curve: Array) -> list[tuple[Fraction, ...]]:
    """Return the segments that are not vertical, from left to right, as x0, y0, x1, y1."""
    points = [tuple(map(Fraction, point)) for point in np.asarray(curve).tolist()]
    ends = points if points[0][0] <= points[-1][0] else points[::-1]
    return [(*a, *b) for a, b in itertools.pairwise(ends) if a[0] < b[0]]


def exact(P: Array, Q: Array, squared: bool) -> Fraction:
    """Integrate over every pair of segments that have x in common."""
    total = Fraction(0)
    for x0, y0, x1, y1 in segments(P):
        for u0, v0, u1, v1 in segments(Q):
            low, high = max(x0, u0), min(x1, u1)
            if low >= high:
                continue
            first, last = (
                y0 + (x - x0) / (x1 - x0) * (y1 - y0) - v0 - (x - u0) / (u1 - u0) * (v1 - v0)
                for x in (low, high)
            )
            if squared:
                total += (high - low) * (first * first + first * last + last * last) / 3
            elif first * last >= 0:
                total += (high - low) * abs(first + last) / 2
            else:
                total += (high - low) * (first**2 + last**2) / abs(first - last) / 2
    return total


def function(rng: np.random.Generator, n: int) -> Array:
    x = np.sort(rng.choice([rng.normal(size=n), rng.integers(-3, 4, n).astype(float)], axis=0))
    x[-1] += x[-1] == x[0]
    curve = np.column_stack([x, rng.normal(size=n)])
    return curve[::-1] if rng.integers(2) else curve


def check(P: Array, Q: Array, relative: float = 1e-13) -> None:
    for squared in (False, True):
        expected = exact(P, Q, squared)
        # The rounding of values of y, where the curves nearly meet.
        size = max(np.abs(P[:, 1]).max(), np.abs(Q[:, 1]).max())
        room = relative * float(expected) + 1e-15 * size * np.sqrt(float(expected) + size)
        for package in (curvewise, reference):
            value = package.area(P, Q, squared=squared, **OPTIONS)
            assert abs(Fraction(value) - expected) <= room, (package, squared)


@pytest.mark.parametrize(("n", "m"), [*itertools.product((2, 3, 4, 9, 33, 70), repeat=2)])
def test_random_functions_against_fractions(n: int, m: int) -> None:
    rng = np.random.default_rng([n, m])
    for _ in range(5):
        P, Q = function(rng, n), function(rng, m)
        low, high = (max(P[:, 0].min(), Q[:, 0].min()), min(P[:, 0].max(), Q[:, 0].max()))
        if low < high:
            check(P, Q)
            value = curvewise.area(P, Q, **OPTIONS)
            assert value == curvewise.area(Q, P, **OPTIONS)
            quads, areas = curvewise.area_quads(P, Q, **OPTIONS)
            assert areas.sum() == pytest.approx(value, rel=1e-13)
            assert (quads[0, 0, 0], quads[-1, 1, 0]) == (low, high)
            np.testing.assert_array_equal(quads, reference.area_quads(P, Q, **OPTIONS).quads)


EIGHTHS = st.integers(-64, 64).map(lambda k: k / 8)


@st.composite
def functions(draw: st.DrawFn) -> Array:
    x = sorted(draw(st.lists(EIGHTHS, min_size=2, max_size=9)))
    y = draw(st.lists(EIGHTHS, min_size=len(x), max_size=len(x)))
    curve = np.column_stack([[-9.0, *x, 9.0], [0.0, *y, 1.0]])
    return curve[::-1] if draw(st.booleans()) else curve


@given(functions(), functions(), EIGHTHS)
@settings(derandomize=True, deadline=None)
def test_what_the_integral_promises(P: Array, Q: Array, shift: float) -> None:
    check(P, Q)
    area = curvewise.area(P, Q, **OPTIONS)
    assert curvewise.area(P, P, **OPTIONS) == 0.0
    assert curvewise.area(P[::-1], Q, **OPTIONS) == area
    assert curvewise.area(P * (2, 4), Q * (2, 4), **OPTIONS) == 8 * area
    moved = P + np.array([0, shift])
    assert curvewise.area(P, moved, **OPTIONS) == pytest.approx(18 * abs(shift), rel=1e-14)
    squares = curvewise.area(P, moved, squared=True, **OPTIONS)
    assert squares == pytest.approx(18 * shift * shift, rel=1e-14)
    # Further points on the segments: the same function.
    middles = (P[1:] + P[:-1]) / 2
    finer = np.insert(P, range(1, len(P)), middles, axis=0)
    assert curvewise.area(finer, Q, **OPTIONS) == pytest.approx(area, rel=1e-13, abs=1e-13)


def test_closed_forms() -> None:
    line, constant = [(0, 0), (4, 4)], [(0, 1), (0.5, 1), (0.7, 1), (3, 1), (4, 1)]
    assert curvewise.area(line, constant, **OPTIONS) == 5.0
    assert curvewise.area([(0, 0), (4, 0)], [(0, 1), (4, -1)], **OPTIONS) == 2.0
    step = [(0, 0), (1, 0), (1, 2), (3, 2)]  # a jump encloses zero area
    assert curvewise.area(step, [(0, 0), (5, 0)], **OPTIONS) == 4.0
    assert curvewise.area(step, [(0, 0), (5, 0)], squared=True, **OPTIONS) == 8.0


@pytest.mark.parametrize("exponent", [-1000, -520, 520, 1000])
def test_the_ends_of_the_range(exponent: int) -> None:
    P, Q = np.array([(0.0, 0), (4, 4)]), np.array([(0.0, 1), (4, 1)])
    for package in (curvewise, reference):
        for squared, degree in ((False, 2), (True, 3)):
            with np.errstate(over="ignore"):
                value = package.area(P, Q, squared=squared, **OPTIONS)
                expected = np.ldexp(value, degree * exponent)
            scaled = np.ldexp(P, exponent), np.ldexp(Q, exponent)
            assert package.area(*scaled, squared=squared, **OPTIONS) == expected
    wide = np.ldexp(P, (-300, 300)), np.ldexp(Q, (-300, 300))  # x small, y large
    assert curvewise.area(*wide, **OPTIONS) == 5.0


REFUSED = [
    ([(0, 0), (1, 0), (1, 2), (0.5, 0)], [(0, 0), (1, 1)], r"^P\[3\] reverses in x; area with"),
    ([(0, 0), (1, 0)], [(3, 0), (2, 1), (2.5, 1)], r"^Q\[2\] reverses in x; area with spacing="),
    ([(0, 0), (4, 4)], [(5, 3), (4, 0)], "^P spans x from 0 to 4 and Q from 4 to 5; area with"),
    ([(1, 0), (1, 4)], [(5, 3), (0, 0)], "^P spans x from 1 to 1 and Q from 0 to 5; area with"),
]


@pytest.mark.parametrize(("P", "Q", "message"), REFUSED)
def test_what_is_no_function_is_refused(P: Any, Q: Any, message: str) -> None:
    said = set()
    for package in (curvewise, reference):
        for squared in (False, True):
            with pytest.raises(ValueError, match=message) as error:
                package.area(P, Q, squared=squared, **OPTIONS)
            said.add(str(error.value))
    assert len(said) == 1
    with pytest.raises(ValueError, match="area with spacing='function' needs"):
        curvewise.cdist([P], [Q], "area", workers=2, **OPTIONS)


def test_batches() -> None:
    rng = np.random.default_rng(3)
    curves = [np.vstack([[-9, 0], np.sort(function(rng, n), axis=0), [9, 0]]) for n in range(2, 22)]
    matrix = curvewise.cdist(curves, curves, "area", workers=2, **OPTIONS)
    assert matrix.tolist() == [[curvewise.area(P, Q, **OPTIONS) for Q in curves] for P in curves]
    condensed = curvewise.pdist(curves, "area", **OPTIONS)
    assert condensed.tolist() == matrix[np.triu_indices(len(curves), 1)].tolist()
    loop = np.array([(0.0, 0), (1, 1), (0, 2)])
    for call in (
        lambda: curvewise.cdist([loop], [loop], "area", **OPTIONS),
        lambda: curvewise.pdist([curves[0], loop], "area", **OPTIONS),
        lambda: curvewise.Prepared(loop, "area", **OPTIONS)(curves[0]),
    ):
        with pytest.raises(ValueError, match=r"\[2\] reverses in x"):
            call()


def test_compare_states_the_common_span() -> None:
    P, Q = [(0, 0), (4, 4)], [(9, 1), (-1, 1)]
    options = {"area": OPTIONS}
    compared = curvewise.compare(P, Q, preset="raw", measures=["area"], options=options)
    assert compared["area"] == 5.0
    assert compared.notes == [
        "area is over x from 0 to 4: 100 % of the span of P, 40 % of that of Q"
    ]
    assert str(compared.deviations["area"]) == "mean 1.25 (31 %), largest 3 (75 %)"
    assert curvewise.compare(P, Q, preset="raw", measures=["area"]).notes == []


def test_there_is_no_gradient() -> None:
    with pytest.raises(ValueError, match="area has no gradient with spacing='function'; choose"):
        curvewise.value_and_gradient([(0, 0), (1, 0)], [(0, 1), (1, 1)], "area", **OPTIONS)
