"""The C++ library and its tests, built as a C++ user would build them, warnings as errors."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("CMakeLists.txt", "cpp/CMakeLists.txt", "tests/cpp/CMakeLists.txt")
COMPILERS = ("c++", "g++", "clang++", "cl")


def tool(name: str) -> str:
    """Return where a build tool is: beside the running Python, or else on the PATH."""
    beside = str(Path(sys.executable).parent)
    found = shutil.which(name, path=beside) or shutil.which(name)
    assert found, f"no {name}: pip install curvewise[test]"
    return found


def run(*command: str) -> None:
    """Run a command; fail with all that it printed."""
    done = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    )
    if done.returncode != 0:
        pytest.fail(f"{' '.join(command)}\n{done.stdout}", pytrace=False)


def test_the_cpp_tests_pass(tmp_path: Path) -> None:
    """Configure, build, and run every C++ test."""
    missing = [name for name in SOURCES if not (ROOT / name).is_file()]
    if missing:
        pytest.skip(f"not a source tree: no {missing[0]}")
    if "CXX" not in os.environ and not any(map(shutil.which, COMPILERS)):
        pytest.skip(f"no C++ compiler: none of {', '.join(COMPILERS)}, and CXX is not set")
    build = str(tmp_path / "build")
    run(
        tool("cmake"),
        "-G=Ninja",
        f"-DCMAKE_MAKE_PROGRAM={Path(tool('ninja')).as_posix()}",
        f"-DCMAKE_PREFIX_PATH={Path(sysconfig.get_path('purelib')).as_posix()}",
        "-DCURVEWISE_BUILD_TESTS=ON",
        "-DCURVEWISE_WARNINGS_AS_ERRORS=ON",
        f"-S={ROOT}",
        f"-B={build}",
    )
    run(tool("cmake"), "--build", build)
    run(tool("ctest"), "--test-dir", build, "--output-on-failure", "--no-tests=error")
