"""The C++ library and its tests, built as a C++ user would build them, warnings as errors."""

from __future__ import annotations

import json
import os
import shutil

import pytest
from programs import ROOT

SOURCES = ("CMakeLists.txt", "cpp/CMakeLists.txt", "tests/cpp/CMakeLists.txt")
COMPILERS = ("c++", "g++", "clang++", "cl")


def test_the_cpp_tests_pass(built) -> None:
    """Every C++ test, as conftest.py has built and run it."""
    missing = [name for name in SOURCES if not (ROOT / name).is_file()]
    if missing:
        pytest.skip(f"not a source tree: no {missing[0]}")
    if "CXX" not in os.environ and not any(map(shutil.which, COMPILERS)):
        pytest.skip(f"no C++ compiler: none of {', '.join(COMPILERS)}, and CXX is not set")
    done = json.loads((built("static") / "printed.json").read_text(encoding="utf-8"))
    assert done["status"] == 0, done["printed"]
    assert "100% tests passed" in done["printed"]
