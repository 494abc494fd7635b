"""Follow every link of the built site: ``python docs/check_links.py build/site``.

Each link, picture, script and style sheet of a page must lead to a file of the site, and each
anchor to an element that has its id. Addresses of other servers are counted, and listed by --list;
``sphinx-build -b linkcheck`` asks those servers. Exit status 1 if a link is broken. Takes a few
seconds.
"""

from __future__ import annotations

import argparse
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

_REFERENCES = {"href", "src"}
_CHECKED_ELSEWHERE = {"http", "https", "mailto"}
_MADE_FOR_THE_BROWSER = {"data", "javascript"}


class _Page(HTMLParser):
    """The links of a page, and the anchors that others may lead to."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[tuple[int, str]] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if value is None:
                continue
            if name in _REFERENCES:
                self.links.append((self.getpos()[0], value))
            elif name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)


def read(page: Path) -> _Page:
    """Return the links and anchors of a page."""
    parsed = _Page()
    parsed.feed(page.read_text(encoding="utf-8"))
    return parsed


def check(site: Path) -> tuple[int, list[str], set[str]]:
    """Return the number of links within the site, what is wrong with them, and the others."""
    written = [page for page in sorted(site.rglob("*.html")) if "_static" not in page.parts]
    pages = {page: read(page) for page in written}
    internal, broken, external = 0, [], set()
    for page, parsed in pages.items():
        for line, link in parsed.links:
            parts = urlsplit(link)
            if parts.scheme in _CHECKED_ELSEWHERE or parts.netloc:
                external.add(link)
                continue
            if parts.scheme in _MADE_FOR_THE_BROWSER:
                continue
            internal += 1
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            if target.is_dir():
                target /= "index.html"
            anchor = unquote(parts.fragment)
            if not target.is_file():
                broken.append(f"{page.relative_to(site)}:{line}: no file {link}")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                broken.append(f"{page.relative_to(site)}:{line}: no anchor {link}")
    return internal, broken, external


def main() -> int:
    """Print what is broken, and the numbers."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("site", type=Path, help="the folder that sphinx-build has written")
    parser.add_argument("--list", action="store_true", help="list the links to other servers")
    arguments = parser.parse_args()
    internal, broken, external = check(arguments.site.resolve())
    if not internal:
        broken.append(f"{arguments.site} has no pages: build the site first")
    for message in broken:
        print(message, file=sys.stderr)
    if arguments.list:
        print("\n".join(sorted(external)))
    print(
        f"{internal} links within the site, {len(broken)} of them broken; "
        f"{len(external)} addresses of other servers, not asked"
    )
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
