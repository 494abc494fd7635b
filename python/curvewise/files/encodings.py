"""Detects the encoding of a text file from its bytes.

The encodings are UTF-8, UTF-16, GBK, Windows-1252 and Latin-1. GBK differs from Windows-1252 by its
pairs: each run of bytes above 0x7F has an even length, and most pairs are common Chinese characters
(level 1 of GB 2312). Western letters beyond ASCII are isolated, or form other pairs. O(n) time.
"""

from __future__ import annotations

import codecs
import re

__all__ = ["UTF_16", "decoded"]

UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
"""The marks with which a file in UTF-16 begins."""

_HIGH = re.compile(rb"[\x80-\xff]+")
# Pairs of GB 2312, and among them the 3,755 common characters.
_PAIRS = re.compile(rb"(?:[\xa1-\xf7][\xa1-\xfe])+")
_COMMON = (0xB0, 0xD7)


def decoded(data: bytes) -> str:
    """Return the text of a file."""
    if data.startswith(UTF_16):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("gb18030" if _is_gbk(data) else _windows(data), errors="replace")


def _is_gbk(data: bytes) -> bool:
    """Return whether the bytes above ASCII are pairs of GB 2312, and most of them common ones."""
    runs = _HIGH.findall(data)
    if not runs or not all(map(_PAIRS.fullmatch, runs)):
        return False
    pairs = b"".join(runs)[::2]
    return 2 * sum(_COMMON[0] <= first <= _COMMON[1] for first in pairs) > len(pairs)


def _windows(data: bytes) -> str:
    """Return the encoding of Windows, which has dashes and apostrophes, or Latin-1."""
    return "latin-1" if any(byte in data for byte in b"\x81\x8d\x8f\x90\x9d") else "cp1252"
