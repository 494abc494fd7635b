"""Make the mutants of mutants.toml one after the other, and report which the C++ tests catch.

    python tests/mutation/mutate.py                  # all; some minutes
    python tests/mutation/mutate.py --only pruned    # those with the word in description or file

The script works on a copy of the sources in build/mutants, so nothing here is changed. It builds
only the tests that a mutant names, and stops at the first that fails. Before the first mutant, the
tests must pass. If a test takes far longer with a mutant, it has caught the mutant, too. A mutant
that does not compile is an error of the list. If a mutant's text is not in its file exactly once,
the run ends before the first mutant. The exit status is 1 if a mutant survives. Needs Python 3.11,
CMake and Ninja; uses ccache if CMAKE_CXX_COMPILER_LAUNCHER names it.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import tomllib

ROOT = Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutants"
LIST = Path(__file__).with_name("mutants.toml")
# As in tests/cpp/CMakeLists.txt: a value that is read before it was written wins every minimum.
FILLED = {"GLIBC_TUNABLES": "glibc.malloc.perturb=1:glibc.malloc.tcache_count=0"}
TREES = ("cpp", "tests/cpp", "tests/stress", "CMakeLists.txt")


def read_list() -> list[dict[str, Any]]:
    """Read mutants.toml."""
    listed: list[dict[str, Any]] = tomllib.loads(LIST.read_text("utf-8"))["mutant"]
    return listed


def misplaced(mutants: list[dict[str, Any]]) -> list[str]:
    """Return the mutants whose text is not in their file exactly once, and how often it is."""
    lines = []
    for mutant in mutants:
        path = ROOT / mutant["file"]
        count = path.read_text("utf-8").count(mutant["from"]) if path.is_file() else 0
        if count != 1:
            lines.append(f"{mutant['file']}: {mutant['what']}: its text is there {count} times")
    return lines


def copy_sources() -> None:
    """Update the copy; unchanged files keep their times, so that little is built."""
    for tree in TREES:
        source = ROOT / tree
        for path in [source] if source.is_file() else sorted(source.rglob("*")):
            copy = COPY / path.relative_to(ROOT)
            if path.is_dir():
                copy.mkdir(parents=True, exist_ok=True)
            elif not copy.exists() or copy.read_bytes() != path.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, copy)


def configure() -> None:
    """Configure the copy."""
    options = ["-DCMAKE_BUILD_TYPE=Release"]
    options += ["-DCURVEWISE_BUILD_TESTS=ON", "-DCURVEWISE_INSTALL=OFF"]
    subprocess.run(
        ["cmake", "-S", COPY, "-B", COPY / "build", "-G", "Ninja", *options],
        check=True,
        stdout=subprocess.DEVNULL,
    )


def build(tests: list[str], jobs: int) -> str:
    """Build tests; return what went wrong, or nothing."""
    targets = [f"test_{name}" for name in tests]
    built = subprocess.run(
        ["ninja", "-C", COPY / "build", f"-j{jobs}", *targets],
        capture_output=True,
        text=True,
        check=False,
    )
    return built.stdout[-2000:] if built.returncode else ""


def run(name: str, limit: float) -> str:
    """Run a test for at most that many seconds; return how it failed, or nothing."""
    program = COPY / "build" / "tests" / "cpp" / f"test_{name}"
    try:
        done = subprocess.run(
            [program], env=os.environ | FILLED, capture_output=True, timeout=limit, check=False
        )
    except subprocess.TimeoutExpired:
        return f"{name} (never ends)"
    if done.returncode in (0, 1):
        return name if done.returncode else ""
    return f"{name} (status {done.returncode})"


def time_limits(tests: list[str]) -> dict[str, float]:
    """Run the tests without a mutant; return the time limit for each with one."""
    limits = {}
    for name in tests:
        begun = time.monotonic()
        failed = run(name, 600.0)
        if failed:
            sys.exit(f"without a mutant this fails: {failed}")
        limits[name] = 10.0 + 5.0 * (time.monotonic() - begun)
    return limits


def verdict(mutant: dict[str, Any], limits: dict[str, float], jobs: int) -> str:
    """Make one mutant, build and run its tests, and undo it."""
    tests = mutant["tests"]
    path = COPY / mutant["file"]
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(mutant["from"], mutant["to"]), encoding="utf-8")
    try:
        failure = build(tests, jobs)
        if failure:
            return f"ERROR: does not compile\n{failure}"
        caught = next(filter(None, (run(name, limits[name]) for name in tests)), "")
        return f"caught by {caught}" if caught else "SURVIVED"
    finally:
        path.write_text(text, encoding="utf-8")


def main() -> int:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="mutants whose description or file holds this")
    parser.add_argument("--jobs", type=int, default=2, help="of the compiler at a time")
    args = parser.parse_args()
    listed = read_list()
    if lines := misplaced(listed):
        sys.exit("\n".join(lines))
    mutants = [m for m in listed if args.only in m["what"] or args.only in m["file"]]
    copy_sources()
    configure()
    tests = sorted({name for m in mutants for name in m["tests"]})
    failure = build(tests, args.jobs)
    if failure:
        sys.exit(f"the tests do not build:\n{failure}")
    limits = time_limits(tests)
    caught = 0
    for mutant in mutants:
        begun = time.monotonic()
        said = verdict(mutant, limits, args.jobs)
        caught += said.startswith("caught")
        name = Path(mutant["file"]).name
        print(f"{time.monotonic() - begun:5.0f} s  {name}: {mutant['what']}: {said}", flush=True)
    print(f"{caught} caught of {len(mutants)}")
    return 0 if caught == len(mutants) else 1


if __name__ == "__main__":
    sys.exit(main())
