"""Local search by scipy's trust-region least squares on the terms of the measure.

Derivatives are differences over `diff_step` of the bounds' range, of runs that are asked for in one
batch. Cost: k + 1 runs an iteration for k parameters, some 40 runs in all for 3.

M. A. Branch, T. F. Coleman, Y. Li, "A subspace, interior, and conjugate gradient method for
large-scale bound-constrained minimization problems", SIAM J. Sci. Comput. 21 (1999) 1-23.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from .called_back import Evaluate, course_of
from .method import Method, check_passed_on, taken_by

__all__ = ["LeastSquares"]

# What of scipy's function is not for users: the objective, and what is set here.
_SET_HERE = ("fun", "x0", "jac", "bounds", "args", "kwargs", "diff_step", "workers")


@dataclass(frozen=True, kw_only=True, repr=False)
class LeastSquares(Method, name="least-squares", keeps_curves=True, needs_squares=True):
    """Least squares by scipy: local, fast and exact where the model is smooth.

    For the measures "curve_length" and "sum_of_squares"; of several loops it minimises the weighted
    sum of squares. It takes some 40 runs for 3 parameters, k of each k + 1 at the same time.

    Parameters
    ----------
    diff_step : float, default 1e-6
        Of the derivatives, as a fraction of the bounds' range. The default is for models in double
        precision; a solver that prints seven digits needs 1e-4 to 1e-3.
    loss : str or callable, default "linear"
        Such as "soft_l1", for a robust sum, of which the result is then the minimum.
    f_scale : float, default 1.0
        Residuals above this count less with such a loss, in units of the experiment's height.
    options : mapping, optional
        Others of ``scipy.optimize.least_squares``: xtol, ftol, gtol, max_nfev, ...

    Raises
    ------
    ValueError
        An option that cannot be, or that scipy does not have.

    Notes
    -----
    M. A. Branch, T. F. Coleman, Y. Li, SIAM J. Sci. Comput. 21 (1999) 1-23.

    Examples
    --------
    >>> from curvewise.calibration import LeastSquares
    >>> LeastSquares(loss="soft_l1", f_scale=0.01)
    LeastSquares(loss='soft_l1', f_scale=0.01)
    """

    diff_step: float = 1e-6
    loss: str | Callable[[Array], Array] = "linear"
    f_scale: float = 1.0
    options: Mapping[str, Any] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        if not 0.0 < self.diff_step < 1.0:
            raise ValueError(
                f"diff_step is {self.diff_step}; give a fraction of the bounds, such as 1e-3"
            )
        if self.options:
            known = taken_by(required("scipy.optimize").least_squares, _SET_HERE)
            check_passed_on(self, self.options, known)

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of two derivatives and of a step between them."""
        return 2 * parameters + 3

    def near_optimum(self) -> LeastSquares:
        """Return the same: it has no region whose size would be known."""
        return self

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise from a start, the middle of the bounds if none is given."""
        return course_of(partial(self._minimised, ledger, start))

    def _minimised(self, ledger: Ledger, start: Array | None, evaluate: Evaluate) -> Finish:
        k = ledger.dimensions
        objective = ledger.objective

        def residuals(unit: Array) -> Array:
            (evaluation,) = evaluate(unit[np.newaxis])
            return objective.residuals(evaluation.simulations)

        def jacobian(unit: Array) -> Array:
            # All columns in one batch; backwards at the upper bound.
            steps = np.where(unit + self.diff_step > 1.0, -self.diff_step, self.diff_step)
            units = np.vstack((unit, unit + np.diag(steps)))
            base, *moved = (objective.residuals(e.simulations) for e in evaluate(units))
            return np.column_stack([(r - base) / h for r, h in zip(moved, steps, strict=True)])

        settings = {"x_scale": "jac", "xtol": 1e-9, "ftol": 1e-12, "gtol": 1e-12, **self.options}
        result = required("scipy.optimize").least_squares(
            residuals,
            np.full(k, 0.5) if start is None else start,
            jacobian,
            bounds=(0.0, 1.0),
            loss=self.loss,
            f_scale=self.f_scale,
            **settings,
        )
        if self.loss != "linear":  # the smallest sum of squares is not what is wanted
            ledger.settle(result.x)
        return Finish(bool(result.success), str(result.message))
