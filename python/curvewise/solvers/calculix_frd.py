"""CalculiX's .frd: what ``*NODE FILE`` and ``*EL FILE`` have the solver write, as text.

Records have fixed columns and are distinguished by their first number. The record 100C begins the
results of a time, -4 names a variable, and -5 a component. The record -1 is a node with up to six
values of 12 columns, -2 continues with more values, and -3 ends a block. See the CalculiX GraphiX
manual, "Result Format". Nodes and elements of the mesh are skipped. Cost: linear in the file.
"""

from __future__ import annotations

import os

from .solver_output import Row, SolverOutput, as_number, as_whole, lines_of

__all__ = ["read_calculix_frd"]

_WIDTH = 12
_FORMAT = 70  # where a line 100C says how the values are written
_BINARY = ("2", "3")


def read_calculix_frd(path: str | os.PathLike[str]) -> SolverOutput:
    r"""Read the .frd of CalculiX, written as text.

    Parameters
    ----------
    path : path-like
        The file, "deck.frd" for a deck "deck.inp".

    Returns
    -------
    SolverOutput
        Variables and components have their names in the file: DISP (D1, D2, D3), FORC (F1, ...),
        STRESS (SXX, ...), PE. The file lacks sets: give the node.

    Raises
    ------
    ValueError
        If the file is binary, or a row does not consist of numbers.
    OSError
        If the file cannot be read.

    Notes
    -----
    Linear in the size of the file. It has six digits instead of the seven of .dat, and values of
    elements are extrapolated to the nodes.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.solvers import read_calculix_frd
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "deck.frd")
    ...     _ = path.write_text(
    ...         "  100CL  101 5.00000E-01           1                     0    1           1\n"
    ...         " -4  DISP        4    1\n -5  D1          1    2    1    0\n"
    ...         " -5  D2          1    2    2    0\n"
    ...         " -1         7 5.00000E-03-2.19307E-03\n -3\n"
    ...     )
    ...     read_calculix_frd(path).history("D2", number=7)
    array([-0.00219307])
    """
    output = SolverOutput(path)
    rows: dict[Row, list[float]] | None = None
    variable, components, time, last = "", [""], 0.0, Row(0)
    for place, line in lines_of(path):
        code = line[:5].strip()
        if code.startswith("100"):
            if line[_FORMAT:].strip() in _BINARY:
                raise ValueError(
                    f"{place}: the results are binary; write *NODE FILE and *EL FILE without BINARY"
                )
            time = as_number(line[12:24], place)
        elif code == "-4":
            variable, components, rows = line[5:13].strip(), [], None
        elif code == "-5":
            if not line.rstrip().endswith("1ALL"):  # the amount of a vector, which is not written
                components.append(line[5:13].strip())
        elif code == "-3":
            variable, rows = "", None
        elif code == "-1" and variable:
            if rows is None:
                rows = output.add(variable, "", components, time)
            last = Row(as_whole(line[3:13], place))
            rows[last] = _fields(line, place)
        elif code == "-2" and rows is not None:
            rows[last] += _fields(line, place)
    return output


def _fields(line: str, place: str) -> list[float]:
    text = line.rstrip()
    return [
        as_number(text[start : start + _WIDTH], place) for start in range(13, len(text), _WIDTH)
    ]
