"""What is said of a search's end besides what its method says: of its bounds, and of its tests.

A method knows its starts and its surfaces. That a bound has stopped it, or that the points of a
test decide by the discrete Fréchet distance, is the same for all methods. Cost: by that distance
one evaluation of the objective, otherwise nothing.

T. Eiter, H. Mannila, "Computing discrete Fréchet distance", CD-TR 94/64, TU Wien (1994): the
discrete distance is up to the longest step of the curves longer than the continuous one.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...curves.scaling import box
from ..objective.objective import Objective
from ..problem.ledger import Finish, Ledger

__all__ = ["judged_end"]

# A simulated point that passes from one end of a test's step to the other is half of it away from
# both on its way. Where that is half of the distance to twice it, either side is a valley, and
# neither is much lower.
_SHORTEST, _LONGEST = 1.0, 4.0  # of such steps, in distances


def judged_end(finish: Finish, ledger: Ledger, simulations: Any) -> Finish:
    """Return how a search ended, without "converged" where bounds stopped it, and with advice.

    Parameters
    ----------
    finish : Finish
        What the method says.
    ledger : Ledger
        Of the search.
    simulations : object
        At its best run; None where they are not known.
    """
    finish = _within_bounds(finish, ledger)
    count = 0 if simulations is None else _deciding_steps(ledger.objective, simulations)
    if count == 0:
        return finish
    steps, verb = ("1 step", "is") if count == 1 else (f"{count} steps", "are")
    tests, them = ("test", "it") if len(ledger.objective.experiments) == 1 else ("tests", "them")
    return finish._replace(
        message=f"{finish.message}; {steps} of the {tests} {verb} one to four times as long as the "
        f"distance, so that points decide which valley is lowest: resample {them} evenly "
        "(curvewise.curves.resample), so finely that none is"
    )


def _within_bounds(finish: Finish, ledger: Ledger) -> Finish:
    """Take back "converged" where bounds stopped the search: the minimum is beyond them.

    A limit is meant: nothing lies beyond.
    """
    if not finish.converged:
        return finish
    parameters = ledger.space.dictionary(ledger.best.point)
    limits = ledger.space.at_limits(parameters)
    stopped = [
        f"{name} is at its {side} bound"
        for name, side in ledger.space.at_bounds(parameters).items()
        if name not in limits
    ]
    if not stopped:
        return finish
    return Finish(False, f"{', '.join(stopped)}: widen it if it is not meant ({finish.message})")


def _deciding_steps(objective: Objective, simulations: Any) -> int:
    """Return how many steps of tests decide, by the discrete Fréchet distance at the best run."""
    condition = objective.condition
    if condition is None or objective.measure != "frechet" or condition.options:
        return 0
    count = 0
    distances = objective.predicted(simulations).terms
    for test, distance in zip(objective.experiments, distances, strict=True):
        sides = box(test)[1] if condition.scaled else 1.0
        steps = np.linalg.norm(np.diff(test, axis=0) / sides, axis=1)
        count += int(np.sum((steps > _SHORTEST * distance) & (steps <= _LONGEST * distance)))
    return count
