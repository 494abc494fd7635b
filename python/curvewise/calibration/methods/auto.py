"""Automatic choice between least squares and trust region."""

from __future__ import annotations

from dataclasses import dataclass

from ...curves.inputs import Array
from ..objective.objective import Objective
from ..problem.ledger import Course, Ledger
from .least_squares import LeastSquares
from .method import Method
from .trust_region import TrustRegion

__all__ = ["Auto"]


@dataclass(frozen=True, kw_only=True, repr=False)
class Auto(Method, name="auto", keeps_curves=True, needs_squares=False):
    """Least squares if every term is "sum_of_squares", else trust region."""

    def chosen_for(self, objective: Objective) -> Method:
        """Return the method for an objective."""
        return LeastSquares() if objective.is_least_squares else TrustRegion()

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Return the course of the method for the ledger's objective."""
        return self.chosen_for(ledger.objective).course(ledger, start, seed)

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the two, which are as many."""
        return TrustRegion().fewest_runs(parameters, has_start=has_start)

    def near_optimum(self) -> Method:
        """Return this method unchanged; the method that it chooses adapts itself."""
        return self
