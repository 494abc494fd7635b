"""Where an installed curvewise keeps what a C++, C or Fortran project builds against.

The wheel carries the headers and a static library, together with the files by which CMake and
pkg-config find them; docs/embedding.md shows their use.
"""

from __future__ import annotations

import errno
from pathlib import Path

from . import _core

__all__ = ["get_cmake_dir", "get_include"]


def get_include() -> str:
    """Return the folder to be given to a compiler with ``-I``.

    Returns
    -------
    str
        An absolute path; ``curvewise/curvewise.hpp`` (C++), ``curvewise/curvewise.h`` (C) and
        ``curvewise/curvewise.f90`` (Fortran, to be compiled) lie in it.

    Raises
    ------
    FileNotFoundError
        This is not an installed package, e.g. a source tree with a module copied into it.

    Notes
    -----
    ``python -m curvewise --includes`` prints it as a flag.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.get_include()  # doctest: +SKIP
    '/usr/lib/python3/site-packages/curvewise/include'
    """
    return _installed("include", holds="curvewise/curvewise.hpp")


def get_cmake_dir() -> str:
    """Return the folder for CMake's ``curvewise_DIR``.

    Returns
    -------
    str
        An absolute path; ``curvewiseConfig.cmake`` lies in it.

    Raises
    ------
    FileNotFoundError
        As for :func:`get_include`.

    Notes
    -----
    ``python -m curvewise --cmakedir`` prints it.

    Examples
    --------
    >>> from curvewise.embedding import get_cmake_dir
    >>> get_cmake_dir()  # doctest: +SKIP
    '/usr/lib/python3/site-packages/curvewise/lib/cmake/curvewise'
    """
    return _installed("lib/cmake/curvewise", holds="curvewiseConfig.cmake")


def _installed(folder: str, holds: str) -> str:
    # Beside the compiled module, also where an editable install has the Python files elsewhere.
    path = Path(_core.__file__).resolve().parent / folder
    if not (path / holds).is_file():
        raise FileNotFoundError(
            errno.ENOENT, "not found: curvewise is not installed here; pip install it", str(path)
        )
    return str(path)
