"""Runs one by one, each where the surface through the best runs is lowest."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.methods.curve_descent import CurveRuns
from curvewise.calibration.methods.single_runs import SingleRuns

# Two points, too far apart for any other coupling: the longer of two distances counts.
TEST = np.array([[0.0, 0.0], [100.0, 0.0]])
OBJECTIVE = Objective(TEST, Criterion("frechet", preset="raw"))
RUNS = [0.0, 0.15, 0.2, 0.4, 0.8, 1.0]


def evaluated(p: float, *, failed: bool = False) -> Any:
    """Minima near 0.2 and 0.7, of 0.08 and 0.03, with 0.6 between them."""
    simulations = [np.column_stack((TEST[:, 0], [10.0 * (p - 0.2) * (p - 0.7), 0.1 * (1.0 - p)]))]
    value = np.inf if failed else OBJECTIVE(simulations)
    return SimpleNamespace(failed=failed, simulations=simulations, value=value, place=p)


class Search:
    """A ledger of a model of one parameter that may fail from now on."""

    dimensions, has_slopes, negligible, objective = 1, False, 0.0, OBJECTIVE

    def __init__(self, places: list[float], *, fails: bool = False) -> None:
        self.fails, self.done = fails, [evaluated(p) for p in places]
        self.earlier_runs = [(np.array([run.place]), run) for run in self.done]

    def show_activity(self) -> None:
        """Show nothing."""

    @property
    def best(self) -> Any:
        return min(self.done, key=lambda run: run.value)

    @property
    def best_unit(self) -> np.ndarray:
        return np.array([self.best.place])

    def answers(self, course: Any) -> tuple[list[float], Any]:
        """Return where a course runs, and what it returns."""
        asked: list[float] = []
        answer = None
        while True:
            try:
                ((p,),) = course.send(answer)
            except StopIteration as end:
                return asked, end.value
            asked.append(p)
            self.done.append(evaluated(p, failed=self.fails))
            answer = self.done[-1:]


def singles(search: Any) -> SingleRuns:
    return SingleRuns(search, np.random.default_rng(0), CurveRuns(search))


def test_it_runs_where_the_surface_promises_most_until_it_promises_no_more():
    """Behind a ridge, beside another good run; the bottom near 0.2 is known."""
    search = Search(RUNS)
    asked, is_at_bottom = search.answers(singles(search).from_best(bottom=0.0))
    assert is_at_bottom
    assert len(asked) <= 6
    assert search.best_unit[0] == pytest.approx(0.7, abs=0.01)


def test_where_little_is_promised_nothing_is_run():
    search = Search([*RUNS, 0.7, 0.703, 0.706])
    assert search.answers(singles(search).from_best(bottom=np.inf)) == ([], True)


def test_it_gives_up_where_nothing_keeps_its_promise():
    search = Search(RUNS, fails=True)
    asked, is_at_bottom = search.answers(singles(search).from_best(bottom=0.0))
    assert not is_at_bottom
    assert len(asked) == 3


def test_a_start_goes_on_from_its_own_best_run():
    search = Search(RUNS)
    own = evaluated(0.4)
    _, (place, value) = search.answers(singles(search).from_own(np.array([0.4]), own.value, 0.2))
    assert value == evaluated(place[0]).value < 0.1
    assert value < own.value


def test_a_start_ends_where_it_promises_too_little_of_what_it_is_above_the_best():
    search, place = Search(RUNS), np.array([0.4])
    value = evaluated(0.4).value
    asked, end = search.answers(singles(search).from_own(place, value, left_behind=2.0))
    assert asked == []
    assert end == (place, value)


def test_a_start_ends_where_four_runs_gain_nothing():
    search = Search(RUNS, fails=True)
    asked, end = search.answers(
        singles(search).from_own(np.array([0.4]), evaluated(0.4).value, left_behind=0.2)
    )
    assert len(asked) == 4
    assert end[0] == 0.4
