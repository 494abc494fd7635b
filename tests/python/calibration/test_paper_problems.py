"""The paper's problems: the data and the material point against the tables."""

from __future__ import annotations

import importlib
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import curvewise

SCRIPTS = Path(__file__).resolve().parents[3] / "benchmarks" / "reproduction"


@pytest.fixture(scope="module", autouse=True)
def _scripts() -> Iterator[None]:
    if not SCRIPTS.is_dir():
        pytest.skip("not a source tree: no benchmarks/reproduction")
    sys.path.insert(0, str(SCRIPTS))
    yield
    sys.path.remove(str(SCRIPTS))


@pytest.fixture(scope="module")
def problems(data_dir: Path, _scripts: None) -> ModuleType:
    module = importlib.import_module("problems")
    if module.data_dir().parent != data_dir:
        pytest.skip(f"the scripts read {module.data_dir().parent}, the tests {data_dir}")
    return module


@pytest.mark.parametrize(
    ("measure", "limit"),
    [("area", 20.5), ("dtw", 20.5), ("curve_length", 21.0), ("pcm", 30.0), ("frechet", 43.0)],
)
def test_point_follows_the_papers_responses(
    problems: ModuleType, measure: str, limit: float
) -> None:
    parameters = problems.paper_parameters(measure)
    theirs = problems.paper_responses(measure)
    ours = problems.HardeningModel.of_the_paper()(parameters)
    errors = [Q[:, 1] - P[:, 1] for P, Q in zip(theirs, ours, strict=True)]
    assert math.sqrt(np.mean(np.concatenate(errors) ** 2)) < limit


def test_papers_responses_give_table_4(problems: ModuleType) -> None:
    """Fréchet, DTW and curve length to every printed digit, area within 1.5 %."""
    for measure in problems.MEASURES:
        pairs = zip(problems.test_loops(), problems.paper_responses(measure), strict=True)
        rows = [curvewise.compare(P, Q, preset="paper").to_dict() for P, Q in pairs]
        area, _, frechet, dtw, length = problems.tables()["table_4_without_noise"][measure]
        total = {name: sum(row[name] for row in rows) for name in problems.MEASURES}
        assert total["area"] == pytest.approx(area, rel=0.015)
        assert round(total["frechet"], 2) == pytest.approx(frechet, abs=0.0101)
        assert total["dtw"] == pytest.approx(dtw, abs=0.0501)
        assert total["curve_length"] == pytest.approx(length, abs=0.0501)


def test_load_unload_is_equation_2(problems: ModuleType) -> None:
    """Written out again, point by point, at random parameters within the bounds of Table 1."""
    low, high = np.array(list(problems.load_unload_bounds().values())).T
    end = math.log((1 + math.e) / 2)
    x = [i / 99 for i in range(100)] + [1 + (end - 1) * i / 49 for i in range(50)]
    for b0, b1, b2, b3 in np.random.default_rng(2).uniform(low, high, (1000, 4)).tolist():
        loading = [math.exp(b0 * at) + b1 for at in x[:100]]
        unloading = [2 * math.exp(b2 * at) - 2 * math.exp(b3) + math.e - 1 for at in x[100:]]
        curve = problems.load_unload({"b0": b0, "b1": b1, "b2": b2, "b3": b3})
        assert np.abs(curve[:, 0] - x).max() < 1e-14
        largest = 2 * math.exp(max(b0, b2, b3))
        assert np.abs(curve[:, 1] - (loading + unloading)).max() < 1e-14 * largest


def test_load_unload_is_the_papers_data(problems: ModuleType) -> None:
    ours = problems.load_unload(problems.LOAD_UNLOAD_TRUTH)
    theirs = problems.load_unload_data(noise=False)
    assert np.abs(ours - theirs).max() < 1e-12
    noisy = problems.load_unload_data(noise=True)
    assert noisy[:, 0].tolist() == theirs[:, 0].tolist()
    assert (noisy - theirs)[:, 1].std() == pytest.approx(0.052, abs=5e-4)
    assert noisy[:, 1].mean() / math.sqrt(0.05) == pytest.approx(3.33, abs=0.005)  # section 3.2


def test_definitions_agree_with_the_tables(problems: ModuleType) -> None:
    truth = problems.tables()["table_1_load_unload"]["true"]
    assert list(problems.LOAD_UNLOAD_TRUTH.values()) == truth
    for (low, high), value in zip(problems.load_unload_bounds().values(), truth, strict=True):
        assert low < value < high
    bounds = problems.hardening_bounds()
    assert tuple(bounds) == tuple("SIGY" if n == "Y" else n for n in problems.POINT.names[1:])
    for measure in problems.MEASURES:
        for noise in (False, True):
            row = problems.paper_parameters(measure, noise=noise)
            assert all(low <= row[name] <= high for name, (low, high) in bounds.items())


@pytest.mark.parametrize("key", ["figure_7_line_with_outlier", "figure_8a_quadratic"])
def test_least_squares_lines(problems: ModuleType, key: str) -> None:
    points = problems.line_with_outlier() if "7" in key else problems.quadratic()
    line = problems.tables()[key]["slope_intercept"]["sum_of_squares"]
    assert np.polyfit(*points.T, 1) == pytest.approx(line, rel=1e-4)


def test_normalised_quadratic(problems: ModuleType) -> None:
    line = problems.tables()["figure_8b_quadratic_normalized"]["slope_intercept"]["sum_of_squares"]
    assert np.polyfit(*problems.quadratic(scaled=True).T, 1) == pytest.approx(line, abs=1e-4)


def test_noise_has_the_deviation_asked_for(problems: ModuleType) -> None:
    loops = problems.test_loops()
    noisy = problems.with_noise(loops, 35.0, seed=1)
    added = np.concatenate([b - a for a, b in zip(loops, noisy, strict=True)])
    assert not added[:, 0].any()
    assert added[:, 1].std() == pytest.approx(35.0, rel=0.1)


def test_signal_to_noise_ratios_are_those_of_the_texts_variance(problems: ModuleType) -> None:
    """Section 3.3 prints 83.1, 105, 117, 127 and 133 for a variance of 35 MPa²."""
    signals = [np.abs(loop[:, 1]).mean() for loop in problems.test_loops()]
    ratios = np.array(signals) / math.sqrt(35.0)
    assert ratios == pytest.approx([83.1, 105, 117, 127, 133], abs=0.61)


def test_pcm_of_a_loop_and_its_first_branch_is_zero(problems: ModuleType) -> None:
    """Figure 15, with the default offsets; DTW with an open end, once the roles are swapped."""
    pytest.importorskip("curvewise.calibration")
    first_branch = importlib.import_module("partial").first_branch
    for loop in problems.test_loops():
        branch = first_branch(loop)
        assert 10 < len(branch) < len(loop) // 2
        assert curvewise.pcm(loop, branch) == 0.0
        assert curvewise.dtw(branch, loop, open_end=True) == 0.0
        others = curvewise.compare(loop, branch, preset="paper").to_dict()
        del others["pcm"]
        assert all(value > 0.1 for value in others.values())


def test_quadrilaterals(problems: ModuleType) -> None:
    module = importlib.import_module("quadrilaterals")
    quads = np.array([[(0, 0), (9, 0), (9, 9), (0, 9)], [(0, 0), (9, 0), (3, 2), (1, 9)]])
    crossed = np.array([[(0, 0), (9, 9), (9, 0), (0, 9)], [(0, 0), (0, 9), (9, 0), (9, 9)]])
    signs = [(module.cross_products(q) > 0).sum(axis=1).tolist() for q in (quads, crossed)]
    assert signs == [[4, 3], [2, 2]]
    assert module.sides_cross(crossed, 0).tolist() == [True, False]
    assert module.sides_cross(crossed, 1).tolist() == [False, True]
    assert not any(module.sides_cross(quads, k).any() for k in (0, 1))
    assert module.interior_angles(quads).tolist() == [360, 360]
    assert module.interior_angles(crossed).tolist() == [720, 720]


def test_mean_squared_mapped_distances(problems: ModuleType) -> None:
    """What the printed PCM column of Table 4 is nearest to, of the definitions tried."""
    mean_square = importlib.import_module("norms").DEFINITIONS["mean squared distance"]
    expected = {"area": 0.78, "pcm": 0.77, "frechet": 0.98, "dtw": 0.71, "curve_length": 0.88}
    for measure, ratio in expected.items():
        pairs = zip(problems.test_loops(), problems.paper_responses(measure), strict=True)
        printed = problems.tables()["table_4_without_noise"][measure][1]
        assert sum(mean_square(P, Q) for P, Q in pairs) / printed == pytest.approx(ratio, abs=0.005)


def test_filter_keeps_parabolas_and_turning_points(problems: ModuleType) -> None:
    """Second order, branch by branch: it returns a piecewise parabola unchanged."""
    pytest.importorskip("curvewise.calibration")
    table6 = importlib.import_module("table6")
    x = np.concatenate((np.linspace(0, 1, 60), np.linspace(1, 0.5, 40)))
    curve = np.column_stack((x, np.where(np.arange(100) < 60, x**2, 4 * x - 3)))
    assert table6.filtered(curve, 11) == pytest.approx(curve, abs=1e-12)
    noisy = curve + np.random.default_rng(0).normal(0, [0, 0.1], (100, 2))
    assert np.abs(table6.filtered(noisy, 11) - curve).mean() < np.abs(noisy - curve).mean() / 1.5


def test_landscape_counts_minima_and_steps(problems: ModuleType) -> None:
    pytest.importorskip("curvewise.calibration")
    landscape = importlib.import_module("landscape").landscape
    t = np.linspace(-1, 1, 2001)
    valley = landscape(np.abs(t))
    assert (valley.minima(), valley.variation) == (1, pytest.approx(1.0))
    assert valley.step < 2e-3
    assert landscape(t**2 + 0.3 * np.cos(20 * t)).minima() > 4
    assert landscape(t + (t > 0)).step == pytest.approx(1 / 3, rel=0.01)
    slope = landscape(t)  # its minimum is at an end
    assert (slope.minima(), slope.variation) == (1, pytest.approx(1.0))


def test_minima_count_from_a_depth(problems: ModuleType) -> None:
    """Two local minima, 5 and 4.98 high, 0.1 below the maximum between them, on a scan of range
    1.1.
    """
    pytest.importorskip("curvewise.calibration")
    landscape = importlib.import_module("landscape").landscape
    line = landscape(np.interp(np.linspace(0, 4, 401), [0, 1, 2, 3, 4], [6.08, 5, 5.1, 4.98, 6]))
    assert len(line.depths) == 2
    assert line.further_depth() == pytest.approx(0.1)
    assert [line.minima(depth) for depth in (0.01, 0.09, 0.1)] == [2, 2, 1]
    assert [line.minima(depth, of="value") for depth in (0.01, 0.02, 0.03)] == [2, 2, 1]


@pytest.fixture(scope="module")
def output(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return one folder for all quick runs, as several draw from the same fits."""
    return tmp_path_factory.mktemp("paper")


@pytest.mark.parametrize(
    "script",
    [
        "illustrations",
        "straight_line",
        "norms",
        "hardening_rules",
        "load_unload",
        "kinematic_hardening",
        "hardening_figures",
        "known_parameters",
        "cross_validation",
        "lines_between_optima",
        "gradient_descents",
        "partial",
        "table6",
        "quadrilaterals",
    ],
)
def test_quick_run(problems: ModuleType, output: Path, script: str) -> None:
    """It succeeds, and its second output replaces the first."""
    if "CURVEWISE_PAPER" not in os.environ:
        pytest.skip("the scripts take two minutes: set CURVEWISE_PAPER=1")
    command = [sys.executable, str(SCRIPTS / f"{script}.py"), "--quick", f"--output={output}"]
    results = output / "results.md"
    texts = []
    for _ in range(2 if script in ("straight_line", "load_unload") else 1):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        texts.append(results.read_text() if results.exists() else "")
    assert len(set(texts)) == 1
    assert texts[0].count(": begin -->") == texts[0].count(": end -->") > 0
    for picture in output.glob("*.png"):
        assert 1_000 < picture.stat().st_size < 150_000
