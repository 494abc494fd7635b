"""One search for the smallest sum of squares, from one start: `least_squares` says how it goes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Finish, Ledger
from ..records.evaluation import Evaluation
from ..surfaces.bounded_squares import ResidualsAndSlopes, squares_minimum
from ..surfaces.residual_surface import ResidualSurface
from .robust_losses import Bend
from .side_by_side import Part
from .starts import End, simplex_around

__all__ = ["SharedRuns", "SquaresDescent", "SquaresRules"]

# Of what was promised, a step that gains less than _POOR has failed; from _GOOD on the region
# grows.
_POOR, _FAIR, _GOOD = 0.1, 0.3, 0.7
_NEAREST = 30  # runs that make a surface, at most; 3 k + 3 where that is more
_FAR = 5.0
_DIFFERENCE = 1e-6  # of a place in the unit cube, along slopes that the model knows
# Of what is negligible elsewhere: near a perfect fit squares are smaller than distances.
_OF_SQUARES = 1e-3
_MOST_STEPS = 500
# The surface is known around the best run if in every direction the runs within _AROUND times the
# difference are spread by this much, in squares of the difference.
_AROUND, _SPREAD = 3.0, 0.3
# A surface that has learnt more deserves trust again, so many times as far.
_AFTER_LOOK = 5.0
# An end where steps gain nothing of what is promised is none if that is more than this fraction.
_PROMISING = 0.01


@dataclass(frozen=True)
class SquaresRules:
    """How a search goes on; as the options of `LeastSquares` of the same names.

    Attributes
    ----------
    first_radius, diff_step, tol, gain : float
    bend : callable, optional
        Of a robust sum.
    """

    first_radius: float
    diff_step: float
    tol: float
    gain: float
    bend: Bend | None


class SharedRuns:
    """The runs of all starts that have succeeded: where they are, and their residuals."""

    def __init__(self, ledger: Ledger, rules: SquaresRules) -> None:
        self._ledger, self._rules = ledger, rules
        self.has_slopes = ledger.has_slopes
        self._rows: dict[tuple[float, ...], int] = {}
        self.points = np.empty((0, ledger.dimensions))
        self.residuals: list[Array] = []
        self._simulations: list[tuple[Array, ...]] = []
        self._slopes: dict[int, Array] = {}
        self.values: list[float] = []
        for point, run in ledger.earlier_runs:
            self.add(point, run)

    @property
    def negligible(self) -> float:
        """Differences of the sum below this do not count; curve_length is the root of one."""
        objective = self._ledger.objective
        if not objective.is_least_squares:
            return objective.negligible**2
        return _OF_SQUARES * objective.negligible

    def number(self, point: Array) -> int | None:
        """Return the number here of the run at a point; None where there is none."""
        return self._rows.get(tuple(point))

    def add(self, point: Array, run: Evaluation) -> int | None:
        """Take a run in; return its number here, or None of one that has failed."""
        if run.failed:
            return None
        place = tuple(point)
        if place not in self._rows:
            self._rows[place] = len(self.values)
            residuals = self._ledger.objective.residuals(run.simulations)
            self.points = np.vstack((self.points, point))
            self.residuals.append(residuals)
            self._simulations.append(run.simulations or ())
            self.values.append(self.value(residuals))
        return self._rows[place]

    def value(self, residuals: Array) -> float:
        """Return what is minimised."""
        if self._rules.bend is not None:
            residuals, _ = self._rules.bend(residuals)
        return float(residuals @ residuals)

    def slopes(self, number: int) -> Array | None:
        """Return the slopes of the residuals of a run, where the model knows those of its curves.

        Of shape (m, k). Residuals are differentiated along these, which takes no runs.
        """
        if number not in self._slopes:
            by_curve = self._ledger.slopes(self.points[number])
            if by_curve is None:
                return None
            columns = range(self.points.shape[1])
            self._slopes[number] = np.column_stack(
                [self._along([slopes[..., i] for slopes in by_curve], number) for i in columns]
            )
        return self._slopes[number]

    def _along(self, directions: list[Array], number: int) -> Array:
        """Return the derivative of the residuals of a run as its curves move."""
        ahead, behind = (
            self._ledger.objective.residuals(
                [
                    curve + step * direction
                    for curve, direction in zip(self._simulations[number], directions, strict=True)
                ]
            )
            for step in (_DIFFERENCE, -_DIFFERENCE)
        )
        derivative: Array = (ahead - behind) / (2.0 * _DIFFERENCE)
        return derivative

    def least_known(self, centre: Array, reach: float) -> list[Array]:
        """Return the directions in which the runs around a point are spread too little, if any.

        As unit vectors, that in which they are spread least first.
        """
        offsets = (self.points - centre) / reach
        offsets = offsets[np.abs(offsets).max(axis=1) <= _AROUND]
        spread, directions = np.linalg.eigh(offsets.T @ offsets)
        return list(directions.T[spread < _SPREAD])

    def surface(self, number: int, most: int, within: float) -> ResidualsAndSlopes:
        """Return the surface through the runs nearest to one, or the plane of its slopes."""
        centre, slopes = self.points[number], self.slopes(number)
        if slopes is None:
            return self._bent(self._through_runs(centre, most, within))
        base = self.residuals[number]
        return self._bent(lambda point: (base + slopes @ (point - centre), slopes))

    def _through_runs(self, centre: Array, most: int, within: float) -> ResidualsAndSlopes:
        distances = np.abs(self.points - centre).max(axis=1)
        near = np.argsort(distances, kind="stable")[:most]
        least = 2 * centre.size + 1
        near = near[: max(least, int(np.sum(distances[near] <= within)))]
        residuals = np.array([self.residuals[i] for i in near])
        reduced = self._rules.bend is None
        return ResidualSurface(self.points[near], residuals, centre, reduced=reduced)

    def _bent(self, surface: ResidualsAndSlopes) -> ResidualsAndSlopes:
        """Return a surface of what is squared and added up."""
        bend = self._rules.bend
        if bend is None:
            return surface

        def bent_surface(point: Array) -> tuple[Array, Array]:
            plain, slopes = surface(point)
            bent, derivatives = bend(plain)
            return bent, derivatives[:, np.newaxis] * slopes

        return bent_surface


class SquaresDescent:
    """The best run of one start, and the region around it in which surfaces are trusted."""

    def __init__(
        self,
        random: np.random.Generator,
        rules: SquaresRules,
        runs: SharedRuns,
    ) -> None:
        self._random, self._rules, self._runs = random, rules, runs
        self._best: int | None = None
        self._tried: set[tuple[float, ...]] = set()

    @property
    def value(self) -> float:
        """The smallest sum so far."""
        return np.inf if self._best is None else self._runs.values[self._best]

    @property
    def centre(self) -> Array:
        """Where it is."""
        assert self._best is not None
        point: Array = self._runs.points[self._best]
        return point

    def course(self, start: Array) -> Part[End | None]:
        """Go down from a start; return how it ended, or None where simulations fail around it."""
        radius = self._rules.first_radius
        simplex = simplex_around(start, radius / 2.0, self._random)
        if self._runs.has_slopes or not self._runs.least_known(start, radius / 2.0):
            yield from self._run(start[np.newaxis])
        if self._best is None:
            yield from self._run(np.vstack((start, simplex)))
        if self._best is None:
            return None
        number = self._runs.number(start)
        before = self.value if number is None else self._runs.values[number]
        finish = yield from self._descended()
        return End(before, self.value, self.centre, finish)

    def _descended(self) -> Part[Finish]:
        radius = self._rules.first_radius
        for _ in range(_MOST_STEPS):
            candidate, promised = self._lowest(radius)
            least = max(self._runs.negligible, self._rules.gain * self.value)
            if promised <= least or radius < self._rules.tol:
                unknown = None if self._runs.has_slopes else next(self._unknown(radius), None)
                if unknown is None:
                    return self._end(promised, least)
                yield from self._run(unknown[np.newaxis])
                radius = max(radius, _AFTER_LOOK * self._reach(radius))
                continue
            length = float(np.abs(candidate - self.centre).max())
            before = self.value
            yield from self._run(candidate[np.newaxis])
            ratio = (before - self._last) / promised
            if ratio >= _GOOD:
                radius = min(1.0, max(radius, 2.0 * length))
            elif ratio < _POOR:
                radius = 0.5 * length
            elif ratio < _FAIR:
                radius = 0.7 * length
        return Finish(False, f"{_MOST_STEPS} steps")

    def _run(self, points: Array) -> Part[None]:
        """Run points, and move to the best of them if it is better than all before."""
        self._last = np.inf
        self._tried.update(tuple(point) for point in points)
        for point, run in zip(points, (yield points), strict=True):
            number = self._runs.add(point, run)
            if number is not None:
                self._last = self._runs.values[number]
                if self._last < self.value:
                    self._best = number

    def _lowest(self, radius: float) -> tuple[Array, float]:
        """Return where the surface is lowest within the region, and the gain that it promises."""
        centre = self.centre
        assert self._best is not None
        surface = self._runs.surface(self._best, max(_NEAREST, 3 * centre.size + 3), _FAR * radius)
        low, high = np.clip(centre - radius, 0.0, 1.0), np.clip(centre + radius, 0.0, 1.0)
        point = squares_minimum(surface, centre, low, high)
        residuals, _ = surface(point)
        return point, self.value - float(residuals @ residuals)

    def _reach(self, radius: float) -> float:
        """Return how far around the best run the surface has to be known."""
        return float(np.clip(radius, self._rules.tol, self._rules.diff_step))

    def _end(self, promised: float, least: float) -> Finish:
        if promised <= least:
            return Finish(True, f"the surface promises to gain less than {least:.2g}")
        region = f"the region is below {self._rules.tol:g} of the bounds' range"
        if promised <= _PROMISING * self.value:
            return Finish(True, region)
        return Finish(False, f"{region}, and steps do not gain what the surface promises")

    def _unknown(self, radius: float) -> Iterator[Array]:
        """Yield points around the best run from which the surface would learn most, if any would.

        They lie in the direction in which the runs around it are spread least; where runs have
        failed there, on the other side or nearer.
        """
        centre, reach = self.centre, self._reach(radius)
        for direction in self._runs.least_known(centre, reach):
            axis = int(np.argmax(np.abs(direction)))
            along = reach / abs(direction[axis]) * direction
            inwards = np.zeros_like(along)  # where a corner of the bounds leaves no room for it
            inwards[axis] = reach if centre[axis] < 0.5 else -reach
            for step in (along, -along, along / 4.0, -along / 4.0, inwards):
                point = centre + step
                is_inside = (point >= 0.0).all() and (point <= 1.0).all()
                if is_inside and tuple(point) not in self._tried:
                    yield point
