"""Misspelt names: what is wrong, and what was meant."""

from __future__ import annotations

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective, identify, identify_each

X = np.linspace(0.0, 1.0, 20)


def line(parameters):
    return np.column_stack((X, parameters["a"] * X))


EXPERIMENT = line({"a": 2.0})
SQUARES = {"method": "least_squares", "measure": "sum_of_squares"}


@pytest.mark.parametrize(
    ("keywords", "error", "message"),
    [
        ({"method": "trust_region"}, ValueError, "unknown method .*you mean 'trust-region'"),
        ({"method": "Nelder Mead"}, ValueError, "unknown method .*you mean 'nelder-mead'"),
        ({"measure": "freched"}, ValueError, "unknown measure .*you mean 'frechet'"),
        ({"preset": "raw"}, TypeError, r"keyword; use measure=Criterion\('area', preset=...\)"),
        ({"presett": "raw"}, TypeError, "area has no option 'presett'; .*you mean 'preset'"),
        ({"measure": Criterion(), "spacing": "x"}, TypeError, "spacing given beside a Criterion"),
        ({"max_evaluation": 5}, TypeError, "no option 'max_evaluation'.*'max_evaluations'"),
        ({"spaceing": "x"}, TypeError, "no option 'spaceing'; it has .*you mean 'spacing'"),
        ({"measure": "dtw", "windw": 3}, TypeError, "no option 'windw'.*you mean 'window'"),
        ({"measure": "sum_of_squares", "absissa": 0}, TypeError, "'absissa'.*you mean 'abscissa'"),
        ({"method_options": {"diffstep": 1}}, ValueError, "no option diffstep.*'diff_step'"),
        (
            {"method": "de", "method_options": {"pop_size": 3}},
            ValueError,
            "'de' has no option pop_size; it has stall, .*you mean 'popsize'",
        ),
        (
            {"method": "nelder-mead", "method_options": {"sise": 3}},
            ValueError,
            "'nelder-mead' has no option sise; it has size.*you mean 'size'",
        ),
        (
            {**SQUARES, "method_options": {"los": "huber"}},
            ValueError,
            "'least_squares' has no option los; .*you mean 'loss'",
        ),
        (
            {"method": "sdrm+de", "method_options": {"srdm": {}}},
            ValueError,
            "takes a dict for each of sdrm, de; did you mean 'sdrm'",
        ),
    ],
)
def test_the_near_name_is_offered(keywords, error, message):
    with pytest.raises(error, match=message):
        identify(line, EXPERIMENT, {"a": (0, 10)}, progress=False, **keywords)


def test_nothing_is_offered_where_nothing_is_near():
    with pytest.raises(ValueError, match=r"choose from .*least_squares$"):
        identify(line, EXPERIMENT, {"a": (0, 10)}, method="magic")
    with pytest.raises(TypeError, match=r"it has spacing, crossing, squared$"):
        Objective(EXPERIMENT, "area", wibble=1)


def test_of_the_settings_of_a_criterion():
    with pytest.raises(ValueError, match=r"unknown preset .*you mean 'scaled'"):
        Criterion(preset="scald")
    with pytest.raises(ValueError, match=r"unknown part .*you mean 'simulation'"):
        Criterion(part="simulations")


def test_of_several_measures_too():
    with pytest.raises(ValueError, match=r"unknown measure 'dwt'.*did you mean 'dtw'"):
        identify_each(line, EXPERIMENT, {"a": (0, 10)}, measures=["area", "dwt"])


def test_options_of_scipy_are_passed_on():
    """Those that are offered are taken: a robust loss, and a tolerance of the simplex."""
    outlier = EXPERIMENT.copy()
    outlier[7, 1] += 40.0
    found = {
        loss: identify(
            line,
            outlier,
            {"a": (0, 10)},
            progress=False,
            method_options={"loss": loss, "f_scale": 0.01},
            **SQUARES,
        ).parameters["a"]
        for loss in ("linear", "soft_l1")
    }
    assert abs(found["linear"] - 2.0) > 1.0  # which fits the outlier, too
    assert abs(found["soft_l1"] - 2.0) < 0.1 * abs(found["linear"] - 2.0)
    coarse = identify(
        line,
        EXPERIMENT,
        {"a": (0, 10)},
        progress=False,
        method="nelder-mead",
        method_options={"xatol": 0.1, "restarts": 0, "fatol": 1.0},
    )
    assert coarse.evaluations < 12
