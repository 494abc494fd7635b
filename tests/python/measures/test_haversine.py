"""Distances on the sphere: right to nanometres, and the same bits in every measure and way of it.

The arc is compared with mpmath with 40 digits. The rest is compared with the reference by ==, or
with brute force. The points are the difficult ones of the globe: the poles, the line of 180
degrees, opposite points, points that coincide, and tracks as dense as those of a GPS receiver.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

import curvewise
from curvewise import reference

Array = npt.NDArray[np.float64]
RADIUS = 6371008.8
SPHERE: dict[str, Any] = {"metric": "haversine"}

# Whole numbers of 30 degrees make ties, poles and opposite points; the others are anywhere.
POINTS = st.tuples(
    st.integers(-12, 12).map(lambda k: 30.0 * k) | st.floats(-360, 360),
    st.integers(-3, 3).map(lambda k: 30.0 * k) | st.floats(-90, 90),
)
CURVES = st.lists(POINTS, min_size=1, max_size=12).map(np.array)


def track(seed: int, points: int, centre: tuple[float, float] = (13.4, 52.5)) -> Array:
    """Return a walk of some ten metres a point, in degrees."""
    rng = np.random.default_rng(seed)
    return np.asarray(centre + rng.normal(scale=2e-4, size=(points, 2)).cumsum(axis=0))


def arc(p: tuple[float, float], q: tuple[float, float]) -> Any:
    """Return the distance of two points by the angle between their vectors, with 40 digits."""
    with mpmath.workdps(40):
        vectors = []
        for longitude, latitude in (p, q):
            along, up = mpmath.radians(mpmath.mpf(longitude)), mpmath.radians(mpmath.mpf(latitude))
            vectors.append(
                mpmath.matrix(
                    [
                        mpmath.cos(up) * mpmath.cos(along),
                        mpmath.cos(up) * mpmath.sin(along),
                        mpmath.sin(up),
                    ]
                )
            )
        a, b = vectors
        angle = 2 * mpmath.atan2(mpmath.norm(a - b), mpmath.norm(a + b))
        return angle * mpmath.mpf(RADIUS)


def distance(p: tuple[float, float], q: tuple[float, float], **options: Any) -> float:
    return curvewise.dtw([p], [q], **SPHERE, **options)


# The claims of docs/reference/measures/haversine.md: a distance in metres, and the largest
# error up to it.
ERRORS = ((5e6, 4e-9), (1.5e7, 16e-9), (1.99e7, 0.5e-6), (math.inf, 0.4))


def stated_error(length: float) -> float:
    return next(error for most, error in ERRORS if length <= most)


@given(POINTS, POINTS, st.integers(0, 12))
def test_errors_are_within_those_that_are_stated(
    p: tuple[float, float], q: tuple[float, float], nearness: int
) -> None:
    # From anywhere down to some ten micrometres, and as near to the opposite point.
    near = (p[0], p[1] + (q[1] - p[1]) * 10.0**-nearness)
    opposite = (near[0] - math.copysign(180.0, near[0]), -near[1])
    for other in (q, near, opposite):
        exact = arc(p, other)
        error = abs(mpmath.mpf(distance(p, other)) - exact)
        assert error <= stated_error(float(exact)), (p, other)


def test_stated_errors_at_every_distance(rounds: Callable[[int], int]) -> None:
    """Points spread evenly over distances, which seldom are large by themselves."""
    rng = np.random.default_rng(8)
    worst = dict.fromkeys(ERRORS, 0.0)
    for _ in range(rounds(1500)):
        p = (rng.uniform(-180, 180), math.degrees(math.asin(rng.uniform(-1, 1))))
        angle, along = math.acos(rng.uniform(-1, 1)), rng.uniform(0, 2 * math.pi)
        if rng.integers(2):
            angle = math.pi - 10.0 ** rng.uniform(-3, 0)
        q = destination(p, angle, along)
        exact = arc(p, q)
        error = float(abs(mpmath.mpf(distance(p, q)) - exact))
        limits = next(limits for limits in ERRORS if float(exact) <= limits[0])
        worst[limits] = max(worst[limits], error)
    for limits, error in worst.items():
        assert error <= limits[1], worst
        # Not stated far too large, either, except for the opposite point itself.
        assert limits[0] == math.inf or error > limits[1] / 8, worst


def destination(p: tuple[float, float], angle: float, along: float) -> tuple[float, float]:
    """Return the point that lies so far from another, in a direction from north to east."""
    up = math.radians(p[1])
    latitude = math.asin(
        math.sin(up) * math.cos(angle) + math.cos(up) * math.sin(angle) * math.cos(along)
    )
    turn = math.atan2(
        math.sin(along) * math.sin(angle) * math.cos(up),
        math.cos(angle) - math.sin(up) * math.sin(latitude),
    )
    return p[0] + math.degrees(turn), math.degrees(latitude)


def test_named_distances() -> None:
    quarter = math.pi / 2 * RADIUS
    assert distance((0, 0), (90, 0)) == pytest.approx(quarter, rel=1e-15)
    assert distance((17, 90), (-60, 0)) == pytest.approx(quarter, rel=1e-15)
    assert distance((0, 0), (180, 0)) == pytest.approx(2 * quarter, rel=1e-15)
    assert distance((10, 90), (200, 90)) == 0.0  # at the pole
    assert distance((-180, 5), (180, 5)) == 0.0
    assert distance((-90, 5), (270, 5)) == 0.0
    assert distance((0, 0), (0, 1), radius=180 / math.pi) == pytest.approx(1.0, rel=1e-15)
    # From Paris to Berlin, by the formula that the metric is named after.
    up, down = math.radians(48.8566), math.radians(52.52)
    along = math.radians(13.405 - 2.3522)
    h = math.sin((down - up) / 2) ** 2 + math.cos(up) * math.cos(down) * math.sin(along / 2) ** 2
    by_formula = 2 * RADIUS * math.asin(math.sqrt(h))
    assert distance((2.3522, 48.8566), (13.405, 52.52)) == pytest.approx(by_formula, rel=1e-14)


def test_rounding_never_turns_the_order_of_two_arcs() -> None:
    from curvewise.curves.sphere import arcs

    rng = np.random.default_rng(3)
    starts = np.concatenate(
        [rng.random(200), rng.random(200) ** 8, 0.5 + rng.normal(size=50) / 1e14]
    )
    steps = np.arange(2000)
    for start in [*starts, 0.25, 0.5, 1.0 - 2.0**-40]:
        squares = (np.float64(start).view(np.int64) + steps).view(np.float64)
        assert (np.diff(arcs(squares, 1.0)) >= 0).all(), start


@given(CURVES, CURVES, st.sampled_from(["symmetric1", "symmetric2", "typeIIa"]))
def test_warpings_equal_the_reference_to_the_bit(P: Array, Q: Array, pattern: str) -> None:
    for name in ("dtw", "frechet"):
        options = SPHERE | ({"step_pattern": pattern} if name == "dtw" else {})
        for suffix in ("", "_table"):
            ours = getattr(curvewise, name + suffix)(P, Q, **options)
            assert np.array_equal(ours, getattr(reference, name + suffix)(P, Q, **options))
        ours, theirs = (
            getattr(of, f"{name}_path")(P, Q, **options) for of in (curvewise, reference)
        )
        assert ours.distance == theirs.distance
        assert np.array_equal(ours.path, theirs.path)
    assert curvewise.hausdorff(P, Q, **SPHERE) == reference.hausdorff(P, Q, **SPHERE)


@given(CURVES, CURVES, st.floats(0, 2e7), st.floats(-90, 90))
def test_edit_distances_equal_the_reference_to_the_bit(
    P: Array, Q: Array, length: float, gap: float
) -> None:
    options: dict[str, dict[str, Any]] = {
        "erp": {"gap": gap},
        "edr": {"epsilon": length},
        "lcss": {"epsilon": length, "radius": 1e6},
        "twe": {"penalty": length},
        "wdtw": {"steepness": 0.0},
    }
    for name, more in options.items():
        ours, theirs = (getattr(of, name)(P, Q, **SPHERE, **more) for of in (curvewise, reference))
        assert ours == theirs, name


def test_lengths_at_the_edges_of_vectors_and_strips() -> None:
    for n, m in ((7, 9), (33, 31), (256, 255), (257, 130)):
        P, Q = track(n, n), track(m, m)
        for measure in ("dtw", "frechet", "hausdorff"):
            ours, theirs = (getattr(of, measure)(P, Q, **SPHERE) for of in (curvewise, reference))
            assert ours == theirs
    P, Q = track(1, 20), track(2, 150)
    for measure in ("dtw", "frechet"):
        ours, theirs = (
            [(run.distance, run.start, run.stop) for run in of.subsequence(P, Q, **options)]
            for of, options in (
                (curvewise, {"k": 4, "measure": measure, **SPHERE}),
                (reference.nearest, {"k": 4, "measure": measure, **SPHERE}),
            )
        )
        assert ours == theirs


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
@pytest.mark.parametrize("centre", [(13.4, 52.5), (179.99, -17.0), (40.0, 89.99)])
def test_pruning_changes_no_bit_of_long_tracks(measure: str, centre: tuple[float, float]) -> None:
    P = np.clip(track(7, 3000, centre), [-360, -90], [360, 90])
    Q = P[: len(P) : 2] + 1e-6
    Q = np.clip(Q, [-360, -90], [360, 90])
    function: Callable[..., float] = getattr(curvewise, measure)
    value = function(P, Q, prune=False, **SPHERE)
    assert function(P, Q, **SPHERE) == value
    assert function(P, Q, cutoff=value, **SPHERE) == value
    assert function(P, Q, cutoff=np.nextafter(value, 0), **SPHERE) == np.inf
    path = getattr(curvewise, f"{measure}_path")
    slow, fast = (path(P, Q, prune=prune, **SPHERE) for prune in (False, True))
    assert fast.distance == slow.distance == value
    assert np.array_equal(fast.path, slow.path)


@pytest.mark.parametrize(
    ("measure", "options"),
    [
        ("dtw", {}),
        ("dtw", {"window": 5, "radius": 1.0}),
        ("dtw", {"step_pattern": "symmetric2", "normalize": True}),
        ("frechet", {}),
        ("hausdorff", {"radius": 1.0}),
    ],
    ids=str,
)
def test_an_index_finds_what_brute_force_finds(measure: str, options: dict[str, Any]) -> None:
    # All about the line of 180 degrees, and around a pole.
    tracks = [track(seed, 40 + seed % 9, (179.9, 10 + seed % 5 / 100)) for seed in range(60)]
    around = np.linspace(-180, 180, 50)
    tracks += [np.column_stack([around, np.full(50, 89 + seed / 40)]) for seed in range(20)]
    index = curvewise.Index(tracks, measure, **SPHERE, **options)
    table = curvewise.cdist(tracks[::7], tracks, measure, **SPHERE, **options)
    distances, places = index.kneighbors(tracks[::7], n_neighbors=6)
    order = np.argsort(table, axis=1, kind="stable")[:, :6]
    assert np.array_equal(places, order)
    assert np.array_equal(distances, np.take_along_axis(table, order, axis=1))
    limit = float(np.median(table[:, :60]))
    near, _ = index.radius_neighbors(tracks[::7], limit)
    for row, found in zip(table, near, strict=True):
        assert np.array_equal(found, np.sort(row[row <= limit], kind="stable"))
    function = getattr(curvewise, measure)
    assert table[1, 5] == function(tracks[7], tracks[5], **SPHERE, **options)


@pytest.mark.parametrize("measure", ["dtw", "frechet"])
def test_derivatives_are_those_of_the_distance(measure: Any) -> None:
    rng = np.random.default_rng(8)
    P, Q = rng.uniform(-80, 80, (2, 6, 2))
    found = curvewise.values_and_gradients(P[np.newaxis], Q[np.newaxis], measure, **SPHERE)
    value, by_p, by_q = (part[0] for part in found)
    function = getattr(curvewise, measure)
    assert value == function(P, Q, **SPHERE)
    step = 1e-6
    for which, gradient in ((0, by_p), (1, by_q)):
        for place in np.ndindex(6, 2):
            moved = np.zeros((2, 2, 6, 2))
            moved[0, which][place], moved[1, which][place] = step, -step
            up, down = (function(P + dP, Q + dQ, **SPHERE) for dP, dQ in moved)
            assert gradient[place] == pytest.approx((up - down) / (2 * step), rel=1e-6, abs=1e-2)


@pytest.mark.parametrize("of", [curvewise, reference])
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0, 1], [0, 1]), r"P has shape \(2,\) and Q has shape \(2,\); frechet with metric='hav"),
        (([(0, 0, 0)], [(0, 0, 0)]), "needs 2 coordinates, longitude and latitude"),
        (([(0, 0), (5, 91)], [(0, 0)]), r"P\[1, 1\] is 91; .*latitudes are from -90 to 90 degrees"),
        (([(0, 0)], [(361, 0)]), r"Q\[0, 0\] is 361; .*longitudes are from -360 to 360 degrees"),
    ],
    ids=["numbers", "space", "latitude", "longitude"],
)
def test_what_is_no_point_of_the_sphere_is_refused(of: Any, arguments: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        of.frechet(*arguments, **SPHERE)


@pytest.mark.parametrize("of", [curvewise, reference])
def test_options_that_mean_nothing_on_the_sphere_are_refused(of: Any) -> None:
    P = [(0, 0), (1, 1)]
    for radius in (0, -1, math.nan, math.inf, "1"):
        with pytest.raises(ValueError, match=f"radius is {radius!r}; give a finite number > 0"):
            of.dtw(P, P, radius=radius, **SPHERE)
    with pytest.raises(ValueError, match="radius applies to metric='haversine' only, not to 'euc"):
        of.dtw(P, P, radius=1)
    with pytest.raises(ValueError, match="p applies to metric='minkowski' only, not to 'haversine"):
        of.dtw(P, P, p=2, **SPHERE)
    with pytest.raises(ValueError, match="edr with metric='haversine' needs epsilon"):
        of.edr(P, P, **SPHERE)
    with pytest.raises(ValueError, match=r"gap is 90\.5; .*give a number from -90 to 90"):
        of.erp(P, P, gap=90.5, **SPHERE)
