"""Where later starts by frechet begin if slopes are known: in other valleys of all runs' surface.

The Fréchet distance has many valleys beside each other, one for each way to couple the few points
that decide, and a start ends in the next one. The curves themselves bend little, so that a surface
through all runs tells the valleys beside each other before the model is run there: hops are made on
it (`LeashMinimum.valley`), from the lowest place so far, and every third from where another start
has ended. A start begins where that promises most. What the surface has wrong the start's runs
mend, so that what is promised once more, and is not there, is not tried again. Cost: 5,000
evaluations of the measure for each start, and no run.

D. J. Wales, J. P. K. Doye, "Global optimization by basin-hopping and the lowest energy structures
of Lennard-Jones clusters containing up to 110 atoms", J. Phys. Chem. A 101 (1997) 5111-5116.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...curves.inputs import Array
from ..problem.ledger import Ledger
from ..surfaces.leash_minimum import LeashMinimum
from .curve_descent import CurveRuns
from .starts import End

__all__ = ["lowest_valley"]

_MOST_RUNS = 500  # that make a surface
_HOPS, _FROM_ANOTHER = 8, 3  # every third hop begins where another start has ended
_SAME = 0.01  # places that are nearer to each other, along each axis, are the same
_OTHER = 0.05  # ends that are further away from the best run are others


def lowest_valley(
    ledger: Ledger,
    random: np.random.Generator,
    runs: CurveRuns,
    ends: Sequence[End],
    begun: Sequence[Array],
    gain: float,
) -> Array | None:
    """Return where the surface through all runs is lowest, of what hops on it find.

    None where it promises to gain less than a part of the best value there, or where a run is
    there already.

    Parameters
    ----------
    ledger, random, runs
        Of the search.
    ends : sequence of End
        Where starts have ended.
    begun : sequence of ndarray, shape (k,)
        Where others have begun that may not have been run yet.
    gain : float
        The smallest that counts, as a fraction of the value.
    """
    best = ledger.best_unit
    surface = runs.through_nearest(best, np.inf, reduced=False, most=_MOST_RUNS)
    minimum = LeashMinimum(ledger.objective, runs.responses, random, ledger.show_activity)
    others = [end.place for end in ends if np.abs(end.place - best).max() > _OTHER]
    lowest, least, found = best, minimum.value(surface, best), []
    for hop in range(1, _HOPS + 1):
        is_elsewhere = others and hop % _FROM_ANOTHER == 0
        origin = others[random.integers(len(others))] if is_elsewhere else lowest
        place = minimum.valley(surface, origin, best)
        value = minimum.value(surface, place)
        found.append((value, place))
        if value < least:
            least, lowest = value, place
    known = np.vstack((runs.points, *begun))
    for value, place in sorted(found, key=lambda one: one[0]):
        if value >= (1.0 - gain) * ledger.best.value:
            return None
        if np.abs(known - place).max(axis=1).min() > _SAME:
            return place
    return None
