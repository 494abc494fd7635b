"""Limits of ``curvewise compare``: measures, a tube, and the span over which both are known."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from .._options import check_choice
from ..comparing.comparison import Comparison
from ..comparing.limits import Verdict, limit_of
from ..comparing.tube import Tube, tube
from ..curves.inputs import Array
from ..measures.registry import MEASURES

__all__ = ["LimitsCheck", "add_limits", "checked", "measures_with_limits"]


class LimitsCheck(NamedTuple):
    """The result of the limits; None for limits that were not given."""

    measures: Verdict | None
    tube: Tube | None

    def failures(self) -> list[str]:
        """Return the names of the values above their limits."""
        checks = () if self.measures is None else self.measures.checks
        above = [check.measure for check in checks if not check.passed]
        return [*above, "tube"] if self.tube is not None and not self.tube else above

    def in_json(self) -> dict[str, Any]:
        """Return the keys of the JSON object that limits add."""
        found: dict[str, Any] = {}
        if self.measures is not None:
            found["limits"] = self.measures.to_list()
        if self.tube is not None:
            found["tube"] = self.tube.to_dict()
        return found

    def print_text(self) -> None:
        """Print each limit with its outcome."""
        lines = [] if self.measures is None else str(self.measures).splitlines()
        if self.tube is not None:
            lines.append(f"tube: {self.tube}")
        if lines:
            print("\nlimits", *lines, sep="\n")

    def status(self, file: str) -> int:
        """Return the exit status, after one line on standard error if a limit is exceeded."""
        if not (failed := self.failures()):
            return 0
        print(f"curvewise: {file} is outside its limits: {', '.join(failed)}", file=sys.stderr)
        return 1


def add_limits(command: argparse.ArgumentParser) -> None:
    """Add --within, --tube and --common-span."""
    command.add_argument(
        "--within",
        nargs="+",
        type=_limit,
        default=[],
        metavar="MEASURE=LIMIT",
        help="end with status 1 if a measure is above its limit, such as area=2%% frechet=0.05; %% "
        "is of the height of A: the mean deviation, for the Fréchet distances the largest",
    )
    command.add_argument(
        "--tube",
        nargs=2,
        type=_tolerance,
        metavar=("DX", "DY"),
        help="end with status 1 if a curve leaves the rectangular tube about the other, which "
        "reaches DX and DY to each side: numbers, or percentages of the extents of A",
    )
    command.add_argument(
        "--common-span",
        action="store_true",
        help="compare the span of x that both curves cover; x must ascend, such as a time",
    )


def measures_with_limits(arguments: argparse.Namespace) -> Sequence[str] | None:
    """Return the measures to compute: those named, and those with a limit."""
    if not arguments.within:
        named: Sequence[str] | None = arguments.measures
        return named
    limited = [name for name, _ in arguments.within]
    return list(dict.fromkeys([*(arguments.measures or []), *limited]))


def checked(arguments: argparse.Namespace, comparison: Comparison) -> LimitsCheck:
    """Return the outcome of the limits that the arguments give."""
    measures = comparison.within(dict(arguments.within)) if arguments.within else None
    if arguments.tube is None:
        return LimitsCheck(measures, None)
    P, Q = comparison.P, comparison.Q
    size = [_size(text, P, column) for column, text in enumerate(arguments.tube)]
    return LimitsCheck(measures, tube(P, Q, *size))


def _limit(text: str) -> tuple[str, str]:
    """Read MEASURE=LIMIT."""
    name, equals, limit = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"expected MEASURE=LIMIT, such as area=2%; got {text!r}")
    try:
        check_choice("measure", name, MEASURES)
        limit_of(name, limit)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return name, limit


def _tolerance(text: str) -> str:
    """Read a number above 0, or a percentage."""
    try:
        number = float(text.removesuffix("%"))
    except ValueError:
        number = 0.0
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"expected a number above 0, or 1%; got {text!r}")
    return text


def _size(text: str, P: Array, column: int) -> float:
    """Return a tolerance in the unit of a column."""
    if not text.endswith("%"):
        return float(text)
    if P.ndim != 2 or column >= P.shape[1] or not np.ptp(P[:, column]) > 0.0:
        raise ValueError(f"the tube has {text} of an extent of P that is 0; give a number")
    return 0.01 * float(text[:-1]) * float(np.ptp(P[:, column]))
