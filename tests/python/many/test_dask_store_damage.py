"""A damaged store gives the right matrix or an error in words, and never other numbers."""

from __future__ import annotations

import shutil
import warnings
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import curvewise

pytestmark = pytest.mark.skipif(
    find_spec("dask") is None or find_spec("zarr") is None,
    reason='no dask or no zarr: pip install "curvewise[zarr]"',
)

CURVES = [
    np.random.default_rng(n).normal(size=(4 + n, 2)).cumsum(axis=0) for n in range(1, 8)
]  # blocks of 3: nine, five of them cut off at an edge


def stored(store: Path) -> Any:
    import dask

    with dask.config.set(scheduler="sync"):
        return curvewise.dask.cdist(CURVES, measure="dtw", block=3, store=store)


@pytest.fixture(scope="module")
def right() -> Any:
    return curvewise.cdist(CURVES, measure="dtw")


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    store = tmp_path_factory.mktemp("whole") / "d.zarr"
    stored(store)
    return store


@pytest.fixture
def store(whole, tmp_path) -> Path:
    return Path(shutil.copytree(whole, tmp_path / "d.zarr"))


def files(store: Path) -> list[Path]:
    return sorted(file for file in store.rglob("*") if file.is_file())


def chunk(store: Path, *place: int) -> Path:
    return store.joinpath("c", *map(str, place))


def flipped(random: np.random.Generator) -> Callable[[bytes], bytes]:
    def flip(content: bytes) -> bytes:
        changed = bytearray(content)
        changed[random.integers(len(changed))] ^= 1 << int(random.integers(8))
        return bytes(changed)

    return flip


def damages(random: np.random.Generator) -> Iterator[tuple[str, Callable[[bytes], bytes]]]:
    yield "a bit", flipped(random)
    yield "cut short", lambda content: content[: random.integers(1, len(content))]
    yield "cut by a number", lambda content: content[:-8]
    yield "longer", lambda content: content + content[-8:]
    yield "zeros", lambda content: bytes(len(content))
    yield "empty", lambda _: b""


def assert_right_or_refused(store: Path, right: Any) -> bool:
    """Return whether the call was refused."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            again, refusal = stored(store), str(store)
        except ValueError as error:
            again, refusal = None, str(error)
    assert str(store) in refusal
    if again is None:
        return True
    assert np.array_equal(again.compute(scheduler="sync"), right)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # it is whole again
        assert np.array_equal(stored(store).compute(scheduler="sync"), right)
    return False


@pytest.mark.parametrize("rounds", [6, pytest.param(100, marks=pytest.mark.nightly)])
def test_damage_of_any_block(store, right, rounds):
    """Each of the files is damaged, in some way, with a probability of one half."""
    random = np.random.default_rng(0)
    for _ in range(rounds):
        for file in files(store):
            if file.name != "zarr.json" and random.random() < 0.5:
                kinds = [damage for _, damage in damages(random)]
                kind = random.integers(len(kinds) + 1)
                if kind < len(kinds):
                    file.write_bytes(kinds[kind](file.read_bytes()))
                else:
                    file.unlink()
        assert not assert_right_or_refused(store, right)


@pytest.mark.parametrize("bits", [40, pytest.param(2000, marks=pytest.mark.nightly)])
def test_damage_of_the_description(store, right, bits):
    file, random = store / "zarr.json", np.random.default_rng(1)
    before = file.read_bytes()
    for damage in [dict(damages(random))["a bit"]] * bits + [one for _, one in damages(random)]:
        file.write_bytes(damage(before))
        assert_right_or_refused(store, right)  # zarr overlooks some letters that do not matter
    file.unlink()
    assert assert_right_or_refused(store, right)


def test_files_that_change_places(store, right):
    """Of every kind: chunks, and the records of their checksums, also of both together."""
    kinds = {name.relative_to(store).parts[0] for name in files(store)} - {"zarr.json"}
    for roots in [{root} for root in kinds] + [kinds]:
        for first, second in [((0, 1), (1, 0)), ((2, 0), (2, 1))]:
            for root in roots:
                a, b = (store.joinpath(root, *map(str, place)) for place in (first, second))
                contents = a.read_bytes(), b.read_bytes()
                a.write_bytes(contents[1])
                b.write_bytes(contents[0])
            assert not assert_right_or_refused(store, right)
            for root in roots:  # a copy, so that one of them is there twice
                shutil.copy(
                    store.joinpath(root, *map(str, first)), store.joinpath(root, *map(str, second))
                )
            assert not assert_right_or_refused(store, right)


def test_blocks_of_another_store(store, right, tmp_path):
    others = [2 * curve for curve in CURVES]
    curvewise.dask.cdist(others, measure="dtw", block=3, store=tmp_path / "other.zarr")
    for file in files(tmp_path / "other.zarr"):
        if file.name != "zarr.json":
            shutil.copy(file, store / file.relative_to(tmp_path / "other.zarr"))
    assert not assert_right_or_refused(store, right)


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (flipped(np.random.default_rng(0)), "its content has changed"),
        (lambda content: content[:-8], "it has 68 bytes instead of 76"),
        (lambda _: b"", "it has 0 bytes instead of 76"),
        (lambda content: bytes(len(content)), "its content has changed"),
        (None, "it is missing"),
    ],
)
def test_damage_is_named_and_only_the_block_computed(store, right, damage, said):
    if damage:
        chunk(store, 0, 2).write_bytes(damage(chunk(store, 0, 2).read_bytes()))
    else:
        chunk(store, 0, 2).unlink()
    others = {f: f.stat().st_mtime_ns for f in files(store) if f.parts[-2:] != ("0", "2")}
    words = rf"^{store}: damaged blocks are computed again: block \(0, 2\): {said}$"
    with pytest.warns(UserWarning, match=words) as met:
        again = stored(store)
    assert len(met) == 1
    assert met[0].filename == __file__
    assert np.array_equal(again.compute(scheduler="sync"), right)
    assert {file: file.stat().st_mtime_ns for file in others} == others


def test_many_damaged_blocks_are_one_warning(store):
    for file in files(store / "c"):
        file.write_bytes(b"")
    with pytest.warns(UserWarning, match=r"block \(0, 2\): .* instead of 76; and 6 more$") as met:
        stored(store)
    assert len(met) == 1


def test_a_block_whose_writing_was_interrupted_is_no_damage(store, right):
    checksum = next(f for f in files(store) if f.parts[-2:] == ("1", "2") and "c" not in f.parts)
    checksum.unlink()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.array_equal(stored(store).compute(scheduler="sync"), right)
    assert checksum.is_file()


def test_damage_after_the_store_was_opened(store, right):
    """The lazy matrix reads blocks when it is used."""
    import zarr

    lazy = stored(store)
    whole = chunk(store, 1, 1).read_bytes()
    for what, damage in damages(np.random.default_rng(0)):
        chunk(store, 1, 1).write_bytes(damage(whole))
        with pytest.raises(ValueError, match=rf"^{store}: block \(1, 1\) is damaged: it") as met:
            lazy.compute(scheduler="sync")
        assert "call cdist or pdist with this store again" in str(met.value), what
        with pytest.raises(ValueError, match=r"checksum|reshape"):
            zarr.open_array(store, mode="r")[:]
    shutil.copy(chunk(store, 1, 0), chunk(store, 1, 1))
    with pytest.raises(ValueError, match=r"block \(1, 1\) is damaged: it is not the block"):
        lazy.compute(scheduler="sync")
    chunk(store, 1, 1).unlink()
    with pytest.raises(ValueError, match=r"block \(1, 1\) is damaged: it is missing"):
        lazy.compute(scheduler="sync")
    chunk(store, 1, 1).write_bytes(whole)
    assert np.array_equal(lazy.compute(scheduler="sync"), right)


def test_a_description_that_is_damaged_is_refused_in_words(store):
    description = store / "zarr.json"
    text = description.read_text(encoding="utf-8")
    for old, new in (
        ('_type": "float64"', '_type": "float32"'), ("little", "big"), ('"NaN"', "0.0"),
            ("crc32c", "bytes"),
        (text, ""), (text, text[:200]), (text, "null"), (text, "[" * 2000),
    ):  # fmt: skip
        description.write_text(text.replace(old, new), encoding="utf-8")
        words = rf"^{store} is there and holds no .* or its zarr.json is damaged; give another"
        with pytest.raises(ValueError, match=words):
            stored(store)
