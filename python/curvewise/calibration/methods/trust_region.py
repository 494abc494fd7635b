"""A search for expensive models: the exact measure on a surrogate of the curves, run by run.

Composite optimisation: the model is expensive and smooth, the measure is cheap and has kinks. So a
surrogate stands for the simulated curves, and the measure of what it predicts is minimised exactly.
In the order in which to read: `multistart` begins starts until enough of them agree; a start is a
trust-region method (`descent`) whose steps come from an inner search of the measure
(`surfaces.inner_search`) on a kriging surrogate (`surfaces.kriged_surface`) of the runs (`runs`);
before a start ends, a global stage (`global_stage`) looks for other minima on the surrogate. Where
the model knows its derivatives (`jacobian`), their plane takes the place of the surrogate.

A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000); S. M. Wild, R. G.
Regis, C. A. Shoemaker, "ORBIT: optimization by radial basis function interpolation in
trust-regions", SIAM J. Sci. Comput. 30 (2008) 3197-3219.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...curves.inputs import Array
from ..problem.ledger import Course, Ledger
from ..surfaces.inner_search import CurveSearch
from .descent import Rules
from .method import Method, with_other_defaults
from .multistart import searched
from .runs import Runs
from .starts import check_regions, starts_that_agree

__all__ = ["TrustRegion"]


@dataclass(frozen=True, kw_only=True, repr=False)
class TrustRegion(Method, name="trust-region", keeps_curves=True, needs_squares=False):
    """Multistart trust-region search on a kriging surrogate of the curves.

    For expensive models and any measure: 10 to 20 runs a start for 3 parameters, 20 to 40 for 8,
    since starts share their runs. A start begins with k + 1 runs for k parameters, and takes one
    for every step.

    It has converged where so many independent starts agree to 1 %, and no unmeant bound holds the
    best of them.

    Parameters
    ----------
    starts : int, optional
        How many starts have to agree, where no start is given: from the middle of the bounds, and
        evenly over them. By default half of the number of parameters, and at least 3. Where some
        have ended higher, one more has to, and half of all.
    most_starts : int, default 30
        The most starts.
    starts_at_once : int, optional
        How many are made side by side: by default one with one worker, and three with several. A
        number gives the same result, bit for bit, with any number of workers.
    initial_range : float, optional
        Half the size of the first region of trust, as a fraction of the bounds' range; the first
        differences are over half of that. By default 0.5, and 0.1 where :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        How far around the best run the surrogate has to be known in every direction when a start
        ends, as a fraction of the bounds' range.
    tol : float, default 1e-3
        The search ends where the region is smaller than this.
    gain : float, default 1e-3
        And where the surrogate promises to gain no more than this fraction of the value.
    maxiter : int, default 200
        The most steps, of each start.

    Raises
    ------
    ValueError
        An option that cannot be.

    Notes
    -----
    A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000).

    Examples
    --------
    >>> from curvewise.calibration import TrustRegion
    >>> TrustRegion(starts=5)
    TrustRegion(starts=5)
    """

    starts: int | None = None
    most_starts: int = 30
    starts_at_once: int | None = None
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-3
    maxiter: int = 200

    def __post_init__(self) -> None:
        check_regions(
            self.first_radius, self.diff_step, self.starts, self.most_starts, self.starts_at_once
        )

    @property
    def first_radius(self) -> float:
        """Half the size of the first region."""
        return 0.5 if self.initial_range is None else self.initial_range

    @property
    def rules(self) -> Rules:
        """How each start goes on."""
        return Rules(self.first_radius, self.diff_step, self.tol, self.gain, self.maxiter)

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the directions at the end."""
        return (1 if has_start else starts_that_agree(self.starts, parameters)) * (
            2 * parameters + 2
        )

    def near_optimum(self) -> TrustRegion:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=0.1)

    def closer(self) -> TrustRegion:
        """Return the same for less, in a wider region, to leave a local minimum."""
        return with_other_defaults(self, initial_range=0.3, gain=2e-5, tol=1e-4)

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise on surrogates of the curves, from several starts."""
        inner = CurveSearch(ledger.objective, self.gain, ledger.show_activity)
        return searched(
            ledger,
            Runs(ledger, inner),
            self.rules,
            start=start,
            seed=seed,
            starts=starts_that_agree(self.starts, ledger.dimensions),
            most_starts=self.most_starts,
            at_once=self.starts_at_once or ledger.starts_at_once,
        )
