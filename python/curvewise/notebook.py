"""What notebooks show of a result: a table of its numbers and, where it has one, its picture.

The picture is the one that `plot()` draws, as PNG within the text, so that the notebook keeps it.
Without matplotlib the table stands alone, with a sentence that says so. Cost: that of `plot()`.
"""

from __future__ import annotations

import base64
import html
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .compare import Comparison
    from .deviations import Deviation, Deviations
    from .plotting.picture import Picture
    from .results import Alignment, Matching, PcmMatch

__all__ = [
    "alignment_html",
    "comparison_html",
    "deviations_html",
    "match_html",
    "matching_html",
    "paragraph",
    "picture",
    "table",
]


def table(rows: Iterable[Sequence[str]], header: Sequence[str] = ()) -> str:
    """Return rows as a table of HTML; all but the first column are numbers, to the right."""
    lines = ["<table>"]
    if header:
        lines.append(f"<thead>{_row(header, 'th')}</thead>")
    lines += ["<tbody>", *(_row(row, "td") for row in rows), "</tbody></table>"]
    return "\n".join(lines)


def _row(cells: Sequence[str], tag: str) -> str:
    first, *others = map(html.escape, cells)
    right = "".join(f'<{tag} style="text-align: right">{cell}</{tag}>' for cell in others)
    return f'<tr><th style="text-align: left">{first}</th>{right}</tr>'


def paragraph(text: str) -> str:
    """Return a text as a paragraph, its lines as lines."""
    return f"<p>{'<br>'.join(map(html.escape, text.splitlines()))}</p>"


def picture(draw: Callable[[], Picture], about: str) -> str:
    """Return what is drawn as an image; without matplotlib a sentence."""
    try:
        drawn = draw()
    except ImportError as error:
        return paragraph(f"No picture: {error}")
    data = base64.b64encode(drawn.png()).decode("ascii")
    style = "max-width: 100%"
    return f'<img alt="{html.escape(about)}" style="{style}" src="data:image/png;base64,{data}">'


def comparison_html(comparison: Comparison) -> str:
    """Return a comparison's values and deviations, and its picture."""
    deviations = comparison.deviations
    rows = []
    for name, value in comparison.values.items():
        rows.append([name, f"{value:.6g}", *_parts(deviations.get(name))])
    header = ["measure", "value", "mean deviation, in units of y", "largest"]
    about = f"The curves, and what {', '.join(comparison.values)} saw in them"
    return "\n".join(
        [
            table(rows, header),
            paragraph(f"preset {comparison.preset}"),
            picture(comparison.plot, about),
        ]
    )


def deviations_html(deviations: Deviations) -> str:
    """Return deviations by measure."""
    header = ["measure", "mean deviation, in units of y", "largest"]
    return table([[name, *_parts(found)] for name, found in deviations.items()], header)


def _parts(found: Deviation | None) -> list[str]:
    return ["", ""] if found is None else [found.mean_text, found.largest_text]


def alignment_html(found: Alignment) -> str:
    """Return an alignment's distance and length, and its picture."""
    rows = [["distance", f"{found.distance:.6g}"], ["pairs of points", f"{len(found.path)}"]]
    return table(rows) + picture(found.plot, "The curves and which points are matched")


def matching_html(found: Matching) -> str:
    """Return a matching's distance, and its picture."""
    rows = [["distance", f"{found.distance:.6g}"]]
    return table(rows) + picture(found.plot, "The curves and which points are matched")


def match_html(found: PcmMatch) -> str:
    """Return a match's numbers and, where it knows its curves, its picture."""
    rows = [
        ["value", f"{found.value:.6g}"],
        ["offset on the longer curve, scaled", f"{found.offset:.6g}"],
        ["coverage", f"{100 * found.coverage:.3g} %"],
        ["shorter curve", found.mapped],
    ]
    drawn = picture(found.plot, "The curves and where the shorter lies") if found.curves else ""
    return table(rows) + drawn
