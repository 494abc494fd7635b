"""Fronts of two measures, profiles of a parameter, and the global method."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from curvewise.calibration import (
    Below,
    DifferentialEvolution,
    Global,
    Objective,
    SimulationStore,
    front,
    identify,
    identify_each,
    profile,
    screening,
)
from curvewise.calibration.fronts import _not_dominated

X = np.linspace(0.0, 1.0, 25)
BOUNDS = {"K": (0.5, 5.0), "n": (0.1, 2.0)}


def power(p):
    return np.column_stack((X, p["K"] * X ** p["n"]))


TEST = power({"K": 2.0, "n": 0.6})
TEST[:, 1] += 0.1 * np.sin(9.0 * X)
SQUARES = {"measure": "sum_of_squares", "progress": False, "method": "least-squares"}


@pytest.fixture(scope="module")
def found():
    return identify(power, TEST, BOUNDS, **SQUARES)


@pytest.mark.parametrize("seed", range(5))
def test_no_run_of_the_front_is_beaten_and_every_other_is(seed):
    values = np.random.default_rng(seed).integers(0, 9, (60, 2)).astype(float)
    chosen = _not_dominated(values)
    for i, one in enumerate(values):
        beaten = (values <= one).all(axis=1) & (values < one).any(axis=1)
        alike = (values[chosen] == one).all(axis=1).sum()
        assert beaten.any() == (alike == 0), i
        assert alike <= 1
    assert (np.diff(values[chosen], axis=0) * (1.0, -1.0) > 0.0).all()


def test_a_front_goes_from_the_best_of_one_measure_to_the_best_of_the_other(tmp_path):
    store = SimulationStore(tmp_path / "runs.db", version="1")
    measures = ["area", "frechet"]
    each = identify_each(power, TEST, BOUNDS, measures=measures, store=store, progress=False)
    found = front(store, TEST, measures)
    assert found.values[0, 0] == pytest.approx(each["area"].value)
    assert found.values[-1, 1] == pytest.approx(each["frechet"].value)
    assert found.losses.min(axis=0).tolist() == [0.0, 0.0]
    largest = found.losses.max(axis=1)
    assert largest[found.compromise] == largest.min()
    for parameters, row in zip(found.parameters, found.values, strict=True):
        for measure, value in zip(measures, row, strict=True):
            assert Objective(TEST, measure)(power(parameters)) == pytest.approx(value)
    text = str(found)
    assert "compromise" in text
    assert f"{len(found.values)} of {len(found.all_values)} runs are on the front" in text
    assert len(found.plot().axes) == 2
    with pytest.raises(ValueError, match="there are 3 measures; give two"):
        front(store, TEST, ["area", "dtw", "frechet"])


@pytest.mark.parametrize("has_store", [False, True])
def test_what_comes_after_several_measures_runs_the_model_again(tmp_path: Path, has_store: bool):
    """Without a store too, when the temporary one of the searches has gone."""
    calls = []

    def counted(p):
        calls.append(p)
        return power(p)

    store = SimulationStore(tmp_path / "runs.db", version="1") if has_store else None
    method = DifferentialEvolution(popsize=3, maxiter=3)
    keywords = {"measures": ["area", "dtw"], "method": method, "store": store, "progress": False}
    each = identify_each(counted, TEST, BOUNDS, **keywords)
    for measure, found in each.items():
        assert found.uncertainty_runs == 4
        first = found.uncertainty()
        assert first.runs == 4
        before = len(calls)
        assert found.uncertainty().intervals == first.intervals
        assert len(calls) - before == (0 if has_store else 4)
        stored = has_store and measure == "dtw"  # those of the other measure's screening
        assert screening(found, paths=4).runs == (0 if stored else 12)
        assert profile(found, "n", points=5, method=method).runs > 4
    assert (tmp_path / "runs.db").exists() == has_store


def test_a_profile_of_a_nearly_linear_model_is_the_interval_by_sensitivities(found):
    one = profile(found, "K", points=5)
    low, high = one.by_sensitivities
    assert one.interval == pytest.approx((low, high), abs=0.1 * (high - low))
    assert one.is_open == (False, False)
    assert one.objective.argmin() == 2
    assert one.objective[2] == found.value
    for value, parameters in zip(one.values, one.parameters, strict=True):
        assert parameters["K"] == value
    assert "interval of K" in str(one)
    assert one.plot().axes[0].get_xlabel() == "K"


def test_a_profile_ends_at_a_bound(found):
    bounds = {**BOUNDS, "K": (0.5, found.parameters["K"] + 1e-3)}
    found = identify(power, TEST, bounds, **SQUARES)
    one = profile(found, "K", points=5)
    assert one.values[-1] <= bounds["K"][1]
    assert one.is_open[1]
    assert one.interval[0] < found.parameters["K"]


def test_what_has_no_profile(found):
    with pytest.raises(ValueError, match="'m' is not one of several parameters: K, n"):
        profile(found, "m")
    with pytest.raises(ValueError, match="points is 4; give an odd number"):
        profile(found, "K", points=4)
    bounds = {"K": (0.5, 5.0), "n": Below("K", 0.1, 2.0)}
    found = identify(power, TEST, bounds, **SQUARES)
    with pytest.raises(ValueError, match="K"):
        profile(found, "K")


def dented(p):
    """A line whose slope has four local minima, the deepest at 0.8."""
    a = p["a"]
    depth = (a - 0.8) ** 2 + 0.15 * np.sin(12.5 * (a - 0.8)) ** 2
    return np.column_stack((X, X + depth + (p["b"] - 0.3) * X**2))


def test_global_finds_the_deepest_valley_and_says_that_rounds_agree():
    pytest.importorskip("cma", reason="cma is an extra: curvewise[global]")
    test = np.column_stack((X, X))
    keywords = {"method": Global(popsize=8), "progress": False, "max_runs": 4000}
    state = np.random.get_state()[1].copy()  # noqa: NPY002
    found = identify(dented, test, {"a": (0, 1), "b": (0, 1)}, **keywords)
    assert found.parameters == pytest.approx({"a": 0.8, "b": 0.3}, abs=0.01)
    assert found.converged
    assert "rounds within 0.1 %" in found.message
    # numpy's own generator is left alone
    assert (np.random.get_state()[1] == state).all()  # noqa: NPY002


def test_global_of_a_single_parameter():
    pytest.importorskip("cma", reason="cma is an extra: curvewise[global]")
    keywords = {"method": Global(rounds=1), "progress": False, "max_runs": 600}
    bounds = {"a": (0, 1), "b": 0.3}
    found = identify(dented, np.column_stack((X, X)), bounds, **keywords)
    assert found.parameters["a"] == pytest.approx(0.8, abs=0.01)
    assert not found.converged  # a single round cannot agree with another


def test_without_cma_the_message_says_what_searched(monkeypatch):
    monkeypatch.setitem(sys.modules, "cma", None)
    keywords = {"method": "global", "progress": False, "max_runs": 2000}
    found = identify(dented, np.column_stack((X, X)), {"a": (0, 1), "b": (0, 1)}, **keywords)
    assert "by differential evolution, since cma is missing" in found.message
    assert 'pip install "curvewise[global]"' in found.message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"popsize": 3}, "popsize is 3; give at least 4"),
        ({"tol": 0.0}, "tol is 0.0; give a fraction"),
        ({"rounds": 0}, "rounds is 0; give at least 1"),
    ],
)
def test_options_that_cannot_be(options, message):
    with pytest.raises(ValueError, match=message):
        Global(**options)


def test_screening_of_a_linear_model_is_exact_and_the_same_everywhere():
    """The mean is the move of the loop over the bounds, as at any optimum; nothing deviates."""

    def line(p):
        return np.column_stack((X, p["slope"] * X + p["offset"]))

    bounds = {"slope": (0.0, 4.0), "offset": (-1.0, 1.0)}
    test = line({"slope": 1.0, "offset": 0.0})
    found = identify(line, test, bounds, **SQUARES)
    effects = screening(found, paths=4)
    expected = np.sqrt([[np.mean((4.0 * X) ** 2), 2.0**2]])
    assert effects.means == pytest.approx(expected, rel=1e-9)
    assert effects.deviations == pytest.approx(0.0, abs=1e-9)
    assert effects.means == pytest.approx(found.uncertainty().sensitivities, rel=1e-4)
    assert (effects.runs, effects.failed) == (12, 0)
    assert "12 runs of the model" in str(effects)
    assert effects.plot().axes[0].get_xlabel() == "move of the loop, % of its box"
    with pytest.raises(ValueError, match="paths is 3; give at least 4"):
        screening(found, paths=3)


def test_screening_goes_on_without_runs_that_fail():
    def fragile(p):
        if p["K"] > 3.0 and p["n"] < 1.0:
            raise ArithmeticError("no convergence")
        return power(p)

    effects = screening(identify(fragile, TEST, BOUNDS, **SQUARES), paths=8)
    assert effects.failed > 0
    assert (effects.means > 0.0).all()
