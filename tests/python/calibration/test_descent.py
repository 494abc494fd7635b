"""The trust region without a model: how the region grows and shrinks, and its geometry-improving
steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration.methods.descent import Descent, Part, Rules, simplex_around
from curvewise.calibration.methods.runs import Noise, Runs
from curvewise.calibration.methods.starts import End
from curvewise.calibration.objective.criterion import Criterion
from curvewise.calibration.objective.objective import Objective
from curvewise.calibration.problem.ledger import Finish
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.surfaces.inner_search import CurveSearch

REACH = 0.8  # of the region, by every step
RULES = Rules(0.2, diff_step=0.02, tol=1e-3, gain=1e-3, maxiter=50)


class Scripted(Descent):
    """A search whose surrogates predict a gain of 1 each time, and whose runs gain the listed
    amounts.
    """

    centre = np.zeros(2)  # type: ignore[assignment]
    value = 10.0  # type: ignore[assignment]

    def __init__(
        self,
        gains: Sequence[float],
        rules: Rules = RULES,
        *,
        unknown: int = 0,
        hops: int = 0,
        is_smooth: bool = True,
    ) -> None:
        inner = SimpleNamespace(negligible=0.0, is_smooth=is_smooth)
        runs: Any = SimpleNamespace(
            inner=inner,
            has_slopes=False,
            is_misled=False,
            earlier=0,
            values=[10.0],
            points=np.zeros((1, 2)),
            noise=lambda number, reach: Noise(0.0, 0.0),
        )
        super().__init__(np.random.default_rng(1), rules, runs, is_independent=True)
        self._best = 0
        self.gains, self.unknown, self.hops = list(gains), unknown, hops
        self.radii: list[float] = []

    def _lowest(self, radius: float) -> tuple[Any, float]:
        self.radii.append(radius)
        return np.array([0.1 * radius, -REACH * radius]), 1.0 if self.gains else 0.0

    def _run(self, points: Any) -> Part[None]:
        yield from ()
        self._last = self.value - self.gains.pop(0)

    def _looks_around(self) -> Part[bool]:
        yield from ()
        self.unknown -= 1
        return self.unknown >= 0

    def _hops(self, least: float) -> Part[bool]:
        yield from ()
        self.hops -= 1
        return self.hops >= 0

    def _end(self, radius: float, promised: float, least: float) -> Finish:
        return Finish(True, f"{promised:g} {least:g}")


def finish_of(search: Scripted) -> tuple[bool, str]:
    with pytest.raises(StopIteration) as end:
        next(search._descended())
    finish: Finish = end.value.value
    return finish.converged, finish.message


@pytest.mark.parametrize(
    ("gain", "factor"),
    [
        (1.0, 2.0 * REACH),
        (0.71, 2.0 * REACH),
        (0.69, 1.0),
        (0.31, 1.0),
        (0.29, 0.7 * REACH),
        (0.11, 0.7 * REACH),
        (0.09, 0.5 * REACH),
        (-1e9, 0.5 * REACH),
        (-np.inf, 1.0),  # once more, with shorter sides
    ],
)
def test_the_region_follows_how_well_gains_are_predicted(gain, factor):
    search = Scripted([gain])
    assert finish_of(search) == (True, "0 0.01")
    assert search.radii == pytest.approx([0.2, 0.2 * factor])


def test_the_region_is_never_more_than_the_bounds():
    search = Scripted([1.0, 1.0], replace(RULES, first_radius=0.6))
    finish_of(search)
    assert search.radii == pytest.approx([0.6, 0.96, 1.0])


def test_a_region_below_tol_ends_it_once_all_is_known():
    """A geometry-improving step makes the region five times the sampled size, at most 0.02."""
    search = Scripted([-1.0] * 3, replace(RULES, tol=0.1), unknown=1)
    assert finish_of(search)[0]
    assert search.radii == pytest.approx([0.2, 0.08, 0.1, 0.04])


def test_a_search_that_hops_to_another_minimum_goes_on():
    search = Scripted([], replace(RULES, first_radius=0.05), hops=1)
    assert finish_of(search)[0]
    assert search.radii == [0.05, 0.15]
    assert search.hops == -1


@pytest.mark.parametrize(
    ("gains", "is_early"), [([-1.0] * 4, True), ([-1.0, -1.0, 1.0, -1.0, -1.0], False)]
)
def test_other_minima_near_kinks_have_their_turn_after_three_failed_steps(gains, is_early):
    kinked, smooth = Scripted(gains, hops=9, is_smooth=False), Scripted(gains, hops=9)
    for search in (kinked, smooth):
        finish_of(search)
    assert kinked.radii[:3] == smooth.radii[:3]
    assert (kinked.radii[3:5] != smooth.radii[3:5]) == is_early


def test_no_other_minima_of_curves_have_a_turn_where_their_surrogate_misleads():
    misled, smooth = (Scripted([-1.0] * 4, hops=9, is_smooth=smooth) for smooth in (False, True))
    misled._by_value = True
    for search in (misled, smooth):
        finish_of(search)
    assert misled.radii == smooth.radii


class Hopping(Scripted):
    """A start whose global stage predicts a gain of 1 each time, as long as gains are listed."""

    _hops = Descent._hops

    def __init__(self, gains: Sequence[float]) -> None:
        super().__init__(gains)
        self.value, self.made_hops = 100.0, 0  # type: ignore[misc]
        self._runs.values = [100.0]
        self._runs.is_exhausted = lambda place: False
        self._runs.exhausted = []
        proposal = (np.zeros(2), 1.0)
        self._stage: Any = SimpleNamespace(lowest=lambda *_: proposal if self.gains else None)

    def _run(self, points: Any) -> Part[None]:
        yield from ()
        self.made_hops += 1
        self.value -= max(0.0, self.gains.pop(0))  # type: ignore[misc]
        self._runs.values = [self.value]


@pytest.mark.parametrize(
    ("gains", "made", "has_gained"),
    [
        ([0.0] * 99, 8, False),
        ([0.0] * 7 + [1.0] + [0.0] * 99, 16, True),
        ([0.5, 0.0, 0.5], 3, True),  # then nothing is proposed
        ([], 0, False),
    ],
)
def test_proposals_are_run_until_eight_in_a_row_fail(gains, made, has_gained):
    """A gain shows that the surrogate does not mislead; without one, the place is exhausted."""
    search = Hopping(gains)
    search._failed = 4
    with pytest.raises(StopIteration) as end:
        next(search._hops(0.01))
    assert end.value.value == has_gained
    assert search.made_hops == made
    assert search._failed == (0 if has_gained else 4)
    assert len(search._runs.exhausted) == (0 if has_gained else 1)


def test_no_proposal_is_run_where_the_surrogate_misleads():
    search = Hopping([1.0] * 9)
    search._by_value = True
    with pytest.raises(StopIteration) as end:
        next(search._hops(0.01))
    assert (end.value.value, search.made_hops) == (False, 0)


def test_steps_come_to_an_end():
    assert finish_of(Scripted([1.0] * 99)) == (False, "50 steps")


X = np.linspace(0.0, 1.0, 9)
TRUE = np.array([0.3, 0.8])


def curve_at(point: Any) -> Any:
    return np.column_stack((X, np.sin(3.0 * point[0] * X) + point[1] ** 2 * X))


class Known:
    """A ledger of a model of two parameters, which counts its runs."""

    has_slopes = False
    dimensions = 2
    negligible = 1e-9
    earlier_runs: Any = ()

    def __init__(self, fails: Callable[[Any], bool] = lambda point: False) -> None:
        self.objective = Objective(curve_at(TRUE), Criterion("area"))
        self.fails = fails
        self.asked: list[Any] = []

    def slopes(self, unit: Any) -> None:
        return None

    def show_activity(self) -> None:
        pass

    def run(self, point: Any) -> Evaluation:
        self.asked.append(np.array(point))
        if self.fails(point):
            return Evaluation(1, tuple(point), 1e6, failed=True, seconds=0.0, message="failed")
        curve = curve_at(point)
        value = self.objective.score(curve).value
        return Evaluation(1, tuple(point), value, False, 0.0, simulations=(curve,))

    def drive(self, part: Part[End | None]) -> End | None:
        answer: Any = None
        while True:
            try:
                points = part.send(answer)
            except StopIteration as end:
                found: End | None = end.value
                return found
            answer = [self.run(point) for point in points]


def runs_of(ledger: Any) -> Runs:
    return Runs(ledger, CurveSearch(ledger.objective, RULES.gain, ledger.show_activity))


def descent(runs: Runs, rules: Rules = RULES, **whose: bool) -> Descent:
    return Descent(np.random.default_rng(1), rules, runs, **{"is_independent": False, **whose})


def test_a_start_that_comes_to_where_another_was_takes_few_runs_of_its_own():
    ledger: Any = Known()
    runs = runs_of(ledger)
    first = ledger.drive(descent(runs).course(np.full(2, 0.5)))
    assert first.place == pytest.approx(TRUE, abs=2e-3)
    known = len(ledger.asked)
    second = ledger.drive(descent(runs).course(TRUE + 0.02))
    assert second.value <= 1.01 * first.value + 1e-4
    assert len(ledger.asked) - known <= known / 2


@pytest.mark.parametrize("is_independent", [True, False])
@pytest.mark.parametrize("is_shared", [True, False])
def test_what_others_have_found_far_away_does_not_lead_an_independent_start(
    is_independent, is_shared
):
    """If it did, starts would agree wherever the first of them has ended."""
    start = np.array([0.8, 0.3])
    alone, beside = Known(), Known()
    runs = [runs_of(alone), runs_of(beside)]
    beside.drive(descent(runs[1]).course(TRUE))
    known = len(beside.asked)
    whose = {"is_independent": is_independent, "is_shared": is_shared}
    parts = [descent(r, **whose).course(start) for r in runs]
    for ledger, part in zip((alone, beside), parts, strict=True):
        ledger.drive(part)
    first, second = np.array(alone.asked), np.array(beside.asked[known:])
    assert np.array_equal(first[:5], second[:5]) == (is_independent and not is_shared)


@pytest.mark.parametrize(("parameters", "is_own"), [(1, True), (2, True), (3, False)])
def test_starts_of_smooth_objectives_share_runs_unless_parameters_are_few(parameters, is_own):
    """One parameter has many minima if it is a frequency, and runs are few."""
    runs: Any = SimpleNamespace(
        inner=SimpleNamespace(is_smooth=True),
        points=np.array([[0.1] * parameters, [0.9] * parameters]),
        earlier=0,
    )
    start = Descent(np.random.default_rng(0), RULES, runs, is_independent=True)
    start._best = 0
    seen = start._seen(0.5)
    assert (seen is not None) == is_own
    assert seen is None or seen.tolist() == [0]


def test_runs_of_an_earlier_search_take_the_place_of_the_first_simplex():
    earlier: Any = Known()
    places = TRUE + 0.05 + np.array([(0.0, 0.08), (0.08, 0.0), (-0.08, 0.02), (0.02, -0.08)])
    ledger: Any = Known()
    ledger.earlier_runs = [(place, earlier.run(place)) for place in places]
    part = descent(runs_of(ledger)).course(TRUE + 0.05)
    assert next(part).shape == (1, 2)
    alone: Any = Known()
    part = descent(runs_of(alone)).course(TRUE + 0.05)
    assert next(part).shape == (3, 2)


def test_where_runs_fail_it_goes_on_and_looks_on_the_other_side():
    ledger: Any = Known(lambda point: bool(point[0] > 0.31))
    end = ledger.drive(descent(runs_of(ledger)).course(np.full(2, 0.25)))
    assert end.place == pytest.approx(TRUE, abs=5e-3)
    nothing: Any = Known(lambda point: True)
    assert nothing.drive(descent(runs_of(nothing)).course(np.full(2, 0.25))) is None


def test_steps_that_fail_again_and_again_go_on_by_the_value() -> None:
    search = Scripted([-1.0] * 7)
    radii = search.radii
    assert finish_of(search)[0]
    assert radii[5] == pytest.approx(RULES.first_radius / 2.0)  # trusted again after five
    assert search._by_value


@pytest.mark.parametrize("centre", [(0.5, 0.5), (0.0, 1.0), (0.01, 0.99), (1.0, 0.0)])
def test_a_simplex_has_a_whole_step_along_every_axis(centre):
    for seed in range(8):
        points = simplex_around(np.array(centre), 0.02, np.random.default_rng(seed))
        assert np.abs(points - centre) == pytest.approx(0.02 * np.eye(2))
        assert points.min() >= 0.0
        assert points.max() <= 1.0
