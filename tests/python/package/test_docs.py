"""The Python on the pages of the documentation runs: every ```python block, page by page."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
# Pages show how to use these, and nobody has all of them.
OPTIONAL = ("geopandas", "polars", "shapely", "xarray")
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_python_of_a_page_runs(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Run a page's blocks in one namespace; an error shows the page's line."""
    text = page.read_text(encoding="utf-8")
    blocks = list(BLOCK.finditer(text))
    assert len(blocks) == text.count("```python"), "a block of Python that is not found"
    if not blocks:
        pytest.skip(f"{page.name} has no Python")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    missing = []
    for block in blocks:
        before = "\n" * text.count("\n", 0, block.start(1))
        try:
            exec(compile(before + block[1], str(page), "exec"), names)
        except ModuleNotFoundError as error:
            if error.name not in OPTIONAL:
                raise
            missing.append(error.name)
    if missing:
        pytest.skip(f"all but the blocks with {', '.join(missing)}, which are not installed")
