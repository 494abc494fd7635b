"""Where the golden data is: beside the project, or in the folder CURVEWISE_DATA names."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from programs import install

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Return the folder with golden/, loops/ and paper/; skip the test where it is absent."""
    folder = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no golden data in {folder}: set CURVEWISE_DATA to the folder that has it")
    return folder


@pytest.fixture(scope="session")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what gives the prefix where the "static" or "shared" C++ library is installed."""
    return cache(lambda kind: install(tmp_path_factory.mktemp(kind), shared=kind == "shared"))
