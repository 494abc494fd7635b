"""Intervals by dtw where points belong together one by one: a spatial median."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from curvewise.calibration import Objective, identify
from curvewise.calibration.uncertainty.directions import fitted_tests
from curvewise.calibration.uncertainty.paired import paired_scatter

PLACE = np.linspace(0.0, 1.0, 60)
SLOPES = np.stack((np.column_stack((PLACE, 1 - PLACE)), np.column_stack((PLACE**2, PLACE))), axis=2)


@pytest.mark.parametrize("deviations", [(1.0, 1.0), (0.3, 1.0), (1.0, 0.05)])
def test_the_scatter_of_a_spatial_median(deviations) -> None:
    random = np.random.default_rng(0)
    noise = random.normal(size=(400, len(PLACE), 2)) * deviations

    def total(move, one):
        return np.hypot(*(one - SLOPES @ move).T).sum()

    found = [minimize(total, np.zeros(2), one, method="Nelder-Mead").x for one in noise]
    expected = paired_scatter([(SLOPES, np.array(deviations), 1.0)])
    np.testing.assert_allclose(np.std(found, axis=0), np.sqrt(np.diag(expected)), rtol=0.15)
    scaled = paired_scatter([(SLOPES, np.array(deviations), 7.0)])
    np.testing.assert_allclose(scaled, expected)


def spring(parameters, leg=40):
    force = np.interp(np.arange(3 * leg + 1) / leg, range(4), (0.0, 100.0, -100.0, 100.0))
    return np.column_stack((force / parameters["k"] + parameters["c"] * force**3, force))


TRUTH = {"k": 50.0, "c": 1e-6}
BOUNDS = {"k": (20.0, 100.0), "c": (0.0, 1e-5)}


def test_noise_in_both_coordinates_is_told_apart() -> None:
    curve = spring(TRUTH)
    deviations = np.array([0.008, 0.002]) * np.ptp(curve, axis=0)
    test = curve + np.random.default_rng(1).normal(size=curve.shape) * deviations
    found = identify(spring, test, BOUNDS, measure="dtw", start=TRUTH, progress=False)
    said = found.uncertainty()
    assert said.sigma == pytest.approx(
        np.hypot(deviations[0] * np.ptp(test[:, 1]) / np.ptp(test[:, 0]), deviations[1]), rel=0.2
    )
    for name, value in TRUTH.items():
        low, high = said.intervals[name]
        assert low <= value <= high


def test_what_is_no_pair() -> None:
    curve = spring(TRUTH)
    noisy = curve + np.random.default_rng(0).normal(size=curve.shape) * (1e-3, 1.0)
    driven = np.column_stack((noisy[:, 0], curve[:, 1]))  # has the x of the test
    for fitted, is_paired in ((curve, True), (driven, False), (curve[::2], False)):
        ((_, _, _, pairs),) = fitted_tests(Objective([noisy], measure="dtw"), [fitted])
        assert (pairs is not None) == is_paired


def test_steps_shorter_than_the_noise_make_no_pairs() -> None:
    curve = spring(TRUTH, leg=1000)
    deviations = 0.01 * np.ptp(curve, axis=0)
    noisy = curve + np.random.default_rng(0).normal(size=curve.shape) * deviations
    ((_, _, _, pairs),) = fitted_tests(Objective([noisy], measure="dtw"), [curve])
    assert pairs is None
