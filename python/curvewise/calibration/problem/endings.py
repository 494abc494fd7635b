"""Checks at the end of a search that do not depend on the method.

A method reports on its starts and surfaces. For all methods, this module reports whether a bound
stopped the search, and whether sampling decides the value (`objective.sampling`). Cost: at most one
evaluation of the objective.
"""

from __future__ import annotations

from typing import Any

from ..objective.sampling import sampling_advice
from .ledger import Finish, Ledger

__all__ = ["judged_end"]


def judged_end(finish: Finish, ledger: Ledger, simulations: Any) -> Finish:
    """Return how a search ended, without "converged" where bounds stopped it, and with advice.

    The simulations are the curves of the best run; None if they are unknown.
    """
    finish = _within_bounds(finish, ledger)
    advice = sampling_advice(ledger.objective, simulations)
    if advice is None:
        return finish
    message = f"{finish.message}; {advice.message}"
    return finish._replace(converged=False, message=message, reason=advice.reason)


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
