"""Common code of the tests that embed curvewise: the C++ library, at most one build of each kind.

The static library is that of the installed package, which is built of these sources and is
installed far from its build. If the package is not installed, or a source is newer, the tests build
it. The shared library is for the nightly run. It is built inside a project that fetches it (the
third way of docs/embedding.md) and has other flags: its bits must not depend on them.
`CURVEWISE_INSTALL=ON` installs it from there. Each built library is installed and moved, and its
build folder is removed, so that it can depend on neither. If pytest-xdist runs several processes,
the first that needs a library builds it and the others wait.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from filelock import FileLock
from programs import (
    KINDS,
    OPTIONS,
    ROOT,
    WARNINGS,
    build,
    compiler,
    eigen,
    output,
    tool,
    write_page,
)

import curvewise


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what gives the folder of the "static" or "shared" library, built if need be.

    It holds ``prefix``, where the library is installed, and ``printed.txt``: what the program of
    the page printed, where there is one.
    """
    base = _base_of_all(tmp_path_factory)

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
    installed = Path(curvewise.__file__).parent
    library = installed / "lib" / "libcurvewise.a"
    sources = [ROOT / "CMakeLists.txt", *(ROOT / "cpp").rglob("*.*")]
    is_of_sources = library.is_file() and library.stat().st_mtime > max(
        source.stat().st_mtime for source in sources
    )
    return lambda kind: installed if kind == "static" and is_of_sources else built(kind) / "prefix"


@pytest.fixture(scope="session", params=KINDS)
def library(
    request: pytest.FixtureRequest,
    prefix: Callable[[str], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> ctypes.CDLL:
    """Return the C interface, to be called by ctypes.

    The static library exports no functions, so its interface is compiled into one that does.
    """
    place = prefix(request.param) / "lib"
    shared = place / f"libcurvewise.{'dylib' if sys.platform == 'darwin' else 'so'}"
    if request.param == "static":
        shared = tmp_path_factory.mktemp("c_interface") / "interface.so"
        # With all that shares an object file with it in the package, or symbols clash.
        sources = sorted((ROOT / "cpp/src/interface").glob("*.cpp"))
        sources = [one for one in sources if one.name != "build_info.cpp"]  # needs CMake's macros
        together = shared.with_suffix(".cpp")
        together.write_text("".join(f'#include "interface/{one.name}"\n' for one in sources))
        options = ["-std=c++17", "-shared", "-fPIC", "-DCURVEWISE_SHARED", "-DCURVEWISE_BUILDING"]
        options += [f"-I{ROOT / 'cpp' / folder}" for folder in ("include", "src")]
        archive = place / "libcurvewise.a"
        output(compiler("c++", "g++"), *options, together, archive, "-pthread", "-o", shared)
    return ctypes.CDLL(str(shared))


@pytest.fixture(scope="session", params=KINDS)
def examples(
    request: pytest.FixtureRequest,
    prefix: Callable[[str], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    """Return the folder of the examples, built by CMake with a library that has been moved."""
    base = _base_of_all(tmp_path_factory)
    folder, is_built = base / f"examples_{request.param}", base / f"examples_{request.param}.built"
    with FileLock(base / f"examples_{request.param}.lock"):
        if not is_built.exists():
            options = [
                f"-DCMAKE_PREFIX_PATH={prefix(request.param)}",
                f"-DEigen3_DIR={eigen() / 'share/eigen3/cmake'}",
                "-DCMAKE_C_FLAGS=" + " ".join(WARNINGS),
                "-DCMAKE_CXX_FLAGS=" + " ".join(WARNINGS),
                "-DCMAKE_Fortran_FLAGS=-std=f2018 -Wall -Wextra -pedantic -Werror",
            ]
            build(ROOT / "cpp" / "examples", folder, *options)
            is_built.touch()
    return folder


def _base_of_all(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the temporary folder that all processes of this session share."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if "PYTEST_XDIST_WORKER" in os.environ else base


def _build(kind: str, work: Path) -> Path:
    """Build and install a library in a folder; return it without its build folder."""
    work.mkdir()
    if kind == "static":
        build(ROOT, work / "build", *OPTIONS)
    else:
        _build_shared(work)
    output(tool("cmake"), "--install", work / "build", "--prefix", work / "prefix")
    shutil.rmtree(work / "build")
    return work


def _build_shared(work: Path) -> None:
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
    (work / "printed.txt").write_text(output(work / "build" / "tool"), encoding="utf-8")
