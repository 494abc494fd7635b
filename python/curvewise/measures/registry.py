"""What the package knows of each measure, in one table.

The command line, compare, the batches, the pictures, the objectives of a calibration and the
self-check go through this table, and have no list of measures of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from .. import _core, reference
from .._curves import Array
from .._options import MeasureName
from ..results import Alignment
from .area import area
from .curve_length import curve_length, curve_length_residuals
from .dtw import dtw, dtw_path, dtw_table
from .frechet import frechet, frechet_path, frechet_table
from .pcm import pcm

__all__ = [
    "MEASURES",
    "PRESETS",
    "WARPINGS",
    "Condition",
    "MeasureInfo",
    "WarpingInfo",
    "default_measures",
]


class Condition(NamedTuple):
    """How a preset computes one measure: on curves scaled by P's box or not, with what options."""

    scaled: bool
    options: dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class MeasureInfo:
    """One measure.

    Attributes
    ----------
    name : str
        The name by which users choose it.
    title : str
        The title of its picture.
    function, reference : callable
        The measure, compiled and in plain numpy.
    planar : bool
        Whether it is for curves in the plane only, or for any dimension.
    symmetric : bool
        Whether P and Q may change places, with the default options.
    picture : str
        The function of :mod:`curvewise.plotting` that draws it; by name, since that module is
        imported where something is drawn and not before.
    residuals : callable, optional
        The function that returns the vector of which the measure is the norm, where it is one.
    scales_itself : bool
        Whether it always scales both curves by P's box, so that a preset need not.
    """

    name: MeasureName
    title: str
    function: Callable[..., float]
    reference: Callable[..., float]
    planar: bool
    symmetric: bool
    picture: str
    residuals: Callable[..., Array] | None = None
    scales_itself: bool = False


@dataclass(frozen=True, kw_only=True)
class WarpingInfo(MeasureInfo):
    """One measure that is read off a table of all pairs of points.

    Attributes
    ----------
    path, table : callable
        The functions that return the path through the table, and the table.
    """

    path: Callable[..., Alignment]
    table: Callable[..., Array]


MEASURES: Mapping[str, MeasureInfo] = {
    info.name: info
    for info in (
        MeasureInfo(
            name="area",
            title="Area",
            function=area,
            reference=reference.area,
            planar=True,
            symmetric=True,
            picture="plot_area",
        ),
        MeasureInfo(
            name="pcm",
            title="Partial curve mapping",
            function=pcm,
            reference=reference.pcm,
            planar=True,
            symmetric=False,
            picture="plot_pcm",
            scales_itself=True,
        ),
        WarpingInfo(
            name="frechet",
            title="Fréchet",
            function=frechet,
            reference=reference.frechet,
            planar=False,
            symmetric=True,
            picture="plot_alignment",
            path=frechet_path,
            table=frechet_table,
        ),
        WarpingInfo(
            name="dtw",
            title="DTW",
            function=dtw,
            reference=reference.dtw,
            planar=False,
            symmetric=True,
            picture="plot_alignment",
            path=dtw_path,
            table=dtw_table,
        ),
        MeasureInfo(
            name="curve_length",
            title="Curve length",
            function=curve_length,
            reference=reference.curve_length,
            planar=True,
            symmetric=False,
            picture="plot_curve_length",
            residuals=curve_length_residuals,
        ),
    )
}

WARPINGS = {name: info for name, info in MEASURES.items() if isinstance(info, WarpingInfo)}

PRESETS: dict[str, dict[str, Condition]] = {
    preset: {name: Condition(*condition) for name, condition in conditions.items()}
    for preset, conditions in _core.presets().items()
}


def default_measures(curve: Array) -> list[str]:
    """Return the measures that suit a curve: in the plane all, else those of any dimension."""
    in_plane = curve.ndim == 2 and curve.shape[1] == 2
    return [name for name, info in MEASURES.items() if in_plane or not info.planar]
