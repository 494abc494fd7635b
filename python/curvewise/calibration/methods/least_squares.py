"""A search for the smallest sum of squares of an expensive model, without derivatives.

The Gauss-Newton method needs the residuals as a function of the parameters. A kriging surrogate
through the runs near the best one replaces that function. `trust_region` lists the parts of the
search; `surfaces.sums_of_squares` is the inner search. Cost: k + 1 runs for the initial design and
one for every step: 10 to 20 runs per start for 3 parameters, 30 to 60 for 8.

C. Cartis, J. Fiala, B. Marteau, L. Roberts, "Improving the flexibility and robustness of
model-based derivative-free optimization solvers", ACM Trans. Math. Softw. 45 (2019) 32; S. M. Wild,
"POUNDERS in TAO: solving derivative-free nonlinear least-squares problems", in "Advances and trends
in optimization with engineering applications", SIAM (2017) 529-540.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...curves.inputs import Array
from ..problem.ledger import Course, Ledger
from ..surfaces.robust_losses import Loss, bend_of, check_loss
from ..surfaces.sums_of_squares import SumOfSquares
from .descent import Rules
from .method import Method, with_other_defaults
from .multistart import searched
from .runs import Runs
from .starts import check_regions, starts_that_agree

__all__ = ["LeastSquares"]

_STEPS = 500  # the most, of each start


@dataclass(frozen=True, kw_only=True, repr=False)
class LeastSquares(Method, name="least-squares", keeps_curves=True, needs_squares=True):
    """Multistart Gauss-Newton search on a kriging surrogate of the residuals.

    For expensive models and the measures "curve_length" and "sum_of_squares". A start takes 10 to
    20 runs for 3 parameters and 30 to 60 for 8: k + 1 runs for k parameters to begin with, then one
    for every step. For several loops it minimises the weighted sum of squares.

    Parameters
    ----------
    starts : int, optional
        Number of starts that must agree, as for :class:`TrustRegion`.
    most_starts : int, default 10
        Maximum number of starts.
    starts_at_once : int, optional
        Number of starts that run in parallel. The default is one with one worker, and three with
        several. A given number yields bitwise identical results with any number of workers.
    initial_range : float, optional
        Half the size of the first trust region, as a fraction of the bounds' range. The first
        finite differences span half of that. The default is 0.2, or 0.1 if :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        Distance around the best run within which every direction must be sampled before the search
        ends, as a fraction of the bounds' range.
    tol : float, default 1e-3
        Smallest trust region that continues without a geometry-improving step.
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
    C. Cartis, J. Fiala, B. Marteau, L. Roberts, ACM Trans. Math. Softw. 45 (2019) 32.

    Examples
    --------
    >>> from curvewise.calibration import LeastSquares
    >>> LeastSquares(loss="soft_l1", f_scale=0.01)
    LeastSquares(loss='soft_l1', f_scale=0.01)
    """

    starts: int | None = None
    most_starts: int = 10
    starts_at_once: int | None = None
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-5
    loss: Loss = "linear"
    f_scale: float = 1.0

    def __post_init__(self) -> None:
        check_loss(self.loss)
        check_regions(
            self.first_radius, self.diff_step, self.starts, self.most_starts, self.starts_at_once
        )
        if not self.f_scale > 0.0:
            raise ValueError(f"f_scale is {self.f_scale}; it must be above 0")

    @property
    def first_radius(self) -> float:
        """Half the size of the first region."""
        return 0.2 if self.initial_range is None else self.initial_range

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the look around at the end."""
        return (1 if has_start else starts_that_agree(self.starts, parameters)) * (
            2 * parameters + 2
        )

    def near_optimum(self) -> LeastSquares:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=0.1)

    @property
    def rules(self) -> Rules:
        """Settings of each start."""
        return Rules(self.first_radius, self.diff_step, self.tol, self.gain, _STEPS)

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise the sum of squares on surrogates of the residuals, from several starts."""
        inner = SumOfSquares(ledger.objective, bend_of(self.loss, self.f_scale))
        runs = Runs(ledger, inner)
        try:
            finish = yield from searched(
                ledger,
                runs,
                self.rules,
                start=start,
                seed=seed,
                starts=starts_that_agree(self.starts, ledger.dimensions),
                most_starts=self.most_starts,
                at_once=self.starts_at_once or ledger.starts_at_once,
            )
        finally:
            if self.loss != "linear" and runs.values:  # the smallest plain sum is not the aim
                ledger.settle(runs.points[runs.best])
        return finish
