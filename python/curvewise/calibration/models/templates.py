"""Decks with placeholders, and the values that replace these.

Placeholders are written as in LS-OPT, ``<<E>>``. Solvers give ``$``, ``{}``, ``%``, ``&``, ``*``
and ``#`` a meaning, but not one to two angle brackets. A template is read once, as bytes that are
cut at its placeholders, in linear time. Filling it in takes linear time, too.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

__all__ = ["Template", "check_names", "placeholder_spans", "read_templates"]

_NAME = re.compile(r"[A-Za-z_]\w*")
_WIDTH = re.compile(r"(?:.?[<>=^])?[-+ ]?z?#?0?(\d+)")


class _Placeholder(NamedTuple):
    """One ``<<name:format>>`` of a template."""

    name: str
    format: str
    place: str


class Template(NamedTuple):
    """A file to fill in, cut at its placeholders: one text more than there are placeholders."""

    name: str
    texts: list[str]
    placeholders: list[_Placeholder]

    def fill(self, parameters: Mapping[str, float | str]) -> bytes:
        """Return the file with values instead of its placeholders."""
        parts = self.texts[:1]
        for placeholder, text in zip(self.placeholders, self.texts[1:], strict=True):
            try:
                parts.append(_format(parameters[placeholder.name], placeholder.format))
            except ValueError as error:
                raise ValueError(f"{placeholder.place}: {error}") from None
            parts.append(text)
        return "".join(parts).encode("utf-8", "surrogateescape")


def read_templates(
    files: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], log: str
) -> list[Template]:
    """Read the files; their names must differ from each other and from that of the log."""
    paths = [Path(files)] if isinstance(files, (str, os.PathLike)) else [Path(f) for f in files]
    names = [path.name for path in paths]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"two templates are called {name}; rename one")
        if name == log:
            raise ValueError(f"a template is called {log}, as the log is; rename it")
    for path in paths:
        if not path.is_file():
            raise FileNotFoundError(f"the template {os.fspath(path)!r} does not exist")
    return [_parse(path) for path in paths]


def _parse(path: Path) -> Template:
    # Bytes rather than text, as line ends and what other encodings a deck's comments have stay.
    whole = path.read_bytes().decode("utf-8", "surrogateescape")
    texts, placeholders, end, line = [], [], 0, 1
    for begin, past in placeholder_spans(whole):
        texts.append(whole[end:begin])
        line += texts[-1].count("\n")
        place = f"{path.name}, line {line}: {whole[begin:past]}"
        name, _, spec = whole[begin + 2 : past - 2].partition(":")
        if not _NAME.fullmatch(name.strip()):
            raise ValueError(f"{place} is malformed; write <<name>> or <<name:10.4g>>")
        placeholders.append(_Placeholder(name.strip(), spec.strip(), place))
        end = past
    return Template(path.name, [*texts, whole[end:]], placeholders)


def placeholder_spans(text: str) -> Iterator[tuple[int, int]]:
    """Yield where each "<<" with the next ">>" of its line begins and ends, in linear time."""
    begin = text.find("<<")
    while begin >= 0:
        close = text.find(">>", begin + 2)
        if close < 0:
            return
        line_end = text.find("\n", begin, close)
        if line_end < 0:
            yield begin, close + 2
            line_end = close + 2
        begin = text.find("<<", line_end)


def check_names(templates: Sequence[Template], parameters: Sequence[str]) -> None:
    """Hold the placeholders against the parameters, and try every format."""
    used = set()
    for placeholder in (p for template in templates for p in template.placeholders):
        used.add(placeholder.name)
        if placeholder.name not in parameters:
            raise ValueError(
                f"{placeholder.place} is not a parameter; they are {', '.join(parameters)}"
            )
        try:
            format(1.0, placeholder.format)
        except ValueError:
            raise ValueError(
                f"{placeholder.place} has no format of a number; write e.g. <<name:10.4g>>"
            ) from None
    for name in parameters:
        if name not in used:
            raise ValueError(f"no template has a placeholder <<{name}>>; add it or drop {name}")


def _format(value: float | str, spec: str) -> str:
    if isinstance(value, str):
        return format(value, spec)
    if not spec:
        return repr(float(value))  # of a numpy float, repr would show the type
    if spec.isdecimal():
        return _fit(float(value), int(spec))
    text = format(float(value), spec)
    width = _WIDTH.match(spec)
    if width and len(text) > int(width.group(1)):
        raise ValueError(f"{text} is longer than the field; choose another format or bounds")
    return text


def _fit(value: float, width: int) -> str:
    for digits in range(17, 0, -1):
        text = f"{value:#.{digits}g}"
        if len(text) <= width:
            return text.rjust(width)
    raise ValueError(f"{value!r} does not fit; widen the field or narrow the bounds")
