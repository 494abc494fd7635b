"""What is said of a search's end besides what its method says: of its bounds, and of its tests.

A method knows its starts and its surfaces. That a bound has stopped it, or that the points of a
test decide by the discrete Fréchet distance (`objective.sampling`), is the same for all methods.
Cost: by that distance one evaluation of the objective, otherwise nothing.
"""

from __future__ import annotations

from typing import Any

from ..objective.sampling import is_leash, sampling_of_tests
from ..problem.ledger import Finish, Ledger

__all__ = ["judged_end"]


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
    if simulations is None or not is_leash(ledger.objective):
        return finish
    distances = ledger.objective.predicted(simulations).terms
    found = sampling_of_tests(ledger.objective, distances)
    count = sum(sampling.deciding for sampling in found)
    if count == 0:
        return finish
    steps, verb = ("1 step", "is") if count == 1 else (f"{count} steps", "are")
    tests, them = ("test", "it") if len(found) == 1 else ("tests", "them")
    points = " and ".join(str(sampling.enough) for sampling in found)
    return finish._replace(
        message=f"{finish.message}; {steps} of the {tests} {verb} longer than a third of the "
        f"distance, so that points decide which valley is lowest: resample {them} evenly to "
        f"{points} points (curvewise.curves.resample)"
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
