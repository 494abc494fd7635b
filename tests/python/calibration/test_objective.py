"""Objectives: values, weights, presets, and what becomes of failed simulations."""

from __future__ import annotations

import dataclasses
import math
import pickle

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise.calibration import MEASURES, Criterion, Objective

EXPERIMENT, SIMULATION = curvewise.datasets.hysteresis_pair()
BRANCH = EXPERIMENT[:60]  # the first loading: x does not turn back
OTHER = SIMULATION[:120] * [1.0, 1.1]
FIVE = [name for name in MEASURES if name != "sum_of_squares"]


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
@pytest.mark.parametrize("measure", FIVE)
def test_value_is_that_of_compare(measure, preset):
    compared = curvewise.compare(EXPERIMENT, SIMULATION, preset=preset, measures=[measure])
    expected = compared[measure]
    objective = Objective(EXPERIMENT, Criterion(measure, preset=preset))
    assert objective(SIMULATION) == expected
    assert objective([SIMULATION]) == expected
    assert objective.failures == 0


@pytest.mark.parametrize("measure", FIVE)
def test_weighted_sum_over_loops(measure):
    loops = [EXPERIMENT, EXPERIMENT[:150]]
    objective = Objective(loops, Criterion(measure, weights=[2.0, 0.5]))
    terms = objective.terms([SIMULATION, OTHER])
    expected = [
        curvewise.compare(P, Q, measures=[measure])[measure]
        for P, Q in zip(loops, [SIMULATION, OTHER], strict=True)
    ]
    assert terms.tolist() == expected
    assert objective([SIMULATION, OTHER]) == 2.0 * terms[0] + 0.5 * terms[1]


def with_gaps(curve, rows):
    given = curve.copy()
    given[rows, [0, 1, 1]] = np.nan
    return given


@pytest.mark.parametrize("measure", [*FIVE, "sum_of_squares"])
def test_gaps_of_experiments_are_left_out(measure):
    rows = [3, 17, 40]
    simulation = BRANCH * [1.0, 1.1]
    given, kept = with_gaps(BRANCH, rows), np.delete(BRANCH, rows, axis=0)
    with pytest.raises(ValueError, match=r"^P\[3, 0\] is nan"):
        Objective(given, measure)
    with pytest.warns(UserWarning, match=r"^P: 3 of 60 points left out, nan; .* is point 3$"):
        objective = Objective(given, Criterion(measure, missing="skip"))
    plain = Objective(kept, measure)
    np.testing.assert_array_equal(objective.experiments[0], kept)
    assert objective(simulation) == plain(simulation)
    assert objective.scales == plain.scales
    assert objective(with_gaps(simulation, rows)) == objective.failure_value[0]
    assert objective.failures == 1
    with pytest.warns(UserWarning, match=r"^experiments\[1\]: 3 of 60 points left out"):
        two = Objective([BRANCH, given], Criterion(measure, missing="skip"))
    assert two([simulation] * 2) == Objective([BRANCH, kept], measure)([simulation] * 2)


def test_an_unknown_treatment_of_gaps():
    with pytest.raises(ValueError, match="unknown missing 'drop'; choose from refuse, skip"):
        Criterion("area", missing="drop")
    criterion = Criterion("area", missing="skip")
    assert criterion == Criterion(**criterion.settings)
    assert repr(criterion) == "Criterion('area', missing='skip')"
    assert criterion.weighing([2.0]).missing == "skip"
    found = r"use measure=Criterion\('area', missing=\.\.\.\)"
    with pytest.raises(TypeError, match=found):
        Objective(BRANCH, "area", missing="skip")


def test_options_override_those_of_the_preset():
    objective = Objective(EXPERIMENT, Criterion("dtw", preset="paper", step_pattern="symmetric1"))
    assert objective(SIMULATION) == curvewise.compare(EXPERIMENT, SIMULATION)["dtw"]
    objective = Objective(EXPERIMENT, Criterion("area", preset="paper", crossing="split"))
    expected = curvewise.area(EXPERIMENT, SIMULATION, spacing="x", crossing="split")
    assert objective(SIMULATION) == expected


def test_sum_of_squares_interpolates_at_the_experiments_x():
    P = np.array([(0.0, 0.0), (1.0, 1.0), (2.0, 4.0)])
    Q = np.array([(0.0, 1.0), (2.0, 5.0)])
    assert Objective(P, Criterion("sum_of_squares", preset="raw"))(Q) == 1.0 + 4.0 + 1.0
    assert Objective(P, "sum_of_squares")(Q) == 6.0 / 16.0  # scaled by the extent in y
    assert Objective(P[::-1], Criterion("sum_of_squares", preset="raw"))(Q) == 6.0
    assert Objective(P, Criterion("sum_of_squares", preset="raw"))(Q[::-1]) == 6.0


@pytest.mark.parametrize(
    ("simulation", "reason"),
    [
        ([(0.0, 0.0), (1.0, 0.0)], "covers x from 0 to 1"),
        ([(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)], "reverses"),
        ([(0.0, 0.0), (2.0, math.nan)], "not finite"),
    ],
)
def test_sum_of_squares_does_not_make_up_what_was_not_simulated(simulation, reason):
    objective = Objective([(0, 0), (1, 1), (2, 4)], Criterion("sum_of_squares", preset="raw"))
    (message,) = objective.score(np.array(simulation)).failures
    assert reason in message
    assert objective(simulation) == objective.failure_value[0]


FAILED = {
    "none": None,
    "exception": RuntimeError("died"),
    "nan": np.array([(0.0, 0.0), (1.0, math.nan)]),
    "inf": np.array([(0.0, 0.0), (math.inf, 1.0)]),
    "one point": np.zeros((1, 2)),
    "empty": np.empty((0, 2)),
    "empty list": [],
    "complex": np.array([(0.0, 0.0), (1.0, 1j)]),
}


@pytest.mark.parametrize("measure", ["area", "pcm", "curve_length"])
@pytest.mark.parametrize("name", FAILED)
def test_failed_simulation_has_a_finite_penalty_and_is_counted(name, measure):
    objective = Objective(EXPERIMENT, measure)
    value = objective(FAILED[name])
    assert value == objective.failure_value[0]
    assert math.isfinite(value)
    assert objective.failures == 1
    assert value > 1e4 * objective(OTHER)  # a bad simulation is better than a failed one


@pytest.mark.parametrize("measure", FIVE)
def test_one_failed_loop_of_two(measure):
    objective = Objective([EXPERIMENT, EXPERIMENT], Criterion(measure, weights=[1.0, 3.0]))
    terms, failures = objective.score([SIMULATION, None])[1:]
    assert terms[0] == Objective(EXPERIMENT, measure)(SIMULATION)
    assert terms[1] == objective.failure_value[1]
    assert failures == ("loop 1: no simulation",)
    assert objective.failures == 1
    objective(None)
    objective(RuntimeError("both"))
    assert objective.failures == 1 + 2 + 2


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("preset", ["scaled", "raw"])
def test_penalty_grows_with_the_units(measure, preset):
    small, large = (
        Objective(BRANCH * [1.0, factor], Criterion(measure, preset=preset)).failure_value[0]
        for factor in (1.0, 1e3)
    )
    without_units = ("pcm", "curve_length", "edr", "lcss")  # scaled, or shares of the points
    grows = preset == "raw" and measure not in without_units
    assert (large > 100 * small) if grows else large == pytest.approx(small)


def test_penalty_can_be_given():
    objective = Objective([EXPERIMENT, EXPERIMENT], Criterion(failure_value=7.0, weights=[1, 2]))
    assert objective(None) == 21.0


def test_pcm_needs_coverage():
    objective = Objective(EXPERIMENT, Criterion("pcm", min_coverage=0.5))
    died_early = EXPERIMENT[:60]  # follows the experiment to the point, then ends
    assert curvewise.pcm(EXPERIMENT, died_early) < 0.02
    assert objective(died_early) == objective.failure_value[0]
    assert "min_coverage is 0.5" in objective.score(died_early).failures[0]
    assert Objective(EXPERIMENT, Criterion("pcm", min_coverage=0.0))(died_early) < 0.02


def test_pcm_of_a_piece_of_an_experiment_passes():
    objective = Objective(EXPERIMENT[100:140], Criterion("pcm", min_coverage=0.9))
    assert objective(EXPERIMENT) < 0.1
    assert objective.failures == 0


@pytest.mark.parametrize(
    ("experiments", "count"),
    [
        ([(0, 0), (1, 1)], 1),
        (((0, 0), (1, 1)), 1),
        ([np.array([0.0, 0.0]), np.array([1.0, 1.0])], 1),
        (np.zeros((3, 4, 2)) + np.arange(4)[:, np.newaxis], 3),
        ([[(0, 0), (1, 1)], [(0, 0), (1, 2)]], 2),
        ([EXPERIMENT, BRANCH], 2),
        (pd.DataFrame(EXPERIMENT, columns=["strain", "stress"]), 1),
        ([pd.DataFrame(EXPERIMENT), BRANCH], 2),
    ],
)
def test_one_curve_or_several(experiments, count):
    objective = Objective(experiments, "dtw")
    assert len(objective.experiments) == count
    assert objective(list(objective.experiments)) == 0.0


def test_experiment_is_copied():
    curve = EXPERIMENT.copy()
    objective = Objective(curve)
    before = objective(SIMULATION)
    curve[:] = 0.0
    assert objective(SIMULATION) == before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([(0, 0), (1, math.nan)],), r"P\[1, 1\] is nan"),
        (([EXPERIMENT, [(0, 0), (1, math.inf)]],), r"experiments\[1\], as P: P\[1, 1\] is inf"),
        (([(0, 0)],), r"P has shape \(1, 2\); area needs at least 2 points"),
        ((np.empty((0, 2)),), r"P has shape \(0, 2\)"),
        ((np.zeros((4, 3)),), r"\(4, 3\)"),
        ((EXPERIMENT, "sum_of_squares"), "x of P reverses"),
        ((EXPERIMENT, "shape"), "unknown measure 'shape'; choose from area, pcm"),
    ],
)
def test_wrong_experiments_and_measures_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        Objective(*arguments)


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"preset": "nice"}, "unknown preset 'nice'; choose from scaled, paper, raw"),
        ({"weights": [1, 2]}, r"weights has shape \(2,\); give one for each of 1 loops"),
        ({"weights": [-1]}, "not negative"),
        ({"failure_value": math.inf}, "finite and above 0"),
        ({"min_coverage": 2}, "from 0 to 1"),
        ({"spacing": "wide"}, "spacing"),
    ],
)
def test_wrong_options_are_refused(keywords, message):
    with pytest.raises(ValueError, match=message):
        Objective(EXPERIMENT, Criterion("area", **keywords))


def test_an_option_that_the_measure_lacks_is_refused():
    with pytest.raises(TypeError, match="window"):
        Objective(EXPERIMENT, "area", window=3)
    with pytest.raises(TypeError, match="sum_of_squares has no option 'window'; it has abscissa"):
        Objective(BRANCH, "sum_of_squares", window=3)


@pytest.mark.parametrize(
    ("simulations", "error", "message"),
    [
        ([SIMULATION] * 3, ValueError, "there are 3 simulations and 2 experiments"),
        ([np.zeros((5, 3)), SIMULATION], ValueError, r"\(5, 3\) and its experiment \(241, 2\)"),
        ([np.array([["a", "b"]]), SIMULATION], TypeError, "real numbers"),
    ],
)
def test_a_model_hooked_up_wrongly_is_an_error(simulations, error, message):
    with pytest.raises(error, match=message):
        Objective([EXPERIMENT, BRANCH])(simulations)


@pytest.mark.parametrize("measure", ["curve_length", "sum_of_squares"])
def test_residuals_add_up_to_the_value(measure):
    objective = Objective([BRANCH, BRANCH], Criterion(measure, weights=[1.0, 3.0]))
    simulations = [BRANCH * [1.0, 1.1], BRANCH * [1.0, 0.8]]
    squares = objective.residuals(simulations) ** 2
    terms = objective.terms(simulations)
    if measure == "curve_length":
        terms = terms**2
    assert squares.sum() == pytest.approx(terms[0] + 3.0 * terms[1], rel=1e-12)
    failed = objective.residuals(None)
    assert failed.shape == squares.shape
    penalty = objective.failure_value ** (2 if measure == "curve_length" else 1)
    assert (failed**2).sum() == pytest.approx(penalty[0] + 3.0 * penalty[1])


LEAST_SQUARES = {
    "over x": Criterion("sum_of_squares", weights=[1.0, 3.0]),
    "over x, raw": Criterion("sum_of_squares", preset="raw"),
    "over the third column": Criterion("sum_of_squares", abscissa=2),
    "over the second column": Criterion("sum_of_squares", abscissa=1),
    "point by point": Criterion("sum_of_squares", abscissa="points", weights=[1.0, 3.0]),
    "curve_length": Criterion("curve_length"),
}


@pytest.mark.parametrize("turned", [False, True], ids=["up", "down"])
@pytest.mark.parametrize("case", LEAST_SQUARES)
def test_residuals_move_as_their_slopes_say(case, turned):
    random = np.random.default_rng(5)

    def curve(count):
        rising = np.linspace(0.0, 1.0, count) + random.uniform(-0.3, 0.3, count) / count
        return np.column_stack((rising, rising**2 + rising, 2.0 * rising)) * [3.0, 200.0, 7.0]

    experiments = [curve(count)[3:-3] for count in (37, 40)]
    simulations = [curve(count) for count in (23, 30)]
    if case == "point by point":
        simulations = [test * [1.0, 1.3, 1.0] for test in experiments]
    if case.startswith("over x") or case == "curve_length":
        experiments, simulations = ([c[:, :2] for c in some] for some in (experiments, simulations))
    if turned:
        simulations = [c[::-1] for c in simulations]
        if case == "point by point":
            experiments = [c[::-1] for c in experiments]
    objective = Objective(experiments, LEAST_SQUARES[case])
    directions = [random.normal(size=(*c.shape, 4)) for c in simulations]
    if case == "point by point":
        directions = [along * [[0.0], [1.0], [1.0]] for along in directions]
    slopes = objective.residual_slopes(simulations, directions)
    for i, column in enumerate(slopes.T):
        ends = [
            objective.residuals(
                [c + by * d[..., i] for c, d in zip(simulations, directions, strict=True)]
            )
            for by in (1e-6, -1e-6)
        ]
        moved = (ends[0] - ends[1]) / 2e-6
        np.testing.assert_allclose(column, moved, rtol=1e-5, atol=1e-6 * np.abs(moved).max())


@pytest.mark.parametrize("measure", ["area", curvewise.mse])
def test_residuals_of_other_measures_are_refused(measure):
    name = Criterion(measure).name
    with pytest.raises(ValueError, match=f"measure '{name}' is not a sum of squares"):
        Objective(BRANCH, Criterion(measure, preset="raw")).residuals(BRANCH)


@pytest.mark.parametrize("measure", FIVE)
def test_objective_can_be_pickled(measure):
    objective = Objective(EXPERIMENT, measure)
    assert pickle.loads(pickle.dumps(objective))(SIMULATION) == objective(SIMULATION)


OPEN = {"open_begin": True, "open_end": True}


@pytest.mark.parametrize("options", [{"open_end": True}, {"open_begin": True}, OPEN])
def test_part_says_which_curve_dtw_matches_to_a_piece_of_the_other(options):
    P, Q = EXPERIMENT, SIMULATION[:90]
    scaled = curvewise.normalize(P, Q)
    of_experiment = Objective(P, "dtw", **options)
    of_simulation = Objective(P, Criterion("dtw", part="simulation", **options))
    assert of_experiment(Q) == curvewise.dtw(*scaled, **options)
    assert of_simulation(Q) == curvewise.dtw(*scaled[::-1], **options)
    assert of_simulation.part == "simulation"


def test_a_piece_of_the_experiment_is_perfect():
    """Figure 15 of the paper: the whole loop is the test, its first branch is the simulation."""
    branch = EXPERIMENT[:60]
    assert Objective(EXPERIMENT, Criterion("dtw", part="simulation", open_end=True))(branch) == 0.0
    objective = Objective(EXPERIMENT, Criterion("pcm", part="simulation"))
    assert objective(branch) == 0.0
    assert objective.failures == 0  # though it has less than min_coverage of the length
    assert Objective(EXPERIMENT, "pcm").score(branch).failures


@pytest.mark.parametrize(
    ("measure", "options"), [("area", {}), ("dtw", {}), ("curve_length", {}), (np.hypot, {})]
)
def test_part_of_a_measure_of_whole_curves_is_refused(measure, options):
    with pytest.raises(ValueError, match="compares whole curves; part='simulation' needs"):
        Objective(EXPERIMENT, Criterion(measure, part="simulation", **options))


def largest_difference(P, Q, *, coordinate=1):
    """A measure of the user's own, which refuses curves of other lengths with ValueError."""
    return np.abs(P[:, coordinate] - Q[:, coordinate]).max()


def test_a_measure_of_ones_own():
    P = np.array([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)])
    Q = np.add(P, [0.5, -1.0])
    assert Objective(P, Criterion(largest_difference, preset="raw"))(Q) == 1.0
    assert Objective(P, Criterion(largest_difference, preset="paper"))(Q) == 1.0
    assert Objective(P, largest_difference)(Q) == 0.5  # of the box's height
    objective = Objective([P, P], Criterion(largest_difference, weights=[1.0, 2.0], coordinate=0))
    assert objective([Q, Q]) == 0.25 + 2 * 0.25
    assert objective.measure == "largest_difference"
    assert pickle.loads(pickle.dumps(objective))([Q, Q]) == 0.75
    assert objective.score([Q[:2], Q]).failures[0].startswith("loop 0: operands could not")


def test_a_function_of_the_measures_has_its_bits():
    by_name = Objective(EXPERIMENT, "dtw", step_pattern="symmetric2")
    by_function = Objective(EXPERIMENT, curvewise.dtw, step_pattern="symmetric2")
    assert by_function(SIMULATION) == by_name(SIMULATION)
    assert by_function.failure_value == by_name.failure_value


def test_series():
    objective = Objective(EXPERIMENT[:, 1], Criterion("dtw", preset="raw"))
    assert objective(SIMULATION[:, 1]) == curvewise.dtw(EXPERIMENT[:, 1], SIMULATION[:, 1])


def test_a_criterion_is_frozen_and_prints_as_what_makes_it():
    criterion = Criterion("pcm", min_coverage=0.8, weights=[1, 2], offsets=50)
    assert repr(criterion) == "Criterion('pcm', min_coverage=0.8, weights=[1.0, 2.0], offsets=50)"
    assert criterion == Criterion(**criterion.settings)
    assert hash(criterion) == hash(pickle.loads(pickle.dumps(criterion)))
    assert criterion != Criterion("pcm", min_coverage=0.8, weights=[1, 2], offsets=60)
    assert criterion.weighing(None).weights is None
    assert repr(Criterion(largest_difference)) == "Criterion('largest_difference')"
    with pytest.raises(dataclasses.FrozenInstanceError):
        criterion.preset = "raw"


def test_options_of_a_function_are_those_of_its_keywords():
    with pytest.raises(TypeError, match=r"'cordinate'; it has coordinate; did you mean 'coord"):
        Criterion(largest_difference, cordinate=0)
    Criterion(lambda P, Q, **options: 0.0, anything=1)
