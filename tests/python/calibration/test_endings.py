"""The reported end of a search, besides the method's own message."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_methods import quiet_identify

from curvewise import frechet
from curvewise.calibration import Criterion, Objective, Problem, TrustRegion
from curvewise.calibration.objective.sampling import sampling_of_tests
from curvewise.curves import resample

X = np.linspace(0.0, 1.0, 21)
LIMIT = "a third of the distance, so that points decide"
OFFSET = {"offset": (-5.0, 5.0)}
WAVE = np.outer(np.sin(2.0 * np.pi * X), (0.0, 1e-3))


def arch(p: dict[str, float], x: np.ndarray[Any, Any] = X) -> np.ndarray[Any, Any]:
    """Return a line that is bent by up to 0.16, which no offset takes back."""
    return np.column_stack((x, x + 0.64 * x * (1.0 - x) + p["offset"]))


def coarse_arch(p: dict[str, float]) -> np.ndarray[Any, Any]:
    return arch(p, np.linspace(0.0, 1.0, 5))


def line(count: int) -> np.ndarray[Any, Any]:
    x = np.linspace(0.0, 1.0, count)
    return np.column_stack((x, x))


def test_steps_that_are_longer_than_the_distance_are_counted():
    test = np.delete(line(9), 4, axis=0)  # steps of 0.18, one of them 0.35
    found = quiet_identify(arch, test, OFFSET, measure="frechet", max_runs=40)
    assert 0.05 < found.value < 0.17
    assert found.value == pytest.approx(frechet(test, arch(found.parameters)))
    steps = np.linalg.norm(np.diff(test, axis=0), axis=1)
    assert np.sum(steps > found.value / 3.0) == 7
    assert found.message.endswith(
        "; 7 steps of the test are longer than a third of the distance, so that points decide "
        "which minimum is lowest: resample it evenly to 100 points (curvewise.curves.resample), "
        "and let the model return as many"
    )
    even = resample(test, 100)
    assert np.linalg.norm(np.diff(even, axis=0), axis=1).max() < found.value / 3.0


def test_steps_up_to_a_third_of_the_distance_do_not_decide():
    found = quiet_identify(arch, line(25), OFFSET, measure="frechet", max_runs=40)
    step = np.sqrt(2.0) / 24
    assert found.value / 3.0 < step < found.value
    assert f"; 24 steps of the test are longer than {LIMIT}" in found.message
    found = quiet_identify(arch, line(81), OFFSET, measure="frechet", max_runs=40)
    assert "steps of the test" not in found.message


def test_steps_of_several_tests_are_counted_together():
    def arches(p):
        return [arch(p), arch(p)]

    found = quiet_identify(arches, [line(9), line(81)], OFFSET, measure="frechet", max_runs=40)
    assert f"; 8 steps of the tests are longer than {LIMIT}" in found.message
    assert "resample them evenly to 100 and 81 points" in found.message


@pytest.mark.nightly("a perfect fit|a good fit")
@pytest.mark.parametrize(
    ("test", "options"),
    [
        pytest.param(line(81), {"measure": "frechet"}, id="short steps"),
        pytest.param(line(9), {"measure": "frechet_continuous"}, id="no coupling of points"),
        pytest.param(line(9), {"measure": Criterion("frechet", metric="cityblock")}, id="options"),
        pytest.param(arch({"offset": 0.5}), {"measure": "frechet"}, id="a perfect fit"),
        pytest.param(arch({"offset": 0.5}) + WAVE, {"measure": "frechet"}, id="a good fit"),
    ],
)
def test_nothing_is_said_of_steps(test, options):
    found = quiet_identify(arch, test, OFFSET, max_runs=40, **options)
    assert "steps of the test" not in found.message


def test_steps_of_scaled_curves_are_in_sides_of_the_box():
    units = np.array((1e-3, 500.0))
    found = quiet_identify(
        lambda p: arch(p) * units, line(9) * units, OFFSET, measure="frechet", max_runs=40
    )
    assert f"; 8 steps of the test are longer than {LIMIT}" in found.message


def test_one_step_of_raw_curves():
    """Raw curves have steps in their own units."""
    test = np.array([(0.0, 0.0), (0.0, 10.0), (0.0, 11.0)])

    def points(p):
        return test + np.array((p["right"], 0.0))

    bounds = {"right": (4.0, 9.0)}
    criterion = Criterion("frechet", preset="raw")
    found = quiet_identify(points, test, bounds, measure=criterion, max_runs=20)
    assert found.value == pytest.approx(4.0)
    assert f"; 1 step of the test is longer than {LIMIT}" in found.message


def test_whoever_asks_and_tells_hears_the_same():
    bounds = {"offset": (0.7, 5.0)}
    problem = Problem.of(arch({"offset": 0.5}), bounds)
    search = TrustRegion().begin(problem)
    while not search.ended:
        for parameters in search.ask():
            search.tell(parameters, arch(parameters))
    answer = search.answer()
    assert not answer.converged
    assert answer.message.startswith("offset is at its lower bound: widen it if it is not meant (")
    found = quiet_identify(arch, arch({"offset": 0.5}), bounds)
    assert (found.converged, found.message) == (answer.converged, answer.message)


@pytest.mark.parametrize(
    ("distance", "expected"),
    [
        pytest.param(0.05, (0, 101), id="less than a third"),
        pytest.param(0.02, (100, 300), id="more than a third"),
        pytest.param(0.0036, (100, 1200), id="less than four"),
        pytest.param(0.0035, (0, 101), id="more than four"),
    ],
)
def test_which_steps_decide_and_how_many_points_would_be_enough(distance, expected):
    """Of steps of 0.01414; enough makes them a third, in hundreds."""
    objective = Objective([line(101)], "frechet")
    assert sampling_of_tests(objective, np.array([distance])) == [expected]


def test_nothing_is_said_of_simulations_that_have_fewer_points():
    found = quiet_identify(coarse_arch, line(81), OFFSET, measure="frechet", max_runs=40)
    assert "points" not in found.message


def test_where_the_distance_is_that_of_the_noise_more_points_would_not_help():
    """Steps of 0.0141 at a distance of 0.03: with noise of 0.01 in y, no step decides."""
    noise = np.random.default_rng(0).normal(0.0, 1.0, 101)
    for deviation, deciding in ((1e-3, 100), (0.01, 0)):
        test = line(101)
        test[:, 1] += deviation * noise
        objective = Objective([test], Criterion("frechet", preset="raw"))
        (sampling,) = sampling_of_tests(objective, np.array([0.03]))
        assert sampling.deciding == deciding
        assert sampling.enough == (101 if deciding == 0 else 200)
