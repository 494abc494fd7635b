"""Limits of measures, for tests that pass or fail, and where a limit is exceeded.

A limit is a value of the measure, or a percentage: of the reference's height, the mean deviation of
`area`, `pcm` and `dtw` and the largest of the Fréchet distances.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from .._options import real_number
from ..curves.inputs import Array
from ..measures.registry import Condition
from .deviations import deviation, largest_places
from .tube import at

__all__ = ["LimitCheck", "Verdict", "check_limits"]

_LARGEST = ("frechet", "frechet_continuous")  # whose value is the largest deviation


class LimitCheck(NamedTuple):
    """A measure with its limit.

    Attributes
    ----------
    measure : str
        Its name.
    value, limit : float
        In the unit; the value is nan if the measure refuses the curves.
    unit : {"", "%"}
        "" for values of the measure, "%" for deviations in per cent of P's height.
    places : tuple of two tuples of float, or None
        If the limit is exceeded, the points of P and of Q with the largest deviation; None for
        measures that do not pair points.
    """

    measure: str
    value: float
    limit: float
    unit: str
    places: tuple[tuple[float, ...], tuple[float, ...]] | None

    @property
    def passed(self) -> bool:
        """Whether the value is at most the limit."""
        return self.value <= self.limit

    def __str__(self) -> str:
        unit = " %" if self.unit else ""
        relation = "within" if self.passed else "above"
        text = f"{self.measure} {self.value:.4g}{unit}, {relation} its limit {self.limit:g}{unit}"
        if math.isnan(self.value):
            return f"{self.measure} has no value; its limit is {self.limit:g}{unit}"
        if self.places is None:
            return text
        return f"{text}; largest deviation between {at(self.places[0])} of P and " + (
            f"{at(self.places[1])} of Q"
        )


@dataclass(frozen=True, repr=False)
class Verdict:
    """Measures against limits; true if all are within.

    Attributes
    ----------
    checks : tuple of LimitCheck
        One for each limit.
    """

    checks: tuple[LimitCheck, ...]

    def __bool__(self) -> bool:
        return all(check.passed for check in self.checks)

    def __str__(self) -> str:
        return "\n".join(map(str, self.checks))

    # A test runner prints it in an assertion.
    __repr__ = __str__

    def to_list(self) -> list[dict[str, Any]]:
        """Return the checks as JSON has them, with `within` as a bool."""
        return [
            {
                **check._asdict(),
                "value": check.value if math.isfinite(check.value) else None,
                "within": check.passed,
            }
            for check in self.checks
        ]


def check_limits(
    limits: Mapping[str, float | str],
    values: Mapping[str, float],
    conditions: Mapping[str, Condition],
    P: Array,
    Q: Array,
) -> Verdict:
    """Return the measures of a comparison against limits, and where those above are exceeded."""
    checks = []
    for measure, given in limits.items():
        if measure not in values:
            raise ValueError(
                f"{measure!r} is not among the measures: {', '.join(values)}; add it to measures="
            )
        limit, unit = limit_of(measure, given)
        value = values[measure]
        condition = conditions[measure]
        if unit and not math.isnan(value):
            value = _percent(measure, condition, P, Q)
        places = None
        if value > limit:
            places = largest_places(measure, condition, P, Q)
        checks.append(LimitCheck(measure, value, limit, unit, places))
    return Verdict(tuple(checks))


def limit_of(measure: str, given: float | str) -> tuple[float, str]:
    """Return a limit as a number and its unit: "" or "%"."""
    advice = f"give a number, or a text such as '2%', as the limit of {measure}"
    text, unit = given, ""
    if isinstance(given, str):
        text, unit = given.strip(), ""
        if text.endswith("%"):
            text, unit = text[:-1], "%"
        try:
            text = float(text)
        except ValueError:
            raise ValueError(f"limit is {given!r}; {advice}") from None
    return real_number("limit", text, 0.0, advice), unit


def _percent(measure: str, condition: Condition, P: Array, Q: Array) -> float:
    found = deviation(measure, condition, P, Q)
    if found is None:
        raise ValueError(f"{measure} has no deviation in %; give a value of {measure} as its limit")
    if not found.height > 0.0:
        raise ValueError(f"P has no height, of which {measure} could be limited in %; give a value")
    return 100.0 * (found.largest if measure in _LARGEST else found.mean) / found.height
