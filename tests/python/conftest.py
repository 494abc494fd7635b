"""What the tests share: among it the golden data, in ../shared/data or CURVEWISE_DATA."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session", autouse=True)
def ctrl_c_is_heard() -> Iterator[None]:
    """Have SIGINT raise KeyboardInterrupt: a process started in the background ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Return the folder with golden/, loops/ and paper/; skip the test where it is absent."""
    folder = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no golden data in {folder}: set CURVEWISE_DATA to the folder that has it")
    return folder
