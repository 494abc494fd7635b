"""dtw, dtw_path and frechet_dist of curvewise.compat, and when they need scipy.

The tables are compared with plain loops over the definitions, written below; numbers without a
definition here are literals that similaritymeasures 1.5.0 printed. That package is not needed.
"""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise.compat as similaritymeasures

Array = npt.NDArray[Any]

P = np.array([[0, 0], [2, 3], [5, 4], [7, 1], [9, 0], [11, 2]])
Q = np.array([[0, 1], [4, 6], [11, -3]])
PF, QF = P.astype(float), Q.astype(float)


def table_by_loops(costs: Array, combine: Callable[[float, float], float]) -> Array:
    table = np.empty(costs.shape)
    for i, j in np.ndindex(*costs.shape):
        before = [
            table[k, m] for k, m in ((i - 1, j), (i, j - 1), (i - 1, j - 1)) if k >= 0 and m >= 0
        ]
        cost = float(costs[i, j])
        table[i, j] = combine(cost, min(before)) if before else cost
    return table


def costs_by_loops(exp: Array, num: Array, distance: Callable[[Array, Array], float]) -> Array:
    return np.array([[distance(u, v) for v in num] for u in exp])


DISTANCES: dict[str, Callable[[Array, Array], float]] = {
    "euclidean": lambda u, v: math.sqrt(sum((u - v) ** 2)),
    "sqeuclidean": lambda u, v: sum((u - v) ** 2),
    "cityblock": lambda u, v: sum(abs(u - v)),
    "chebyshev": lambda u, v: max(abs(u - v)),
    "canberra": lambda u, v: sum(
        abs(a - b) / (abs(a) + abs(b)) for a, b in zip(u, v, strict=True) if a or b
    ),
}

dimensions = st.integers(1, 3)


@st.composite
def curve_pairs(draw: st.DrawFn) -> tuple[Array, Array]:
    d = draw(dimensions)
    # Fractions of 2^16: squares of smaller differences vanish in the loops, not in the kernel.
    coordinate = st.integers(-3, 3) | st.integers(-(2**22), 2**22).map(lambda k: k / 2**16)
    point = st.lists(coordinate, min_size=d, max_size=d)
    exp, num = (draw(st.lists(point, min_size=1, max_size=9)) for _ in range(2))
    return np.array(exp, dtype=float), np.array(num, dtype=float)


@settings(deadline=None)
@given(curve_pairs(), st.sampled_from(sorted(DISTANCES)))
def test_dtw_equals_loops_over_its_definition(curves: tuple[Array, Array], metric: str) -> None:
    costs = costs_by_loops(*curves, DISTANCES[metric])
    r, d = similaritymeasures.dtw(*curves, metric)
    np.testing.assert_allclose(d, table_by_loops(costs, lambda c, best: c + best), rtol=1e-12)
    assert r == d[-1, -1]


@settings(deadline=None)
@given(curve_pairs(), st.sampled_from([1, 2, 3, 7.5, np.inf, 0.5]))
def test_frechet_dist_equals_loops_over_its_definition(
    curves: tuple[Array, Array], p: float
) -> None:
    costs = costs_by_loops(*curves, lambda u, v: minkowski(u - v, p))
    df = similaritymeasures.frechet_dist(*curves, p)
    assert df == pytest.approx(table_by_loops(costs, max)[-1, -1], rel=1e-12, abs=1e-300)


def minkowski(steps: Array, p: float) -> float:
    largest = max(abs(steps))
    if p == np.inf or largest == 0:
        return float(largest)
    return float(largest * sum((abs(steps) / largest) ** p) ** (1 / p))


def cross_product(u: Array, v: Array) -> float:
    return float(u[0] * v[1] - u[1] * v[0])


@pytest.mark.parametrize(("n", "m"), [(1, 1), (1, 5), (5, 1), (2, 2), (7, 3), (3, 7)])
def test_tables_over_a_callable_have_every_shape(n: int, m: int) -> None:
    rng = np.random.default_rng(7)
    exp, num = rng.normal(size=(n, 3)), rng.normal(size=(m, 3))
    r, d = similaritymeasures.dtw(exp, num, metric=cross_product)
    costs = costs_by_loops(exp, num, cross_product)
    assert np.array_equal(d, table_by_loops(costs, lambda c, best: c + best))
    assert r == d[-1, -1]


def test_metrics_and_options_of_scipy() -> None:
    r, _ = similaritymeasures.dtw(PF, QF, "canberra")
    assert r == pytest.approx(5.064790764790764, rel=1e-12)
    r, _ = similaritymeasures.dtw(PF, QF, w=[1, 4])
    assert r == pytest.approx(35.86406881095316, rel=1e-12)
    r, _ = similaritymeasures.dtw(P > 2, Q > 2, metric="jaccard")
    assert r == 0.5
    r, d = similaritymeasures.dtw(PF, QF, metric="Euclidean")
    assert np.array_equal(d, similaritymeasures.dtw(PF, QF)[1])
    costs = np.empty((6, 3))
    similaritymeasures.dtw(PF, QF, out=costs)
    assert costs[0, 0] == 1.0
    assert similaritymeasures.frechet_dist(PF, QF, 0.5) == pytest.approx(15.745966692414834)
    with pytest.raises(ValueError, match="foo"):
        similaritymeasures.dtw(PF, QF, "foo")
    with pytest.raises(TypeError):
        similaritymeasures.dtw(PF, QF, "euclidean", p=2)


def test_one_coordinate_may_be_one_dimensional() -> None:
    for metric in ("euclidean", "canberra"):
        r, _ = similaritymeasures.dtw([0.0, 1.0, 2.0], [0.0, 2.0], metric)
        assert r == similaritymeasures.dtw([[0.0], [1.0], [2.0]], [[0.0], [2.0]], metric)[0]
    assert similaritymeasures.frechet_dist([0, 1, 2], [0, 2]) == 1.0


@pytest.mark.parametrize(
    ("table", "path"),
    [
        ([[0, 0, 0], [0, 0, 0], [0, 0, 0]], [(0, 0), (0, 1), (0, 2), (1, 2), (2, 2)]),
        ([[0, 0, 9], [9, 0, 9], [9, 9, 1]], [(0, 0), (0, 1), (1, 1), (2, 2)]),
        ([[0, 5, 9], [0, 0, 9], [9, 9, 1]], [(0, 0), (1, 0), (1, 1), (2, 2)]),
        ([[0, 5, 9], [5, 0, 9], [9, 9, 1]], [(0, 0), (1, 1), (2, 2)]),
        ([[0, 1, 3]], [(0, 0), (0, 1), (0, 2)]),
        ([[0], [1]], [(0, 0), (1, 0)]),
        ([[4]], [(0, 0)]),
        ([[0, np.nan], [np.nan, 1]], [(0, 0), (1, 1)]),
    ],
)
def test_dtw_path_prefers_up_then_left_then_the_diagonal(
    table: list[list[float]], path: list[tuple[int, int]]
) -> None:
    assert similaritymeasures.dtw_path(np.array(table)).tolist() == [list(cell) for cell in path]
    assert similaritymeasures.dtw_path(d=table).tolist() == [list(cell) for cell in path]


# ---------------------------------------------------------------- scipy is optional


def test_scipy_is_imported_only_when_needed() -> None:
    program = (
        "import sys, curvewise.compat as c; a = [[0., 1.], [2., 3.]];"
        "c.dtw(a, a); c.dtw(a, a, 'minkowski', p=3); c.frechet_dist(a, a); c.pcm(a, a);"
        "c.area_between_two_curves(a, a); c.get_arc_length(a); c.curve_length_measure(a, a);"
        "assert 'scipy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_missing_scipy_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.spatial.distance", None)
    with pytest.raises(ImportError, match=r"'canberra'.*needs scipy.*curvewise\[compat\]"):
        similaritymeasures.dtw(PF, QF, "canberra")
    with pytest.raises(ImportError, match=r"curvewise\[compat\]"):
        similaritymeasures.frechet_dist(PF, QF, p=0.5)


def test_refused_input_says_what_and_where() -> None:
    for measure in (similaritymeasures.dtw, similaritymeasures.frechet_dist):
        with pytest.raises(ValueError, match=r"num_data has shape \(0, 2\); a curve needs"):
            measure(PF, QF[:0])
        shapes = r"exp_data has shape \(6, 2\) and num_data has shape \(4, 3\); both need"
        with pytest.raises(ValueError, match=shapes):
            measure(PF, np.zeros((4, 3)))
        with pytest.raises(TypeError, match="num_data has dtype"):
            measure(PF, [["a", "b"]])
    with pytest.raises(ValueError, match=r"d has shape \(2,\)"):
        similaritymeasures.dtw_path([1.0, 2.0])
