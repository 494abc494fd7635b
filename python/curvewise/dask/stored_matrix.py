"""A matrix, or its triangle, on disk: begun, begun again, or grown by new curves.

The attributes of the zarr array hold the settings and the digests of the curves. A call with others
is refused, except that a matrix grows if its curves are the first ones of longer lists. Its
description is then replaced in one step. A block at the edge keeps its stored part, and only its
other distances are computed.
"""

from __future__ import annotations

import hashlib
import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any

from .._extras import extra
from ..curves.foreign_curves import warn
from ..curves.inputs import Array
from ..curves.several_curves import digest
from .block_store import Block, BlockStore, Place
from .pieces import Delayed, HighLevelGraph, dask_array, lazy_array, tokenize

__all__ = ["Contents", "Known", "StoredMatrix", "begin_store"]

Known = Mapping[Place, Callable[[], Array]]
"""Functions that read the stored parts of unfinished blocks."""

_KEY = "curvewise"  # of what a store is of, among the attributes of its array
_NAMED = 3  # damaged blocks that a warning names


class Contents:
    """What a store is of.

    Parameters
    ----------
    settings : dict of str to str
        The measure, and everything else on which the distances depend.
    **lists : list of ndarray
        The curves, by the names that the caller knows: of each side of a matrix, or X of a
        triangle.
    """

    def __init__(self, settings: dict[str, str], **lists: list[Array]) -> None:
        self.settings = settings
        self.lists = lists
        self._digests: dict[tuple[str, int, int], str] = {}

    def described(self, shape: tuple[int, ...]) -> dict[str, str]:
        """Return the attributes of a store of this shape."""
        counts = shape if self.is_matrix else [len(curves) for curves in self.lists.values()]
        pairs = zip(self.lists, counts, strict=True)
        return {name: self._digest(name, 0, count) for name, count in pairs} | self.settings

    def tie(self, place: Place, shape: tuple[int, ...], block: tuple[int, ...]) -> str:
        """Return the digest of what the first distances of a block depend on."""
        begins = [i * size for i, size in zip(place, block, strict=True)]
        if self.is_matrix:
            sides = zip(self.lists, begins, shape, strict=True)
            found = [self._digest(name, begin, begin + count) for name, begin, count in sides]
        else:
            found = [self._digest(name, 0, len(curves)) for name, curves in self.lists.items()]
        return hashlib.sha256(repr((found, sorted(self.settings.items()))).encode()).hexdigest()

    @property
    def is_matrix(self) -> bool:
        """Whether each side of the array has curves of its own."""
        return len(self.lists) > 1

    def _digest(self, name: str, begin: int, end: int) -> str:
        key = name, begin, end
        if key not in self._digests:
            self._digests[key] = digest(self.lists[name][begin:end])
        return self._digests[key]


@dataclass(frozen=True)
class StoredMatrix:
    """A store whose blocks are there, unfinished or missing."""

    store: BlockStore
    contents: Contents

    def filled(self, build: Callable[[Known], dask_array.Array]) -> dask_array.Array:
        """Compute the distances that are not there or damaged; return the array, read where used.

        `build` returns the array to compute; it leaves the stored parts of blocks to functions.
        """
        store, array = self.store, self.store.array
        if not math.prod(array.shape):
            return build({})
        sides = [range(-(-n // size)) for n, size in zip(array.shape, array.chunks, strict=True)]
        whole = {place: self._whole(place) for place in product(*sides)}
        stored = {place: self._stored(block) for place, block in whole.items()}
        written = [block for block in stored.values() if block]
        damages = self._computed("check", [(partial(store.damage, block),) for block in written])
        found = {block.place: what for block, what in zip(written, damages, strict=True) if what}
        if found:
            warn(f"{store.folder}: damaged blocks are computed again: {_listed(found)}")
        sound = {block.place: block for block in written if block.place not in found}
        parts = {place: block for place, block in sound.items() if block != whole[place]}
        lazy = build({place: partial(store.read, block) for place, block in parts.items()})
        wanted = [block for place, block in whole.items() if sound.get(place) != block]
        writes = [(partial(store.write, block), (lazy.name, *block.place)) for block in wanted]
        self._computed("write", writes, lazy)
        name = f"read-{self._token()}"
        reads = {(name, *place): (partial(store.read, block),) for place, block in whole.items()}
        return lazy_array(reads, name, lazy.chunks, array.dtype)

    def _whole(self, place: Place) -> Block:
        array = self.store.array
        sides = zip(place, array.shape, array.chunks, strict=True)
        shape = tuple(min(size, n - i * size) for i, n, size in sides)
        return Block(place, shape, self.contents.tie(place, shape, array.chunks))

    def _stored(self, block: Block) -> Block | None:
        """Return the part of a block that was written, if any."""
        shape = self.store.stored_shape(block.place, block.shape)
        if shape is None:
            return None
        tie = self.contents.tie(block.place, shape, self.store.array.chunks)
        return Block(block.place, shape, tie)

    def _computed(self, what: str, tasks: list[Any], *of: dask_array.Array) -> list[Any]:
        """Run tasks on the scheduler in use; return their results in order."""
        name = f"{what}-{self._token(*(lazy.name for lazy in of))}"
        graph: dict[Any, Any] = {(name, k): task for k, task in enumerate(tasks)}
        graph[name] = (list, list(graph))
        # dask's own types do not fit together here, or are not there.
        collections: Any = of
        delayed: Callable[..., Any] = Delayed
        results = delayed(name, HighLevelGraph.from_collections(name, graph, collections)).compute()
        return list(results)

    def _token(self, *names: str) -> str:
        described = self.contents.described(self.store.array.shape)
        token: str = tokenize(self.store.folder, described, *names)
        return token


def begin_store(
    store: str | os.PathLike[str],
    shape: tuple[int, ...],
    block: tuple[int, ...],
    contents: Contents,
    *,
    keep_block: bool = False,
) -> StoredMatrix:
    """Return a new store, or one for the same contents or the first of its curves.

    A store that is there keeps its own size of blocks with `keep_block`.

    Raises
    ------
    ValueError
        If the store was begun for other contents, holds something else, or its description is
        damaged.
    ImportError
        If zarr is missing.
    """
    _zarr()
    folder = os.path.abspath(store)
    if not os.path.lexists(folder) or (os.path.isdir(folder) and _is_bare(folder)):
        array = _created(folder, shape, block, contents)
        return StoredMatrix(BlockStore(folder, array), contents)
    array, found = _begun(folder, store)
    if keep_block and len(array.chunks) == len(block):
        block = array.chunks
    _check_contents(store, shape, block, contents, array, found)
    if array.metadata.to_dict() != _created({}, array.shape, block, contents).metadata.to_dict():
        raise ValueError(_foreign(store))
    for unfinished in Path(folder).rglob("*.partial"):  # SIGKILL met it
        unfinished.unlink(missing_ok=True)
    if array.shape != shape:
        _replace_description(folder, shape, block, contents)
        array = _begun(folder, store)[0]
    return StoredMatrix(BlockStore(folder, array), contents)


def _check_contents(
    store: str | os.PathLike[str],
    shape: tuple[int, ...],
    block: tuple[int, ...],
    contents: Contents,
    array: Any,
    found: dict[str, Any],
) -> None:
    """Raise ValueError if a store is of other curves or settings."""
    may_grow = contents.is_matrix and len(array.shape) == len(shape)
    stored = tuple(map(min, array.shape, shape)) if may_grow else shape
    wanted = _attributes(stored, block, contents)
    said = {
        name: f"{name} {found.get(name)}, not {content}"
        for name, content in wanted.items()
        if found.get(name) != content
    }
    for name, count, least in zip(contents.lists, shape, array.shape, strict=False):
        if name in said and may_grow and count < least:
            said[name] = f"{least} curves {name}, not {count}"
        elif name in said:
            said[name] = f"other curves {name}"
    if said:
        advice = "give what it was begun with, or another store"
        if "X" in said:
            advice += ": only a store of cdist grows by new curves"
        raise ValueError(f"{store} was begun with {' and '.join(said.values())}; {advice}")


def _attributes(
    shape: tuple[int, ...], block: tuple[int, ...], contents: Contents
) -> dict[str, str]:
    return contents.described(shape) | {"block": repr(block)}


def _created(
    where: str | dict[str, Any], shape: tuple[int, ...], block: tuple[int, ...], contents: Contents
) -> Any:
    """Write the description of an array to a folder, or to a dict; return the array."""
    zarr = _zarr()
    return zarr.create_array(
        where,
        shape=shape,
        chunks=block,
        dtype=contents.settings["dtype"],
        compressors=zarr.codecs.Crc32cCodec(),
        fill_value=math.nan,
        attributes={_KEY: _attributes(shape, block, contents)},
        zarr_format=3,
        chunk_key_encoding={"name": "default", "separator": "/"},
        # zarr leaves out chunks of nothing but its fill value, if it is not told otherwise.
        config={"write_empty_chunks": True},
    )


def _replace_description(
    folder: str, shape: tuple[int, ...], block: tuple[int, ...], contents: Contents
) -> None:
    """Make a store one of another shape, in a single step that also survives a crash."""
    described: dict[str, Any] = {}
    _created(described, shape, block, contents)
    half = Path(folder, "zarr.json.partial")
    with half.open("wb") as file:
        file.write(described["zarr.json"].to_bytes())
        file.flush()
        os.fsync(file.fileno())
    os.replace(half, Path(folder, "zarr.json"))


def _begun(folder: str, store: str | os.PathLike[str]) -> tuple[Any, dict[str, Any]]:
    """Return a store's array, and the contents for which it was begun."""
    try:
        array = _zarr().open_array(folder, mode="r+", config={"write_empty_chunks": True})
        return array, dict(array.attrs[_KEY])
    except Exception as error:  # whatever zarr meets in a damaged description
        raise ValueError(_foreign(store)) from error


def _foreign(store: str | os.PathLike[str]) -> str:
    return (
        f"{store} is there and holds no distances that curvewise.dask began, or its zarr.json is "
        "damaged; give another store"
    )


def _listed(damaged: dict[Place, str]) -> str:
    """Name the first damaged blocks, and count the others."""
    named = [f"block {place}: {what}" for place, what in list(damaged.items())[:_NAMED]]
    if len(damaged) > _NAMED:
        named.append(f"and {len(damaged) - _NAMED} more")
    return "; ".join(named)


def _is_bare(folder: str) -> bool:
    """Return whether a folder is empty, except for a partial description."""
    return all(name.endswith(".partial") for name in os.listdir(folder))


def _zarr() -> Any:
    with extra("zarr", "a store needs zarr >= 3.1.3 (Python >= 3.11)"):
        zarr = import_module("zarr")
        if not _renames(zarr.__version__):
            raise ImportError(f"zarr {zarr.__version__} writes chunks in place")
        return zarr


def _renames(version: str) -> bool:
    """Return whether this zarr writes chunks whole or not at all."""
    return tuple(map(int, re.findall(r"\d+", version)[:3])) >= (3, 1, 3)
