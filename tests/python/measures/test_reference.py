"""The numpy reference against independent results: hand calculation, enumeration, data.

Every other test trusts the reference, so here nothing is compared with the compiled library. Values
come from two other packages (the golden data), from the tables of the paper and at the ends of the
range. In `test_reference_planar.py` they come from closed forms, in `test_reference_warping.py`
from enumerating all warping paths of short curves.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from curvewise import reference

Array = npt.NDArray[np.float64]

GEOS_P = [(2, 5), (3, 3), (4, 3), (5, 4), (0, 0), (3, 4)]
GEOS_Q = [(0, 4), (4, 4), (5, 1)]
MEASURES = ("area", "pcm", "frechet", "dtw", "curve_length")


@pytest.mark.parametrize("scale", [2.0**600, 2.0**1020, 2.0**-600, 2.0**-1040])
def test_magnitudes_at_the_ends_of_the_range(scale: float) -> None:
    P, Q = np.array(GEOS_P, dtype=float), np.array(GEOS_Q, dtype=float)
    assert reference.frechet(P * scale, Q * scale) == 5.0 * scale
    assert reference.frechet_table(P * scale, Q * scale)[-1, -1] == 5.0 * scale
    assert reference.dtw(P * scale, Q * scale) == pytest.approx(
        scale * reference.dtw(P, Q), rel=1e-12, abs=5e-324
    )
    degree_2 = reference.dtw(P * scale, Q * scale, metric="sqeuclidean")
    assert degree_2 == (math.inf if scale > 1 else 0.0)
    for name in ("pcm", "curve_length"):
        measure = getattr(reference, name)
        assert measure(P * scale, Q * scale) == pytest.approx(measure(P, Q), rel=1e-12)


def test_a_coordinate_far_smaller_than_the_other_still_counts() -> None:
    P, Q = np.array(GEOS_P, dtype=float), np.array(GEOS_Q, dtype=float)
    stretch = np.array([2.0**-700, 2.0**700])
    for measure in (reference.pcm, reference.curve_length):
        assert measure(P * stretch, Q * stretch) == pytest.approx(measure(P, Q), rel=1e-12)
    scaled = zip(
        reference.normalize(P * stretch, Q * stretch), reference.normalize(P, Q), strict=True
    )
    for found, expected in scaled:
        np.testing.assert_array_equal(found, expected)


def test_pcm_beyond_the_range_of_a_double_is_inf() -> None:
    P, Q = np.array(GEOS_P) * 1e-200, np.array(GEOS_Q) * 1e200
    match = reference.pcm_match(P, Q)
    assert (match.value, match.mapped, match.coverage) == (math.inf, "P", 0.0)
    assert np.isnan(match.points).all()


@pytest.fixture(scope="module")
def golden(data_dir: Path) -> dict[str, dict[str, Any]]:
    """Return, by name, a pair of curves and what two other packages give for it."""
    text = (data_dir / "golden" / "expected.json").read_text()
    with np.load(data_dir / "golden" / "cases.npz") as curves:
        return {
            name: {"P": curves[f"{name}/P"], "Q": curves[f"{name}/Q"], **expected}
            for name, expected in json.loads(text)["values"].items()
        }


def golden_values(case: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any], float]]:
    """Yield measure, options and value of all that a case has."""
    cubic: dict[str, Any] = {"metric": "minkowski", "p": 3}
    for metric, value in case["dtw"].items():
        yield "dtw", cubic if metric == "minkowski_p3" else {"metric": metric}, value
    yield "dtw", {"step_pattern": "symmetric2"}, case["dtw_symmetric2_euclidean"]
    metrics: dict[str, dict[str, Any]] = {
        "1": {"metric": "cityblock"},
        "2": {},
        "3": cubic,
        "inf": {"metric": "chebyshev"},
    }
    for p, value in case["frechet"].items():
        yield "frechet", metrics[p], value
    for measure in ("area", "curve_length"):
        if case.get(measure) is not None:
            yield measure, {}, case[measure]


def test_golden_values(golden: dict[str, dict[str, Any]]) -> None:
    count = 0
    for name, case in golden.items():
        for measure, options, expected in golden_values(case):
            found = getattr(reference, measure)(case["P"], case["Q"], **options)
            assert found == pytest.approx(expected, rel=1e-12), (name, measure, options)
            count += 1
    assert count == 11 * (5 + 1 + 4) + 9 + 8


def test_curve_length_of_circles_around_the_origin(golden: dict[str, dict[str, Any]]) -> None:
    # The mean of y is rounding error, and a quotient by it is noise: the golden value is null.
    circles = golden["circles_c5_c6"]
    assert circles["curve_length"] is None
    with pytest.raises(ValueError, match=r"the mean of P's y is 0 to rounding; use scale='mean_ab"):
        reference.curve_length(circles["P"], circles["Q"])


@pytest.mark.parametrize("row", MEASURES)
def test_table_4_of_the_paper(data_dir: Path, row: str) -> None:
    def loop(kind: str, number: int) -> Array:
        path = data_dir / "paper" / kind / f"{'' if kind == 'test' else row + '_'}loop_{number}.csv"
        return np.loadtxt(path, delimiter=",", skiprows=1)

    totals = dict.fromkeys(("area", "frechet", "dtw", "curve_length"), 0.0)
    for number in range(1, 6):
        P, Q = loop("test", number), loop("model", number)
        p, q = reference.normalize(P, Q)
        totals["area"] += reference.area(P, Q, spacing="x")
        totals["frechet"] += reference.frechet(p, q)
        totals["dtw"] += reference.dtw(p, q, step_pattern="symmetric2")
        totals["curve_length"] += reference.curve_length(P, Q)
    table = json.loads((data_dir / "paper" / "tables.json").read_text())["table_4_without_noise"]
    printed = dict(zip(table["columns"], table[row], strict=True))
    assert totals["area"] == pytest.approx(printed["area"], rel=0.015)
    assert round(totals["frechet"], 2) == printed["frechet"]
    assert round(totals["dtw"], 1) == printed["dtw"]
    assert round(totals["curve_length"], 1) == printed["curve_length"]
