"""Step patterns: against the reference, against R's dtw, and known properties of their paths."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import StepPattern, reference
from curvewise._options import StepPatternName

NAMES = get_args(StepPatternName)
# Distance and what R's dtw divides it by, of the curves below, by dtw-python 1.9.0.
A = np.array([0.0, 1.0, 3.0, 2.5, 4.0, 6.0, 5.0, 5.5])
B = np.array([0.5, 0.0, 2.0, 4.0, 3.0, 5.0, 6.5, 5.0, 5.0])
OF_R: dict[str, tuple[float, float | None]] = {
    "symmetric1": (5.0, None),
    "symmetric2": (7.5, 0.4411764705882353),
    "asymmetric": (4.0, 0.5),
    "symmetricP0": (7.5, 0.4411764705882353),
    "symmetricP05": (9.0, 0.5294117647058824),
    "symmetricP1": (9.5, 0.5588235294117647),
    "symmetricP2": (10.5, 0.6176470588235294),
    "asymmetricP0": (3.5, 0.4375),
    "asymmetricP05": (4.666666666666666, 0.5833333333333333),
    "asymmetricP1": (4.75, 0.59375),
    "asymmetricP2": (5.0, 0.625),
    "typeIa": (3.5, None),
    "typeIb": (6.0, None),
    "typeIc": (4.5, 0.5625),
    "typeId": (9.5, 0.5588235294117647),
    "typeIas": (4.0, None),
    "typeIbs": (6.0, None),
    "typeIcs": (4.75, 0.59375),
    "typeIds": (9.5, 0.5588235294117647),
    "typeIIa": (3.5, None),
    "typeIIb": (5.0, None),
    "typeIIc": (4.0, 0.5),
    "typeIId": (8.0, 0.47058823529411764),
    "typeIIIc": (4.0, 0.5),
    "typeIVc": (4.0, 0.5),
    "rigid": (np.inf, np.inf),
    "mori2006": (15.0, 1.6666666666666667),
}


def curves(seed: int, n: int, m: int, dim: int) -> tuple[Any, Any]:
    rng = np.random.default_rng(seed)
    return rng.integers(0, 9, (n, dim)) / 2, rng.integers(0, 9, (m, dim)) / 2


def of_both(function: str, P: Any, Q: Any, **options: Any) -> tuple[Any, Any]:
    return tuple(getattr(module, function)(P, Q, **options) for module in (curvewise, reference))


@pytest.mark.parametrize("name", NAMES)
def test_distances_and_normalisations_are_those_of_r(name: str) -> None:
    distance, normalized = OF_R[name]
    assert curvewise.dtw(A, B, step_pattern=name) == pytest.approx(distance, rel=1e-12)
    if normalized is None:
        with pytest.raises(ValueError, match="normalize needs"):
            curvewise.dtw(A, B, step_pattern=name, normalize=True)
    else:
        found = curvewise.dtw(A, B, step_pattern=name, normalize=True)
        assert found == pytest.approx(normalized, rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=6)
@given(
    seed=st.integers(0, 999),
    n=st.integers(1, 24),
    m=st.integers(1, 24),
    dim=st.integers(1, 4),
    metric=st.sampled_from(["euclidean", "sqeuclidean", "cityblock", "chebyshev"]),
    penalty=st.sampled_from([0.0, 0.3]),
    window=st.sampled_from([None, 3, 0.9]),
)
def test_bits_are_those_of_the_reference(
    name: str, seed: int, n: int, m: int, dim: int, metric: str, penalty: float, window: Any
) -> None:
    P, Q = curves(seed, n, m, dim)
    options = {"step_pattern": name, "metric": metric, "penalty": penalty, "window": window}
    if abs(n - m) > 3 or min(n, m) < 3:
        options["window"] = None
    ours, theirs = of_both("dtw", P, Q, **options)
    assert ours == theirs
    np.testing.assert_array_equal(*of_both("dtw_table", P, Q, **options))
    if np.isfinite(ours):
        ours, theirs = of_both("dtw_path", P, Q, **options)
        assert ours.distance == theirs.distance
        np.testing.assert_array_equal(ours.path, theirs.path)


@pytest.mark.parametrize("name", ["symmetricP2", "typeIVc", "asymmetric"])
def test_bits_across_strips(name: str) -> None:
    P, Q = curves(3, 300, 180, 2)  # a strip has 256 rows
    ours, theirs = of_both("dtw_path", P, Q, step_pattern=name)
    assert ours.distance == theirs.distance
    np.testing.assert_array_equal(ours.path, theirs.path)


def test_a_path_that_is_halved_costs_what_the_distance_is() -> None:
    rng = np.random.default_rng(5)
    P, Q = rng.normal(size=(3000, 1)).cumsum(0), rng.normal(size=(2800, 1)).cumsum(0)
    found = curvewise.dtw_path(P, Q, step_pattern="symmetricP1")
    i, j = found.path.T
    cost = np.abs(P[i, 0] - Q[j, 0])
    moves = np.diff(found.path, axis=0)
    total = cost[0] + sum(cost[1:] * moves.sum(axis=1))
    assert found.path[0].tolist() == [0, 0]
    assert found.path[-1].tolist() == [2999, 2799]
    assert moves.min() >= 0
    assert moves.max() == 1
    assert total == pytest.approx(found.distance, rel=1e-12)


def test_slopes_are_limited() -> None:
    P, Q = curves(1, 30, 30, 1)
    for name, most in {"symmetricP05": 2, "symmetricP1": 1}.items():
        moves = np.diff(curvewise.dtw_path(P, Q, step_pattern=name).path, axis=0)
        straight = "".join("x" if move.sum() == 1 else "." for move in moves)
        assert "." in straight
        assert "x" * (most + 1) not in straight
    assert curvewise.dtw(P[:10], Q, step_pattern="symmetricP1") == np.inf
    assert curvewise.dtw(P, Q, step_pattern="rigid") == np.abs(P - Q).sum()


def test_a_penalty_is_paid_for_each_step_off_the_diagonal() -> None:
    assert curvewise.dtw([0, 1, 2], [0, 1, 1, 2], penalty=0.25) == 0.25
    assert curvewise.dtw([0, 1, 2], [0, 1, 1, 2]) == 0.0
    P, Q = curves(2, 20, 20, 2)
    values = [curvewise.dtw(P, Q, penalty=penalty) for penalty in (0, 0.1, 1, 1e6)]
    assert values == sorted(values)
    assert values[-1] == pytest.approx(np.linalg.norm(P - Q, axis=1).sum(), rel=1e-12)


@pytest.mark.parametrize("metric", ["euclidean", "sqeuclidean"])
def test_a_penalty_may_be_far_larger_than_the_curves(metric: Any) -> None:
    P, Q = (1e-140 * curve for curve in curves(3, 20, 20, 2))
    for penalty in (1e-130, 1.0, 1e150):
        for dtw in (curvewise.dtw, curvewise.reference.dtw):
            straight = dtw(P, Q, metric=metric, step_pattern="rigid")
            assert dtw(P, Q, metric=metric, penalty=penalty) == pytest.approx(straight, rel=1e-14)
            assert dtw(P[:17], Q, metric=metric, penalty=penalty) == pytest.approx(3 * penalty)


def test_an_own_pattern_is_the_named_one_of_its_rows() -> None:
    P, Q = curves(4, 30, 34, 2)
    for name in NAMES:
        own = StepPattern.named(name)
        again = StepPattern(list(own.rows), own.normalization)
        assert again == own
        # Steps that the library has not compiled: the first of them once more.
        steps = [(99, *row[1:]) for row in own.rows if row[0] == own.rows[0][0]]
        twice = StepPattern([*own.rows, *steps], own.normalization)
        assert curvewise.dtw(P, Q, step_pattern=twice) == curvewise.dtw(P, Q, step_pattern=name)
        assert curvewise.dtw(P, Q, step_pattern=again) == curvewise.dtw(P, Q, step_pattern=name)
    assert StepPattern.rabiner_juang(2, "c") == StepPattern.named("typeIc")
    assert StepPattern.rabiner_juang(5) != StepPattern.rabiner_juang(5, smoothed=True)


def test_batches_take_patterns() -> None:
    lines = [curves(seed, 10 + seed, 1, 1)[0] for seed in range(6)]
    for options in ({"step_pattern": "symmetricP0"}, {"penalty": 0.5}):
        matrix = curvewise.cdist(lines, measure="dtw", **options)
        expected = [[curvewise.dtw(P, Q, **options) for Q in lines] for P in lines]
        np.testing.assert_array_equal(matrix, expected)
        index = curvewise.Index(lines, "dtw", **options)
        distances, _ = index.kneighbors(lines[:2], n_neighbors=3)
        np.testing.assert_array_equal(distances, np.sort(matrix[:2])[:, :3])
        assert curvewise.Prepared(lines[0], "dtw", **options)(lines[1]) == matrix[0, 1]
        limit = float(np.median(matrix))
        cut = curvewise.cdist(lines, measure="dtw", cutoff=limit, **options)
        np.testing.assert_array_equal(cut, np.where(matrix > limit, np.inf, matrix))
    with pytest.raises(ValueError, match="needs a symmetric measure"):
        curvewise.pdist(lines, "dtw", step_pattern="asymmetric")


def test_large_and_small_curves() -> None:
    P, Q = curves(6, 20, 22, 2)
    for factor in (2.0**600, 2.0**-600):
        for options in ({"step_pattern": "typeIIIc"}, {"penalty": 0.5}):
            scaled = {**options, "penalty": options.get("penalty", 0.0) * factor}
            assert curvewise.dtw(P * factor, Q * factor, **scaled) == factor * curvewise.dtw(
                P, Q, **options
            )


ERRORS = [
    (
        {"step_pattern": "typeV"},
        "unknown step_pattern 'typeV'; choose from symmetric1, symmetric2,",
    ),
    ({"penalty": -1}, "penalty is -1; give a number >= 0"),
    ({"penalty": "x"}, "penalty is 'x'; give a number >= 0"),
    (
        {"step_pattern": "typeIa", "open_end": True},
        "open_end needs step_pattern='symmetric1' without a penalty, or a step pattern whose paths "
        "all have one weight, such as 'symmetric2' or 'asymmetric'; those of typeIa differ",
    ),
    (
        {"penalty": 1, "open_end": True},
        "open_end needs step_pattern='symmetric1' without a penalty, or a step pattern whose paths "
        "all have one weight, such as 'symmetric2' or 'asymmetric'; those of symmetric1 differ",
    ),
    (
        {"step_pattern": "symmetric2", "open_begin": True, "open_end": True},
        "open_begin needs step_pattern='symmetric1' without a penalty, or a step pattern "
        "normalised by N, such as 'asymmetric'; symmetric2 is not",
    ),
    (
        {"step_pattern": StepPattern([(1, 1, 1, -1), (1, 0, 0, 1)]), "open_begin": True},
        "open_begin needs step_pattern='symmetric1' without a penalty, or a step pattern "
        "normalised by N, such as 'asymmetric'; of one's own is not",
    ),
    (
        {"step_pattern": "asymmetric", "open_end": True, "window": 3},
        "open_begin and open_end cannot be combined with window",
    ),
    (
        {"step_pattern": "typeIa", "normalize": True},
        "normalize needs a step pattern whose paths all have one weight, such as 'symmetric2'; "
        "those of typeIa differ",
    ),
]


@pytest.mark.parametrize(("options", "message"), ERRORS)
@pytest.mark.parametrize("module", [curvewise, reference])
def test_errors(module: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match="^" + message.replace(".", r"\.")):
        module.dtw([1, 2], [1, 2], **options)


def test_errors_of_patterns() -> None:
    with pytest.raises(ValueError, match="the first row of each step has the weight -1"):
        StepPattern([(1, 1, 1, 1.0)])
    with pytest.raises(ValueError, match="rows are of four numbers"):
        StepPattern([(1, 1, 1)])  # type: ignore[list-item]
    with pytest.raises(ValueError, match="rows is empty"):
        StepPattern([])
    with pytest.raises(ValueError, match="type is 8; 1 to 7"):
        StepPattern.rabiner_juang(8)
    far = StepPattern([(1, 9, 1, -1), (1, 0, 0, 1)])
    with pytest.raises(ValueError, match="step 1 of the pattern is longer than 8 rows or columns"):
        curvewise.dtw([1], [1], step_pattern=far)
    for measure in (curvewise.value_and_gradient,):
        with pytest.raises(ValueError, match="a gradient needs step_pattern='symmetric1'"):
            measure([1, 2], [1, 2], measure="dtw", step_pattern="typeIa")


def test_the_picture_has_a_line_for_each_step() -> None:
    pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    (ax,) = StepPattern.named("symmetricP05").plot().axes
    assert len(ax.lines) == 5
    assert [text.get_text() for text in ax.texts].count("2") == 5
