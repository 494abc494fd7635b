"""A search for expensive models: the measure is minimised on surfaces of the curves, run by run.

A surface of the simulated curves goes through the runs near the best one
(`surfaces.kriged_surface`): the plane through the k + 1 runs that a start begins with, bent as
later runs ask for. The parameters at which the curves that it predicts are nearest to the tests, by
the exact measure, within a region of trust around the best run, are run next. The region grows and
shrinks with what a step gains of what was promised. Where the surface promises nothing more, the
directions in which it knows least are run, all at once; where it knows them all, other minima that
the measure has are tried, and then the start has ended: the small valleys beside the best run, on a
surface through a hundred runs (`surfaces.small_valleys`), and minima that are further away. Where
the model knows its slopes (`jacobian`), the plane of these takes the place of the surface, and no
run is made for it.

All starts share their runs, so that a start that comes to where another has been takes few of its
own: 20 to 60 runs each for 8 parameters. A plane that learns from each run (Broyden's update), and
is measured afresh where it misleads, took twice as many to the same value, and ended above it more
often (benchmarks/validation/README.md). Each start is local, and every second one ends in another
valley than the best: `starts` has how many are made, and when the search may say that it has
converged. By frechet, whose valleys are many, single runs take the place of most of a start's
(`single_runs`), unless the model knows its slopes.

A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000); S. M. Wild, R. G.
Regis, C. A. Shoemaker, "ORBIT: optimization by radial basis function interpolation in
trust-regions", SIAM J. Sci. Comput. 30 (2008) 3197-3219.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from ...curves.inputs import Array
from ..objective.sampling import is_leash
from ..problem.ledger import Course, Ledger
from .curve_descent import CurveDescent, CurveRuns, promising_place
from .descent import Rules
from .method import Method, with_other_defaults
from .side_by_side import Part, side_by_side
from .single_runs import SingleRuns
from .starts import HOP, End, are_alike, check_regions, finish_of, hop, is_flat, places
from .valleys import lowest_valley

__all__ = ["TrustRegion"]

# Starts that have to come to the best value beyond `starts`: of all that there are, and where
# others have ended elsewhere.
_SURE, _NOT_SO = 2, 3
# Times as many starts, where they are short: where the measure is flat, and by the measures whose
# later starts begin with the surfaces of those before.
_OF_SHORT_ONES = 3
# Of those that hop on the same surface, which agree more easily.
_SURE_OF_HOPS = 12
# By frechet, of the first starts and of the later ones; and half the size of the first region in
# which the best run of all is gone down from.
_FIRST_STEPS, _LATER_STEPS, _NEAR = 10, 6, 0.1
# By dtw and frechet a start ends where its surface promises less than this part of what it is above
# the best.
_LEFT_BEHIND = 0.2

_log = logging.getLogger("curvewise.calibration")


Slopes = Literal["from runs", "fresh"]


@dataclass(frozen=True, kw_only=True, repr=False)
class TrustRegion(Method, name="trust-region", keeps_curves=True, needs_squares=False):
    """The measure on linear surfaces of the curves, minimised within a region of trust.

    Local, for expensive models and any measure: 10 to 20 runs a start for 3 parameters, 20 to 40
    for 8, since starts share their runs. Each of the first begins with k + 1 runs for k parameters,
    and takes one for every step; three go side by side, so that three runs at least can be made at
    the same time.

    It never says "converged" where starts end more than 1 % apart, where no step has gained
    anything, or where several places have the best value, of a measure that is flat there.

    Parameters
    ----------
    starts : int, default 3
        From how many places to search, side by side, where no start is given: from the middle of
        the bounds, and evenly over them.
    most_starts : int, default 10
        Others follow until two more than `starts` have ended alike; where some have ended more than
        1 % above the best, until three more have come to it, or so many have been made in all.
        Every second of them begins where a surface through all runs so far promises most, by "dtw"
        near the best run; by "frechet", of models that know their slopes, all of them begin in
        other valleys, as long as the surface promises lower ones. Those do not count as alike.
        Where the model does not know them, they are short and follow one by one by "frechet", each
        and the best run go on by single runs where the surface promises most, and twelve more
        have to end alike. Where the measure is flat, and by these two, there are three times as
        many.
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
    slopes : {"from runs", "fresh"}
        "from runs": of the runs that are made anyway, and of up to k more where these promise
        nothing. "fresh": those around the best run are made before every step, by k workers at the
        same time.

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
    most_starts: int = 10
    initial_range: float | None = None
    diff_step: float = 0.02
    tol: float = 1e-3
    gain: float = 1e-3
    maxiter: int = 200
    slopes: Slopes = "from runs"

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
        yield from side_by_side(starts.first(), starts.more, ledger.expect)
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
        self._runs = CurveRuns(ledger)
        self._is_leash = is_leash(ledger.objective)
        self._is_path = all(measure == "dtw" for measure in ledger.objective.measures)
        # Where the model knows its slopes, a start takes few runs, and these tell more.
        self._is_single = self._is_leash and not ledger.has_slopes
        self._singles = SingleRuns(ledger, self._random, self._runs)
        self._went_on, self._lowest = False, np.inf
        self.begun, self._running = 0, 0
        self.ends: list[End] = []
        self._valleys: list[Array] = []  # in which starts have begun

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
        if self._is_single and (self._running or not self._went_on):
            return [] if self._running else [self._from_best()]
        telling = [end for end in ends if not end.stayed_near]
        alike = are_alike(ends, self._ledger.negligible, telling)
        flat = is_flat(ends, self._ledger.negligible)
        sure = _SURE_OF_HOPS if self._is_single else _SURE if alike == len(telling) else _NOT_SO
        if not flat and alike >= options.starts + sure:
            return []
        # On flat ground a start is short, and the way down is found by chance; and so it is where
        # later starts have the surfaces of those before.
        is_short = flat or self._is_path or self._is_leash
        most = _OF_SHORT_ONES * options.most_starts if is_short else options.most_starts
        at_once = 1 if self._is_single else options.starts - self._running
        count = min(at_once, most - self.begun)
        if count > 0 and self.begun == options.starts and alike < len(telling):
            _log.info(
                "starts end more than 1 %% apart; up to %d more follow, of some %d runs each",
                most - self.begun,
                len(self._ledger.done) // self.begun,
            )
        return [self._next() for _ in range(count)]

    def _next(self) -> Part[None]:
        """Begin the next start: every second of the later ones where the runs so far promise most.

        And beside the best run where they promise nothing but where starts have ended. The valleys
        of dtw have long floors, along which a search comes down slowly: every second start goes on
        near the best run. Of the many valleys of frechet those are begun in that the surface
        promises to be lower, as long as there are any, where the model knows its slopes; where it
        does not, starts are short. By both a start that is far above the best is left behind.
        """
        rules = self._options.rules
        if self._is_single:
            return self._short()
        if self._is_path or self._is_leash:
            rules = replace(rules, left_behind=_LEFT_BEHIND)
        smaller = replace(rules, first_radius=min(HOP, rules.first_radius))
        later = self.begun - self._options.starts
        flat = later >= 0 and is_flat(self.ends, self._ledger.negligible)
        if later >= 0 and self._is_leash and not flat:
            place = self._valley()
            if place is not None:
                return self._descent(place, smaller, stays_near=True)
        elif later >= 0 and later % 2 == 0:
            is_near = self._is_path and not flat
            reach = HOP if is_near else 1.0
            place = promising_place(self._ledger, self._random, self._runs, self.ends, reach)
            if place is None:
                place = hop(self._ledger.best_unit, self._random)
            return self._descent(place, smaller, stays_near=is_near)
        return self._descent(next(self._places), rules)

    def _short(self) -> Part[None]:
        """Begin a start of a few steps; a later one goes on by single runs."""
        rules = self._options.rules
        if self.begun < self._options.starts:
            rules = replace(rules, left_behind=_LEFT_BEHIND)
            if self._options.starts > 1:  # a single start is not followed by single runs
                rules = replace(rules, maxiter=min(rules.maxiter, _FIRST_STEPS))
            return self._descent(next(self._places), rules)
        self._went_on = False
        rules = replace(rules, maxiter=min(rules.maxiter, _LATER_STEPS))
        return self._hopping(self._descent(next(self._places), rules))

    def _hopping(self, start: Part[None]) -> Part[None]:
        """Go on from where a start has ended, by single runs."""
        before = len(self.ends)
        yield from start
        if len(self.ends) > before:
            end = self.ends[-1]
            place, value = yield from self._singles.from_own(end.place, end.value, _LEFT_BEHIND)
            self.ends[-1] = end._replace(place=place, value=value)

    def _from_best(self) -> Part[None]:
        """Go on from the best run, by single runs, and to the bottom of its valley.

        As the start whose best run it is.
        """
        self._went_on = True
        bottom = (1.0 - self._options.gain) * self._lowest
        is_at_bottom = yield from self._singles.from_best(bottom)
        number = min(range(len(self.ends)), key=lambda i: self.ends[i].value)
        end = self.ends[number]
        if is_at_bottom and self._ledger.best.value < bottom:
            rules = replace(
                self._options.rules, first_radius=min(_NEAR, self._options.first_radius)
            )
            random = np.random.default_rng((self._seed, self.begun, 1))
            descent = CurveDescent(self._ledger, random, rules, self._runs)
            end = end._replace(finish=(yield from descent.from_best()))
            self._lowest = self._ledger.best.value
        self.ends[number] = end._replace(
            value=self._ledger.best.value, place=self._ledger.best_unit
        )

    def _valley(self) -> Array | None:
        """Return where another valley promises to be lower than all runs, if one does."""
        place = lowest_valley(
            self._ledger, self._random, self._runs, self.ends, self._valleys, self._options.gain
        )
        if place is not None:
            self._valleys.append(place)
        return place

    def _descent(self, place: Array, rules: Rules, *, stays_near: bool = False) -> Part[None]:
        random = np.random.default_rng((self._seed, self.begun))
        self.begun += 1
        self._running += 1
        descent = CurveDescent(self._ledger, random, rules, self._runs)
        return self._ended(descent.course(place), stays_near)

    def _ended(self, course: Part[End | None], stays_near: bool) -> Part[None]:
        end = yield from course
        self._running -= 1
        if end is not None:
            self.ends.append(end._replace(stayed_near=stays_near))
