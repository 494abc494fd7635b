"""White noise by the area: its constants by quadrature and by draws, and the sandwich of both."""

from __future__ import annotations

import math

import numpy as np
import pytest

import curvewise
from curvewise.calibration.uncertainty.area_noise import (
    SECOND_DERIVATIVES,
    SLOPE_COVARIANCES,
    area_scatter,
)
from curvewise.calibration.uncertainty.repeats import Branches

COUNT = 400
BRANCHES = Branches([slice(0, COUNT)])


def area_between(a, b):
    """Return the area of straight pieces from errors a to errors b, one apart."""
    same = a * b >= 0
    crossed = (a**2 + b**2) / (2.0 * np.where(same, 1.0, np.abs(a) + np.abs(b)))
    return np.where(same, (np.abs(a) + np.abs(b)) / 2.0, crossed)


def slopes_of_area(noise):
    """Return the derivatives of the area by the errors of inner points."""
    step = 1e-6
    upper, lower = noise[1:-1] + step, noise[1:-1] - step
    change = area_between(noise[:-2], upper) - area_between(noise[:-2], lower)
    change += area_between(upper, noise[2:]) - area_between(lower, noise[2:])
    return change / (2.0 * step)


def test_the_area_is_that_of_straight_pieces_that_cross():
    errors = np.random.default_rng(0).normal(size=7)
    x = np.arange(7.0)
    test, other = np.column_stack((x, errors)), np.column_stack((x, np.zeros(7)))
    expected = area_between(errors[:-1], errors[1:]).sum()
    fine = np.column_stack((np.linspace(0, 6, 6001), np.interp(np.linspace(0, 6, 6001), x, errors)))
    flat = fine * (1.0, 0.0)
    assert curvewise.area(fine, flat) == pytest.approx(expected, rel=1e-3)
    assert curvewise.area(test, other) >= expected * (1.0 - 1e-12)


def test_covariances_of_slopes_are_those_of_draws():
    slopes = slopes_of_area(np.random.default_rng(1).normal(size=2_000_000))
    found = [np.mean(slopes[: len(slopes) - k] * slopes[k:]) for k in range(4)]
    assert found == pytest.approx([*SLOPE_COVARIANCES, 0.0], abs=2e-3)


def test_second_derivatives_are_those_of_the_integral():
    nodes, weights = np.polynomial.legendre.leggauss(30)
    t = (nodes + 1.0) / 2.0
    density = weights / 2.0 * np.sqrt(2.0 / math.pi / (t**2 + (1.0 - t) ** 2))
    expected = [2.0 * np.sum(density * t**2), np.sum(density * t * (1.0 - t))]
    assert expected == pytest.approx(SECOND_DERIVATIVES, abs=1e-4)


@pytest.mark.parametrize(
    ("slopes", "expected"),
    [
        (np.ones(COUNT), 1.217),
        (np.random.default_rng(2).choice((-1.0, 1.0), COUNT), 1.45),
        ((-1.0) ** np.arange(COUNT), 1.58),
    ],
    ids=["slow", "unrelated", "alternating"],
)
def test_the_variance_depends_on_how_slopes_go_on(slopes, expected):
    columns = slopes[:, np.newaxis]
    inverse = np.array([[1.0 / COUNT]])
    (variance,) = area_scatter(columns / COUNT, columns, inverse, BRANCHES).ravel()
    assert variance * COUNT == pytest.approx(expected, rel=0.03)


def test_estimates_by_the_area_scatter_so():
    """A line's height and slope, and noise that is drawn 400 times."""
    optimize = pytest.importorskip("scipy.optimize")
    x = np.linspace(-1.0, 1.0, 60)
    design, random = np.column_stack((np.ones(60), x)), np.random.default_rng(3)

    def fitted(noise):
        def area(parameters):
            left = noise - design @ parameters
            return float(area_between(left[:-1], left[1:]).sum())

        options = {"xatol": 1e-4, "fatol": 1e-4}
        return optimize.minimize(area, np.zeros(2), method="Nelder-Mead", options=options).x

    estimates = np.array([fitted(random.normal(size=60)) for _ in range(400)])
    inverse = np.linalg.inv(design.T @ design)
    expected = area_scatter(design @ inverse, design, inverse, Branches([slice(0, 60)]))
    ratio = estimates.var(axis=0) / np.diag(expected)
    assert ratio == pytest.approx([1.0, 1.0], abs=0.25)  # a variance of 400 is known to 7 %


def test_points_of_two_branches_are_no_neighbours():
    columns = np.random.default_rng(4).normal(size=(COUNT, 2))
    inverse = np.linalg.inv(columns.T @ columns)
    halves = Branches([slice(0, 1), slice(1, 200), slice(200, COUNT)])
    spread = np.insert(columns, [1, 1, 200, 200], 0.0, axis=0)
    moves = columns @ inverse
    apart = np.insert(moves, [1, 1, 200, 200], 0.0, axis=0)
    expected = area_scatter(apart, spread, inverse, Branches([slice(0, COUNT + 4)]))
    assert area_scatter(moves, columns, inverse, halves) == pytest.approx(expected, rel=1e-12)
