"""Stiffness and equivalent viscous damping of each cycle of a record. O(n log n) time."""

from __future__ import annotations

import math
from typing import Literal, get_args

import numpy as np

from .._options import check_choice, real_number
from .cycles import Cycle, area_of, cycles_of, in_plane, up_to_level
from .inputs import Array, CurveLike

__all__ = ["StiffnessKind", "damping", "stiffness"]

StiffnessKind = Literal["secant", "unloading", "reloading"]
_PART = "give two fractions, 0 <= low < high <= 1"


def stiffness(
    curve: CurveLike,
    *,
    kind: StiffnessKind = "secant",
    part: tuple[float, float] = (0.05, 0.35),
    column: int = 0,
    reversal: float = 0.1,
) -> Array:
    """Compute the secant, unloading or reloading stiffness of each cycle.

    Parameters
    ----------
    curve : array_like, shape (n, 2)
        The record: displacement and force, or strain and stress.
    kind : {"secant", "unloading", "reloading"}, default "secant"
        "secant": the slope from valley to peak, the effective stiffness of ASCE/SEI 7. "unloading":
        the slope after the peak; for strain and stress ASTM E606's modulus E_NT. "reloading": the
        slope after the valley, ASTM E606's E_NC.
    part : (low, high), default (0.05, 0.35)
        The part of the branch whose slope is taken, by the change of y since the reversal, as
        fractions of the loop's height. It must lie within the straight part. Ignored for "secant".
    column, reversal
        As for :func:`loops`.

    Returns
    -------
    ndarray, shape (k,)
        In units of y over x. It is nan for a branch that the record does not contain, because it
        ends with the reversal, and for a branch whose ends have the same y.

    Raises
    ------
    TypeError, ValueError
        As for :func:`loops`; if `curve` does not have two columns, `kind` is unknown or `part` is
        out of order.

    Notes
    -----
    The slopes after reversals are those of least-squares lines of x over y. O(n log n) time, O(n)
    memory.

    References
    ----------
    ASCE/SEI 7, chapter 17, effective stiffness. ASTM E606/E606M, unloading moduli.

    Examples
    --------
    >>> from curvewise.curves import stiffness
    >>> record = [[0, 0], [1, 10], [4, 10], [2, -10], [-4, -10], [-2, 10], [4, 10]]
    >>> stiffness(record)
    array([2.5])
    >>> stiffness(record, kind="unloading")
    array([10.])
    """
    check_choice("kind", kind, get_args(StiffnessKind))
    low, high = _fractions(part)
    cycles = cycles_of(in_plane(curve), column, reversal)
    if kind == "secant":
        rise, run = _extents(cycles)
        with np.errstate(divide="ignore", invalid="ignore"):
            return rise / run
    branches = (cycle.branch(after_peak=kind == "unloading") for cycle in cycles)
    return np.array([_slope(branch, low, high) for branch in branches])


def damping(curve: CurveLike, *, column: int = 0, reversal: float = 0.1) -> Array:
    r"""Compute the equivalent viscous damping ratio of each cycle.

    .. math:: \zeta_\mathrm{eq} = \frac{E_D}{4 \pi E_S}, \qquad E_S = \frac{k x_0^2}{2}

    :math:`E_D` is the energy of the loop, :math:`k` the secant stiffness, and :math:`x_0` half of
    the way from valley to peak.

    Parameters
    ----------
    curve : array_like, shape (n, 2)
        The record: displacement and force, or strain and stress.
    column, reversal
        As for :func:`loops`.

    Returns
    -------
    ndarray, shape (k,)
        The damping ratio, 1 for critical damping. It is infinite if the secant stiffness is 0.

    Raises
    ------
    TypeError, ValueError
        As for :func:`loops`; if `curve` does not have two columns.

    Notes
    -----
    Equal to the effective damping of ASCE/SEI 7, chapter 17. O(n log n) time, O(n) memory.

    References
    ----------
    A. K. Chopra, "Dynamics of Structures", section 3.9; L. S. Jacobsen, Transactions ASME 52,
    1930.

    Examples
    --------
    An elastic, perfectly plastic loop of ductility 4 has a ratio of 2 (1 - 1/4) / π:

    >>> from curvewise.curves import damping
    >>> record = [[0, 0], [1, 10], [4, 10], [2, -10], [-4, -10], [-2, 10], [4, 10]]
    >>> damping(record).round(4)
    array([0.4775])
    """
    cycles = cycles_of(in_plane(curve), column, reversal)
    rise, run = _extents(cycles)
    with np.errstate(divide="ignore", invalid="ignore"):
        return 2.0 / math.pi * np.array([area_of(cycle.points) for cycle in cycles]) / (rise * run)


def _extents(cycles: list[Cycle]) -> tuple[Array, Array]:
    """Return the rise of y and of x from valley to peak."""
    tips = np.array([cycle.tips for cycle in cycles])
    run, rise = (tips[:, 0] - tips[:, 1]).T
    return rise, run


def _fractions(part: tuple[float, float]) -> tuple[float, float]:
    low, high = (real_number("part", limit, -math.inf, _PART) for limit in part)
    if not 0.0 <= low < high <= 1.0:
        raise ValueError(f"part is {part}; {_PART}")
    return low, high


def _slope(branch: Array, low: float, high: float) -> float:
    """Return the slope of a branch between two shares of its change of y."""
    y = branch[:, 1]
    if y[-1] == y[0]:
        return math.nan
    share = (y - y[0]) / (y[-1] - y[0])
    ends = [up_to_level(branch, share, at, rises=True)[-1] for at in (low, high)]
    first, beyond = int(np.argmax(share >= low)), int(np.argmax(share >= high))
    away, rise = (np.vstack((ends[0], branch[first:beyond], ends[1])) - ends[0]).T
    away, rise = away - away.mean(), rise - rise.mean()
    with np.errstate(divide="ignore"):
        return float(np.divide(rise @ rise, away @ rise))
