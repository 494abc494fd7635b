"""An external solver as a model: a deck from templates, a process, a curve from its results.

Every set of parameters has its own scratch folder. The filled-in templates are written there. The
command runs there under a time limit, in its own process group. A user-defined function then reads
the curves. Calls do not share anything, so they can run in parallel, in threads or in processes. A
call costs the solver's time plus that of the templates (templates.py) and of the process
(process.py).
"""

from __future__ import annotations

import hashlib
import math
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from ...curves.inputs import Array, as_curve
from .identity import fingerprint
from .process import SolverError, end_of_log, run_solver
from .raised import named_with_place
from .templates import check_names, read_templates

__all__ = ["CommandModel", "SolverError"]

Curves: TypeAlias = Array | list[Array]

LOG = "command.log"


class CommandModel:
    r"""A model that runs an external program and returns its curves.

    Templates hold placeholders with a parameter's name:

    ``<<E>>``
        The shortest text that reads back as the same number.
    ``<<E:10>>``
        A field of 10 characters, with as many digits as fit and always a decimal point, for decks
        with fixed columns.
    ``<<E:12.4e>>``
        Any of Python's format specifications. A number that is longer than the given width is an
        error, because it would shift the columns behind it.

    A template without placeholders, such as a mesh that the deck includes, is copied unchanged.

    Parameters
    ----------
    template_files : path or sequence of paths
        Files to write into each run's folder, under the same name. They are read once, when the
        model is created.
    command : sequence of str
        The program and its arguments, run in that folder without a shell. It must wait for the
        solver's end (Abaqus: ``interactive``).
    read : callable
        ``read(folder)`` is called with the folder (a ``Path``) after the program has ended with
        exit code 0. It returns a curve, an array of shape (n, d), or a list of such arrays. It
        should raise if results are incomplete. A module-level function can be pickled, a lambda
        cannot.
    parameters : sequence of str
        The names of the parameters, so that a misspelt placeholder is found before the first run.
    timeout : float
        Seconds after which a run is stopped, with all processes it has started.
    environment : mapping of str to str, optional
        Variables to set in addition to those of this process, e.g. ``{"OMP_NUM_THREADS": "1"}``.
    scratch : path, optional
        The parent of the scratch folders; by default the system's folder for temporary files.
    keep : bool
        Whether to keep the folders of successful runs, too.

    Attributes
    ----------
    identity : str
        A text that differs between different models; a store identifies the model by it.
    is_solver : bool
        True: a search compares its first run with the tests (:class:`FirstRunWarning`).

    Raises
    ------
    ValueError
        If a placeholder is not a parameter, or is malformed. If a parameter lacks a placeholder. If
        two templates have the same name, the command is empty, or the time limit is not positive.
    FileNotFoundError
        If a template, the scratch folder or the program does not exist.

    Notes
    -----
    A call raises `SolverError` if the program cannot be started, or ends with an exit code other
    than 0 or by a signal. The same holds if it takes longer than `timeout`, or prints more than 64
    MiB. It also raises `SolverError` if `read` fails or returns something other than curves of
    finite numbers. The folder is then kept, with the program's output in ``command.log``, whose end
    the error quotes. However a call ends (Ctrl-C included), all processes of the run's group end
    with it (on Windows: the program itself).

    A store identifies the model by its `identity`: the text of its templates, its command and
    environment, and the code of `read` (but not of the functions that it calls). The identity does
    not cover the version of the program, or files that the deck names but that are not templates.
    Use ``SimulationStore(path, version=...)`` for those.

    Parameters may also be text, which is inserted unchanged, e.g. a table of a hardening curve that
    a function computes from two numbers before it calls the model.

    Examples
    --------
    >>> import sys, tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from curvewise.calibration import CommandModel
    >>> deck = "open('curve.txt', 'w').write('0 0\\n1 <<E:10>>\\n')"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     template = Path(folder, "solver.py")
    ...     _ = template.write_text(deck)
    ...     model = CommandModel(
    ...         template,
    ...         [sys.executable, "solver.py"],
    ...         lambda folder: np.loadtxt(folder / "curve.txt"),
    ...         parameters=["E"],
    ...         timeout=60,
    ...     )
    >>> model({"E": 205.5}).tolist()
    [[0.0, 0.0], [1.0, 205.5]]
    """

    is_solver = True

    def __init__(
        self,
        template_files: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
        command: Sequence[str],
        read: Callable[[Path], Array | Sequence[Array]],
        *,
        parameters: Sequence[str],
        timeout: float,
        environment: Mapping[str, str] | None = None,
        scratch: str | os.PathLike[str] | None = None,
        keep: bool = False,
    ) -> None:
        if isinstance(command, str) or not command:
            raise ValueError(f"command is {command!r}; give a list: the program and its arguments")
        if not timeout > 0:
            raise ValueError(f"timeout is {timeout!r}; give a positive number of seconds")
        if isinstance(parameters, str):
            raise ValueError(f"parameters is {parameters!r}; give a list of names")
        program = shutil.which(command[0])
        if program is None:
            raise FileNotFoundError(
                f"the program {command[0]!r} does not exist; install it, or give its path"
            )
        if scratch is not None and not Path(scratch).is_dir():
            raise FileNotFoundError(
                f"the scratch folder {os.fspath(scratch)!r} does not exist; create it"
            )
        self.parameters = tuple(parameters)
        self.command = [os.path.abspath(program), *command[1:]]  # the run's folder is another one
        self.read = read
        self.timeout = float(timeout)
        self.environment = dict(environment or {})
        self.scratch = None if scratch is None else Path(scratch).resolve()
        self.keep = keep
        self._templates = read_templates(template_files, LOG)
        check_names(self._templates, self.parameters)
        self.identity = self._identity()

    def __call__(self, parameters: Mapping[str, float | str]) -> Curves:
        """Run the program with these parameters and return its curves.

        Parameters
        ----------
        parameters : mapping of str to float or str
            A value for each of the model's parameters, and for nothing else.

        Returns
        -------
        ndarray or list of ndarray
            The result of `read`, in float64.

        Raises
        ------
        SolverError
            If the run failed; the message names its log.
        ValueError
            If a parameter is missing, unknown, not finite, or does not fit its field.

        Notes
        -----
        As for the class.
        """
        files = self._fill(parameters)
        folder = Path(tempfile.mkdtemp(prefix="curvewise_", dir=self.scratch))
        keep = self.keep
        try:
            for name, content in files:
                (folder / name).write_bytes(content)
            run_solver(
                self.command,
                folder,
                folder / LOG,
                timeout=self.timeout,
                environment=self.environment,
            )
            return self._read(folder)
        except Exception:  # not KeyboardInterrupt: nothing is wrong with that run
            keep = True
            raise
        finally:
            if not keep:
                shutil.rmtree(folder, ignore_errors=True)  # a file left behind spoils no result

    def _identity(self) -> str:
        """Return a text that is another where the curves may be: of the deck and what reads it."""
        digest = hashlib.sha256()
        for template in self._templates:
            digest.update(repr((template.name, template.texts)).encode("utf-8", "surrogateescape"))
            digest.update(repr(template.placeholders).encode())
        digest.update(repr((self.command, sorted(self.environment.items()))).encode())
        digest.update(fingerprint(self.read).encode())
        names = " ".join(template.name for template in self._templates)
        return f"{Path(self.command[0]).name} {names}, {digest.hexdigest()[:16]}"

    def _fill(self, parameters: Mapping[str, float | str]) -> list[tuple[str, bytes]]:
        if set(parameters) != set(self.parameters):
            raise ValueError(
                f"got parameters {', '.join(parameters) or '(none)'}; "
                f"the model's are {', '.join(self.parameters)}"
            )
        for name, value in parameters.items():
            if not isinstance(value, str) and not math.isfinite(value):
                raise ValueError(f"parameter {name} is {value}; parameters must be finite")
        return [(template.name, template.fill(parameters)) for template in self._templates]

    def _read(self, folder: Path) -> Curves:
        try:
            curves = self.read(folder)
            if isinstance(curves, (list, tuple)):
                return [_checked(curve, f"curves[{i}]") for i, curve in enumerate(curves)]
            return _checked(curves, "the curve")
        except Exception as error:  # whatever the user's function stumbles over
            raise SolverError(
                f"the results cannot be read: {named_with_place(error)}; log: {folder / LOG}"
                f"{end_of_log(folder / LOG)}"
            ) from error


def _checked(curve: object, name: str) -> Array:
    array = as_curve(curve, name)
    if array.size == 0 or not np.isfinite(array).all():
        raise ValueError(f"{name} is {'empty' if array.size == 0 else 'not finite'}")
    return array
