"""The trust-region search for sums of squares, and the choice between the two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...curves.inputs import Array
from ..objective.objective import Objective
from ..problem.ledger import Course, Ledger
from ..surfaces.sums_of_squares import Loss, SumOfSquares, bend_of, check_loss
from .method import Method
from .runs import Runs
from .trust_region import SurrogateSearch, TrustRegion

__all__ = ["Auto", "LeastSquares"]


@dataclass(frozen=True, kw_only=True, repr=False)
class LeastSquares(SurrogateSearch, name="least-squares", keeps_curves=True, needs_squares=True):
    """Multistart Gauss-Newton search on a kriging surrogate of the residuals.

    For expensive models and the measures that are sums of squares, or the root of one. A start
    takes 10 to 20 runs for 3 parameters and 30 to 60 for 8: k + 1 runs for k parameters to begin
    with, then one for every step. For several loops it minimises the weighted sum of squares.

    Parameters
    ----------
    starts, starts_at_once, diff_step, tol, maxiter : optional
        As for :class:`TrustRegion`.
    most_starts : int, default 10
        Maximum number of starts.
    initial_range : float, optional
        As for :class:`TrustRegion`, but 0.2 by default.
    gain : float, default 1e-5
        The search ends if the predicted reduction is at most this fraction of the value.
    loss : {"linear", "soft_l1", "huber", "cauchy", "arctan"}
        Loss function of scipy.optimize.least_squares, for a robust sum. The result minimises that
        sum.
    f_scale : float, default 1.0
        Residuals above this value count less with a robust loss, in units of the experiment's range
        of y.

    Raises
    ------
    ValueError
        If an option is out of its range.

    Notes
    -----
    The Gauss-Newton method needs the residuals as a function of the parameters. A kriging surrogate
    through the runs near the best one replaces that function.

    C. Cartis, J. Fiala, B. Marteau, L. Roberts, "Improving the flexibility and robustness of
    model-based derivative-free optimization solvers", ACM Trans. Math. Softw. 45 (2019) 32. S. M.
    Wild, "POUNDERS in TAO: solving derivative-free nonlinear least-squares problems", SIAM (2017)
    529-540.

    Examples
    --------
    >>> from curvewise.calibration import LeastSquares
    >>> LeastSquares(loss="soft_l1", f_scale=0.01)
    LeastSquares(loss='soft_l1', f_scale=0.01)
    """

    first_range: ClassVar[float] = 0.2

    most_starts: int = 10
    gain: float = 1e-5
    loss: Loss = "linear"
    f_scale: float = 1.0

    def __post_init__(self) -> None:
        check_loss(self.loss)
        super().__post_init__()
        if not self.f_scale > 0.0:
            raise ValueError(f"f_scale is {self.f_scale}; it must be above 0")

    def inner(self, ledger: Ledger) -> SumOfSquares:
        """Return the sum of squares."""
        return SumOfSquares(ledger.objective, bend_of(self.loss, self.f_scale))

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise the sum of squares; the best run is that of the smallest robust sum."""
        runs = Runs(ledger, self.inner(ledger))
        try:
            return (yield from self.search(ledger, runs, start, seed))
        finally:
            if self.loss != "linear" and runs.values:
                ledger.settle(runs.points[runs.best])


@dataclass(frozen=True, kw_only=True, repr=False)
class Auto(Method, name="auto", keeps_curves=True, needs_squares=False):
    """Least squares if every term is a sum of squares, else trust region."""

    def chosen_for(self, objective: Objective) -> Method:
        """Return the method for an objective."""
        return LeastSquares() if objective.is_least_squares else TrustRegion()

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Return the course of the method for the ledger's objective."""
        return self.chosen_for(ledger.objective).course(ledger, start, seed)

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the two, which are as many."""
        return TrustRegion().fewest_runs(parameters, has_start=has_start)
