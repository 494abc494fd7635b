"""The base of every result: what it says and draws, as text, in a notebook and on a page.

A result says which tables and paragraphs it consists of, and draws its picture of arrays; how these
are shown is said here alone. In a notebook the picture is the one that `plot()` draws, as PNG
within the text, so that the notebook keeps it. Without matplotlib the tables stand alone, with a
sentence that says so. Cost: that of `plot()`.
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

__all__ = ["Result", "Table", "Tabular", "paragraph"]


@dataclass(frozen=True)
class Table:
    """Rows of texts; columns of numbers are set to the right.

    Attributes
    ----------
    rows : sequence of sequence of str
        As many cells in each.
    header : sequence of str
        What the columns are called; none if empty.
    narrowest : int
        How many characters wide a column of numbers is at least, as text.
    """

    rows: Sequence[Sequence[str]]
    header: Sequence[str] = ()
    narrowest: int = 0

    @property
    def first_width(self) -> int:
        """How many characters the first column takes."""
        return max((len(row[0]) for row in (self.header, *self.rows) if row), default=0)

    def text(self, first_width: int = 0) -> str:
        """Return the table as lines, the first column at least so many characters wide."""
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
        float(cell or "0")
    except ValueError:
        return False
    return True


class Tabular(ABC):
    """A result without a picture: tables and paragraphs."""

    @abstractmethod
    def parts(self) -> Sequence[Table | str]:
        """Return the tables and paragraphs that say what was found, in their order."""

    def __str__(self) -> str:
        parts = self.parts()  # the first columns of all tables become equally wide
        first_width = max(part.first_width for part in parts if isinstance(part, Table))
        texts = (part if isinstance(part, str) else part.text(first_width) for part in parts)
        return "\n\n".join(texts)

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


def paragraph(text: str) -> str:
    """Return a text as a paragraph of HTML, its lines as lines."""
    return f"<p>{'<br>'.join(map(html.escape, text.splitlines()))}</p>"


def _picture(plot: Callable[[], Picture], shows: str) -> str:
    """Return a picture as an image of HTML, or a sentence that says why there is none."""
    try:
        png = plot().png()
    except (ImportError, ValueError) as error:
        return paragraph(f"No picture: {error}")
    data = base64.b64encode(png).decode("ascii")
    style = "max-width: 100%"
    return f'<img alt="{html.escape(shows)}" style="{style}" src="data:image/png;base64,{data}">'
