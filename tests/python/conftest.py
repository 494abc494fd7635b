"""Common code of the tests: the golden data, the processes, and the header of a run.

Tests that are marked nightly are skipped, unless `-m` names the mark or the command names the test
("file.py::test"). They take long and seldom find more than the others (tests/README.md lists them).
The mark takes patterns for the ids of cases; without a pattern it covers all of them. If they are
skipped, the tests of properties have fewer examples, and those of random curves fewer rounds.

The whole suite runs in one process more than there are cores (pytest-xdist). The tests of a file
stay together, in one process and in their order, so that a fixture of a file is made once. Files
whose tests take seconds each are distributed test by test, and the longest begin first. A run of
named files or tests is one process, as are `pytest -n 0` and `pytest --pdb`.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("CURVEWISE_DATA", ROOT.parent / "shared" / "data"))

# The longest tests, to start first: tests that build the libraries, then tests without them, so
# that no test waits for the libraries. Among the latter are only files whose tests do not share a
# long preparation.
LONGEST_FIRST = (
    "embedding/test_embed.py::test_fetch_content",
    "commands/test_selfcheck.py::test_selfcheck_passes_on_this_machine",
    "calibration/",
    "embedding/",
    "plotting/",
)
TEST_BY_TEST = ("embedding/test_embed.py", "package/test_docs.py", LONGEST_FIRST[2])


def place(nodeid: str) -> str:
    """Return a test's id from tests/python on, e.g. "package/test_docs.py::test_x"."""
    return nodeid.removeprefix("tests/python/")


def leaves_out_nightly(config: pytest.Config) -> bool:
    """Return whether the tests that are marked nightly are not asked for."""
    named = any("::" in argument for argument in config.args)
    return not named and "nightly" not in config.option.markexpr


def is_nightly(item: pytest.Item) -> bool:
    """Return whether a test, or this case of it, is marked nightly."""
    return any(
        not mark.args or any(re.search(case, item.callspec.id) for case in mark.args)
        for mark in item.iter_markers("nightly")
    )


def pytest_configure(config: pytest.Config) -> None:
    """Have the tests of properties draw fewer examples by day, if they do not say how many."""
    # No deadline: it says how busy the machine is.
    examples = 40 if leaves_out_nightly(config) else 200
    settings.register_profile("curvewise", max_examples=examples, deadline=None)
    settings.load_profile("curvewise")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Skip nightly tests, and begin with the longest."""
    if leaves_out_nightly(config):
        config.hook.pytest_deselected(items=[item for item in items if is_nightly(item)])
        items[:] = [item for item in items if not is_nightly(item)]

    def rank(item: pytest.Item) -> int:
        starts = [i for i, name in enumerate(LONGEST_FIRST) if place(item.nodeid).startswith(name)]
        return starts[0] if starts else len(LONGEST_FIRST)

    items.sort(key=rank)  # stable


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Keep the tests of a file together, except for those that are shared out one by one."""
    if config.getvalue("dist") != "loadscope":
        return None  # Somebody has asked for another way.
    from xdist.scheduler import LoadScopeScheduling

    class FileScheduling(LoadScopeScheduling):
        # Not by pytest-xdist's marks for groups: they are lost where pytest is newer than 9.0.
        def _split_scope(self, nodeid: str) -> str:
            return nodeid if place(nodeid).startswith(TEST_BY_TEST) else nodeid.partition("::")[0]

    return FileScheduling(config, log)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """Answer `-n auto`: a process for each core for the whole suite, a single one for a part of it.

    And one more: some tests wait, for solvers and signals.
    """
    whole = config.args == config.getini("testpaths")
    cores = min(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1, 8)
    return cores + 1 if whole and cores > 1 else 0


def pytest_report_header(config: pytest.Config) -> list[str]:
    """Print the scope, the time and the skipped tests of a run of the whole suite."""
    lines = []
    if config.args == config.getini("testpaths"):
        lines.append(
            "curvewise: some 8600 tests; they also build programs that use the library; about "
            "five minutes on two cores"
        )
    if leaves_out_nightly(config):
        lines.append("curvewise: without the tests for the night, which take long (-m nightly)")
    if not DATA.is_dir():
        lines.append(f"curvewise: no golden data in {DATA} (CURVEWISE_DATA): its tests are skipped")
    missing = [name for name in ("g++", "clang++", "gfortran", "pkg-config") if not found(name)]
    if missing:
        lines.append(f"curvewise: no {', '.join(missing)}: the tests that use it are skipped")
    return lines


def found(program: str) -> bool:
    """Return whether there is such a program."""
    return shutil.which(program) is not None


@pytest.fixture(scope="session", autouse=True)
def ctrl_c_is_heard() -> Iterator[None]:
    """Have SIGINT raise KeyboardInterrupt: a process started in the background ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def rounds(pytestconfig: pytest.Config) -> Callable[[int], int]:
    """Return how many of `count` random cases a test tries: by day a fifth, as for properties."""
    return lambda count: -(-count // 5) if leaves_out_nightly(pytestconfig) else count


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Return the folder with golden/, loops/ and paper/; skip the test where it is absent."""
    if not DATA.is_dir():
        pytest.skip(f"no golden data in {DATA}: set CURVEWISE_DATA to the folder that has it")
    return DATA
