"""The base class of results: display as text, in notebooks and in reports.

A result defines its tables and paragraphs, and draws its figure from arrays; only this module
displays them. In a notebook, the figure of `plot()` is embedded as PNG, so that the notebook keeps
it. Without matplotlib, the tables are shown with a note that it is missing. Cost: that of `plot()`.
"""

from __future__ import annotations

import base64
import html
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["Result", "Table", "Tabular", "paragraph", "text_of"]


@dataclass(frozen=True)
class Table:
    """Rows of texts; columns of numbers are set to the right.

    Attributes
    ----------
    rows : sequence of sequence of str
        The rows, all with the same number of cells.
    header : sequence of str
        The names of the columns; omitted if empty.
    narrowest : int
        The least width of a column of numbers in characters, as text.
    """

    rows: Sequence[Sequence[str]]
    header: Sequence[str] = ()
    narrowest: int = 0

    @property
    def first_width(self) -> int:
        """How many characters the first column takes."""
        return max((len(row[0]) for row in (self.header, *self.rows) if row), default=0)

    def text(self, first_width: int = 0) -> str:
        """Return the table as lines; `first_width` is the first column's least width."""
        rows = [self.header, *self.rows] if self.header else self.rows
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        widths[0] = max(widths[0], first_width)
        formats = [
            f">{max(width, self.narrowest)}" if is_right else f"<{width}"
            for width, is_right in zip(widths, self._are_numbers(), strict=True)
        ]
        lines = [map(format, row, formats) for row in rows]
        return "\n".join("  ".join(line).rstrip() for line in lines)

    def html(self) -> str:
        """Return the table as HTML."""
        sides = ["right" if is_right else "left" for is_right in self._are_numbers()]

        def row(cells: Sequence[str], tag: str) -> str:
            pairs = zip(sides, map(html.escape, cells), strict=True)
            made = [f'<{tag} style="text-align: {side}">{cell}</{tag}>' for side, cell in pairs]
            return f"<tr>{''.join(made)}</tr>"

        head = [f"<thead>{row(self.header, 'th')}</thead>"] if self.header else []
        body = [row(cells, "td") for cells in self.rows]
        return "\n".join(["<table>", *head, "<tbody>", *body, "</tbody></table>"])

    def _are_numbers(self) -> list[bool]:
        """Return for each column whether its cells are numbers, or empty but not all of them."""
        columns = zip(*self.rows, strict=True) if self.rows else [()] * len(self.header)
        return [any(column) and all(map(_is_number, column)) for column in columns]


def _is_number(cell: str) -> bool:
    try:
        float(cell.lstrip("<>") or "0")  # an interval's end may have a mark
    except ValueError:
        return False
    return True


class Tabular(ABC):
    """A result without a picture: tables and paragraphs."""

    @abstractmethod
    def parts(self) -> Sequence[Table | str]:
        """Return the tables and paragraphs of the result, in order."""

    def __str__(self) -> str:
        return text_of(self.parts())

    def _repr_html_(self) -> str:
        parts = self.parts()
        return "\n".join(paragraph(one) if isinstance(one, str) else one.html() for one in parts)


class Result(Tabular):
    """A result with a picture, which a notebook shows below its tables."""

    @property
    @abstractmethod
    def picture_shows(self) -> str:
        """What the picture shows, for those who do not see it."""

    @abstractmethod
    def plot(self) -> Picture:
        """Return a matplotlib Figure."""

    def _repr_html_(self) -> str:
        return f"{super()._repr_html_()}\n{_picture(self.plot, self.picture_shows)}"


def text_of(parts: Sequence[Table | str]) -> str:
    """Return tables and paragraphs as text; the first columns of all tables are equally wide."""
    first_width = max((part.first_width for part in parts if isinstance(part, Table)), default=0)
    texts = (part if isinstance(part, str) else part.text(first_width) for part in parts)
    return "\n\n".join(texts)


def paragraph(text: str) -> str:
    """Return a text as a paragraph of HTML, its lines as lines."""
    return f"<p>{'<br>'.join(map(html.escape, text.splitlines()))}</p>"


def _picture(plot: Callable[[], Picture], shows: str) -> str:
    """Return a figure as an HTML image, or the reason for its absence."""
    try:
        png = plot().png()
    except (ImportError, ValueError) as error:
        return paragraph(f"No picture: {error}")
    data = base64.b64encode(png).decode("ascii")
    style = "max-width: 100%"
    return f'<img alt="{html.escape(shows)}" style="{style}" src="data:image/png;base64,{data}">'
