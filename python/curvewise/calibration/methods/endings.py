"""What is said of a search's end besides what its method says: of its bounds, and of its tests.

A method knows its starts and its surfaces. That a bound has stopped it, or that points decide by
the discrete Fréchet distance (`objective.sampling`), is the same for all methods.
Cost: by that distance one evaluation of the objective, otherwise nothing.
"""

from __future__ import annotations

from typing import Any

from ..objective.sampling import (
    Sampling,
    is_leash,
    sampling_of_simulations,
    sampling_of_tests,
)
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
    advice = _of_sampling(
        sampling_of_tests(ledger.objective, distances),
        sampling_of_simulations(ledger.objective, simulations, distances),
    )
    return finish._replace(message="; ".join(filter(None, (finish.message, advice))))


def _of_sampling(tests: list[Sampling], simulations: list[Sampling]) -> str:
    """Return what to do about points that decide; nothing where none does."""
    steps, points = _counted(tests, "test")
    simulated_steps, simulated_points = _counted(simulations, "simulation")
    if steps:
        it = "it" if len(tests) == 1 else "them"
        also = ", and let the model return as many" if simulated_steps else ""
        return (
            f"{steps} longer than a third of the distance, so that points decide which valley is "
            f"lowest: resample {it} evenly to {points} points (curvewise.curves.resample){also}"
        )
    if simulated_steps:
        return (
            f"{simulated_steps} longer than two thirds of the distance, so that points decide: "
            f"let the model return {simulated_points} points at even steps"
        )
    return ""


def _counted(curves: list[Sampling], name: str) -> tuple[str, str]:
    """Return how many steps of curves decide, and of how many points none would."""
    count = sum(curve.deciding for curve in curves)
    if count == 0:
        return "", ""
    steps = "1 step" if count == 1 else f"{count} steps"
    plural = "" if len(curves) == 1 else "s"
    verb = "is" if count == 1 else "are"
    points = " and ".join(str(curve.enough) for curve in curves)
    return f"{steps} of the {name}{plural} {verb}", points


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
