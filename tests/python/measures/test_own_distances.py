"""A custom ground distance: a matrix, or a function of two blocks of points.

Results are compared by == with the reference, on matrices full of ties and of pairs that must not
meet. On curves of more rows than the sweep requests at a time, they are compared with the library's
own metrics of the same numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.curves.ground_distance import ground_distances

Array = npt.NDArray[np.float64]

KNIGHT = curvewise.StepPattern([(1, 1, 1, -1), (1, 0, 0, 2), (2, 2, 1, -1), (2, 0, 0, 1)])
DTW_OPTIONS: list[dict[str, Any]] = [
    {},
    {"step_pattern": "symmetric2"},
    {"window": 3},
    {"step_pattern": "symmetric2", "window": 0.5},
    {"open_begin": True, "open_end": True},
    {"open_end": True},
    {"penalty": 0.5},
    {"penalty": 0.5, "window": 4},
    {"step_pattern": "symmetricP1"},
    {"step_pattern": "asymmetricP05"},
    {"step_pattern": KNIGHT},
]
COSTS = st.sampled_from([0.0, 0.5, 1.0, 1.0, 2.0, 3.25, np.inf])


def canberra(p: Array, q: Array) -> Array:
    """Return the sums of abs(x - y) / (abs(x) + abs(y)), coordinate by coordinate."""
    total = np.zeros((len(p), len(q)))
    for x, y in zip(p.T[:, :, np.newaxis], q.T[:, np.newaxis, :], strict=True):
        size = np.abs(x) + np.abs(y)
        total += np.abs(x - y) / np.where(size > 0, size, 1.0)
    return total


class Asked:
    """A metric that records its calls."""

    def __init__(self, metric: Callable[[Array, Array], Array]) -> None:
        self.metric = metric
        self.shapes: list[tuple[int, int]] = []

    def __call__(self, p: Array, q: Array) -> Array:
        self.shapes.append((len(p), len(q)))
        return self.metric(p, q)


def random_pair(n: int, m: int, d: int, seed: int = 0) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, d)).cumsum(axis=0), rng.normal(size=(m, d)).cumsum(axis=0)


@st.composite
def matrices(draw: st.DrawFn) -> Array:
    n, m = draw(st.integers(1, 12)), draw(st.integers(1, 12))
    cells = st.lists(COSTS, min_size=n * m, max_size=n * m)
    return np.array(draw(cells)).reshape(n, m)


def same(found: Any, expected: Any) -> bool:
    """Return whether two alignments are equal; if there is not a path, compare their distances
    alone.
    """
    if np.isinf(expected.distance):
        return bool(found.distance == expected.distance)
    return found.distance == expected.distance and np.array_equal(found.path, expected.path)


@pytest.mark.parametrize("options", DTW_OPTIONS)
@given(matrix=matrices())
@settings(max_examples=15)
def test_dtw_of_a_matrix_has_the_bits_of_the_reference(
    matrix: Array, options: dict[str, Any]
) -> None:
    P, Q = (np.zeros((k, 2)) for k in matrix.shape)
    given_options = {"metric": matrix, **options}
    value = reference.dtw(P, Q, **given_options)
    assert curvewise.dtw(P, Q, **given_options) == value
    assert curvewise.dtw_info(P, Q, **given_options).value == value
    assert curvewise.dtw(P, Q, **given_options, cutoff=2.0) == (value if value <= 2 else np.inf)
    assert same(
        curvewise.dtw_path(P, Q, **given_options), reference.dtw_path(P, Q, **given_options)
    )
    table = reference.dtw_table(P, Q, **given_options)
    assert np.array_equal(curvewise.dtw_table(P, Q, **given_options), table)


@given(matrix=matrices())
def test_frechet_of_a_matrix_has_the_bits_of_the_reference(matrix: Array) -> None:
    P, Q = (np.zeros(k) for k in matrix.shape)
    value = reference.frechet(P, Q, metric=matrix)
    assert curvewise.frechet(P, Q, metric=matrix) == value
    assert curvewise.frechet_info(P, Q, metric=matrix).value == value
    assert curvewise.frechet(P, Q, metric=matrix, cutoff=1.0) == (value if value <= 1 else np.inf)
    path = reference.frechet_path(P, Q, metric=matrix)
    assert same(curvewise.frechet_path(P, Q, metric=matrix), path)
    table = reference.frechet_table(P, Q, metric=matrix)
    assert np.array_equal(curvewise.frechet_table(P, Q, metric=matrix), table)


@pytest.mark.parametrize(
    ("n", "m", "d"), [(1, 1, 1), (1, 40, 4), (40, 1, 7), (33, 31, 3), (256, 20, 1), (257, 9, 2)]
)
def test_a_callable_is_the_matrix_of_its_numbers(n: int, m: int, d: int) -> None:
    P, Q = random_pair(n, m, d)
    matrix = canberra(P, Q)
    for options in ({}, {"step_pattern": "symmetric2"}, {"window": 30}, {"penalty": 0.1}):
        expected = reference.dtw(P, Q, metric=matrix, **options)
        assert curvewise.dtw(P, Q, metric=canberra, **options) == expected
        assert curvewise.dtw(P, Q, metric=matrix, **options) == expected
        found = curvewise.dtw_path(P, Q, metric=canberra, **options)
        assert same(found, curvewise.dtw_path(P, Q, metric=matrix, **options))
        table = reference.dtw_table(P, Q, metric=matrix, **options)
        assert np.array_equal(curvewise.dtw_table(P, Q, metric=canberra, **options), table)
    expected = reference.frechet(P, Q, metric=matrix)
    assert curvewise.frechet(P, Q, metric=canberra) == expected
    assert same(
        curvewise.frechet_path(P, Q, metric=canberra), reference.frechet_path(P, Q, metric=matrix)
    )
    assert np.array_equal(
        curvewise.frechet_table(P, Q, metric=canberra),
        reference.frechet_table(P, Q, metric=matrix),
    )


@pytest.mark.parametrize("metric", ["euclidean", "sqeuclidean", "chebyshev"])
@pytest.mark.parametrize(("n", "m"), [(255, 513), (600, 300), (30, 9000)])
def test_the_numbers_of_a_metric_give_its_bits(n: int, m: int, metric: Any) -> None:
    P, Q = random_pair(n, m, 2, seed=1)
    asked = Asked(lambda p, q: ground_distances(p[:, np.newaxis], q, metric, 2.0))
    for options in ({}, {"window": 0.1}, {"step_pattern": "asymmetricP05"}):
        expected = curvewise.dtw_path(P, Q, metric=metric, **options)
        assert same(curvewise.dtw_path(P, Q, metric=asked, **options), expected)
        assert curvewise.dtw(P, Q, metric=asked, **options) == expected.distance
    assert curvewise.frechet(P, Q, metric=asked) == curvewise.frechet(P, Q, metric=metric)


@pytest.mark.parametrize(
    ("n", "m", "options"),
    [(4200, 4020, {}), (4300, 4000, {"window": 3900}), (2300, 2200, {"penalty": 0.25})],
)
def test_a_long_path_is_that_of_the_metric(n: int, m: int, options: dict[str, Any]) -> None:
    """Longer than what steps are kept for at once: found by halves, whose strips are asked for."""
    P, Q = random_pair(n, m, 1, seed=2)
    asked = Asked(lambda p, q: np.abs(p - q.T))
    expected = curvewise.dtw_path(P, Q, metric="cityblock", **options)
    assert same(curvewise.dtw_path(P, Q, metric=asked, **options), expected)
    assert max(rows for rows, _ in asked.shapes) <= 264
    if not options:
        found = curvewise.frechet_path(P, Q, metric=asked)
        assert same(found, curvewise.frechet_path(P, Q, metric="cityblock"))


def test_only_some_rows_and_the_window_are_asked_for() -> None:
    P, Q = random_pair(1000, 1000, 2)
    asked = Asked(canberra)
    curvewise.dtw(P, Q, metric=asked)
    assert sum(rows for rows, _ in asked.shapes) == 1000
    assert all(rows <= 256 and columns == 1000 for rows, columns in asked.shapes)
    whole = sum(rows * columns for rows, columns in asked.shapes)
    asked.shapes.clear()
    curvewise.dtw(P, Q, metric=asked, window=10)
    assert sum(rows * columns for rows, columns in asked.shapes) < 0.3 * whole
    wide = Asked(lambda p, q: np.zeros((len(p), len(q))))
    assert curvewise.frechet(np.zeros(3), np.zeros(2**21), metric=wide) == 0.0
    assert wide.shapes == [(1, 2**21)] * 3


def test_a_large_matrix_is_checked_to_its_end() -> None:
    P, Q = np.zeros(1100), np.zeros(2000)
    matrix = np.zeros((1100, 2000), dtype=np.float32)
    assert curvewise.dtw(P, Q, metric=matrix, window=0.5) == 0.0
    matrix[1090, 7] = np.nan  # outside of the window
    match = r"metric\[1090, 7\] is nan"
    refused(ValueError, match, lambda: curvewise.dtw(P, Q, metric=matrix, window=0.1))
    asked = Asked(lambda p, q: np.where(np.arange(len(q)) == 3, -1.0, p - q.T))
    match = r"metric of P\[0\] and Q\[3\] is -1.0"
    refused(ValueError, match, lambda: curvewise.dtw(P, Q, metric=asked))


def test_the_example_of_dtw_python() -> None:
    """The example in the docstring of its dtw (Giorgino 2009), with the printed numbers."""
    costs = np.ones((6, 6))
    costs[1, :] = costs[:, 4] = 0.0
    costs[1, 4] = 0.01
    for pattern in ("symmetric2", "asymmetric"):
        found = curvewise.dtw(range(6), range(6), metric=costs, step_pattern=pattern)
        assert found == 2.0


def test_a_function_gets_points_as_rows_and_curves_stay() -> None:
    P, Q = [1, 2, 4], [1.0, 4.0]

    def ratio(p: Array, q: Array) -> Any:
        assert p.shape == (3, 1)
        assert q.shape == (2, 1)
        return np.abs(np.log2(p) - np.log2(q).T).astype(np.float32).tolist()

    assert curvewise.dtw(P, Q, metric=ratio) == 1.0
    assert curvewise.dtw(P, Q, metric=[[0, 2], [1, 1], [2, 0]]) == 1.0
    assert curvewise.frechet(P, Q, metric=np.array([[0, 2], [1, 1], [2, 0]], order="F")) == 1.0
    assert curvewise.dtw(P, Q, metric=np.array([[True, True]] * 3)[:, ::-1]) == 3.0


def test_a_picture_marks_the_pair_of_the_own_distance() -> None:
    figure = pytest.importorskip("matplotlib.figure")
    P, Q = [0.0, 1.0, 2.0], [0.0, 5.0]
    costs = np.array([[0.0, 9.0], [3.0, 1.0], [8.0, 0.5]])
    for metric in (
        costs,
        lambda p, q: costs[np.ix_(p[:, 0].astype(int), (q[:, 0] > 0).astype(int))],
    ):
        ax = figure.Figure().subplots()
        artists = curvewise.plotting.plot_alignment(P, Q, ax, measure="frechet", metric=metric)
        assert curvewise.frechet(P, Q, metric=metric) == 1.0
        assert artists.accent.get_xdata().tolist() == [1.0, 1.0]


def test_batches_call_a_function_pair_by_pair() -> None:
    curves = [random_pair(n, 1, 2, seed=n)[0] for n in (5, 9, 12, 3)]

    def ahead(p: Array, q: Array) -> Array:  # not symmetric
        return np.maximum(p[:, :1] - q[:, 0], 0.0) + 0.25 * np.abs(p[:, 1:] - q[:, 1])

    expected = np.array([[reference.dtw(p, q, metric=ahead) for q in curves] for p in curves])
    assert not np.array_equal(expected, expected.T)
    assert np.array_equal(curvewise.cdist(curves, metric=ahead), expected)
    assert np.array_equal(curvewise.cdist(curves[:2], curves, metric=ahead), expected[:2])
    triangle = expected[np.triu_indices(4, 1)]
    assert np.array_equal(curvewise.pdist(curves, metric=ahead), triangle)
    limit = float(np.median(triangle))
    limited = curvewise.pdist(curves, metric=ahead, cutoff=limit)
    assert np.array_equal(limited, np.where(triangle > limit, np.inf, triangle))
    leashes = [reference.frechet(p, q, metric=ahead) for p in curves for q in curves]
    assert curvewise.cdist(curves, measure="frechet", metric=ahead).ravel().tolist() == leashes


def refused(error: type[Exception], match: str, call: Callable[[], object]) -> None:
    with pytest.raises(error, match=match):
        call()


@pytest.mark.parametrize("package", [curvewise, reference])
@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize(
    ("metric", "error", "match"),
    [
        (np.zeros((2, 3)), ValueError, r"metric has shape \(2, 3\); P has 3 points and Q has 2"),
        (
            np.zeros(6),
            ValueError,
            r"metric has shape \(6,\); .* give their distances, shape \(3, 2",
        ),
        ([[0, 1], [np.nan, 0], [1, 1]], ValueError, r"metric\[1, 0\] is nan; distances are at"),
        ([[0, 1], [0, 0], [1, -2]], ValueError, r"metric\[2, 1\] is -2.0; distances are at least"),
        ([[0, 1], [0], [1, 2]], ValueError, "metric is ragged"),
        (np.zeros((3, 2), dtype=complex), TypeError, "metric has dtype complex128; distances are"),
        ([["a", "b"]] * 3, TypeError, "metric has dtype <U1; distances are real numbers"),
        (np.ma.masked_equal(np.eye(3)[:, :2], 1), TypeError, "metric has masked entries"),
        (lambda p, q: p[:, 0], ValueError, r"metric returns shape \(3,\) for blocks of points of "),
        (lambda p, q: None, TypeError, "what metric returns has dtype object"),
        (lambda p, q: p - q.T - 5, ValueError, r"metric of P\[0\] and Q\[0\] is -5.0; distances"),
        (lambda p, q: (p - q.T) * np.nan, ValueError, r"metric of P\[0\] and Q\[0\] is nan"),
        (lambda p, q: (p - q.T) * 1j, TypeError, "what metric returns has dtype complex128"),
        (3, ValueError, "unknown metric 3; choose from euclidean"),
        (b"euclidean", ValueError, "unknown metric b'euclidean'; choose from euclidean"),
    ],
)
def test_errors_of_a_metric(
    package: Any, measure: str, metric: Any, error: type[Exception], match: str
) -> None:
    refused(error, match, lambda: getattr(package, measure)([0, 1, 2], [0, 2], metric=metric))


@pytest.mark.parametrize("package", [curvewise, reference])
@pytest.mark.parametrize(
    ("metric", "match"),
    [
        (lambda a, b: np.linalg.norm(a - b), r"^metric returns shape \(\) for blocks of points of"),
        (lambda a, b: np.abs(a - b).sum(axis=-1), r"^metric returns shape \(\d,\) for blocks of"),
        (math.dist, r"^metric takes two points, and is called with blocks of them, of shapes"),
        (lambda a, b: float(np.hypot(*(a - b))), r"^metric takes two points, and is called with"),
    ],
)
def test_a_metric_of_two_points_is_told_how_to_take_blocks(
    package: Any, metric: Any, match: str
) -> None:
    P, Q = random_pair(5, 5, 2, seed=1)
    with pytest.raises(ValueError, match=match) as caught:
        package.dtw(P, Q, metric=metric)
    advice = re.search(r"metric=(lambda p, q: .*) does so", str(caught.value))
    assert advice is not None
    blocks = eval(advice[1], {"f": metric})  # what the message says to write
    fast = eval(
        f"lambda p, q: {re.search('numpy.linalg.*2.', str(caught.value))[0]}", {"numpy": np}
    )
    expected = package.dtw(P, Q, metric="euclidean")
    assert package.dtw(P, Q, metric=fast) == pytest.approx(expected)
    assert package.dtw(P, Q, metric=blocks) == pytest.approx(
        package.dtw(P, Q, metric=[[metric(a, b) for b in Q] for a in P])
    )
    with pytest.raises(TypeError, match=r"unsupported operand type\(s\) for -"):  # its own error
        package.dtw(P, Q, metric=lambda a, b: a.sum - 1.0)


@pytest.mark.parametrize("package", [curvewise, reference])
def test_errors_beside_a_metric(package: Any) -> None:
    P, Q = [0, 1, 2], [0, 2]
    matrix = np.ones((3, 2))
    beside = "applies to a metric by its name, not to one of one's own"
    refused(ValueError, f"p {beside}", lambda: package.dtw(P, Q, metric=matrix, p=3))
    refused(ValueError, f"radius {beside}", lambda: package.frechet(P, Q, metric=matrix, radius=1))
    refused(ValueError, r"Q\[1\] is nan", lambda: package.dtw(P, [0, np.nan], metric=matrix))
    shapes = "both need the same number of coordinates"
    refused(ValueError, shapes, lambda: package.dtw(P, [[0, 1]], metric=canberra))
    nothing = "is for dtw and frechet of one pair"
    for measure in ("hausdorff", "edr", "erp", "wdtw"):
        refused(ValueError, nothing, lambda m=measure: getattr(package, m)(P, Q, metric=matrix))


def test_an_exception_of_the_function_passes_through() -> None:
    class OwnError(Exception):
        pass

    def raising(p: Array, q: Array) -> Array:
        raise OwnError("of my own")

    P, Q = random_pair(300, 400, 2)
    functions: list[Callable[..., Any]] = [
        curvewise.dtw,
        curvewise.frechet,
        curvewise.dtw_path,
        curvewise.frechet_table,
        curvewise.dtw_info,
        lambda *pair, metric: curvewise.cdist(pair, metric=metric),
    ]
    for function in functions:
        refused(OwnError, "of my own", lambda f=function: f(P, Q, metric=raising))
        refused(OwnError, "of my own", lambda f=function: f(P[:3], Q[:2], metric=raising))

    def interrupted(p: Array, q: Array) -> Array:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        curvewise.dtw(P, Q, metric=interrupted)
    assert curvewise.dtw(P, P) == 0.0


def test_what_has_no_bounds_of_it_says_so() -> None:
    P, Q = random_pair(5, 4, 2)
    match = "a metric of one's own is for dtw and frechet of one pair.*nothing else computes with"
    calls: list[Callable[[], object]] = [
        lambda: curvewise.Prepared(P, "dtw", metric=canberra),
        lambda: curvewise.Index([P, Q], "frechet", metric=np.ones((5, 4))),
        lambda: curvewise.subsequence(P, Q, metric=canberra),
        lambda: curvewise.value_and_gradient(P, Q, "dtw", metric=canberra),
        lambda: curvewise.cdist([P, Q], metric=np.ones((5, 4))),
        lambda: curvewise.pdist([P, Q], "frechet", metric=np.ones((5, 4))),
        lambda: curvewise.cdist([P, Q], measure="lcss", metric=canberra, epsilon=1.0),
        lambda: curvewise.medoid([P, Q], "dtw", metric=canberra),
    ]
    for call in calls:
        refused(ValueError, match, call)


def test_errors_of_a_batch_name_the_curve_before_any_call() -> None:
    asked = Asked(canberra)
    curves = [[0.0, 1.0], [0.0, np.nan]]
    refused(ValueError, r"XA\[1\]\[1\] is nan", lambda: curvewise.cdist(curves, metric=asked))
    match = "pdist needs a symmetric measure"
    X = [[0.0, 1.0], [0.0, 2.0]]
    refused(ValueError, match, lambda: curvewise.pdist(X, metric=asked, open_end=True))
    assert not asked.shapes


@pytest.mark.parametrize("options", [{"metric": canberra}, {"measure": curvewise.dtw}])
def test_an_index_without_bounds_shows_the_form_that_sorts_all(options: dict[str, Any]) -> None:
    curves = [random_pair(5, 4, 2, seed=k)[0] for k in range(4)]
    with pytest.raises(ValueError, match="a function has none; sort all distances, ") as met:
        curvewise.Index(curves, **options)
    code = str(met.value).partition("all distances, ")[2].partition(", or give")[0]
    names = {"np": np, "curvewise": curvewise, "queries": curves, "curves": curves, "k": 2}
    found = eval(code.replace("...", "**options"), names | {"options": options})
    assert found[:, 0].tolist() == [0, 1, 2, 3]
    assert found.shape == (4, 2)
