"""What the tests that embed curvewise share: the C++ library, built once a kind and session.

The static library is built together with the C++ tests, as `cmake -DCURVEWISE_BUILD_TESTS=ON` does
it. The shared one is built inside a project that fetches it (the third way of docs/embedding.md)
and has other flags: its bits must not depend on them, and `CURVEWISE_INSTALL=ON` installs it from
there. Both are installed, moved, and their build folders removed, so that what is installed can
depend on neither. Where pytest-xdist runs several processes, the first that asks builds and the
others wait.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from filelock import FileLock
from programs import PURELIB, ROOT, build, output, run, tool, write_page

OPTIONS = [
    f"-DCMAKE_PREFIX_PATH={PURELIB.as_posix()}",
    "-DCMAKE_INSTALL_LIBDIR=lib",
    "-DCURVEWISE_WARNINGS_AS_ERRORS=ON",
]


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what gives the folder of the "static" or "shared" library, built if need be.

    It holds ``prefix``, where the library is installed, and ``printed.json``: for "static" what
    ctest printed and its status, for "shared" what the program of the page printed.
    """
    base = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        base = base.parent  # of all processes of this session

    def folder_of(kind: str) -> Path:
        folder, failure = base / f"library_{kind}", base / f"library_{kind}.failure"
        with FileLock(base / f"library_{kind}.lock"):
            if failure.exists():
                pytest.fail(failure.read_text(encoding="utf-8"), pytrace=False)
            if not folder.exists():
                try:
                    _build(kind, base / f"unfinished_{kind}").rename(folder)
                except pytest.fail.Exception as error:
                    failure.write_text(str(error), encoding="utf-8")
                    raise
        return folder

    return cache(folder_of)


@pytest.fixture(scope="session")
def prefix(built: Callable[[str], Path]) -> Callable[[str], Path]:
    """Return what gives the prefix where the "static" or "shared" C++ library is installed."""
    return lambda kind: built(kind) / "prefix"


def _build(kind: str, work: Path) -> Path:
    """Build and install a library in a folder; return it without what it was built in."""
    work.mkdir()
    printed, status = _BUILDERS[kind](work)
    output(tool("cmake"), "--install", work / "build", "--prefix", work / "prefix")
    shutil.rmtree(work / "build")
    text = json.dumps({"printed": printed, "status": status})
    (work / "printed.json").write_text(text, encoding="utf-8")
    return work


def _build_static(work: Path) -> tuple[str, int]:
    """Build the library and the C++ tests, and run these."""
    build(ROOT, work / "build", *OPTIONS, "-DCURVEWISE_BUILD_TESTS=ON")
    options = ["--output-on-failure", "--no-tests=error", "--parallel", "2"]
    done = run(tool("ctest"), "--test-dir", work / "build", *options)
    return done.stdout, done.returncode


def _build_shared(work: Path) -> tuple[str, int]:
    """Build and run the page's program in a project of other flags that fetches the library."""
    folder = write_page(work / "tool", "main.cpp", "fetch_content/CMakeLists.txt")
    (work / "curvewise").symlink_to(ROOT)
    options = [
        "-DBUILD_SHARED_LIBS=ON",
        "-DCURVEWISE_INSTALL=ON",
        f"-DCMAKE_PROJECT_tool_INCLUDE={ROOT / 'tests/python/embedding/other_flags.cmake'}",
        "-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON",
        "-DCMAKE_UNITY_BUILD=ON",
    ]
    build(folder, work / "build", *OPTIONS, *options)
    return output(work / "build" / "tool"), 0


_BUILDERS = {"static": _build_static, "shared": _build_shared}
