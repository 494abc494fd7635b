"""A matplotlib Figure that a notebook shows as a picture, whatever else has been imported.

matplotlib's own Figure is shown by Jupyter only once pyplot has been set up for it; before that a
notebook prints ``<Figure size 1100x580 with 6 Axes>``. And a Figure that pyplot does not know is
shown only as the value of a cell, not in the middle of one or before a semicolon. To have it known
to pyplot would open windows in scripts, keep every picture of a loop in memory, and show it twice
as the value of a cell. So a picture made while a cell runs waits for the cell's end, and is shown
then unless it has been drawn by that time, to be seen or to be saved. Outside of notebooks nothing
knows of a picture except its user.

This module imports matplotlib: :func:`curvewise.drawing.figures.new_figure` imports it when a
picture is drawn.
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
        """Draw the picture; IPython calls it too, which need not show it any more."""
        super().draw(renderer)
        self.was_drawn = True

    def _repr_png_(self) -> bytes:
        return self.png()

    def png(self, dpi: float = _DPI) -> bytes:
        """Return the picture as a PNG file, with nothing in it of when it was drawn."""
        file = io.BytesIO()
        self.savefig(file, format="png", dpi=dpi, metadata={"Software": None})
        return file.getvalue()


def _show_after_cell(picture: Picture) -> None:
    """Show a picture when the notebook's cell that makes it has run; do nothing elsewhere."""
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
