"""Threads within one pair change no bit, at any instruction-set level, and live with others."""

from __future__ import annotations

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise import reference

# Enough cells for two threads, whole and in a band.
SIZES = (3100, 2900)
CASES: list[tuple[str, dict[str, Any]]] = [
    ("dtw", {}),
    ("dtw", {"step_pattern": "symmetric2", "window": 1400}),
    ("frechet", {}),
]


def pair() -> tuple[Any, Any]:
    n, m = SIZES
    rng = np.random.default_rng(7)
    return rng.normal(size=(n, 2)).cumsum(0), rng.integers(-9, 9, (m, 2)).astype(float)


@pytest.fixture(scope="module", params=["one thread", "reference"])
def expected(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a file with the result of the reference, or of one thread of this process, for each
    case.

    With this number of cells the reference takes seconds; test_bits.py compares one thread with it
    on fewer.
    """
    P, Q = pair()
    module = reference if request.param == "reference" else curvewise
    arrays = {}
    for i, (measure, options) in enumerate(CASES):
        alignment = getattr(module, f"{measure}_path")(P, Q, **options)
        arrays[f"distance{i}"], arrays[f"path{i}"] = alignment.distance, alignment.path
    file = tmp_path_factory.mktemp("workers") / "expected.npz"
    np.savez(file, **arrays)
    return file


def differences(file: str) -> list[str]:
    """Return the differences from the expected results, at this process's level."""
    P, Q = pair()
    expected = np.load(file)
    found = []
    for i, (measure, options) in enumerate(CASES):
        for workers in (1, 2, -1):
            distance = getattr(curvewise, measure)(P, Q, **options, workers=workers)
            path = getattr(curvewise, f"{measure}_path")(P, Q, **options, workers=workers)
            same_path = np.array_equal(path.path, expected[f"path{i}"])
            if not (distance == path.distance == expected[f"distance{i}"]) or not same_path:
                found.append(f"{measure} {options} workers={workers}")
    return found


@pytest.mark.parametrize("level", curvewise.installation.build_info()["instruction_sets"])
@pytest.mark.nightly("reference")
def test_workers_change_no_bit_at_any_level(level: str, expected: Path) -> None:
    done = subprocess.run(
        [sys.executable, __file__, str(expected)],
        env={**os.environ, "CURVEWISE_ISA": level},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.split() == [level, "agrees"], done.stdout + done.stderr


def test_a_level_that_the_machine_lacks_is_an_import_error() -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import curvewise"],
        env={**os.environ, "CURVEWISE_ISA": "v9"},
        capture_output=True,
        text=True,
        check=False,
    )
    names = ", ".join(curvewise.installation.build_info()["instruction_sets"])
    last_line = done.stderr.strip().splitlines()[-1]
    assert last_line == f"ImportError: CURVEWISE_ISA is 'v9'; this machine has {names}"


@pytest.mark.parametrize("function", ["dtw", "dtw_path", "frechet", "frechet_path"])
@pytest.mark.parametrize("workers", [0, -2, 1.5, "2", None, True])
def test_workers_out_of_range(function: str, workers: Any) -> None:
    message = f"workers is {workers!r}; give a whole number >= 1, or -1 for all cores"
    with pytest.raises(ValueError, match="workers") as caught:
        getattr(curvewise, function)([1, 2], [3], workers=workers)
    assert str(caught.value) == message


def test_workers_within_the_threads_of_a_caller() -> None:
    P, Q = pair()
    expected = curvewise.dtw(P, Q)
    with ThreadPoolExecutor(4) as pool:
        calls = [pool.submit(curvewise.dtw, P, Q, workers=2) for _ in range(24)]
    assert {call.result() for call in calls} == {expected}


if __name__ == "__main__":
    print(
        curvewise.installation.build_info()["active"],
        " ".join(differences(sys.argv[1])) or "agrees",
    )
