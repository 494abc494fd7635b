"""The programs that run for hours (tests/stress, tests/fuzz), for a second each."""

from __future__ import annotations

import importlib
import os
import random
import sys
from pathlib import Path
from types import ModuleType

import pytest

TESTS = Path(__file__).resolve().parents[2]


def program(monkeypatch: pytest.MonkeyPatch, folder: str, name: str) -> ModuleType:
    """Import a program from its folder."""
    if not (TESTS / folder / f"{name}.py").is_file():
        pytest.skip(f"not a source tree: no tests/{folder}/{name}.py")
    monkeypatch.syspath_prepend(str(TESTS / folder))
    monkeypatch.setitem(sys.modules, "atheris", None)  # which hooks into imports, for good
    return importlib.import_module(name)


def test_nasty_pairs_agree_with_the_reference(monkeypatch) -> None:
    reference_pairs = program(monkeypatch, "stress", "reference_pairs")
    record = reference_pairs.Record()
    for number in range(50):
        reference_pairs.check(record, 20261122, number)
    assert not +record.wrong
    assert record.compared["dtw"] > 20
    assert record.compared["frechet_continuous"] > 5


@pytest.mark.parametrize("name", ["fuzz_read_curve", "fuzz_study"])
def test_any_bytes_are_read_or_refused(monkeypatch, tmp_path, name) -> None:
    target = program(monkeypatch, "fuzz", name)
    check = target.make_check(tmp_path)
    choices = random.Random(1)
    seeds = [path.read_bytes() for path in sorted(target.SEEDS.iterdir())]
    for seed in seeds:
        check(seed)
    for _ in range(300):
        check(target.change(choices.choice(seeds), choices))


def write_beside(path: Path) -> None:
    path.with_name("other.txt").write_text("")


WRONG_READERS = {
    "starts a process": lambda path: os.system("true"),
    "writes a file": write_beside,
    "makes a folder": lambda path: (path.parent / "made").mkdir(),
}


@pytest.mark.parametrize("name", WRONG_READERS)
def test_the_study_target_sees_what_a_reader_must_not_do(monkeypatch, tmp_path, name) -> None:
    target = program(monkeypatch, "fuzz", "fuzz_study")
    check = target.make_check(tmp_path)
    monkeypatch.setattr(target.Study, "read", WRONG_READERS[name])
    with pytest.raises(target.FoundError, match="reading a study does"):
        check(b"")
