"""Workbooks in Strict Open XML (ISO/IEC 29500 Strict) for openpyxl.

In the parts that are read, strict and transitional workbooks differ only in the names of their XML
namespaces. A strict workbook is copied in memory with the transitional names. Cost: linear in its
parts.
"""

from __future__ import annotations

import io
import re
import zipfile

__all__ = ["transitional"]

_STRICT = b"http://purl.oclc.org/ooxml/"
_BOOK = "xl/workbook.xml"
_NAMES = re.compile(rb"http://purl\.oclc\.org/ooxml/(\w+)/?")
_HEADS = {
    b"officeDocument": b"http://schemas.openxmlformats.org/officeDocument/2006/",
    b"spreadsheetml": b"http://schemas.openxmlformats.org/spreadsheetml/2006/",
    b"drawingml": b"http://schemas.openxmlformats.org/drawingml/2006/",
}


def transitional(file: str) -> str | io.BytesIO:
    """Return a workbook; a strict one as a copy with transitional names."""
    try:
        with zipfile.ZipFile(file) as parts:
            if _BOOK not in parts.namelist() or _STRICT not in parts.read(_BOOK):
                return file
            copy = io.BytesIO()
            with zipfile.ZipFile(copy, "w") as written:
                for name in parts.namelist():
                    content = parts.read(name)
                    if name.endswith((".xml", ".rels")):
                        content = _NAMES.sub(_transitional_name, content)
                    written.writestr(name, content)
    except zipfile.BadZipFile:  # of another kind, or damaged; its reader says so
        return file
    copy.seek(0)
    return copy


def _transitional_name(found: re.Match[bytes]) -> bytes:
    return _HEADS.get(found[1], found[0])
