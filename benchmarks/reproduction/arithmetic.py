"""The arithmetic of AVX2 for numpy and BLAS, the same on every x86-64 processor that has it.

numpy and OpenBLAS choose loops by the processor: with AVX-512 they add in another order and have
other approximations of exp and log, so that last bits differ. A search compares values, and one
different bit may lead it another way: an evolution found nothing on one processor, and 1.8 % on
another. So the stored results are made, and made again, with what both have. Both libraries read
the environment when they are loaded; so a process begins once more. Compiled measures have the
same bits at every level of instructions.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

__all__ = ["begin_again_held", "environment", "is_held"]

_HELD = {
    "OPENBLAS_CORETYPE": "Haswell",
    "NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL AVX512_SPR",  # numpy 2.4's names of them
}


def environment() -> dict[str, str]:
    """Return the environment, with numpy and BLAS held to AVX2 where the processor has it."""
    return {**os.environ, **(_HELD if _has_avx2() else {})}


def is_held() -> bool:
    """Return whether numpy and BLAS were held to AVX2 when this process began."""
    return _HELD.items() <= os.environ.items()


def begin_again_held() -> None:
    """Begin this process again, held to AVX2, unless it is or the processor has none."""
    if _has_avx2() and not is_held():
        os.execve(sys.executable, sys.orig_argv, environment())


def _has_avx2() -> bool:
    information = Path("/proc/cpuinfo")
    return information.exists() and " avx2 " in information.read_text()
