"""What the tests that embed curvewise share: the installed C++ library."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from programs import install


@pytest.fixture(scope="session")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what gives the prefix where the "static" or "shared" C++ library is installed."""
    return cache(lambda kind: install(tmp_path_factory.mktemp(kind), shared=kind == "shared"))
