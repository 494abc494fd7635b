"""Some of the loops of a model: what a fold of a cross-validation compares.

The model is run as a whole, so that its runs in a store are the same for every fold.
"""

from __future__ import annotations

from ...curves.several_curves import curve_list
from ..models.pool import Model, Outcome

__all__ = ["Selection"]


class Selection:
    """A model of which some curves count.

    Parameters
    ----------
    whole : callable
        The model, which returns `count` curves.
    kept : tuple of int
        Which of them count.
    count : int
        How many there are.
    """

    def __init__(self, whole: Model, kept: tuple[int, ...], count: int) -> None:
        self.whole, self._kept, self._count = whole, kept, count

    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return the curves that count, of a run of the whole."""
        (outcome,) = outcomes
        if outcome.message:
            return outcome
        curves = curve_list(outcome.simulations)
        if len(curves) == 1 and curves[0] is None:
            return outcome
        if len(curves) != self._count:
            message = f"the model gave {len(curves)} curves for {self._count} loops"
            return Outcome(None, message, outcome.seconds)
        return outcome._replace(simulations=[curves[i] for i in self._kept])
