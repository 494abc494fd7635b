"""A TOML file with the line of every key, and a list of its errors.

tomllib, part of Python from 3.11 on, returns values without their lines. A second pass over the
text, which is valid TOML by then, finds the beginning of each key, each table and each item of an
array. Errors are collected, so that all of them can be fixed at once. Cost: linear in the file.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any, TypeAlias

from .._extras import extra
from ..files.regular_files import check_file

__all__ = ["KeyPath", "Source", "StudyError"]

KeyPath: TypeAlias = tuple["str | int", ...]

_LARGEST = 2**24  # bytes of a study file

_TOKEN = re.compile(
    r'(?P<text>"""(?:\\.|(?!""").)*"{3,5}|\'\'\'(?:(?!\'\'\').)*\'{3,5}'
    r'|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\')'
    r"|(?P<comment>#[^\n]*)|(?P<line>\n)|(?P<sign>[][{}=,.])|(?P<bare>[^\s\[\]{}=,.#\"']+)",
    re.DOTALL,
)


class StudyError(ValueError):
    """A study file has errors; the message lists them with their lines.

    Attributes
    ----------
    problems : tuple of str
        One for each thing that is wrong.
    """

    def __init__(self, problems: list[str]) -> None:
        super().__init__("\n".join(problems))
        self.problems = tuple(problems)


class Source:
    """The content of a TOML file, its place, and its errors.

    Parameters
    ----------
    path : path-like
        The file.

    Attributes
    ----------
    values : dict
        The values that tomllib returns.
    folder : Path
        The folder of the file; relative paths in the file start there.

    Raises
    ------
    StudyError
        If the file is not TOML, or not a regular file of at most 16 MiB.
    OSError
        If it cannot be read.
    ImportError
        If tomli is missing on Python 3.10.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.folder = self.path.parent.resolve()
        self._found: list[tuple[int, str]] = []
        try:
            check_file(self.path, _LARGEST)
        except ValueError as error:
            raise StudyError([str(error)]) from None
        content = self.path.read_bytes()
        try:
            text = content.decode("utf-8-sig").replace("\r\n", "\n")
        except UnicodeDecodeError as error:
            line = content.count(b"\n", 0, error.start) + 1
            raise StudyError([f"{path}, line {line}: not UTF-8; save the file as UTF-8"]) from None
        if sys.version_info >= (3, 11):
            import tomllib
        else:
            with extra("calibration", "a study file needs tomli with Python 3.10"):
                import tomli as tomllib
        try:
            self.values: dict[str, Any] = tomllib.loads(text)
            self._lines = _Locator(text).lines
        except tomllib.TOMLDecodeError as error:
            raise StudyError([_syntax_error(self.path, str(error), text)]) from None
        except ValueError:  # Python's own limit of digits; _refuse_long_numbers sees to the others
            line = _line_of_longest_number(text)
            raise StudyError([f"{path}, line {line}: a number of thousands of digits"]) from None
        except RecursionError:
            line = _line_of_deep_bracket(text)
            raise StudyError([f"{path}, line {line}: too many brackets within brackets"]) from None
        self._refuse_long_numbers((), self.values)
        self.raise_problems()

    def line(self, path: KeyPath) -> int:
        """Return the line of a key, or of the innermost thing around it that has one."""
        while path and path not in self._lines:
            path = path[:-1]
        return self._lines.get(path, 1)

    def problem(self, path: KeyPath, message: str) -> None:
        """Note that something is wrong with a key."""
        line = self.line(path)
        text = f"{dotted(path)} {message}".lstrip().replace("\n", "\\n").replace("\r", "\\r")
        self._found.append((line, f"{self.path}, line {line}: {text}"))

    def _refuse_long_numbers(self, path: KeyPath, value: Any) -> None:
        """Record integers beyond 64 bits, which tomllib reads but TOML forbids."""
        if isinstance(value, dict):
            for key, item in value.items():
                self._refuse_long_numbers((*path, key), item)
        elif isinstance(value, list):
            for i, item in enumerate(value):
                self._refuse_long_numbers((*path, i), item)
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            self.problem(path, "is a whole number beyond 64 bits; write it with a point or an e")

    def resolved(self, value: Any) -> Path:
        """Return a path relative to the file's folder; fill in ~ and variables.

        Raises
        ------
        ValueError
            If it is not a text, or the environment lacks the variable.
        """
        if not isinstance(value, str) or not value.strip():
            raise ValueError(f"is {value!r}; give a path")
        text = os.path.expandvars(os.path.expanduser(value))
        if "\0" in text:
            raise ValueError(f"is {value!r}; no path has a character \\0")
        if missing := re.search(r"\$\{?(\w+)", text):
            raise ValueError(f"is {value!r}, and no variable {missing[1]} is set; set it")
        return self.folder / text

    @property
    def problems(self) -> list[str]:
        """The errors, in the order of their lines."""
        return [text for _, text in sorted(self._found, key=lambda problem: problem[0])]

    def raise_problems(self) -> None:
        """Raise StudyError if there are any."""
        if self.problems:
            raise StudyError(self.problems)


def dotted(path: KeyPath) -> str:
    """Return a path of keys as one would write it, items numbered from 1."""
    text = ""
    for key in path:
        text += f"[{key + 1}]" if isinstance(key, int) else f".{key}" if text else key
    return text


def _syntax_error(path: Path, message: str, text: str) -> str:
    """Return tomllib's message, line first, with its most frequent cause."""
    found = re.search(r"\s*\(at line (\d+), column \d+\)$", message)
    lines = text.split("\n")
    number = int(found[1]) if found else len(lines)
    if found:
        message = message[: found.start()]
    hint = ""
    line = lines[number - 1] if number <= len(lines) else ""
    value = line.partition("=")[2].strip()
    if re.match(r"[A-Za-z_./~$(]", value) and not re.match(r"(true|false)\b", value):
        hint = f'; texts and formulas stand in quotes: "{value}"'
    elif "\\" in line and '"' in line:
        hint = "; a path with \\ stands in single quotes: '...'"
    elif re.search(r"(?<!\d)\.\d|\d\.(?!\d)", value):
        hint = "; a number has digits on both sides of its point: 0.5, 1.0e5"
    elif re.search(r"\d,\d", value) and "[" not in value:
        hint = "; numbers have a decimal point"
    return f"{path}, line {number}: {message}{hint}"


def _line_of_longest_number(text: str) -> int:
    longest = max(re.finditer(r"[0-9_]+", text), key=lambda match: match.end() - match.start())
    return text.count("\n", 0, longest.start()) + 1


def _line_of_deep_bracket(text: str) -> int:
    depth, deep = 0, 50  # no study has that many; Python's own limit is some hundreds
    for token, line in _tokens(text):
        depth += (token in "[{") - (token in "]}")
        if depth > deep:
            return line
    return 1


class _Locator:
    """The lines of all keys of a text that is valid TOML."""

    def __init__(self, text: str) -> None:
        self.lines: dict[KeyPath, int] = {}
        self._last_items: dict[KeyPath, int] = {}  # of the arrays of tables
        self._tokens = [*_tokens(text), ("", 0)][::-1]  # the next one is the last of them
        table: KeyPath = ()
        while line := self._next_line():
            if self._take("["):
                table = self._header(line)
            else:
                self._assignment(table)

    def _header(self, line: int) -> KeyPath:
        """Return the path of a table, in the last item of every array of tables on its way."""
        is_array = self._take("[")
        *outer, name = self._names()
        path: KeyPath = ()
        for outer_name in outer:
            path = (*path, outer_name)
            if path in self._last_items:
                path = (*path, self._last_items[path])
        path = (*path, name)
        if is_array:
            self.lines.setdefault(path, line)
            self._last_items[path] = self._last_items.get(path, -1) + 1
            path = (*path, self._last_items[path])
        self.lines.setdefault(path, line)
        while self._take("]"):
            pass
        return path

    def _assignment(self, path: KeyPath) -> None:
        line = self._next_line()
        for name in self._names():
            path = (*path, name)
            self.lines.setdefault(path, line)
        self._take("=")
        self._value(path)

    def _names(self) -> list[str]:
        names = [_unquoted(self._tokens.pop()[0])]
        while self._take("."):
            names.append(_unquoted(self._tokens.pop()[0]))
        return names

    def _value(self, path: KeyPath) -> None:
        if self._take("["):
            for item in self._items("]"):
                self.lines.setdefault((*path, item), self._next_line())
                self._value((*path, item))
        elif self._take("{"):
            for _ in self._items("}"):
                self._assignment(path)
        else:  # a date or a number may be several tokens
            while self._tokens[-1][0] not in "\n,]}":
                self._tokens.pop()

    def _items(self, closing: str) -> Iterator[int]:
        """Count the items between brackets; each is read before the next."""
        for item in count():
            if not self._next_line() or self._take(closing):
                return
            yield item
            self._next_line()
            self._take(",")

    def _next_line(self) -> int:
        """Return the line of what comes after any line breaks; 0 at the end."""
        while self._take("\n"):
            pass
        return self._tokens[-1][1]

    def _take(self, token: str) -> bool:
        """Go past a token, and return whether it is the next one."""
        is_next = self._tokens[-1][0] == token
        if is_next:
            self._tokens.pop()
        return is_next


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    """Yield what a text consists of, without blanks and comments, with its line."""
    line = 1
    for match in _TOKEN.finditer(text):
        if match.lastgroup != "comment":
            yield match[0], line
        line += match[0].count("\n")


def _unquoted(name: str) -> str:
    return name[1:-1] if name[0] in "\"'" else name
