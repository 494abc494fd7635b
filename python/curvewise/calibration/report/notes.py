"""Sections of a report on the preparation of the tests, with a figure each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ...curves.inputs import Array
from ...showing.result import paragraph
from . import figures
from .figures import Figure

__all__ = ["Note", "note_section"]


class Note(NamedTuple):
    """A report's section on the preparation of one test.

    Attributes
    ----------
    title : str
        Its heading.
    sentences : sequence of str
        The paragraphs.
    curves : tuple of ndarray, shape (n, 2)
        The beginning of the test before and after the preparation.
    axes : sequence of str
        The names of the coordinates; empty if they are unknown.
    """

    title: str
    sentences: Sequence[str]
    curves: tuple[Array, Array]
    axes: Sequence[str] = ()


def note_section(note: Note, add: Callable[[Figure, str], str], most: int) -> str:
    """Return a note as HTML: its sentences, and the first per cent of strain before and after."""
    figure = figures.before_and_after(note.curves, note.axes or ("strain", "stress"), most)
    drawn = add(figure, f"{note.title}: the first per cent of strain")
    texts = [paragraph(sentence) for sentence in note.sentences]
    heading = paragraph(note.title).replace("<p>", "<h2>").replace("</p>", "</h2>")
    return "\n".join(
        ["<section>", heading, *texts, f'<div class="figures">{drawn}</div>', "</section>"]
    )
