"""Progress of a long call: a bar, or a user-defined function."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeAlias

from ._extras import extra

__all__ = ["Report", "reporting"]

Report: TypeAlias = Callable[[int, int], object]
"""What is called with (done, total)."""


@contextmanager
def reporting(progress: bool | Report) -> Iterator[Report | None]:
    """Yield the function to call with (done, total), or None; show a bar for True.

    Raises
    ------
    ImportError
        If a bar is requested and tqdm is missing.
    """
    if callable(progress):
        yield progress
    elif progress:
        with extra("progress", "progress=True needs tqdm", ", or give a function of (done, total)"):
            from tqdm import tqdm
        with tqdm(unit="step", unit_scale=True) as bar:

            def report(done: int, total: int) -> None:
                bar.total = total
                bar.update(done - bar.n)

            yield report
    else:
        yield None
