"""Build information, and the files for C++, C or Fortran projects.

The wheel carries the headers and a static library, with the files that CMake and pkg-config need to
find them; docs/embedding.md shows their use.
"""

from __future__ import annotations

import errno
from pathlib import Path
from typing import TYPE_CHECKING

from ._core import __file__ as compiled_file
from ._core import build_info as compiled_build_info
from ._names import names_alone

if TYPE_CHECKING:
    from ._core import BuildInfo

__all__ = ["build_info", "get_cmake_dir", "get_include"]
__dir__ = names_alone(__all__)


def build_info() -> BuildInfo:
    """Return how the compiled library was built, and what this machine uses.

    Returns
    -------
    dict
        "version", "compiler", "eigen", "pybind11", "instruction_sets" (those this machine has, the
        slowest first) and "active" (the one in use).

    Examples
    --------
    >>> from curvewise.installation import build_info
    >>> build_info()["active"] in build_info()["instruction_sets"]
    True
    """
    return compiled_build_info()


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
        If this is not an installed package, e.g. a source tree with a module copied into it.

    Notes
    -----
    ``python -m curvewise --includes`` prints it as a flag.

    Examples
    --------
    >>> from curvewise.installation import get_include
    >>> get_include()  # doctest: +SKIP
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
    >>> from curvewise.installation import get_cmake_dir
    >>> get_cmake_dir()  # doctest: +SKIP
    '/usr/lib/python3/site-packages/curvewise/lib/cmake/curvewise'
    """
    return _installed("lib/cmake/curvewise", holds="curvewiseConfig.cmake")


def _installed(folder: str, holds: str) -> str:
    # Search next to the compiled module: an editable install has the Python files elsewhere.
    path = Path(compiled_file).resolve().parent / folder
    if not (path / holds).is_file():
        raise FileNotFoundError(
            errno.ENOENT, "not found: curvewise is not installed here; pip install it", str(path)
        )
    return str(path)
