"""Shared paragraphs and signatures are written into the sources; a changed one is found."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

ROOT = next(folder for folder in Path(__file__).parents if (folder / "pyproject.toml").is_file())
DTW = ROOT / "python" / "curvewise" / "measures" / "dtw.py"


@pytest.fixture(scope="module")
def writer() -> ModuleType:
    spec = importlib.util.spec_from_file_location("shared_text", ROOT / ".ci" / "shared_text.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_file_is_as_written(writer: ModuleType) -> None:
    written = [
        file for file in writer.PACKAGE.rglob("*.py") if "# Shared text:" in file.read_text()
    ]
    assert len(written) > 15
    for file in written:
        text = file.read_text(encoding="utf-8")
        assert writer.rewritten(text) == text, file.name


@pytest.mark.parametrize(
    ("place", "other"),
    [
        ("Number of threads: at least 1", "Number of workers: at least 2"),
        ("p : float, 1 <= p <= inf, optional", "p : float"),
        ("    penalty: SupportsFloat = 0.0,\n    window", "    window"),
        ("The value is the smallest over all first", "The value is that of the first"),
    ],
)
def test_a_change_by_hand_is_written_over(writer: ModuleType, place: str, other: str) -> None:
    text = DTW.read_text(encoding="utf-8")
    assert place in text
    # Behind the signature of dtw itself, from which others are copied.
    head, body = text[: text.index("-> float:")], text[text.index("-> float:") :]
    changed = head + body.replace(place, other, 1)
    assert changed != text
    assert writer.rewritten(changed) == text


def test_a_name_in_braces_becomes_the_text(writer: ModuleType) -> None:
    text = DTW.read_text(encoding="utf-8")
    entry = r"    workers : int, default 1\n        Number.*\n"
    assert writer.rewritten(re.sub(entry, "    {workers}\n", text, count=1)) == text


def test_an_entry_that_lacks_is_an_error(writer: ModuleType) -> None:
    text = DTW.read_text(encoding="utf-8").replace("    prune : bool", "    pruned : bool")
    with pytest.raises(ValueError, match=r"^no entry 'prune'$"):
        writer.rewritten(text)


def test_names_that_exceed_a_line_are_several_entries(
    writer: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = DTW.read_text(encoding="utf-8")
    monkeypatch.setattr(writer, "WIDTH", 70)
    narrow = writer.rewritten(text)
    assert len(re.findall(r"As for :func:`dtw`\.\n    \w+, \w+", narrow)) > 3
    monkeypatch.setattr(writer, "WIDTH", 100)
    assert writer.rewritten(narrow) == text
