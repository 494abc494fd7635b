"""Where the golden data is: beside the project, or in the folder CURVEWISE_DATA names."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Return the folder with golden/, loops/ and paper/; skip the test where it is absent."""
    folder = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no golden data in {folder}: set CURVEWISE_DATA to the folder that has it")
    return folder
