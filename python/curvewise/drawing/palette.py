"""The colours of all figures and reports, from Okabe and Ito.

They can be distinguished with any colour vision, and most of them in grey too. A colour always has
the same meaning: P, the test, is blue, and Q, the simulation, vermilion. Connections between curves
and the background are grey. The part that decides a value is black. If more than two curves are
drawn, they take `SERIES` in its order.

M. Okabe, K. Ito, "Color universal design" (2008), https://jfly.uni-koeln.de/color.
"""

from __future__ import annotations

__all__ = [
    "ACCENT_COLOUR",
    "BETWEEN_COLOUR",
    "CORRELATION_MAP",
    "FILL_COLOUR",
    "GROUND_COLOUR",
    "P_COLOUR",
    "Q_COLOUR",
    "SERIES",
    "TABLE_MAP",
    "series_colours",
]

P_COLOUR = "#0072B2"
Q_COLOUR = "#D55E00"
BETWEEN_COLOUR = "#808080"
FILL_COLOUR = "#A0A0A0"
GROUND_COLOUR = "#D8D8D8"  # bars and lines that others are drawn on
ACCENT_COLOUR = "#000000"

# Colours of further curves: vermilion, green, purple, orange, sky blue, black, blue.
SERIES = (Q_COLOUR, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", ACCENT_COLOUR, P_COLOUR)

# Maps of matplotlib: dark is far; and red against blue for what may be below and above 0.
TABLE_MAP = "viridis_r"
CORRELATION_MAP = "RdBu"


def series_colours(count: int) -> list[str]:
    """Return a colour for each of `count` curves; they repeat after seven."""
    return [SERIES[i % len(SERIES)] for i in range(count)]
