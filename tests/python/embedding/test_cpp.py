"""The C++ library and its tests, built as a C++ user would build them, warnings as errors."""

from __future__ import annotations

import os
import shutil
import sysconfig
from pathlib import Path

import pytest
from programs import ROOT, build, output, tool

SOURCES = ("CMakeLists.txt", "cpp/CMakeLists.txt", "tests/cpp/CMakeLists.txt")
COMPILERS = ("c++", "g++", "clang++", "cl")


def test_the_cpp_tests_pass(tmp_path: Path) -> None:
    """Configure, build, and run every C++ test."""
    missing = [name for name in SOURCES if not (ROOT / name).is_file()]
    if missing:
        pytest.skip(f"not a source tree: no {missing[0]}")
    if "CXX" not in os.environ and not any(map(shutil.which, COMPILERS)):
        pytest.skip(f"no C++ compiler: none of {', '.join(COMPILERS)}, and CXX is not set")
    folder = tmp_path / "build"
    build(
        ROOT,
        folder,
        f"-DCMAKE_PREFIX_PATH={Path(sysconfig.get_path('purelib')).as_posix()}",
        "-DCURVEWISE_BUILD_TESTS=ON",
        "-DCURVEWISE_WARNINGS_AS_ERRORS=ON",
    )
    output(tool("ctest"), "--test-dir", folder, "--output-on-failure", "--no-tests=error")
