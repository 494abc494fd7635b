"""A matplotlib Figure that a notebook shows as a picture, whatever else has been imported.

matplotlib's own Figure is shown by Jupyter only once pyplot has been set up for it; before that a
notebook prints ``<Figure size 1100x580 with 6 Axes>``. This module imports matplotlib:
:func:`curvewise.drawing.figures.new_figure` imports it when a picture is drawn.
"""

from __future__ import annotations

import io

from matplotlib.figure import Figure

__all__ = ["Picture"]

_DPI = 80  # on the page of a notebook


class Picture(Figure):
    """A Figure that is not registered with pyplot; Jupyter shows it as PNG."""

    def _repr_png_(self) -> bytes:
        return self.png()

    def png(self, dpi: float = _DPI) -> bytes:
        """Return the picture as a PNG file, with nothing in it of when it was drawn."""
        file = io.BytesIO()
        self.savefig(file, format="png", dpi=dpi, metadata={"Software": None})
        return file.getvalue()
