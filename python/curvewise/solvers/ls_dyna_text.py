"""LS-DYNA's ASCII files nodout and elout (``*DATABASE_NODOUT``, ``*DATABASE_ELOUT``, BINARY = 1).

Each time begins with a spaced-out title that ends with "( at time 1.0000000E-03 )". In nodout, a
head of columns follows, and a row for every node, in columns of 12 that touch if numbers are
negative. In elout, a line "element-material" follows for every element. Below it is a line for
every integration point with a word for its state and the stresses. Written from LS-DYNA's manual
and public listings, and tested on hand-written samples, because LS-DYNA is not available for
development. Cost: linear in the file.
"""

from __future__ import annotations

import os
import re

from .solver_output import Row, SolverOutput, as_number, as_whole, lines_of

__all__ = ["read_ls_dyna_elout", "read_ls_dyna_nodout"]

_TIME = re.compile(r"\(\s*at time\s*([-+.\dEe]+)\s*\)")
_NUMBER = re.compile(r"[-+]?\d\.\d+(?:[Ee][-+]?\d+|[-+]\d{3})")
_NODE = re.compile(r"\s*(\d+)(\s.*)")
_ELEMENT = re.compile(r"\s*(\d+)\s*-\s*\d+\s*$")
_POINT = re.compile(r"\s*(\d+)\s*-?\s*(?:\d+\s+)?([a-zA-Z]+)?")
_STRESSES = ("sig-xx", "sig-yy", "sig-zz", "sig-xy", "sig-yz", "sig-zx")
_STRAINS = ("eps-xx", "eps-yy", "eps-zz", "eps-xy", "eps-yz", "eps-zx")


def read_ls_dyna_nodout(path: str | os.PathLike[str]) -> SolverOutput:
    r"""Read LS-DYNA's nodout.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    SolverOutput
        Variables "translations" (x-disp, x-vel, x-accl, x-coor, y-disp, ...) and "rotations"
        (x-rot, ...); give the node.

    Raises
    ------
    ValueError
        If a row does not consist of numbers; the message has its line.
    OSError
        If the file cannot be read.

    Notes
    -----
    Linear in the size of the file. A last time that is cut short has fewer nodes, which a history
    of them says.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.solvers import read_ls_dyna_nodout
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "nodout")
    ...     _ = path.write_text(
    ...         " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1"
    ...         "                              ( at time 1.0000000E-03 )\n\n"
    ...         " nodal point  x-disp     y-disp      z-disp\n"
    ...         "        71  1.00000E-02-2.00000E-03 0.00000E+00\n"
    ...     )
    ...     read_ls_dyna_nodout(path).history("y-disp", number=71)
    array([-0.002])
    """
    output = SolverOutput(path)
    time = 0.0
    rows: dict[Row, list[float]] | None = None
    count = 0
    for place, line in lines_of(path):
        if found := _TIME.search(line):
            time, rows = as_number(found[1], place), None
        elif line.split()[:2] == ["nodal", "point"]:
            columns = line.split()[2:]
            variable = "rotations" if "x-rot" in columns else "translations"
            rows, count = output.add(variable, "", columns, time), len(columns)
        elif rows is not None and (row := _NODE.match(line)):
            values = [as_number(text, place) for text in _NUMBER.findall(row[2])]
            if len(values) == count:  # a run that was killed ends in the middle of a line
                rows[Row(as_whole(row[1], place))] = values
        else:
            rows = None
    return output


def read_ls_dyna_elout(path: str | os.PathLike[str]) -> SolverOutput:
    r"""Read the stresses and strains of LS-DYNA's elout, of solids and shells.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    SolverOutput
        The variables are "stress" and "strain", by element and integration point. Components of
        "stress" are sig-xx, sig-yy, sig-zz, sig-xy, sig-yz, sig-zx, then effsg and yield for
        solids, and plastic-strain for shells. Components of "strain" are eps-xx, ...; for shells
        point 1 is the lower surface and 2 the upper one.

    Raises
    ------
    ValueError
        If a row does not consist of numbers; the message has its line.
    OSError
        If the file cannot be read.

    Notes
    -----
    Linear in the size of the file. Beams and discrete elements are not read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.solvers import read_ls_dyna_elout
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "elout")
    ...     _ = path.write_text(
    ...         " e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p"
    ...         "        1   ( at time 1.00000E-03 )\n\n element  materl\n"
    ...         "     ipt  stress       sig-xx      sig-yy\n           state\n"
    ...         "      12-      1\n"
    ...         "       1 elastic   2.0000E+02 0.0000E+00 0.0000E+00 0.0000E+00 0.0000E+00"
    ...         " 0.0000E+00 2.0000E+02 1.0000E+00\n"
    ...     )
    ...     read_ls_dyna_elout(path).history("sig-xx", number=12, point=1)
    array([200.])
    """
    output = SolverOutput(path)
    time, element, variable, surface = 0.0, 0, "", 0
    for place, line in lines_of(path):
        folded = line.lower()
        if found := _TIME.search(folded):
            time, variable = as_number(found[1], place), "stress"
        elif "eps-xx" in folded:
            variable = "strain"
        elif found := _ELEMENT.match(line):
            element, surface = as_whole(found[1], place), 0
        elif values := [as_number(text, place) for text in _NUMBER.findall(line)]:
            surface += 1
            components = _components(variable, len(values))
            point = _POINT.match(line) if "ipt" not in folded else None
            row = Row(element, as_whole(point[1], place) if point else surface)
            if components and element:
                output.add(variable, "", components, time)[row] = values
    return output


def _components(variable: str, count: int) -> tuple[str, ...]:
    """Return the names of the values of a row, by their number."""
    if variable == "strain":
        return _STRAINS if count == len(_STRAINS) else ()
    rest = {0: (), 1: ("plastic-strain",), 2: ("effsg", "yield")}
    further = count - len(_STRESSES)
    return (*_STRESSES, *rest[further]) if variable and further in rest else ()
