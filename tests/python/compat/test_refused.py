"""Inputs that curvewise.compat accepts and rejects, and nan or inf results, as in that package."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd
import pytest

from curvewise import compat

Array = npt.NDArray[Any]
Convert = Callable[[Array], Any]

P = np.array([[0, 0], [2, 3], [5, 4], [7, 1], [9, 0], [11, 2]])
Q = np.array([[0, 1], [4, 6], [11, -3]])
PF, QF = P.astype(float), Q.astype(float)

PLANE_MEASURES = (
    compat.area_between_two_curves,
    compat.pcm,
    compat.curve_length_measure,
)


# ---------------------------------------------------------------- nan and inf


def test_zero_scales_give_nan_or_inf_without_a_warning() -> None:
    flat = [[0, 1], [1, 1], [2, 1]]
    point_twice = [[1.0, 1.0], [1.0, 1.0]]
    centred = [[-1, 1], [0, 2], [1, 1]]
    line = [[-1.0, 1.1], [1.0, 1.1]]
    assert np.isnan(compat.pcm(flat, line))
    assert np.isnan(compat.pcm(point_twice, line, norm_seg_length=True))
    assert compat.pcm(centred, point_twice) >= 0
    assert np.isinf(compat.curve_length_measure(centred, [[-0.9, 1.1], [1.1, 1.1]]))
    assert np.isnan(compat.curve_length_measure(-PF - 1, QF))
    assert np.isnan(compat.curve_length_measure(point_twice, line))
    assert np.isnan(compat.mae(np.empty((0, 2)), np.empty((0, 2))))
    xi, eta, xiP, _ = compat.normalizeTwoCurves([1, 1], [0, 4], [1, 2], [1, 1])
    assert np.isnan(xi).all()
    assert eta.tolist() == [0, 1]
    assert np.array_equal(xiP, [np.nan, np.inf], equal_nan=True)


@pytest.mark.parametrize("column", [0, 1])
@pytest.mark.parametrize("row", [0, 2, 5])
def test_curves_with_nan_give_nan(row: int, column: int) -> None:
    broken = PF.copy()
    broken[row, column] = np.nan
    for exp, num in ((broken, QF), (QF, broken)):
        for measure in PLANE_MEASURES:
            assert np.isnan(measure(exp, num))
        for p in (1, 2, np.inf, 0.5):
            assert np.isnan(compat.frechet_dist(exp, num, p))
        assert np.isnan(compat.dtw(exp, num)[0])
    assert np.isnan(compat.mae(broken, PF))
    assert np.isnan(compat.mse(broken, PF))


def test_tables_and_distances_of_infinite_points() -> None:
    far = np.array([[0.0, 0.0], [np.inf, 0.0]])
    assert compat.frechet_dist(far, PF) == np.inf
    _, d = compat.dtw(far, far)
    assert np.array_equal(d, [[0, np.inf], [np.inf, np.nan]], equal_nan=True)


# ---------------------------------------------------------------- accepted and rejected inputs


def test_read_only_arrays_are_accepted_and_nothing_is_changed() -> None:
    exp, num = P.copy(), QF.copy()
    for curve in (exp, num):
        curve.setflags(write=False)
    for measure in (*PLANE_MEASURES, compat.frechet_dist, compat.dtw):
        measure(exp, num)
        measure(num, exp)
    assert np.array_equal(exp, P)
    assert np.array_equal(num, QF)


def test_mean_errors() -> None:
    assert compat.mae(P[:3], Q) == np.mean([0, 1, 2, 3, 6, 7])
    assert compat.mse(num_data=Q.tolist(), exp_data=P[:3].tolist()) == 99 / 6
    assert compat.mse(PF, PF[:1]) == np.mean((PF - PF[0]) ** 2)
    one, two, three = (np.array([[value]], dtype=np.uint8) for value in (1, 2, 3))
    assert compat.mae(one, two) == 255
    assert compat.mse(one, three) == 4


def test_pandas_objects_with_different_labels_are_refused() -> None:
    frame = pd.DataFrame(PF, columns=["strain", "stress"])
    assert compat.mae(frame, frame + 1) == 1
    assert compat.mae(frame["strain"], frame["strain"] + 1) == 1
    for other in (frame.iloc[::-1], frame[["stress", "strain"]]):
        with pytest.raises(ValueError, match="labels"):
            compat.mse(frame, other)


@pytest.mark.parametrize(
    ("message", "call"),
    {
        r"exp_data has shape \(6,\); give shape \(n, 2\)": lambda: compat.pcm(PF[:, 0], QF),
        r"exp_data has shape \(1, 2\); .* at least 2 points": (
            lambda: compat.area_between_two_curves(QF[:1], PF)
        ),
        r"num_data has shape \(0, 2\); it needs at least 1 point": (
            lambda: compat.curve_length_measure(PF, QF[:0])
        ),
        r"exp_data has shape \(6, 2\) and num_data has shape \(3, 2\); mae needs equal shapes": (
            lambda: compat.mae(PF, QF)
        ),
        "give four vertices": lambda: compat.makeQuad([0, 1], [0, 1]),
        "x has 2 entries and y has 1; give .* vertex": lambda: compat.poly_area([0, 1], [0]),
        "x has 2 entries and y has 1; give .* point": lambda: compat.get_length([0, 1], [0]),
        r"shape \(2,\)": lambda: compat.get_arc_length([0, 1]),
        r"ab has shape \(1,\); give one edge": (
            lambda: compat.is_simple_quad([1], [1, 1], [1, 1], [1, 1])
        ),
    }.items(),
)
def test_refused_input_says_what_and_where(message: str, call: Callable[[], Any]) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_complex_curves_are_refused() -> None:
    with pytest.raises(TypeError, match="exp_data is complex"):
        compat.pcm(PF + 1j, QF)
