"""Packages that only some of this one needs, imported where they are used and not before."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from textwrap import shorten
from typing import Any

__all__ = ["extra", "foreign_reader", "required"]


@contextmanager
def extra(name: str, needed: str, advice: str = "") -> Iterator[None]:
    """Explain how to install the extra `name` if an import in the block fails.

    The message begins with `needed`, e.g. "a plot needs matplotlib", and ends with `advice`.
    """
    try:
        yield
    except ImportError as error:
        raise ImportError(f'{needed}: pip install "curvewise[{name}]"{advice}') from error


@contextmanager
def foreign_reader(file: str, kind: str, advice: str) -> Iterator[None]:
    """Report a file as damaged if another package's reader fails on it."""
    try:
        yield
    except (ImportError, MemoryError):
        raise
    except Exception as error:
        if isinstance(error, OSError) and error.filename is not None:  # it cannot be opened
            raise
        # Without the advice of pandas, which is for who calls it.
        said = shorten(str(error).partition(", you must")[0], 90, placeholder=" ...")
        raise ValueError(
            f"{file} is damaged, or no {kind} ({type(error).__name__}: {said}); {advice}"
        ) from error


def required(module: str) -> Any:
    """Return a module of the extra `calibration`, or explain its installation."""
    with extra("calibration", f"curvewise.calibration needs {module.partition('.')[0]}"):
        return import_module(module)
