"""CalculiX's .dat: what ``*NODE PRINT`` and ``*EL PRINT`` have the solver write.

A table begins with a line such as " forces (fx,fy,fz) for set PULLED and time 0.5000000E+00" (in
CalculiX 2.20 sometimes without the space before "for"). Rows of node, or element and integration
point, and values follow. A total has values alone. Cost: linear in the file.
"""

from __future__ import annotations

import os
import re

from .solver_output import Row, SolverOutput, as_number, as_whole, lines_of

__all__ = ["read_calculix_dat"]

_TITLE = re.compile(r"\s*(.*?)\s*(?:\(([^)]*)\))?\s*for set (\S+) and time\s+(\S+)")
# Words in a title's brackets that number a row and are not components.
_LABELS = ("elem", "integ.pnt.", "node")


def read_calculix_dat(path: str | os.PathLike[str]) -> SolverOutput:
    """Read the .dat of CalculiX.

    Parameters
    ----------
    path : path-like
        The file, "deck.dat" for a deck "deck.inp".

    Returns
    -------
    SolverOutput
        Variables are called as in the file ("displacements", "total force", "stresses"), and so
        are components (vx, fx, sxx); a total volume or energy has the component "value".

    Raises
    ------
    ValueError
        A row is not made of numbers; the message has its line.
    OSError
        The file cannot be read.

    Notes
    -----
    Linear in the size of the file. Of two requests for the same variable of the same set the
    first counts. Eigenvalues, and what CalculiX prints of contact, are left out.

    Examples
    --------
    As for :class:`SolverOutput`.
    """
    output = SolverOutput(path)
    rows: dict[Row, list[float]] | None = None
    labels = 0
    count = 0
    for place, line in lines_of(path):
        words = line.split()
        if not words:
            continue
        if title := _TITLE.match(line):
            names = [name.strip() for name in (title[2] or "").split(",") if name.strip()]
            components = [name for name in names if name not in _LABELS] or ["value"]
            is_total = title[1].startswith("total")
            labels = 0 if is_total else 2 if "elem" in names else 1
            count = len(components)
            time = as_number(title[4], place)
            rows = output.add(title[1], title[3], components, time)
        elif rows is not None and len(words) == labels + count:
            label = [as_whole(word, place) for word in words[:labels]]
            values = [as_number(word, place) for word in words[labels:]]
            rows.setdefault(Row(*(label or [0])), values)
        else:
            rows = None
    return output
