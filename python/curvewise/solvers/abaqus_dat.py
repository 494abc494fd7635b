"""Abaqus' .dat: what ``*NODE PRINT`` and ``*EL PRINT`` have the solver write.

Every increment has a summary with its time, then tables under "THE FOLLOWING TABLE IS PRINTED FOR
...", which name their set or type of element, with a head of columns (NODE FOOT- U1 RF1, or
ELEMENT PT FOOT- S11) and a row for each node or integration point. The deck's echo at the top has
similar lines for later tables ("... AT EVERY 1 INCREMENT"), which are skipped. Written from Abaqus'
documentation and public listings, and tested on hand-written samples, because Abaqus is not
available for development. Cost: linear in the file.
"""

from __future__ import annotations

import os
import re

from .solver_output import Row, SolverOutput, as_number, as_whole, lines_of

__all__ = ["read_abaqus_dat"]

_TIME = re.compile(r"TOTAL TIME COMPLETED\s+([-+.\dE]+)")
_TABLE = re.compile(r"THE FOLLOWING TABLE IS PRINTED (?!.*AT EVERY)")
_SET = re.compile(r"(?:NODE|ELEMENT) SET\s+(\S+)")
_TYPE = re.compile(r"(?:WITH TYPE|ELEMENT TYPE)\s+(\S+)")


def read_abaqus_dat(path: str | os.PathLike[str]) -> SolverOutput:
    r"""Read the tables that Abaqus prints to its .dat.

    Parameters
    ----------
    path : path-like
        The file, "deck.dat" for ``abaqus job=deck``.

    Returns
    -------
    SolverOutput
        The variable is "nodes", or "elements", or "elements C3D8" if the file states their type;
        components have their Abaqus names (U1, RF2, S11).

    Raises
    ------
    ValueError
        If a row does not consist of numbers; the message has its line.
    OSError
        If the file cannot be read.

    Notes
    -----
    Linear in the size of the file. A table that is split because it has too many columns remains
    several tables, distinguished by their columns. Times are the total times.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.solvers import read_abaqus_dat
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "deck.dat")
    ...     _ = path.write_text(
    ...         " STEP TIME COMPLETED  0.1  ,  TOTAL TIME COMPLETED  0.1\n"
    ...         " THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TOP\n\n"
    ...         "       NODE FOOT-   U2          RF2\n            NOTE\n\n"
    ...         "          3       1.0000E-02   120.5\n          4       1.0000E-02   119.5\n\n"
    ...     )
    ...     read_abaqus_dat(path).history("RF2", set_name="TOP", combine="sum")
    array([240.])
    """
    output = SolverOutput(path)
    time, title = 0.0, ""
    reader: _Rows | None = None
    for place, line in lines_of(path):
        words = line.split()
        if found := _TIME.search(line):
            time = as_number(found[1], place)
        if _TABLE.search(line):
            title, reader = line, None
        elif title and words and words[0] in ("NODE", "ELEMENT") and "FOOT-" in words:
            reader = _Rows(output, title, words, time)
        elif reader is None and title and words:
            title += line  # a title of two lines
        elif reader is not None and words and words[0].isdigit():
            reader.add(words, place)
        elif reader is not None and reader.has_rows:
            title, reader = "", None
    return output


class _Rows:
    """A table that is being read."""

    def __init__(self, output: SolverOutput, title: str, head: list[str], time: float) -> None:
        kind = "nodes" if head[0] == "NODE" else "elements"
        if (type_ := _TYPE.search(title)) is not None:
            kind = f"{kind} {type_[1]}"
        set_name = _SET.search(title)
        self._columns = head[head.index("FOOT-") + 1 :]
        self._labels = head.index("FOOT-")
        name = set_name[1].rstrip(".") if set_name else ""
        self._rows = output.add(kind, name, self._columns, time)
        self.has_rows = False

    def add(self, words: list[str], place: str) -> None:
        """Add a row: numbers of node, or element and point, perhaps a footnote, and the values."""
        self.has_rows = True
        count = len(self._columns)
        if len(words) < self._labels + count:
            raise ValueError(
                f"{place}: {len(words)} words for {self._labels + count} columns; was the run cut "
                "short?"
            )
        label = [as_whole(word, place) for word in words[: self._labels]]
        values = [as_number(word, place) for word in words[-count:]]
        self._rows.setdefault(Row(*label[:2]), values)
