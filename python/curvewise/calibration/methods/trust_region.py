"""Trust-region search: the exact measure on surrogates of the curves.

Read the modules in this order. `multistart` begins starts until enough of them agree (`starts`). A
start is a trust-region method (`descent`). Its steps come from an inner search of the measure
(`surfaces.inner_search`) on a kriging surrogate (`surfaces.kriged_surface`) of the runs (`runs`).
Before a start ends, a global stage (`global_stage`) searches the surrogate for other minima.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from ...curves.inputs import Array
from ..problem.ledger import Course, Ledger
from ..surfaces.inner_search import CurveSearch, InnerSearch
from ..surfaces.steps import SMALL
from .descent import Rules
from .method import NEAR, Method, with_other_defaults
from .multistart import Multistart
from .runs import Runs
from .starts import starts_that_agree

__all__ = ["SurrogateSearch", "TrustRegion"]


@dataclass(frozen=True, kw_only=True, repr=False)
class SurrogateSearch(Method, name="", keeps_curves=True, needs_squares=False):
    """A multistart trust-region search on kriging surrogates; each class has its inner search."""

    first_range: ClassVar[float]  # the default of initial_range

    starts: int | None = None
    most_starts: int = 40
    starts_at_once: int | None = None
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-3
    maxiter: int = 200

    def __post_init__(self) -> None:
        for name, value in (("initial_range", self._radius), ("diff_step", self.diff_step)):
            if not 0.0 < value <= 1.0:
                raise ValueError(f"{name} is {value}; give a fraction of the bounds, such as 0.02")
        for name in ("starts", "most_starts", "starts_at_once"):
            count = getattr(self, name)
            if count is not None and count < 1:
                raise ValueError(f"{name} is {count}; give at least 1")

    @property
    def _radius(self) -> float:
        return self.first_range if self.initial_range is None else self.initial_range

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the directions at the end."""
        starts = 1 if has_start else starts_that_agree(self.starts, parameters)
        return starts * (2 * parameters + 2)

    def near_optimum(self) -> SurrogateSearch:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=NEAR)

    @abstractmethod
    def inner(self, ledger: Ledger) -> InnerSearch:
        """Return what is minimised on the surrogates."""

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise on surrogates, from one start or from several."""
        return self.search(ledger, Runs(ledger, self.inner(ledger)), start, seed)

    def search(self, ledger: Ledger, runs: Runs, start: Array | None, seed: int) -> Course:
        """Return the course on the surrogates of some runs."""
        rules = Rules(self._radius, self.diff_step, self.tol, self.gain, self.maxiter)
        multistart = Multistart(
            ledger,
            runs,
            rules,
            seed=seed,
            starts=starts_that_agree(self.starts, ledger.dimensions),
            most=self.most_starts,
            at_once=self.starts_at_once or ledger.starts_at_once,
        )
        return multistart.course(start)


@dataclass(frozen=True, kw_only=True, repr=False)
class TrustRegion(SurrogateSearch, name="trust-region", keeps_curves=True, needs_squares=False):
    """Multistart trust-region search on a kriging surrogate of the curves.

    For expensive models and any measure. A start takes 10 to 20 runs for 3 parameters and 20 to 40
    for 8, because starts share their runs. It begins with k + 1 runs for k parameters and takes one
    more for every step.

    The search has converged if enough independent starts agree to within 1 % and no unintended
    bound limits the best of them.

    Parameters
    ----------
    starts : int, optional
        Number of starts that must agree if no start is given: the middle of the bounds, and points
        spread evenly over them. The default is half the number of parameters, at least 3. If some
        starts have ended higher, one more must agree, and at least half of all.
    most_starts : int, default 40
        Maximum number of starts.
    starts_at_once : int, optional
        Number of starts that run in parallel. The default is one with one worker, and three with
        several. A given number yields bitwise identical results with any number of workers.
    initial_range : float, optional
        Half the size of the first trust region, as a fraction of the bounds' range. The first
        finite differences span half of that. The default is 0.5, or 0.1 if :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        Distance around the best run within which every direction of the surrogate must be sampled
        before a start ends, as a fraction of the bounds' range.
    tol : float, default 1e-3
        The search ends if the trust region is smaller than this.
    gain : float, default 1e-3
        The search also ends if the predicted reduction is at most this fraction of the value.
    maxiter : int, default 200
        Maximum number of steps of each start.

    Raises
    ------
    ValueError
        If an option is out of its range.

    Notes
    -----
    This is composite optimisation: a surrogate replaces the curves of the model, and the measure of
    the predicted curves is minimised exactly. If the model has a `jacobian`, a plane with its
    derivatives is the surrogate.

    A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000). S. M. Wild, R. G.
    Regis, C. A. Shoemaker, "ORBIT: optimization by radial basis function interpolation in
    trust-regions", SIAM J. Sci. Comput. 30 (2008) 3197-3219.

    Examples
    --------
    >>> from curvewise.calibration import TrustRegion
    >>> TrustRegion(starts=5)
    TrustRegion(starts=5)
    """

    first_range: ClassVar[float] = 0.5

    def closer(self) -> TrustRegion:
        """Return the same for less, in a wider region, to leave a local minimum."""
        return with_other_defaults(self, initial_range=0.3, gain=2e-5, tol=SMALL)

    def inner(self, ledger: Ledger) -> CurveSearch:
        """Return the measure of curves."""
        return CurveSearch(ledger.objective, self.gain, ledger.show_activity)
