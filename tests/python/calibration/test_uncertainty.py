"""What the tests determine: against the formula of least squares, and where little is."""

from __future__ import annotations

import itertools
import re
from dataclasses import replace

import numpy as np
import pytest

from curvewise import datasets
from curvewise.calibration import Log, NoisyTestWarning, SimulationStore, identify, identify_each
from curvewise.calibration.problem.space import Space
from curvewise.calibration.uncertainty.determined import determined

X = np.linspace(0.0, 1.0, 40)
BOUNDS = {"a": (-10.0, 10.0), "b": (-20.0, 20.0), "c": (-20.0, 20.0)}
TRUTH = {"a": 1.0, "b": -2.0, "c": 3.0}
DESIGN = np.column_stack((np.ones_like(X), X, X**2))
QUIET = {"progress": False, "method": "trust-region"}


def parabola(p):
    return np.column_stack((X, DESIGN @ [p["a"], p["b"], p["c"]]))


def with_noise(curve, deviation, seed=0):
    noisy = curve.copy()
    noisy[:, 1] += np.random.default_rng(seed).normal(0.0, deviation, len(curve))
    return noisy


TEST = with_noise(parabola(TRUTH), 0.1)


def linear_theory(test, sigma=None):
    """Return the estimate, its covariance and the degrees of freedom, by the textbook."""
    best, *_ = np.linalg.lstsq(DESIGN, test[:, 1], rcond=None)
    residuals = test[:, 1] - DESIGN @ best
    freedom = len(test) - 3
    variance = residuals @ residuals / freedom if sigma is None else sigma**2
    return best, variance * np.linalg.inv(DESIGN.T @ DESIGN), freedom


@pytest.mark.parametrize("sigma", [None, 0.3])
def test_a_linear_model_has_the_errors_of_least_squares(sigma):
    from scipy import stats

    found = identify(parabola, TEST, BOUNDS, measure="sum_of_squares", **QUIET)
    uncertainty = found.uncertainty(sigma=sigma)
    best, covariance, freedom = linear_theory(TEST, sigma)
    errors = np.sqrt(np.diag(covariance))
    assert list(uncertainty.standard_errors.values()) == pytest.approx(errors, rel=1e-3)
    expected = covariance / np.outer(errors, errors)
    assert uncertainty.correlations == pytest.approx(expected, abs=1e-3)
    t = stats.norm.ppf(0.975) if sigma else stats.t(freedom).ppf(0.975)
    for (low, high), b, e in zip(uncertainty.intervals.values(), best, errors, strict=True):
        assert low == pytest.approx(b - t * e, abs=0.05 * e)
        assert high == pytest.approx(b + t * e, abs=0.05 * e)
    deviation = sigma or np.sqrt(covariance[0, 0] / np.linalg.inv(DESIGN.T @ DESIGN)[0, 0])
    assert uncertainty.sigma == pytest.approx(deviation, rel=1e-3)
    assert uncertainty.runs == 0
    assert set(uncertainty.bias.values()) == {0.0}
    step = list(uncertainty.weakest_direction.values())
    move = np.sqrt(np.mean((DESIGN @ step / np.ptp(TEST[:, 1])) ** 2) / 2)  # of x and y
    said = re.search(r"the loops change by (\S+) % of their size$", uncertainty.in_words)
    assert float(said[1]) == pytest.approx(100.0 * move, rel=0.06)  # has two digits


@pytest.mark.nightly
def test_the_bootstrap_of_a_measure_is_near_least_squares():
    """Area and dtw of a noisy parabola: similar in efficiency, never better than least squares."""
    _, covariance, _ = linear_theory(TEST, 0.1)
    least = np.sqrt(np.diag(covariance))
    for measure in ("area", "dtw"):
        found = identify(parabola, TEST, BOUNDS, measure=measure, **QUIET)
        errors = found.uncertainty(sigma=0.1, samples=200).standard_errors
        ratio = np.array(list(errors.values())) / least
        assert (ratio > 0.85).all(), measure
        assert (ratio < 2.5).all(), measure


def chebyshev_fit(noise):
    """Return the parabola of the least largest deviation, by a linear program."""
    from scipy.optimize import linprog

    ones = np.ones((len(X), 1))
    upper = np.vstack((np.hstack((DESIGN, -ones)), np.hstack((-DESIGN, -ones))))
    cost, free = [0.0, 0.0, 0.0, 1.0], (None, None)
    return linprog(cost, A_ub=upper, b_ub=np.hstack((noise, -noise)), bounds=[free] * 4).x[:3]


def test_the_bootstrap_of_a_largest_distance_is_that_of_chebyshev_fits():
    """The noise is less than the steps between points, so that frechet pairs equal points."""
    test = with_noise(parabola(TRUTH), 0.005)
    with pytest.warns(NoisyTestWarning, match="the one point that noise moves most"):
        found = identify(parabola, test, BOUNDS, measure="frechet", **QUIET)
    errors = found.uncertainty(sigma=0.005, samples=300).standard_errors
    noise = np.random.default_rng(1).normal(0.0, 0.005, (500, len(X)))
    expected = np.std([chebyshev_fit(one) for one in noise], axis=0, ddof=1)
    assert list(errors.values()) == pytest.approx(expected, rel=0.12)


def test_the_same_seed_gives_the_same_and_another_another():
    found = identify(parabola, TEST, BOUNDS, measure="dtw", **QUIET)
    one, same, other = (
        found.uncertainty(samples=20, seed=seed).standard_errors for seed in (1, 1, 2)
    )
    assert one == same
    assert one != other


def test_methods_that_keep_no_curves_take_two_runs_a_parameter():
    runs = []

    def counted(p):
        runs.append(p)
        return parabola(p)

    found = identify(
        counted, TEST, BOUNDS, measure="sum_of_squares", method="nelder-mead", progress=False
    )
    assert found.uncertainty_runs == 6
    assert found.determined is None
    assert "Intervals take 6 more runs of the model" in str(found)
    before = len(runs)
    uncertainty = found.uncertainty()
    assert len(runs) - before == uncertainty.runs == 6
    errors = np.sqrt(np.diag(linear_theory(TEST)[1]))
    assert list(uncertainty.standard_errors.values()) == pytest.approx(errors, rel=1e-3)


def test_runs_that_fail_leave_differences_to_one_side():
    def fragile(p):
        if p["b"] > -2.0:
            raise ArithmeticError("no convergence")
        return parabola(p)

    keywords = {"measure": "sum_of_squares", "method": "nelder-mead", "progress": False}
    found = identify(fragile, TEST, BOUNDS, start={"a": 1.0, "b": -3.0, "c": 3.0}, **keywords)
    errors = found.uncertainty().standard_errors
    expected = np.sqrt(np.diag(linear_theory(TEST)[1]))
    assert list(errors.values()) == pytest.approx(expected, rel=0.2)


# Determined parameters.

STRAIN = np.concatenate(
    [np.linspace(a, b, 20, endpoint=False) for a, b in itertools.pairwise((0.0, 0.02, -0.02, 0.02))]
)


def hardening(p):
    stress = datasets.kinematic_hardening(
        STRAIN,
        youngs_modulus=p["E"],
        yield_stress=p["yield"],
        backstresses=((p["C"], p.get("gamma", 400.0)), (p.get("C2", 5e3), p.get("gamma2", 20.0))),
    )
    return np.column_stack((STRAIN, stress))


THREE = {"E": (150e3, 260e3), "yield": (150.0, 500.0), "C": (20e3, 200e3)}


def test_three_parameters_of_a_loop_are_determined():
    truth = {"E": 200e3, "yield": 300.0, "C": 80e3}
    test = with_noise(hardening(truth), 4.0)
    found = identify(hardening, test, THREE, measure="dtw", **QUIET)
    assert found.determined == dict.fromkeys(THREE, True)
    assert "\nSearch: converged. All 3 starts agree" in str(found)
    uncertainty = found.uncertainty()
    assert uncertainty.determined == dict.fromkeys(THREE, True)
    assert "all parameters are determined" in str(uncertainty)
    assert uncertainty.sensitivities.shape == (1, 3)
    for name, (low, high) in uncertainty.intervals.items():
        assert low <= truth[name] <= high


def test_parameters_that_only_act_together_are_not_determined():
    """If two back stresses are similar, a first branch gives only their sum; and seeds disagree."""

    def alike(p):
        return hardening({**p, "yield": 300.0})[:21]

    bounds = {"E": (150e3, 260e3), "C": (20e3, 200e3), "C2": (20e3, 200e3)}
    truth = {"E": 200e3, "C": 80e3, "C2": 60e3, "gamma": 400.0, "gamma2": 400.0}
    test = with_noise(alike(truth), 2.0)

    def model(p):
        return alike({**p, "gamma": 400.0, "gamma2": 400.0})

    for seed in (1, 2):
        found = identify(model, test, bounds, seed=seed, **QUIET)
        assert found.determined == {"E": True, "C": False, "C2": False}
        assert re.search(r"Do not use C \([^)]+\) and C2 \([^)]+\): the tests", str(found))
        low, high = found.uncertainty().intervals["C"]
        assert high > 1.5 * low
        assert "They are not sensitive to this change: " in str(found)
        assert found.verdict.usable == found.determined
        uncertainty = found.uncertainty(samples=20)
        assert uncertainty.determined == {"E": True, "C": False, "C2": False}
        direction = uncertainty.weakest_direction
        assert direction["C"] == pytest.approx(-direction["C2"], rel=0.02)
        assert uncertainty.singular_values[-1] < 3e-3 * uncertainty.singular_values[0]
        smaller, larger = sorted(("C", "C2"), key=lambda name: found.parameters[name])
        assert f"{smaller} by 10 %" in uncertainty.in_words
        assert f"{larger} by " in uncertainty.in_words


def test_a_parameter_at_its_bound_is_not_determined():
    found = identify(parabola, TEST, {**BOUNDS, "a": (1.5, 10.0)}, measure="dtw", **QUIET)
    uncertainty = found.uncertainty(samples=20)
    assert uncertainty.at_bounds == {"a": "lower"}
    assert not uncertainty.determined["a"]
    assert "at its lower bound" in str(uncertainty)


def test_a_parameter_at_zero_is_at_its_limit(tmp_path):
    def line(p):
        return np.column_stack((TEST[:, 0], p["height"] + p["slope"] * TEST[:, 0]))

    falling = line({"height": 1.0, "slope": -0.5})
    bounds = {"height": (-2.0, 5.0), "slope": (0.0, 3.0)}
    found = identify(line, falling, bounds, measure="sum_of_squares", **QUIET)
    uncertainty = found.uncertainty()
    assert uncertainty.at_limits == ("slope",)
    assert not uncertainty.determined["slope"]
    assert "slope, at a limit beyond which nothing lies" in str(uncertainty)
    assert "at its limit" in str(found)
    found.report(tmp_path / "report.html", uncertainty=uncertainty)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Do not use slope: it is at its limit, 0, beyond which nothing lies." in page


@pytest.mark.parametrize(
    ("bounds", "value", "change", "expected"),
    [
        ((0.0, 100.0), 58.5, 10.5, True),  # 58.5 ± 5, were the tests ten times as many
        ((0.0, 1000.0), 58.5, 25.0, False),
        ((55.0, 65.0), 58.5, 4.0, False),  # the bounds had said as much
        ((-1.0, 1.0), 0.001, 0.03, True),  # next to nothing, and known to be
        (Log(1e-3, 1e3), 1.0, 0.2, True),
        (Log(1e-3, 1e3), 1.0, 0.4, False),
        ((0.0, 58.5), 58.5, 1.0, False),  # at its bound
    ],
)
def test_what_is_determined(bounds, value, change, expected):
    assert determined(Space({"Q": bounds}), {"Q": value}, [change]) == {"Q": expected}


def test_a_half_interval_of_a_fifth_is_determined_whatever_the_linear_theory_says():
    """Swift's offset, 0.0045 ± 9 %: the interval that is shown decides, and no other estimate."""
    strain = np.linspace(0.002, 0.15, 60)

    def swift(p):
        return np.column_stack((strain, p["K"] * (p["strain_0"] + strain) ** p["n"]))

    test = with_noise(swift({"K": 520.0, "strain_0": 0.004, "n": 0.19}), 2.0)
    bounds = {"K": (300, 900), "strain_0": (0.0005, 0.02), "n": (0.05, 0.4)}
    found = identify(swift, test, bounds, measure="sum_of_squares", **QUIET)
    uncertainty = found.uncertainty()
    low, high = uncertainty.intervals["strain_0"]
    assert 0.15 < (high - low) / 2 / found.parameters["strain_0"] < 0.2
    assert uncertainty.determined == found.determined == dict.fromkeys(bounds, True)


def test_the_weakest_direction_of_a_parameter_that_is_0():
    """10 % of 0 is not a change; a part of the range is, and the loops then move."""
    test = parabola({**TRUTH, "c": 0.0})
    found = identify(parabola, test, {**BOUNDS, "c": (0.0, 20.0)}, measure="dtw", **QUIET)
    found = replace(found, parameters={**found.parameters, "c": 0.0})
    uncertainty = found.uncertainty(samples=20)
    assert max(map(abs, uncertainty.weakest_direction.values())) > 0.05
    assert " of its range" in uncertainty.in_words or "by 10 %" in uncertainty.in_words


def test_errors_are_said_in_per_cent():
    uncertainty = identify(parabola, TEST, BOUNDS, measure="sum_of_squares", **QUIET).uncertainty()
    rows = str(uncertainty).splitlines()
    assert rows[0].split()[:5] == ["parameter", "value", "std.", "error", "%"]
    for row, (name, error) in zip(rows[1:], uncertainty.standard_errors.items(), strict=False):
        per_cent = 100 * error / abs(uncertainty.parameters[name])
        assert row.split()[3] == f"{per_cent:.2g}"


def test_draws_that_end_at_a_bound_make_up_no_limit():
    """Half of the draws of a end at its bound; their mirror image would be 0.2 errors away."""
    free = identify(parabola, TEST, BOUNDS, measure="dtw", start=TRUTH, **QUIET)
    best, error = free.parameters["a"], free.uncertainty(samples=40).standard_errors["a"]
    bounds = {**BOUNDS, "a": (-10.0, best + 0.2 * error)}
    found = identify(parabola, TEST, bounds, measure="dtw", start=free.parameters, **QUIET)
    low, high = found.uncertainty(samples=40).intervals["a"]
    assert high == bounds["a"][1]
    assert low < best - 0.7 * error


@pytest.mark.nightly
def test_residuals_that_go_on_alike_widen_the_intervals():
    """A wrong model: blocks of residuals, not single ones, are what may come differently."""
    smooth = parabola(TRUTH)
    smooth[:, 1] += 0.1 * np.sqrt(2.0) * np.sin(6.0 * np.pi * X)
    rough = with_noise(parabola(TRUTH), 0.1)
    errors = [
        identify(parabola, test, BOUNDS, measure="area", **QUIET)
        .uncertainty(samples=100)
        .standard_errors["a"]
        for test in (smooth, rough)
    ]
    assert errors[0] > 1.3 * errors[1]


def test_a_bias_is_measured_and_said():
    """Noise lengthens a curve: curve_length makes up for it by the parameters; dtw does not."""
    truth = {"E": 200e3, "yield": 300.0, "C": 80e3}
    keywords = {"start": truth, **QUIET}
    test = with_noise(hardening(truth), 5.0, seed=2)
    with pytest.warns(NoisyTestWarning, match="noise increases the lengths"):
        biased = identify(hardening, test, THREE, measure="curve_length", **keywords)
    uncertainty = biased.uncertainty(samples=60, sigma=5.0)
    assert uncertainty.bias["yield"] > 0.25 * uncertainty.standard_errors["yield"]
    assert "; the intervals include only a part of it" in str(uncertainty)
    assert "that curve_length compares: filter the test" in str(uncertainty)
    fair = identify(hardening, test, THREE, measure="dtw", **keywords)
    uncertainty = fair.uncertainty(samples=60, sigma=5.0)
    for name, bias in uncertainty.bias.items():
        assert abs(bias) < 0.25 * uncertainty.standard_errors[name]
    assert "noise increases the lengths" not in str(uncertainty)


def test_pictures_and_errors():
    found = identify(parabola, TEST, BOUNDS, measure="dtw", **QUIET)
    figure = found.uncertainty(samples=20).plot()
    titles = [ax.get_title() for ax in figure.axes]
    assert titles[:2] == ["95 % intervals", "Correlations of the errors"]
    assert "by 10 %" in figure.subfigs[1].get_suptitle()
    for keywords, message in [
        ({"level": 1.0}, "level is 1.0"),
        ({"samples": 3}, "samples is 3; give at least 20"),
        ({"sigma": -1.0}, "sigma is -1.0; give a finite deviation"),
    ]:
        with pytest.raises(ValueError, match=message):
            found.uncertainty(**keywords)


# Several measures.


@pytest.mark.nightly
@pytest.mark.filterwarnings("ignore::curvewise.calibration.NoisyTestWarning")
def test_several_measures_share_their_runs():
    runs = []

    def counted(p):
        runs.append(p)
        return hardening(p)

    truth = {"E": 200e3, "yield": 300.0, "C": 80e3}
    test = with_noise(hardening(truth), 4.0)
    each = identify_each(counted, test, THREE, measures=["area", "dtw", "frechet"], progress=False)
    assert len(runs) == each.runs == sum(found.runs for found in each.values())
    assert list(each) == ["area", "dtw", "frechet"]
    alone = {m: identify(hardening, test, THREE, measure=m, **QUIET) for m in each}
    assert each.runs < 0.75 * sum(found.evaluations for found in alone.values())
    for row, (measure, found) in enumerate(each.items()):
        assert found.value <= 1.01 * alone[measure].value
        assert found.value == found.history.value.min()  # of all rounds
        assert found.history.evaluation.tolist() == list(range(1, found.evaluations + 1))
        assert each.optima[row, row] == found.value
        assert each.optima[:, row].argmin() == row  # the best by its own measure
    low, high = each.spread["C"]
    assert low <= each["area"].parameters["C"] <= high
    text = str(each)
    for word in ("spread, % of bounds", "optimum of", f"{each.runs} runs of the model"):
        assert word in text
    assert [ax.get_title() for ax in each.plot().axes] == ["", "Parameters"]


def test_several_measures_from_a_store_run_nothing_again(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    keywords = {"measures": ["area", "dtw"], "progress": False, "store": store}
    first = identify_each(parabola, TEST, BOUNDS, **keywords)
    again = identify_each(parabola, TEST, BOUNDS, **keywords)
    assert again.runs == 0
    assert np.array_equal(first.optima, again.optima)
    with pytest.raises(ValueError, match="give at least one, and none twice"):
        identify_each(parabola, TEST, BOUNDS, measures=["area", "area"], progress=False)
