"""Where searches start, how many starts there are, and when they may say "converged"."""

from __future__ import annotations

import itertools
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from test_methods import BOUNDS, TRUE, model, quiet_identify

from curvewise import datasets
from curvewise.calibration import Criterion, Objective, TrustRegion
from curvewise.calibration.methods.descent import Descent, Part, Rules
from curvewise.calibration.methods.global_stage import GlobalStage
from curvewise.calibration.methods.multistart import places, side_by_side
from curvewise.calibration.methods.runs import Noise, Runs
from curvewise.calibration.methods.starts import (
    End,
    are_alike,
    finish_of,
    is_enough,
    is_flat,
)
from curvewise.calibration.problem.ledger import Finish

K = 3


def ended(
    value: float,
    place: float = 0.0,
    first: float = 10.0,
    *,
    converged: bool = True,
    independent: bool = True,
    **others: Any,
) -> End:
    finish = Finish(converged, f"ended at {value}")
    return End(first, value, np.full(K, place), finish, independent, **others)


def driven(course: Any) -> tuple[list[list[float]], Any]:
    """Return the requests of a course, and its result; the requests are the answers."""
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


@pytest.mark.parametrize(
    ("values", "negligible", "alike"),
    [
        ([5.0, 5.04, 5.06], 1e-6, 2),
        ([5.06, 5.0, 4.0], 1e-6, 1),
        ([9e-4, 0.0, 2e-3], 1e-6, 2),  # perfect, relative to a negligible value
        ([1e-5, 3e-5, 3e-4], 1e-9, 2),  # and relative to the gain
        ([1.0, 1.0, 1.0], 1e-6, 3),
    ],
)
def test_how_many_starts_end_alike(values, negligible, alike):
    """Within 1 % of the best, or all but perfect."""
    ends = [ended(value, place / 10, first=1.0) for place, value in enumerate(values)]
    assert are_alike(ends, negligible, ends) == alike


@pytest.mark.parametrize(("noise", "alike"), [(0.0, 1), (0.1, 2), (1.0, 2)])
def test_ends_within_the_noise_of_the_model_are_alike(noise, alike):
    """Two deviations, but never more than 5 %."""
    ends = [ended(5.0, noise=noise), ended(5.19), ended(5.3)]
    assert are_alike(ends, 0.0, ends) == alike


@pytest.mark.parametrize(
    ("ends", "enough"),
    [
        ([ended(5.0), ended(5.01)], False),
        ([ended(5.0), ended(5.01), ended(5.02)], True),  # all agree
        ([ended(5.0), ended(5.01), ended(5.02), ended(6.0)], False),  # one more has to, then
        ([ended(5.0), ended(5.01), ended(5.02), ended(5.03), ended(6.0)], True),
        ([ended(5.0 + i / 1e3) for i in range(4)] + [ended(6.0)] * 5, False),  # and half
        ([ended(5.0), ended(5.01), ended(5.02), ended(6.0, converged=False)], True),  # left behind
        ([ended(5.0), ended(5.01), ended(5.02, independent=False)], False),
    ],
)
def test_how_many_starts_are_enough(ends, enough):
    assert is_enough(ends, 0.0, 3) == enough


def test_what_may_be_said_of_the_ends():
    """Never "converged" where starts end apart, at a plateau, or where they began."""
    best = ended(5.0)
    assert finish_of([best], 0.0, 1) == (True, "ended at 5.0", (1, 1, 0.0), "")
    assert finish_of([best, ended(5.04), ended(5.01)], 0.0, 3) == (
        True,
        "3 of 3 starts within 1 % of the best; ended at 5.0",
        (3, 3, pytest.approx(0.008)),
        "",
    )
    assert finish_of([best, ended(5.04), ended(5.1)], 0.0, 3) == (
        False,
        "2 of 3 starts within 1 % of the best, others up to 2 % above; ended at 5.0",
        (2, 3, pytest.approx(0.008)),
        "only 2 of 3 starts agree; give closer bounds, or another seed",
    )
    assert finish_of([best, ended(5.01), ended(5.02, independent=False)], 0.0, 3) == (
        False,
        "2 of 2 starts within 1 % of the best; ended at 5.0",
        (2, 2, pytest.approx(0.002)),
        "only 2 of 2 starts agree; give closer bounds, or another seed",
    )
    alone = finish_of([best, ended(6.0), ended(7.0)], 0.0, 3)
    assert (alone.agreement, alone.reason[:22]) == ((1, 3, 0.0), "no two starts agree; g")
    perfect = [ended(value, first=1.0) for value in (1e-9, 3e-9, 5e-9)]
    assert finish_of(perfect, 1e-9, 3).agreement == (3, 3, 0.0)
    assert not finish_of([ended(5.0, converged=False), ended(5.01)], 0.0, 2).converged
    flat = finish_of([best, ended(5.0, place=0.3)], 0.0, 2)
    assert not flat.converged
    assert flat.reason.startswith("several parameter sets have the same best value")
    assert flat.message.startswith("several parameter sets have the best value: the measure is")
    still = finish_of([ended(5.0, first=5.0)], 0.0, 1)
    assert not still.converged
    assert still.reason.startswith("no start found a better fit than it began with")
    assert still.message.startswith("no step gained anything: the start is a minimum already, or")
    assert finish_of([ended(0.0, first=0.0)], 1e-9, 1).converged  # begun at a perfect fit
    there = ended(4.999, first=4.999, independent=False)  # begun where others had ended
    assert finish_of([best, ended(5.0, first=9.0), ended(5.01), there], 0.0, 3).converged
    misled = finish_of([best, ended(5.0), ended(5.0, is_misled=True)], 0.0, 2)
    assert not misled.converged
    assert misled.reason.startswith("the model's curves jump")
    assert misled.message.startswith("the surrogate of curves misleads, and steps went by the")


@pytest.mark.parametrize(
    ("alike", "higher", "starts", "converged"),
    [
        (10, 9, 10, True),  # of whoever asks for ten, enough for the default agree
        (4, 15, 10, True),
        (3, 15, 10, False),  # one more than all that agree by default
        (3, 0, 10, True),
        (2, 0, 10, False),
        (2, 0, 2, True),
        (2, 1, 2, False),
    ],
)
def test_what_has_arrived_where_others_ended_higher(alike, higher, starts, converged):
    ends = [ended(5.0 + i / 1e4) for i in range(alike)] + [ended(6.0)] * higher
    finish = finish_of(ends, 0.0, starts)
    assert finish.converged == converged
    assert finish.agreement[:2] == (alike, alike + higher)


def test_starts_that_were_left_behind_do_not_agree():
    ends = [ended(5.0), ended(5.01), ended(5.0, converged=False)]
    assert finish_of(ends, 0.0, 3).agreement == (2, 3, pytest.approx(0.002))


def test_equal_values_at_one_place_are_no_plateau():
    assert not is_flat([ended(5.0, place=0.3), ended(5.0, place=0.305)], 0.0)
    assert is_flat([ended(5.0, place=0.3), ended(5.0, place=0.32)], 0.0)
    assert not is_flat([ended(5.0, place=0.3), ended(4.0, place=0.8)], 0.0)
    assert not is_flat([ended(0.0, place=0.3), ended(0.0, place=0.8)], 1e-9)  # perfect fits


def test_courses_go_in_rounds_and_others_follow():
    """Each round has one batch of every course that continues, in their order."""

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


class Listed:
    """Replaces a descent: ends at listed values, at different places."""

    values: list[float]
    begun: list[tuple[Any, bool, bool]]
    made: int

    def __init__(
        self, random: Any, rules: Any, runs: Any, *, is_independent: bool, is_shared: bool
    ) -> None:
        self.begun.append((rules, is_independent, is_shared))
        self.is_independent = is_independent

    def course(self, start: Any) -> Part[End]:
        yield np.atleast_2d(start)
        value = self.values.pop(0)
        return ended(value, float(start[0]), independent=self.is_independent)


@pytest.mark.parametrize("at_once", [1, 3])
@pytest.mark.parametrize("made", [50, 51])
@pytest.mark.parametrize(
    ("values", "count", "alike"),
    [
        ([5.0, 5.01, 5.02], 3, 3),  # they agree
        ([5.0, 6.0, 5.01, 5.02, 5.03, 5.02], 6, 4),  # four of five; one more where they promise
        ([float(5 + i) for i in range(50)], 40, 1),  # the most
        ([5.0] * 40, 40, 22),  # flat ground
    ],
)
def test_starts_that_disagree_are_followed_by_others(
    values, count, alike, made, at_once, monkeypatch
):
    monkeypatch.setattr("curvewise.calibration.methods.multistart.Descent", Listed)
    monkeypatch.setattr(GlobalStage, "lowest", lambda *_: (np.full(2, 0.7), 1.0))
    Listed.values, Listed.begun, Listed.made = list(values), [], made
    run = SimpleNamespace(failed=False, value=9.0, simulations=(np.zeros((2, 2)),))
    ledger: Any = SimpleNamespace(
        dimensions=2,
        has_slopes=False,
        negligible=0.0,
        earlier_runs=[(np.zeros(2), run)],
        objective=Objective(np.array([[0.0, 0.0], [1.0, 2.0]])),
        expect=lambda units: None,
        show_activity=lambda: None,
    )
    asked, finish = driven(TrustRegion(starts_at_once=at_once).course(ledger, None, 1))
    assert max(map(len, asked)) == at_once * 2  # coordinates
    if at_once == 1:
        assert len(Listed.begun) == count
        assert f"{alike} of {sum(own for _, own, _ in Listed.begun)} starts" in finish.message
    # The first in a separate region; those that begin where the surrogate predicts a gain do not
    # count.
    independent = [own for _, own, _ in Listed.begun[:6]]
    assert independent == [True, True, True, True, False, True][:count]
    radii = [rules.first_radius for rules, _, _ in Listed.begun[:5]]
    assert radii == [0.5, 0.25, 0.25, 0.25, 0.25][: len(radii)]
    # Three starts of 50 runs, and as many that depend on them, fit into 300 runs, whatever the
    # limit of the search. Otherwise the starts share their runs once the first has shown this.
    shared = [shared for _, _, shared in Listed.begun]
    assert shared == [False] * at_once + [made > 50] * (len(shared) - at_once)


class Slow(Descent):
    """A start whose surrogate predicts a tenth at every step, but which gains nothing."""

    def _lowest(self, radius: float) -> tuple[np.ndarray, float]:
        return self.centre + 0.01, 0.1


class Known:
    """An inner search for which only the values of runs count."""

    negligible, sides, is_smooth = 0.0, None, True

    def taken(self, run: Any) -> tuple[np.ndarray, float]:
        return np.zeros(1), run.value

    def slopes(self, run: Any, by_curve: Any) -> None:
        return None


@pytest.mark.parametrize(
    ("best", "message"), [(8.9, "another start is far ahead"), (9.3, "2 steps")]
)
def test_a_start_far_above_the_best_run_is_abandoned(best, message, monkeypatch):
    """Its value is 10, and its predicted gain is less than a fifth of the distance to the best."""
    monkeypatch.setattr(Runs, "noise", lambda runs, number, reach: Noise(0.0, 0.0))
    ledger: Any = SimpleNamespace(
        dimensions=K,
        has_slopes=True,
        slopes=lambda point: None,
        earlier_runs=[(np.zeros(K), SimpleNamespace(failed=False, value=best))],
    )
    inner: Any = Known()
    rules = Rules(0.1, 0.02, 1e-3, 1e-3, maxiter=2)
    descent = Slow(np.random.default_rng(0), rules, Runs(ledger, inner), is_independent=True)
    course = descent.course(np.full(K, 0.5))
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
    assert not end.tells


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
            loop, experiment, bounds, measure="frechet", method=TrustRegion(most_starts=12)
        )
    assert not found.converged
    assert "starts within 1 % of the best" in found.message
    assert found.value < 0.0455


def test_the_answer_is_the_same_however_many_runs_are_made_at_once():
    """Threads and processes; some runs are finished before others that were asked first."""
    keywords = {"max_runs": 25, "method": TrustRegion(starts_at_once=3)}
    alone = quiet_identify(model, model(TRUE), BOUNDS, **keywords)
    with ThreadPoolExecutor(8) as threads:
        others = [
            quiet_identify(slow_model, model(TRUE), BOUNDS, executor=threads, **keywords),
            quiet_identify(model, model(TRUE), BOUNDS, workers=2, **keywords),
        ]
    for other in others:
        assert other.message == alone.message
        for name in ("evaluation", *BOUNDS, "value"):
            np.testing.assert_array_equal(other.history[name], alone.history[name])


@pytest.mark.nightly
def test_nor_does_it_depend_on_eight_processes():
    keywords = {"max_runs": 40, "method": TrustRegion(starts_at_once=3)}
    alone = quiet_identify(model, model(TRUE), BOUNDS, **keywords)
    other = quiet_identify(slow_model, model(TRUE), BOUNDS, workers=8, **keywords)
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
