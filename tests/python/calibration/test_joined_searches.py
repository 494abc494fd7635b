"""Several searches as one: history, failures and runs of all, and the optimum of one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from curvewise.calibration import DifferentialEvolution, SimulationStore, identify
from curvewise.calibration.answers.joined_searches import continued, joined

X = np.linspace(0.0, 1.0, 12)


def fragile(p):
    if p["a"] > 3.0 or p["b"] > 1.9:
        raise ArithmeticError("a is above 3, or b above 1.9")
    return np.column_stack((X, p["a"] * X + p["b"] * X**2))


TEST = fragile({"a": 2.5, "b": 1.4})
KEYWORDS = {"method": DifferentialEvolution(popsize=4, maxiter=3), "progress": False}


@pytest.fixture(scope="module")
def searches():
    bounds = [{"a": (0.0, 2.0), "b": (0.0, 2.0)}, {"a": (0.0, 9.0), "b": (0.0, 4.0)}]
    return [identify(fragile, TEST, one, seed=i, **KEYWORDS) for i, one in enumerate(bounds)]


@pytest.mark.parametrize("number", [0, 1])
def test_a_joined_search_has_the_evaluations_of_all(searches, number: int) -> None:
    first, second = searches
    chosen = searches[number]
    whole = joined(searches, chosen)
    assert whole.evaluations == whole.runs == first.evaluations + second.evaluations
    assert whole.history["evaluation"].tolist() == list(range(1, whole.evaluations + 1))
    for name in ("a", "b", "value", "failed", "seconds"):
        both = np.concatenate([first.history[name], second.history[name]])
        np.testing.assert_array_equal(whole.history[name], both)
    assert second.failures
    assert [n for n, _ in whole.failures] == whole.history["evaluation"][
        whole.history["failed"]
    ].tolist()
    assert {message for _, message in whole.failures} == {second.failures[0][1]}
    assert (whole.value, whole.parameters) == (chosen.value, chosen.parameters)
    assert (whole.message, whole.bounds) == (chosen.message, chosen.bounds)


def test_its_record_has_them_too_and_those_of_each_search_remain(searches) -> None:
    before = [one.record() for one in searches]
    whole = joined(searches, searches[0]).record()
    assert [one.number for one in whole.evaluations] == list(range(1, len(whole.evaluations) + 1))
    values = [one.value for record in before for one in record.evaluations]
    assert [one.value for one in whole.evaluations] == values
    assert whole.settings == before[0].settings
    after = [one.record() for one in searches]
    assert [r.evaluations for r in after] == [r.evaluations for r in before]


def test_a_store_has_each_search_by_itself(tmp_path: Path) -> None:
    store = SimulationStore(tmp_path / "s.db", version="1")
    bounds = {"a": (0.0, 2.0), "b": (0.0, 1.0)}
    two = [identify(fragile, TEST, bounds, seed=i, store=store, **KEYWORDS) for i in (0, 1)]
    assert len(joined(two, two[1]).record().evaluations) == two[1].evaluations


def test_a_continuation_ends_as_the_later_search_unless_that_only_confirms(searches) -> None:
    worse, better = sorted(searches, key=lambda one: -one.value)
    assert better.value < worse.value
    on = continued(worse, better)
    assert (on.value, on.message, on.converged) == (better.value, better.message, better.converged)
    assert on.evaluations == sum(one.evaluations for one in searches)
    back = continued(better, worse)
    assert (back.value, back.parameters) == (better.value, better.parameters)
    assert back.converged == (better.converged or worse.converged)
    assert back.runs_with_curves == worse.runs_with_curves
