"""Misspelt names: the error, and the suggested name."""

from __future__ import annotations

import numpy as np
import pytest

from curvewise.calibration import (
    Criterion,
    DifferentialEvolution,
    LeastSquares,
    NelderMead,
    Objective,
    TrustRegion,
    identify,
    identify_each,
)
from curvewise.calibration.methods import method_with

X = np.linspace(0.0, 1.0, 20)


def line(parameters):
    return np.column_stack((X, parameters["a"] * X))


EXPERIMENT = line({"a": 2.0})
LINE = {"model": line, "experiments": EXPERIMENT, "bounds": {"a": (0, 10)}}


@pytest.mark.parametrize(
    ("keywords", "error", "message"),
    [
        ({"method": "trust_region"}, ValueError, "unknown method .*you mean 'trust-region'"),
        ({"method": "Nelder Mead"}, ValueError, "unknown method .*you mean 'nelder-mead'"),
        ({"measure": "freched"}, ValueError, "unknown measure .*you mean 'frechet'"),
        ({"preset": "raw"}, TypeError, r"keyword; use measure=Criterion\('area', preset=...\)"),
        ({"presett": "raw"}, TypeError, "area has no option 'presett'; .*you mean 'preset'"),
        (
            {"measure": Criterion(), "spacing": "x"},
            TypeError,
            "spacing given together with a Criterion",
        ),
        ({"max_run": 5}, TypeError, "no option 'max_run'.*'max_runs'"),
        ({"spaceing": "x"}, TypeError, "no option 'spaceing'; it has .*you mean 'spacing'"),
        ({"measure": "dtw", "windw": 3}, TypeError, "no option 'windw'.*you mean 'window'"),
        ({"measure": "sum_of_squares", "absissa": 0}, TypeError, "'absissa'.*you mean 'abscissa'"),
    ],
)
def test_the_near_name_is_offered(keywords, error, message):
    with pytest.raises(error, match=message):
        identify(**LINE, progress=False, **keywords)


@pytest.mark.parametrize(
    ("method", "options", "message"),
    [
        (TrustRegion, {"diffstep": 1}, "has no option diffstep; it has starts.*'diff_step'"),
        (DifferentialEvolution, {"pop_size": 3}, "'de' has no option pop_size; .*'popsize'"),
        (DifferentialEvolution, {"afetr": {"name": "sdrm"}}, "did you mean 'after'"),
        (NelderMead, {"sise": 3}, r"'nelder-mead' has no option sise; it has size.*'size'"),
        (LeastSquares, {"los": "huber"}, "'least-squares' has no option los; .*mean 'loss'"),
    ],
)
def test_the_near_option_is_offered(method, options, message):
    """Of a method as a table, in a study, and of options that are passed on."""
    with pytest.raises(ValueError, match=message):
        method_with({"name": method.name, **options})
    if "options" in vars(method()):
        with pytest.raises(ValueError, match=message):
            method(options=options)


NOT_DE = "options has popsize; give it to DifferentialEvolution"


@pytest.mark.parametrize(
    ("function", "keywords", "message"),
    [
        # The list of passed-on options does not contain own options.
        (DifferentialEvolution, {"options": {"mutatin": 1}}, "it has popsize, .*you mean 'mutat"),
        (DifferentialEvolution, {"options": {"popsize": 3}}, NOT_DE),
        # Nothing is offered where nothing is near.
        (identify, {**LINE, "method": "magic"}, "choose from .*nelder-mead$"),
        # Of the settings of a criterion, and of several measures.
        (Criterion, {"preset": "scald"}, "unknown preset .*you mean 'scaled'"),
        (Criterion, {"part": "simulations"}, "unknown part .*you mean 'simulation'"),
        (identify_each, {**LINE, "measures": ["dwt"]}, "unknown measure 'dwt'.*did you mean 'dtw'"),
    ],
)
def test_names_elsewhere(function, keywords, message):
    with pytest.raises(ValueError, match=message):
        function(**keywords)


def test_nothing_is_offered_where_nothing_is_near():
    with pytest.raises(TypeError, match=r"it has spacing, crossing, squared, closed, missing$"):
        Objective(EXPERIMENT, "area", wibble=1)


def test_options_of_scipy_are_passed_on():
    """Those that are offered are taken: a robust loss, and a tolerance of the simplex."""
    outlier = EXPERIMENT.copy()
    outlier[7, 1] += 40.0
    keywords = {**LINE, "progress": False}
    squares = {**keywords, "experiments": outlier, "measure": "sum_of_squares"}
    found = {
        loss: identify(**squares, method=LeastSquares(loss=loss, f_scale=0.01)).parameters["a"]
        for loss in ("linear", "soft_l1")
    }
    assert abs(found["linear"] - 2.0) > 1.0  # which fits the outlier, too
    assert abs(found["soft_l1"] - 2.0) < 0.1 * abs(found["linear"] - 2.0)
    method = NelderMead(restarts=0, options={"xatol": 0.1, "fatol": 1.0})
    coarse = identify(**keywords, method=method)
    assert coarse.evaluations < 12
