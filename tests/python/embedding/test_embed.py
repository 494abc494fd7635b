"""curvewise in other programs: every way to get it, in C++, C and Fortran.

The programs, project files and commands are those of docs/embedding.md. Their output equals
Python's results, to the last bit. `pytest -m embed` runs these tests and those of the examples
alone. conftest.py chooses the library.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path

import pytest
from programs import (
    KINDS,
    MARKS,
    PURELIB,
    ROOT,
    WARNINGS,
    build,
    compiler,
    configure,
    library_path,
    numbers,
    output,
    pkg_config,
    run,
    tool,
    write_page,
)

import curvewise

pytestmark = MARKS

STRAIN_STRESS = [(0.0, 0.0), (0.1, 21.3), (0.2, 35.1), (0.4, 41.7)]  # of docs/embedding.md
SIMULATION = [(0.0, 0.0), (0.15, 28.3), (0.4, 43.9)]


def assert_tool_right(printed: str) -> None:
    """What main.cpp of docs/embedding.md prints."""
    assert numbers(printed) == {
        "dtw": curvewise.dtw(STRAIN_STRESS, SIMULATION),
        "area": curvewise.area(STRAIN_STRESS, SIMULATION, spacing="x"),
    }


@pytest.mark.parametrize("kind", KINDS)
def test_find_package(kind, prefix, tmp_path) -> None:
    """Without Eigen, from a prefix that has been moved."""
    build(
        write_page(tmp_path / "tool", "main.cpp", "find_package/CMakeLists.txt"),
        tmp_path / "build",
        f"-DCMAKE_PREFIX_PATH={prefix(kind)}",
        "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON",
        f"-DCMAKE_CXX_FLAGS={' '.join(WARNINGS)}",
    )
    assert_tool_right(output(tmp_path / "build" / "tool"))


@pytest.mark.parametrize("version", ["0.0", "0.2", "1.0"])
def test_find_package_refuses_another_minor_version(version, prefix, tmp_path) -> None:
    folder = write_page(tmp_path / "tool", "main.cpp", "find_package/CMakeLists.txt")
    project = folder / "CMakeLists.txt"
    project.write_text(project.read_text().replace("curvewise 0.1", f"curvewise {version}"))
    done = run(*configure(folder, tmp_path, f"-DCMAKE_PREFIX_PATH={prefix('static')}"))
    assert done.returncode != 0
    assert "compatible with requested version" in done.stdout


@pytest.mark.parametrize("cxx", ["g++", "clang++"])
@pytest.mark.parametrize("kind", KINDS)
def test_pkg_config(kind, cxx, prefix, tmp_path) -> None:
    """The command of the page, by either compiler, and with every warning an error."""
    folder = write_page(tmp_path / "tool", "main.cpp", "pkg_config.sh")
    place = prefix(kind)
    tools = tmp_path / "tools"
    tools.mkdir()
    (tools / "c++").symlink_to(str(shutil.which(compiler(cxx))))
    environment = {
        "PKG_CONFIG_PATH": str(place / "lib" / "pkgconfig"),
        "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}",
    }
    compiler("pkg-config", "pkgconf")
    output("sh", "-e", "pkg_config.sh", cwd=folder, **environment)
    assert_tool_right(output(folder / "tool", **library_path(place)))
    flags = pkg_config(place, "--cflags")
    output(cxx, "-std=c++17", *WARNINGS, "-fsyntax-only", *flags, folder / "main.cpp")


def test_add_subdirectory_leaks_nothing(tmp_path) -> None:
    """Nothing of the project is set, its warnings do not meet our headers, nothing is installed."""
    folder = write_page(tmp_path / "tool", "main.cpp", "add_subdirectory/CMakeLists.txt")
    (folder / "curvewise").symlink_to(ROOT)
    work = tmp_path / "build"
    build(
        folder,
        work,
        f"-DCMAKE_PREFIX_PATH={PURELIB.as_posix()}",
        f"-DCMAKE_PROJECT_tool_INCLUDE={ROOT / 'tests/python/embedding/leaks.cmake'}",
        target="CMakeFiles/tool.dir/main.cpp.o",
    )
    output(tool("cmake"), "--install", work, "--prefix", tmp_path / "prefix")
    assert not (tmp_path / "prefix").exists()


@pytest.mark.parametrize(
    ("languages", "options", "message"),
    [
        ("CXX", [], "curvewise: the project sets no build type"),
        ("C", [], "C++, which your project does not enable; write project(... LANGUAGES C CXX)"),
        ("CXX", ["-DCURVEWISE_LEVELS=v9"], "CURVEWISE_LEVELS is 'v9'; give all or baseline"),
    ],
)
def test_add_subdirectory_says_what_is_missing(languages, options, message, tmp_path) -> None:
    lines = [
        "cmake_minimum_required(VERSION 3.21)",
        f"project(tool LANGUAGES {languages})",
        f"add_subdirectory({ROOT.as_posix()} curvewise)",
    ]
    (tmp_path / "CMakeLists.txt").write_text("\n".join(lines))
    prefix = f"-DCMAKE_PREFIX_PATH={PURELIB.as_posix()}"
    done = run(*configure(tmp_path, tmp_path / "build", prefix, *options))
    assert message in " ".join(done.stdout.split())
    assert (done.returncode == 0) == message.startswith("curvewise:")


@pytest.mark.nightly
def test_fetch_content(built) -> None:
    """As a shared library: a project may set this for everything that it fetches.

    conftest.py builds it, with the flags of a separate project (-Ofast, unity, link-time
    optimisation) and without warnings. The tests of the prefix "shared" use the installed result,
    and get the same bits.
    """
    assert_tool_right((built("shared") / "printed.txt").read_text(encoding="utf-8"))


def python(*arguments: str) -> str:
    return output(sys.executable, "-m", "curvewise", *arguments).strip()


@pytest.fixture
def wheel() -> None:
    try:
        curvewise.installation.get_include()
    except FileNotFoundError:
        pytest.skip("curvewise runs from its source tree: pip install it to test the wheel")


def test_wheel(wheel, tmp_path) -> None:
    """Both commands of the page, with the python that runs this test."""
    folder = write_page(
        tmp_path / "tool", "main.cpp", "find_package/CMakeLists.txt", "wheel.sh", "wheel_by_hand.sh"
    )
    tools = [Path(sys.executable).parent, Path(tool("cmake")).parent]
    path = os.pathsep.join(map(str, [*tools, os.environ["PATH"]]))
    environment = {"PATH": path, "CMAKE_GENERATOR": "Ninja"}  # there may be no make
    output("sh", "-e", "wheel.sh", cwd=folder, **environment)
    assert_tool_right(output(folder / "build" / "tool"))
    output("sh", "-e", "wheel_by_hand.sh", cwd=folder, **environment)
    assert_tool_right(output(folder / "tool"))


def test_wheel_says_where(wheel) -> None:
    assert python("--includes") == f"-I{curvewise.installation.get_include()}"
    assert (Path(curvewise.installation.get_include()) / "curvewise" / "curvewise.hpp").is_file()
    assert (Path(python("--cmakedir")) / "curvewiseConfig.cmake").is_file()


def test_in_one_process_with_the_python_module(prefix, tmp_path) -> None:
    """A plug-in that embeds the static library exports none of it; both give the same bits."""
    source, plugin = tmp_path / "plugin.cpp", tmp_path / "plugin.so"
    source.write_text(
        "#include <curvewise/curvewise.hpp>\n"
        'extern "C" double plugin_dtw(const double* P, long n, const double* Q, long m) {\n'
        "    return curvewise::dtw({P, n, 2}, {Q, m, 2});\n"
        "}\n"
    )
    flags = pkg_config(prefix("static"), "--cflags", "--libs")
    output(compiler("c++", "g++"), "-std=c++17", "-fPIC", "-shared", source, "-o", plugin, *flags)
    if sys.platform == "linux":
        shown = output("nm", "-D", "-C", "--defined-only", plugin)
        assert "plugin_dtw" in shown
        assert not re.search(r" [A-V] .*curvewise", shown)  # W: inline functions of the headers
    program = (
        "import ctypes, sys, numpy as np, curvewise\n"
        "P, Q = (np.ascontiguousarray(c) for c in curvewise.datasets.hysteresis_pair())\n"
        "plugin = ctypes.CDLL(sys.argv[1], ctypes.RTLD_GLOBAL)\n"
        "plugin.plugin_dtw.restype = ctypes.c_double\n"
        "pointer, size = ctypes.c_void_p, ctypes.c_long\n"
        "arguments = [f(c) for c in (P, Q)\n"
        "             for f in (lambda c: pointer(c.ctypes.data), lambda c: size(len(c)))]\n"
        "assert plugin.plugin_dtw(*arguments) == curvewise.dtw(P, Q)\n"
        "print('equal')\n"
    )
    assert output(sys.executable, "-c", program, plugin) == "equal\n"
