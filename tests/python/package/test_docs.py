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


def test_the_worked_example_shows_its_script() -> None:
    """Its code needs a solver and data: it stands in the script that was run, line by line."""
    page = (ROOT / "docs" / "worked_example.md").read_text(encoding="utf-8")
    script = (ROOT / "benchmarks" / "answer" / "worked_example.py").read_text(encoding="utf-8")
    printed = (ROOT / "benchmarks" / "answer" / "worked_example.txt").read_text(encoding="utf-8")
    known = {line.strip() for line in (script + printed).splitlines()}
    shown = [line.strip() for line in page.splitlines() if line.startswith("    ")]
    assert len(shown) > 20
    assert [line for line in shown if line not in known] == []
