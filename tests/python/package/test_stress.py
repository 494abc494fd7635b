"""The programs that run for hours (tests/stress, tests/fuzz), for a second each."""

from __future__ import annotations

import importlib
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


def test_any_bytes_are_read_or_refused(monkeypatch, tmp_path) -> None:
    fuzz_read_curve = program(monkeypatch, "fuzz", "fuzz_read_curve")
    choices = random.Random(1)
    seeds = [path.read_bytes() for path in sorted(fuzz_read_curve.SEEDS.iterdir())]
    for seed in seeds:
        fuzz_read_curve.check(seed, tmp_path / "any.csv")
    for _ in range(400):
        data = fuzz_read_curve.changed(choices.choice(seeds), choices)
        fuzz_read_curve.check(data, tmp_path / "any.csv")
