"""Slopes that a model knows take the place of runs: in the trust region and in the uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from curvewise.calibration import Below, Log, Tied, TrustRegion, identify
from curvewise.calibration.problem.space import Space
from curvewise.materials import ChabocheVoce, DrivenModel

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (200e3, 300.0, 60.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(91) / 30, range(4), (0.0, 0.02, -0.02, 0.02))
LOOP = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF)))
BOUNDS = {name: (0.4 * value, 2.2 * value) for name, value in MADE_OF.items()}
MODEL = MATERIAL.driven_by(LOOP)


@dataclass
class WithoutSlopes:
    """The same model, which says nothing of its slopes."""

    model: DrivenModel

    def __call__(self, parameters):
        return self.model(parameters)


@pytest.fixture(scope="module")
def found():
    return identify(MODEL, LOOP, BOUNDS, method=TrustRegion(starts=1), progress=False)


def test_the_trust_region_needs_no_runs_for_slopes(found) -> None:
    for name, value in MADE_OF.items():
        assert found.parameters[name] == pytest.approx(value, rel=5e-3), name
    blind = identify(
        WithoutSlopes(MODEL), LOOP, BOUNDS, method=TrustRegion(starts=1), progress=False
    )
    with_slopes, without = (int(np.argmax(one.history["value"] < 1e-3)) for one in (found, blind))
    assert 0 < 2 * with_slopes < without


def test_the_uncertainty_needs_no_runs_for_slopes(found) -> None:
    assert found.uncertainty_runs == 0
    assert found.uncertainty(sigma=1.0, samples=20).runs == 0


def test_known_slopes_give_the_errors_that_differences_give(found) -> None:
    problem = found.problem
    exact = found.uncertainty(sigma=1.0)
    blind = identify(
        WithoutSlopes(MODEL),
        LOOP,
        BOUNDS,
        start=found.parameters,
        method=TrustRegion(starts=1),
        progress=False,
    ).uncertainty(sigma=1.0)
    # Eight runs near the optimum of six parameters barely show the curvature in gamma1.
    for name in problem.space.names:
        assert exact.standard_errors[name] == pytest.approx(blind.standard_errors[name], rel=0.12)


SPACE = Space(
    {
        "plain": (-2.0, 5.0),
        "log": Log(1e-3, 1e4),
        "known": 7.0,
        "below log": Below("log", 1e-4, 20.0),
        "tied": Tied(lambda p: p["log"] - 3.0 * p["plain"] + p["known"]),
        "below below": Below("below log", 0.0, 3.0),
    }
)


@given(st.lists(st.floats(0.01, 0.99), min_size=4, max_size=4))
def test_parameters_move_as_their_rates_say(place) -> None:
    unit, step = np.array(place), 1e-7

    def at(moved) -> np.ndarray:
        return np.array(list(SPACE.dictionary(SPACE.point(moved)).values()))

    rates = SPACE.rates(unit)
    sides = []
    for sign in (-1.0, 1.0):
        moved = [at(unit + sign * step * axis) - at(unit) for axis in np.eye(4)]
        sides.append(np.column_stack(moved) / (sign * step))
    # Where what a parameter stays below begins to be less than its own bound, the two sides differ.
    scale = 1e-5 * np.abs(rates).max(axis=1, keepdims=True) + 1e-6
    near = [np.abs(rates - side) <= scale for side in sides]
    assert (near[0] | near[1]).all()
    free = [0, 1, 3, 5]
    np.testing.assert_array_equal(SPACE.differential(unit), rates[free])
    assert not rates[2].any()
