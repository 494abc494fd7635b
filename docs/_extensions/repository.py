"""Files of the repository as pages of the site, and links from a page to what is no page.

A page is mirrored if it holds a comment ``<!-- mirrors benchmarks/README.md -->`` behind its front
matter: the file's text takes the place of the comment, so that it stands once and reads
well in the repository too. In mirrored and other Markdown pages, relative links are then turned to
where the site has their target: a mirrored file to its page, a header to its page of the C++
reference, a folder to the page that `repository_folders` names. Other files of the repository
become downloads, which is what MyST does with them. A link to something that does not exist, or to
a folder without a page, is an error.
"""

from __future__ import annotations

import os
import re
from pathlib import Path, PurePosixPath
from typing import Any

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

_MIRROR = re.compile(r"^<!-- mirrors (\S+) -->$", re.MULTILINE)
_LINK = re.compile(r"(?<=\]\()([^()\s]+)(?=\))")
_CODE = re.compile(r"(^```.*?^```$|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
_ELSEWHERE = re.compile(r"[a-z]+:|#")


def _pages_of_files(docs: Path) -> dict[str, str]:
    """Return which page has which file of the repository, both as paths from its root."""
    root = docs.parent
    pages = {}
    for page in sorted(docs.rglob("*.md")):
        mirrored = _MIRROR.search(page.read_text(encoding="utf-8"))
        if mirrored:
            pages[mirrored[1]] = page.relative_to(root).as_posix()
    for header in (root / "cpp/include/curvewise").glob("*.hpp"):
        pages[header.relative_to(root).as_posix()] = f"docs/api/cpp/{header.stem}.rst"
    pages["cpp/include/curvewise/curvewise.h"] = "docs/api/c.rst"
    pages["cpp/fortran/curvewise.f90"] = "docs/api/fortran.rst"
    return pages


def _rewrite(text: str, folder: str, page: str, pages: dict[str, str], root: Path) -> str:
    """Return a text that stands in `folder` with its links as they must be on `page`."""

    def turn(link: re.Match[str]) -> str:
        target, hash_, anchor = link[1].partition("#")
        if _ELSEWHERE.match(link[1]) or target.startswith("<"):
            return link[1]
        path = os.path.normpath(os.path.join(folder, target))
        if path.startswith("docs/gallery"):  # made by the build, which checks it
            return link[1]
        if not (root / path).exists():
            raise ExtensionError(f"{page}: the link to {link[1]} leads to no file")
        if (root / path).is_dir() and path not in pages:
            raise ExtensionError(f"{page}: no page is known for the folder {path}")
        found = PurePosixPath(Path(pages.get(path, path)).as_posix())
        return os.path.relpath(found, PurePosixPath(page).parent).replace(os.sep, "/") + (
            hash_ + anchor
        )

    parts = _CODE.split(text)
    parts[::2] = [_LINK.sub(turn, part) for part in parts[::2]]
    return "".join(parts)


def _read(app: Sphinx, docname: str, source: list[str]) -> None:
    path = Path(str(app.env.doc2path(docname)))
    if path.suffix != ".md":
        return
    root = Path(app.srcdir).parent
    page = path.relative_to(root).as_posix()
    pages = _pages_of_files(Path(app.srcdir)) | app.config.repository_folders
    mirrored = _MIRROR.search(source[0])
    if mirrored is None:
        source[0] = _rewrite(source[0], str(PurePosixPath(page).parent), page, pages, root)
        return
    file = root / mirrored[1]
    app.env.note_dependency(str(file))
    folder = str(PurePosixPath(mirrored[1]).parent)
    text = _rewrite(file.read_text(encoding="utf-8"), folder, page, pages, root)
    source[0] = source[0].replace(mirrored[0], text)


def setup(app: Sphinx) -> dict[str, Any]:
    """Look at every Markdown page before it is parsed."""
    app.add_config_value("repository_folders", {}, "env")
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
