"""Pictures of the measures: what each of them saw in two curves.

Every function computes the quadrilaterals, coupling or table with the function that gives the
number, with the same options, so a picture shows the number's own geometry. It draws into a given
matplotlib Axes and returns its artists. Axes are labelled unless they already are; the legend is
left to the caller: ``ax.legend(loc="upper left")``, as the default "best" is slow where points
are many. The table is drawn as in figure 5 of Jekel, Venter, Venter, Stander, Haftka, "Similarity
measures for identifying material parameters from hysteresis loops using inverse analysis", Int.
J. Material Forming (2018).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from . import _drawing as drawing
from ._curve_pictures import (
    CurveArtists,
    plot_alignment,
    plot_area,
    plot_curve_length,
    plot_pcm,
)
from ._curves import CurveLike
from .compare import PRESETS
from .measures import dtw_path, dtw_table, frechet_path, frechet_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D

    from .compare import Comparison

__all__ = [
    "CurveArtists",
    "plot_alignment",
    "plot_area",
    "plot_comparison",
    "plot_curve_length",
    "plot_pcm",
    "plot_table",
]

_MAX_TABLE_SIDE = 1000  # entries; about the pixels of a panel

_TITLES = {
    "area": "Area",
    "pcm": "Partial curve mapping",
    "frechet": "Fréchet",
    "dtw": "DTW",
    "curve_length": "Curve length",
}

_PICTURES: dict[str, Callable[..., CurveArtists]] = {
    "area": plot_area,
    "pcm": plot_pcm,
    "frechet": partial(plot_alignment, measure="frechet"),
    "dtw": partial(plot_alignment, measure="dtw"),
    "curve_length": plot_curve_length,
}


def plot_table(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    measure: Literal["dtw", "frechet"] = "dtw",
    normalized: bool = False,
    **options: Any,
) -> tuple[AxesImage, Line2D]:
    """Draw the cumulative table of DTW or Fréchet, and the path through it.

    Cells outside a window are blank. Of tables with more than 1000 rows or columns, every k-th
    is drawn. ``ax.figure.colorbar(image)`` adds a colour bar.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,)
        The curves, of any d.
    ax : matplotlib.axes.Axes
        Where to draw: i, the index in P, upwards, and j, the index in Q, to the right.
    measure : {"dtw", "frechet"}
        Whose table to draw.
    normalized : bool
        As in `plot_area`.
    **options
        Passed to `dtw_table` and `dtw_path`, or `frechet_table` and `frechet_path`.

    Returns
    -------
    image : matplotlib.image.AxesImage
        The table.
    path : matplotlib.lines.Line2D
        The path.

    Raises
    ------
    ValueError, TypeError, MemoryError
        Where `dtw_table` or `frechet_table` does, before anything is drawn.

    Notes
    -----
    O(n·m) time and memory: 8·n·m bytes. The paper's Fig. 5.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from curvewise.plotting import plot_table
    >>> image, path = plot_table([0, 1, 2], [0, 2], Figure().subplots(), measure="frechet")
    >>> path.get_xydata().tolist()
    [[0.0, 0.0], [0.0, 1.0], [1.0, 2.0]]
    """
    with drawing.matplotlib_required():
        from matplotlib.patheffects import withStroke
    drawing.check_measure(measure)
    measured, _ = drawing.measured_and_drawn(P, Q, normalized)
    table = (dtw_table if measure == "dtw" else frechet_table)(*measured, **options)
    path = (dtw_path if measure == "dtw" else frechet_path)(*measured, **options).path
    n, m = table.shape
    row_step, column_step = (-(-size // _MAX_TABLE_SIDE) for size in (n, m))
    shown = table[::row_step, ::column_step]
    rows, columns = shown.shape
    image = ax.imshow(
        shown,
        cmap="viridis_r",
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        # Pixel centres are at the indices of the rows and columns drawn.
        extent=(
            -column_step / 2,
            (columns - 0.5) * column_step,
            -row_step / 2,
            (rows - 0.5) * row_step,
        ),
    )
    (line,) = ax.plot(
        *path.T[::-1],
        color=drawing.ACCENT_COLOUR,
        linewidth=1.3,
        path_effects=[withStroke(linewidth=3, foreground="white")],  # legible on any colour
        label="path",
    )
    ax.set(xlim=(-0.5, m - 0.5), ylim=(-0.5, n - 0.5))
    drawing.label_axes(ax, "index in Q", "index in P")
    return image, line


def plot_comparison(comparison: Comparison) -> Figure:
    """Draw both curves, and for each measure of a comparison its value and its picture.

    In the plane the curves fill the large panel and each measure has a small one. For series
    (d = 1) the panels are stacked; for d > 2 they are the tables of Fréchet and DTW.

    Parameters
    ----------
    comparison : Comparison
        What `compare` returned. Its preset decides which curves are measured, scaled or not;
        the picture is in original units.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot: ``figure.savefig("comparison.png")``.

    Raises
    ------
    ImportError
        Without matplotlib.

    Notes
    -----
    Time and memory of the paths, and of the tables (8·n·m bytes) for d > 2.

    Examples
    --------
    >>> from curvewise import compare
    >>> from curvewise.plotting import plot_comparison
    >>> figure = plot_comparison(compare([[0, 0], [1, 2], [2, 2]], [[0, 0], [2, 1]]))
    >>> [ax.get_title() for ax in figure.axes][1:3]
    ['Area: 0.5', 'Partial curve mapping: 0.3953']
    """
    with drawing.matplotlib_required():
        from matplotlib.figure import Figure
    P, Q = comparison.P, comparison.Q
    _, drawn = drawing.measured_and_drawn(P, Q, normalized=False)
    dim = drawn[0].shape[1]
    figure = Figure(layout="constrained")
    main, others = drawing.panels(figure, dim, len(comparison.values))
    main.set_title(f"Preset: {comparison.preset}")
    if dim > 2:
        main.set(xlabel="coordinate 0", ylabel="coordinate 1")
    handles = list(drawing.draw_curves(main, *(curve[:, :2] for curve in drawn)))
    for ax, (name, value) in zip(others, comparison.values.items(), strict=True):
        ax.set_title(f"{_TITLES[name]}: {value:.4g}")
        accent = _draw_measure(comparison, name, ax, dim)
        if accent is not None:
            handles.append(accent)
    figure.legend(handles=handles, loc="outside upper left", ncols=len(handles), frameon=False)
    return figure


def _draw_measure(comparison: Comparison, name: str, ax: Axes, dim: int) -> Line2D | None:
    """Draw the picture of one measure into a small panel, and return its accent."""
    condition = PRESETS[comparison.preset][name]
    options = dict(condition.options)
    if name != "pcm":  # which scales in any case
        options["normalized"] = condition.scaled
    curves = comparison.P, comparison.Q
    if dim > 2:
        image, _ = plot_table(*curves, ax, measure="dtw" if name == "dtw" else "frechet", **options)
        ax.figure.colorbar(image)
        return None
    artists = _PICTURES[name](*curves, ax, **options)
    for line in (artists.P, artists.Q):
        line.set_linewidth(0.9)
    if dim == 2:
        ax.locator_params(nbins=4)
    return artists.accent
