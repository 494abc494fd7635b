"""The list of C++ mutants (tests/mutation), made by nightly runs: each has its text to change."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("tomllib", reason="mutate.py reads TOML as Python does from 3.11 on")
MUTATE = Path(__file__).resolve().parents[2] / "mutation" / "mutate.py"


@pytest.fixture(scope="module")
def mutate():
    specification = importlib.util.spec_from_file_location("mutate", MUTATE)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_every_mutant_has_its_text_once(mutate):
    listed = mutate.read_list()
    assert len(listed) > 80
    assert mutate.misplaced(listed) == []


def test_a_text_that_is_gone_or_there_twice_is_told(mutate):
    file = "tests/mutation/mutate.py"
    gone = {"what": "one", "file": file, "from": "no such " + "text"}
    twice = {"what": "another", "file": file, "from": "import"}
    no_file = {"what": "a third", "file": "cpp/none.cpp", "from": "import"}
    told = mutate.misplaced([gone, twice, no_file])
    assert len(told) == 3
    assert told[0] == f"{file}: one: its text is there 0 times"
    assert told[2] == "cpp/none.cpp: a third: its text is there 0 times"
