"""Pictures of the measures: what each of them saw in two curves.

Every function uses the quadrilaterals, coupling or table that the measure's own function computes
with the same options. A plot therefore shows the geometry of the value. It is drawn into a given
matplotlib Axes, and its artists are returned. Axes are labelled unless they already are. The legend
is left to the caller: use ``ax.legend(loc="upper left")``, because the default "best" is slow for
many points. The plots are those of figures 5 and 6 of Jekel, Venter, Venter, Stander, Haftka,
"Similarity measures for identifying material parameters from hysteresis loops using inverse
analysis", Int. J. Material Forming (2018), and similar ones for the other measures.
"""

from __future__ import annotations

from .._names import names_alone
from ..drawing.figures import CurveArtists
from .alignment import plot_alignment
from .animation import animate_alignment
from .area import plot_area
from .comparison import plot_comparison
from .curve_length import plot_curve_length
from .farthest import plot_farthest, plot_farthest_of_lines
from .matching import plot_free_space, plot_matching
from .pcm import plot_pcm
from .table import plot_table

__all__ = [
    "CurveArtists",
    "animate_alignment",
    "plot_alignment",
    "plot_area",
    "plot_comparison",
    "plot_curve_length",
    "plot_farthest",
    "plot_farthest_of_lines",
    "plot_free_space",
    "plot_matching",
    "plot_pcm",
    "plot_table",
]
__dir__ = names_alone(__all__)
