"""Distances on disk, block by block: a zarr array that says what it is of.

zarr writes a chunk under another name and then renames it (``LocalStore`` from 3.1.3 on), so that a
chunk's file is there if and only if it is whole: what is there after SIGKILL is the record of what
was done, and no other is kept. The chunks are not compressed, since digits of distances are hardly
ever alike. Only a crash of the whole machine may leave a chunk without its content: nothing waits
for the disk.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any

from .._extras import extra
from ..curves.inputs import Array
from .pieces import Delayed, HighLevelGraph, dask_array, tokenize

__all__ = ["BlockStore", "Place", "begin_store"]

Place = tuple[int, ...]

_KEY = "curvewise"  # of what a store is of, among the attributes of its array


@dataclass(frozen=True)
class BlockStore:
    """A zarr array in a folder, of which every chunk is a block of distances.

    Attributes
    ----------
    folder : str
        Where it is; a cluster's workers must see the same folder.
    shape : tuple of int
        That of the array.
    block : tuple of int
        That of its blocks, except for the last ones.
    """

    folder: str
    shape: tuple[int, ...]
    block: tuple[int, ...]

    def places(self) -> Iterator[Place]:
        """Return the places of all blocks."""
        counts = (math.ceil(k / size) for k, size in zip(self.shape, self.block, strict=True))
        return product(*map(range, counts))

    def holds(self, place: Place) -> bool:
        """Say whether a block is there, and so whole."""
        return Path(self.folder, "c", *map(str, place)).is_file()

    def write(self, place: Place, values: Array) -> None:
        """Write a block."""
        begins = [i * size for i, size in zip(place, self.block, strict=True)]
        where = tuple(slice(i, i + k) for i, k in zip(begins, values.shape, strict=True))
        # zarr leaves out chunks of nothing but its fill value, if it is not told otherwise.
        array = _zarr().open_array(self.folder, mode="r+", config={"write_empty_chunks": True})
        array[where] = values

    def filled(self, lazy: dask_array.Array) -> dask_array.Array:
        """Compute the blocks that are not there; return the array, read where it is used."""
        name = f"write-{tokenize(lazy.name, self)}"
        graph: dict[Any, Any] = {
            (name, *place): (partial(self.write, place), (lazy.name, *place))
            for place in self.places()
            if not self.holds(place)
        }
        graph[name] = (len, list(graph))
        # dask's own types do not fit together here, or are not there.
        collections: Any = [lazy]
        delayed: Callable[..., Any] = Delayed
        delayed(name, HighLevelGraph.from_collections(name, graph, collections)).compute()
        read: Callable[[str], dask_array.Array] = dask_array.from_zarr
        return read(self.folder)


def begin_store(
    store: str | os.PathLike[str],
    shape: tuple[int, ...],
    block: tuple[int, ...],
    contents: dict[str, str],
) -> BlockStore:
    """Return a store that is new, or was begun for the same contents and stopped.

    Raises
    ------
    ValueError
        It was begun for others, or holds something else.
    ImportError
        There is no zarr.
    """
    zarr = _zarr()
    begun = BlockStore(os.path.abspath(store), shape, block)
    contents = contents | {"block": repr(block)}
    found = _contents_of(begun.folder, store)
    if found is None:
        zarr.create_array(
            begun.folder,
            shape=shape,
            chunks=block,
            dtype="float64",
            compressors=None,
            fill_value=math.nan,
            attributes={_KEY: contents},
            zarr_format=3,
            chunk_key_encoding={"name": "default", "separator": "/"},
        )
        return begun
    others = [name for name, content in contents.items() if found.get(name) != content]
    if others:
        raise ValueError(
            f"{store} was begun with {_another(others, contents, found)}; give what it was begun "
            "with, or another store"
        )
    for unfinished in Path(begun.folder).rglob("*.partial"):  # SIGKILL met it
        unfinished.unlink(missing_ok=True)
    return begun


def _contents_of(folder: str, store: str | os.PathLike[str]) -> dict[str, str] | None:
    """Return what a store was begun for; None where there is none yet."""
    if not os.path.lexists(folder) or (os.path.isdir(folder) and _is_bare(folder)):
        return None
    try:
        attributes = _zarr().open_array(folder, mode="r").attrs
        return dict(attributes[_KEY])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ValueError(
            f"{store} is there and holds no distances that curvewise.dask began; give another store"
        ) from error


def _is_bare(folder: str) -> bool:
    """Say whether a folder is empty, but for what was to be a new store's description."""
    return all(name.endswith(".partial") for name in os.listdir(folder))


def _another(names: list[str], contents: dict[str, str], found: dict[str, str]) -> str:
    """Say what is another than it was, of short contents with what was given then and now."""
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
    """Say whether this zarr writes chunks whole or not at all."""
    return tuple(map(int, re.findall(r"\d+", version)[:3])) >= (3, 1, 3)
