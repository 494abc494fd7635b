"""Printed tables and plots of a comparison."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

from .._extras import extra
from ..comparing.comparison import Comparison

__all__ = ["failures_unlogged", "print_table", "require_matplotlib", "write_picture"]


def print_table(comparison: Comparison, names: list[str], columns: list[str]) -> None:
    """Print the files, the values, and the deviations."""
    curves = comparison.P, comparison.Q
    for letter, name, curve, of in zip("PQ", names, curves, columns, strict=True):
        print(f"{letter}  {name}, {len(curve)} points{of}")
    print(f"preset {comparison.preset}\n\n{comparison}\n\ndeviation, in units of y")
    width = max(map(len, comparison.values))
    for name, deviation in comparison.deviations.items():
        print(f"{name:<{width}}  {deviation}")


@contextmanager
def failures_unlogged() -> Iterator[None]:
    """Keep runs of a material that fail off standard error: the result counts them."""
    log = logging.getLogger("curvewise.calibration")
    level = log.level
    log.setLevel(logging.ERROR)
    try:
        yield
    finally:
        log.setLevel(level)


def require_matplotlib() -> None:
    """Fail before the work rather than after it."""
    with extra("plot", "a picture needs matplotlib"):
        import_module("matplotlib.figure")


def write_picture(comparison: Comparison, file: str) -> None:
    """Write the plot of a comparison, in the format of the file's suffix, or PNG."""
    # With the format given, matplotlib does not append ".png" to a name without an ending.
    comparison.plot().savefig(file, format=Path(file).suffix[1:] or "png")
