"""A matplotlib Figure that notebooks always show as an image.

Jupyter shows matplotlib's own Figure only after pyplot has been set up for it; before that a
notebook prints ``<Figure size 1100x580 with 6 Axes>``. A Figure that pyplot does not manage is
shown only as the value of a cell, not in the middle of a cell or before a semicolon. Registration
with pyplot would open windows in scripts, keep every figure of a loop in memory, and show a figure
twice as the value of a cell. A figure that is made while a cell runs is therefore shown at the end
of the cell, unless it has been drawn or saved by then. Outside notebooks only the user holds a
reference to a figure.

This module imports matplotlib; :func:`curvewise.drawing.figures.new_figure` imports it when a
figure is drawn.
"""

from __future__ import annotations

import io
import sys
from typing import Any

from matplotlib.figure import Figure

__all__ = ["Picture"]

_DPI = 80  # on the page of a notebook


class Picture(Figure):
    """A Figure that is not registered with pyplot; Jupyter shows it as PNG."""

    was_drawn = False

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        _show_after_cell(self)

    def draw(self, renderer: Any) -> None:
        """Draw the figure, which then need not be shown again (IPython calls this)."""
        super().draw(renderer)
        self.was_drawn = True

    def _repr_png_(self) -> bytes:
        return self.png()

    def png(self, dpi: float = _DPI) -> bytes:
        """Return the figure as a PNG file without a time stamp."""
        file = io.BytesIO()
        self.savefig(file, format="png", dpi=dpi, metadata={"Software": None})
        return file.getvalue()


def _show_after_cell(picture: Picture) -> None:
    """Show a figure at the end of the notebook's cell; do nothing elsewhere."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    # A terminal shows no pictures; callbacks of widgets run outside of any cell.
    if shell is None or "image/png" not in shell.display_formatter.active_types:
        return
    if shell.displayhook.exec_result is None:
        return

    def show(ran: Any) -> None:
        shell.events.unregister("post_run_cell", show)
        if ran.success and ran.result is not picture and not picture.was_drawn:
            sys.modules["IPython.display"].display(picture)

    shell.events.register("post_run_cell", show)
