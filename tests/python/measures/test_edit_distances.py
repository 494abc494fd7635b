"""Edit distances and hausdorff: against the reference, against aeon and scipy, and closed forms."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.measures.edit_distances import EditDistance

NAMES = get_args(EditDistance)
A = np.array([0.0, 1.0, 3.0, 2.5, 4.0, 6.0, 5.0, 5.5])
B = np.array([0.5, 0.0, 2.0, 4.0, 3.0, 5.0, 6.5, 5.0, 5.0])
# Of A and B, of the two-dimensional curves that A and B make with their squares / 9 (aeon 1.6.0).
OF_AEON: dict[str, tuple[float, float]] = {
    "erp": (5.0, 6.445924823106774),
    "edr": (0.3333333333333333, 0.6666666666666666),
    "lcss": (0.0, 0.25),
    "msm": (6.0, 10.722222222222221),
    "twe": (10.515000000000002, 13.13855427477247),
    "wdtw": (1.8223514502247997, 3.023811653885123),
}
OPTIONS: dict[str, dict[str, Any]] = {
    "erp": {"gap": 0.75},
    "edr": {"epsilon": 0.6},
    "lcss": {"epsilon": 0.6},
    "msm": {"cost": 0.3},
    "twe": {"stiffness": 0.02, "penalty": 0.4},
    "wdtw": {"steepness": 0.2},
}


def curves(seed: int, n: int, m: int, dim: int) -> tuple[Any, Any]:
    rng = np.random.default_rng(seed)
    return rng.integers(0, 9, (n, dim)) / 2, rng.integers(0, 9, (m, dim)) / 2


@pytest.mark.parametrize("name", NAMES)
def test_defaults_are_those_of_aeon(name: str) -> None:
    measure = getattr(curvewise, name)
    plane = [np.column_stack([x, x * x / 9]) for x in (A, B)]
    assert measure(A, B) == pytest.approx(OF_AEON[name][0], rel=1e-12)
    assert measure(*plane) == pytest.approx(OF_AEON[name][1], rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=10)
@given(
    seed=st.integers(0, 999),
    n=st.integers(1, 20),
    m=st.integers(1, 20),
    dim=st.integers(1, 4),
    metric=st.sampled_from(["euclidean", "sqeuclidean", "cityblock", "chebyshev"]),
    window=st.sampled_from([None, 4, 0.9]),
    is_default=st.booleans(),
)
def test_values_paths_and_tables_are_those_of_the_reference(
    name: str, seed: int, n: int, m: int, dim: int, metric: str, window: Any, is_default: bool
) -> None:
    P, Q = curves(seed, n, m, dim)
    options: dict[str, Any] = {} if is_default else dict(OPTIONS[name])
    options["window"] = window if abs(n - m) < 4 and min(n, m) > 2 else None
    if name != "msm":
        options["metric"] = metric
    ours, theirs = (getattr(module, name)(P, Q, **options) for module in (curvewise, reference))
    assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-12)
    tables = [module.edit_table(P, Q, name, **options) for module in (curvewise, reference)]
    np.testing.assert_allclose(*tables, rtol=1e-12, atol=1e-12)
    if name == "msm" and dim > 1:
        with pytest.raises(ValueError, match="msm has no path for curves of several coordinates"):
            curvewise.edit_path(P, Q, name, **options)
        return
    path = curvewise.edit_path(P, Q, name, **options)
    assert path.distance == ours
    assert path.path[-1].tolist() == [n - 1, m - 1]
    moves = np.diff(path.path, axis=0)
    assert len(moves) == 0 or (moves.min() >= 0 and moves.max() <= 1 and moves.sum(1).min() >= 1)


@pytest.mark.parametrize("name", NAMES)
def test_across_strips(name: str) -> None:
    P, Q = curves(3, 290, 40, 1)  # a strip has 256 rows
    ours, theirs = (getattr(module, name)(P, Q) for module in (curvewise, reference))
    assert ours == pytest.approx(theirs, rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_batches_index_and_cutoff(name: str) -> None:
    lines = [curves(seed, 9 + seed, 1, 2)[0] for seed in range(6)]
    measure = getattr(curvewise, name)
    options = OPTIONS[name]
    matrix = curvewise.cdist(lines, lines[::-1], name, workers=2, **options)[:, ::-1]
    np.testing.assert_array_equal(
        matrix, [[measure(P, Q, **options) for Q in lines] for P in lines]
    )
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-12)
    limit = float(np.median(matrix))
    cut = curvewise.cdist(lines, measure=name, cutoff=limit, **options)
    np.testing.assert_allclose(cut, np.where(matrix > limit, np.inf, matrix), atol=1e-12)
    assert measure(lines[0], lines[5], cutoff=matrix[0, 5], **options) == matrix[0, 5]
    distances, places = curvewise.Index(lines, name, **options).kneighbors(lines[:2], n_neighbors=4)
    order = np.argsort(matrix[:2], axis=1, kind="stable")[:, :4]
    np.testing.assert_array_equal(places, order)
    np.testing.assert_array_equal(distances, np.take_along_axis(matrix[:2], order, 1))
    assert curvewise.Prepared(lines[0], name, **options)(lines[3]) == matrix[0, 3]
    assert len(curvewise.pdist(lines, name, **options)) == 15


def test_closed_forms() -> None:
    assert curvewise.lcss([1, 2, 3], [9, 9], epsilon=1) == 1.0
    assert curvewise.lcss(A, A, epsilon=0) == 0.0
    assert curvewise.edr(A, A + 9, epsilon=1) == 1.0
    assert curvewise.erp([1, 2, 3], [2, 3]) == 3.0  # leaving out the first point would cost 6
    assert curvewise.msm([1, 1], [1]) == 1.0
    assert curvewise.twe([0, 1], [0, 1]) == 0.0
    assert curvewise.wdtw([0, 0], [2, 2], steepness=0) == (4 + 4) / 2


def test_edr_takes_a_quarter_of_the_larger_deviation() -> None:
    P, Q = curves(8, 20, 22, 2)
    epsilon = max(P.std(), Q.std()) / 4
    assert curvewise.edr(P, Q) == curvewise.edr(P, Q, epsilon=epsilon)


@settings(max_examples=20)
@given(
    seed=st.integers(0, 999),
    n=st.integers(1, 30),
    m=st.integers(1, 30),
    dim=st.integers(1, 4),
    metric=st.sampled_from(["euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"]),
)
def test_hausdorff_is_that_of_the_reference(
    seed: int, n: int, m: int, dim: int, metric: str
) -> None:
    P, Q = curves(seed, n, m, dim)
    options = {"metric": metric, "p": 3} if metric == "minkowski" else {"metric": metric}
    ours, theirs = (module.hausdorff(P, Q, **options) for module in (curvewise, reference))
    assert ours == (pytest.approx(theirs, rel=1e-12) if metric == "minkowski" else theirs)
    assert curvewise.frechet(P, Q, **options) >= ours * (1 - 1e-12)
    assert curvewise.hausdorff(P[::-1], Q, **options) == ours
    assert curvewise.hausdorff(P * 2.0**600, Q * 2.0**600) == 2.0**600 * curvewise.hausdorff(P, Q)
    if ours > 0:
        assert curvewise.hausdorff(P, Q, cutoff=ours / 2, **options) == np.inf


def test_hausdorff_is_that_of_scipy() -> None:
    distance = pytest.importorskip("scipy.spatial.distance", reason="no scipy: pip install scipy")
    for seed in range(20):
        P, Q = np.random.default_rng(seed).normal(size=(2, 40, 3))
        both = [distance.directed_hausdorff(*pair)[0] for pair in ((P, Q), (Q, P))]
        assert curvewise.hausdorff(P, Q) == pytest.approx(max(both), rel=1e-12)


ERRORS = [
    ("erp", {"gap": np.nan}, "gap is nan; give a number"),
    ("edr", {"epsilon": -1}, "epsilon is -1; give a number >= 0, or None"),
    ("lcss", {"epsilon": -1}, "epsilon is -1; give a number >= 0"),
    ("msm", {"cost": "x"}, "cost is 'x'; give a number >= 0"),
    ("twe", {"penalty": -1}, "penalty is -1; give a number >= 0"),
    ("wdtw", {"steepness": -0.5}, "steepness is -0.5; give a number >= 0"),
    ("erp", {"window": -1}, "window is -1; give a whole number >= 0"),
    ("erp", {"metric": "foo"}, "unknown metric 'foo'"),
]


@pytest.mark.parametrize(("name", "options", "message"), ERRORS)
@pytest.mark.parametrize("module", [curvewise, reference])
def test_errors(module: Any, name: str, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match="^" + message):
        getattr(module, name)([1, 2], [1, 2], **options)


def test_errors_of_paths() -> None:
    with pytest.raises(ValueError, match="unknown measure 'dtw'; choose from erp"):
        curvewise.edit_path([1], [1], "dtw")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="window=0 admits no path between 2 and 3 points"):
        curvewise.edit_table([1, 2], [1, 2, 3], "msm", window=0)
    with pytest.raises(TypeError, match="msm has no option 'metric'"):
        curvewise.cdist([[1, 2]], measure="msm", metric="cityblock")
