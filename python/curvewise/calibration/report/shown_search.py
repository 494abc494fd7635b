"""A search for display: its record, and quantities computed once from it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ..records.search_record import SearchRecord
from .branches import Branch, branches_of
from .uncertainty_summary import summary_of_record

__all__ = ["Loop", "ShownSearch"]


@dataclass(frozen=True)
class Loop:
    """A test with its simulation.

    Attributes
    ----------
    title : str
        What the test is called.
    axes : sequence of str
        What its columns are called; `is_named` says whether anybody has named them.
    test : ndarray, shape (n, d)
        Of a number (1, 1).
    simulation : ndarray, or None where it is not known
        At the optimum.
    y : int
        The column whose differences are residuals.
    at_same_x : bool
        Whether its measure, "sum_of_squares", compares y at the same x.
    """

    title: str
    axes: Sequence[str]
    is_named: bool
    test: Array = field(repr=False)
    simulation: Any = field(repr=False)
    y: int
    at_same_x: bool = True

    @property
    def has_number(self) -> bool:
        """Whether it is a number with its simulated value, and no curve."""
        return self.test.size == 1 and self.simulation is not None

    @property
    def y_name(self) -> str:
        """What y is called."""
        return self.axes[self.y]

    @cached_property
    def branches(self) -> list[Branch]:
        """The branches with their residuals; none without a simulated curve of finite numbers."""
        if self.simulation is None or len(self.test) < 2 or not np.isfinite(self.simulation).all():
            return []
        return branches_of(self.test, self.simulation, self.y)

    @property
    def residual(self) -> Array:
        """The residual of every point of the test."""
        # Branches share the points at which the test turns.
        return np.concatenate([one.residual[i > 0 :] for i, one in enumerate(self.branches)])


class ShownSearch:
    """A search with its tests and its uncertainty.

    Parameters
    ----------
    record : SearchRecord

    Attributes
    ----------
    record : SearchRecord
    loops : list of Loop
        Its tests with their simulations at the optimum.
    summary, reason
        The summary of its uncertainty, or None and the reason.
    """

    def __init__(self, record: SearchRecord) -> None:
        self.record = record
        self.summary, self.reason = summary_of_record(record)
        details, tests = record.details, record.experiments
        simulated = [*record.curves, *[None] * (len(tests) - len(record.curves))]
        # The default "column 2" of a file without a header does not count as a name.
        named = [
            any(not re.fullmatch(r"column \d+", n) for n in names) for names in details["named"]
        ]
        cases = record.settings["cases"]
        criteria = (
            [record.settings] * len(tests) if cases is None else [c["criterion"] for c in cases]
        )
        at_same_x = [criterion["measure"] == "sum_of_squares" for criterion in criteria]
        columns = (
            *(details["titles"], details["axes"], named),
            *(tests, simulated, details["y"], at_same_x),
        )
        self.loops = [Loop(*one) for one in zip(*columns, strict=True)]

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters that it has found, or the best so far."""
        record, best = self.record, self.record.best
        if record.ending is not None:
            return record.ending.parameters
        return {} if best is None else dict(zip(record.names, best.point, strict=True))

    @property
    def objective(self) -> str:
        """The minimised measure, with its preset."""
        return f"{self.record.settings['measure']} ({self.record.settings['preset']})"
