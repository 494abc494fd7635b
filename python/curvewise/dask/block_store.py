"""Distances on disk, block by block: a zarr array with its description.

zarr writes a chunk under another name and then renames it (``LocalStore`` from 3.1.3 on), so that
SIGKILL leaves either the whole file of a chunk or no file. The package does not wait for the disk:
a crash of the whole machine may leave a chunk without its content. Each chunk therefore ends in a
checksum, which zarr's codec crc32c writes and checks. The codec does not know a chunk's place. A
file in ``checksums`` therefore ties the checksum to the block's place and to the store's contents.
It is written after the chunk, and a chunk without it is unfinished. The chunks are not compressed,
because the digits of distances are practically random.
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

import numpy as np

from .._extras import extra
from ..curves.foreign_curves import warn
from ..curves.inputs import Array
from .pieces import Delayed, HighLevelGraph, dask_array, lazy_array, tokenize

__all__ = ["BlockStore", "Place", "begin_store"]

Place = tuple[int, ...]

_KEY = "curvewise"  # of what a store is of, among the attributes of its array
_CHECKSUM = 4  # bytes of crc32c, at the end of a chunk
_NAMED = 3  # damaged blocks that a warning names


class DamageError(ValueError):
    """The fault of a block."""


@dataclass(frozen=True)
class BlockStore:
    """A zarr array in a folder; each of its chunks is a block of distances.

    Attributes
    ----------
    folder : str
        The folder; a cluster's workers must see the same folder.
    array : zarr.Array
        The array, as the checked description defines it; it does not depend on later damage of the
        file.
    contents : mapping of str to str
        The digests of the store's input.
    """

    folder: str
    array: Any
    contents: Mapping[str, str]

    def write(self, place: Place, values: Array) -> None:
        """Write a block, and then what ties it to its place."""
        self.array[self._slices(place)] = values
        record = self._record(place)
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_bytes(self._seal(place))

    def read(self, place: Place) -> Array:
        """Read a block.

        Raises
        ------
        ValueError
            If the block is damaged.
        """
        try:
            return self._checked(place)
        except DamageError as error:
            raise ValueError(
                f"{self.folder}: block {place} is damaged: {error}; call cdist or pdist with this "
                "store again to compute it"
            ) from error

    def damage(self, place: Place) -> str | None:
        """Return the damage of a block that was written, if any."""
        try:
            self._checked(place)
        except DamageError as error:
            return str(error)
        return None

    def filled(self, lazy: dask_array.Array) -> dask_array.Array:
        """Compute the blocks that are not there or damaged; return the array, read where used."""
        if not lazy.size:
            return lazy
        places = list(product(*map(range, lazy.numblocks)))
        written = [place for place in places if self._record(place).is_file()]
        checks = [(partial(self.damage, place),) for place in written]
        found = dict(zip(written, self._computed("check", checks), strict=True))
        damaged = {place: what for place, what in found.items() if what}
        if damaged:
            warn(f"{self.folder}: damaged blocks are computed again: {_listed(damaged)}")
        wanted = [place for place in places if place not in found or place in damaged]
        writes = [(partial(self.write, place), (lazy.name, *place)) for place in wanted]
        self._computed("write", writes, lazy)
        name = f"read-{tokenize(self.folder, self.contents)}"
        reads = {(name, *place): (partial(self.read, place),) for place in places}
        return lazy_array(reads, name, lazy.chunks, np.float64)

    def _computed(self, what: str, tasks: list[Any], *of: dask_array.Array) -> list[Any]:
        """Run tasks on the scheduler in use; return their results in order."""
        name = f"{what}-{tokenize(self.folder, self.contents, *(lazy.name for lazy in of))}"
        graph: dict[Any, Any] = {(name, k): task for k, task in enumerate(tasks)}
        graph[name] = (list, list(graph))
        # dask's own types do not fit together here, or are not there.
        collections: Any = of
        delayed: Callable[..., Any] = Delayed
        results = delayed(name, HighLevelGraph.from_collections(name, graph, collections)).compute()
        return list(results)

    def _checked(self, place: Place) -> Array:
        """Read a block; raise DamageError if it is not the one that was written."""
        chunk = self._chunk(place)
        if not chunk.is_file():
            raise DamageError("it is missing")
        found, size = chunk.stat().st_size, 8 * math.prod(self.array.chunks) + _CHECKSUM
        if found != size:
            raise DamageError(f"it has {found} bytes instead of {size}")
        try:
            values: Array = self.array[self._slices(place)]
        except ValueError as error:
            raise DamageError("its content has changed") from error
        if self._record(place).read_bytes() != self._seal(place):
            raise DamageError("it is not the block that was written here")
        return values

    def _slices(self, place: Place) -> tuple[slice, ...]:
        pairs = zip(place, self.array.chunks, strict=True)
        return tuple(slice(i * size, (i + 1) * size) for i, size in pairs)

    def _chunk(self, place: Place) -> Path:
        return Path(self.folder, "c", *map(str, place))

    def _record(self, place: Place) -> Path:
        return Path(self.folder, "checksums", *map(str, place))

    def _seal(self, place: Place) -> bytes:
        """Return what ties the checksum in a chunk to a place in a matrix of these contents."""
        with self._chunk(place).open("rb") as file:
            file.seek(-_CHECKSUM, os.SEEK_END)
            tied = repr((sorted(self.contents.items()), place, file.read()))
        return hashlib.sha256(tied.encode()).hexdigest().encode()


def begin_store(
    store: str | os.PathLike[str],
    shape: tuple[int, ...],
    block: tuple[int, ...],
    contents: dict[str, str],
) -> BlockStore:
    """Return a new store, or an unfinished one for the same contents.

    Raises
    ------
    ValueError
        If the store was begun for other contents, holds something else, or its description is
        damaged.
    ImportError
        If zarr is missing.
    """
    zarr = _zarr()
    folder, contents = os.path.abspath(store), contents | {"block": repr(block)}
    create = partial(
        zarr.create_array,
        shape=shape,
        chunks=block,
        dtype="float64",
        compressors=zarr.codecs.Crc32cCodec(),
        fill_value=math.nan,
        attributes={_KEY: contents},
        zarr_format=3,
        chunk_key_encoding={"name": "default", "separator": "/"},
        # zarr leaves out chunks of nothing but its fill value, if it is not told otherwise.
        config={"write_empty_chunks": True},
    )
    if not os.path.lexists(folder) or (os.path.isdir(folder) and _is_bare(folder)):
        return BlockStore(folder, create(folder), contents)
    array, found = _begun(folder, store)
    others = [name for name, content in contents.items() if found.get(name) != content]
    if others:
        raise ValueError(
            f"{store} was begun with {_another(others, contents, found)}; give what it was begun "
            "with, or another store"
        )
    if array.metadata.to_dict() != create({}).metadata.to_dict():
        raise ValueError(_foreign(store))
    for unfinished in Path(folder).rglob("*.partial"):  # SIGKILL met it
        unfinished.unlink(missing_ok=True)
    return BlockStore(folder, array, contents)


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


def _another(names: list[str], contents: dict[str, str], found: dict[str, str]) -> str:
    """Describe differing contents; short ones with the earlier and new value."""
    said = (f"{name} {found.get(name)}, not {contents[name]}" for name in names)
    return " and ".join(
        f"other curves {name}" if name in ("X", "XA", "XB") else text
        for name, text in zip(names, said, strict=True)
    )


def _zarr() -> Any:
    with extra("zarr", "a store needs zarr >= 3.1.3 (Python >= 3.11)"):
        zarr = import_module("zarr")
        if not _renames(zarr.__version__):
            raise ImportError(f"zarr {zarr.__version__} writes chunks in place")
        return zarr


def _renames(version: str) -> bool:
    """Return whether this zarr writes chunks whole or not at all."""
    return tuple(map(int, re.findall(r"\d+", version)[:3])) >= (3, 1, 3)
