"""How far a long call is: a bar, or a function of the caller's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeAlias

__all__ = ["Progress", "Report", "reporting"]

Report: TypeAlias = Callable[[int, int], object]
Progress: TypeAlias = bool | Report


@contextmanager
def reporting(progress: Progress) -> Iterator[Report | None]:
    """Yield the function to call with (done, total), or None; show a bar for True.

    Raises
    ------
    ImportError
        A bar is asked for and tqdm is not installed.
    """
    if callable(progress):
        yield progress
    elif progress:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError(
                'progress=True needs tqdm: pip install "curvewise[progress]", '
                "or give a function of (done, total)"
            ) from error
        with tqdm(unit="step", unit_scale=True) as bar:

            def report(done: int, total: int) -> None:
                bar.total = total
                bar.update(done - bar.n)

            yield report
    else:
        yield None
