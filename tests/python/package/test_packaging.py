"""The tests of wheels in pyproject.toml, since wheels are not built before a release."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


def names(requirements: list[str]) -> set[str]:
    """Return the import names of required packages."""
    return {re.split(r"[^\w-]", one)[0].replace("-", "_") for one in requirements}


def test_a_wheel_is_tested_with_what_its_tests_import():
    tomllib = pytest.importorskip("tomllib", reason="part of Python from 3.11 on")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    settings = project["tool"]["cibuildwheel"]
    needed = names(project["project"]["optional-dependencies"]["test"]) - {"curvewise"}
    missing = needed - names(settings["test-requires"])
    run = [ROOT / path for path in re.findall(r"tests/[\w/.]+", settings["test-command"])]
    files = [file for path in run for file in (path.rglob("*.py") if path.is_dir() else [path])]
    assert len(files) > 20
    assert [
        (file.name, module)
        for file in files
        for module in re.findall(r"^(?:import|from) (\w+)", file.read_text("utf-8"), re.MULTILINE)
        if module in missing
    ] == []
