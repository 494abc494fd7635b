"""Damaged stores: every read raises an error of one sentence, or returns the stored data."""

from __future__ import annotations

import random
import sqlite3

import numpy as np
import pytest
from test_resuming import BOUNDS, EXPERIMENT, line

from curvewise.calibration import SDRM, SimulationStore, StoreError, identify, rescore
from curvewise.calibration.records.database import Database, checksum
from curvewise.calibration.records.rescue import rescue
from curvewise.commands import main

SHORT = {"progress": False, "method": SDRM(maxiter=2)}


class Line:
    identity = "line"

    def __call__(self, parameters):
        if parameters["a"] > 8.0:
            raise ValueError("too steep")
        return line(parameters)


def counted(file):
    with SimulationStore(file) as store:
        return len(store), store.models()


def read_runs(file):
    with SimulationStore(file) as store:
        return [repr(run) for run in store.runs("line")]


def read_searches(file):
    with SimulationStore(file) as store:
        return repr(store.searches())


def exported(file):
    with SimulationStore(file) as store:
        store.to_csv(file.with_suffix(".csv"))
    return file.with_suffix(".csv").read_text()


def rescored(file):
    found = rescore(file, EXPERIMENT, "curve_length")
    return found.value, found.parameters, found.history.tolist(), found.failures


def searched(file):
    """The last of the readers, because it also writes: it runs missing runs again."""
    found = identify(Line(), EXPERIMENT, BOUNDS, store=file, **SHORT)
    values = found.history[["a", "b", "value", "failed"]].tolist()
    return found.value, found.parameters, values, found.failures


READERS = (counted, read_runs, read_searches, exported, rescored, searched)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Return the bytes of a store, and what its readers say."""
    file = tmp_path_factory.mktemp("whole") / "s.db"
    identify(Line(), EXPERIMENT, BOUNDS, store=file, **SHORT)
    content = file.read_bytes()
    return content, {reader: reader(file) for reader in READERS}


def told(file, content, expected):
    """Write a damaged store; return the wrong results of its readers."""
    for left in file.parent.glob("s.db*"):
        left.unlink()
    file.write_bytes(content)
    sentences = set()
    for reader in READERS:
        try:
            found = reader(file)
        except StoreError as error:
            sentences.add(str(error))
        else:
            assert found == expected[reader], reader
    for sentence in sentences:
        assert sentence.startswith(f"the store {file} is damaged: ")
        assert f"curvewise report {file} --rescue NEW.db copies them" in sentence
    return sentences


def test_another_byte_is_noticed_or_does_not_matter(whole, tmp_path, rounds):
    content, expected = whole
    rng = random.Random(25)
    used = [i for i, byte in enumerate(content) if byte]  # most of a small store is empty
    # tests/faults/stores.py tries five times the number of the night.
    places = [*rng.sample(used, rounds(60)), *rng.sample(range(len(content)), rounds(20))]
    noticed = 0
    for place in places:
        damaged = bytearray(content)
        damaged[place] ^= rng.randrange(1, 256)
        noticed += bool(told(tmp_path / "s.db", damaged, expected))
    assert 0.6 * len(places) < noticed < len(places)


def test_a_store_that_is_cut_off_is_noticed(whole, tmp_path):
    content, expected = whole
    rng = random.Random(25)
    for size in (15, 100, 511, 512, 4096, *rng.sample(range(len(content)), 12)):
        assert told(tmp_path / "s.db", content[:size], expected), size


def test_what_can_be_read_is_rescued(whole, tmp_path, capsys):
    """A store with a damaged page keeps all runs but those of the page; the search continues."""
    content, expected = whole
    file, new = tmp_path / "s.db", tmp_path / "new.db"
    kept = []
    for begin in range(0, len(content), 4096):
        file.write_bytes(content[:begin] + bytes(4096) + content[begin + 4096 :])
        new.unlink(missing_ok=True)
        assert main(["report", str(file), "--rescue", str(new)]) == 0
        assert "rescued: 1 models, " in capsys.readouterr().out
        runs = read_runs(new)
        assert [run for run in expected[read_runs] if run in runs] == runs
        assert searched(new)[:2] == expected[searched][:2]
        kept.append(len(runs))
    runs = len(expected[read_runs])
    assert sum(kept) == (len(kept) - 1) * runs  # each is lost in one of them
    assert main(["report", str(file), "--rescue", str(new)]) == 1
    assert "new.db: File exists" in capsys.readouterr().err
    file.write_text("another file")
    with pytest.raises(ValueError, match=r"nothing in .* can be read as a part of a store"):
        rescue(file, tmp_path / "none.db")
    assert not (tmp_path / "none.db").exists()


def test_a_row_that_others_have_written_is_not_trusted(whole, tmp_path):
    content, _ = whole
    file = tmp_path / "s.db"
    file.write_bytes(content)
    with sqlite3.connect(file) as database:
        database.execute("UPDATE runs SET seconds = seconds + 1.0 WHERE rowid = 3")
    database.close()
    with pytest.raises(StoreError, match="a row of its table runs is not as it was written"):
        read_runs(file)
    assert exported(file)


def test_checksums_are_those_of_what_sqlite_gives_back(tmp_path):
    """It makes floats of whole numbers, and whole numbers of True; texts may be anything."""
    rows = [("ä\0b", "c", 3, "", "[]", b"\0\xff"), ("ä", "\0bc", np.float64(0.1), "x", "", b"")]
    database = Database(tmp_path / "s.db")
    with database.transaction():
        database.write("runs", rows)
        database.write("evaluations", [(1, 2, "[]", np.inf, True, 0, "")])
    assert list(database.rows("runs")) == rows
    assert list(database.rows("evaluations")) == [(1, 2, "[]", np.inf, 1, 0.0, "")]
    database.close()
    assert checksum(rows[0]) != checksum(rows[1]) != checksum(("äb", "c", 0.1, "x", "", b""))
