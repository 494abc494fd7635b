"""Local search by Nelder and Mead's simplex, restarted until it gains nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from .called_back import Evaluate, course_of
from .method import Method, check_passed_on

__all__ = ["NelderMead"]

_OF_SCIPY = ("xatol", "fatol", "maxiter", "maxfev", "adaptive", "disp", "return_all")
_RESOLUTION = 1e-6  # of a simplex, as a fraction of the bounds' range
_GAIN = 1e-3  # restarts that gain a smaller fraction of the value gain nothing


@dataclass(frozen=True, kw_only=True, repr=False)
class NelderMead(Method, name="nelder-mead", keeps_curves=False, needs_squares=False):
    """Restarted Nelder-Mead simplex: a local search for few parameters.

    It begins at `start`, and requests one run at a time, whatever `workers` is.

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
    A simplex may collapse at a point that is not a minimum, most often at the kinks of an
    objective. A new simplex in other directions lets the search continue. The tolerance on the
    value is the negligible difference of the objective, because the smallest value of a perfect
    model is 0. Cost: 250 to 500 runs for 3 parameters; it suits up to 10 parameters, better 5.

    J. A. Nelder, R. Mead, "A simplex method for function minimization", The Computer Journal 7
    (1965) 308-313.

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

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise from a start, by default the middle of the bounds."""
        begin = np.full(ledger.dimensions, 0.5) if start is None else start
        random = np.random.default_rng(seed)
        return course_of(lambda evaluate: self._minimised(evaluate, begin, random, ledger))

    def _minimised(
        self, evaluate: Evaluate, best: Array, random: np.random.Generator, ledger: Ledger
    ) -> Finish:
        def function(unit: Array) -> float:
            return evaluate(unit[np.newaxis])[0].value

        k, negligible = best.size, ledger.negligible
        nothing = 10.0 * negligible
        value, idle = function(best), 0
        for restart in range(1 + self.restarts):
            directions = np.eye(k) if restart == 0 else np.linalg.qr(random.normal(size=(k, k)))[0]
            # Inwards: of the two ends of an edge the one nearer to the middle.
            outwards = directions @ (best - 0.5) > 0
            directions *= np.where(outwards, -self.size, self.size)[:, np.newaxis]
            options = {
                "xatol": _RESOLUTION,
                "fatol": negligible,
                "adaptive": k > 3,
                **self.options,
                "initial_simplex": np.clip(np.vstack((best, best + directions)), 0.0, 1.0),
            }
            result = required("scipy.optimize").minimize(
                function, best, method="Nelder-Mead", bounds=[(0.0, 1.0)] * k, options=options
            )
            gained = value - result.fun
            if gained > 0:
                best, value = result.x, float(result.fun)
            idle = 0 if gained > max(nothing, _GAIN * value) else idle + 1
            if value <= nothing or idle == 2:
                break
        return Finish(bool(result.success), str(result.message))
