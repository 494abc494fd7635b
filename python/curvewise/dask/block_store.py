"""Blocks of distances on disk: the chunks of a zarr array, each with a checksum.

zarr writes a chunk under another name and then renames it (``LocalStore`` from 3.1.3 on), so that
SIGKILL leaves either the whole file of a chunk or no file. The package does not wait for the disk:
a crash of the whole machine may leave a chunk without its content. Each chunk therefore ends in a
checksum, which zarr's codec crc32c writes and checks. The codec does not know a chunk's place. A
file in ``checksums`` therefore ties the checksum to the block's place, curves and settings. It is
written after the chunk, and a chunk without it is unfinished. The file also states the number of
distances, because a block at the edge of a matrix that grows has only a part of them.
"""

from __future__ import annotations

import hashlib
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ..curves.inputs import Array

__all__ = ["Block", "BlockStore", "Place"]

Place = tuple[int, ...]

_CHECKSUM = 4  # bytes of crc32c, at the end of a chunk


class DamageError(ValueError):
    """The fault of a block."""


class Block(NamedTuple):
    """A block, or the part of it that is stored.

    Attributes
    ----------
    place : tuple of int
        Its place among the blocks.
    shape : tuple of int
        The number of distances along each side, from the first.
    tie : str
        The digest of the curves and settings with which its distances are computed.
    """

    place: Place
    shape: tuple[int, ...]
    tie: str


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
    """

    folder: str
    array: Any

    def stored_shape(self, place: Place, whole: tuple[int, ...]) -> tuple[int, ...] | None:
        """Return how many distances of a block were written; `whole` if that is not readable."""
        record = self._record(place)
        if not record.is_file():
            return None
        try:
            *counts, _ = record.read_text(encoding="ascii").split()
            shape = tuple(map(int, counts))
        except ValueError:
            return whole
        pairs = zip(shape, whole, strict=False)
        fits = len(shape) == len(whole) and all(0 < a <= b for a, b in pairs)
        return shape if fits else whole

    def write(self, block: Block, values: Array) -> None:
        """Write a block, and then what ties it to its place."""
        record = self._record(block.place)
        record.unlink(missing_ok=True)  # of the part that was stored
        self.array[self._slices(block.place)] = values
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_bytes(self._seal(block))

    def read(self, block: Block) -> Array:
        """Read a block.

        Raises
        ------
        ValueError
            If the block is damaged.
        """
        try:
            return self._checked(block)
        except DamageError as error:
            raise ValueError(
                f"{self.folder}: block {block.place} is damaged: {error}; call cdist or pdist with "
                "this store again to compute it"
            ) from error

    def damage(self, block: Block) -> str | None:
        """Return the damage of a block that was written, if any."""
        try:
            self._checked(block)
        except DamageError as error:
            return str(error)
        return None

    def _checked(self, block: Block) -> Array:
        """Read a block; raise DamageError if it is not the one that was written."""
        chunk = self._chunk(block.place)
        if not chunk.is_file():
            raise DamageError("it is missing")
        item = self.array.dtype.itemsize
        found, size = chunk.stat().st_size, item * math.prod(self.array.chunks) + _CHECKSUM
        if found != size:
            raise DamageError(f"it has {found} bytes instead of {size}")
        try:
            values: Array = self.array[self._slices(block.place)]
        except ValueError as error:
            raise DamageError("its content has changed") from error
        if self._record(block.place).read_bytes() != self._seal(block):
            raise DamageError("it is not the block that was written here")
        return values[tuple(slice(count) for count in block.shape)]

    def _slices(self, place: Place) -> tuple[slice, ...]:
        pairs = zip(place, self.array.chunks, strict=True)
        return tuple(slice(i * size, (i + 1) * size) for i, size in pairs)

    def _chunk(self, place: Place) -> Path:
        return Path(self.folder, "c", *map(str, place))

    def _record(self, place: Place) -> Path:
        return Path(self.folder, "checksums", *map(str, place))

    def _seal(self, block: Block) -> bytes:
        """Return what ties the checksum in a chunk to a block, with the number of its distances."""
        with self._chunk(block.place).open("rb") as file:
            file.seek(-_CHECKSUM, os.SEEK_END)
            tied = hashlib.sha256(repr((block, file.read())).encode()).hexdigest()
        return " ".join([*map(str, block.shape), tied]).encode()
