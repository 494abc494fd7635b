"""Packages that only some of this one needs, imported where they are used and not before."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["extra"]


@contextmanager
def extra(name: str, needed: str, advice: str = "") -> Iterator[None]:
    """Say how to install the extra `name` where an import inside the block fails.

    `needed` begins the message, e.g. "a picture needs matplotlib", and `advice` ends it.
    """
    try:
        yield
    except ImportError as error:
        raise ImportError(f'{needed}: pip install "curvewise[{name}]"{advice}') from error
