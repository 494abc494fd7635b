"""The table of all measures and their properties.

The command line, compare, the batches, the plots, the objectives of a calibration and the
self-check use this table instead of separate lists of measures. The plotting function and the
reference of a measure are named and not imported, so that ``import curvewise`` stays fast.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

from .._core import presets
from ..curves.inputs import Array
from . import edit_distances
from .area import area
from .curve_length import curve_length, curve_length_residuals
from .dtw import dtw, dtw_path, dtw_table
from .edit_distances import EditDistance, edit_path, edit_table
from .frechet import frechet, frechet_path, frechet_table
from .frechet_continuous import frechet_continuous
from .hausdorff import hausdorff
from .hausdorff_continuous import hausdorff_continuous
from .pcm import pcm
from .results import Alignment

__all__ = [
    "MEASURES",
    "PRESETS",
    "WARPINGS",
    "Condition",
    "MeasureInfo",
    "MeasureName",
    "Warping",
    "default_measures",
]


MeasureName: TypeAlias = (
    Literal[
        "area",
        "pcm",
        "frechet",
        "dtw",
        "curve_length",
        "frechet_continuous",
        "hausdorff",
        "hausdorff_continuous",
    ]
    | EditDistance
)


class Condition(NamedTuple):
    """Conditions of a measure in a preset: scaled or not, and options."""

    scaled: bool
    options: dict[str, Any]


class Warping(NamedTuple):
    """Further functions of a measure with a table of all pairs of points."""

    path: Callable[..., Alignment]
    table: Callable[..., Array]


class MeasureInfo(NamedTuple):
    """One measure.

    Attributes
    ----------
    name : str
        The public name, and the name of the function in the reference.
    title : str
        The title of its plot.
    function : callable
        The measure.
    planar : bool
        Whether it is for curves in the plane only, or for any dimension.
    symmetric : bool
        Whether P and Q may be exchanged, with the default options.
    picture : str
        The function of :mod:`curvewise.plotting` that draws it.
    warping : Warping, optional
        The functions that return the path and the table, if the measure has a table.
    residuals : callable, optional
        The function that returns the vector whose norm is the measure, if it is a norm.
    scales_itself : bool
        Whether it always scales both curves by P's bounding box, so that a preset need not.
    by_default : bool
        Whether compare computes it by default.
    """

    name: MeasureName
    title: str
    function: Callable[..., float]
    planar: bool
    symmetric: bool
    picture: str
    warping: Warping | None = None
    residuals: Callable[..., Array] | None = None
    scales_itself: bool = False
    by_default: bool = True


MEASURES: Mapping[str, MeasureInfo] = {
    info.name: info
    for info in (
        MeasureInfo(
            name="area",
            title="Area",
            function=area,
            planar=True,
            symmetric=True,
            picture="plot_area",
        ),
        MeasureInfo(
            name="pcm",
            title="Partial curve mapping",
            function=pcm,
            planar=True,
            symmetric=False,
            picture="plot_pcm",
            scales_itself=True,
        ),
        MeasureInfo(
            name="frechet",
            title="Fréchet",
            function=frechet,
            planar=False,
            symmetric=True,
            picture="plot_alignment",
            warping=Warping(frechet_path, frechet_table),
        ),
        MeasureInfo(
            name="dtw",
            title="DTW",
            function=dtw,
            planar=False,
            symmetric=True,
            picture="plot_alignment",
            warping=Warping(dtw_path, dtw_table),
        ),
        MeasureInfo(
            name="curve_length",
            title="Curve length",
            function=curve_length,
            planar=True,
            symmetric=False,
            picture="plot_curve_length",
            residuals=curve_length_residuals,
        ),
        MeasureInfo(
            name="frechet_continuous",
            title="Continuous Fréchet",
            function=frechet_continuous,
            planar=False,
            symmetric=True,
            picture="plot_matching",
            by_default=False,
        ),
        MeasureInfo(
            name="hausdorff",
            title="Hausdorff",
            function=hausdorff,
            planar=False,
            symmetric=True,
            picture="plot_farthest",
            by_default=False,
        ),
        MeasureInfo(
            name="hausdorff_continuous",
            title="Continuous Hausdorff",
            function=hausdorff_continuous,
            planar=False,
            symmetric=True,
            picture="plot_farthest_of_lines",
            by_default=False,
        ),
        *(
            MeasureInfo(
                name=name,
                title=name.upper(),
                function=getattr(edit_distances, name),
                planar=False,
                symmetric=True,
                picture="plot_alignment",
                warping=Warping(
                    partial(edit_path, measure=name), partial(edit_table, measure=name)
                ),
                by_default=False,
            )
            for name in get_args(EditDistance)
        ),
    )
}

WARPINGS = {name: info.warping for name, info in MEASURES.items() if info.warping}

PRESETS: dict[str, dict[str, Condition]] = {
    preset: {name: Condition(*condition) for name, condition in conditions.items()}
    for preset, conditions in presets().items()
}


def default_measures(curve: Array) -> list[str]:
    """Return the measures that compare computes: in the plane five, else those of any dimension."""
    in_plane = curve.ndim == 2 and curve.shape[1] == 2
    return [
        name for name, info in MEASURES.items() if info.by_default and (in_plane or not info.planar)
    ]
