"""Every method and measure on a model whose parameters are known, and on awkward landscapes."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from curvewise import datasets
from curvewise.calibration import (
    SDRM,
    Case,
    Criterion,
    DifferentialEvolution,
    LeastSquares,
    TrustRegion,
    identify,
)

TRUE = {"E": 200e3, "yield": 300.0, "C": 80e3}
BOUNDS = {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)}
NEAR = {"E": 210e3, "yield": 270.0, "C": 95e3}
STRAIN = np.concatenate(
    [np.linspace(a, b, 20, endpoint=False) for a, b in itertools.pairwise((0.0, 0.02, -0.02, 0.02))]
)
MEASURES = ["area", "pcm", "frechet", "dtw", "curve_length"]


def material(parameters, strain):
    stress = datasets.kinematic_hardening(
        strain,
        youngs_modulus=parameters["E"],
        yield_stress=parameters["yield"],
        backstresses=((parameters["C"], 400.0), (5e3, 20.0)),
    )
    return np.column_stack((strain, stress))


def model(parameters):
    return material(parameters, STRAIN)


def first_branch(parameters):
    return model(parameters)[:21]


def with_noise(curve, deviation, seed):
    noisy = curve.copy()
    noisy[:, 1] += np.random.default_rng(seed).normal(0.0, deviation, len(curve))
    return noisy


def largest_error(found):
    return max(abs(found.parameters[name] / TRUE[name] - 1.0) for name in TRUE)


def quiet_identify(*arguments, **keywords):
    return identify(*arguments, progress=False, **keywords)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize(
    ("method", "start", "runs"),
    [
        ("sdrm+de", None, 10**5),
        ("de", None, 10**5),
        ("sdrm", None, 10**5),
        ("trust-region", None, 90),
        ("nelder-mead", NEAR, 1000),
    ],
)
@pytest.mark.nightly("de-", "(region|sdrm)-.*-(area|pcm|frechet)")
def test_known_parameters_are_recovered(measure, method, start, runs):
    found = quiet_identify(model, model(TRUE), BOUNDS, measure=measure, method=method, start=start)
    assert found.converged, found.message
    assert found.evaluations < runs
    assert largest_error(found) < (1e-4 if "de" in method else 1e-3)
    assert found.value < (1e-5 if "de" in method else 1e-4)


@pytest.mark.parametrize("method", ["sdrm+de", "sdrm", "nelder-mead", "least-squares"])
@pytest.mark.nightly("de$")
def test_sum_of_squares_recovers_known_parameters(method):
    found = quiet_identify(
        first_branch, first_branch(TRUE), BOUNDS, measure="sum_of_squares", method=method
    )
    assert largest_error(found) < 1e-3


def test_least_squares_recovers_known_parameters():
    loops = [model(TRUE), first_branch(TRUE)]
    found = quiet_identify(
        lambda p: [model(p), first_branch(p)],
        loops,
        BOUNDS,
        measure=Criterion("sum_of_squares", abscissa="points", weights=[1.0, 2.0]),
        method="least-squares",
    )
    assert found.converged
    assert largest_error(found) < 1e-4
    assert found.evaluations < 60


def timed(parameters):
    """The loop with its time in a third column: a function of it, though strain turns back."""
    return np.column_stack((model(parameters), np.arange(len(STRAIN), dtype=float)))


@pytest.mark.parametrize("method", ["least-squares", "trust-region"])
def test_loops_that_are_functions_of_time(method):
    """The test has other times than the simulation; the errors are those of least squares."""
    time = np.linspace(0.5, len(STRAIN) - 1.5, 150)
    clean = np.column_stack([np.interp(time, np.arange(len(STRAIN)), c) for c in timed(TRUE).T])
    noisy = with_noise(clean, 4.0, seed=1)
    keywords = {"measure": "sum_of_squares", "abscissa": 2, "method": method}
    found = quiet_identify(timed, clean, BOUNDS, **keywords)
    assert largest_error(found) < 1e-4
    found = quiet_identify(timed, noisy, BOUNDS, **keywords)
    uncertainty = found.uncertainty(sigma=4.0)
    for name, error in uncertainty.standard_errors.items():
        assert abs(found.parameters[name] - TRUE[name]) < 3.5 * error
        assert error < 0.02 * TRUE[name]
    assert found.uncertainty().sigma == pytest.approx(4.0, rel=0.2)
    with pytest.raises(ValueError, match="abscissa is 3; P has the columns 0 to 2"):
        quiet_identify(timed, clean, BOUNDS, measure="sum_of_squares", abscissa=3)
    with pytest.raises(ValueError, match="needs x and y, shape"):
        quiet_identify(timed, clean, BOUNDS, measure="sum_of_squares")


@pytest.mark.parametrize("method", ["least-squares", "trust-region"])
def test_a_model_driven_by_the_tests_own_strains(method):
    """One option: least squares on stress, point by point, though the strain turns back."""
    noisy = with_noise(model(TRUE), 4.0, seed=1)
    keywords = {"measure": "sum_of_squares", "abscissa": "points", "method": method}
    found = quiet_identify(model, noisy, BOUNDS, **keywords)
    squares = ((found.simulations[0] - noisy)[:, 1] ** 2).sum()
    assert found.value == pytest.approx(squares / np.ptp(noisy[:, 1]) ** 2, rel=1e-12)
    residuals = found.problem.objective.residuals(found.simulations)
    assert residuals.shape == (len(noisy),)
    uncertainty = found.uncertainty(sigma=4.0)
    for name, error in uncertainty.standard_errors.items():
        assert abs(found.parameters[name] - TRUE[name]) < 3.5 * error
    assert found.uncertainty().sigma == pytest.approx(4.0, rel=0.2)

    points = Criterion("sum_of_squares", abscissa="points")
    case = Case("loop", model, noisy, measure=points, sigma=4.0)
    of_case = identify([case], bounds=BOUNDS, method=method, progress=False)
    assert of_case.value == pytest.approx(squares / 4.0**2, rel=1e-3)
    with pytest.raises(RuntimeError, match=r"21 points and the experiment \d+; abscissa='points'"):
        quiet_identify(first_branch, noisy, BOUNDS, **keywords)
    with pytest.raises(RuntimeError, match=r"off by .* %.*driven by the experiment's x"):
        quiet_identify(lambda p: model(p)[::-1], noisy, BOUNDS, **keywords)


@pytest.mark.parametrize("measure", ["area", "dtw"])
@pytest.mark.parametrize("method", ["sdrm+de", "sdrm", "trust-region"])
@pytest.mark.nightly("de-", "region-area")
def test_noise_moves_the_optimum_little(measure, method):
    noisy = with_noise(model(TRUE), 4.0, seed=3)
    found = quiet_identify(model, noisy, BOUNDS, measure=measure, method=method)
    assert found.converged
    assert largest_error(found) < 0.03
    at_truth = quiet_identify(
        model, noisy, BOUNDS, measure=measure, method="nelder-mead", start=TRUE, max_runs=1
    )
    assert found.value <= at_truth.value * (1.0 if "de" in method else 1.05)


@pytest.mark.parametrize("method", ["sdrm", "trust-region"])
def test_simulations_of_different_numbers_of_points_are_resampled(method, caplog):
    x = np.linspace(0.0, 1.0, 41)

    def adaptive(parameters):
        curve = np.column_stack((x, parameters["a"] * x + parameters["b"]))
        steps = 20 + int(10 * abs(parameters["a"]) + 7 * abs(parameters["b"])) % 20
        resampled = np.linspace(0.0, 1.0, steps)
        return np.column_stack((resampled, np.interp(resampled, *curve.T)))

    found = quiet_identify(
        adaptive,
        np.column_stack((x, 2.0 * x + 1.0)),
        {"a": (0.0, 10.0), "b": (-5.0, 5.0)},
        method=method,
    )
    assert found.value < 1e-3
    assert len({len(found.simulations[0]), 41}) == 2  # other point counts did occur
    (record,) = [r for r in caplog.records if "different numbers of points" in r.message]
    assert "resampled by arc length" in record.message


@pytest.mark.parametrize("method", ["de", "sdrm+de", "sdrm", "trust-region", "nelder-mead"])
def test_a_landscape_of_steps_ends(method):
    x = np.linspace(0.0, 1.0, 21)

    def steps(parameters):
        level = np.floor(4.0 * parameters["a"]) + np.floor(4.0 * parameters["b"])
        return np.column_stack((x, level * x))

    found = quiet_identify(
        steps, np.column_stack((x, 3.0 * x)), {"a": (0, 3), "b": (0, 3)}, method=method
    )
    assert found.evaluations < 5000
    # Most starts of one cannot move, and the other may end beside its best run.
    assert found.converged or method in ("trust-region", "sdrm")
    if method in ("de", "sdrm+de", "trust-region"):
        assert found.value == 0.0


@pytest.mark.parametrize("method", ["sdrm+de", "sdrm", "trust-region", "nelder-mead"])
@pytest.mark.nightly("de$")
def test_a_region_where_simulations_fail_is_left(method):
    def fragile(parameters):
        if parameters["yield"] > 380.0:
            raise ArithmeticError("no convergence")
        return None if parameters["E"] < 160e3 else model(parameters)

    found = quiet_identify(fragile, model(TRUE), BOUNDS, measure="dtw", method=method)
    assert largest_error(found) < 1e-3
    assert bool(found.failures) == (method != "nelder-mead")  # whose path does not lead there
    assert {message.partition(" (")[0] for _, message in found.failures} <= {
        "ArithmeticError: no convergence",
        "no simulation",
    }
    numbers = [number for number, _ in found.failures]
    assert found.history.evaluation[found.history.failed].tolist() == numbers


def test_the_default_starts_three_times_and_then_makes_sure():
    """From the middle and from places that are drawn; from one where a start is given."""
    experiment = with_noise(model(TRUE), 4.0, seed=3)
    found = quiet_identify(model, experiment, BOUNDS, seed=3)
    assert (found.method, found.message.split(";")[0]) == (
        "trust-region",
        "3 of 3 starts within 1 % of the best",
    )
    one = quiet_identify(model, experiment, BOUNDS, method=TrustRegion(starts=1))
    near = quiet_identify(model, experiment, BOUNDS, start=NEAR)
    for other in (one, near):
        assert other.evaluations < 0.7 * found.evaluations
        assert "starts" not in other.message
        assert other.value < 1.01 * found.value


STALL = r"stall is .*give \(improvement, generations\)"


@pytest.mark.parametrize(
    ("method", "wrong", "message"),
    [
        (TrustRegion, {"starts_at_once": 0}, "starts_at_once is 0; give at least 1"),
        (TrustRegion, {"starts": 0}, "starts is 0; give at least 1"),
        (TrustRegion, {"diff_step": 0.0}, "diff_step is 0.0; give a fraction of the bounds"),
        (TrustRegion, {"initial_range": 1.5}, "initial_range is 1.5; give a fraction of the"),
        (LeastSquares, {"diff_step": 0}, "diff_step is 0"),
        (LeastSquares, {"f_scale": 0}, "f_scale is 0; it must be above 0"),
        (LeastSquares, {"loss": "l1"}, "loss is 'l1'; choose from linear, soft_l1, huber"),
        *(
            (DifferentialEvolution, {"stall": stall}, STALL)
            for stall in (0.001, (0.001,), (1.0, 100), (-0.1, 100), (0.001, 0))
        ),
        (
            DifferentialEvolution,
            {"stall": (0.001, 100), "options": {"callback": print}},
            "either stall or callback",
        ),
    ],
)
def test_options_that_are_wrong(method, wrong, message):
    with pytest.raises(ValueError, match=message):
        method(**wrong)


CYCLES = [
    np.concatenate([np.linspace(a, b, 25, endpoint=False) for a, b in ((0, x), (x, -x), (-x, x))])
    for x in (0.02, 0.04)
]
SEVEN = {
    "E": (190e3, 150e3, 230e3),
    "yield": (250.0, 100.0, 500.0),
    "C1": (90e3, 20e3, 300e3),
    "gamma1": (700.0, 200.0, 2000.0),
    "C2": (10e3, 1e3, 40e3),
    "gamma2": (60.0, 10.0, 200.0),
    "C3": (500.0, 0.0, 3000.0),
}


def two_cycles(p):
    backstresses = ((p["C1"], p["gamma1"]), (p["C2"], p["gamma2"]), (p["C3"], 0.0))
    laws = {"youngs_modulus": p["E"], "yield_stress": p["yield"], "backstresses": backstresses}
    curves = [(strain, datasets.kinematic_hardening(strain, **laws)) for strain in CYCLES]
    return [np.column_stack(curve) for curve in curves]


@pytest.mark.parametrize("slopes", ["from runs", "fresh"])
@pytest.mark.nightly
def test_one_start_does_not_halt_with_stale_slopes(slopes):
    """Where the region shrank before slopes were renewed, it ended 76 % above the best."""
    truth = {name: value for name, (value, _, _) in SEVEN.items()}
    tests, random = two_cycles(truth), np.random.default_rng(9)
    for test in tests:
        test[:, 1] += random.normal(0.0, 4.0, len(test))
    found = quiet_identify(
        two_cycles,
        tests,
        {name: (low, high) for name, (_, low, high) in SEVEN.items()},
        seed=9,
        method=TrustRegion(starts=1, slopes=slopes),
    )
    assert found.converged
    assert found.value < 1.01 * found.problem.objective(two_cycles(truth))
    assert found.evaluations < 100


def test_a_valley_that_is_not_the_deepest_is_left():
    """A measure with two minima, between which the objective is higher than at the first."""
    x = np.linspace(0.0, 1.0, 20)

    def two_minima(P, Q):
        height = float(np.mean(Q[:, 1] - P[:, 1]))
        return min(abs(height + 0.3) + 0.5, abs(height - 0.3))

    keywords = {"measure": Criterion(two_minima, preset="raw"), "start": {"height": -0.3}}
    found = quiet_identify(
        lambda p: np.column_stack((x, np.full(20, p["height"]))),
        np.column_stack((x, np.zeros(20))),
        {"height": (-0.5, 0.5)},
        method=TrustRegion(initial_range=1.0),
        **keywords,
    )
    assert found.parameters["height"] == pytest.approx(0.3, abs=1e-3)
    assert found.evaluations < 20


def test_one_parameter():
    found = quiet_identify(
        lambda p: model({**TRUE, **p}), model(TRUE), {"yield": (100.0, 600.0)}, method="sdrm"
    )
    assert found.parameters["yield"] == pytest.approx(300.0, rel=1e-3)


@pytest.mark.parametrize("method", ["sdrm+de", "sdrm"])
@pytest.mark.nightly("de$")
def test_an_optimum_at_a_bound_is_reported(method):
    found = quiet_identify(model, model(TRUE), {**BOUNDS, "yield": (320.0, 500.0)}, method=method)
    assert found.parameters["yield"] == pytest.approx(320.0, rel=1e-3)
    (line,) = [line for line in str(found).splitlines() if line.startswith("yield")]
    assert line.endswith("at its lower bound")


def test_options_reach_the_methods():
    short = DifferentialEvolution(popsize=5, maxiter=3)
    found = quiet_identify(model, model(TRUE), BOUNDS, measure="frechet", method=short)
    assert found.evaluations <= 4 * 15
    assert not found.converged
    staged = DifferentialEvolution(maxiter=1, popsize=4, after=SDRM(maxiter=2))
    found = quiet_identify(model, model(TRUE), BOUNDS, method=staged)
    assert found.method == "sdrm+de"
    assert found.evaluations <= 2 * 5 + 2 * 12


def test_stall_ends_de_where_it_hardly_improves():
    """The paper's rule, and not a generation earlier: read off the history."""
    experiment = with_noise(model(TRUE), 20.0, seed=0)
    generations, members = 12, 5 * len(TRUE)
    method = DifferentialEvolution(popsize=5, maxiter=500, tol=0.0, stall=(0.001, generations))
    found = quiet_identify(model, experiment, BOUNDS, method=method)
    assert found.converged
    assert found.message == "improved by less than 0.001 over 12 generations"
    assert found.evaluations < 500 * members
    best = np.minimum.accumulate(found.history.value)[::-members][::-1]  # after each generation
    improved = 1.0 - best[generations:] / best[:-generations]
    assert improved[-1] <= 0.001
    assert (improved[1:-1] > 0.001).all()


def test_stall_of_the_second_stage():
    method = DifferentialEvolution(popsize=5, tol=0.0, stall=(0.5, 3), after=SDRM(maxiter=2))
    found = quiet_identify(model, model(TRUE), BOUNDS, method=method)
    assert found.message == "improved by less than 0.5 over 3 generations"


@pytest.mark.parametrize("measure", ["area", "dtw", "frechet"])
def test_domain_reduction_leaves_a_kink_in_the_middle_of_the_bounds(measure):
    strain = np.linspace(0.0, 0.01, 51)

    def bar(p):
        return np.column_stack((strain, np.minimum(p["E"] * strain, p["yield"])))

    found = quiet_identify(
        bar,
        bar({"E": 205e3, "yield": 400.0}),
        {"E": (150e3, 250e3), "yield": (200.0, 600.0)},
        measure=measure,
        method="sdrm",
    )
    assert found.converged
    assert found.parameters == pytest.approx({"E": 205e3, "yield": 400.0}, rel=1e-6)


def test_domain_reduction_that_ends_above_its_best_run_has_not_converged():
    x = np.linspace(0.0, 1.0, 11)

    def misleading(p):  # a single good place, and a slope that leads away from it
        height = 0.0 if p["a"] == 0.5 else 2.0 - p["a"]
        return np.column_stack((x, x + height))

    found = quiet_identify(misleading, misleading({"a": 0.5}), {"a": (0.0, 1.0)}, method="sdrm")
    assert found.parameters == {"a": 0.5}
    assert not found.converged
    assert "the last run has" in found.message
