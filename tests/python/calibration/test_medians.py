"""Noise and medians: the area's sums against kernel and reference; scatter, also of pairs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import optimize

import curvewise
from curvewise.calibration import Criterion, identify
from curvewise.calibration.objective.objective import Objective
from curvewise.calibration.uncertainty.directions import fitted_tests
from curvewise.calibration.uncertainty.estimate import estimate_of
from curvewise.calibration.uncertainty.medians import (
    NoisyCurve,
    area_scatter,
    paired_scatter,
    sums_of_pieces,
)
from curvewise.calibration.uncertainty.noise import noise_of
from curvewise.calibration.uncertainty.sensitivity import moves_of
from curvewise.reference.matched_curves import matched_curves


def line(count):
    """Return a straight line that travels two sides of its box: 20 pieces."""
    x = np.linspace(0.0, 1.0, count)
    return np.column_stack((x, x))


def loop(count):
    """Return a curve that turns twice; none of its points ends a piece."""
    x = np.abs(np.mod(np.linspace(0.2, 2.7, count), 2.0) - 1.0)
    return np.column_stack((x, np.sin(np.linspace(0.0, 7.0, count)) + x))


def along_y(curve, size=1.0):
    return size * np.column_stack((np.zeros(len(curve)), np.ones(len(curve))))


def noisy(curve, slopes, cost=1.0, test=None):
    return NoisyCurve(curve if test is None else test, curve, along_y(curve), slopes, cost)


CURVES = {"line": line(47), "loop": loop(160), "few": loop(9), "two": line(2)}
CURVES["repeated"] = np.repeat(CURVES["loop"], 2, axis=0)


@pytest.mark.parametrize("name", CURVES)
def test_pieces_are_those_of_the_measure(name):
    curve = CURVES[name]
    sums = sums_of_pieces(curve, curve, along_y(curve))
    assert sums.shape == (len(matched_curves(curve, curve)[2]), len(curve))
    # Of so little noise the warping path knows nothing.
    noise = 1e-7 * np.random.default_rng(0).normal(size=len(curve))
    moved = curve + np.column_stack((np.zeros(len(curve)), noise))
    expected = curvewise.area(curve, moved, spacing="matched")
    assert np.abs(sums @ noise).sum() == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("name", CURVES)
def test_points_may_move_in_any_direction(name):
    curve, random = CURVES[name], np.random.default_rng(8)
    moves = random.normal(size=curve.shape)
    sums = sums_of_pieces(curve, curve, moves)
    noise = 1e-7 * random.normal(size=len(curve))
    expected = curvewise.area(curve, curve + noise[:, np.newaxis] * moves, spacing="matched")
    assert np.abs(sums @ noise).sum() == pytest.approx(expected, rel=1e-4)
    turned = sums_of_pieces(curve[:, ::-1], curve[:, ::-1], moves[:, ::-1])
    assert turned.toarray() == pytest.approx(-sums.toarray(), abs=1e-14)


def test_points_that_move_along_a_line_enclose_nothing():
    curve = line(47)
    assert np.abs(sums_of_pieces(curve, curve, curve).toarray()).max() < 1e-16


def test_a_single_point_encloses_nothing():
    still = np.zeros((5, 2))
    assert sums_of_pieces(CURVES["loop"], still, along_y(still)).nnz == 0


def test_of_many_points_a_piece_it_is_a_median_of_twenty_means():
    curve = line(4001)
    scatter = area_scatter([noisy(curve, np.ones((4001, 1)))])
    assert scatter.item() * 4000 == pytest.approx(math.pi / 2.0, rel=0.01)


def test_two_tests_tell_twice_as_much_and_one_that_costs_nothing_tells_nothing():
    one = noisy(line(150), np.column_stack((np.ones(150), np.linspace(-1.0, 1.0, 150))))
    alone = area_scatter([one])
    assert area_scatter([one, one]) == pytest.approx(alone / 2.0, rel=1e-12)
    assert area_scatter([one, one._replace(cost=0.0)]) == pytest.approx(alone, rel=1e-12)


def test_units_and_the_cost_of_a_single_test_do_not_matter():
    slopes = np.random.default_rng(1).normal(size=(160, 3))
    expected = area_scatter([noisy(CURVES["loop"], slopes)])
    other = area_scatter([noisy(CURVES["loop"] * (1e-3, 500.0), slopes, cost=7.0)])
    assert other == pytest.approx(expected, rel=1e-6)  # arcsines near 1


def test_fewer_pieces_than_parameters_say_nothing():
    slopes = np.random.default_rng(2).normal(size=(47, 21))
    assert area_scatter([noisy(CURVES["line"], slopes)]) is None


def test_the_scatter_is_the_sandwich_of_dense_matrices():
    """Of signs: 2 phi(0) times the slopes inside, and covariances of (2 / pi) arcsin outside."""
    curve = CURVES["loop"]
    slopes = np.random.default_rng(7).normal(size=(len(curve), 3))
    sums = sums_of_pieces(curve, curve, along_y(curve)).toarray()
    together = sums @ sums.T
    deviations = np.sqrt(np.diag(together))
    by_place = sums @ slopes
    bent = (by_place.T * (math.sqrt(2.0 / math.pi) / deviations)) @ by_place
    signs = 2.0 / math.pi * np.arcsin(np.clip(together / np.outer(deviations, deviations), -1, 1))
    expected = np.linalg.inv(bent) @ by_place.T @ signs @ by_place @ np.linalg.inv(bent)
    assert area_scatter([noisy(curve, slopes)]) == pytest.approx(expected, rel=1e-6)


def test_medians_of_pieces_scatter_so():
    """A loop's height and two waves: linear programs of 400 draws."""
    curve, random = CURVES["loop"], np.random.default_rng(3)
    t = np.linspace(0.0, 1.0, len(curve))
    slopes = np.column_stack((np.ones(len(t)), np.sin(5.0 * t), np.cos(9.0 * t)))
    sums = sums_of_pieces(curve, curve, along_y(curve))
    A, one = sums @ slopes, np.eye(sums.shape[0])
    above = np.block([[A, -one], [-A, -one]])
    cost, sides = np.r_[np.zeros(3), np.ones(len(A))], [(None, None)] * 3 + [(0.0, None)] * len(A)

    def fitted(noise):
        right = np.r_[sums @ noise, -(sums @ noise)]
        return optimize.linprog(cost, A_ub=above, b_ub=right, bounds=sides).x[:3]

    estimates = np.array([fitted(random.normal(size=len(t))) for _ in range(400)])
    ratio = estimates.var(axis=0) / np.diag(area_scatter([noisy(curve, slopes)]))
    assert ratio == pytest.approx(np.ones(3), abs=0.25)  # a variance of 400 is known to 7 %


def test_estimates_by_the_measure_scatter_so():
    """The height and the slope of a line, by the compiled area itself, of 300 tests."""
    curve, random = line(100), np.random.default_rng(4)
    x = curve[:, 0] - 0.5
    slopes = np.column_stack((np.ones(100), x))
    sigma = 0.005
    scatter = area_scatter([noisy(curve, slopes / sigma)])
    step = np.sqrt(np.diag(scatter))

    def fitted():
        test = curve + np.column_stack((np.zeros(100), random.normal(0.0, sigma, 100)))

        def area(place):
            moved = curve + np.column_stack((np.zeros(100), slopes @ (step * place)))
            return curvewise.area(test, moved, spacing="matched")

        simplex = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)]
        options = {"initial_simplex": simplex, "xatol": 1e-3, "fatol": 1e-9}
        return optimize.minimize(area, (0.0, 0.0), method="Nelder-Mead", options=options).x

    estimates = np.array([fitted() for _ in range(300)])
    # It finds the nearest local minimum: these have the size of a tenth of a deviation.
    assert estimates.var(axis=0) == pytest.approx(np.ones(2), abs=0.3)


def test_moves_are_those_of_weighted_least_squares_and_end_at_the_bounds():
    random = np.random.default_rng(5)
    weights, slopes = random.uniform(0.5, 2.0, 30), random.normal(size=(30, 3))
    squared = weights[:, np.newaxis] ** 2 * slopes
    moves, inverse = moves_of(weights, slopes)
    assert inverse == pytest.approx(np.linalg.inv(slopes.T @ squared), rel=1e-9)
    assert moves == pytest.approx(squared @ inverse, rel=1e-9)
    moves, _ = moves_of(weights, slopes * (1.0, 1.0, 1e-12))
    assert np.abs(moves).max() < 2.0


def straight(parameters):
    curve = line(60)
    curve[:, 1] = parameters["height"] + parameters["slope"] * curve[:, 0]
    return curve


BOUNDS = {"height": (-1.0, 1.0), "slope": (0.1, 3.0)}


def found_by(measure, test, **options):
    return identify(straight, [test], BOUNDS, measure=measure, progress=False, **options)


def white_test():
    test = straight({"height": 0.1, "slope": 1.0})
    test[:, 1] += np.random.default_rng(6).normal(0.0, 0.01, 60)
    return test


def estimate(found):
    optimum = found.uncertainty().optimum
    return estimate_of(optimum, noise_of(optimum, None))


def test_white_noise_of_an_area_of_pieces_alone_has_their_scatter():
    found = found_by("area", white_test())
    theirs = estimate(found)
    assert theirs.correlation.is_white
    slopes = theirs.slopes
    scatter = area_scatter([noisy(straight(found.parameters), slopes, test=white_test())])
    assert theirs.covariance == pytest.approx(theirs.correlation.variance * scatter, rel=1e-9)
    points = math.pi / 2.0 * theirs.correlation.variance * theirs.moves.T @ theirs.moves
    assert np.diag(theirs.covariance) != pytest.approx(np.diag(points), rel=0.01)
    # Algorithm 1 does not use pieces, and autocorrelated residuals are not white noise.
    plain = estimate(found_by(Criterion("area", spacing="x", crossing="split"), white_test()))
    points = math.pi / 2.0 * plain.correlation.variance * plain.moves.T @ plain.moves
    assert plain.covariance == pytest.approx(points, rel=1e-9)
    wave = straight({"height": 0.1, "slope": 1.0})
    wave[:, 1] += 0.01 * np.sin(np.linspace(0.0, 40.0, 60))
    alike = estimate(found_by("area", wave))
    assert not alike.correlation.is_white
    expected = alike.correlation.scatter(alike.moves, of_median=True)
    assert alike.covariance == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("measure", "expected"),
    [
        ("area", True),
        (Criterion("area", squared=True), False),
        (Criterion("area", spacing="arc_length"), False),
        (Criterion("area", preset="paper"), False),
        ("dtw", False),
        ("sum_of_squares", False),
    ],
)
def test_an_objective_says_whether_it_adds_up_pieces(measure, expected):
    assert Objective([line(20)], measure).is_area_of_pieces is expected


PLACE = np.linspace(0.0, 1.0, 60)
SLOPES = np.stack((np.column_stack((PLACE, 1 - PLACE)), np.column_stack((PLACE**2, PLACE))), axis=2)


@pytest.mark.parametrize("deviations", [(1.0, 1.0), (0.3, 1.0), (1.0, 0.05)])
def test_the_scatter_of_a_spatial_median(deviations) -> None:
    random = np.random.default_rng(0)
    noise = random.normal(size=(400, len(PLACE), 2)) * deviations

    def total(move, one):
        return np.hypot(*(one - SLOPES @ move).T).sum()

    found = [optimize.minimize(total, np.zeros(2), one, method="Nelder-Mead").x for one in noise]
    expected = paired_scatter([(SLOPES, np.array(deviations), 1.0)])
    np.testing.assert_allclose(np.std(found, axis=0), np.sqrt(np.diag(expected)), rtol=0.15)
    scaled = paired_scatter([(SLOPES, np.array(deviations), 7.0)])
    np.testing.assert_allclose(scaled, expected)


def spring(parameters, leg=40):
    force = np.interp(np.arange(3 * leg + 1) / leg, range(4), (0.0, 100.0, -100.0, 100.0))
    return np.column_stack((force / parameters["k"] + parameters["c"] * force**3, force))


SPRING = {"k": 50.0, "c": 1e-6}
SPRING_BOUNDS = {"k": (20.0, 100.0), "c": (0.0, 1e-5)}


def test_noise_in_both_coordinates_is_told_apart() -> None:
    curve = spring(SPRING)
    deviations = np.array([0.008, 0.002]) * np.ptp(curve, axis=0)
    test = curve + np.random.default_rng(1).normal(size=curve.shape) * deviations
    found = identify(spring, test, SPRING_BOUNDS, measure="dtw", start=SPRING, progress=False)
    said = found.uncertainty()
    assert said.sigma == pytest.approx(
        np.hypot(deviations[0] * np.ptp(test[:, 1]) / np.ptp(test[:, 0]), deviations[1]), rel=0.2
    )
    for name, value in SPRING.items():
        low, high = said.intervals[name]
        assert low <= value <= high


def test_what_is_no_pair() -> None:
    curve = spring(SPRING)
    measured = curve + np.random.default_rng(0).normal(size=curve.shape) * (1e-3, 1.0)
    driven = np.column_stack((measured[:, 0], curve[:, 1]))  # has the x of the test
    for fitted, is_paired in ((curve, True), (driven, False), (curve[::2], False)):
        ((_, _, _, pairs),) = fitted_tests(Objective([measured], measure="dtw"), [fitted])
        assert (pairs is not None) == is_paired


def test_steps_shorter_than_the_noise_make_no_pairs() -> None:
    curve = spring(SPRING, leg=1000)
    deviations = 0.01 * np.ptp(curve, axis=0)
    measured = curve + np.random.default_rng(0).normal(size=curve.shape) * deviations
    ((_, _, _, pairs),) = fitted_tests(Objective([measured], measure="dtw"), [curve])
    assert pairs is None
