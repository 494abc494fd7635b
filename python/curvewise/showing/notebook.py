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
    from ..drawing.picture import Picture

__all__ = ["paragraph", "picture", "table"]


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
