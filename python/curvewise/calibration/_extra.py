"""Packages that only calibration needs, imported where they are used and not before."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["required"]


def required(module: str) -> Any:
    """Return a module of the extra `calibration`, or say how to install it."""
    try:
        return import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        raise ImportError(
            f'curvewise.calibration needs {package}: pip install "curvewise[calibration]"'
        ) from error
