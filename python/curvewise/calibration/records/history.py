"""The history file: every evaluation of the model, from which an interrupted search resumes.

A CSV file. Its first line, a comment, holds the settings of the search as JSON; then come a header
and one line per evaluation, in the order in which they were finished, numbers as %.17g, which
gives a double back bit for bit. Every line is flushed when it is written, so that a search that is
killed loses the evaluations that were running and no other; half a line at the end is cut off.
Methods that learn more from a simulation than its value have the curves appended as base64. Every
line ends with a checksum of the rest of it (CRC-32, in hexadecimal digits): a damaged file is
refused, and never changes a result. A search that ends adds a comment that says how, for reports;
its tests stand beside the settings.
"""

from __future__ import annotations

import csv
import io
import json
import os
import zlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from .curve_text import curves_of, text_of
from .evaluation import Evaluation, Point

__all__ = ["History", "append_ending", "read_history"]

# A row may hold the curves of several loops: more than csv's default of 128 kB for a cell.
_LARGEST_CELL = 2**31 - 1

_TITLE = "# curvewise identification "
_CHECKSUM = "checksum"
_ENDING = "# ended "
_DETAILS = "report"  # among the settings; what a report needs beside them


class History:
    """Evaluations saved by an earlier run, and the file to which new ones are appended.

    Parameters
    ----------
    path : path-like or None
        None: nothing is read or written.
    settings : mapping
        What must be the same for an evaluation to be used again; JSON can hold it.
    names : tuple of str
        The parameters.
    keep_simulations : bool
        Write curves too; not where a store has them.
    details : mapping
        What a report needs beside the settings; it may change from one version to the next.

    Raises
    ------
    ValueError
        The file is not a history, or one of a search with other settings.
    OSError
        The file cannot be read or written.
    """

    def __init__(
        self,
        path: str | os.PathLike[str] | None,
        settings: Mapping[str, Any],
        names: tuple[str, ...],
        *,
        keep_simulations: bool = True,
        details: Mapping[str, Any] | None = None,
    ) -> None:
        self._keep_simulations = keep_simulations
        self.saved: dict[Point, Evaluation] = {}
        self._file: io.TextIOWrapper | None = None
        if path is None:
            return
        text = json.dumps(settings, default=repr)
        header = ("evaluation", *names, "value", "failed", "seconds", "message", "simulations")
        if not self._load(Path(path), json.loads(text), header):
            title = {**settings, _DETAILS: details}
            title_line = _with_checksum(_TITLE + json.dumps(title, default=repr))
            try:
                with open(path, "w", encoding="utf-8", newline="") as file:
                    file.write(title_line + _line([*header, _CHECKSUM]))
            except OSError as error:
                raise OSError(f"the history {path} cannot be written: {error}") from error
        self._file = open(path, "a", encoding="utf-8", newline="")  # noqa: SIM115 (close() does)

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            # Every line was flushed when it was written; one that could not be has been reported.
            with suppress(OSError):
                self._file.close()

    def write(self, evaluation: Evaluation) -> None:
        """Append an evaluation to the file, at once."""
        if self._file is None:
            return
        row = [
            evaluation.number,
            *(f"{value:.17g}" for value in (*evaluation.point, evaluation.value)),
            int(evaluation.failed),
            f"{evaluation.seconds:.6g}",
            " ".join(evaluation.message.split()),  # on one line
            text_of(evaluation.simulations or ()) if self._keep_simulations else "",
        ]
        try:
            self._file.write(_with_checksum(_line(row).rstrip("\n")))
            self._file.flush()
        except OSError as error:
            raise OSError(
                f"the history {self._file.name} cannot be written: {error}; what it held before "
                "is whole, and a search that is started again goes on from there"
            ) from error

    def _load(self, path: Path, settings: dict[str, Any], header: tuple[str, ...]) -> bool:
        """Read the file; return whether there is anything in it."""
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            return False
        complete = content[: content.rfind(b"\n") + 1]
        if content and not content.startswith(_TITLE.encode()):
            raise ValueError(f"{path} is not a history; give the name of a file to be made")
        lines = complete.decode("utf-8", errors="replace").split("\n")[:-1]
        if len(lines) < 2:  # empty, or killed while it was made
            return False
        title = _checked(lines[0], f"{path}, line 1", "give another file")
        _check_settings(path, json.loads(title.removeprefix(_TITLE)), settings)
        if lines[1] != _line([*header, _CHECKSUM]).rstrip("\n"):
            raise ValueError(f"{path}, line 2 is not the header of a history; give another file")
        csv.field_size_limit(_LARGEST_CELL)
        for number, line in enumerate(lines[2:], 3):
            row = _checked(line, f"{path}, line {number}", "delete the line: it will be run again")
            if row.startswith(_ENDING):
                continue
            evaluation = _parsed(next(csv.reader([row])))
            self.saved[evaluation.point] = evaluation
        if len(complete) < len(content):
            os.truncate(path, len(complete))
        return True


def _line(row: Sequence[Any]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(row)
    return text.getvalue()


def _with_checksum(line: str) -> str:
    return f"{line},{zlib.crc32(line.encode()):08x}\n"


def _checked(line: str, place: str, way_out: str) -> str:
    """Return a line without its checksum, or raise ValueError where that is another's."""
    content, _, checksum = line.rpartition(",")
    if checksum != f"{zlib.crc32(content.encode()):08x}":
        raise ValueError(f"{place} is damaged, by its checksum; {way_out}")
    return content


def _check_settings(path: Path, found: dict[str, Any], wanted: dict[str, Any]) -> None:
    for key in wanted:
        if found.get(key) != wanted[key]:
            raise ValueError(
                f"{path} is the history of another search: its {key} is {found.get(key)!r}, "
                f"not {wanted[key]!r}; give another file"
            )


def _parsed(row: list[str]) -> Evaluation:
    number, *values, failed, seconds, message, simulations = row
    *point, value = map(float, values)
    return Evaluation(
        int(number),
        tuple(point),
        value,
        failed == "1",
        float(seconds),
        message,
        curves_of(simulations) or None,
    )


def append_ending(path: str | os.PathLike[str], ending: str) -> None:
    """Add how a search ended, as JSON, unless that is what the file says already."""
    line = _with_checksum(_ENDING + ending).encode()
    try:
        with open(path, "r+b") as file:
            content = file.read()
            if not content.endswith(b"\n" + line):
                # Half a line is one for which there was no room, when it was written before.
                file.truncate(file.seek(content.rfind(b"\n") + 1))
                file.write(line)
    except OSError as error:
        raise OSError(
            f"the history {path} cannot be written: {error}; the runs that it holds are whole, "
            "and a search that is started again makes none of them again"
        ) from error


def read_history(
    path: str | os.PathLike[str],
) -> tuple[dict[str, Any], dict[str, Any], list[Evaluation], str]:
    """Read what a file holds, to report on it.

    Returns
    -------
    settings, details : dict
        As they were given to `History`.
    evaluations : list of Evaluation
        In the order of the file.
    ending : str
        The last that was added; empty if there is none.

    Raises
    ------
    ValueError
        The file is no history, is damaged, or is from before there were details.
    OSError
        The file cannot be read.
    """
    lines = Path(path).read_text(encoding="utf-8", errors="replace").split("\n")[:-1]
    if len(lines) < 2 or not lines[0].startswith(_TITLE):
        raise ValueError(f"{path} is not a history; give the file that identify(..., history=) has")
    title = _checked(lines[0], f"{path}, line 1", "give another file")
    settings = json.loads(title.removeprefix(_TITLE))
    details = settings.pop(_DETAILS, None)
    if details is None:
        raise ValueError(
            f"{path} was begun by a curvewise that did not write the tests down; search again with "
            "another history (what a store holds is not run again)"
        )
    csv.field_size_limit(_LARGEST_CELL)
    evaluations, ending = [], ""
    for number, line in enumerate(lines[2:], 3):
        row = _checked(line, f"{path}, line {number}", "delete the line")
        if row.startswith(_ENDING):
            ending = row.removeprefix(_ENDING)
        else:
            evaluations.append(_parsed(next(csv.reader([row]))))
    return settings, details, evaluations, ending
