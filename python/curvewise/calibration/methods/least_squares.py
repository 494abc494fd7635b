"""A search for the smallest sum of squares of an expensive model, without derivatives.

Gauss and Newton's method needs the residuals as a function of the parameters; here a surface
through the runs near the best one stands in their place (`surfaces.kriged_surface`): the plane
through the k + 1 runs that the search begins with, bent as later runs ask for. Where the squares of
the surface add up to least, in a region of trust around the best run and within the bounds, is run
next (`surfaces.bounded_squares`). The region grows and shrinks with what a step gains of what was
promised. Where the surface promises no more, the directions in which it knows least are run, one by
one, until it promises something or knows them all; then the search has converged.

A plane that learns from each run forgets how the residuals bend; this surface keeps it, and takes a
quarter fewer runs than planes through the latest k + 1 (benchmarks/validation/README.md). Cost: k +
1 runs to begin with, and one for every step: 10 to 20 for 3 parameters, 20 to 60 for 8 until the
value is within 1 % of the smallest, and some 20 more until that is known.

C. Cartis, J. Fiala, B. Marteau, L. Roberts, "Improving the flexibility and robustness of
model-based derivative-free optimization solvers", ACM Trans. Math. Softw. 45 (2019) 32; S. M. Wild,
"POUNDERS in TAO: solving derivative-free nonlinear least-squares problems", in "Advances and trends
in optimization with engineering applications", SIAM (2017) 529-540.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Course, Ledger
from .method import Method, with_other_defaults
from .robust_losses import Loss, bend_of, check_loss
from .side_by_side import Part, side_by_side
from .squares_descent import SquaresDescent, SquaresRules, SquaresRuns
from .starts import End, are_alike, check_regions, finish_of, hop, places

__all__ = ["LeastSquares"]

# Starts that come down one valley end within a ten-thousandth of each other, since each goes on
# until it would gain a hundred-thousandth. Those that end further apart are in several valleys, and
# where there are several, there may be a lower one.
_SAME_VALLEY = 1e-3


@dataclass(frozen=True, kw_only=True, repr=False)
class LeastSquares(Method, name="least-squares", keeps_curves=True, needs_squares=True):
    """Gauss and Newton's method on a surface of the residuals, within a region of trust.

    For the measures "curve_length" and "sum_of_squares"; of several loops it minimises the weighted
    sum of squares. Local, for expensive models: 20 to 30 runs a start for 3 parameters, 40 to 90
    for 8. It begins with k + 1 runs for k parameters, and takes one for every step.

    Parameters
    ----------
    starts : int, default 3
        From how many places to search where no start is given: from the middle of the bounds, and
        then, side by side, evenly over them. They share their runs, so that one that comes to where
        another has ended takes few.
    most_starts : int, default 6
        As long as starts end more than 1 % apart others follow, up to so many in all, unless
        `starts` of them have come within 1 % of the best. It has converged where all have ended
        within 0.1 %, in one valley.
    initial_range : float, optional
        Half the size of the first region of trust, as a fraction of the bounds' range; the first
        differences are over half of that. By default 0.2, and 0.1 where :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        How far around the best run the surface has to be known in every direction when the search
        ends, as a fraction of the bounds' range.
    tol : float, default 1e-3
        A region of trust that is smaller than this is too small to go on without another look
        around.
    gain : float, default 1e-5
        The search ends where the surface promises to gain no more than this fraction of the value.
    loss : {"linear", "soft_l1", "huber", "cauchy", "arctan"}
        Of scipy.optimize.least_squares, for a robust sum, of which the result is then the minimum.
    f_scale : float, default 1.0
        Residuals above this count less with such a loss, in units of the experiment's height.

    Raises
    ------
    ValueError
        An option that cannot be.

    Notes
    -----
    C. Cartis, J. Fiala, B. Marteau, L. Roberts, ACM Trans. Math. Softw. 45 (2019) 32.

    Examples
    --------
    >>> from curvewise.calibration import LeastSquares
    >>> LeastSquares(loss="soft_l1", f_scale=0.01)
    LeastSquares(loss='soft_l1', f_scale=0.01)
    """

    starts: int = 3
    most_starts: int = 6
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-5
    loss: Loss = "linear"
    f_scale: float = 1.0

    def __post_init__(self) -> None:
        check_loss(self.loss)
        check_regions(self.first_radius, self.diff_step, self.starts, self.most_starts)
        if not self.f_scale > 0.0:
            raise ValueError(f"f_scale is {self.f_scale}; it must be above 0")

    @property
    def first_radius(self) -> float:
        """Half the size of the first region."""
        return 0.2 if self.initial_range is None else self.initial_range

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the look around at the end."""
        return (1 if has_start else self.starts) * (2 * parameters + 2)

    def near_optimum(self) -> LeastSquares:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=0.1)

    @property
    def rules(self) -> SquaresRules:
        """How each start goes on."""
        bend = bend_of(self.loss, self.f_scale)
        return SquaresRules(self.first_radius, self.diff_step, self.tol, self.gain, bend=bend)

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise from a start; where none is given from the middle, and then from elsewhere."""
        starts = _Starts(self, ledger, start, seed)
        try:
            yield from side_by_side(starts.first(), starts.more, ledger.expect)
        finally:
            if self.loss != "linear" and starts.runs.values:  # the smallest sum is not wanted
                ledger.settle(starts.best)
        if not starts.ends:
            raise RuntimeError(
                "simulations fail all around the start; give identify another start=, or closer "
                "bounds"
            )
        return finish_of(starts.ends, starts.begun, starts.runs.negligible, within=_SAME_VALLEY)


class _Starts:
    """Begins with one start; when it has ended with others, and with more where they disagree."""

    def __init__(
        self, options: LeastSquares, ledger: Ledger, start: Array | None, seed: int
    ) -> None:
        self._options, self._given, self._seed = options, start, seed
        self._random = np.random.default_rng(seed)
        self._places = places(ledger.dimensions, self._random)
        self.runs = SquaresRuns(ledger, options.rules)
        self.begun = self._running = 0
        self.ends: list[End] = []

    @property
    def best(self) -> Array:
        """Where the smallest sum is."""
        place: Array = self.runs.points[int(np.argmin(self.runs.values))]
        return place

    def first(self) -> list[Part[None]]:
        """Return the start with which a search begins."""
        return [self._descent(next(self._places) if self._given is None else self._given)]

    def more(self) -> list[Part[None]]:
        """Return those to begin after some have ended."""
        options, ends = self._options, self.ends
        if self._given is not None or self._running:
            return []
        if self.begun < options.starts:
            return [self._descent(next(self._places)) for _ in range(options.starts - self.begun)]
        alike = are_alike(ends, self.runs.negligible) if ends else 0
        if alike in (0, len(ends)) or alike >= options.starts or self.begun >= options.most_starts:
            return []
        if (self.begun - options.starts) % 2:
            return [self._descent(next(self._places))]
        return [self._descent(hop(self.best, self._random))]

    def _descent(self, place: Array) -> Part[None]:
        random = np.random.default_rng((self._seed, self.begun))
        self.begun += 1
        self._running += 1
        return self._ended(SquaresDescent(random, self._options.rules, self.runs).course(place))

    def _ended(self, course: Part[End | None]) -> Part[None]:
        end = yield from course
        self._running -= 1
        if end is not None:
            self.ends.append(end)
