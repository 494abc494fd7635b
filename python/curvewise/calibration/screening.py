"""Morris screening: elementary effects of the parameters over their bounds.

Starting at a random place, the parameters change one after the other, in random order, by two
thirds of their range. The move of every loop due to one of these changes is an elementary effect.
The mean of the effects shows whether the loops are sensitive to the parameter anywhere. Their
deviation shows whether the effect depends on the place and on the other parameters.
`Uncertainty.sensitivities` gives the same at the optimum alone. Cost: k + 1 runs of the model for
each path, with k parameters.

M. D. Morris, "Factorial sampling plans for preliminary computational experiments", Technometrics 33
(1991) 161-174. F. Campolongo, J. Cariboni, A. Saltelli, "An effective screening design for
sensitivity analysis of large models", Environmental Modelling & Software 22 (2007) 1509-1518 (the
mean of absolute effects).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ..curves.inputs import Array
from ..curves.several_curves import points_of
from ..drawing.effects import elementary_effects
from ..showing.result import Result, Table
from .answers.identification import Identification
from .surfaces.surfaces import Responses

if TYPE_CHECKING:
    from ..drawing.picture import Picture

__all__ = ["Screening", "screening"]

_STEP = 2.0 / 3.0  # of four levels 0, 1/3, 2/3 and 1, as Morris has it


@dataclass(frozen=True, eq=False)
class Screening(Result):
    """Result of `screening`.

    Attributes
    ----------
    names : tuple of str
        The parameters.
    titles : tuple of str
        The names of the loops.
    means : ndarray, shape (loops, k)
        The mean over the paths of the root mean square move of each loop as a parameter spans its
        bounds, in units of the loop's bounding box.
    deviations : ndarray, shape (loops, k)
        The deviation of these moves between places.
    runs, failed : int
        The number of runs of the model, and how many of them failed.
    """

    names: tuple[str, ...]
    titles: tuple[str, ...]
    means: Array = field(repr=False)
    deviations: Array = field(repr=False)
    runs: int
    failed: int

    picture_shows = "The mean effect of every parameter, and how it differs from place to place"

    def parts(self) -> Sequence[Table | str]:
        """Return the effects, the largest first."""
        order = np.argsort(-self.means.max(axis=0), kind="stable")
        rows = [
            [
                self.names[i],
                *(
                    f"{100.0 * mean:.3g} ± {100.0 * deviation:.2g}"
                    for mean, deviation in zip(self.means[:, i], self.deviations[:, i], strict=True)
                ),
            ]
            for i in order
        ]
        header = ["parameter", *(f"{title}, % of its box" for title in self.titles)]
        return [Table(rows, header), f"{self.runs} runs of the model, {self.failed} failed"]

    def plot(self) -> Picture:
        """Return a matplotlib Figure: mean and deviation of the effects, a panel for every loop.

        Raises
        ------
        ImportError
            If matplotlib is missing: ``pip install "curvewise[plot]"``.
        """
        return elementary_effects(self.names, self.titles, self.means, self.deviations)


def screening(found: Identification, *, paths: int = 10, seed: int = 0) -> Screening:
    """Estimate the effect of every parameter over the whole of its bounds.

    Parameters
    ----------
    found : Identification
        The result of a search; its model, tests, bounds, store and workers are used.
    paths : int, default 10
        Number of places from which the parameters are changed, at least 4.
    seed : int, default 0
        Seed of the places.

    Returns
    -------
    Screening
        Prints as a table, plots itself.

    Raises
    ------
    ValueError
        If `paths` is below 4. If, for some parameter, two consecutive runs never succeeded.

    Notes
    -----
    `paths` (k + 1) runs for k parameters, in one batch. M. D. Morris, Technometrics 33 (1991)
    161-174.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import identify, screening
    >>> x = np.linspace(0, 1, 20)
    >>> def line(p):
    ...     return np.column_stack((x, p["slope"] * x + 0.01 * p["offset"]))
    >>> bounds = {"slope": (0, 10), "offset": (0, 10)}
    >>> found = identify(line, line({"slope": 2.0, "offset": 1.0}), bounds, progress=False)
    >>> effects = screening(found, paths=4)
    >>> bool(effects.means[0, 0] > 10 * effects.means[0, 1])
    True
    """
    if paths < 4:
        raise ValueError(f"paths is {paths}; give at least 4")
    problem = found.problem
    k = len(problem.space.names)
    random = np.random.default_rng(seed)
    orders = [random.permutation(k) for _ in range(paths)]
    places = np.array([_path(order, random) for order in orders]).reshape(-1, k)
    vectors, responses, runs = _responses(found, places)
    moves: list[list[Array]] = [[] for _ in range(k)]
    for path, order in enumerate(orders):
        for step, parameter in enumerate(order):
            one, other = vectors[path * (k + 1) + step], vectors[path * (k + 1) + step + 1]
            if one is not None and other is not None:
                curves = responses.curves((other - one) / _STEP)
                extents = problem.objective.extents
                pairs = zip(curves, extents, strict=True)
                moves[parameter].append(np.array([_rms(curve / size) for curve, size in pairs]))
    for name, several in zip(problem.space.names, moves, strict=True):
        if len(several) < 2:
            raise ValueError(f"too few runs succeeded to say what {name} does; give more paths")
    return Screening(
        problem.space.names,
        tuple(problem.objective.titles),
        np.column_stack([np.mean(several, axis=0) for several in moves]),
        np.column_stack([np.std(several, axis=0, ddof=1) for several in moves]),
        runs,
        sum(vector is None for vector in vectors),
    )


def _path(order: np.ndarray[Any, np.dtype[np.int64]], random: np.random.Generator) -> Array:
    """Return k + 1 places; each differs from the previous one in one parameter."""
    place = random.integers(0, 2, order.size) / 3.0
    place = np.where(random.random(order.size) < 0.5, place, 1.0 - place)
    places = [place]
    for parameter in order:
        place = place.copy()
        place[parameter] += _STEP if place[parameter] < 0.5 else -_STEP
        places.append(place)
    return np.array(places)


def _responses(found: Identification, places: Array) -> tuple[list[Array | None], Responses, int]:
    """Return the curves at places, None where a run fails, and how many runs were made."""
    problem, responses = found.problem, Responses(found.simulations)
    vectors: list[Array | None] = [None] * len(places)
    parameters = [problem.space.dictionary(problem.space.point(place)) for place in places]
    with found.execution.simulator(problem.model) as simulator:
        for i, outcome in simulator.run(parameters):
            if (
                not outcome.message
                and not problem.objective.predicted(outcome.simulations).failures
            ):
                vectors[i] = responses.vector(points_of(outcome.simulations))
        runs = simulator.runs
    return vectors, responses, runs


def _rms(points: Array) -> float:
    """Return the root mean square of the lengths of vectors, shape (n, d)."""
    return float(np.sqrt(np.mean((points**2).sum(axis=1))))
