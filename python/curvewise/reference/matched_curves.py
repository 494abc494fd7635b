"""Two curves matched by a warping path, for the matched area.

The option is `spacing="matched"`. A simulation has other increments than the test, and a test has
noise. Refinement compares corresponding places only if both curves were sampled in the same way.
Arc length does so only if neither has noise, because noise adds length. Here both are resampled at
equal fractions of their arc lengths, and the path of dynamic time warping finds corresponding
samples.

Coordinates are scaled by P's bounding box. The path is that of :func:`dtw_path` with the ground
distance abs(dx) + abs(dy), on coordinates rounded to 30 bits. Rounding errors therefore do not
decide between two paths of equal cost. It is cut into sections that are short, a tenth of the box,
but long compared with the spacing of noisy points. Areas within a section are added with their
signs, so that the contributions of noise cancel.

Time and memory O(n + m + k²), where k = 50 T samples are matched and T is the number of widths and
heights of its box that P travels. If T is above 280, the places of matched samples differ by at
most 1e8 / k.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..curves.arc_length import arc_lengths, interpolate, locate
from ..curves.inputs import Array
from ..curves.scaling import box_scaled
from ..curves.travel import GRID, on_grid, travel_on_grid
from .dtw import dtw_path

__all__ = ["MatchedCurves", "matched_curves"]

Indices = npt.NDArray[np.intp]

_PIECES_PER_SIDE = 10  # of the box
_SAMPLES_PER_PIECE = 5
_MOST_CELLS = 200_000_000  # of the table of the warping path
# Further away, in boxes, than any point that could be matched to advantage; keeps sums finite.
_FAR = 2.0**40


class MatchedCurves(NamedTuple):
    """Two curves with as many vertices each, and the vertices at which their pieces end."""

    A: Array
    B: Array
    ends: Indices


def matched_curves(P: Array, Q: Array) -> MatchedCurves:
    """Return P and Q with a vertex at every vertex of the other, and at every end of a piece."""
    scaled_p, scaled_q = _in_box(P, P, Q), _in_box(Q, P, Q)
    boxes = sum(travel_on_grid(scaled_p[:, c]) for c in range(2)) / GRID
    pieces = max(1, math.ceil(_PIECES_PER_SIDE * boxes))
    samples = _SAMPLES_PER_PIECE * pieces
    at_p, at_q = _positions(scaled_p, samples), _positions(scaled_q, samples)
    window = _MOST_CELLS // (samples + 1) // 2 if (samples + 1) ** 2 > _MOST_CELLS else None
    i, j = dtw_path(
        _sampled(scaled_p, at_p, samples),
        _sampled(scaled_q, at_q, samples),
        metric="cityblock",
        window=window,
    ).path.T
    # Places along the path: i + j at its cells, and linear between.
    cuts = 2.0 * _SAMPLES_PER_PIECE * np.arange(1, pieces + 1)
    place = np.unique(np.concatenate([i + j, cuts, _places(at_p, i, j), _places(at_q, j, i)]))
    A = interpolate(P, *locate(at_p, np.interp(place, i + j, i)))
    B = interpolate(Q, *locate(at_q, np.interp(place, i + j, j)))
    return MatchedCurves(A, B, np.searchsorted(place, cuts))


def _in_box(curve: Array, P: Array, Q: Array) -> Array:
    """Scale by the box of P; by that of Q in a direction in which P is flat."""
    scaled = np.empty(curve.shape)
    for c in range(2):
        box_of = Q if P[:, c].min() == P[:, c].max() else P
        scaled[:, c] = box_scaled(curve[:, c : c + 1], box_of[:, c : c + 1])[:, 0]
    return np.clip(scaled, -_FAR, _FAR)


def _positions(points: Array, samples: int) -> Array:
    """Return where each vertex lies along its curve: 0 at the first, `samples` at the last."""
    lengths = arc_lengths(points)
    if lengths[-1] == 0:
        return np.linspace(0.0, samples, len(points))
    positions: Array = lengths / lengths[-1] * samples
    return positions


def _sampled(points: Array, positions: Array, samples: int) -> Array:
    """Return the points at positions 0, 1, ..., on the grid."""
    return on_grid(interpolate(points, *locate(positions, np.arange(samples + 1.0))))


def _places(positions: Array, i: npt.NDArray[np.int64], j: npt.NDArray[np.int64]) -> Array:
    """Return the places along the path of a curve's vertices between its samples."""
    positions = positions[positions % 1 != 0]
    # The step in which the curve goes from the sample before the vertex to the one behind it.
    step = np.searchsorted(i, positions) - 1
    fraction = positions - i[step]
    return np.asarray(i[step] + j[step] + fraction * (1 + j[step + 1] - j[step]))
