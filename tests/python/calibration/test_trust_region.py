"""The trust region without a model: how the region grows and shrinks, and what slopes come from."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration.methods.descent import Descent, Rules, SharedResponses
from curvewise.calibration.methods.side_by_side import Part
from curvewise.calibration.methods.starts import simplex_around
from curvewise.calibration.problem.ledger import Finish
from curvewise.calibration.records.evaluation import Evaluation

REACH = 0.8  # of the region, by every step
RULES = Rules(0.2, diff_step=0.02, tol=1e-3, gain=1e-3, maxiter=50, always_fresh=False)


class Scripted(Descent):
    """A search whose surfaces promise a gain of 1 each time, and whose runs gain what is listed."""

    centre = np.zeros(2)  # type: ignore[assignment]

    def __init__(
        self,
        gains: Sequence[float],
        rules: Rules = RULES,
        *,
        is_fresh: bool = False,
        valleys: int = 0,
        known: bool = False,
    ) -> None:
        ledger: Any = SimpleNamespace(negligible=0.0)
        super().__init__(ledger, np.random.default_rng(1), rules, SharedResponses())
        self.gains = list(gains)
        self.value = 10.0
        self.known = known
        self.is_fresh = is_fresh
        self.valleys = valleys
        self.looked: list[tuple[float, bool]] = []  # in which regions, with fresh slopes or not

    def lowest(self, radius: float) -> tuple[Any, float]:
        self.looked.append((pytest.approx(radius), self.is_fresh))
        return np.array([0.1 * radius, -REACH * radius]), 1.0 if self.gains else 0.0

    def step(self, candidate: Any) -> Part[float]:
        yield from ()
        self.is_fresh = False
        self._seen.add(0 if self.known else len(self._seen))
        return self.gains.pop(0)

    def renew(self, radius: float) -> Part[None]:
        yield from ()
        self.is_fresh = True

    def leaves_valley(self, radius: float, least: float) -> Part[bool]:
        yield from ()
        self.valleys -= 1
        self.is_fresh = False
        return self.valleys >= 0


def finish_of(search: Scripted) -> Finish:
    with pytest.raises(StopIteration) as end:
        next(search.descend())
    finish: Finish = end.value.value
    return finish


def descended(search: Scripted) -> list[tuple[float, bool]]:
    """Return in which regions a search looked for minima, and whether with fresh slopes."""
    finish = finish_of(search)
    assert finish.converged
    assert not search.gains
    return search.looked


@pytest.mark.parametrize(
    ("is_fresh", "gain", "factor", "is_renewed"),
    [
        (False, 1.0, 2.0 * REACH, False),
        (False, 0.7, 2.0 * REACH, False),
        (False, 0.69, 1.0, True),
        (False, 0.09, 1.0, True),
        (False, -np.inf, 1.0, True),
        (True, 0.7, 2.0 * REACH, False),
        (True, 0.69, 1.0, False),
        (True, 0.1, 1.0, False),
        (True, 0.09, 0.5 * REACH, False),
        (True, -3.0, 0.5 * REACH, False),
        (True, -np.inf, 0.5 * REACH, False),
    ],
)
def test_the_region_follows_how_well_gains_are_predicted(is_fresh, gain, factor, is_renewed):
    """Slopes that mislead are measured afresh; only fresh ones that mislead shrink the region."""
    looked = descended(Scripted([gain], is_fresh=is_fresh))
    assert looked[:2] == [(0.2, is_fresh), (0.2 * factor, is_renewed)]


def test_fresh_slopes_before_every_step():
    looked = descended(Scripted([1.0, 0.5, 0.05], replace(RULES, always_fresh=True)))
    assert looked == [(0.2, False), (0.32, True), (0.32, True), (0.128, True)]


def test_the_region_is_never_more_than_the_bounds():
    looked = descended(Scripted([1.0, 1.0], replace(RULES, first_radius=0.6)))
    assert [radius for radius, _ in looked[:3]] == [0.6, 0.96, 1.0]


def test_a_region_below_tol_has_its_slopes_renewed():
    search = Scripted([-1.0, -1.0, -1.0], replace(RULES, tol=0.1))
    finish = finish_of(search)
    assert [radius for radius, _ in search.looked] == [0.2, 0.2, 0.08, 0.15, 0.06, 0.15]
    assert finish == (
        True,
        "fresh slopes promise to gain less than 0.01 within 15 % of the bounds' range",
    )


def test_a_search_that_leaves_a_valley_goes_on():
    search = Scripted([], is_fresh=True, valleys=1)
    assert descended(search) == [(0.2, True), (0.2, False), (0.2, True)]
    assert search.valleys == -1


def test_a_search_that_only_meets_known_runs_ends():
    """Where slopes are of noise alone, each step may lead to where the search has been."""
    search = Scripted([-1.0] * 200, replace(RULES, maxiter=200), known=True)
    finish = finish_of(search)
    assert finish == (False, "30 steps in a row led only to runs that were known")
    assert len(search.looked) == 31


SLOPES = np.array([[3.0, 0.0], [-1.0, 2.0], [0.0, 0.5], [4.0, -4.0]])  # of two points' coordinates


def run_at(point: Any, wrong: float = 0.0) -> Evaluation:
    curve = (SLOPES @ point + wrong).reshape(2, 2)
    return Evaluation(1, tuple(point), 1.0, failed=False, seconds=0.0, simulations=(curve,))


class Known:
    """Evaluations, of which some are known around a point."""

    has_slopes = False

    def slopes(self, unit):
        return None

    def __init__(self, unit: Any, steps: Any, wrong: Sequence[float]) -> None:
        points = unit + np.array(steps)
        self.earlier_runs = [(p, run_at(p, error)) for p, error in zip(points, wrong, strict=True)]
        self.run = 0

    def drive(self, part: Part[bool]) -> None:
        runs = None
        with suppress(StopIteration):
            while True:
                points = part.send(runs)  # type: ignore[arg-type]  # None begins a generator
                self.run += len(points)
                runs = [run_at(point) for point in points]


@pytest.mark.parametrize("wrong", [0.0, 0.5])
def test_slopes_come_from_earlier_runs_the_nearest_first(wrong):
    """Two that are further away differ from the others; they count by 1 / (distance + 0.02)^2."""
    steps = [(0.02, 0.0), (-0.02, 0.0), (0.0, 0.02), (0.1, 0.0), (-0.1, 0.0)]
    start = np.array([0.4, 0.3])
    known: Any = Known(start, steps, [0.0, 0.0, 0.0, wrong, -wrong])
    search = Descent(known, np.random.default_rng(1), RULES, SharedResponses())
    known.drive(search.begin(start, known.earlier_runs))
    assert known.run == 1
    np.testing.assert_array_equal(search.centre, [0.4, 0.3])
    near, far = 1.0 / 0.04**2, 1.0 / 0.12**2
    steeper = far * 0.1 * wrong / (near * 0.02**2 + far * 0.1**2)
    assert search._surfaces.slopes == pytest.approx(np.add(SLOPES, (steeper, 0.0)), abs=1e-9)


@pytest.mark.parametrize("centre", [(0.5, 0.5), (0.0, 1.0), (0.01, 0.99), (1.0, 0.0)])
def test_a_simplex_has_a_whole_step_along_every_axis(centre):
    for seed in range(8):
        points = simplex_around(np.array(centre), 0.02, np.random.default_rng(seed))
        assert np.abs(points - centre) == pytest.approx(0.02 * np.eye(2))
        assert points.min() >= 0.0
        assert points.max() <= 1.0
