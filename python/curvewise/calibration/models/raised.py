"""The message of an exception, with the user's line that raised it."""

from __future__ import annotations

import sysconfig
import traceback
from pathlib import Path

__all__ = ["named_with_place"]

_PACKAGE = str(Path(__file__).parents[2])
_INSTALLED = (
    "<frozen",
    *(sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")),
)


def named_with_place(error: BaseException) -> str:
    """Return an exception's type, its message, and its place: file, line and function.

    The place is the innermost line of the user's own code, or else the innermost line outside this
    package. The place is omitted if only this package is involved.
    """
    places = [
        (frame.f_code.co_filename, line, frame.f_code.co_name)
        for frame, line in traceback.walk_tb(error.__traceback__)
        if not frame.f_code.co_filename.startswith(_PACKAGE)
    ]
    own = [place for place in places if not place[0].startswith(_INSTALLED)]
    where = ""
    if places:
        file, line, function = (own or places)[-1]
        where = f" ({file}, line {line}, in {function})"
    return f"{type(error).__name__}: {error}{where}"
