"""A figure of a whole comparison: both curves, and a panel for each measure."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from ..curves.inputs import Array
from ..drawing.figures import CurveArtists, draw_curves, new_figure, panels
from ..measures.registry import MEASURES, Condition
from .matching import plot_free_space
from .measured import measured_and_drawn
from .table import plot_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from ..drawing.picture import Picture

__all__ = ["plot_comparison"]


class Compared(Protocol):
    """The attributes of a :class:`curvewise.Comparison` that are drawn."""

    @property
    def P(self) -> Array: ...
    @property
    def Q(self) -> Array: ...
    @property
    def preset(self) -> str: ...
    @property
    def values(self) -> Mapping[str, float]: ...
    @property
    def conditions(self) -> Mapping[str, Condition]: ...
    @property
    def refusals(self) -> Mapping[str, str]: ...


def plot_comparison(comparison: Compared, *, names: Sequence[str] | None = None) -> Picture:
    """Draw both curves, and for each measure its value and its plot.

    In the plane the curves fill the large panel and each measure has a small one. For series
    (d = 1) the panels are stacked; for d > 2 they are the tables of Fréchet and DTW.

    Parameters
    ----------
    comparison : Comparison
        The result of `compare`. Its preset decides whether the measured curves are scaled; the plot
        is in original units.
    names : sequence of str, optional
        The labels of the axes; by default the names of the curves' columns (DataFrames,
        `read_curve`), else x and y.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot: ``figure.savefig("comparison.png")``, or .svg, or .pdf.
        Notebooks show it.

    Raises
    ------
    ImportError
        If matplotlib is missing.
    ValueError
        If the number of names differs from the number of coordinates.

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
    _, drawn, labels = measured_and_drawn(comparison.P, comparison.Q, False, names)
    figure = new_figure(layout="constrained")
    main, others = panels(figure, len(labels.axes), len(comparison.values))
    handles = list(draw_curves(main, *drawn, labels))
    for ax, (name, value) in zip(others, comparison.values.items(), strict=True):
        refusal = comparison.refusals.get(name)
        ax.set_title(f"{MEASURES[name].title}: {'no value' if refusal else f'{value:.4g}'}")
        if refusal:
            _write_words(ax, refusal)
            continue
        try:
            accent = _draw_measure(comparison, name, ax, labels.axes)
        except ValueError as error:  # it has a value, but no path: the others have their pictures
            _write_words(ax, f"no picture: {error}")
            continue
        if accent is not None:
            handles.append(accent)
    figure.legend(handles=handles, loc="outside upper left", ncols=len(handles), frameon=False)
    return figure


def _write_words(ax: Axes, words: str) -> None:
    """Write words into a small panel, in which nothing is drawn."""
    ax.set_axis_off()
    ax.text(0.5, 0.5, textwrap.fill(words, 32), ha="center", va="center", transform=ax.transAxes)


def _draw_measure(comparison: Compared, name: str, ax: Axes, axes: Sequence[str]) -> Line2D | None:
    """Draw one measure in a small panel, and return its accent."""
    dim = len(axes)
    info, condition = MEASURES[name], comparison.conditions[name]
    options: dict[str, Any] = dict(condition.options)
    if info.warping:
        options["measure"] = name
    if not info.scales_itself:
        options["normalized"] = condition.scaled
    curves = comparison.P, comparison.Q
    if dim > 2 and name == "frechet_continuous":
        plot_free_space(*curves, ax, **options)
        return None
    if info.warping and dim > 2:
        image, _ = plot_table(*curves, ax, **options)
        ax.figure.colorbar(image)
        return None
    picture = getattr(import_module(__package__), info.picture)
    artists: CurveArtists = picture(*curves, ax, names=axes, **options)
    for line in (artists.P, artists.Q):
        line.set_linewidth(0.9)
    if dim == 2:
        ax.locator_params(nbins=4)
    return artists.accent
