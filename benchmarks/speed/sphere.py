"""Tracks on the globe: how many queries an exact index answers a second, and how right an arc is.

    python benchmarks/speed/sphere.py [index cells accuracy]

`index`: 20,000 GPS tracks in degrees, and all within 1 km of each of 200 others, by frechet and by
dtw; the answers of 20 are compared with a table of all distances. `cells`: the table of two tracks
of 4,000 points, beside metric="euclidean". `accuracy`: 20,000 random pairs of points, a metre to
half the globe apart, beside mpmath with 40 digits, in metres and ulp. All in one thread; half a
minute.
"""

from __future__ import annotations

import timing  # noqa: F401  before numpy: it sets the number of threads

# isort: split
import argparse
import time
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
from mpmath import cos, sin

import curvewise

Curve = np.ndarray[Any, np.dtype[np.float64]]
METRES_PER_DEGREE = 111_194.93


def tracks(count: int, seed: int) -> list[Curve]:
    """Make tracks of 40 to 160 points in a city of 40 km, some 30 m apart, on 2,000 routes."""
    rng = np.random.default_rng(seed)
    routes = np.random.default_rng(0)
    headings = routes.uniform(0, 2 * np.pi, size=(2000, 1))
    headings = headings + routes.normal(scale=0.25, size=(2000, 160)).cumsum(axis=1)
    starts = routes.uniform(-20e3, 20e3, size=(2000, 2))
    made = []
    for _ in range(count):
        route, n = rng.integers(2000), rng.integers(40, 161)
        heading = headings[route, :n]
        steps = 30 * np.column_stack([np.cos(heading), np.sin(heading)])
        metres = starts[route] + steps.cumsum(axis=0) + rng.normal(scale=8, size=(n, 2))
        longitude = 13.4 + metres[:, 0] / METRES_PER_DEGREE / np.cos(np.radians(52.5))
        made.append(np.column_stack([longitude, 52.5 + metres[:, 1] / METRES_PER_DEGREE]))
    return made


def seconds(call: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    found = call()
    return time.perf_counter() - start, found


def measure_index() -> None:
    kept, asked = tracks(20_000, 1), tracks(200, 2)
    # Within 1 km: a leash of 1 km; 1 km on average along the 100 steps of a path.
    for measure, radius in (("frechet", 1e3), ("dtw", 1e5)):
        built, index = seconds(lambda name=measure: curvewise.Index(kept, name, metric="haversine"))
        took, (distances, places) = seconds(
            lambda index=index, radius=radius: index.radius_neighbors(asked, radius)
        )
        table = curvewise.cdist(asked[:20], kept, measure, metric="haversine")
        for row, near, where in zip(table, distances, places, strict=False):
            order = np.argsort(row, kind="stable")
            order = order[row[order] <= radius]
            assert np.array_equal(order, where)
            assert np.array_equal(row[order], near)
        found = np.mean([len(near) for near in distances])
        print(
            f"index: {measure}, 20,000 tracks of 100 points, radius {radius / 1e3:g} km: built in "
            f"{built:.2f} s, {len(asked) / took:.0f} queries a second, {found:.0f} found by each"
        )


def measure_cells() -> None:
    rng = np.random.default_rng(3)
    P, Q = np.array([13.4, 52.5]) + rng.normal(scale=1e-3, size=(2, 4000, 2)).cumsum(axis=1)
    for measure in (curvewise.dtw, curvewise.frechet):
        for metric in ("euclidean", "haversine"):
            took = min(
                seconds(lambda m=measure, of=metric: m(P, Q, metric=of, prune=False))[0]
                for _ in range(5)
            )
            print(
                f"cells: {measure.__name__} {metric}: {P.shape[0] ** 2 / took / 1e9:.2f} Gcells/s"
            )


def exact_arc(p: Curve, q: Curve) -> Any:
    """Return the distance of two points by the angle between their vectors."""
    with mpmath.workdps(40):
        a, b = (
            (cos(up) * cos(along), cos(up) * sin(along), sin(up))
            for along, up in (map(mpmath.radians, map(mpmath.mpf, point)) for point in (p, q))
        )
        apart = mpmath.norm([x - y for x, y in zip(a, b, strict=True)])
        together = mpmath.norm([x + y for x, y in zip(a, b, strict=True)])
        return 2 * mpmath.atan2(apart, together) * mpmath.mpf(6371008.8)


def measure_accuracy() -> None:
    rng = np.random.default_rng(4)
    worst: dict[str, tuple[float, float]] = {}
    for _ in range(20_000):
        p = rng.uniform([-180, -90], [180, 90])
        reach = 10.0 ** rng.uniform(-5, 2.3)
        q = np.clip(p + rng.uniform(-reach, reach, 2), [-360, -90], [360, 90])
        ours = curvewise.dtw([p], [q], metric="haversine")
        error = float(abs(ours - exact_arc(p, q)))
        power = int(np.ceil(np.log10(max(ours, 1))))
        decade = "19,900 km and more" if ours > 1.99e7 else f"to 1e{power} m"
        metres, ulps = worst.get(decade, (0.0, 0.0))
        worst[decade] = (max(metres, error), max(ulps, error / np.spacing(max(ours, 1e-300))))
    for decade, (metres, ulps) in sorted(worst.items()):
        print(f"accuracy: {decade}: at most {metres:.2g} m, {ulps:.2g} ulp")


SECTIONS = {"index": measure_index, "cells": measure_cells, "accuracy": measure_accuracy}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("sections", nargs="*", choices=[[], *SECTIONS], metavar="section")
    for name in parser.parse_args().sections or SECTIONS:
        SECTIONS[name]()
