"""LS-DYNA's binout, by lasso-python (BSD-3-Clause), which holds the reader of LS-DYNA's makers.

The extra ``curvewise[ls-dyna]`` brings it, with much else, and needs Python 3.11. Without it
LS-DYNA's own ``l2a binout`` turns the file into nodout, elout, rcforc and so on. Cost: that of the
reader, linear in the branches that are read.
"""

from __future__ import annotations

import glob
import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from .._extras import extra, foreign_reader
from .solver_output import Row, SolverOutput

__all__ = ["read_ls_dyna_binout"]


def read_ls_dyna_binout(
    path: str | os.PathLike[str], branches: Sequence[str] | None = None
) -> SolverOutput:
    """Read histories of LS-DYNA's binout.

    Parameters
    ----------
    path : path-like
        The file, or a pattern for its parts: "binout*", for a parallel run.
    branches : sequence of str, optional
        The branches to read, such as "nodout", "rcforc" or "elout/solid". By default all.

    Returns
    -------
    SolverOutput
        A variable for each branch; components have their names in the file (x_displacement,
        x_force). Numbers are those of its ids (for rcforc each id has a master and a slave: points
        1 and 0).

    Raises
    ------
    ImportError
        If lasso-python is missing: ``pip install "curvewise[ls-dyna]"``.
    ValueError
        If the branch does not exist; the message lists the existing ones.
    OSError
        If no file has this name.

    Notes
    -----
    If the number of values of a component differs from the number of ids (stresses at several
    integration points), they are numbered from 1 in the order of the file.

    Examples
    --------
    >>> from curvewise.solvers import read_ls_dyna_binout
    >>> output = read_ls_dyna_binout("binout*", ["nodout"])  # doctest: +SKIP
    >>> output.history("x_displacement", number=71)  # doctest: +SKIP
    """
    with extra("ls-dyna", "a binout needs lasso-python", ", or convert it by LS-DYNA's l2a"):
        from lasso.dyna import Binout
    name = os.fspath(path)
    if not glob.glob(name):
        raise FileNotFoundError(f"there is no binout {name!r}")
    advice = "was the run cut short? LS-DYNA's l2a may still convert it"
    with foreign_reader(name, "binout", advice):
        binout = Binout(name)
        there_are = _branches(binout)
    output = SolverOutput(name)
    for branch in there_are if branches is None else branches:
        if branch not in there_are:
            raise ValueError(f"{name} has no branch {branch!r}; there is {', '.join(there_are)}")
        with foreign_reader(name, "binout", advice):
            _add(output, binout, branch)
    return output


def _branches(binout: Any) -> list[str]:
    """Return what holds times: "nodout", "elout/solid"."""
    found = []
    for name in _items(binout):
        below = _items(binout, name)
        if "time" in below:
            found.append(name)
        else:
            found += [f"{name}/{item}" for item in below if "time" in _items(binout, name, item)]
    return found


def _items(binout: Any, *path: str) -> list[str]:
    listed = binout.read(*path)
    return [str(item) for item in listed] if isinstance(listed, list) else []


def _add(output: SolverOutput, binout: Any, branch: str) -> None:
    path = branch.split("/")
    names = _items(binout, *path)
    times = np.atleast_1d(binout.read(*path, "time"))
    ids = np.atleast_1d(binout.read(*path, "ids")) if "ids" in names else np.zeros(1)
    sides = np.atleast_1d(binout.read(*path, "side")) if "side" in names else np.zeros(len(ids))
    for name in names:
        values = binout.read(*path, name)
        if name == "time" or not isinstance(values, np.ndarray) or values.dtype.kind not in "fi":
            continue
        table = values.reshape(len(times), -1) if values.size % len(times) == 0 else None
        if table is None or len(values) != len(times):  # of the whole run, such as the ids
            continue
        if table.shape[1] == len(ids):
            rows = [Row(int(i), int(side)) for i, side in zip(ids, sides, strict=True)]
        else:
            rows = [Row(i + 1) for i in range(table.shape[1])]
        for time, row_values in zip(times, table, strict=True):
            at = output.add(branch, "", [name], float(time))
            at.update({row: [float(v)] for row, v in zip(rows, row_values, strict=True)})
