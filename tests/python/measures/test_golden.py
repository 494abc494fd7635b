"""What other packages computed for the same curves, and the paper's Table 4, digit by digit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import curvewise
from curvewise.calibration import Criterion, Objective

Array = npt.NDArray[np.float64]

ROWS = ("area", "pcm", "frechet", "dtw", "curve_length")


def close(found: Any, expected: Any) -> None:
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=0)


def read_curve(file: Path) -> Array:
    with file.open() as lines:
        header = int(not next(lines)[0].lstrip("-").isdigit())
    return np.asarray(np.loadtxt(file, delimiter=",", skiprows=header))


@pytest.fixture(scope="session")
def golden(data_dir: Path) -> dict[str, dict[str, Any]]:
    """Return, by case, the curves and what other packages computed for them."""
    expected = json.loads((data_dir / "golden" / "expected.json").read_text())["values"]
    with np.load(data_dir / "golden" / "cases.npz") as curves:
        for name, case in expected.items():
            case.update(P=curves[f"{name}/P"], Q=curves[f"{name}/Q"])
    assert len(expected) == 11
    return dict(expected)


def test_golden_area_and_curve_length(golden: dict[str, dict[str, Any]]) -> None:
    checked = {"area": 0, "curve_length": 0}
    for case in golden.values():
        for name in checked:
            if case.get(name) is not None:
                close(getattr(curvewise, name)(case["P"], case["Q"]), case[name])
                checked[name] += 1
    assert checked == {"area": 9, "curve_length": 8}


def test_golden_dtw_and_frechet(golden: dict[str, dict[str, Any]]) -> None:
    for case in golden.values():
        P, Q = case["P"], case["Q"]
        for metric, expected in case["dtw"].items():
            name, _, p = metric.partition("_p")
            close(curvewise.dtw(P, Q, metric=name, p=float(p) if p else None), expected)
        symmetric2 = curvewise.dtw(P, Q, step_pattern="symmetric2")
        close(symmetric2, case["dtw_symmetric2_euclidean"])
        for p, expected in case["frechet"].items():
            close(curvewise.frechet(P, Q, metric="minkowski", p=float(p)), expected)
        close(curvewise.frechet(P, Q), case["frechet"]["2"])


def test_area_of_each_preset() -> None:
    """Crossing lines in P's box, 1 wide and 2 high: half of the enclosed area before scaling."""
    P, Q = [(0, 1), (1, -1)], [(0, -1), (1, 1)]
    area = ["area"]
    assert curvewise.compare(P, Q, measures=area)["area"] == 0.5
    assert curvewise.compare(P, Q, measures=area, preset="raw")["area"] == 2.0
    assert curvewise.compare(P, Q, measures=area, preset="paper")["area"] == 2.0
    P, Q = curvewise.datasets.hysteresis_pair()
    matched = curvewise.area(*curvewise.normalize(P, Q), spacing="matched")
    assert curvewise.compare(P, Q, measures=area)["area"] == matched
    assert Objective(P)(Q) == matched
    of_table_4 = curvewise.area(P, Q, spacing="x")
    assert curvewise.compare(P, Q, measures=area, preset="paper")["area"] == of_table_4
    assert Objective(P, Criterion(preset="paper"))(Q) == of_table_4
    assert curvewise.compare(P, Q, measures=area, preset="raw")["area"] == curvewise.area(P, Q)


@pytest.mark.parametrize("row", ROWS)
def test_table_4_of_the_paper(data_dir: Path, row: str) -> None:
    """The model at the optimum of one measure, under all of them, summed over five loops."""
    paper = data_dir / "paper"
    printed = json.loads((paper / "tables.json").read_text())["table_4_without_noise"]
    expected = dict(zip(printed["columns"], printed[row], strict=True))
    total = dict.fromkeys(ROWS, 0.0)
    for number in range(1, 6):
        test = read_curve(paper / "test" / f"loop_{number}.csv")
        model = read_curve(paper / "model" / f"{row}_loop_{number}.csv")
        for name, value in curvewise.compare(test, model, preset="paper").to_dict().items():
            total[name] += value
    assert f"{total['frechet']:.2f}" == f"{expected['frechet']:.2f}"
    assert f"{total['dtw']:.1f}" == f"{expected['dtw']:.1f}"
    assert f"{total['curve_length']:.1f}" == f"{expected['curve_length']:.1f}"
    assert total["area"] == pytest.approx(expected["area"], rel=0.014)
