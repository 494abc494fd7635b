"""Resampling and trimming where units matter: equal units, steps in them, and the sphere."""

from __future__ import annotations

import itertools
import math
import warnings

import numpy as np
import pytest

import curvewise
from curvewise import curves
from curvewise.curves.named_curve import NamedCurve

RADIUS = 6371008.8


def steps(curve: np.ndarray) -> np.ndarray:
    return np.hypot(*np.diff(curve, axis=0).T)


def metres(a: np.ndarray, b: np.ndarray) -> float:
    return curvewise.frechet([a], [b], metric="haversine")


def middle(a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """The middle of a great circle, by the textbook's formula of navigation."""
    (x, y), (u, v) = np.radians(a), np.radians(b)
    p, q = math.cos(v) * math.cos(u - x), math.cos(v) * math.sin(u - x)
    latitude = math.atan2(math.sin(y) + math.sin(v), math.hypot(math.cos(y) + p, q))
    longitude = x + math.atan2(q, math.cos(y) + p)
    return math.degrees(longitude), math.degrees(latitude)


def test_a_track_in_metres_has_equal_steps() -> None:
    track = [(0.0, 0.0), (1000.0, 0.0), (1000.0, 100.0)]
    right = [(100.0 * k, 0.0) for k in range(11)] + [(1000.0, 100.0)]
    for even in (
        curves.resample(track, 12, metric="euclidean"),
        curves.resample(track, spacing=100.0),
        curves.resample(track, spacing=100.0, metric="euclidean"),
    ):
        np.testing.assert_allclose(even, right, rtol=1e-13, atol=1e-10)
    by_box = curves.resample(track, 12)
    assert steps(by_box).max() > 5 * steps(by_box).min()  # each coordinate by its range


@pytest.mark.parametrize(
    ("length", "spacing", "count"), [(1.1, 0.1, 12), (1.0, 0.3, 5), (1.0, 7.0, 2), (0.3, 0.1, 4)]
)
def test_a_spacing_is_the_largest_step(length: float, spacing: float, count: int) -> None:
    line = curves.resample([(0.0, 0.0), (length, 0.0)], spacing=spacing)
    np.testing.assert_allclose(line[:, 0], np.linspace(0.0, length, count), rtol=1e-14)


def test_a_spacing_is_in_units_of_what_it_is_by() -> None:
    curve = [(0.0, 0.0), (1.0, 8.0), (2.0, 8.0), (0.0, 0.0)]
    by_time = curves.resample(curve, spacing=0.5, by=[0.0, 1.0, 2.0, 6.0])
    assert len(by_time) == 13
    by_column = curves.resample(curve, spacing=0.25, by=0, turns=[2])
    assert len(by_column) == 8 + 8 + 1
    assert by_column[8].tolist() == [2.0, 8.0]
    with pytest.raises(ValueError, match="spacing is 0; give a number > 0"):
        curves.resample(curve, spacing=0)
    for given in ({}, {"count": 3, "spacing": 1.0}):
        with pytest.raises(ValueError, match="give either count or spacing"):
            curves.resample(curve, **given)


def test_the_middle_of_a_great_circle() -> None:
    random = np.random.default_rng(0)
    for _ in range(60):
        a, b = random.uniform([-360, -90], [360, 90], (2, 2))
        x, y = curves.resample([a, b], 3, metric="haversine")[1]
        right = middle(a, b)
        assert -180.0 <= x <= 180.0
        assert metres((x, y), ((right[0] + 540.0) % 360.0 - 180.0, right[1])) < 1e-3


def test_known_middles_on_the_sphere() -> None:
    for a, b, right in (
        [(179.0, 0.0), (-179.0, 0.0), (180.0, 0.0)],
        [(359.0, 10.0), (1.0, 10.0), (0.0, 10.00149253)],
        [(181.0, 0.0), (177.0, 0.0), (179.0, 0.0)],
        [(0.0, 80.0), (180.0, 80.0), (90.0, 90.0)],  # over the pole, whose longitude is any
        [(10.0, -20.0), (10.0, 40.0), (10.0, 10.0)],
    ):
        x, y = curves.resample([a, b], 3, metric="haversine")[1]
        assert metres((x, y), right) < 0.01, (a, b)


def test_equal_arcs_along_a_track_and_ends_to_the_bit() -> None:
    steps_of_a_degree = np.random.default_rng(0).normal(size=(40, 2))
    track = np.cumsum(steps_of_a_degree, axis=0) + np.array([181.0, 50.0])
    track[:, 0] = (track[:, 0] + 180.0) % 360.0 - 180.0
    assert np.abs(np.diff(track[:, 0])).max() > 350.0  # it crosses the antimeridian
    turns = list(range(1, 39))  # no corner is cut off
    fine = curves.resample(track, spacing=20e3, metric="haversine", turns=turns)
    assert np.abs(fine[:, 0]).max() <= 180.0
    arcs = np.array([metres(a, b) for a, b in itertools.pairwise(fine)])
    assert arcs.max() < 20e3 * (1 + 1e-6)
    lengths = [metres(a, b) for a, b in itertools.pairwise(track)]
    assert arcs.sum() == pytest.approx(sum(lengths), rel=1e-12)
    for place in (0, *turns, -1):
        assert (fine == track[place]).all(axis=1).any()
    flat = curves.resample(track, 50, metric="haversine")
    moved = track.copy()
    moved[:, 0] = np.where(track[:, 0] < 0, track[:, 0] + 360.0, track[:, 0])  # 0 to 360
    again = curves.resample(moved, 50, metric="haversine")
    np.testing.assert_allclose(flat, again, rtol=0, atol=1e-9)


def test_equal_steps_of_a_long_arc() -> None:
    ends = [(20.0, -40.0), (-170.0, 60.0)]
    arc = curves.resample(ends, 14, metric="haversine")
    lengths = [metres(a, b) for a, b in itertools.pairwise(arc)]
    np.testing.assert_allclose(lengths, metres(*ends) / 13, rtol=1e-9)


def test_a_track_by_its_times() -> None:
    track, times = [(179.0, 0.0), (-179.0, 0.0), (-179.0, 4.0)], [0.0, 10.0, 20.0]
    by_time = curves.resample(track, 5, by=times, metric="haversine")
    right = [(179, 0), (180, 0), (-179, 0), (-179, 2), (-179, 4)]
    assert max(map(metres, by_time, right)) < 1e-6
    part = curves.trim(track, 5.0, 15.0, by=times, metric="haversine")
    assert max(map(metres, part, [(180, 0), (-179, 0), (-179, 2)])) < 1e-6
    whole = curves.trim(track, by=times, metric="haversine")
    assert whole.tolist() == [list(point) for point in track]


def test_names_stay() -> None:
    track = NamedCurve(np.array([(1.0, 2.0), (3.0, 4.0)]), ("lon", "lat"))
    assert curves.resample(track, 3, metric="haversine").column_names == ("lon", "lat")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"metric": "cityblock"}, "unknown metric 'cityblock'; choose from euclidean, haversine"),
        ({"metric": "haversine", "by": 0}, "metric='haversine' interpolates between points on"),
        ({"metric": "haversine", "by": [0.0, 2.0, 1.9]}, "reverse in branch 0, by 0.1 before"),
        ({"metric": "haversine", "curve": np.eye(3)}, "needs 2 coordinates, longitude and latitu"),
        ({"metric": "haversine", "curve": [(0, 0), (0, 91)]}, r"curve\[1, 1\] is 91; metric='hav"),
        ({"metric": "haversine", "curve": [(9, 5), (0, 0), (180, 0)]}, "points 1 and 2 are opposi"),
        ({"metric": "haversine", "curve": [(9, 5), (9, 5)]}, "constant in branch 0"),
    ],
)
def test_what_the_sphere_refuses(arguments, message) -> None:
    with pytest.raises(ValueError, match=message):
        curves.resample(**{"curve": [(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)], "count": 3} | arguments)


def test_longitudes_that_jump_are_asked_about() -> None:
    jump = r"looks like a longitude, and jumps by 358 between points 1 and 2; "
    track = [(178.0, 0.0), (179.0, 0.0), (-179.0, 0.0)]
    for call in (
        lambda: curves.resample(track, 3),
        lambda: curves.trim(track, by=[0, 1, 2]),
    ):
        with pytest.warns(UserWarning, match=jump) as met:
            call()
        assert met[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        curves.resample(track, 3, metric="euclidean")  # meant so
        curves.trim(track, by=[0, 1, 2], metric="euclidean")
        curves.resample([(178.0, 95.0), (179.0, 0.0), (-179.0, 0.0)], 3)  # 95 is not a latitude
        curves.resample([(178.0, 0.0), (900.0, 0.0)], 3)
        curves.resample([178.0, -178.0], 3)
        curves.resample([(0.0, 0.0, 0.0), (300.0, 0.0, 0.0)], 3)
