"""Pictures of the measures: what each of them saw in two curves.

Every function computes the quadrilaterals, coupling or table with the function that gives the
number, with the same options, so a picture shows the number's own geometry. It draws into a given
matplotlib Axes and returns its artists. Axes are labelled unless they already are; the legend is
left to the caller: ``ax.legend(loc="upper left")``, as the default "best" is slow where points
are many. The pictures are those of figures 5 and 6 of Jekel, Venter, Venter, Stander, Haftka,
"Similarity measures for identifying material parameters from hysteresis loops using inverse
analysis", Int. J. Material Forming (2018), and their like for the other measures.
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
