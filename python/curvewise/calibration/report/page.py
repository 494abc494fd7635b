"""The page itself: head, sections, figures as JSON, and plotly.js to draw them.

The page consists of a head, sections, figures as JSON, and plotly.js. plotly.js has four to five
megabytes and compresses to a third. The page contains it as gzip in base64, and the browser unpacks
it (DecompressionStream: Chrome 80, Safari 16.4, Firefox 113 and later). An older browser shows the
tables and the reason for the missing figures. The page does not load anything.
"""

from __future__ import annotations

import base64
import gzip
import html
import json
import os
from collections.abc import Sequence
from functools import lru_cache
from importlib import import_module, resources
from pathlib import Path

from ..._extras import extra
from ...showing.result import paragraph
from ..records.search_record import SearchRecord
from .figures import Figure
from .notes import Note, note_section
from .sections import most_points, overview, sections_of
from .shown_search import ShownSearch
from .verdict import verdict_of

__all__ = ["page", "write_report"]

_POINTS = 120_000  # of all curves together: some 2 MB
_LEAST_SIDE = 240


def write_report(
    path: str | os.PathLike[str], records: Sequence[SearchRecord], notes: Sequence[Note] = ()
) -> None:
    """Write the page of one search or several.

    Parameters
    ----------
    path : path-like
        The file; an existing file is replaced.
    records : sequence of SearchRecord
        The records, in the order of the page.
    notes : sequence of Note
        The sections on the preparation of the tests.

    Raises
    ------
    ImportError
        If plotly is missing.
    OSError
        If the file cannot be written.
    """
    Path(path).write_text(page(records, notes), encoding="utf-8", newline="\n")


def page(records: Sequence[SearchRecord], notes: Sequence[Note] = ()) -> str:
    """Return the page of one search or several, as HTML."""
    script = _plotly()
    figures: list[Figure] = []

    def add(figure: Figure, about: str) -> str:
        figures.append(figure)
        height = max(int(figure["layout"]["height"]), _LEAST_SIDE)
        return (
            f'<div class="figure" id="figure-{len(figures) - 1}" role="img" '
            f'aria-label="{html.escape(about)}" style="height: {height}px"></div>'
        )

    most = most_points(records, _POINTS)
    searches = list(map(ShownSearch, records))
    title = f"Identification of {', '.join(records[0].names)}"
    body = [f"<h1>{html.escape(title)}</h1>"]
    body += [note_section(note, add, most) for note in notes]
    if len(searches) > 1:
        body.append(overview(searches))
    for number, search in enumerate(searches, 1):
        heading = f"{search.objective}, {search.record.settings['method']}"
        if len(searches) > 1:
            heading = f"Search {number}: {heading}"
        sections = sections_of(search, add, most)
        body.append(_section(search, f"s{number}", heading, list(enumerate(sections))))
    data = json.dumps(figures, separators=(",", ":"), allow_nan=False)
    return _PAGE.format(
        title=html.escape(title),
        style=_asset("report.css"),
        body="\n".join(body),
        figures=data.replace("<", "\\u003c"),  # a name cannot end the script, or begin another
        plotly=script,
        draw=_asset("report.js"),
    )


def _section(
    search: ShownSearch, prefix: str, heading: str, sections: list[tuple[int, tuple[str, str]]]
) -> str:
    """Return a search with its sections, which are numbered."""
    links = [f'<a href="#{prefix}-{i}">{title}</a>' for i, (title, _) in sections]
    parts = [
        f'<section id="{prefix}"><h2>{html.escape(heading)}</h2>',
        verdict_of(search).html(),
        f"<nav>{' · '.join(links)}</nav>",
        *(f'<h3 id="{prefix}-{i}">{title}</h3>\n{content}' for i, (title, content) in sections),
        _footnote(search),
        "</section>",
    ]
    return "\n".join(parts)


def _footnote(search: ShownSearch) -> str:
    """Return how many sets were evaluated, and the last words of the method, as HTML."""
    record = search.record
    outside, count = sum(one.outside for one in record.evaluations), len(record.evaluations)
    failed = sum(one.failed for one in record.evaluations) - outside
    said = f"{count} evaluations" + (f", of which {failed} failed." if failed else ".")
    if outside:
        said += f" {outside} were outside of the model's own bounds."
    if record.ending is not None:
        said += f" The last words of {record.settings['method']}: {record.ending.message}."
    return paragraph(said).replace("<p>", '<p class="footnote">')


def _asset(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")


def _plotly() -> str:
    """Return plotly.js as gzip in base64; the same text for the same plotly."""
    with extra("report", "a report needs plotly, which is not installed"):
        source: str = import_module("plotly.offline").get_plotlyjs()
    return _packed(source)


@lru_cache(maxsize=1)  # a tenth of a second, for every page of the same plotly
def _packed(source: str) -> str:
    return base64.b64encode(gzip.compress(source.encode("utf-8"), 5, mtime=0)).decode("ascii")


_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="curvewise">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>
{style}</style>
</head>
<body>
<noscript><p class="state">Figures need JavaScript; the tables do not.</p></noscript>
<p class="state" id="no-figures" hidden>
This browser has no DecompressionStream, and draws no figures; the tables are complete.
</p>
{body}
<script type="application/json" id="figures">{figures}</script>
<script type="text/plain" id="plotly">{plotly}</script>
<script>
{draw}</script>
</body>
</html>
"""
