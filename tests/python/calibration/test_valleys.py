"""Valleys beside each other on surfaces, and the evolution strategy that looks for them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.methods.curve_descent import CurveRuns
from curvewise.calibration.methods.starts import End
from curvewise.calibration.methods.valleys import lowest_valley
from curvewise.calibration.problem.ledger import Finish
from curvewise.calibration.surfaces.evolution import evolved
from curvewise.calibration.surfaces.kriged_surface import KrigedSurface

# Two points, too far apart for any other coupling: the longer of two distances counts.
TEST = np.array([[0.0, 0.0], [100.0, 0.0]])


def simulated(p: float) -> np.ndarray:
    """Minima near 0.2 and 0.7, of 0.08 and 0.03, with 0.6 between them."""
    return np.column_stack((TEST[:, 0], [10.0 * (p - 0.2) * (p - 0.7), 0.1 * (1.0 - p)]))


def lowest(places: list[float], *, ends: list[float], gain: float = 1e-3) -> np.ndarray | None:
    """Return the lowest valley of the surface through runs at some places."""
    objective = Objective(TEST, Criterion("frechet", preset="raw"))
    runs = [
        SimpleNamespace(failed=False, simulations=[simulated(p)], value=objective([simulated(p)]))
        for p in places
    ]
    best = min(range(len(runs)), key=lambda i: runs[i].value)
    ledger: Any = SimpleNamespace(
        dimensions=1,
        has_slopes=False,
        earlier_runs=[(np.array([p]), run) for p, run in zip(places, runs, strict=True)],
        objective=objective,
        best=runs[best],
        best_unit=np.array([places[best]]),
        show_activity=lambda: None,
    )
    begun = [End(1.0, 0.5, np.array([p]), Finish(True, "")) for p in ends]
    return lowest_valley(
        ledger, np.random.default_rng(0), CurveRuns(ledger), begun, [np.array([0.95])], gain
    )


RUNS = [0.0, 0.15, 0.2, 0.4, 0.8, 1.0]


def test_it_begins_in_the_lower_valley_that_the_surface_shows():
    """Beside the end of another start, behind a ridge; the model was not run there."""
    np.testing.assert_allclose(lowest(RUNS, ends=[0.8]), [0.7], atol=0.02)


@pytest.mark.parametrize(
    ("places", "gain"),
    [
        ([*RUNS, 0.203, 0.703], 1e-3),  # both valleys are known
        (RUNS, 0.9),  # what is to be gained does not count
    ],
)
def test_where_the_surface_promises_nothing_there_is_no_place(places, gain):
    assert lowest(places, ends=[0.8], gain=gain) is None


@pytest.mark.parametrize("k", [1, 2, 8])
def test_a_population_finds_the_bottom_of_a_narrow_valley(k):
    """Askew, with axes of 1 to 100, its bottom at a bound for one parameter.

    In two thirds of the generations that it takes where the members do not shape its covariance.
    """
    bottom = np.linspace(0.0, 0.7, k)
    turned = np.linalg.qr(np.random.default_rng(1).normal(size=(k, k)))[0]
    scales = np.geomspace(1.0, 100.0, k)

    def function(points: np.ndarray) -> np.ndarray:
        assert points.min() >= 0.0
        assert points.max() <= 1.0
        return np.square((points - bottom) @ turned * scales).sum(axis=1)

    found = evolved(
        function,
        np.full(k, 0.5),
        0.1,
        np.random.default_rng(0),
        members=16,
        generations=200,
    )
    np.testing.assert_allclose(found, bottom, atol=1e-3)


def test_it_never_returns_more_than_the_lowest_of_what_it_has_seen():
    seen: list[float] = []

    def stepped(points: np.ndarray) -> np.ndarray:
        values = np.floor(9.0 * points).sum(axis=1)
        seen.extend(values)
        return values

    found = evolved(
        stepped, np.full(3, 0.9), 0.05, np.random.default_rng(0), members=6, generations=20
    )
    assert stepped(found[np.newaxis])[0] == min(seen) < 18.0
    assert len(seen) <= 6 * 20 + 1


def test_a_surface_at_several_points_is_that_at_each():
    random = np.random.default_rng(0)
    places, curves = random.random((9, 3)), random.random((9, 5))
    surface = KrigedSurface(places, curves, places[0], reduced=False)
    points = random.random((4, 3))
    each = np.array([surface.at(point) for point in points])
    np.testing.assert_allclose(surface.at(points), each, rtol=1e-9)
