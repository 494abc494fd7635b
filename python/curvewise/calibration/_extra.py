"""Packages that only calibration needs, imported where they are used and not before."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .._extras import extra

__all__ = ["required"]


def required(module: str) -> Any:
    """Return a module of the extra `calibration`, or say how to install it."""
    with extra("calibration", f"curvewise.calibration needs {module.partition('.')[0]}"):
        return import_module(module)
