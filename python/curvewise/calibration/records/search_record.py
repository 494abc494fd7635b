"""The record of a search: enough to report on it, and to repeat it.

A record has three parts: the settings (tests, objective, space, method, seed, versions), the
evaluations in order, and the ending. A store keeps all three and returns them bitwise identical. A
report made from a store therefore equals the one made by the search itself. Curves are stored in
JSON as text: the shape of each, and its float64 numbers in base64, eight bytes in eleven letters.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from .evaluation import Evaluation

__all__ = ["Agreement", "Doubt", "Ending", "SearchRecord", "as_json", "curves_of", "text_of"]

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


class Agreement(NamedTuple):
    """How many starts of a search have ended at the best value.

    Attributes
    ----------
    agree, starts : int
        How many of how many independent starts.
    within : float
        How far the highest of those that agree is above the best, as a fraction of it; 0 for
        perfect fits.
    """

    agree: int
    starts: int
    within: float


class Doubt(NamedTuple):
    """Parameters that are not to be used, whatever their intervals are.

    Attributes
    ----------
    names : tuple of str
        Empty if a test itself is doubtful, and with it all parameters.
    sentence : str
        Why, and what would determine them.
    """

    names: tuple[str, ...]
    sentence: str


@dataclass(frozen=True)
class Ending:
    """The ending of a search.

    Attributes
    ----------
    converged, message, parameters, value, measures
        As for an :class:`Identification`.
    deviations : list of (mean, largest, height), or None, for each loop
        See :class:`curvewise.comparing.deviations.Deviation`.
    simulations : tuple of ndarray
        The curves at the optimum.
    unit, slopes : ndarray, or None
        The place of the optimum in the unit cube, and the derivatives of the curves there. None if
        the search has left too few runs near the optimum.
    uncertainty : dict, or None
        The figures of a computed :class:`Uncertainty`, see
        :func:`curvewise.calibration.report.uncertainty_summary.summary_of`.
    agreement, reason
        As those of a :class:`curvewise.calibration.problem.ledger.Finish`.
    doubts : tuple of Doubt
        Parameters that are not to be used, by those who know the model and the tests.
    """

    converged: bool
    message: str
    parameters: dict[str, float]
    value: float
    measures: dict[str, float]
    deviations: list[list[Any] | None]
    simulations: tuple[Array, ...]
    unit: Array | None = None
    slopes: Array | None = None
    uncertainty: dict[str, Any] | None = None
    agreement: Agreement | None = None
    reason: str = ""
    doubts: tuple[Doubt, ...] = ()

    def to_json(self) -> str:
        """Return the ending as a line of JSON."""
        plain = {name: getattr(self, name) for name in self.__dataclass_fields__}
        for name in ("simulations", "unit", "slopes"):
            value = plain[name]
            if value is not None:
                plain[name] = text_of(value if name == "simulations" else (value,))
        return as_json(plain)

    @classmethod
    def from_json(cls, text: str) -> Ending:
        """Return the ending that a line of JSON encodes."""
        plain = json.loads(text)
        plain["simulations"] = curves_of(plain["simulations"])
        for name in ("unit", "slopes"):
            if plain[name] is not None:
                (plain[name],) = curves_of(plain[name])
        if agreement := plain.get("agreement"):
            plain["agreement"] = Agreement(*agreement)
        doubts = plain.get("doubts", ())
        plain["doubts"] = tuple(Doubt(tuple(names), sentence) for names, sentence in doubts)
        return cls(**plain)


@dataclass(frozen=True)
class SearchRecord:
    """A search: its settings, its evaluations, and its ending.

    Attributes
    ----------
    settings : dict
        The settings that determine the course of the search.
    details : dict
        Further data for a report: see `details_of`.
    evaluations : tuple of Evaluation
        In the order of their numbers. Evaluations read from a store lack their curves.
    ending : Ending or None
        None for an interrupted search.
    simulations : tuple of ndarray
        The curves at the best point so far of an interrupted search, if they are known.
    """

    settings: dict[str, Any]
    details: dict[str, Any]
    evaluations: tuple[Evaluation, ...]
    ending: Ending | None = None
    simulations: tuple[Array, ...] = field(default=(), repr=False)

    @property
    def experiments(self) -> tuple[Array, ...]:
        """The measured curves."""
        return curves_of(self.details["experiments"])

    @property
    def curves(self) -> tuple[Array, ...]:
        """The simulated curves at the best point; empty if they are unknown."""
        return self.simulations if self.ending is None else self.ending.simulations

    @property
    def best(self) -> Evaluation | None:
        """The evaluation with the smallest value, the first among equals."""
        return min(self.evaluations, key=lambda one: one.value, default=None)

    @property
    def names(self) -> list[str]:
        """The parameters that were searched for."""
        return list(self.details["parameters"])


def as_json(value: Mapping[str, Any]) -> str:
    """Return JSON, with numpy's numbers as numbers and functions by their names."""
    return json.dumps(value, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    return _ADDRESS.sub("", repr(value))


def text_of(curves: Sequence[Array]) -> str:
    """Return curves as text without line breaks, commas or quotation marks."""
    return " ".join(
        f"{'x'.join(map(str, curve.shape))}:{base64.b64encode(curve.tobytes()).decode()}"
        for curve in curves
    )


def curves_of(text: str) -> tuple[Array, ...]:
    """Return the curves that a text encodes; () for an empty text."""
    curves = []
    for part in text.split():
        shape, _, numbers = part.partition(":")
        curve = np.frombuffer(base64.b64decode(numbers))
        curves.append(curve.reshape(tuple(map(int, shape.split("x")))))
    return tuple(curves)
