"""Where searches start, how many starts there are, and when they may say "converged"."""

from __future__ import annotations

import itertools
import logging
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from test_methods import BOUNDS, TRUE, model, quiet_identify

from curvewise import datasets
from curvewise.calibration import Criterion, Objective, TrustRegion
from curvewise.calibration.methods.descent import Descent, Rules
from curvewise.calibration.methods.shared_runs import SharedRuns
from curvewise.calibration.methods.side_by_side import Part, side_by_side
from curvewise.calibration.methods.starts import (
    HOP,
    End,
    are_alike,
    finish_of,
    hop,
    is_flat,
    places,
)
from curvewise.calibration.problem.ledger import Finish

K = 3


def ended(value: float, place: float = 0.0, first: float = 10.0, *, converged: bool = True) -> End:
    return End(first, value, np.full(K, place), Finish(converged, f"ended at {value}"))


def driven(course: Any) -> tuple[list[list[float]], Any]:
    """Return what a course asks for, and what it returns; what is asked is the answer."""
    asked: list[list[float]] = []
    answer: Any = None
    while True:
        try:
            points = course.send(answer)
        except StopIteration as end:
            return asked, end.value
        asked.append(points.ravel().tolist())
        answer = asked[-1] if points.shape[1] == 1 else list(points)


@pytest.mark.parametrize("k", [1, 2, 8])
def test_starts_are_spread_over_the_box(k):
    """The middle, then of every four a point in each quarter of every axis."""
    first = list(itertools.islice(places(k, np.random.default_rng(1)), 17))
    again = list(itertools.islice(places(k, np.random.default_rng(1)), 17))
    np.testing.assert_array_equal(first, again)
    np.testing.assert_array_equal(first[0], np.full(k, 0.5))
    spread = np.array(first[1:])
    assert spread.min() >= 0.1
    assert spread.max() <= 0.9
    for four in spread.reshape(4, 4, k):
        quarters = np.sort(np.floor((four - 0.1) / 0.2), axis=0)
        np.testing.assert_array_equal(quarters, np.tile(np.arange(4.0)[:, np.newaxis], (1, k)))
    assert len(np.unique(spread)) == spread.size


def test_a_hop_stays_near_the_best_run():
    random = np.random.default_rng(0)
    hops = np.array([hop(np.array([0.0, 0.5, 0.9]), random) for _ in range(200)])
    assert hops.min() >= 0.0
    assert hops.max() <= 1.0
    assert np.abs(hops - [0.0, 0.5, 0.9]).max() <= 0.25
    assert np.ptp(hops, axis=0).min() > 0.2


@pytest.mark.parametrize(
    ("values", "negligible", "alike"),
    [
        ([5.0, 5.04, 5.06], 1e-6, 2),
        ([5.06, 5.0, 4.0], 1e-6, 1),
        ([9e-4, 0.0, 2e-3], 1e-6, 2),  # perfect, by what is negligible
        ([1e-5, 3e-5, 3e-4], 1e-9, 2),  # and by what was gained
        ([1.0, 1.0, 1.0], 1e-6, 3),
    ],
)
def test_how_many_starts_end_alike(values, negligible, alike):
    """Within 1 % of the best, or all but perfect."""
    ends = [ended(value, place / 10, first=1.0) for place, value in enumerate(values)]
    assert are_alike(ends, negligible) == alike


def test_what_may_be_said_of_the_ends():
    """Never "converged" where starts end apart, at a plateau, or where they began."""
    best = ended(5.0)
    assert finish_of([best], 1, 0.0) == (True, "ended at 5.0")
    assert finish_of([best, ended(5.04), ended(5.01)], 3, 0.0) == (
        True,
        "3 of 3 starts within 1 % of the best; ended at 5.0",
    )
    assert finish_of([best, ended(5.04), ended(5.1)], 3, 0.0) == (
        False,
        "2 of 3 starts within 1 % of the best, others up to 2 % above; ended at 5.0",
    )
    assert finish_of([best, ended(5.004), ended(5.02)], 3, 0.0, within=1e-3) == (
        False,
        "2 of 3 starts within 0.1 % of the best, others up to 0.4 % above; ended at 5.0",
    )
    assert not finish_of([best, ended(5.01)], 3, 0.0).converged  # one found no run that succeeds
    assert not finish_of([ended(5.0, converged=False), ended(5.01)], 2, 0.0).converged
    flat = finish_of([best, ended(5.0, place=0.3)], 2, 0.0)
    assert not flat.converged
    assert flat.message.startswith("several places have the best value: the measure is flat")
    still = finish_of([ended(5.0, first=5.0)], 1, 0.0)
    assert not still.converged
    assert still.message.startswith("no step gained anything: the start is a minimum already, or")
    assert finish_of([ended(0.0, first=0.0)], 1, 1e-9).converged  # begun at a perfect fit


def test_equal_values_at_one_place_are_no_plateau():
    assert not is_flat([ended(5.0, place=0.3), ended(5.0, place=0.305)], 0.0)
    assert is_flat([ended(5.0, place=0.3), ended(5.0, place=0.32)], 0.0)
    assert not is_flat([ended(5.0, place=0.3), ended(4.0, place=0.8)], 0.0)
    assert not is_flat([ended(0.0, place=0.3), ended(0.0, place=0.8)], 1e-9)  # perfect fits


def test_courses_go_in_rounds_and_others_follow():
    """Each round has one batch of every course that goes on, in their order."""

    def course(name: float, rounds: int) -> Part[float]:
        for _ in range(rounds):
            (run,) = yield np.array([[name]])
            assert run == name
        return name

    expected: list[float] = []
    waiting = [course(3.0, 0), course(4.0, 1)]  # the third ends without a run
    both = side_by_side(
        [course(1.0, 3), course(2.0, 1)],
        lambda: [waiting.pop(0)] if waiting else [],
        lambda units: expected.append(float(units[0, 0])),
    )
    asked, names = driven(both)
    # All at once to begin with; then each in its turn, those that are new behind.
    assert asked == [[1.0, 2.0], [1.0], [2.0], [1.0], [4.0], [1.0]]
    assert expected == [1.0, 2.0, 1.0, 4.0, 1.0]
    assert names == [1.0, 2.0, 3.0, 4.0]


class Valleys:
    """In the place of a descent: ends at values that are listed, at places of their own."""

    values: list[float]
    rules: list[Any]

    def __init__(self, ledger: Any, random: Any, rules: Any, runs: Any) -> None:
        self.rules.append(rules)

    def course(self, start: Any) -> Part[End]:
        yield np.atleast_2d(start)
        return ended(self.values.pop(0), float(start[0]))


class NoSingleRuns:
    """In the place of single runs: makes none, and leaves the best run where it is."""

    def __init__(self, *known: Any) -> None:
        """Take what a search knows."""

    def from_best(self, bottom: float) -> Part[bool]:
        yield from ()
        return False

    def from_own(self, own: Any, value: float, left_behind: float) -> Part[tuple[Any, float]]:
        yield from ()
        return own, value


@pytest.mark.parametrize(
    ("measure", "values", "count", "alike"),
    [
        ("area", [5.0, 5.01, 5.02, 5.03, 5.04, 5.05], 6, 6),  # they agree, and three more with them
        ("area", [5.0, 6.0, 4.0, 4.01, 4.02, 4.03, 4.02, 4.01, 9.0], 9, 6),  # six with the best
        ("area", [float(5 + i) for i in range(40)], 10, 1),  # the most
        ("area", [5.0] * 30, 30, 30),  # flat ground: short starts, and more of them
        ("frechet", [float(5 + i) for i in range(40)], 30, 1),  # and of those by frechet
        # They hop on one surface, so that more of them have to agree.
        ("frechet", [5.0 + i / 1000.0 for i in range(40)], 15, 15),
        ("frechet, slopes", [float(5 + i) for i in range(40)], 30, 1),
        # Those in valleys that the surface shows do not tell, the others do: here every third.
        ("frechet, slopes", [5.0 + i / 1000.0 for i in range(40)], 9, 9),
        ("dtw", [float(5 + i) for i in range(40)], 30, 1),  # and by dtw
        ("dtw", [5.0 + i / 1000.0 for i in range(40)], 9, 9),  # those near the best run do not tell
    ],
)
def test_starts_that_disagree_are_followed_by_others(
    measure, values, count, alike, monkeypatch, caplog
):
    caplog.set_level(logging.INFO, "curvewise.calibration")
    room = "curvewise.calibration.methods.trust_region"
    monkeypatch.setattr(f"{room}.CurveDescent", Valleys)
    monkeypatch.setattr(f"{room}.SingleRuns", NoSingleRuns)
    has_slopes, measure = "slopes" in measure, measure.partition(",")[0]
    reaches: list[float] = []

    def promising_place(*known: Any) -> Any:
        reaches.append(known[-1])
        return np.full(2, 0.7)

    def lowest_valley(*known: Any) -> Any:
        reaches.append(0.0)
        return None if len(reaches) % 3 == 0 else np.full(2, 0.7)

    monkeypatch.setattr(f"{room}.promising_place", promising_place)
    monkeypatch.setattr(f"{room}.lowest_valley", lowest_valley)
    Valleys.values, Valleys.rules = list(values), []
    ledger: Any = SimpleNamespace(
        dimensions=2,
        has_slopes=has_slopes,
        negligible=0.0,
        earlier_runs=(),
        runs_with_curves=(),
        objective=Objective(np.array([[0.0, 0.0], [1.0, 2.0]]), measure),
        done=[None] * 30,
        best=SimpleNamespace(value=min(values)),
        best_unit=np.full(2, 0.4),
        expect=lambda units: None,
    )
    asked, finish = driven(TrustRegion().course(ledger, None, 1))
    assert max(map(len, asked)) == 3 * 2  # coordinates: no more than three starts at a time
    assert len(Valleys.rules) == count
    assert f"{alike} of {count} starts within 1 % of the best" in finish.message
    said = [record.getMessage() for record in caplog.records]
    assert len(said) == (alike != count)
    assert all("more follow, of some 10 runs each" in text for text in said)
    behind = {rules.left_behind for rules in Valleys.rules}
    first = {0.0 if measure == "area" else 0.2}
    assert behind == (first | {0.0} if measure == "frechet" and not has_slopes else first)
    # Where the runs promise most regions are smaller.
    radii = [rules.first_radius for rules in Valleys.rules[3:6]]
    if measure == "frechet" and not has_slopes:  # single runs take the place of others
        assert radii == [0.5, 0.5, 0.5]
        assert reaches == []
    elif measure == "frechet":  # where the surface shows no lower valley at another place
        assert radii == [0.25, 0.25, 0.5]
        assert reaches == [0.0] * (count - 3)
    else:
        assert radii == [0.25, 0.5, 0.25]
        assert set(reaches) == {HOP if measure == "dtw" else 1.0}


class Slow(Descent):
    """A start whose surface promises a tenth at every step, of which it gains nothing."""

    looks_at_once = True

    def _lowest(self, radius: float) -> tuple[np.ndarray, float]:
        return self.centre + 0.01, 0.1

    def _end(self, radius: float, promised: float, least: float) -> Finish:
        return Finish(True, "arrived")


class Known(SharedRuns):
    """Runs of which nothing but the values counts."""

    negligible = 0.0

    def _taken(self, run: Any) -> tuple[np.ndarray, float]:
        return np.zeros(1), run.value

    def _known_slopes(self, number: int, by_curve: Any) -> None:
        return None


@pytest.mark.parametrize(
    ("best", "message"), [(9.51, "2 steps"), (9.49, "another start is far ahead")]
)
def test_a_start_far_above_the_best_run_is_left_behind(best, message):
    """It is 10, and promises to gain a fifth of what it is above the best at 9.5."""
    ledger: Any = SimpleNamespace(
        dimensions=K,
        has_slopes=True,
        slopes=lambda point: None,
        earlier_runs=[(np.zeros(K), SimpleNamespace(failed=False, value=best))],
    )
    rules = Rules(0.1, 0.02, 1e-3, 1e-3, maxiter=2, left_behind=0.2)
    course = Slow(np.random.default_rng(0), rules, Known(ledger)).course(np.full(K, 0.5))
    runs: Any = None
    end = None
    while end is None:
        try:
            asked = course.send(runs)
        except StopIteration as stopped:
            end = stopped.value
        else:
            runs = [SimpleNamespace(failed=False, value=10.0) for _ in asked]
    assert end.finish.message == message


def test_a_bound_that_was_not_meant_has_not_converged():
    bounds = {**BOUNDS, "yield": (320.0, 500.0)}
    found = quiet_identify(model, model(TRUE), bounds)
    assert not found.converged
    assert found.message.startswith("yield is at its lower bound: widen it if it is not meant (")
    x = np.linspace(0.0, 1.0, 9)

    def line(p):
        return np.column_stack((x, 2.0 * x + p["offset"]))

    found = quiet_identify(line, line({"offset": -0.1}), {"offset": (0.0, 5.0)})
    assert found.converged  # a bound of 0 is meant
    assert found.parameters["offset"] < 0.005


def test_flat_ground_is_said_and_searched():
    """The middle of the bounds, 0.047, was said to have converged: the mesh decides there."""
    experiment, simulation = datasets.hysteresis_pair()
    strain = simulation[:, 0]

    def loop(p):
        stress = datasets.kinematic_hardening(
            strain,
            youngs_modulus=195e3,
            yield_stress=p["yield"],
            backstresses=[(p["C"], p["gamma"]), (10e3, 60.0), (2e3, 0.0)],
        )
        return np.column_stack([strain, stress])

    bounds = {"yield": (200, 500), "C": (20e3, 200e3), "gamma": (100, 1000)}
    with pytest.warns(match="frechet is decided by the one point"):
        found = quiet_identify(
            loop, experiment, bounds, measure="frechet", method=TrustRegion(most_starts=4)
        )
    assert not found.converged
    assert "starts within 1 % of the best" in found.message
    assert found.value < 0.0445


def test_the_answer_is_the_same_however_many_runs_are_made_at_once():
    """Threads and processes; some runs are finished before others that were asked first."""
    alone = quiet_identify(model, model(TRUE), BOUNDS, max_runs=25)
    with ThreadPoolExecutor(8) as threads:
        others = [
            quiet_identify(slow_model, model(TRUE), BOUNDS, max_runs=25, executor=threads),
            quiet_identify(model, model(TRUE), BOUNDS, max_runs=25, workers=2),
        ]
    for other in others:
        assert other.message == alone.message
        for name in ("evaluation", *BOUNDS, "value"):
            np.testing.assert_array_equal(other.history[name], alone.history[name])


@pytest.mark.nightly
def test_nor_does_it_depend_on_eight_processes():
    alone = quiet_identify(model, model(TRUE), BOUNDS, max_runs=40)
    other = quiet_identify(slow_model, model(TRUE), BOUNDS, max_runs=40, workers=8)
    assert other.message == alone.message
    np.testing.assert_array_equal(other.history.value, alone.history.value)


def slow_model(parameters):
    time.sleep(1e-3 * (hash(parameters["E"]) % 7))
    return model(parameters)


def test_where_nothing_is_gained_nothing_has_converged():
    x = np.linspace(0.0, 1.0, 9)
    found = quiet_identify(
        lambda p: np.column_stack((x, p["a"] * x)),
        np.column_stack((x, x)),
        {"a": (0.0, 4.0)},
        measure=Criterion(lambda P, Q: 1.0, preset="raw"),
        start={"a": 2.0},
    )
    assert (found.converged, found.parameters) == (False, {"a": 2.0})
    assert found.message.startswith("no step gained anything")
