"""Checks at the end of a search that do not depend on the method.

A method reports on its starts and surfaces. For all methods, this module reports whether a bound
stopped the search, and whether sampling decides the discrete Fréchet distance
(`objective.sampling`). Cost: one evaluation of the objective for the discrete Fréchet distance;
otherwise nothing.
"""

from __future__ import annotations

from typing import Any

from ..objective.sampling import Sampling, sampling_of_tests
from ..problem.ledger import Finish, Ledger

__all__ = ["judged_end"]


def judged_end(finish: Finish, ledger: Ledger, simulations: Any) -> Finish:
    """Return how a search ended, without "converged" where bounds stopped it, and with advice.

    Parameters
    ----------
    finish : Finish
        The ending that the method reports.
    ledger : Ledger
        The ledger of the search.
    simulations : object
        The curves of the best run; None if they are unknown.
    """
    finish = _within_bounds(finish, ledger)
    if simulations is None or not ledger.objective.is_largest_distance:
        return finish
    distances = ledger.objective.predicted(simulations).terms
    tests = sampling_of_tests(ledger.objective, distances)
    if all(test.deciding == 0 for test in tests):
        return finish
    points = " and ".join(str(test.enough) for test in tests)
    return finish._replace(
        converged=False,
        message=f"{finish.message}; {_of_tests(tests)}",
        reason="the points of the test are so far apart that they decide which fit is best; "
        f"compare by another measure, or resample the test evenly to {points} points",
    )


def _of_tests(tests: list[Sampling]) -> str:
    count = sum(test.deciding for test in tests)
    steps, verb = ("1 step", "is") if count == 1 else (f"{count} steps", "are")
    name, them = ("test", "it") if len(tests) == 1 else ("tests", "them")
    points = " and ".join(str(test.enough) for test in tests)
    return (
        f"{steps} of the {name} {verb} longer than a third of the distance, so that points decide "
        f"which minimum is lowest: resample {them} evenly to {points} points "
        "(curvewise.curves.resample), and let the model return as many"
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
    held = ", ".join(stopped)
    return finish._replace(
        converged=False,
        message=f"{held}: widen it if it is not meant ({finish.message})",
        reason=f"{held}, and a better fit may lie beyond; give wider bounds",
    )
