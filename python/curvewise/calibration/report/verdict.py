"""What is said first of a search, in plain words: how far off, what can be used, and the search.

The same sentences begin the text of an identification, the page, and the head of a material card;
`verdict_of` alone makes them. How the distance of model and test is defined stands in `misfit`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...showing.result import paragraph
from ..problem.tables import digits, per_cent
from ..records.search_record import Agreement, Doubt
from .misfit import SCATTERED, SYSTEMATIC, misfit_of
from .shown_search import Loop, ShownSearch

__all__ = ["Verdict", "asked_for", "unit_of", "verdict_of"]

# "stress [MPa]", "stress (MPa)", "stress, MPa", "stress / MPa", "stress in MPa".
_UNIT = re.compile(r"\s*(?:[\[(]([^\[\]()]+)[\])]\s*|(?:,|\s/|\sin)\s+(\S+))$")
_MOST_TESTS = 6  # with a line each
_LEAST_SHARE = 1e-3  # per cent of the height: what is less is said to be less


@dataclass(frozen=True)
class Verdict:
    """What is said first of a search.

    Attributes
    ----------
    lines : tuple of str
        The deviation of each test, the parameters that can be used, those that cannot, with the
        reason and the test that would determine them, and whether the search has converged.
    usable : dict of str to bool
        Whether each parameter that was searched for can be used; empty where that is not known.
    """

    lines: tuple[str, ...]
    usable: Mapping[str, bool]

    def __str__(self) -> str:
        return "\n".join(self.lines)

    def html(self) -> str:
        """Return the lines as HTML, a paragraph each."""
        return "\n".join(['<div class="verdict">', *map(paragraph, self.lines), "</div>"])


def verdict_of(search: ShownSearch) -> Verdict:
    """Return what is said first of a search."""
    usable = _usable(search)
    lines = [*_deviations(search.loops), *_parameters(search, usable), _ended(search)]
    return Verdict(tuple(lines), usable)


def unit_of(name: str) -> str:
    """Return the unit in the name of a column, or ""."""
    found = _UNIT.search(name)
    return (found[1] or found[2]) if found else ""


def asked_for(loops: Sequence[Loop]) -> str:
    """Say which names and units of axes are not known, and how to give them; else nothing."""
    curves = [loop for loop in loops if loop.test.size > 1]
    nameless = [loop.title for loop in curves if not loop.is_named]
    names = dict.fromkeys(name for loop in curves if loop.is_named for name in loop.axes)
    unitless = [f'"{name}"' for name in names if not unit_of(name) and "×" not in name]
    asked = []
    if nameless:
        asked.append(
            f"the names of the columns of {_listed(nameless)} are not known: read the test with "
            "curvewise.read_curve, or give it as curvewise.curves.named_curve.NamedCurve(test, "
            '["strain [-]", "stress [MPa]"])'
        )
    if unitless:
        asked.append(
            f"the units of {_listed(unitless)} are not known: write them into the names of the "
            'columns, as in "stress [MPa]", and [-] for none'
        )
    return f"For the axes of the figures, {'; '.join(asked)}." if asked else ""


def _deviations(loops: Sequence[Loop]) -> list[str]:
    """Say how far the model is from each test."""
    known = [loop for loop in loops if loop.branches or loop.has_number]
    if len(known) == 1 == len(loops):
        return [f"Deviation: {_distance(known[0])}"]
    lines = [f"Deviation from {loop.title}: {_distance(loop)}" for loop in known[:_MOST_TESTS]]
    more = len(known) - _MOST_TESTS
    return (
        [*lines, f"Deviation from {more} more tests: see the table below."] if more > 0 else lines
    )


def _distance(loop: Loop) -> str:
    """Say how far a simulation is from its test."""
    unit = unit_of(loop.y_name)
    after = f" {unit}" if unit else ""
    if loop.has_number:
        made, measured = float(loop.simulation[0, 0]), float(loop.test[0, 0])
        share = per_cent(made - measured, measured) or "0"
        return (
            f"{digits(made - measured, 3)}{after} ({share} %), for {digits(measured, 4)} measured."
        )
    misfit = misfit_of(loop)
    name = _UNIT.sub("", loop.y_name) if loop.is_named else "y"
    said = f"{digits(misfit.rms, 2)}{after} root mean square"
    if misfit.height > 0.0:
        part = 100.0 * misfit.rms / misfit.height
        of = f"{part:.2g} %" if part >= _LEAST_SHARE else f"less than {_LEAST_SHARE:g} %"
        said += f", {of} of the test's range of {name}"
    said += f"; {digits(misfit.largest, 2)}{after} at most."
    if misfit.scatter is not None and misfit.scatter >= SCATTERED:
        said += " It looks like noise of the test."
    elif misfit.scatter is not None and misfit.scatter <= SYSTEMATIC:
        said += " It is systematic: the model does not follow the test."
    return said


def _usable(search: ShownSearch) -> dict[str, bool]:
    """Return which parameters can be used: the tests determine them, and nobody doubts it."""
    if search.summary is None or search.record.ending is None:
        return {}
    doubted = {name for doubt in search.record.ending.doubts for name in doubt.names}
    determined: dict[str, bool] = search.summary["determined"]
    return {name: is_good and name not in doubted for name, is_good in determined.items()}


def _parameters(search: ShownSearch, usable: Mapping[str, bool]) -> list[str]:
    """Say which parameters can be used, and why the others cannot."""
    ending, summary = search.record.ending, search.summary
    if ending is None:
        return []
    if summary is None:
        return [
            f"Parameters: it is not known which of them the tests determine. {search.reason}",
            *map(_doubt, ending.doubts),
        ]
    values = search.parameters
    good = [name for name, is_good in usable.items() if is_good]
    lines = [_doubt(doubt) for doubt in ending.doubts if not doubt.names]
    use = "Use, once this is settled" if lines else "Use"
    if good:
        said = [f"{name} = {digits(values[name], 4)}{_half(summary, name)}" for name in good]
        lines.append(f"{use}: {', '.join(said)} ({100 * summary['level']:g} % intervals).")
    else:
        lines.append("Use: no single parameter.")
    doubted: set[str] = set()
    for doubt in ending.doubts:
        if not doubt.names:
            continue
        said = [f"{name}{_range(summary, name)}" for name in doubt.names]
        lines.append(f"Do not use {_listed(said)}: {doubt.sentence}")
        doubted |= set(doubt.names)
    left = [name for name, is_good in usable.items() if not is_good and name not in doubted]
    return [*lines, *_undetermined(search, summary, left)]


def _doubt(doubt: Doubt) -> str:
    """Return the line of a doubt, about a test or about parameters."""
    if not doubt.names:
        return f"Check first: {doubt.sentence}"
    return f"Do not use {_listed(doubt.names)}: {doubt.sentence}"


def _half(summary: Mapping[str, Any], name: str) -> str:
    """Return the larger half of an interval, in per cent of the value."""
    low, high = summary["intervals"][name]
    value = 0.5 * (low + high)
    share = per_cent(0.5 * (high - low), value)
    return f" ± {share} %" if share else f" ({digits(low, 3)} to {digits(high, 3)})"


def _range(summary: Mapping[str, Any], name: str) -> str:
    """Return an interval that is too wide; nothing for one that is not."""
    if name in summary["at_bounds"] or summary["determined"].get(name, True):
        return ""
    low, high = (digits(end, 3) for end in summary["intervals"][name])
    is_open = summary.get("open_ends", {}).get(name, (False, False))  # older records do not have it
    if all(is_open):
        return " (any value within its bounds)"
    if any(is_open):
        return f" ({high} or less)" if is_open[0] else f" ({low} or more)"
    return f" ({low} to {high})"


def _undetermined(search: ShownSearch, summary: Mapping[str, Any], left: list[str]) -> list[str]:
    """Say of parameters why the tests do not determine them, and what is known of a remedy."""
    bounded, values = summary["at_bounds"], search.parameters
    limits = summary.get("at_limits", ())  # which older records do not have
    lines = []
    for name in (name for name in left if name in bounded):
        at = f"Do not use {name}: it is at its"
        if name in limits:
            lines.append(f"{at} limit, {digits(values[name], 4)}, beyond which nothing lies.")
        else:
            lines.append(
                f"{at} {bounded[name]} bound, {digits(values[name], 4)}, and may lie beyond. Give "
                "wider bounds."
            )
    if loose := [f"{name}{_range(summary, name)}" for name in left if name not in bounded]:
        lines.append(
            f"Do not use {_listed(loose)}: the tests do not determine "
            f"{'them' if len(loose) > 1 else 'it'}. They are not sensitive to this change: "
            f"{summary['in_words']}. Add a test that is sensitive to it."
        )
    return lines


def _ended(search: ShownSearch) -> str:
    """Say whether the search has converged."""
    ending = search.record.ending
    if ending is None:
        return "Search: not ended. It was interrupted, or is running."
    agreement = ending.agreement
    if not ending.converged:
        reason = ending.reason or "the method ended before it met its tolerances"
        return f"Search: not converged. {reason[:1].upper()}{reason[1:]}."
    if agreement is None:
        return "Search: converged."
    if agreement.starts == 1:
        return "Search: converged, from a single start."
    return f"Search: converged. {_agreed(agreement)}."


def _agreed(agreement: Agreement) -> str:
    agree, starts, within = agreement
    who = f"All {starts} starts" if agree == starts else f"{agree} of {starts} starts"
    rest = "" if agree == starts else "; the others end at worse fits"
    if within == 0.0:
        return f"{who} agree{rest}"
    return f"{who} agree, within {max(100.0 * within, 0.01):.1g} %{rest}"


def _listed(parts: Iterable[str]) -> str:
    *first, last = parts
    return " and ".join(filter(None, [", ".join(first), last]))
