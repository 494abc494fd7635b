"""Where the curves that surfaces predict are nearest to the tests: the inner work of a search.

A search on surfaces asks this after every few runs, so it decides how long a search takes beside
the model. Three things keep that short. The search goes along gradients: those of the measure with
its path held, times the slopes of the surfaces. Tests and simulations of thousands of points are
thinned to some hundreds first. And only from what that has found does the exact measure, with all
points, go on, for a few evaluations. What comes out is never worse than the centre, by the exact
measure.

Cost: some 50 to 100 evaluations of the measure on thinned curves and 10 on all points, and 40 k
more for k parameters where a simplex search confirms the minimum. For measures without a gradient
(pcm, functions, and frechet, whose gradient is that of one point alone) differences and a simplex
search take their place, some 50 k evaluations; `leash_minimum` does better by frechet.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from inspect import signature

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ...curves.thinning import Rows
from ..objective.objective import Objective
from .nelder_mead import nelder_mead
from .nonsmooth_descent import nonsmooth_descent
from .small_valleys import lowest_beside
from .surfaces import Responses, Surface

__all__ = ["SurfaceMinimum"]

# Of thinned curves; those of up to half as many again are taken as they are. The minimum of thinned
# curves is that of all points to some 1e-3 of the value: for less they have more points.
_MOST_POINTS, _MORE_POINTS, _LESS = 400, 1600, 1e-3
_MOST, _POLISHING = 150, 8  # evaluations with a gradient, and those after thinned curves
# Without one, for each parameter; and those after thinned curves.
_SIMPLEX, _POLISHING_SIMPLEX = 40, 5
_OF_NEGLIGIBLE = 1e-4
_PLACES = 4  # from which to search elsewhere
_NEAR = 0.1  # of points to avoid, along any axis
_MEMBERS, _GENERATIONS = 8, 25  # of a population that does, per parameter


class SurfaceMinimum:
    """Minimises an objective on surfaces of its curves.

    Parameters
    ----------
    objective : Objective
        Of the tests.
    responses : Responses
        What the surfaces stand for.
    random : numpy.random.Generator
        For the simplex search.
    show_activity : callable
        Called before every evaluation on predicted curves, to show that something moves.
    gain : float
        The smallest gain that counts, as a fraction of the value.
    """

    def __init__(
        self,
        objective: Objective,
        responses: Responses,
        random: np.random.Generator,
        show_activity: Callable[[], None],
        gain: float = _LESS,
    ) -> None:
        self._random, self._gain = random, gain
        # Of squares the root counts, and a step on the surfaces costs little.
        self._negligible = _OF_NEGLIGIBLE * objective.negligible
        self._exact = _Predicted(objective, responses, None, show_activity)
        self._thinned: _Predicted | None = None
        if not objective.can_be_thinned:
            return
        most = _MORE_POINTS if gain < _LESS else _MOST_POINTS
        rows = responses.thinned_rows(most)
        thinned = objective.thinned(most)
        if thinned is not None or rows is not None:
            self._thinned = _Predicted(thinned or objective, responses, rows, show_activity)

    def lowest(
        self,
        surfaces: Surface,
        centre: Array,
        region: tuple[Array, Array],
        *,
        thoroughly: bool = False,
    ) -> Array:
        """Return where in a box around a centre the surfaces are lowest.

        Parameters
        ----------
        surfaces, centre, region
            What is minimised, where to begin, and the box, (low, high).
        thoroughly : bool
            Whether a simplex search has to confirm what gradients have found on thinned curves:
            before a search says that there is nothing left to gain. It always does where
            gradients alone promise too little, for they halt at kinks.
        """
        low, high = region
        width = high - low
        start = (centre - low) / np.where(width > 0, width, 1.0)
        value = self._exact.on(surfaces, region)
        if self._thinned is not None:
            best = self._minimised(self._thinned, surfaces, region, start, thoroughly)
            if value(best) < value(start):
                return low + self._polished(surfaces, region, best) * width
        elif not thoroughly and self._exact.has_gradient:
            best = self._minimised(self._exact, surfaces, region, start, thoroughly)
            if value(best) < (1.0 - self._gain) * value(start):
                return low + best * width
        # Where gradients alone have halted, at a kink maybe, or thinned curves mislead: noise has a
        # length, which pcm measures.
        return low + self._minimised(self._exact, surfaces, region, start, True) * width

    def elsewhere(
        self,
        surfaces: Surface,
        region: tuple[Array, Array],
        *,
        places: int = _PLACES,
        avoid: Sequence[Array] = (),
    ) -> Array | None:
        """Return the lowest of what is found from places that are drawn in the box.

        A measure may have several minima on surfaces that are linear. Those within _NEAR of points
        to avoid are left out; None is returned where there are no others.
        """
        low, high = region
        predicted = self._thinned or self._exact
        function = predicted.on(surfaces, region)
        if predicted.has_gradient:
            found = [
                self._minimised(predicted, surfaces, region, place, thoroughly=False)
                for place in self._random.random((places, low.size))
            ]
        else:
            found = [self._over_the_box(function, low.size)]
        found = [
            place
            for place in found
            if all(np.abs(low + place * (high - low) - p).max() > _NEAR for p in avoid)
        ]
        if not found:
            return None
        best = min(found, key=function)
        if self._thinned is not None:
            best = self._polished(surfaces, region, best)
        return low + best * (high - low)

    def beside(self, surface: Surface, centre: Array, slopes: Array) -> Array:
        """Return the lowest of the small valleys beside a place, over the whole cube.

        Of tests that are thinned, those of the thinned ones, which noise may put elsewhere.

        Parameters
        ----------
        surface, centre
            What is minimised, and where to begin.
        slopes : ndarray, shape (m, k)
            Of the surface there, in units in which all coordinates count alike.
        """
        cube = np.zeros(centre.size), np.ones(centre.size)
        function = (self._thinned or self._exact).on(surface, cube)
        best = lowest_beside(function, centre, slopes, self._random)
        return best if self._thinned is None else self._polished(surface, cube, best)

    def _over_the_box(self, function: Callable[[Array], float], k: int) -> Array:
        """Minimise a function that is flat or stepped in places, over the whole unit cube."""
        differential_evolution = required("scipy.optimize").differential_evolution
        # scipy 1.15 renamed `seed`; a Generator means the same under both names.
        seed = "rng" if "rng" in signature(differential_evolution).parameters else "seed"
        result = differential_evolution(
            function,
            [(0.0, 1.0)] * k,
            popsize=_MEMBERS,
            maxiter=_GENERATIONS,
            polish=False,
            **{seed: self._random},
        )
        return self._simplex(function, np.clip(result.x, 0.0, 1.0), _SIMPLEX)

    def value(self, surfaces: Surface, point: Array) -> float:
        """Return the objective that surfaces predict at a point, with all points."""
        return self._exact.value(surfaces.at(point))

    def _minimised(
        self,
        predicted: _Predicted,
        surfaces: Surface,
        region: tuple[Array, Array],
        start: Array,
        thoroughly: bool,
    ) -> Array:
        """Minimise in the box, as a unit cube."""
        function = predicted.on(surfaces, region)
        if not predicted.has_gradient:
            result = required("scipy.optimize").minimize(
                function,
                start,
                method="L-BFGS-B",
                bounds=[(0.0, 1.0)] * start.size,
                options={"eps": 1e-4, "maxiter": 30, "ftol": 1e-6},
            )
            return self._simplex(function, np.clip(result.x, 0.0, 1.0), _SIMPLEX)
        descend = partial(
            nonsmooth_descent,
            predicted.with_gradient_on(surfaces, region),
            negligible=self._negligible,
            most=_MOST,
        )
        best = descend(start)
        if not thoroughly:
            return best
        return descend(self._simplex(function, best, _SIMPLEX))

    def _polished(self, surfaces: Surface, region: tuple[Array, Array], start: Array) -> Array:
        """Go on from where thinned curves have led, with all points, for a few evaluations."""
        if not self._exact.has_gradient:
            return self._simplex(self._exact.on(surfaces, region), start, _POLISHING_SIMPLEX)
        function = self._exact.with_gradient_on(surfaces, region)
        return nonsmooth_descent(function, start, negligible=self._negligible, most=_POLISHING)

    def _simplex(self, function: Callable[[Array], float], start: Array, evaluations: int) -> Array:
        k = start.size
        best, _, _ = nelder_mead(
            function,
            start,
            (np.zeros(k), np.ones(k)),
            self._random,
            negligible=self._negligible,
            size=0.05,
            restarts=0,
            xatol=1e-3,
            fatol=max(self._negligible, 1e-4 * function(start)),
            maxfev=evaluations * k,
        )
        return best


class _Predicted:
    """An objective of the curves that surfaces predict, of all their points or of some rows."""

    def __init__(
        self,
        objective: Objective,
        responses: Responses,
        rows: list[Rows] | None,
        show_activity: Callable[[], None],
    ) -> None:
        self._objective, self._show_activity = objective, show_activity
        self._responses = responses if rows is None else responses.of_rows(rows)
        self._places = None if rows is None else responses.places_of_rows(rows)
        self.has_gradient = objective.has_gradient

    def value(self, vector: Array) -> float:
        """Return the objective of curves as one vector."""
        self._show_activity()
        return self._objective.predicted(self._responses.curves(vector)).value

    def on(self, surfaces: Surface, region: tuple[Array, Array]) -> Callable[[Array], float]:
        """Return the objective as a function of a place in a box, which counts as a unit cube."""
        low, high = region
        seen = surfaces.of_places(self._places)
        return lambda place: self.value(seen.at(low + np.clip(place, 0.0, 1.0) * (high - low)))

    def with_gradient_on(
        self, surfaces: Surface, region: tuple[Array, Array]
    ) -> Callable[[Array], tuple[float, Array]]:
        """Return the same with its gradient."""
        low, high = region
        width = high - low
        seen = surfaces.of_places(self._places)

        def function(place: Array) -> tuple[float, Array]:
            self._show_activity()
            vector, chain_rule = seen.with_chain_rule(low + place * width)
            value, gradients = self._objective.value_and_gradient(self._responses.curves(vector))
            by_coordinate = np.concatenate([gradient.ravel() for gradient in gradients])
            return value, chain_rule(by_coordinate) * width

        return function
