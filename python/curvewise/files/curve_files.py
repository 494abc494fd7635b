"""Curves from files of any kind: text, Excel, MATLAB. The kind is told from the name's ending.

Text is read here alone (csv_curves.py); Excel through pandas and MATLAB through scipy, which are
imported where such a file is read. Time and memory are linear in the size of the file.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np

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

    What the name ends with decides: .xlsx, .xlsm, .xls and .ods are workbooks, .mat is MATLAB's,
    and everything else is text, one point per line:

    Separator
        Semicolon, tab, ``|``, comma or blanks, whichever turns the first 200 lines into numbers
        best, or what a first line such as "sep=;" says. Cells may be quoted. A file with numbers
        between tabs is never read as separated by blanks, so that an empty cell stays one. Lines
        without a header that may be other cells, such as "1 000,5", are refused.
    Decimal sign
        A point; or a comma where the separator is a semicolon, a tab or blanks ("1,5;2,5"), or
        where cells are quoted. ("1,5" on its own is two columns.) The first number read that is
        one with one of the signs alone decides; with decimal commas "1.000" and "1.000,5" have
        points between thousands. What stays open, as "1,234" beside "0.5", is refused: give
        `decimal`. Exponents may be Fortran's, "1.5D-03". The minus sign may be U+2212 or a dash.
        Blanks of any width and apostrophes may stand between thousands.
    Header
        All lines before the first one that holds a number, and before them lines that begin with
        a text and hold one number, such as "Width;12,5", if a line of names follows. The column
        names are the one line with the most cells, the first among equals; or that has all names
        in `columns`; that line may be further down, above a second table. Names that blanks
        separate count only if there are as many as columns. Lines with more cells than there are
        names are refused, and so is a second table whose names are not asked for. A row that
        looks like numbers, such as "0,1 %;10 MPa", is no header. A row of units names the units.
    Ignored
        Empty lines (separators alone too), lines that begin with #, % or //, columns that are
        not asked for, and below the last point rows that are empty in those asked for.
    Encoding
        UTF-8, UTF-16 with a byte order mark, else GBK if all bytes above ASCII are pairs and most
        of these are common Chinese characters, else Windows-1252 or Latin-1; or `encoding`. Lines
        end with CR, LF or CRLF.

    A sheet of a workbook is read by the same rules. The columns of a .mat file are its real arrays
    in the order of the file: a vector is a column of its variable's name; a matrix A of k > 1
    columns is "A(:,1)" to "A(:,k)"; the fields of a structure are "test.strain".

    Parameters
    ----------
    path : str or path-like
        The file.
    columns : sequence of str or int, optional
        Names from the header, or numbers from 1 (as int or str), in the order wanted. If no column
        has a name to the letter, capitals, blanks, hyphens, underscores and the unit do not count:
        "stress" is "Stress (MPa)". By default the first two columns, or the only one.
    sheet : str or int, optional
        The sheet of a workbook, by its name, or by its number from 1 (as int or str). By default
        the first.
    factors : sequence of float, one per column, optional
        What the columns are multiplied by, to change units: ``[0.01, 1e-6]`` for per cent and Pa
        where the other curve has fractions and MPa.
    decimal : {".", ","}, optional
        The decimal sign of numbers that are text, if they leave it open; the other one may then
        stand between thousands. By default told from the numbers.
    from_ : str, optional
        The table begins with the first row that contains this text: its title, or its names. What
        is above, such as a table of results, is not looked at.
    header_row : int, optional
        The row of the file that has the names, from 1; it may be a comment. Not with `from_`.
    until : str, optional
        The curve ends before the first row that contains this text, below the first row of
        numbers: where statistics or a second table follow. By default, and where no row contains
        it, with the file. Without effect on a .mat file.
    skip_invalid : bool, optional
        Leave out rows in which a cell is missing, not a number, nan or inf, and warn how many.
        By default such a row is an error.
    encoding : str, optional
        The encoding of a text file, such as "gbk" or "cp1251".

    Returns
    -------
    ndarray, shape (n, d)
        One row per point, one column per entry of `columns`, in the units of the file times
        `factors`. It remembers the names and units of its columns, which pictures write on their
        axes.

    Raises
    ------
    ValueError
        A cell is missing, not a number, nan or inf (with file, line and column); there is no
        such column or sheet (lists those there are); no line holds a number, or none is left; two
        decimal signs; a line with more cells than names; a damaged file, or one of another kind;
        factors that are not finite, that are 0, or not one per column; a sheet of a file that is
        no workbook; no row with `from_` or `header_row`; an unknown encoding, or not that of the
        file; a device, a file above 4 GiB, a pipe above 256 MiB, a line above 2^20
        characters, a sheet above 2^25 cells; MATLAB variables of different lengths, or a .mat file
        of version 7.3.
    ImportError
        A workbook without pandas and openpyxl, or a .mat file without scipy.
    OSError
        The file cannot be read.
    MemoryError
        The file takes more memory than there is.

    Warns
    -----
    TimeColumnWarning
        `columns` is not given, the first column is time by its name, and there are three or more.
    UserWarning
        `skip_invalid` has left out rows.

    Notes
    -----
    O(size) time and memory: about 2 s for 10^6 points of text (quoted: 5 s), more of a workbook.
    Workbooks in Strict Open XML are read, too.
    .xls needs xlrd and .ods odfpy, beside pandas. A .mat file is read in a process of its own,
    which takes 0.5 s, since scipy's reader can crash on a damaged one.

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
    r"""Read a curve as :func:`read_curve` does, and say which columns it was read from.

    Parameters
    ----------
    path, columns, factors
        As for :func:`read_curve`.
    reading : Reading
        Its other keywords.

    Returns
    -------
    values : ndarray, shape (n, d)
        The curve.
    names : list of str
        Of each column its name; its number, from 1, where it has none.

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
    # What pictures call the columns.
    titles = [
        titled(f"column {name}" if name.isdecimal() else name, unit)
        for name, unit in zip(names, units, strict=True)
    ]
    if factors is None:
        return NamedCurve(values, titles, Path(path).name), names
    given = np.asarray(factors, dtype=np.float64)
    if given.shape != values.shape[1:]:
        raise ValueError(
            f"factors has shape {given.shape}; {os.fspath(path)} gives {values.shape[1]} columns, "
            "and each needs one"
        )
    if not (np.isfinite(given).all() and given.all()):
        raise ValueError(f"factors is {given.tolist()}; each must be finite and not 0")
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
            f"sheet is {reading.sheet!r}, and {os.fspath(path)} is no workbook; leave sheet out"
        )
    if kind == ".mat":
        from .mat_curves import read_mat_columns

        return read_mat_columns(path, columns, reading)
    return read_csv_columns(path, columns, reading)
