"""The cumulative table of DTW or Fréchet, and the path through it. Memory 8 n m bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._options import WarpingName
from ..curves.inputs import CurveLike
from ..drawing.figures import matplotlib_required
from ..drawing.links import draw_walk
from ..drawing.palette import TABLE_MAP
from .measured import measured_and_drawn, warping_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D

__all__ = ["plot_table"]

_MAX_TABLE_SIDE = 1000  # entries; about the pixels of a panel


def plot_table(
    P: CurveLike,
    Q: CurveLike,
    ax: Axes,
    *,
    measure: WarpingName = "dtw",
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
        The axes to draw in: i, the index in P, upwards, and j, the index in Q, to the right.
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
        As for `dtw_table` or `frechet_table`, before anything is drawn.

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
    with matplotlib_required():
        from matplotlib.patheffects import withStroke
    warping = warping_of(measure)
    measured, _, labels = measured_and_drawn(P, Q, normalized)
    table = warping.table(*measured, **options)
    path = warping.path(*measured, **options).path
    n, m = table.shape
    steps = [-(-size // _MAX_TABLE_SIDE) for size in (n, m)]
    shown = table[:: steps[0], :: steps[1]]
    # Pixel centres are at the indices of the rows and columns drawn.
    rows, columns = (
        (-step / 2, (size - 0.5) * step) for size, step in zip(shown.shape, steps, strict=True)
    )
    image = ax.imshow(
        shown,
        cmap=TABLE_MAP,
        origin="lower",
        aspect="auto",
        interpolation="nearest",
        extent=(*columns, *rows),
    )
    line = draw_walk(ax, path, "index in", labels)
    line.set_path_effects([withStroke(linewidth=3, foreground="white")])  # legible on any colour
    ax.set(xlim=(-0.5, m - 0.5), ylim=(-0.5, n - 0.5))
    return image, line
