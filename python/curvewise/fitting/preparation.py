"""Preparation of tests for a fit or a comparison, with a record of its steps.

Forces become stresses and extensions strains; a wrong zero and a toe are corrected; engineering
values become true ones. `prepare` is what the commands and studies call. O(n) time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .._option_names import called
from .._options import real_number
from ..curves.inputs import Array, CurveLike
from ..curves.named_curve import Labels, NamedCurve, known_file, known_names
from ..curves.stress_strain import engineering_to_true, shift_to_origin
from ..drawing.figures import draw_curves, legend_above, new_figure
from ..files.column_units import FORCES, LENGTHS, in_mpa, unit_of
from ..materials.readings import strain_and_stress
from .beginnings import beginning_of, cut_toe
from .recorded_cycles import Numbers, checked_numbers, said_of_cycles

__all__ = ["PreparedTest", "prepare"]

_FIRST = 0.01  # strain up to which the beginning of a test is drawn


@dataclass(frozen=True, eq=False)
class PreparedTest:
    """A prepared test: a curve for every function that takes one.

    Attributes
    ----------
    curve : ndarray, shape (n, 2)
        Strain [-] and stress.
    before : ndarray, shape (m, 2)
        Strain and stress before zero, toe and true values.
    steps : tuple of str
        The steps, a sentence each.
    cycle_numbers : ndarray of int, shape (n,), or None
        The cycle that each point belongs to, if the record leaves out cycles.
    """

    curve: Array
    before: Array = field(repr=False)
    steps: tuple[str, ...]
    cycle_numbers: Numbers | None = field(default=None, repr=False)

    ndim = 2
    """Of the array."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The dimension of the array."""
        return self.curve.shape

    @property
    def column_names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return known_names(self.curve)

    def __getitem__(self, rows: Any) -> PreparedTest:
        """Return some of its points, by a slice or an array of indices."""
        numbers = None if self.cycle_numbers is None else self.cycle_numbers[rows]
        return replace(self, curve=self.curve[rows], cycle_numbers=numbers)

    def __len__(self) -> int:
        return len(self.curve)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        return np.array(self.curve, dtype=dtype or np.float64)

    def __str__(self) -> str:
        return "\n".join(self.steps)

    def beginnings(self) -> tuple[Array, Array]:
        """Return the first per cent of strain before and after, two arrays of shape (n, 2)."""
        return _beginning(self.before), _beginning(np.asarray(self.curve))

    def plot(self) -> Any:
        """Draw the first per cent of strain before and after.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        before, after = self.beginnings()
        figure = new_figure(figsize=(4.6, 3.6), layout="constrained")
        ax = figure.add_subplot()
        labels = Labels(self.column_names or ("strain", "stress"), ("before", "after"))
        for line in draw_curves(ax, before, after, labels):
            line.set(marker=".", markersize=4, linewidth=0.8)
        legend_above(figure, ax)
        return figure


def prepare(
    test: CurveLike,
    *,
    area: float | None = None,
    gauge_length: float | None = None,
    zero: bool = False,
    toe: bool | Sequence[float] = False,
    true: bool = False,
    cycle_numbers: Any = None,
    units: str = "MPa",
) -> PreparedTest:
    """Prepare a test: stresses from forces, zero, toe, true values.

    The steps are done in the order of the parameters.

    Parameters
    ----------
    test : array_like, shape (n, 2)
        Strain [-] or extension, and stress or force. A curve from :func:`curvewise.read_curve`
        knows the units of its columns, which are converted.
    area : float, optional
        The divisor of the force, a cross section: in mm² if the column names a unit of force.
    gauge_length : float, optional
        The divisor of the extension, a length: in mm if the column names a unit of length.
    zero : bool, default False
        Whether to make the first point the origin.
    toe : bool or (low, high), default False
        Whether to cut the toe. The strain is shifted so that the line between two stresses of the
        first loading passes through the origin, and the points before it are left out. If True, the
        stresses are 0.4 and 0.7 of the offset yield stress.
    true : bool, default False
        Whether to convert engineering strain and stress to true ones
        (:func:`curvewise.curves.engineering_to_true`).
    cycle_numbers : array_like, shape (n,), optional
        Number of the cycle of each point, never decreasing. If the record leaves out cycles, a fit
        drives the material through these: each repeats the reversals of the cycle before.
    units : str, default "MPa"
        Unit of the stresses.

    Returns
    -------
    PreparedTest
        The curve, and a sentence for each step. Every function that takes a curve accepts it.

    Raises
    ------
    TypeError, ValueError
        If `test` does not have two finite columns. If an area or a gauge length is not positive, or
        its column is neither a force nor an extension. If cycle numbers fall, or have another
        length. As for `shift_to_origin` and `engineering_to_true`.

    Notes
    -----
    O(n) time and memory.

    Examples
    --------
    >>> from curvewise.fitting import prepare
    >>> from curvewise.fitting import prepare
    >>> test = prepare([(0.01, 10.0), (0.06, 4010.0), (0.11, 5010.0)], area=20, zero=True)
    >>> print(test)
    stress = force / area of 20, taken to be in MPa: the column names no unit
    zero: the first point, at a strain of 0.01 and a stress of 0.5 MPa, is the origin
    >>> test.curve
    array([[0.0e+00, 0.0e+00],
           [5.0e-02, 2.0e+02],
           [1.0e-01, 2.5e+02]])
    """
    names = list(known_names(test) or ("", ""))
    points = np.array(strain_and_stress(test, "test"))
    steps = []
    if area is not None:
        factor, said = _of_force(names[1], area, units)
        points[:, 1] *= factor
        names[1] = f"stress [{units}]"
        steps.append(said)
    if gauge_length is not None:
        factor, said = _of_extension(names[0], gauge_length)
        points[:, 0] *= factor
        names[0] = "strain [-]"
        steps.append(said)
    before, numbers = points, checked_numbers(cycle_numbers, len(points))
    if zero:
        strain, stress = points[0]
        points = shift_to_origin(points)
        steps.append(
            f"zero: the first point, at a strain of {strain:.4g} and a stress of {stress:.4g} "
            f"{units}, is the origin"
        )
    if toe is not False:
        points, said = _without_toe(points, toe, units)
        steps.append(said)
        numbers = None if numbers is None else numbers[len(numbers) - len(points) :]
    if true:
        largest = np.abs(points).max(axis=0)
        points = engineering_to_true(points)
        e, s = np.abs(points).max(axis=0)
        steps.append(
            "true: engineering values are converted to true values; the largest strain "
            f"changes from {largest[0]:.4g} to {e:.4g}, the largest stress from "
            f"{largest[1]:.4g} to {s:.4g} {units}"
        )
    if numbers is not None:
        steps.append(said_of_cycles(numbers))
    curve = NamedCurve(points, names, known_file(test)) if any(names) else points
    return PreparedTest(curve, before, tuple(steps), numbers)


def _of_force(name: str, area: float, units: str) -> tuple[float, str]:
    """Return what forces are multiplied by, and this in words."""
    _check_positive("area", area, "the cross section")
    unit = unit_of(name)
    if not unit:
        return 1.0 / area, (
            f"stress = force / area of {area:g}, taken to be in {units}: the column names no unit"
        )
    if unit not in FORCES:
        raise ValueError(
            f"{called('area')} is {area:g}, and column {name!r} is not a force; leave "
            f"{called('area')} out, or choose the column of the force"
        )
    if (target := in_mpa(units)) is None:
        raise ValueError(
            f"{called('area')} is {area:g}, and forces cannot be converted to {units!r}; give "
            f"{called('units')} such as 'MPa' or 'ksi'"
        )
    return FORCES[unit] / area / target, f"stress = {name} / area of {area:g} mm², in {units}"


def _check_positive(option: str, value: float, what: str) -> None:
    advice = f"give {what}, a number above 0"
    if not 0.0 < real_number(called(option), value, 0.0, advice) < np.inf:
        raise ValueError(f"{called(option)} is {value!r}; {advice}")


def _of_extension(name: str, gauge_length: float) -> tuple[float, str]:
    """Return what extensions are multiplied by, and this in words."""
    _check_positive("gauge_length", gauge_length, "a length")
    unit = unit_of(name)
    if not unit:
        return 1.0 / gauge_length, (
            f"strain = extension / gauge length of {gauge_length:g}, taken to be in the same unit: "
            "the column names none"
        )
    if unit not in LENGTHS:
        raise ValueError(
            f"{called('gauge_length')} is {gauge_length:g}, and column {name!r} is not a length; "
            f"leave {called('gauge_length')} out, or choose the column of the extension"
        )
    return LENGTHS[unit] / gauge_length, f"strain = {name} / gauge length of {gauge_length:g} mm"


def _without_toe(points: Array, toe: bool | Sequence[float], units: str) -> tuple[Array, str]:
    """Return a test without its toe, and a sentence about this step."""
    limits = () if isinstance(toe, bool) else tuple(map(float, toe))
    if len(limits) not in (0, 2):
        raise ValueError(
            f"{called('toe')} has {len(limits)} stresses; give two, low and high, or none"
        )
    begin = beginning_of(points, "test")
    low, high = limits or begin.elastic
    cut = cut_toe(points, (low, high))
    left_out = len(points) - len(cut)
    shift = float(cut[0, 0] - points[left_out, 0])
    return cut, (
        f"toe: strains are shifted by {shift:.4g}, so that the line from {low:.4g} to {high:.4g} "
        f"{units} goes through the origin; {left_out} points before it are left out"
    )


def _beginning(points: Array) -> Array:
    """Return the first points, up to a strain of one per cent from the first one."""
    far = np.flatnonzero(np.abs(points[:, 0] - points[0, 0]) > _FIRST)
    return np.array(points[: int(far[0]) if far.size else len(points)])
