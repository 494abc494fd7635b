"""A search for expensive models: the measure is minimised on surfaces of the curves, run by run.

Linear surfaces of the simulated curves (`surfaces`) come from a simplex of k + 1 runs. The
parameters at which the curves that they predict are nearest to the tests, within a region of
trust around the best run, are run next, and the surfaces learn from every run (Broyden's update).
Where a step gains clearly less than they promised, k runs nearby measure the slopes afresh; where
fresh slopes have promised it too, the region shrinks. The search ends when fresh slopes promise
nothing more, nearby or in another minimum that the measure has on these surfaces. With
slopes="fresh" they are measured before every step: for a sum of squares that is Gauss and Newton's
method, and here the exact measure, whichever it is, stands in the place of the squares.

A region that shrank around slopes grown stale was the way this search used to fail: on seven
parameters with noise it halted high up in a valley from 3 of 10 starts that nothing was tuned on,
and from none where slopes are renewed first and other minima of the surfaces are looked at before
the end (benchmarks/validation/README.md). Differences are taken over hundredths of the bounds'
range, not 1e-6 of it: a solver prints seven digits. Cost: k + 1 runs to begin with, k for every
renewal, one for every step; 10 to 170 a start in what we have run. Each start is local, and every
second one ends in another valley than the best (benchmarks/validation/searches.py): `starts` has
how many are made, and when the search may say that it has converged.

C. G. Broyden, "A class of methods for solving nonlinear simultaneous equations", Math. Comp. 19
(1965) 577-593; A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000).
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Course, Ledger
from ..surfaces.nearby_runs import Run
from .descent import Descent, Rules, SharedResponses
from .method import Method, with_other_defaults
from .side_by_side import Part, side_by_side
from .starts import HOP, End, are_alike, check_regions, finish_of, hop, is_flat, places

__all__ = ["TrustRegion"]

_ON_FLAT_GROUND = 3  # times as many starts, where the measure is flat

_log = logging.getLogger("curvewise.calibration")


Slopes = Literal["broyden", "fresh"]


@dataclass(frozen=True, kw_only=True, repr=False)
class TrustRegion(Method, name="trust-region", keeps_curves=True, needs_squares=False):
    """The measure on linear surfaces of the curves, minimised within a region of trust.

    Local, for expensive models and any measure: 10 to 30 runs a start for 3 parameters, 45 to 95
    for 7. Each of three starts begins with k + 1 runs for k parameters, and takes one for every
    step; they go side by side, so that three runs at least can be made at the same time.

    It never says "converged" where starts end more than 1 % apart, where no step has gained
    anything, or where several places have the best value, of a measure that is flat there.

    Parameters
    ----------
    starts : int, default 3
        From how many places to search, side by side, where no start is given: from the middle of
        the bounds, and evenly over them.
    most_starts : int, default 6
        As long as starts end more than 1 % apart others follow, up to so many in all, unless
        `starts` of them have come within 1 % of the best.
    initial_range : float, optional
        Half the size of the first region of trust, as a fraction of the bounds' range; the first
        differences are over half of that. By default 0.5, and 0.1 where :func:`identify_each`
        begins near the end of another search.
    diff_step : float, default 0.02
        The largest difference over which slopes are renewed, as a fraction of the bounds' range.
    tol : float, default 1e-3
        The search ends where the region is smaller than this.
    gain : float, default 1e-3
        And where fresh slopes promise to gain no more than this fraction of the value.
    maxiter : int, default 200
        The most steps, of each start.
    slopes : {"broyden", "fresh"}
        "broyden": of the runs that are made anyway, and renewed by k runs where these mislead.
        "fresh": measured before every step, by k runs, which k workers make at the same time: Gauss
        and Newton's method, for any measure.

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

    starts: int = 3
    most_starts: int = 6
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-3
    maxiter: int = 200
    slopes: Slopes = "broyden"

    def __post_init__(self) -> None:
        if self.slopes not in get_args(Slopes):
            raise ValueError(
                f"slopes is {self.slopes!r}; choose from {', '.join(get_args(Slopes))}"
            )
        check_regions(self.first_radius, self.diff_step, self.starts, self.most_starts)

    @property
    def first_radius(self) -> float:
        """Half the size of the first region."""
        return 0.5 if self.initial_range is None else self.initial_range

    @property
    def rules(self) -> Rules:
        """How each start goes on."""
        return Rules(
            self.first_radius,
            self.diff_step,
            self.tol,
            self.gain,
            self.maxiter,
            self.slopes == "fresh",
        )

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the first simplex, of one step and of the slopes at the end."""
        return (1 if has_start else self.starts) * (2 * parameters + 2)

    def near_optimum(self) -> TrustRegion:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=0.1)

    def closer(self) -> TrustRegion:
        """Return the same for less, in a wider region, to leave a valley of other measures."""
        return with_other_defaults(self, initial_range=0.3, gain=2e-5, tol=1e-4)

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise on surfaces of the curves, from several starts at the same time."""
        starts = _Starts(self, ledger, start, seed)
        yield from side_by_side(starts.first(), starts.more)
        if not starts.ends:
            raise RuntimeError(
                "simulations fail all around the start; give identify another start=, or closer "
                "bounds"
            )
        return finish_of(starts.ends, starts.begun, ledger.negligible)


class _Starts:
    """Begins starts, and more of them where they have ended at different values."""

    def __init__(
        self, options: TrustRegion, ledger: Ledger, start: Array | None, seed: int
    ) -> None:
        self._options, self._ledger, self._seed = options, ledger, seed
        self._given = start
        self._random = np.random.default_rng(seed)
        self._places = places(ledger.dimensions, self._random)
        self._responses = SharedResponses()
        self.begun, self._running = 0, 0
        self.ends: list[End] = []

    def first(self) -> list[Part[None]]:
        """Return the starts with which a search begins."""
        if self._given is not None:
            return [self._descent(self._given, self._options.rules)]
        return [self._next() for _ in range(self._options.starts)]

    def more(self) -> list[Part[None]]:
        """Return those to begin after some have ended."""
        options, ends = self._options, self.ends
        if self._given is not None or len(ends) < 2:
            return []
        alike = are_alike(ends, self._ledger.negligible)
        flat = is_flat(ends, self._ledger.negligible)
        if not flat and (alike == len(ends) or alike >= options.starts):
            return []
        # On flat ground a start is short, and the way down is found by chance.
        most = _ON_FLAT_GROUND * options.most_starts if flat else options.most_starts
        count = min(options.starts - self._running, most - self.begun)
        if count > 0 and self.begun == options.starts:
            _log.info(
                "starts end more than 1 %% apart; up to %d more follow, of some %d runs each",
                most - self.begun,
                len(self._ledger.done) // self.begun,
            )
        return [self._next(flat=flat) for _ in range(count)]

    def _next(self, *, flat: bool = False) -> Part[None]:
        """Begin the next start: beside the best run where it is the turn of a hop."""
        rules = self._options.rules
        later = self.begun - self._options.starts
        if not flat and later >= 0 and later % 2 == 0:
            place = hop(self._ledger.best_unit, self._random)
            smaller = replace(rules, first_radius=min(HOP, rules.first_radius))
            return self._descent(place, smaller, self._ledger.runs_with_curves)
        return self._descent(next(self._places), rules)

    def _descent(self, place: Array, rules: Rules, runs: Sequence[Run] = ()) -> Part[None]:
        random = np.random.default_rng((self._seed, self.begun))
        self.begun += 1
        self._running += 1
        search = Descent(self._ledger, random, rules, self._responses)
        return self._ended(search.course(place, (*self._ledger.earlier_runs, *runs)))

    def _ended(self, course: Part[End | None]) -> Part[None]:
        end = yield from course
        self._running -= 1
        if end is not None:
            self.ends.append(end)
