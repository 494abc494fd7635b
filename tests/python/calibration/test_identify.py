"""identify: its result, processes, callbacks, limits, and errors."""

from __future__ import annotations

import dataclasses
import os
import re
import sys

import numpy as np
import pytest
from test_resuming import BOUNDS, EXPERIMENT, QUICK, X, assert_same, fragile_line, line

import curvewise
from curvewise.calibration import (
    Criterion,
    DifferentialEvolution,
    LeastSquares,
    Log,
    SimulationStore,
    TrustRegion,
    identify,
)

DE_ONCE = {"progress": False, "method": DifferentialEvolution(maxiter=1, popsize=8)}


def deadly_line(parameters):
    if parameters["a"] > 9.0:
        os._exit(3)
    return line(parameters)


class Counted:
    """The line, which keeps the parameters that it is called with."""

    def __init__(self):
        self.calls = []

    def __call__(self, parameters):
        self.calls.append(parameters)
        return line(parameters)


def test_what_is_returned():
    found = identify(line, EXPERIMENT, BOUNDS, **QUICK)
    history = found.history
    assert history.dtype.names == ("evaluation", "a", "b", "value", "failed", "seconds")
    assert history.evaluation.tolist() == list(range(1, found.evaluations + 1))
    best = history[history.value.argmin()]
    assert found.parameters == {"a": best.a, "b": best.b}
    assert found.value == best.value
    assert ((history.a >= 0) & (history.a <= 10) & (history.b >= -5) & (history.b <= 5)).all()
    assert np.array_equal(found.simulations[0], line(found.parameters))
    assert np.array_equal(found.experiments[0], EXPERIMENT)
    expected = curvewise.compare(EXPERIMENT, found.simulations[0])
    assert found.measures == expected.to_dict()
    assert found.measures["area"] == found.value
    with pytest.raises(AttributeError):
        found.value = 0.0


def moved(parameters):
    return [line(parameters), line(parameters) * (1.0, 2.0)]


def test_deviations_are_those_of_the_measure_with_its_options():
    experiments = [line({"a": 2.0, "b": 1.0}), line({"a": 2.2, "b": 1.0}) * (1.0, 2.0)]
    criterion = Criterion("dtw", preset="raw", step_pattern="symmetric2", window=3)
    found = identify(moved, experiments, BOUNDS, measure=criterion, **QUICK)
    expected = [
        curvewise.compare(
            *pair, preset="raw", options={"dtw": {"step_pattern": "symmetric2", "window": 3}}
        ).deviations["dtw"]
        for pair in zip(found.experiments, found.simulations, strict=True)
    ]
    assert list(found.deviations) == expected
    assert found.deviations[1].height == pytest.approx(4.4)
    assert f"\ndeviation of dtw, in units of y\ncurve 0: {expected[0]}\ncurve 1: " in str(found)


def test_deviations_of_a_part():
    def beginning(parameters):
        return line(parameters)[:10]

    criterion = Criterion("dtw", open_end=True, part="simulation")
    found = identify(beginning, EXPERIMENT, BOUNDS, measure=criterion, **QUICK)
    P, Q = curvewise.normalize(EXPERIMENT, found.simulations[0])
    path = curvewise.dtw_path(Q, P, open_end=True)
    expected = path.distance / len(path.path) * np.ptp(EXPERIMENT[:, 1])
    assert found.deviations[0].mean == pytest.approx(expected, rel=1e-12)


def test_deviations_of_measures_that_compare_no_points():
    def dtw(P, Q):  # a name that curvewise has, too
        return curvewise.mae(P, Q)

    for measure in ("curve_length", "sum_of_squares", dtw):
        found = identify(line, EXPERIMENT, BOUNDS, measure=measure, **QUICK)
        assert found.deviations == (None,)
        assert "deviation" not in str(found)


def test_deviations_of_simulations_that_failed():
    found = identify(line, EXPERIMENT, BOUNDS, **QUICK)
    assert found.deviations[0].mean < found.deviations[0].height
    for failed in ((), (line({"a": 1.0, "b": np.nan}),), (EXPERIMENT[:1],)):
        without = dataclasses.replace(found, simulations=failed)
        assert without.deviations == (None,)
        assert "deviation" not in str(without)


def test_summary_is_a_table():
    text = str(identify(line, EXPERIMENT, BOUNDS, **QUICK))
    for word in ("parameter", "a ", "b ", "dtw", "minimised", "sdrm+de, seed 0", "not converged"):
        assert word in text


def test_the_middle_of_a_logarithmic_range_is_not_a_bound():
    bounds = {"a": Log(1e-2, 1e4), "b": (-10.0, 10.0)}
    start = {"a": 5.0, "b": -1.0}
    keywords = {"start": start, "max_runs": 1, "progress": False}
    found = identify(line, line(start), bounds, **keywords)
    assert "at its" not in str(found)
    assert "at its" not in found._repr_html_()


def test_measures_that_cannot_be_computed_are_nan():
    centred = line({"a": 2.0, "b": -1.0})  # mean of y is 0: curve_length, raw, is not defined
    found = identify(line, centred, BOUNDS, measure=Criterion(preset="raw"), **QUICK)
    assert np.isnan(found.measures["curve_length"])
    assert np.isfinite(found.measures["dtw"])


def test_series_and_space_curves():
    found = identify(lambda p: line(p)[:, 1], EXPERIMENT[:, 1], BOUNDS, measure="dtw", **QUICK)
    assert list(found.measures) == ["frechet", "dtw"]

    def in_space(parameters):
        return np.column_stack((line(parameters), X**2))

    found = identify(in_space, in_space({"a": 2, "b": 1}), BOUNDS, measure="frechet", **QUICK)
    assert list(found.measures) == ["frechet", "dtw"]
    found.plot()


def test_same_seed_same_result_and_another_seed_another():
    found = [identify(line, EXPERIMENT, BOUNDS, seed=seed, **QUICK) for seed in (4, 4, 5)]
    assert_same(found[0], found[1])
    assert not np.array_equal(found[0].history.a, found[2].history.a)


@pytest.mark.parametrize(
    "method",
    [
        "sdrm+de",
        "nelder-mead",
        TrustRegion(starts_at_once=3),
        TrustRegion(starts_at_once=1),
        LeastSquares(starts_at_once=3),
    ],
    ids=repr,
)
def test_result_does_not_depend_on_the_number_of_processes(method):
    keywords = {"measure": "curve_length", "method": method, "progress": False}
    if method == "sdrm+de":
        keywords["method"] = QUICK["method"]
    one, two = (
        identify(fragile_line, EXPERIMENT, BOUNDS, workers=workers, **keywords)
        for workers in (1, 2)
    )
    assert_same(one, two)


def test_a_model_that_cannot_be_pickled():
    with pytest.raises(ValueError, match=r"cannot be sent to other processes.*workers=1"):
        identify(lambda p: line(p), EXPERIMENT, BOUNDS, workers=2, **QUICK)


def test_a_worker_that_dies_is_one_failed_simulation():
    found = identify(deadly_line, EXPERIMENT, BOUNDS, workers=2, seed=1, **DE_ONCE)
    steep = found.history.a > 9.0
    assert steep.any()
    assert np.array_equal(found.history.failed, steep)
    assert {message for _, message in found.failures} == {"the worker process died"}


def test_callback_is_told_and_can_stop():
    told = []

    def callback(progress):
        told.append(progress)
        return progress.evaluations >= 10

    found = identify(line, EXPERIMENT, BOUNDS, callback=callback, **QUICK)
    assert found.message == "the callback ended the search"
    assert not found.converged
    assert [p.evaluations for p in told] == sorted({p.evaluations for p in told})
    assert told[-1].evaluations == found.evaluations
    assert (told[-1].value, told[-1].parameters) == (found.value, found.parameters)


@pytest.mark.parametrize("method", ["sdrm+de", "de", "trust-region", "nelder-mead"])
def test_max_runs(method):
    counted = Counted()
    found = identify(counted, EXPERIMENT, BOUNDS, method=method, max_runs=12, progress=False)
    assert found.evaluations == len(counted.calls) == 12
    assert found.message == "max_runs = 12 reached"


def test_no_point_is_run_twice():
    counted = Counted()
    found = identify(counted, EXPERIMENT, BOUNDS, **QUICK)
    points = [(p["a"], p["b"]) for p in counted.calls]
    assert len(points) == len(set(points)) == found.evaluations


@pytest.mark.parametrize("method", ["nelder-mead", "sdrm"])
def test_start_is_evaluated_first(method):
    keywords = {"start": {"b": 1.5, "a": 3.0}, "max_runs": 3, "progress": False}
    found = identify(line, EXPERIMENT, BOUNDS, method=method, **keywords)
    assert (found.history.a[0], found.history.b[0]) == pytest.approx((3.0, 1.5))


def test_pictures_have_a_panel_for_every_loop():
    found = identify(moved, moved({"a": 2, "b": 1}), BOUNDS, **QUICK)
    titles = [ax.get_title() for ax in found.plot().axes]
    assert titles == ["Loop 0", "Loop 1", ""]


# Errors.


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        ({}, "bounds is empty"),
        ({"a": (2, 1)}, r"bounds\['a'\] is \(2, 1\); they must be finite, low < high"),
        ({"a": (1, 1)}, "every parameter is fixed; give one of them bounds"),
        ([("a", 0, 1)], "bounds is list; give a dict of name"),
        ({"a": (0, np.inf)}, "must be finite"),
        ({"a": "3"}, r"bounds\['a'\] is '3'; give \(low, high\)"),
        ({"value": (0, 1)}, "cannot be called 'value'"),
    ],
)
def test_wrong_bounds(bounds, message):
    with pytest.raises(ValueError, match=message):
        identify(line, EXPERIMENT, bounds, progress=False)


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"method": "magic"}, "unknown method 'magic'; choose from auto, trust-region"),
        ({"method": "least-squares"}, "'area' is not a sum of squares"),
        ({"start": {"a": 1.0}}, "give a value for each of a, b"),
        ({"start": {"a": 11.0, "b": 0.0}}, r"start\['a'\] is 11.0; it must be from 0.0 to 10.0"),
        ({"max_runs": 0}, "max_runs is 0"),
        ({"workers": 0}, "workers is 0"),
    ],
)
def test_wrong_keywords(keywords, message):
    with pytest.raises(ValueError, match=message):
        identify(line, EXPERIMENT, BOUNDS, progress=False, **keywords)


@pytest.mark.parametrize("method", ["de", "sdrm+de", "trust-region", "nelder-mead"])
def test_a_model_that_never_succeeds_is_an_error_at_once(method):
    calls = []

    def broken(parameters):
        calls.append(parameters)
        raise KeyError("no such file")

    with pytest.raises(RuntimeError, match=r"no simulation succeeded.*KeyError: 'no such file'"):
        identify(broken, EXPERIMENT, BOUNDS, method=method, progress=False)
    assert len(calls) <= 30


@pytest.mark.parametrize("method", ["de", "sdrm+de", "trust-region", "nelder-mead"])
@pytest.mark.parametrize(
    ("model", "error", "message"),
    [
        (moved, ValueError, "there are 2 simulations and 1 experiments"),
        (lambda p: np.array(["a"]), TypeError, "real numbers"),
        (EXPERIMENT, TypeError, "must be callable"),
    ],
)
def test_a_model_hooked_up_wrongly_is_an_error(model, error, message, method):
    with pytest.raises(error, match=message):
        identify(model, EXPERIMENT, BOUNDS, method=method, progress=False)


def test_the_first_failure_is_logged(caplog):
    found = identify(fragile_line, EXPERIMENT, BOUNDS, **QUICK)
    assert len(found.failures) > 1
    (record,) = [r for r in caplog.records if r.levelname == "WARNING"]
    number, message = found.failures[0]
    assert record.message == f"evaluation {number} failed: {message}"
    assert re.fullmatch(
        r"ValueError: too steep \(\S+test_resuming.py, line \d+, in fragile_line\)", message
    )


@pytest.mark.parametrize("workers", [1, 2])
def test_an_exception_has_the_line_of_the_users_code(workers):
    with pytest.raises(RuntimeError, match=r"no simulation succeeded") as caught:
        identify(stumbling, EXPERIMENT, BOUNDS, workers=workers, progress=False)
    where = stumbling.__code__.co_firstlineno + 1
    assert f"({__file__}, line {where}, in stumbling)" in str(caught.value)


def stumbling(parameters):
    return np.loadtxt("no such file")  # the innermost line is numpy's


@pytest.mark.parametrize("missing", ["scipy", "tqdm"])
def test_a_missing_package_is_named(monkeypatch, missing):
    for name in [name for name in sys.modules if name.partition(".")[0] == missing]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(ImportError, match=rf'needs {missing}: pip install "curvewise\[calib'):
        identify(line, EXPERIMENT, BOUNDS)


def mean_difference(P, Q):
    return np.abs(P - Q).mean()


def test_a_measure_of_ones_own(tmp_path):
    store = SimulationStore(tmp_path / "own.db", version="1")
    keywords = {"measure": mean_difference, "progress": False, "store": store}
    found = identify(line, EXPERIMENT, BOUNDS, method="de", **keywords)
    assert found.measure == "mean_difference"
    assert found.measures["mean_difference"] == found.value
    assert "mean_difference" in str(found)
    assert identify(line, EXPERIMENT, BOUNDS, method="de", **keywords).value == found.value
    with pytest.raises(ValueError, match="is not a sum of squares"):
        identify(line, EXPERIMENT, BOUNDS, method="least-squares", measure=mean_difference)


@pytest.mark.parametrize("options", [{"measure": "pcm"}, {"measure": "dtw", "open_end": True}])
def test_a_model_of_a_piece_of_the_experiment(options):
    """The test goes up and down a parabola, the model simulates its first third alone."""
    experiment = np.column_stack((X, 4.0 * X * (1.0 - X)))

    def first_third(parameters):
        return np.column_stack((X[:9], parameters["a"] * X[:9] + parameters["b"] * X[:9] ** 2))

    keywords = {"method": "de", "progress": False}
    keywords["measure"] = Criterion(**options, part="simulation")
    found = identify(first_third, experiment, BOUNDS, **keywords)
    assert found.parameters["a"] == pytest.approx(4.0, abs=1e-3)
    assert found.parameters["b"] == pytest.approx(-4.0, abs=4e-3)
    assert found.measures["pcm"] < 1e-3
