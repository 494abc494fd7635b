"""missing="skip": points with a nan take no part, for every measure and every way to call it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise.fitting import fit_material
from curvewise.materials import ChabocheVoce

Array = npt.NDArray[np.float64]
POINTWISE = ("sum_of_squares", "mse", "mae")
SINGLE = ("area", "frechet", "dtw", "erp", "edr", "lcss", "msm", "twe", "wdtw")


def with_gaps(dim: int, count: int = 40) -> tuple[Array, Array]:
    """Return a curve with gaps, and which points are there."""
    rng = np.random.default_rng([dim, count])
    curve = np.cumsum(rng.normal(size=(count, dim)), axis=0)
    for i in (0, 7, 8, count - 1):
        curve[i, rng.integers(dim)] = np.nan
    return curve, ~np.isnan(curve).any(axis=1)


@pytest.mark.parametrize("measure", SINGLE)
def test_missing_points_take_no_part(measure: str) -> None:
    function: Callable[..., float] = getattr(curvewise, measure)
    (P, p), (Q, q) = (with_gaps(1 if measure == "msm" else 2, count) for count in (40, 31))
    with pytest.warns(UserWarning, match="points left out, nan") as said:
        value = function(P, Q, missing="skip")
    assert value == function(P[p], Q[q])
    assert [str(one.message) for one in said] == [
        "P: 4 of 40 points left out, nan; the first is point 0",
        "Q: 4 of 31 points left out, nan; the first is point 0",
    ]
    assert {one.filename for one in said} == {__file__}
    with pytest.raises(ValueError, match=r"^P\[0, \d\] is nan; curves must be finite$"):
        function(P, Q)
    with pytest.raises(ValueError, match=r"is inf; curves must be finite$"):
        function(np.where(np.isnan(P), np.inf, P), Q[q], missing="skip")
    with pytest.raises(ValueError, match=r"^unknown missing 'drop'; choose from refuse, skip$"):
        function(P, Q, missing="drop")


@pytest.mark.parametrize("measure", POINTWISE)
def test_a_point_that_one_curve_lacks_is_left_out_of_both(measure: str) -> None:
    function: Callable[..., float] = getattr(curvewise, measure)
    P, Q = np.arange(12.0).reshape(6, 2), np.arange(12.0).reshape(6, 2) ** 2
    P[1, 0] = Q[4, 1] = np.nan
    there = [0, 2, 3, 5]
    with pytest.warns(UserWarning, match=r"^P and Q: 2 of 6 points left out, nan; .* point 1$"):
        assert function(P, Q, missing="skip") == function(P[there], Q[there])
    with pytest.raises(ValueError, match="needs equal shapes"):
        function(P, Q[1:], missing="skip")
    with pytest.raises(ValueError, match=r"^P\[1, 0\] is nan"):
        function(P, Q)


def test_without_gaps_nothing_is_said_and_nothing_else_is_left() -> None:
    P, Q = [0, 1, 2, 3], [0, 2, 3]
    assert curvewise.dtw(P, Q, missing="skip") == curvewise.dtw(P, Q)
    with (
        pytest.warns(UserWarning, match="2 of 2 points left out"),
        pytest.raises(ValueError, match=r"^P has shape \(0,\); dtw needs at least 1 point$"),
    ):
        curvewise.dtw([np.nan, np.nan], Q, missing="skip")


def test_many_curves() -> None:
    given = [with_gaps(2, count) for count in (40, 31, 33)] + [(np.eye(2), np.ones(2, bool))]
    curves, whole = [curve for curve, _ in given], [curve[there] for curve, there in given]
    for measure in ("dtw", "hausdorff"):
        with pytest.warns(UserWarning, match="points left out") as said:
            found = curvewise.cdist(curves, measure=measure, missing="skip")
        assert found.tolist() == curvewise.cdist(whole, measure=measure).tolist()
        assert str(said[2].message) == "XA[2]: 4 of 33 points left out, nan; the first is point 0"
        assert len(said) == 3
        with pytest.warns(UserWarning, match="points left out") as said:
            curvewise.cdist(whole, curves, measure, missing="skip")
        assert str(said[0].message).startswith("XB[0]: 4 of 40 points left out")
        with pytest.warns(UserWarning, match=r"^X\[\d\]: 4 of"):
            condensed = curvewise.pdist(curves, measure, missing="skip")
        assert condensed.tolist() == curvewise.pdist(whole, measure).tolist()
        with pytest.raises(ValueError, match=r"XA\[0\]\[0, \d\] is nan"):
            curvewise.cdist(curves, measure=measure)


def test_compare() -> None:
    P, p = with_gaps(2)
    Q = P[p] + 0.1
    with pytest.warns(UserWarning, match="^P: 4 of 40 points left out, nan; the first is point 0$"):
        found = curvewise.compare(P, Q, missing="skip")
    assert found.values == curvewise.compare(P[p], Q).values
    assert len(found.P) == 36
    with pytest.raises(ValueError, match="is nan"):
        curvewise.compare(P, Q)


def test_a_material_is_fitted_to_the_points_that_are_there() -> None:
    steel = ChabocheVoce(backstresses=1)
    strain = np.interp(np.arange(121) / 40, range(4), [0.0, 0.02, -0.02, 0.02])
    made_of = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0), strict=True))
    test = np.column_stack((strain, steel.stress(strain, made_of)))
    gaps = test.copy()
    gaps[[20, 66], [1, 0]] = np.nan
    with pytest.warns(UserWarning, match=r"^tests\[0\]: 2 of 121 points left out, nan"):
        found = fit_material(gaps, steel, progress=False, missing="skip")
    there = fit_material(np.delete(test, [20, 66], axis=0), steel, progress=False)
    assert found.parameters == there.parameters


def test_the_command_line_leaves_out_rows_that_are_not_finite(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    from curvewise.commands.command_line import main

    P, p = with_gaps(2)
    files = [str(tmp_path / name) for name in ("a.csv", "b.csv")]
    np.savetxt(files[0], P, delimiter=",")
    np.savetxt(files[1], P[p] + 0.1, delimiter=",")
    arguments: list[Any] = ["compare", *files, "--measures", "dtw", "--skip-invalid"]
    assert main(arguments) == 0
    printed = capfd.readouterr()
    assert "4 of 40 lines left out" in printed.err
    value = curvewise.compare(P[p], P[p] + 0.1, measures=["dtw"])["dtw"]
    assert f"dtw  {value:.6g}" in printed.out
