"""Tests of different kinds in one call, and parameters that are logarithmic, tied or ordered."""

from __future__ import annotations

from unittest.mock import Mock

import numpy as np
import pytest
from test_methods import BOUNDS, STRAIN, TRUE, material
from test_methods import model as cycle
from test_resuming import assert_same

from curvewise import datasets
from curvewise.calibration import (
    Below,
    Case,
    Criterion,
    Log,
    Objective,
    SimulationStore,
    Tied,
    identify,
)
from curvewise.calibration.objective.cases import Cases
from curvewise.calibration.problem.space import Space

TENSION = np.linspace(0.0, 0.1, 40)
QUIET = {"method": "trust-region", "progress": False}


def test_a_response_picks_among_curves_of_different_lengths():
    x = np.linspace(0.0, 1.0, 20)

    def both(p):
        return [np.column_stack((x, p["a"] * x)), np.column_stack((x[:7], p["b"] * x[:7]))]

    cases = [
        Case(f"curve {i}", both, curve, response=lambda curves, i=i: curves[i])
        for i, curve in enumerate(both({"a": 2.0, "b": 3.0}))
    ]
    found = identify(cases, bounds={"a": (0, 10), "b": (0, 10)}, **QUIET)
    assert (found.parameters["a"], found.parameters["b"]) == pytest.approx((2.0, 3.0), rel=1e-3)


def tension(parameters):
    return material(parameters, TENSION)


def strength(curve):
    return curve[:, 1].max()


def three_cases(cycle=cycle, tension=tension):
    return [
        Case("cycle", cycle, cycle(TRUE), measure="dtw", weight=2.0),
        Case("tension", tension, tension(TRUE), measure="sum_of_squares", sigma=4.0),
        Case("strength", tension, strength(tension(TRUE)), response=strength, sigma=8.0),
    ]


def test_a_cycle_a_tension_test_and_a_strength_in_one_call():
    counted = Mock(cycle, side_effect=cycle), Mock(tension, side_effect=tension)
    cases = three_cases(*counted)
    before = [one.call_count for one in counted]
    found = identify(cases, bounds=BOUNDS, **QUIET)
    after = [one.call_count for one in counted]
    assert np.subtract(after, before).tolist() == [found.evaluations] * 2
    for name, value in TRUE.items():
        assert found.parameters[name] == pytest.approx(value, rel=5e-3)
    assert list(found.measures) == ["cycle", "tension", "strength"]
    assert sum(found.measures.values()) == pytest.approx(found.value)
    assert found.measure == "dtw + sum_of_squares + area"
    assert "cycle" in str(found)
    assert len(found.plot().axes) == 4
    assert set(found.uncertainty(samples=20).standard_errors) == set(TRUE)


def test_terms_answer_for_their_objective():
    """What searches and records ask is the same question of cases as of loops."""
    by_name = Cases(three_cases()).objective()
    assert not by_name.has_function
    assert by_name.measures == ["dtw", "sum_of_squares", "area"]
    assert not by_name.is_least_squares
    assert by_name.titles == ["cycle", "tension", "strength"]
    assert by_name.sigmas == [None, 4.0, 8.0]
    assert [written["sigma"] for written in by_name.settings["cases"]] == by_name.sigmas
    of_function = Case("own", cycle, cycle(TRUE), measure=largest_difference)
    objective = Cases([*three_cases(), of_function]).objective()
    assert objective.has_function
    assert objective.measure == "dtw + sum_of_squares + area + largest_difference"
    others = [2.0 * curve for curve in by_name.experiments]
    assert by_name.of_other_tests(others)(others) == 0.0


def largest_difference(P, Q):
    return float(np.abs(P - Q).max())


def test_a_case_has_a_criterion_of_its_own():
    test, criterion = cycle(TRUE), Criterion("dtw", preset="raw", metric="cityblock")
    moved = test + np.array([0.0, 4.0])
    objective = Cases([Case("a", cycle, test, measure=criterion)]).objective()
    assert objective([moved]) == Objective(test, criterion)(moved)
    assert objective.preset == "raw"
    given = Criterion("dtw", failure_value=7.0)
    objective = Cases([Case("a", cycle, test, measure=given, weight=2.0)]).objective()
    assert objective([None]) == 14.0


NOISY = {"experiment": tension(TRUE) + np.array([0.0, 4.0]), "sigma": 4.0, "weight": 3.0}
STRONG = {"experiment": strength(tension(TRUE)) + 8.0, "response": strength}


@pytest.mark.parametrize(
    ("case", "expected", "rel"),
    [
        ({**NOISY, "measure": "area"}, 3.0, 1e-2),
        ({**NOISY, "measure": "dtw"}, 3.0, 1e-2),
        ({**NOISY, "measure": "sum_of_squares"}, 3.0 * 40.0, 1e-2),
        ({**STRONG, "sigma": 4.0}, 2.0, 1e-6),
        ({**STRONG, "sigma": 4.0, "measure": "sum_of_squares"}, 4.0, 1e-6),
        (STRONG, 8.0 / STRONG["experiment"], 1e-6),
    ],
)
def test_cases_count_in_units_of_their_noise(case, expected, rel):
    """A simulation that is off by sigma everywhere counts 1; squares n; a number its deviation."""
    case = Case("of its noise", tension, **case)
    found = identify([case], bounds=BOUNDS, start=TRUE, max_runs=1, **QUIET)
    assert found.value == pytest.approx(expected, rel=rel)


def test_a_case_that_fails_leaves_the_others():
    def fragile(parameters):
        if parameters["yield"] > 350.0:
            raise ArithmeticError("no convergence")
        return tension(parameters)

    found = identify(three_cases(tension=fragile), bounds=BOUNDS, method="sdrm", progress=False)
    assert found.failures
    for _, message in found.failures:
        assert "case 'tension': RuntimeError: ArithmeticError: no convergence" in message
        assert "cycle" not in message
    assert found.parameters["yield"] == pytest.approx(300.0, rel=1e-3)


def test_cases_in_a_store_run_once(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    keywords = {"bounds": BOUNDS, "store": store, "max_runs": 12, **QUIET}
    first = identify(three_cases(), **keywords)
    again = identify(three_cases(), **keywords)
    assert first.runs == 2 * first.evaluations  # two models
    assert again.runs == 0
    assert_same(first, again)
    other = [*three_cases()[:2], Case("strength", tension, 500.0, response=strength, sigma=1.0)]
    identify(other, **keywords)
    with store:
        one, two = store.searches().values()
    assert one.settings["cases"] != two.settings["cases"]


@pytest.mark.parametrize(
    ("cases", "message"),
    [
        ([Case("a", cycle, 1.0), Case("a", cycle, 2.0)], "two cases are called 'a'"),
        ([Case("a", cycle, np.ones((3, 2)), measure="magic")], "case 'a': unknown measure 'magic'"),
        ([Case("a", cycle, 1.0, weight=-1.0)], "case 'a': weight is -1.0"),
        ([Case("a", cycle, 1.0, sigma=0.0)], "case 'a': sigma is 0.0"),
        ([Case("a", cycle, np.inf)], "case 'a': the experiment is inf"),
        ([Case("a", cycle, 1.0)], "its experiment is a number; give the case a response"),
        ([Case("a", cycle, 1.0, measure=Criterion(weights=[1]))], "case 'a': its Criterion has"),
        (
            [Case("a", lambda p: [cycle(p)] * 2, cycle(TRUE))],
            "case 'a': the model returned 2 curves; give a response",
        ),
    ],
)
def test_cases_that_are_wrong(cases, message):
    with pytest.raises(ValueError, match=message):
        identify(cases, bounds=BOUNDS, **QUIET)


def test_what_belongs_to_a_case_is_not_given_beside_it():
    with pytest.raises(
        ValueError, match="measure given together with cases; give them to each Case"
    ):
        identify(three_cases(), measure=Criterion(weights=[1, 2, 3]), bounds=BOUNDS, **QUIET)
    with pytest.raises(
        ValueError, match="window given together with cases; give them to each Case"
    ):
        identify(three_cases(), window=3, bounds=BOUNDS, **QUIET)
    with pytest.raises(TypeError, match="identify needs bounds"):
        identify(three_cases())


# Parameters.


def relaxation(parameters):
    """Maxwell's model: the stress at constant strain, over six decades of time."""
    time = np.linspace(-2.0, 4.0, 60)
    stress = np.exp(-(10.0**time) * 100.0 / parameters["viscosity"])
    return np.column_stack((time, stress))


@pytest.mark.parametrize("viscosity", [3e0, 2e3, 4e5])
@pytest.mark.nightly("2000")
def test_a_viscosity_over_six_decades(viscosity):
    found = identify(
        relaxation, relaxation({"viscosity": viscosity}), {"viscosity": Log(1.0, 1e6)}, **QUIET
    )
    assert found.parameters["viscosity"] == pytest.approx(viscosity, rel=0.01)
    assert found.evaluations <= 100


def two_backstresses(parameters):
    stress = datasets.kinematic_hardening(
        STRAIN,
        youngs_modulus=parameters["E"],
        backstresses=((parameters["C1"], parameters["gamma1"]), (parameters["C2"], 20.0)),
    )
    return np.column_stack((STRAIN, stress))


@pytest.mark.parametrize("method", ["trust-region", "sdrm"])
def test_ordered_fixed_and_tied_parameters(method):
    """C1 > C2 at every run, E unchanged, gamma1 from C1."""
    runs = []

    def model(parameters):
        runs.append(parameters)
        return two_backstresses(parameters)

    bounds = {
        "E": 200e3,
        "C1": (1e3, 200e3),
        "C2": Below("C1", 1e3, 200e3),
        "gamma1": Tied(lambda p: p["C1"] / 200.0),
    }
    truth = {"E": 200e3, "C1": 80e3, "C2": 5e3, "gamma1": 400.0}
    keywords = {"measure": "dtw", "method": method, "progress": False}
    found = identify(model, two_backstresses(truth), bounds, **keywords)
    assert all(run["C1"] > run["C2"] for run in runs)
    assert all(run["E"] == 200e3 and run["gamma1"] == run["C1"] / 200.0 for run in runs)
    assert found.parameters == pytest.approx(truth, rel=0.01)
    assert list(found.parameters) == list(bounds)
    assert found.history.dtype.names[1:3] == ("C1", "C2")
    lines = {line.split()[0]: line for line in str(found).splitlines() if line}
    assert lines["E"].endswith("fixed")
    assert lines["gamma1"].endswith("tied")
    found.uncertainty(samples=20)


def test_a_parameter_stays_below_by_a_millionth_of_its_range():
    space = Space({"a": (100.0, 200.0), "b": Below("a", 50.0, 200.0)})
    for unit in (0.0, 0.3, 1.0):
        above, below = space.point(np.array([unit, 1.0]))
        assert above - below == pytest.approx(150e-6, rel=1e-6)


def test_a_parameter_at_the_one_that_it_stays_below_may_be_looked_up():
    space = Space({"CB": (99.78, 794.8), "Y": Below("CB", 3.326, 399.1)})
    for above in np.random.default_rng(0).random(200):  # an eighth of them were a rounding too high
        point = space.point(np.array([above, 1.0]))
        unit = space.unit_of(dict(zip(space.names, point, strict=True)))
        assert unit == pytest.approx([above, 1.0])


def test_places_between_bounds_are_those_of_the_search():
    space = Space({"a": (100.0, 200.0), "b": Below("a", 50.0, 200.0), "c": Log(1e-2, 1e4)})
    parameters = {"a": 150.0, "b": 150.0 - 150e-6, "c": 5.0}
    assert space.place("a", 150.0) == 0.5
    assert space.place("b", 125.0) == 0.5
    assert space.place("b", 100.0, parameters) == pytest.approx(0.5, abs=1e-6)
    assert space.place("c", 10.0) == pytest.approx(0.5)
    assert space.place("c", 0.0) == -np.inf
    assert space.place("a", 210.0) == 1.1
    assert space.at_bounds(parameters) == {"b": "upper"}
    assert space.at_bounds({"a": 100.05, "b": 80.0, "c": 9.95e3}) == {"a": "lower", "c": "upper"}
    assert space.at_limits(parameters) == ("b",)  # it cannot pass a
    assert space.at_limits({"a": 100.05, "b": 80.0, "c": 9.95e3}) == ()


def test_a_bound_of_zero_is_a_limit():
    space = Space({"rate": (0.0, 1.0), "softening": (-1.0, 0.0), "b": (-1.0, 1.0)})
    assert space.at_limits({"rate": 0.0, "softening": 0.0, "b": 0.0}) == ("rate", "softening")
    assert space.at_limits({"rate": 1.0, "softening": -1.0, "b": 1.0}) == ()
    assert space.open_ends("rate", (0.0, 1.0), {}) == (False, True)
    assert space.open_ends("softening", (-1.0, 0.0), {}) == (True, False)
    assert space.open_ends("b", (-0.9, 1.1), {}) == (False, False)  # of the linear theory


def test_a_start_among_ordered_and_logarithmic_parameters():
    bounds = {"C1": Log(1e3, 200e3), "C2": Below("C1", 1e3, 50e3), "E": (2e5, 2e5)}
    start = {"C1": 2e4, "C2": 3e3}

    def model(parameters):
        return two_backstresses({**parameters, "gamma1": 100.0})

    keywords = {"bounds": bounds, "max_runs": 1, **QUIET}
    found = identify(model, model({**start, "E": 2e5}), start=start, **keywords)
    assert found.parameters == pytest.approx({**start, "E": 2e5}, rel=1e-12)
    with pytest.raises(ValueError, match=r"start\['C2'\] is 30000.0; it must be below C1"):
        identify(model, model({**start, "E": 2e5}), start={"C1": 2e4, "C2": 3e4}, **keywords)


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        ({"a": Log(0.0, 1.0)}, "a logarithm needs low above 0"),
        ({"a": Log(1.0, 1.0)}, "low < high"),
        (
            {"a": Below("b", 0.0, 1.0), "b": (0.0, 1.0)},
            "a stays below 'b', which is not a parameter",
        ),
        ({"b": (0.0, 1.0), "a": Below("b", 2.0, 3.0)}, "a cannot stay below b within their bounds"),
        ({"a": 1.0}, "every parameter is fixed"),
    ],
)
def test_bounds_that_are_wrong(bounds, message):
    with pytest.raises(ValueError, match=message):
        identify(cycle, cycle(TRUE), bounds, **QUIET)
