"""Estimates from a loop: modulus, yield stress, stresses, plastic strains.

They define bounds, and are not results. The modulus is the slope of a line through the unloading
after the first reversal (through the first loading, if the test never unloads). The yield stress is
where the first loading leaves this line by an offset. O(n) time.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .._option_names import instead
from ..curves.averaging import averaged
from ..curves.checks import Turns, branch_slices
from ..curves.inputs import Array
from ..curves.isotonic import isotonic
from ..curves.resampling import resample
from ..curves.several_curves import as_points
from ..curves.turns import last_cycle, turning_points

__all__ = [
    "MaterialReading",
    "Span",
    "offset_yield",
    "reading_of",
    "strain_and_stress",
    "thinned",
    "thinned_cycle",
]

# Fractions of the stress at a reversal: unloading between them is nearly straight, also in
# measurements.
_UNLOADED = (0.05, 0.75)
# Fractions of the largest stress: the first loading is nearly straight between them.
_LOADED = (0.05, 0.3)
_FEW = 3  # points for a line
_OFFSET = 0.002  # of plastic strain, or a quarter of what the first loading reaches
_HARDLY_MORE = 1.5  # times the wanted points: as many rows are not averaged
_MOST_STRAIN = 0.5  # beyond it a column of strains is in per cent


class MaterialReading(NamedTuple):
    """The estimates from one test.

    Attributes
    ----------
    moduli : tuple of float
        Of the first loading and of unloading after each reversal, if these are straight.
    yield_stress : float
        At an offset of 0.2 %, or of a quarter of the first loading's plastic strain if that is
        less.
    stress : float
        The largest, in tension or compression.
    branch, path : float
        Plastic strain: the most in one direction, and the sum over all directions.
    """

    moduli: tuple[float, ...]
    yield_stress: float
    stress: float
    branch: float
    path: float


class Span(NamedTuple):
    """The joint range of the estimates from several tests."""

    lowest_yield: float
    highest_yield: float
    stress: float
    shortest_branch: float
    longest_branch: float
    path: float

    @classmethod
    def of(cls, readings: Sequence[MaterialReading]) -> Span:
        """Return that of some tests."""
        _, yields, stresses, branches, paths = zip(*readings, strict=True)
        return cls(
            min(yields), max(yields), max(stresses), min(branches), max(branches), max(paths)
        )


def strain_and_stress(experiment: object, name: str) -> Array:
    """Return a test as an array of strain and stress, shape (n, 2), or say what else it is."""
    points = as_points(experiment, name)
    if points.shape[1] != 2:
        raise ValueError(f"{name} has shape {points.shape}; give strain and stress, (n, 2)")
    return points


def reading_of(experiment: object, name: str) -> MaterialReading:
    """Return the estimates from one test.

    Parameters
    ----------
    experiment : array_like, shape (n, 2)
        Strain [-] and stress, from the unloaded state.
    name : str
        The name of the test in errors.

    Raises
    ------
    ValueError
        If the test does not hold strain and stress, or has strains in per cent. If it is elastic,
        or its stress does not rise with the strain.
    """
    points = strain_and_stress(experiment, name)
    largest = float(np.abs(points[:, 0]).max())
    if largest > _MOST_STRAIN:
        raise ValueError(
            f"{name} has strains of up to {largest:.4g}, which is {100 * largest:.4g} %; "
            f"{instead('factors', 'divide them by 100', 'give {} 0.01 1')} if they are in per cent "
            f"(where they are true, {instead('bounds', 'the bounds')} must be given)"
        )
    branches = [points[part] for part in branch_slices(turning_points(points), len(points))]
    moduli = _moduli([_first_loading(branches[0]), *map(_unloading, branches[1:])])
    if not moduli:
        raise ValueError(
            f"{name} has no straight part, neither where it is first loaded nor where it is "
            "unloaded; the first column is to be the strain, the second the stress"
        )
    plastic = [abs(float(_plastic(branch, max(moduli))[-1])) for branch in branches]
    if not max(plastic) > 0.01 * np.ptp(points[:, 0]):
        raise ValueError(f"{name} is elastic: nothing of hardening can be read off it")
    return MaterialReading(
        tuple(moduli),
        offset_yield(branches[0], moduli[0], name),
        float(np.abs(points[:, 1]).max()),
        max(plastic),
        sum(plastic),
    )


def thinned(experiment: object, name: str, points: int = 300) -> Array:
    """Return a test with about `points` points, including its reversals.

    Noise in strain is averaged. The points are evenly spaced in each branch along the path of
    strain and stress, each by its range and without its noise. The knee and the elastic part
    therefore have enough points. A test with fewer points is unchanged. A test whose noise exceeds
    its step of strain is averaged first.
    """
    test = strain_and_stress(experiment, name)
    return _evenly(*_averaged(test, len(test), points), points)


def thinned_cycle(experiment: object, name: str, points: int = 300) -> tuple[Array, slice]:
    """Return a test up to its last complete cycle, and that cycle's place.

    The part before the cycle is reduced to its reversals: between two of them the strain is
    monotonic, and a step of a material-point model may be that long. The cycle is thinned as in
    `thinned`.
    """
    test = strain_and_stress(experiment, name)
    try:
        cycle = last_cycle(test)
        test, turns = _averaged(test, cycle.stop - cycle.start, points)
        cycle = last_cycle(test)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    history = [0, *(turn for turn in turns if turn < cycle.start)]
    kept = _evenly(test[cycle], turning_points(test[cycle]), points)
    return np.concatenate((test[history], kept)), slice(len(history), len(history) + len(kept))


def _averaged(test: Array, rows: int, points: int) -> tuple[Array, Turns]:
    """Return a test and its turns, averaged if `rows` of it are dense for that many points."""
    turns = turning_points(test)
    dense = averaged(test, turns) if rows > _HARDLY_MORE * points else None
    return dense or (test, turns)


def _evenly(test: Array, turns: Turns, points: int) -> Array:
    """Return about `points` points of a test, evenly spaced in each branch."""
    if len(test) <= points:
        return test
    travel = np.zeros(len(test))
    for part in branch_slices(turns, len(test)):
        for column in (test / np.ptp(test, axis=0)).T:
            sign = 1.0 if column[part][-1] >= column[part][0] else -1.0
            fitted = isotonic(sign * column[part])
            travel[part] += fitted - fitted[0]
        travel[part.stop :] = travel[part.stop - 1]
    return resample(test, max(8, points // (len(turns) + 1)), by=travel, turns=turns)


def _plastic(branch: Array, modulus: float) -> Array:
    """Return the plastic strains of a branch, from its begin on."""
    found: Array = (branch[:, 0] - branch[0, 0]) - (branch[:, 1] - branch[0, 1]) / modulus
    return found


def _unloading(branch: Array) -> Array:
    """Return the points of a branch that unload from its beginning."""
    if branch[0, 1] == 0.0:
        return branch[:0]
    return _between(branch, 1.0 - branch[:, 1] / branch[0, 1], *_UNLOADED)


def _first_loading(branch: Array) -> Array:
    """Return the points of the first branch at which it is nearly straight."""
    stress = np.abs(branch[:, 1])
    return _between(branch, stress / max(float(stress.max()), np.finfo(float).tiny), *_LOADED)


def _between(branch: Array, share: Array, low: float, high: float) -> Array:
    """Return the points from one share to another; where they are few, from the begin on."""
    beyond = np.flatnonzero(share > high)
    first = branch[: int(beyond[0]) if beyond.size else len(branch)]
    inside: Array = first[share[: len(first)] >= low]
    return inside if len(inside) >= _FEW else branch[: max(2, len(first))]


def _moduli(parts: Sequence[Array]) -> list[float]:
    """Return the slopes of lines through those parts that have one: strain over stress."""
    found = []
    for part in parts:
        if len(part) < 2:
            continue
        strain, stress = (part - part.mean(axis=0)).T
        compliance = float(strain @ stress) / max(float(stress @ stress), np.finfo(float).tiny)
        if compliance > 0.0:
            found.append(1.0 / compliance)
    return found


def offset_yield(first: Array, modulus: float, name: str) -> float:
    """Return the stress at which the first loading has left its line by the offset.

    Raises
    ------
    ValueError
        If there is no stress up to there.
    """
    sign = 1.0 if first[-1, 0] >= first[0, 0] else -1.0
    plastic = np.maximum.accumulate(sign * _plastic(first, modulus))
    place = int(np.searchsorted(plastic, min(_OFFSET, 0.25 * plastic[-1])))
    found = float(np.abs(first[: place + 1, 1]).max())
    if not found > 0.0:
        raise ValueError(
            f"{name} strains without stress where it is first loaded; the first column is to be "
            "the strain, the second the stress"
        )
    return found
