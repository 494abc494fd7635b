"""All measures of a pair of curves at once, under conditions that make sense together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import is_symmetric
from .._option_names import with_values
from .._options import Default, Missing, Preset, check_choice
from ..curves.column_roles import is_time
from ..curves.foreign_curves import warn
from ..curves.inputs import Array, CurveLike, as_curves, in_columns
from ..curves.layouts import ask_about_curves, settled_layout
from ..curves.missing import skip_in_each
from ..curves.named_curve import axis_names, copied, known_names
from ..measures import normalize
from ..measures.registry import MEASURES, PRESETS, Condition, MeasureInfo, default_measures
from ..showing.result import Result, Table
from .deviations import Deviations, cells, deviation
from .limits import Verdict, check_limits
from .units import other_units

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["PRESETS", "Comparison", "Preset", "compare"]


@dataclass(frozen=True, eq=False)
class Comparison(Result):
    """The values of several measures for one pair of curves.

    ``comparison["dtw"]`` is one value, ``str(comparison)`` a table. For a measure without a value
    ``comparison["dtw"]`` raises ValueError.

    Attributes
    ----------
    P, Q : ndarray
        The curves in float64, unscaled, with the names of their columns if known.
    preset : {"scaled", "paper", "raw"}
        The conditions under which the values were computed.
    values : dict of str to float
        The values, in the order of :func:`compare` or as requested; nan for a measure that refuses
        these curves.
    conditions : dict of str to Condition
        How each value was computed: on scaled curves or not, and with which options.
    refusals : dict of str to str
        The reason for each measure that refuses these curves.
    """

    P: Array = field(repr=False)
    Q: Array = field(repr=False)
    preset: Preset
    values: dict[str, float]
    conditions: dict[str, Condition] = field(repr=False)
    refusals: dict[str, str] = field(default_factory=dict)

    def __getitem__(self, measure: str) -> float:
        if measure in self.refusals:
            raise ValueError(self.refusals[measure])
        return self.values[measure]

    def __str__(self) -> str:
        width = max(map(len, self.values))
        lines = [f"{name:<{width}}  {self._text(name)}" for name in self.values]
        return "\n".join([*lines, *self.notes])

    def _text(self, name: str) -> str:
        """Return a measure's value as text, or the reason why it is missing."""
        refusal = self.refusals.get(name)
        return f"no value: {refusal}" if refusal else f"{self.values[name]:.6g}"

    @property
    def notes(self) -> list[str]:
        """Warnings: coordinates in which one curve is more than 20 times the other.

        Per cent against a fraction, for example. With area's ``spacing="function"``, also the x
        over which it integrates. `str` and a notebook show the notes below the values.
        """
        P, Q = map(in_columns, (self.P, self.Q))
        units = other_units(P, Q, axis_names(P.shape[1], None, self.P, self.Q), "P", "Q")
        return [*self._common_span(), *units]

    def _common_span(self) -> list[str]:
        """Say which x both curves span, where an area is an integral over it."""
        area = self.conditions.get("area")
        if not area or area.options.get("spacing") != "function" or "area" in self.refusals:
            return []
        spans = [(float(curve[:, 0].min()), float(curve[:, 0].max())) for curve in (self.P, self.Q)]
        low, high = max(low for low, _ in spans), min(high for _, high in spans)
        p, q = (f"{100 * (high - low) / (end - begin):.3g} %" for begin, end in spans)
        span = f"x from {low:.6g} to {high:.6g}"
        return [f"area is over {span}: {p} of the span of P, {q} of that of Q"]

    @property
    def deviations(self) -> Deviations:
        """Distances between the points that each measure compares, in units of y.

        For the measures that compare points, that is, not for curve_length. They are computed on
        first use: dtw and frechet need their paths. A dict of
        :class:`curvewise.comparing.deviations.Deviation`.
        """
        found = {
            name: deviation(name, condition, self.P, self.Q)
            for name, condition in self.conditions.items()
            if name not in self.refusals
        }
        return Deviations({name: value for name, value in found.items() if value is not None})

    def to_dict(self) -> dict[str, float]:
        """Return the values by name, as a new dict of Python floats; nan if missing."""
        return dict(self.values)

    def within(self, limits: Mapping[str, float | str]) -> Verdict:
        """Check the measures against limits, for a test that passes or fails.

        Parameters
        ----------
        limits : mapping of str to float or str
            The largest value of each measure, or a percentage of P's range of y such as "2%". The
            percentage limits the mean deviation for area, pcm and dtw, and the largest for the
            Fréchet distances.

        Returns
        -------
        Verdict
            True if no measure is above its limit. It prints each measure with its limit and, if it
            is above, where the deviation is largest. A measure without a value is not within.

        Raises
        ------
        ValueError
            If a measure is not among the values, a limit is not a number from 0, or a percentage is
            given for a measure without a deviation.

        Notes
        -----
        The time of :attr:`deviations` for percentages and for measures above their limits.

        Examples
        --------
        >>> import curvewise
        >>> compared = curvewise.compare(*curvewise.datasets.hysteresis_pair())
        >>> compared.within({"area": "5%", "frechet": 0.08})
        area 3.996 %, within its limit 5 %
        frechet 0.07264, within its limit 0.08
        """
        return check_limits(limits, self.values, self.conditions, self.P, self.Q)

    def plot(self, *, names: Sequence[str] | None = None) -> Picture:
        """Return a matplotlib Figure of the curves and of what each measure saw.

        Parameters
        ----------
        names : sequence of str, optional
            The labels of the axes; by default the names of the curves' columns, else x and y.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        ValueError
            If the number of names differs from the number of coordinates.
        """
        from ..plotting import plot_comparison

        return plot_comparison(self, names=names)

    @property
    def picture_shows(self) -> str:
        """The alternative text of the figure."""
        return f"The curves, and what {', '.join(self.values)} saw in them"

    def parts(self) -> Sequence[Table | str]:
        """Return the values with the deviations, which `str` leaves out, and the preset."""
        deviations = self.deviations
        rows = [
            [name, "", self._text(name), ""]
            if name in self.refusals
            else [name, self._text(name), *cells(deviations.get(name))]
            for name in self.values
        ]
        header = ["measure", "value", "mean deviation, in units of y", "largest"]
        return [Table(rows, header), f"preset {self.preset}", *self.notes]


# Shared text: measures(all by_default anywhere), missing
def compare(
    P: CurveLike,
    Q: CurveLike,
    *,
    preset: Preset = "scaled",
    measures: Sequence[str] | None = None,
    options: Mapping[str, Mapping[str, Any]] | None = None,
    missing: Missing = Default.missing,
) -> Comparison:
    """Compute several measures of a pair of curves.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves; P is the reference. Every column of an array is a coordinate. Unless `measures`
        is given, a warning is issued if one of three or more columns is time by its name, or alone
        increases from point to point in both curves. A table of three columns or more is refused if
        their names show that they are not all coordinates (docs/reference/accepted_inputs.md).
    preset : {"scaled", "paper", "raw"}
        "scaled": all measures on curves scaled by P's bounding box, area with spacing="matched",
        curve_length with scale="mean_abs". "paper": the conditions of the paper's Table 4 (area raw
        with spacing="x"; frechet, and dtw with step_pattern="symmetric2", on scaled curves;
        curve_length raw with scale="mean"). "raw": every default, on the raw curves.
    measures : sequence of str, optional
        Some of "area", "pcm", "frechet", "dtw", "curve_length", "frechet_continuous", "hausdorff",
        "hausdorff_continuous", "erp", "edr", "lcss", "msm", "twe", "wdtw". The default is "area",
        "pcm", "frechet", "dtw", "curve_length" in the plane, and "frechet", "dtw" in other
        dimensions.
    options : mapping of str to mapping, optional
        Options of measures that override the preset's: {"dtw": {"window": 0.1}}.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    Comparison
        The values by name; prints as a table, plots itself. Its `notes` mention curves that are
        probably in different units. If a measure refuses these curves, the others have their
        values, and `refusals` has the reason.

    Raises
    ------
    ValueError
        If a preset or measure is unknown. If options are given for a measure that is not computed,
        or a measure refuses an option. If every measure refuses the curves.
    TypeError
        If a curve does not hold real numbers, or a measure does not have an option.

    Notes
    -----
    Time O(n m) for frechet and dtw, O(200 (n + m)) for pcm; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> print(curvewise.compare([(0, 0), (1, 1), (2, 0)], [(0, 1), (1, 2), (2, 1)]))
    area          1
    pcm           2.23607
    frechet       1
    dtw           3
    curve_length  2.40113
    >>> P, Q = curvewise.datasets.hysteresis_pair()
    >>> print(curvewise.compare(P, Q, measures=["area"]).deviations["area"])
    mean 54.09 (4 %), largest 99.3 (7.3 %)
    """
    columns = known_names(P, Q)
    curves = skip_in_each(as_curves(P, Q), ["P", "Q"], missing)
    ask_about_curves(*curves)
    P, Q = map(copied, (P, Q), curves)
    check_choice("preset", preset, PRESETS)
    if measures is None:
        measures = default_measures(P)
        _warn_of_time(P, Q, columns, measures)
    if isinstance(measures, str) or not (names := list(measures)):
        raise ValueError(f"measures is {measures!r}; give a list of names, e.g. ['area', 'dtw']")
    given = {} if options is None else options
    for name in (*names, *given):
        check_choice("measure", name, MEASURES)
    for name in given:
        if name not in names:
            raise ValueError(f"options are given for {name!r}, which is not among the measures")
    conditions = {}
    for name in names:
        scaled, of_preset = PRESETS[preset][name]
        conditions[name] = Condition(scaled, {**of_preset, **given.get(name, {})})
    with settled_layout():
        values, errors = _values(conditions, P, Q)
    if len(errors) == len(values):
        raise next(iter(errors.values()))
    refusals = {name: str(error) for name, error in errors.items()}
    return Comparison(P, Q, preset, values, conditions, refusals)


def _warn_of_time(P: Array, Q: Array, names: Sequence[Any], measures: Sequence[str]) -> None:
    """Warn if one of several columns is time: it would count as a coordinate."""
    if P.ndim != 2 or Q.ndim != 2 or P.shape[1] != Q.shape[1] or P.shape[1] < 3:
        return
    times = [i for i, name in enumerate(names) if is_time(name)]
    if not times and min(len(P), len(Q)) > 2:
        rising = (np.diff(P, axis=0) > 0).all(axis=0) & (np.diff(Q, axis=0) > 0).all(axis=0)
        times = [int(i) for i in np.flatnonzero(rising)] if rising.sum() == 1 else []
    if times:
        by_name = bool(names) and is_time(names[times[0]])
        column = repr(names[times[0]]) if by_name else f"{times[0] + 1} of {P.shape[1]}"
        warn(
            f"column {column} counts as a coordinate, and looks like time; leave it out of P and Q,"
            f" or say {with_values('measures', list(measures))} if it shall count"
        )


def _values(
    conditions: Mapping[str, Condition], P: Array, Q: Array
) -> tuple[dict[str, float], dict[str, ValueError]]:
    """Return the values, and for each measure that refuses the curves nan and its error."""
    values, errors = {}, {}
    for name, condition in conditions.items():
        try:
            values[name] = _value(MEASURES[name], condition, P, Q)
        except ValueError as error:
            if not _are_valid(name, condition.options):
                raise
            values[name], errors[name] = math.nan, error
    return values, errors


def _are_valid(measure: str, options: Mapping[str, Any]) -> bool:
    """Return whether a measure takes options, whatever the curves are."""
    try:
        is_symmetric(measure, dict(options))  # it checks the options too
    except (TypeError, ValueError):
        return False
    return True


def _value(info: MeasureInfo, condition: Condition, P: Array, Q: Array) -> float:
    if condition.scaled:
        P, Q = normalize(P, Q)
    return info.function(P, Q, **condition.options)
