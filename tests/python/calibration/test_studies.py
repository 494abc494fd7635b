"""Cross-validation and plots along a line between two parameter sets."""

from __future__ import annotations

import numpy as np
import pytest

import curvewise
from curvewise.calibration import (
    Criterion,
    Objective,
    SimulationStore,
    cross_validate,
    line_plot,
)

X = np.linspace(0.0, 1.0, 25)
BOUNDS = {"a": (0.0, 10.0), "b": (-5.0, 5.0)}
TRUE = {"a": 2.0, "b": 1.0}
QUIET = {"progress": False, "method": "sdrm"}


def loops(parameters):
    a, b = parameters["a"], parameters["b"]
    return [np.column_stack((X, y)) for y in (a * X + b, a * X**2 + b, a * X**3 - b)]


def odd_loops():
    """Two loops of one material, and one of another."""
    return [*loops(TRUE)[:2], loops({"a": 4.0, "b": 1.0})[2]]


@pytest.fixture(scope="module")
def odd_checked():
    return cross_validate(loops, odd_loops(), BOUNDS, **QUIET)


def test_every_loop_is_left_out_once():
    checked = cross_validate(loops, loops(TRUE), BOUNDS, measure="dtw", **QUIET)
    assert [fold.left_out for fold in checked.folds] == [0, 1, 2]
    for fold in checked.folds:
        assert fold.parameters["a"] == pytest.approx(2.0, rel=1e-3)
        assert fold.value < 1e-2
        assert fold.others < 1e-2
        assert len(fold.identification.experiments) == 2


def test_a_loop_of_another_material_is_predicted_badly(odd_checked):
    experiments = odd_loops()
    odd = odd_checked.folds[2]
    assert odd.parameters["a"] == pytest.approx(2.0, rel=1e-3)
    assert odd.value > 100 * odd.others
    assert odd.value == curvewise.compare(experiments[2], odd.simulation)["area"]
    assert np.array_equal(odd.simulation, loops(odd.parameters)[2])


def test_options_and_weights_reach_the_folds():
    checked = cross_validate(
        loops,
        odd_loops(),
        BOUNDS,
        measure=Criterion(
            "dtw", weights=[1.0, 1.0, 0.0], preset="paper", step_pattern="symmetric1"
        ),
        **QUIET,
    )
    assert (checked.measure, checked.preset) == ("dtw", "paper")
    without_first = checked.folds[0]
    assert without_first.parameters["a"] == pytest.approx(2.0, rel=1e-3)  # weight 0 for the odd one
    P, Q = curvewise.normalize(odd_loops()[2], checked.folds[2].simulation)
    assert checked.folds[2].value == curvewise.dtw(P, Q)


def test_a_left_out_loop_that_fails_is_nan():
    def fragile(parameters):
        curves = loops(parameters)
        return [*curves[:2], None if abs(parameters["a"] - 2.0) < 0.1 else curves[2]]

    checked = cross_validate(fragile, odd_loops(), BOUNDS, **QUIET)
    assert np.isnan(checked.folds[2].value)
    assert checked.folds[2].simulation is None
    assert np.isfinite(checked.folds[1].value)
    assert "nan" in str(checked)


def test_summary_is_a_table(odd_checked):
    rows = [row.split() for row in str(odd_checked).splitlines()]
    assert rows[0] == ["left", "out", "a", "b", "area", "others"]
    assert [row[:2] for row in rows[1:4]] == [["loop", "0"], ["loop", "1"], ["loop", "2"]]
    assert [row[0] for row in rows[4:]] == ["mean", "std"]
    values = np.array([[float(cell) for cell in row[2:]] for row in rows[1:4]])
    means = [float(cell) for cell in rows[4][1:]]
    assert means == pytest.approx(values.mean(axis=0), rel=1e-3)


def test_the_folds_are_searches_of_one_store(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    keywords = {"store": store, "measure": "dtw", **QUIET}
    first = cross_validate(loops, odd_loops(), BOUNDS, **keywords)
    with store:
        assert len(store.searches()) == 3
    again = cross_validate(loops, odd_loops(), BOUNDS, **keywords)
    assert sum(fold.identification.runs for fold in again.folds) == 0
    assert str(again) == str(first)


def test_one_loop_cannot_be_cross_validated():
    with pytest.raises(ValueError, match="at least 2"):
        cross_validate(loops, loops(TRUE)[0], BOUNDS, **QUIET)
    with pytest.raises(ValueError, match="weights has 2 entries"):
        cross_validate(loops, loops(TRUE), BOUNDS, measure=Criterion(weights=[1, 2]), **QUIET)


A, B = {"a": 1.0, "b": 1.0}, {"b": 1.0, "a": 3.0}


@pytest.mark.parametrize("workers", [1, 2])
def test_line_plot_of_experiments(workers):
    data, figure = line_plot(loops(TRUE), loops, A, B, points=21, progress=False, workers=workers)
    names = ["area", "pcm", "frechet", "dtw", "curve_length"]
    assert list(data.dtype.names) == ["t"] + [n for name in names for n in (name, f"{name}_scaled")]
    assert data.t.tolist() == np.linspace(0, 1, 21).tolist()
    for name in names:
        objective = Objective(loops(TRUE), name)
        assert data[name][0] == objective(loops(A))
        assert data[name][10] == pytest.approx(0.0, abs=1e-9)
        assert data[name][20] == objective(loops(B))
        scaled = data[f"{name}_scaled"]
        assert (scaled.min(), scaled.max()) == (0.0, 1.0)
    (ax,) = figure.axes
    assert [drawn.get_label() for drawn in ax.lines] == names


def test_line_plot_of_objectives():
    objectives = {
        "jumping": Objective(loops(TRUE), Criterion("area", preset="raw")),
        "continuous": Objective(loops(TRUE), Criterion("area", preset="raw", crossing="split")),
    }
    data, _ = line_plot(objectives, loops, A, B, points=5, progress=False)
    assert data.dtype.names[1:] == ("jumping", "jumping_scaled", "continuous", "continuous_scaled")
    assert data.continuous[1] == objectives["continuous"](loops({"a": 1.5, "b": 1.0}))


def test_line_plot_leaves_out_what_failed():
    def fragile(parameters):
        if parameters["a"] > 2.7:
            raise ValueError("too steep")
        return loops(parameters)

    data, _ = line_plot(loops(TRUE), fragile, A, B, points=5, measures=["dtw"], progress=False)
    assert np.isnan(data.dtw).tolist() == [False] * 4 + [True]
    assert np.isnan(data.dtw_scaled[4])
    assert np.nanmax(data.dtw_scaled) == 1.0


def test_line_plot_of_simulations_that_are_short_for_pcm():
    """The curves cover a fifth of the experiments: without the guard, this is a valid run."""

    def short(parameters):
        return [curve[: len(curve) // 5] for curve in loops(parameters)]

    keywords = {"points": 3, "measures": ["pcm"], "progress": False}
    data, _ = line_plot(loops(TRUE), short, A, B, **keywords)
    assert np.isnan(data.pcm).all()
    data, _ = line_plot(
        loops(TRUE), short, A, B, **keywords | {"measures": [Criterion("pcm", min_coverage=0.0)]}
    )
    assert data.pcm[0] == Objective(loops(TRUE), Criterion("pcm", min_coverage=0.0))(short(A))


def test_line_plot_refuses_what_is_no_line():
    with pytest.raises(ValueError, match="give the same"):
        line_plot(loops(TRUE), loops, A, {"a": 1.0}, progress=False)
    with pytest.raises(ValueError, match="at least 2"):
        line_plot(loops(TRUE), loops, A, B, points=1, progress=False)
