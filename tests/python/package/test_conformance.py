"""The conformance cases: every certificate holds, a changed one does not, curvewise passes."""

from __future__ import annotations

import copy
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

ROOM = Path(__file__).resolve().parents[3] / "conformance"
NAMES = ("free_space", "verify", "exact", "make", "run", "worker")
# The square root of dtw-squared is the adapter's, of squares that overflow or vanish.
KNOWN = {("dtw-squared-root", "extreme"): 12}

if not ROOM.is_dir():
    pytest.skip("the folder conformance is not here", allow_module_level=True)


@pytest.fixture(scope="module")
def room() -> Iterator[dict[str, ModuleType]]:
    """The folder's modules, whose names are for scripts: afterwards they are gone."""
    sys.path.insert(0, str(ROOM))
    try:
        yield {name: __import__(name) for name in NAMES}
    finally:
        sys.path.remove(str(ROOM))
        for name in NAMES:
            sys.modules.pop(name, None)


@pytest.fixture(scope="module")
def cases(room: dict[str, ModuleType]) -> list[dict[str, Any]]:
    return list(room["verify"].read_cases())


def test_every_certificate_holds(room: dict[str, ModuleType], cases: list[dict[str, Any]]) -> None:
    assert len(cases) > 1000
    assert {case["check"] for case in cases} == set(room["verify"].CHECKS)
    assert len({case["id"] for case in cases}) == len(cases)
    for case in cases:
        room["verify"].verify(case)


def changes(case: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield wrong values, and certificates that no longer show the value."""

    def changed(**parts: Any) -> dict[str, Any]:
        other = copy.deepcopy(case)
        other["certificate"].update(parts)
        return other

    larger = copy.deepcopy(case)
    larger["value"]["terms"][0][1] += "1"
    yield "terms", larger
    rounded = copy.deepcopy(case)
    rounded["value"]["hex"] = (float.fromhex(case["value"]["hex"]) * (1 + 2**-50)).hex()
    yield "hex", rounded
    shown = case["certificate"]
    if "path" in shown:
        yield "path", changed(path=shown["path"][:-1])
        low = [
            [None if x is None else str(int(x) * 99 // 100) for x in row]
            for row in shown["potentials"]
        ]
        yield "low potentials", changed(potentials=low)
        high = [
            [None if x is None else str(int(x) * 2 + 1) for x in row] for row in shown["potentials"]
        ]
        yield "high potentials", changed(potentials=high)
    if "coupling" in shown:
        yield "coupling", changed(coupling=shown["coupling"][:-1])
        yield "blocked", changed(blocked=[])
    if "matching" in shown:
        yield "matching", changed(matching=[shown["matching"][0], shown["matching"][-1]])
    if "partners" in shown:
        yield "farthest", changed(farthest=["P", 0])
        (side, *_) = shown["partners"]
        yield "partners", changed(partners={**shown["partners"], side: []})
    if "depths" in shown:
        yield "depths", changed(depths=shown["depths"][::-1])
        swapped = [[[1, 0, 2, 3], area] for _, area in shown["quadrilaterals"]]
        yield "order", changed(quadrilaterals=swapped)


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("dtw/walk-3", 5),
        ("dtw-squared-root/walk-4", 5),
        ("frechet/leash-past-a-corner", 4),
        ("frechet-continuous/to-and-fro", 3),
        ("hausdorff/leash-past-a-corner", 4),
        ("area/leash-past-a-corner", 4),
    ],
)
def test_a_changed_value_or_certificate_is_found(
    room: dict[str, ModuleType], cases: list[dict[str, Any]], name: str, kinds: int
) -> None:
    (case,) = (case for case in cases if case["id"] == name)
    found = dict(changes(case))
    assert len(found) == kinds
    for changed in found.values():
        with pytest.raises(room["verify"].WrongError):
            room["verify"].verify(changed)


def test_the_continuous_value_is_not_one_that_is_just_longer(
    room: dict[str, ModuleType], cases: list[dict[str, Any]]
) -> None:
    """The matching allows it; the free-space diagram below it does not."""
    (case,) = (c for c in cases if c["id"] == "frechet-continuous/to-and-fro")
    assert case["value"]["terms"] == [["1", "13/4"]]
    longer = copy.deepcopy(case)
    longer["value"] = {"terms": [["1", "16"]], "double": "4.0", "hex": "0x1p+2"}
    with pytest.raises(room["verify"].WrongError, match="a shorter leash is long enough"):
        room["verify"].verify(longer)


def test_the_files_are_what_make_writes(
    room: dict[str, ModuleType], cases: list[dict[str, Any]]
) -> None:
    for check in ("area", "frechet", "dtw-window-difference"):
        made = [json.loads(json.dumps(case)) for case in room["make"].make(check)]
        assert made == [case for case in cases if case["check"] == check]


def test_curvewise_passes(room: dict[str, ModuleType], cases: list[dict[str, Any]]) -> None:
    adapter = room["worker"].load(str(ROOM / "adapters" / "curvewise.py"), None)
    failed: dict[tuple[str, str], int] = {}
    for case in cases:
        if case["check"] not in adapter["CHECKS"]:
            continue
        said = room["worker"].answer(adapter, case)
        right = "raises" if case["kind"] == "refused" else "pass"
        if room["run"].outcome(case, said, 1e-9) != right:
            key = (case["check"], case["kind"])
            failed[key] = failed.get(key, 0) + 1
    assert failed == KNOWN


ADAPTER = """
import os, time
PACKAGE = "made up"
LICENCE = "none"
def call(P, Q):
    if len(P) == 2:
        time.sleep(60)
    if len(P) == 3:
        os.abort()
    if len(P) == 4:
        raise KeyError("no")
    return abs(P - Q).max() + 1
CHECKS = {"frechet": call}
"""


def test_a_crash_or_a_hang_does_not_end_the_run(
    room: dict[str, ModuleType], tmp_path: Path
) -> None:
    file = tmp_path / "adapter.py"
    file.write_text(ADAPTER)
    process = room["run"].Process(sys.executable, str(file), None, 0.3)

    def ask(n: int) -> dict[str, str]:
        rows = [[0.0, 0.0]] * n
        return process.ask({"check": "frechet", "P": rows, "Q": rows, "parameters": {}})

    try:
        assert process.about["checks"] == ["frechet"]
        assert ask(1) == {"number": "1.0"}
        assert list(ask(2)) == ["hung"]
        assert list(ask(3)) == ["crashed"]
        assert ask(4) == {"raised": "KeyError: 'no'"}
        # What differs is made as short as it can be: one point each.
        case = {"check": "frechet", "kind": "usual", "parameters": {}}
        case |= {"P": [[1.0, 2.0]], "Q": [[3.0, 4.0]] * 5}
        small, number = room["run"].shrink(process, room["run"].with_value(case), 1e-9)
        assert (small["P"], small["Q"], number) == ([[0.0, 0.0]], [[0.0, 0.0]], "1.0")
    finally:
        process.end()
