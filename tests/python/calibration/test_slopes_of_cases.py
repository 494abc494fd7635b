"""Derivatives of several models and of some curves of one: cases, and folds of a validation."""

from __future__ import annotations

from dataclasses import dataclass
from unittest.mock import Mock

import numpy as np
import pytest
from test_known_slopes import BOUNDS, LOOP, MADE_OF, MATERIAL, MODEL, WithoutSlopes

from curvewise.calibration import (
    Case,
    Criterion,
    LeastSquares,
    Log,
    TrustRegion,
    cross_validate,
    identify,
)
from curvewise.calibration.models.forward import Selection, SingleModel
from curvewise.calibration.objective.cases import Cases
from curvewise.calibration.objective.objective import Objective
from curvewise.calibration.problem.problem import Problem
from curvewise.calibration.problem.space import Space

STRAIN = np.interp(np.arange(61) / 20, range(4), (0.0, 0.01, -0.015, 0.02))
SECOND = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF)))
TESTS = [LOOP, SECOND]
ALONE = MATERIAL.driven_by(SECOND)
BOTH = MATERIAL.driven_by(TESTS)
SQUARES = Criterion("sum_of_squares", abscissa="points")
QUIET = {"bounds": BOUNDS, "progress": False}
WAYS = [
    pytest.param(SQUARES, LeastSquares(), id="squares"),
    pytest.param(Criterion("area"), TrustRegion(starts=1), id="area"),
]


@dataclass
class Power:
    """K x ** n, whose `jacobian` is what a test makes of it."""

    derivatives: object = None
    points: int = 30

    def __call__(self, p):
        x = np.linspace(0.01, 1.0, self.points)
        return np.column_stack((x, p["K"] * x ** p["n"]))

    def jacobian(self, p):
        if callable(self.derivatives):
            return self.derivatives(p)
        x, y = self(p).T
        by_parameter = np.column_stack((y / p["K"], y * np.log(x)))
        return np.stack((np.zeros_like(by_parameter), by_parameter), axis=1)


TRUE = {"K": 2.0, "n": 0.4}
RANGES = {"K": (0.5, 5.0), "n": Log(0.1, 2.0)}
TEST = Power()(TRUE)


def largest(curve):
    return curve[:, 1].max()


def strain_of_largest(curve):
    """A step function of the parameters."""
    return curve[np.argmax(curve[:, 1]), 0]


@pytest.mark.parametrize(("criterion", "method"), WAYS)
def test_two_cases_take_the_runs_of_one_model_of_both_tests(criterion, method) -> None:
    counted = [Mock(one, side_effect=one, jacobian=one.jacobian) for one in (MODEL, ALONE)]
    cases = [
        Case(name, model, test, measure=criterion)
        for name, model, test in zip("ab", counted, TESTS, strict=True)
    ]
    one = identify(BOTH, TESTS, measure=criterion, method=method, max_runs=12, **QUIET)
    two = identify(cases, method=method, max_runs=12, **QUIET)
    for name in ("E", "yield", "value"):
        assert np.array_equal(two.history[name], one.history[name])
    assert [model.call_count for model in counted] == [one.evaluations] * 2


def test_cases_with_derivatives_take_fewer_runs_and_have_the_intervals_of_one_model() -> None:
    one = identify(BOTH, TESTS, measure=SQUARES, **QUIET)
    cases = [Case("a", MODEL, LOOP, measure=SQUARES), Case("b", ALONE, SECOND, measure=SQUARES)]
    two = identify(cases, **QUIET)
    assert two.uncertainty().intervals == one.uncertainty().intervals
    blind = Case("b", WithoutSlopes(ALONE), SECOND, measure=SQUARES)
    more = identify([cases[0], blind], **QUIET)
    assert not more.problem.has_slopes
    assert more.evaluations > 1.3 * two.evaluations


def test_cases_that_pick_a_curve_each_take_the_runs_of_the_whole() -> None:
    cases = [
        Case("a", BOTH, LOOP, measure=SQUARES, response=lambda curves: curves[0]),
        Case("b", BOTH, SECOND, measure=SQUARES, response=lambda curves: curves[1]),
    ]
    whole = identify(BOTH, TESTS, measure=SQUARES, **QUIET)
    picked = identify(cases, **QUIET)
    assert picked.evaluations == whole.evaluations
    for name, value in MADE_OF.items():
        assert picked.parameters[name] == pytest.approx(value, rel=1e-4)


def test_folds_use_the_derivatives_of_the_curves_that_they_keep() -> None:
    checked = cross_validate(BOTH, TESTS, BOUNDS, measure=SQUARES, progress=False)
    for fold, model, test in zip(checked.folds, (ALONE, MODEL), (SECOND, LOOP), strict=True):
        alone = identify(model, test, measure=SQUARES, **QUIET)
        assert fold.identification.evaluations == alone.evaluations
        assert np.array_equal(fold.identification.history["value"], alone.history["value"])


def slopes_of(cases, unit=(0.3, 0.6)):
    forward = Cases(cases)
    return Problem(forward.objective(), Space(RANGES), forward).slopes(np.array(unit))


@pytest.mark.parametrize(
    "response",
    [
        largest,
        lambda curve: curve[::-3],
        lambda curve: np.column_stack((curve[:, 0] ** 2, np.sin(curve[:, 1]))),
        lambda curve: np.trapezoid(curve[:, 1], curve[:, 0]),
    ],
)
def test_derivatives_go_through_a_response(response) -> None:
    """They are the derivatives of the compared curves by the place between the bounds."""
    space, unit, step = Space(RANGES), np.array([0.3, 0.6]), 1e-6
    reference = response(Power()(TRUE))
    (found,) = slopes_of([Case("a", Power(), reference, response=response)])

    def at(place):
        return np.atleast_2d(response(Power()(space.dictionary(space.point(place)))))

    expected = [(at(unit + e) - at(unit - e)) / (2 * step) for e in step * np.eye(2)]
    np.testing.assert_allclose(found, np.stack(expected, axis=-1), rtol=1e-6, atol=1e-7)


def test_a_response_that_does_not_move_has_derivatives_of_0() -> None:
    case = Case("a", Power(), TEST[:, :1], response=lambda curve: curve[:, :1], measure="dtw")
    (found,) = slopes_of([case])
    assert found.shape == (30, 1, 2)
    assert not found.any()


def shortened(curve):
    return curve[: int(1e7 * curve[-1, 1]) % 7 + 2]


def refusing(curve):
    raise ArithmeticError


@pytest.mark.parametrize(
    "case",
    [
        Case("steps", Power(), 0.9, response=strain_of_largest),
        Case("number of points", Power(), TEST, response=shortened),
        Case("error", Power(), TEST, response=refusing),
        Case("nothing", Power(), TEST, response=lambda curve: None),
        Case("no jacobian here", Power(lambda p: None), TEST),
        Case("other points", Power(Power(points=31).jacobian), TEST, response=largest),
    ],
    ids=lambda case: case.name,
)
def test_what_has_no_derivatives_takes_them_from_all_cases(case) -> None:
    assert slopes_of([Case("smooth", Power(), TEST)]) is not None
    if case.name == "steps":  # its highest point moves where the curve falls
        falling = Power(lambda p: -40.0 * Power().jacobian(p))
        case = Case("steps", falling, 0.9, response=strain_of_largest)
    assert slopes_of([Case("smooth", Power(), TEST), case]) is None


def test_a_jacobian_of_another_shape_is_refused_in_cases_too() -> None:
    case = Case("a", Power(lambda p: np.zeros((30, 2, 3))), TEST)
    with pytest.raises(ValueError, match=r"shapes \[\(30, 2, 3\)\]; .* of 1 curves, .*, 2\)"):
        slopes_of([case])
    with pytest.raises(ValueError, match="not finite"):
        slopes_of([Case("a", Power(lambda p: np.full((30, 2, 2), np.nan)), TEST)])
    whole = Selection(Power(lambda p: [np.zeros((30, 2, 2))]), (1,), 2)
    problem = Problem(Objective(TEST), Space(RANGES), whole)
    with pytest.raises(ValueError, match="an array for each of 2 curves"):
        problem.slopes(np.array([0.5, 0.5]))


@pytest.mark.parametrize("measure", ["sum_of_squares", "area"])
def test_where_a_model_knows_no_derivatives_runs_take_their_place(measure) -> None:
    """From there on: a search that trusts the others alone ends too high."""

    def in_part(p):
        return Power().jacobian(p) if p["n"] > 0.6 else None

    calls = []

    def counted(p):
        calls.append(p)
        return in_part(p)

    start = {"K": 1.0, "n": 1.5}
    found = identify(
        Power(counted), TEST, RANGES, measure=measure, start=start, max_runs=80, progress=False
    )
    known = identify(Power(), TEST, RANGES, measure=measure, start=start, progress=False)
    assert len(calls) > 1
    assert known.evaluations < found.evaluations < 80
    assert found.converged
    for name, value in TRUE.items():
        assert found.parameters[name] == pytest.approx(value, rel=1e-2)


def test_an_optimum_without_derivatives_says_how_many_runs_they_take() -> None:
    model = Power(lambda p: None)
    found = identify(model, TEST, RANGES, method="nelder-mead", max_runs=20, progress=False)
    assert found.problem.has_slopes
    assert found.uncertainty_runs == 4
    assert found.uncertainty().runs == 4
    known = identify(Power(), TEST, RANGES, method="nelder-mead", max_runs=20, progress=False)
    assert known.uncertainty_runs == 0


def test_a_model_that_runs_elsewhere_has_no_derivatives() -> None:
    problem = Problem.of(TEST, RANGES)
    assert not problem.has_slopes
    assert problem.slopes(np.array([0.5, 0.5])) is None
    assert Problem(problem.objective, problem.space, SingleModel(Power(), 1)).has_slopes
