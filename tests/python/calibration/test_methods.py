"""Every method and measure on a model whose parameters are known, and on awkward landscapes."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from curvewise import datasets
from curvewise.calibration import identify

TRUE = {"E": 200e3, "yield": 300.0, "C": 80e3}
BOUNDS = {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)}
NEAR = {"E": 210e3, "yield": 270.0, "C": 95e3}
STRAIN = np.concatenate(
    [np.linspace(a, b, 20, endpoint=False) for a, b in itertools.pairwise((0.0, 0.02, -0.02, 0.02))]
)
MEASURES = ["area", "pcm", "frechet", "dtw", "curve_length"]


def model(parameters):
    stress = datasets.kinematic_hardening(
        STRAIN,
        youngs_modulus=parameters["E"],
        yield_stress=parameters["yield"],
        backstresses=((parameters["C"], 400.0), (5e3, 20.0)),
    )
    return np.column_stack((STRAIN, stress))


def first_branch(parameters):
    return model(parameters)[:21]


def largest_error(found):
    return max(abs(found.parameters[name] / TRUE[name] - 1.0) for name in TRUE)


def quiet_identify(*arguments, **keywords):
    return identify(*arguments, progress=False, **keywords)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("method", ["sdrm+de", "de", "sdrm"])
def test_known_parameters_are_recovered_from_the_bounds(measure, method):
    found = quiet_identify(model, model(TRUE), BOUNDS, measure=measure, method=method)
    assert found.converged, found.message
    assert largest_error(found) < (1e-3 if method == "sdrm" else 1e-4)
    assert found.value < (1e-4 if method == "sdrm" else 1e-5)


@pytest.mark.parametrize("measure", MEASURES)
def test_nelder_mead_recovers_known_parameters_from_nearby(measure):
    found = quiet_identify(
        model, model(TRUE), BOUNDS, measure=measure, method="nelder-mead", start=NEAR
    )
    assert largest_error(found) < 1e-4
    assert found.value < 1e-5
    assert found.evaluations < 1000


@pytest.mark.parametrize("method", ["sdrm+de", "sdrm", "nelder-mead", "least_squares"])
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
        measure="curve_length",
        method="least_squares",
        weights=[1.0, 2.0],
    )
    assert found.converged
    assert largest_error(found) < 1e-5
    assert found.evaluations < 80


@pytest.mark.parametrize("measure", ["area", "dtw"])
@pytest.mark.parametrize("method", ["sdrm+de", "sdrm"])
def test_noise_moves_the_optimum_little(measure, method):
    random = np.random.default_rng(3)
    noisy = model(TRUE)
    noisy[:, 1] += random.normal(0.0, 4.0, len(noisy))
    found = quiet_identify(model, noisy, BOUNDS, measure=measure, method=method)
    assert found.converged
    assert largest_error(found) < 0.03
    at_truth = quiet_identify(
        model, noisy, BOUNDS, measure=measure, method="nelder-mead", start=TRUE, max_evaluations=1
    )
    assert found.value <= at_truth.value * (1.05 if method == "sdrm" else 1.0)


def test_sdrm_falls_back_to_the_objective_where_point_counts_differ():
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
        method="sdrm",
    )
    assert found.value < 0.05
    assert len({len(found.simulations[0]), 41}) == 2  # other point counts did occur


@pytest.mark.parametrize("method", ["de", "sdrm+de", "sdrm", "nelder-mead"])
def test_a_landscape_of_steps_ends(method):
    x = np.linspace(0.0, 1.0, 21)

    def steps(parameters):
        level = np.floor(4.0 * parameters["a"]) + np.floor(4.0 * parameters["b"])
        return np.column_stack((x, level * x))

    found = quiet_identify(
        steps, np.column_stack((x, 3.0 * x)), {"a": (0, 3), "b": (0, 3)}, method=method
    )
    assert found.converged
    assert found.evaluations < 5000
    if method in ("de", "sdrm+de"):
        assert found.value == 0.0


@pytest.mark.parametrize("method", ["sdrm+de", "sdrm", "nelder-mead"])
def test_a_region_where_simulations_fail_is_left(method):
    def fragile(parameters):
        if parameters["yield"] > 380.0:
            raise ArithmeticError("no convergence")
        return None if parameters["E"] < 160e3 else model(parameters)

    found = quiet_identify(fragile, model(TRUE), BOUNDS, method=method)
    assert largest_error(found) < 1e-3
    assert bool(found.failures) == (method != "nelder-mead")  # whose path does not lead there
    assert {message for _, message in found.failures} <= {
        "ArithmeticError: no convergence",
        "no simulation",
    }
    numbers = [number for number, _ in found.failures]
    assert found.history.evaluation[found.history.failed].tolist() == numbers


def test_one_parameter():
    found = quiet_identify(
        lambda p: model({**TRUE, **p}), model(TRUE), {"yield": (100.0, 600.0)}, method="sdrm"
    )
    assert found.parameters["yield"] == pytest.approx(300.0, rel=1e-3)


def test_an_optimum_at_a_bound_is_reported():
    found = quiet_identify(
        model, model(TRUE), {**BOUNDS, "yield": (320.0, 500.0)}, method="sdrm+de"
    )
    assert found.parameters["yield"] == pytest.approx(320.0, rel=1e-3)
    (line,) = [line for line in found.summary().splitlines() if line.startswith("yield")]
    assert line.endswith("at its lower bound")


def test_method_options_reach_the_methods():
    keywords = {"measure": "frechet", "method_options": {"popsize": 5, "maxiter": 3}}
    found = quiet_identify(model, model(TRUE), BOUNDS, method="de", **keywords)
    assert found.evaluations <= 4 * 15
    assert not found.converged
    staged = {"sdrm": {"maxiter": 2}, "de": {"maxiter": 1, "popsize": 4}}
    found = quiet_identify(model, model(TRUE), BOUNDS, method_options=staged)
    assert found.evaluations <= 2 * 5 + 2 * 12


def test_stall_ends_de_where_it_hardly_improves():
    """The paper's rule, and not a generation earlier: read off the history."""
    experiment = model(TRUE)
    experiment[:, 1] += np.random.default_rng(0).normal(0.0, 20.0, len(experiment))
    generations, members = 12, 5 * len(TRUE)
    options = {"popsize": 5, "maxiter": 500, "tol": 0.0, "stall": (0.001, generations)}
    found = quiet_identify(model, experiment, BOUNDS, method="de", method_options=options)
    assert found.converged
    assert found.message == "improved by less than 0.001 over 12 generations"
    assert found.evaluations < 500 * members
    best = np.minimum.accumulate(found.history.value)[::-members][::-1]  # after each generation
    improved = 1.0 - best[generations:] / best[:-generations]
    assert improved[-1] <= 0.001
    assert (improved[1:-1] > 0.001).all()


def test_stall_of_the_second_stage():
    options = {"sdrm": {"maxiter": 2}, "de": {"popsize": 5, "tol": 0.0, "stall": (0.5, 3)}}
    found = quiet_identify(model, model(TRUE), BOUNDS, method_options=options)
    assert found.message == "improved by less than 0.5 over 3 generations"


@pytest.mark.parametrize("stall", [0.001, (0.001,), (1.0, 100), (-0.1, 100), (0.001, 0)])
def test_a_stall_that_is_none_is_refused(stall):
    with pytest.raises(ValueError, match=r"stall is .*give \(improvement, generations\)"):
        quiet_identify(model, model(TRUE), BOUNDS, method="de", method_options={"stall": stall})


def test_stall_takes_the_place_of_a_callback():
    options = {"stall": (0.001, 100), "callback": print}
    with pytest.raises(ValueError, match="either stall or callback"):
        quiet_identify(model, model(TRUE), BOUNDS, method="de", method_options=options)
