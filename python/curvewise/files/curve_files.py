"""Curves from files of any kind (text, Excel, MATLAB), by the file's suffix.

Text is read here alone (csv_curves.py); Excel through pandas and MATLAB through scipy, which are
imported where such a file is read. Time and memory are linear in the size of the file.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np

from .._option_names import called
from ..curves.inputs import Array
from ..curves.named_curve import NamedCurve
from .column_units import titled
from .csv_curves import read_csv_columns
from .file_options import Reading
from .regular_files import check_file

__all__ = ["read_curve", "read_named_columns"]

_WORKBOOKS = (".xlsx", ".xlsm", ".xls", ".ods")


def read_curve(
    path: str | os.PathLike[str],
    columns: Sequence[str | int] | None = None,
    *,
    sheet: str | int | None = None,
    factors: Sequence[float] | None = None,
    decimal: Literal[".", ","] | None = None,
    from_: str | None = None,
    header_row: int | None = None,
    until: str | None = None,
    skip_invalid: bool = False,
    encoding: str | None = None,
) -> Array:
    r"""Read a curve from a file: text, a sheet of Excel, or variables of MATLAB.

    The end of the name selects the format: .xlsx, .xlsm, .xls and .ods are workbooks, .mat is
    MATLAB's, and everything else is text, one point per line:

    Separator
        Semicolon, tab, ``|``, comma or spaces, whichever best turns the first 200 lines into
        numbers; or the separator of a first line such as "sep=;". Cells may be quoted. If numbers
        are separated by tabs, spaces never separate cells, so that an empty cell is kept. Lines
        without a header are refused if their cells are ambiguous, such as "1 000,5".
    Decimal sign
        A point; or a comma if the separator is a semicolon, a tab or spaces ("1,5;2,5"), or if
        cells are quoted. ("1,5" on its own is two columns.) The first number that is valid with
        only one of the signs decides. With decimal commas, "1.000" and "1.000,5" have points
        between thousands. Ambiguous files, such as "1,234" with "0.5", are refused: give
        `decimal`. Fortran exponents, "1.5D-03", are accepted. The minus sign may be U+2212 or a
        dash. Spaces of any width and apostrophes may separate thousands.
    Header
        All lines before the first one that holds a number. Lines before them that begin with a
        text and hold one number, such as "Width;12,5", also belong to the header if a line of
        names follows. The column names are the line with the most cells, the first among equals;
        or the line that has all names in `columns`, possibly further down, above a second table.
        Names that are separated by spaces count only if there is one for every column. Lines with
        more cells than names are refused, and so is a second table whose names are not requested.
        A row that looks like numbers, such as "0,1 %;10 MPa", is not a header. A row of units sets
        the units.
    Ignored
        Empty lines (separators alone too), lines that begin with #, % or //, and columns that are
        not requested. Below the last point, rows that are empty in the requested columns.
    Encoding
        UTF-8, or UTF-16 with a byte order mark. Otherwise GBK if all bytes above ASCII are pairs
        and most of these are common Chinese characters, else Windows-1252 or Latin-1. `encoding`
        overrides this. Lines end with CR, LF or CRLF.

    A sheet of a workbook is read by the same rules. The columns of a .mat file are its real arrays
    in the order of the file. A vector is a column with its variable's name. A matrix A of k > 1
    columns is "A(:,1)" to "A(:,k)". The fields of a structure are "test.strain".

    Parameters
    ----------
    path : str or path-like
        The file.
    columns : sequence of str or int, optional
        Names from the header, or numbers from 1 (as int or str), in the wanted order. If no column
        has exactly this name, capitals, spaces, hyphens, underscores and the unit are ignored:
        "stress" is "Stress (MPa)". By default the first two columns, or the only one.
    sheet : str or int, optional
        The sheet of a workbook, by its name or by its number from 1 (as int or str). By default the
        first.
    factors : sequence of float, one per column, optional
        Factors of the columns that convert units: ``[0.01, 1e-6]`` for per cent and Pa if the other
        curve has fractions and MPa.
    decimal : {".", ","}, optional
        The decimal sign of numbers in text, if the file is ambiguous; the other sign may then
        separate thousands. By default it is detected.
    from_ : str, optional
        The table begins with the first row that contains this text: its title, or its names. Rows
        above, such as a table of results, are ignored.
    header_row : int, optional
        The row of the file with the names, from 1; it may be a comment. Not allowed with `from_`.
    until : str, optional
        The curve ends before the first row that contains this text, below the first row of numbers:
        where statistics or a second table follow. By default, and if no row contains it, the curve
        ends with the file. Without effect on a .mat file.
    skip_invalid : bool, optional
        Whether to omit rows in which a cell is missing, not a number, nan or inf, with a warning of
        how many. By default such a row is an error.
    encoding : str, optional
        The encoding of a text file, such as "gbk" or "cp1251".

    Returns
    -------
    ndarray, shape (n, d)
        One row per point, one column per entry of `columns`, in the units of the file times
        `factors`. It remembers the names and units of its columns, which plots show on their axes.

    Raises
    ------
    ValueError
        If a cell is missing, not a number, nan or inf (the message has file, line and column). If a
        column or sheet does not exist (the message lists the existing ones). If no line holds a
        number, or all are omitted. If there are two decimal signs, or a line with more cells than
        names. If the file is damaged or of another kind, or `sheet` is given for a file that is not
        a workbook. If factors are not finite, are 0, or not one per column. If no row matches
        `from_` or `header_row`. If the encoding is unknown or does not fit the file. If the file is
        a device, or too large. The limits are a file above 4 GiB, a pipe above 256 MiB, a line
        above 2^20 characters, a sheet above 2^25 cells. If MATLAB variables differ in length, or a
        .mat file has version 7.3.
    ImportError
        If pandas and openpyxl are missing for a workbook, or scipy for a .mat file.
    OSError
        If the file cannot be read.
    MemoryError
        If the file needs more memory than is available.

    Warns
    -----
    TimeColumnWarning
        If `columns` is not given, the first column is time or counts cycles, and there are three or
        more.
    UserWarning
        If `skip_invalid` has omitted rows.

    Notes
    -----
    O(size) time and memory: about 2 s for 10^6 points of text (quoted: 5 s), more for a workbook.
    Workbooks in Strict Open XML are supported. .xls needs xlrd and .ods odfpy, in addition to
    pandas. A .mat file is read in a separate process, which takes 0.5 s, because scipy's reader can
    crash on a damaged one.

    Examples
    --------
    The columns of each file, in one unit:

    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise import read_curve
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.csv")
    ...     _ = path.write_text("time;strain [%];stress\n0;0;0\n1;0,1;199,5\n")
    ...     read_curve(path, columns=["strain [%]", "stress"], factors=[0.01, 1])
    array([[0.000e+00, 0.000e+00],
           [1.000e-03, 1.995e+02]])
    """
    reading = Reading(sheet, from_, header_row, until, skip_invalid, decimal, encoding)
    return read_named_columns(path, columns, reading, factors=factors)[0]


def read_named_columns(
    path: str | os.PathLike[str],
    columns: Sequence[str | int] | None,
    reading: Reading,
    *,
    factors: Sequence[float] | None = None,
) -> tuple[Array, list[str]]:
    r"""Read a curve as :func:`read_curve` does, with the names of its columns.

    Parameters
    ----------
    path, columns, factors
        As for :func:`read_curve`.
    reading : Reading
        The other keywords.

    Returns
    -------
    values : ndarray, shape (n, d)
        The curve.
    names : list of str
        The name of each column; its number, from 1, if it lacks one.

    Raises
    ------
    ValueError, ImportError, OSError
        As for :func:`read_curve`.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.files.curve_files import read_named_columns
    >>> from curvewise.files.file_options import Reading
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.csv")
    ...     _ = path.write_text("time,strain,stress\n0,0,0\n1,0.001,199.5\n")
    ...     read_named_columns(path, ["strain", 3], Reading())[1]
    ['strain', 'stress']
    """
    check_file(path, pipe=Path(path).suffix.lower() not in (*_WORKBOOKS, ".mat"))
    try:
        values, names, units = _read_columns(path, columns, reading)
    except MemoryError as error:
        raise MemoryError(
            f"{os.fspath(path)} takes more memory than there is; give a part of it"
        ) from error
    # The names of the columns in plots.
    titles = [
        titled(f"column {name}" if name.isdecimal() else name, unit)
        for name, unit in zip(names, units, strict=True)
    ]
    if factors is None:
        return NamedCurve(values, titles, Path(path).name), names
    given = np.asarray(factors, dtype=np.float64)
    if given.shape != values.shape[1:]:
        raise ValueError(
            f"{called('factors')} has shape {given.shape}; {os.fspath(path)} gives "
            f"{values.shape[1]} columns, and each needs one"
        )
    if not (np.isfinite(given).all() and given.all()):
        raise ValueError(f"{called('factors')} is {given.tolist()}; each must be finite and not 0")
    changed = [
        name if factor == 1.0 else f"{name} × {factor:.10g}"
        for name, factor in zip(titles, given.tolist(), strict=True)
    ]
    return NamedCurve(values * given, changed, Path(path).name), names


def _read_columns(
    path: str | os.PathLike[str], columns: Sequence[str | int] | None, reading: Reading
) -> tuple[Array, list[str], list[str]]:
    """Read columns by the reader of the file's kind."""
    kind = Path(path).suffix.lower()
    if kind in _WORKBOOKS:
        from .excel_curves import read_sheet_columns

        return read_sheet_columns(path, columns, reading)
    if reading.sheet is not None:
        raise ValueError(
            f"{called('sheet')} is {reading.sheet!r}, and {os.fspath(path)} is not a workbook; "
            f"omit {called('sheet')}"
        )
    if kind == ".mat":
        from .mat_curves import read_mat_columns

        return read_mat_columns(path, columns, reading)
    return read_csv_columns(path, columns, reading)
