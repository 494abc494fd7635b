"""The beginning of tests: a material point starts at zero strain and stress.

The first loading has a straight section, from 0.4 to 0.7 of the offset yield stress. Its line,
strain over stress by least squares, and the first point determine how far in strain a test misses
the origin. A test is doubtful if this offset exceeds a fraction of the yield strain, and the noise:
a fit compensates for it by a yield stress near 0. Model error looks the same in the first points,
so the command asks and Python warns. O(n) time.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from .._option_names import instead
from ..curves.checks import branch_slices
from ..curves.inputs import Array
from ..curves.named_curve import name_of_test
from ..curves.stress_strain import shift_to_origin
from ..curves.turns import turning_points
from ..materials.readings import offset_yield, reading_of, strain_and_stress

__all__ = [
    "BeginningError",
    "BeginningWarning",
    "beginning_of",
    "check_beginnings",
    "cut_toe",
    "warn_of_beginnings",
]

# Fractions of the offset yield stress: the straight section, and the remaining stress of a test
# that begins unloaded.
_STRAIGHT = (0.4, 0.7)
_UNLOADED = 0.5
# Limits of a test's offset from the origin, as fractions of the yield strain: for refusal and for a
# note.
_MOST, _SEEN = 0.08, 0.012
_MOST_TOE, _SEEN_TOE = 0.12, 0.03
_NOISE = 4.0  # times its standard error
_STEEPEST = 1.3  # times the modulus that was read
_EFFECT = ": parameters may be off by more than their intervals"


class BeginningError(ValueError):
    """A test does not begin at zero strain and stress."""


class BeginningWarning(UserWarning):
    """A test that is fitted does not begin at zero strain and stress."""


class Beginning(NamedTuple):
    """The beginning of a test.

    Attributes
    ----------
    strain, stress : float
        The first point.
    modulus : float
        The modulus of unloading, or of the first loading if the test never unloads.
    limit : float
        Offset yield stress.
    sign : float
        -1.0 if the test begins with compression.
    elastic : tuple of float
        Stresses between which the first loading is straight, both positive.
    zero : float
        The strain at which the line through the straight section has zero stress.
    noise : float
        Scatter of the strains about this line.
    error : float
        Standard error of `zero`.
    early, early_error : float
        The offset in strain of the points before the straight section from the elastic line through
        the origin, and its standard error.
    """

    strain: float
    stress: float
    modulus: float
    limit: float
    sign: float
    elastic: tuple[float, float]
    zero: float
    noise: float
    error: float
    early: float
    early_error: float

    @property
    def missed(self) -> float:
        """Offset in strain of the first point from the elastic line of the origin."""
        return self.strain - self.stress / self.modulus

    def share(self, strain: float) -> float:
        """Return a strain over that at which the material yields."""
        return abs(strain) * self.modulus / self.limit


def beginning_of(test: Any, name: str) -> Beginning:
    """Return where a test begins; errors are those of `reading_of`."""
    points = strain_and_stress(test, name)
    reading = reading_of(points, name)
    modulus = float(np.median(reading.moduli[1:] or reading.moduli))
    first = points[branch_slices(turning_points(points), len(points))[0]]
    limit = offset_yield(first, modulus, name)
    sign = 1.0 if first[-1, 0] >= first[0, 0] else -1.0
    elastic = (_STRAIGHT[0] * limit, _STRAIGHT[1] * limit)
    stress = sign * first[:, 1]
    beyond = np.flatnonzero(stress > elastic[1])
    straight = first[: int(beyond[0]) if beyond.size else len(first)]
    straight = straight[sign * straight[:, 1] >= elastic[0]]
    before = first[: max(3, int(np.argmax(stress > elastic[0])))]
    misses = before[:, 0] - before[:, 1] / modulus
    zero = noise = error = 0.0
    if len(straight) >= 3:
        mean = straight.mean(axis=0)
        e, s = (straight - mean).T
        compliance = float(e @ s / max(float(s @ s), np.finfo(float).tiny))
        zero = float(mean[0] - compliance * mean[1])
        noise = float(np.sqrt(((e - compliance * s) ** 2).sum() / (len(e) - 2)))
        spread = 1.0 / len(e) + mean[1] ** 2 / max(float(s @ s), np.finfo(float).tiny)
        error = noise * float(np.sqrt(spread))
    return Beginning(
        float(first[0, 0]),
        float(first[0, 1]),
        modulus,
        limit,
        sign,
        elastic,
        zero,
        noise,
        error,
        float(misses.mean()),
        float(misses.std() / np.sqrt(len(misses))),
    )


def check_beginnings(tests: Sequence[Any], units: str, *, effect: str = _EFFECT) -> str:
    """Refuse tests that do not begin at the origin, and report those that nearly do.

    Parameters
    ----------
    tests : sequence of array_like
        Strain and stress of each.
    units : str
        The unit of the stresses.
    effect : str
        What an offset may do, for the sentences.

    Returns
    -------
    str
        A sentence for each test that misses the origin by little, or "".

    Raises
    ------
    BeginningError
        If a test misses the origin; the message states the strain, and the remedy.
    """
    said = []
    for i, test in enumerate(tests):
        name = name_of_test(test, i)
        begin = beginning_of(test, name)
        largest = float(np.abs(strain_and_stress(test, name)[:, 1]).max())
        if abs(begin.stress) >= _UNLOADED * largest:
            _check_loaded(begin, name, units)
        else:
            _check_offset(begin, name, units)
            said.append(_said(begin, name, units, effect))
    return ". ".join(filter(None, said))


def warn_of_beginnings(tests: Sequence[Any], units: str, *, level: int) -> str:
    """Warn of a test that does not begin at the origin; return `check_beginnings`, or the warning.

    Parameters
    ----------
    tests, units
        As for `check_beginnings`.
    level : int
        The stack level of the warning.
    """
    try:
        return check_beginnings(tests, units)
    except BeginningError as error:
        warnings.warn(str(error), BeginningWarning, stacklevel=level + 1)
        return str(error)


def cut_toe(test: Any, elastic: Sequence[float] = ()) -> Array:
    """Return a test from its straight section on, shifted through the origin.

    Parameters
    ----------
    test : array_like, shape (n, 2)
        Strain and stress.
    elastic : (low, high), optional
        As for :func:`curvewise.curves.shift_to_origin`; by default 0.4 and 0.7 of the offset yield
        stress.
    """
    begin = beginning_of(test, "test")
    low, high = elastic or begin.elastic
    return begin.sign * shift_to_origin(
        begin.sign * strain_and_stress(test, "test"), elastic=(low, high), cut=True
    )


def _check_loaded(begin: Beginning, name: str, units: str) -> None:
    """Refuse a first point to which no loading from the origin leads."""
    strain, stress = begin.strain, begin.stress
    if stress * strain > 0.0 and abs(stress) <= _STEEPEST * begin.modulus * abs(strain):
        return
    raise BeginningError(
        f"{name} begins with a stress of {stress:.4g} {units} at a strain of {strain:.4g}, to "
        "which no loading from zero strain and stress leads; begin the test with its first "
        "loading, or correct the zero of the strain"
    )


def _check_offset(begin: Beginning, name: str, units: str) -> None:
    """Refuse a test that begins unloaded elsewhere than at the origin, or with a toe."""
    missed, zero = begin.missed, begin.zero
    is_off = begin.share(missed) > _MOST and abs(missed) > _NOISE * begin.noise
    is_along = begin.share(missed - zero) <= _MOST or abs(missed - zero) <= _NOISE * begin.error
    late = begin.sign * (zero - missed)
    has_toe = begin.share(late) > _MOST_TOE and late > _NOISE * begin.error
    low, high = (f"{stress:.2g}" for stress in begin.elastic)
    if has_toe or (is_off and not is_along):
        minus = "-" if begin.sign < 0.0 else ""
        way = instead(
            "toe",
            f"curvewise fit: --toe; Python: {minus}shift_to_origin({minus}test, elastic="
            f"({float(low):g}, {float(high):g}), cut=True)",
        )
        raise BeginningError(
            f"{name} begins with a toe: its first point is at a strain of {begin.strain:.4g} and a "
            f"stress of {begin.stress:.4g} {units}, and its straight part, extended, has no stress "
            f"at a strain of {zero:.4g}; cut the toe ({way})"
        )
    if is_off:
        raise BeginningError(
            f"{name} does not begin at zero: its first point is at a strain of {begin.strain:.4g} "
            f"and a stress of {begin.stress:.4g} {units}, a strain of {missed:.4g} beside the "
            "elastic line through zero. If strain or stress was not zeroed, or the test follows a "
            f"prestrain, make the first point the origin ({_zero()}). If the test is part of a "
            "longer one, begin it with the first loading"
        )


def _said(begin: Beginning, name: str, units: str, effect: str) -> str:
    """Return a sentence about a small offset or toe, or ""."""
    late = begin.sign * (begin.zero - begin.missed)
    if begin.share(late) > _SEEN_TOE and late > _NOISE * begin.error:
        return (
            f"{name} may begin with a toe: its straight part, extended, has no stress at a strain "
            f"of {begin.zero:.4g}. Compare the fit without it "
            f"({instead('toe', 'curvewise fit: --toe')})"
        )
    noise = _NOISE * max(begin.noise, begin.early_error)
    is_seen = begin.share(begin.early) > _SEEN and abs(begin.early) > noise
    if not is_seen or abs(begin.missed - begin.early) > noise + 0.2 * abs(begin.early):
        return ""
    return (
        f"The first points of {name} are beside the elastic line through zero, by a strain of "
        f"{begin.early:.2g} or a stress of {-begin.early * begin.modulus:.2g} {units}{effect}. "
        "If strain or stress was not zeroed, make the "
        f"first point the origin ({_zero()})"
    )


def _zero() -> str:
    return instead("zero", "curvewise fit: --zero; Python: shift_to_origin(test)")
