"""Ways to match two curves before the area between them is taken: those of `area`, and others.

Each takes P and Q, both scaled by P's box, and returns an area. `area_sampling.py` and
`area_landscapes.py` judge them. The others are prototypes in numpy; curvewise itself has the one
that was chosen.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

import curvewise

Array: TypeAlias = npt.NDArray[np.float64]
Matching: TypeAlias = Callable[[Array, Array], float]


def arc_lengths(curve: Array) -> Array:
    """Return the arc length at every vertex."""
    return np.concatenate(([0.0], np.hypot(*np.diff(curve, axis=0).T).cumsum()))


def at(curve: Array, positions: Array, wanted: Array) -> Array:
    """Return the points of a curve at wanted positions, of which its vertices have `positions`."""
    return np.column_stack([np.interp(wanted, positions, coordinate) for coordinate in curve.T])


def strip_areas(A: Array, B: Array) -> Array:
    """Return twice the signed areas at both ends of each strip between facing curves."""
    motion = np.diff(A + B, axis=0) / 2
    leash = B - A
    return np.array([_cross(motion, leash[:-1]), _cross(motion, leash[1:])])


def swept(A: Array, B: Array) -> float:
    """Return the area that the line between facing curves sweeps, forward or backward."""
    begin, end = strip_areas(A, B)
    total = np.abs(begin) + np.abs(end)
    crossed = (begin**2 + end**2) / np.where(total > 0, total, 1.0)
    return float(np.where(begin * end < 0, crossed, total).sum() / 2)


def net(A: Array, B: Array, places: Array, pieces: int) -> float:
    """Return the sum of the absolute areas of pieces between facing curves."""
    areas = np.concatenate(([0.0], strip_areas(A, B).mean(axis=0).cumsum()))
    return float(np.abs(np.diff(np.interp(np.linspace(0, 1, pieces + 1), places, areas))).sum())


def merged(P: Array, Q: Array, p: Array, q: Array) -> tuple[Array, Array, Array]:
    """Return facing curves: a vertex of each where the other has one; and their places."""
    # Where many vertices have one place, arc length tells them apart.
    p, q = (
        (1 - 1e-9) * u / u[-1] + 1e-9 * s / s[-1]
        for u, s in ((p, arc_lengths(P)), (q, arc_lengths(Q)))
    )
    places = np.union1d(p, q)
    return at(P, p, places), at(Q, q, places), places


def travelled(curve: Array) -> Array:
    """Return the sum of abs(dx) at every vertex."""
    return np.concatenate(([0.0], np.abs(np.diff(curve[:, 0])).cumsum()))


def by_strain(P: Array, Q: Array) -> float:
    """Match equal shares of the sum of abs(dx)."""
    return swept(*merged(P, Q, travelled(P), travelled(Q))[:2])


def one_way(curve: Array, least: float = 0.1) -> Array:
    """Return the sum of abs(dx), noise left out: from turn to turn x counts only at new extremes.

    A turn is followed by a reversal of at least `least`.
    """
    x = curve[:, 0]
    turns, low, high, rises = [0], 0, 0, None
    for i, value in enumerate(x):
        low, high = (i if value < x[low] else low), (i if value > x[high] else high)
        if rises is not False and value <= x[high] - least:
            turns.append(high)
            low, rises = i, False
        elif rises is not True and value >= x[low] + least:
            turns.append(low)
            high, rises = i, True
    turns = sorted({*turns, len(x) - 1})
    total, lengths = 0.0, np.zeros(len(x))
    for a, b in itertools.pairwise(turns):
        forward = np.sign(x[b] - x[a]) * (x[a : b + 1] - x[a])
        lengths[a : b + 1] = total + np.maximum.accumulate(np.maximum(forward, 0.0))
        total = lengths[b]
    return lengths


def by_legs(P: Array, Q: Array) -> float:
    """Match equal shares of the one-way sum of abs(dx); 50 pieces."""
    return net(*merged(P, Q, one_way(P), one_way(Q)), pieces=50)


def simplified(curve: Array, tolerance: float) -> npt.NDArray[np.intp]:
    """Return the vertices that Douglas and Peucker (1973) keep."""
    kept, parts = {0, len(curve) - 1}, [(0, len(curve) - 1)]
    while parts:
        a, b = parts.pop()
        if b - a < 2:
            continue
        chord, offsets = curve[b] - curve[a], curve[a + 1 : b] - curve[a]
        along = np.clip(offsets @ chord / max(float(chord @ chord), 1e-300), 0, 1)
        distances = np.hypot(*(offsets - along[:, np.newaxis] * chord).T)
        if distances.max() > tolerance:
            k = a + 1 + int(distances.argmax())
            kept.add(k)
            parts += [(a, k), (k, b)]
    return np.array(sorted(kept))


def by_simplified(P: Array, Q: Array, tolerance: float) -> float:
    """Match equal shares of the simplified curves' arc lengths."""
    positions = []
    for curve in (P, Q):
        kept = simplified(curve, tolerance)
        raw = arc_lengths(curve)
        positions.append(np.interp(raw, raw[kept], arc_lengths(curve[kept])))
    return swept(*merged(P, Q, *positions)[:2])


def smoothed(curve: Array, share: float) -> Array:
    """Return each vertex's mean of the curve over a share of its arc length, less at the ends."""
    lengths = arc_lengths(curve) + 1e-12 * np.arange(len(curve))
    half = np.minimum(np.minimum(lengths, lengths[-1] - lengths), lengths[-1] * share / 2)
    steps = np.diff(lengths)[:, np.newaxis]
    integral = np.vstack((np.zeros(2), ((curve[1:] + curve[:-1]) / 2 * steps).cumsum(axis=0)))

    def until(length: Array) -> Array:
        i = np.clip(np.searchsorted(lengths, length, side="right") - 1, 0, len(curve) - 2)
        beyond = (length - lengths[i])[:, np.newaxis]
        slope = (curve[i + 1] - curve[i]) / steps[i]
        return np.asarray(integral[i] + curve[i] * beyond + slope * beyond**2 / 2)

    means, inside = curve.copy(), half > 1e-9 * lengths[-1]
    sums = until((lengths + half)[inside]) - until((lengths - half)[inside])
    means[inside] = sums / (2 * half[inside])[:, np.newaxis]
    return means


def by_smoothed(P: Array, Q: Array, pieces: int | None) -> float:
    """Match equal shares of the smoothed curves' arc lengths."""
    lengths = (arc_lengths(smoothed(curve, 0.02)) for curve in (P, Q))
    A, B, places = merged(P, Q, *lengths)
    return swept(A, B) if pieces is None else net(A, B, places, pieces)


def by_leash(P: Array, Q: Array) -> float:
    """Sweep the leash of the DTW path."""
    path = curvewise.dtw_path(P, Q).path
    return swept(P[path[:, 0]], Q[path[:, 1]])


def by_shorter_leash(P: Array, Q: Array) -> float:
    """Integrate the leash of the DTW path along the shorter curve, taken as the smoother."""
    path = curvewise.dtw_path(P, Q).path
    A, B = P[path[:, 0]], Q[path[:, 1]]
    shorter = A if arc_lengths(P)[-1] < arc_lengths(Q)[-1] else B
    motion, leash = np.diff(shorter, axis=0), B - A
    return float(np.abs(_cross(motion, leash[:-1] + leash[1:])).sum() / 2)


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


MATCHINGS: Mapping[str, Matching] = {
    "distance, rearrange": curvewise.area,
    "distance, split": partial(curvewise.area, crossing="split"),
    "x, split": partial(curvewise.area, spacing="x", crossing="split"),
    "arc_length, split": partial(curvewise.area, spacing="arc_length", crossing="split"),
    "sum of |dx|": by_strain,
    "one-way |dx|, pieces": by_legs,
    "simplified to 2 %": partial(by_simplified, tolerance=0.02),
    "simplified to 5 %": partial(by_simplified, tolerance=0.05),
    "smoothed": partial(by_smoothed, pieces=None),
    "smoothed, pieces": partial(by_smoothed, pieces=50),
    "leash of dtw": by_leash,
    "leash along shorter": by_shorter_leash,
    "matched": partial(curvewise.area, spacing="matched"),
}
