"""Local search by Nelder and Mead's simplex, restarted: `restarted_simplex` on the model itself.

Its tolerance on the value is the negligible difference of the objective. A relative tolerance would
never be met, because the smallest value of a perfect model is 0. Cost: 250 to 500 runs for 3
parameters.

J. A. Nelder, R. Mead, "A simplex method for function minimization", The Computer Journal 7 (1965)
308-313.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from .called_back import Evaluate, course_of
from .method import Method, check_passed_on
from .restarted_simplex import nelder_mead

__all__ = ["NelderMead"]

_OF_SCIPY = ("xatol", "fatol", "maxiter", "maxfev", "adaptive", "disp", "return_all")


@dataclass(frozen=True, kw_only=True, repr=False)
class NelderMead(Method, name="nelder-mead", keeps_curves=False, needs_squares=False):
    """Restarted Nelder-Mead simplex: a local search for few parameters.

    It begins at `start`.

    It requests one run at a time, whatever `workers` is.

    Parameters
    ----------
    size : float, default 0.1
        Length of the edges of a fresh simplex, as a fraction of the bounds' range.
    restarts : int, default 10
        The most fresh simplices after the first; two in a row that gain nothing end the search.
    options : mapping, optional
        Options of scipy's Nelder-Mead: xatol, fatol, maxiter, maxfev, adaptive, disp, return_all.

    Raises
    ------
    ValueError
        If scipy does not have an option.

    Notes
    -----
    J. A. Nelder, R. Mead, The Computer Journal 7 (1965) 308-313.

    Examples
    --------
    >>> from curvewise.calibration import NelderMead
    >>> NelderMead(restarts=2, options={"xatol": 1e-4})
    NelderMead(restarts=2, options={'xatol': 0.0001})
    """

    size: float = 0.1
    restarts: int = 10
    options: Mapping[str, Any] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        check_passed_on(self, self.options, _OF_SCIPY)

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of a simplex and of some steps."""
        return 2 * parameters + 10

    def near_optimum(self) -> NelderMead:
        """Return the same: its simplex is small already."""
        return self

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise from a start, by default the middle of the bounds."""
        return course_of(partial(self._minimised, ledger, start, seed))

    def _minimised(
        self, ledger: Ledger, start: Array | None, seed: int, evaluate: Evaluate
    ) -> Finish:
        k = ledger.dimensions
        negligible = ledger.negligible
        _, converged, message = nelder_mead(
            lambda unit: evaluate(unit[np.newaxis])[0].value,
            np.full(k, 0.5) if start is None else start,
            (np.zeros(k), np.ones(k)),
            np.random.default_rng(seed),
            negligible=negligible,
            size=self.size,
            restarts=self.restarts,
            **{"xatol": 1e-6, "fatol": negligible, **self.options},
        )
        return Finish(converged, message)
