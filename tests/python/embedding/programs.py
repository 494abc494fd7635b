"""Programs that embed curvewise, as tests need them: built by CMake or by a compiler, and run."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
PURELIB = Path(sysconfig.get_path("purelib"))
OPTIONS = [
    f"-DCMAKE_PREFIX_PATH={PURELIB.as_posix()}",
    "-DCMAKE_INSTALL_LIBDIR=lib",
    "-DCURVEWISE_WARNINGS_AS_ERRORS=ON",
]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]

# The libraries that a test takes: the shared one, which has to be built, at night.
KINDS = ["static", pytest.param("shared", marks=pytest.mark.nightly)]

# For `pytestmark` of a file whose tests build such programs.
MARKS = [
    pytest.mark.embed,
    pytest.mark.skipif(
        not (ROOT / "cpp" / "CMakeLists.txt").is_file(), reason="not a source tree: no cpp"
    ),
    pytest.mark.skipif(os.name == "nt", reason="drives compilers by the flags of gcc and clang"),
]


def tool(name: str) -> str:
    """Return the path of a build tool: next to the running Python, or else on the PATH."""
    beside = str(Path(sys.executable).parent)
    found = shutil.which(name, path=beside) or shutil.which(name)
    assert found, f"no {name}: pip install curvewise[test]"
    return found


def compiler(*names: str) -> str:
    """Return the first compiler of these names that there is; skip the test without one."""
    for name in names:
        if shutil.which(name):
            return name
    pytest.skip(f"no {' or '.join(names)}")


def run(
    *command: str | Path, cwd: Path | None = None, **environment: str
) -> subprocess.CompletedProcess[str]:
    """Run a command; keep all that it printed, and its status."""
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        cwd=cwd,
        env={**os.environ, **environment},
    )


def output(*command: str | Path, cwd: Path | None = None, **environment: str) -> str:
    """Run a command and return its output; fail with the whole output."""
    done = run(*command, cwd=cwd, **environment)
    if done.returncode != 0:
        pytest.fail(f"{' '.join(map(str, command))}\n{done.stdout}", pytrace=False)
    return done.stdout


def numbers(text: str) -> dict[str, float]:
    """Return the lines `name number` that a program printed."""
    return {name: float(value) for name, value in re.findall(r"^(\w+) +(\S+)$", text, re.M)}


def configure(source: Path, folder: Path, *options: str) -> list[str]:
    """Return the command that configures a CMake project for ninja: there may be no make."""
    ninja = f"-DCMAKE_MAKE_PROGRAM={Path(tool('ninja')).as_posix()}"
    return [tool("cmake"), "-G=Ninja", ninja, *options, f"-S={source}", f"-B={folder}"]


def build(source: Path, folder: Path, *options: str, target: str = "all") -> None:
    """Configure a CMake project and build it, or a target of it, with ninja."""
    output(*configure(source, folder, *options))
    output(tool("cmake"), "--build", folder, "--target", target)


def write_page(folder: Path, *names: str) -> Path:
    """Write files that docs/embedding.md shows into a folder, and return it."""
    text = (ROOT / "docs" / "embedding.md").read_text(encoding="utf-8")
    shown = dict(re.findall(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", text, re.S))
    assert len(shown) == text.count("<!-- file: ")
    folder.mkdir()
    for name in names:
        (folder / Path(name).name).write_text(shown[name], encoding="utf-8")
    return folder


def eigen() -> Path:
    """Return the prefix of Eigen."""
    places = [PURELIB / "cmeel.prefix", Path("/usr"), Path("/usr/local"), Path("/opt/homebrew")]
    for place in places:
        if (place / "include/eigen3/Eigen/Core").is_file():
            return place
    pytest.skip("no Eigen: pip install cmeel-eigen")


def pkg_config(prefix: Path, *arguments: str) -> list[str]:
    program = compiler("pkg-config", "pkgconf")
    environment = {"PKG_CONFIG_PATH": str(prefix / "lib" / "pkgconfig")}
    return shlex.split(output(program, *arguments, "curvewise", **environment))


def library_path(prefix: Path) -> dict[str, str]:
    """Return how a program finds a shared library that is not where the system looks."""
    return {"LD_LIBRARY_PATH": str(prefix / "lib"), "DYLD_LIBRARY_PATH": str(prefix / "lib")}


def loop(n: int, height: float) -> np.ndarray:
    """Return the loop of the examples, whose arithmetic is exact where n - 1 is a power of two."""
    t = 4.0 * np.arange(n) / (n - 1)
    u = np.where(t < 2.0, t - 1.0, 3.0 - t)
    bow = height * (1.0 - u * u)
    return np.column_stack([u, np.where(t < 2.0, u + bow, u - bow)])
