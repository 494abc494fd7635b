"""Checks of the environment, made first when the package is imported.

Two environments are refused or reported. In a subinterpreter the compiled module would wait forever
for a lock that belongs to the main interpreter. Arithmetic may also flush subnormal numbers to
zero: any library that was linked with -ffast-math switches this on for the thread that loads it.
"""

from __future__ import annotations

import importlib
import sys
import warnings

__all__ = ["check", "flushes_subnormals"]


def check() -> None:
    """Refuse a subinterpreter; warn of arithmetic without subnormal numbers.

    Raises
    ------
    ImportError
        If this is not the main interpreter of the process.
    """
    if _is_subinterpreter():
        raise ImportError(
            "curvewise does not work in a subinterpreter (neither does numpy, in full); use "
            "threads or processes (in mod_wsgi: WSGIApplicationGroup %{GLOBAL})"
        )
    if flushes_subnormals():
        warnings.warn(
            "this thread's arithmetic flushes numbers below 2.2e-308 to zero, switched on by "
            "another library (built with -ffast-math, probably): values of curves as small as "
            "that have other bits; import curvewise first, or build that library without",
            RuntimeWarning,
            stacklevel=2,
        )


def flushes_subnormals() -> bool:
    """Return whether this thread computes without subnormal numbers."""
    smallest = sys.float_info.min
    return smallest / 2.0 == 0.0 or smallest * 0.5 == 0.0


def _is_subinterpreter() -> bool:
    for name in ("_interpreters", "_xxsubinterpreters"):  # CPython 3.13, and before
        try:
            interpreters = importlib.import_module(name)
        except ImportError:
            continue
        return bool(interpreters.get_current() != interpreters.get_main())
    return False


check()
