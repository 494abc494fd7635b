"""What a page begins with: in plain words what the tests determine and how far the model is off.

Written for those who read no further. Distances are differences in y, in the unit that stands in
the name of the test's column. What the search said of itself at its end is a footnote.
"""

from __future__ import annotations

import html
import re
from collections.abc import Sequence

import numpy as np

from ...showing.result import paragraph
from ..problem.tables import digits, per_cent
from .shown_search import Loop, ShownSearch

__all__ = ["asked_for", "footnote", "verdict"]

# "stress [MPa]", "stress (MPa)", "stress, MPa", "stress / MPa", "stress in MPa".
_UNIT = re.compile(r"[\[(]([^\[\]()]+)[\])]\s*$|(?:,|\s/|\sin)\s+(\S+)$")


def verdict(search: ShownSearch) -> str:
    """Return the verdict as HTML."""
    made = [paragraph(" ".join([*_ended(search), *_determined(search)]))]
    known = [loop for loop in search.loops if loop.branches or loop.has_number]
    if len(known) == 1:
        made.append(paragraph(f"At the optimum the model is off by {_distance(known[0])}."))
    elif known:
        items = [f"<li>{html.escape(f'{one.title}: {_distance(one)}')}</li>" for one in known]
        made += [paragraph("At the optimum the model is off by"), "<ul>", *items, "</ul>"]
    return "\n".join(['<div class="verdict">', *made, paragraph(_runs(search)), "</div>"])


def footnote(search: ShownSearch) -> str:
    """Return the last words of the method, as HTML."""
    record = search.record
    if record.ending is None:
        return ""
    words = html.escape(record.ending.message)
    return f'<p class="footnote">The last words of {record.settings["method"]}: {words}.</p>'


def asked_for(loops: Sequence[Loop]) -> str:
    """Say which names and units of axes are not known, and how to give them; else nothing."""
    curves = [loop for loop in loops if loop.test.size > 1]
    nameless = [loop.title for loop in curves if not loop.is_named]
    names = dict.fromkeys(name for loop in curves if loop.is_named for name in loop.axes)
    unitless = [f'"{name}"' for name in names if not _UNIT.search(name) and "×" not in name]
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


def _ended(search: ShownSearch) -> list[str]:
    ending = search.record.ending
    if ending is None:
        return ["The search has not ended: it was interrupted, or goes on."]
    if not ending.converged:
        return ["The search has not converged: these are the best parameters that it has met."]
    return []


def _determined(search: ShownSearch) -> list[str]:
    """Say which parameters the tests determine, which not, and which are at a bound."""
    if search.record.ending is None:
        return []
    is_one, summary, values = len(search.loops) == 1, search.summary, search.parameters
    tests, it, verb = ("test", "it", "determines") if is_one else ("tests", "they", "determine")
    if summary is None:
        return [f"What the {tests} {verb} is not known. {search.reason}"]
    said = {
        name: f"{name} = {digits(values[name], 4)} ± {per_cent(error, values[name]) or 0} %"
        for name, error in summary["standard_errors"].items()
    }
    bounded = summary["at_bounds"]
    good = [said[name] for name, is_good in summary["determined"].items() if is_good]
    loose = [
        f"{name} (anything from {digits(low, 3)} to {digits(high, 3)})"
        for name, (low, high) in summary["intervals"].items()
        if not summary["determined"][name] and name not in bounded
    ]
    sentences = []
    if good:
        sentences.append(f"The {tests} {verb} {_listed(good)} (±: one standard error).")
    if loose:
        who = it.capitalize() if good else f"The {tests}"
        sentences.append(f"{who} do{'es' if is_one else ''} not determine {_listed(loose)}.")
    limits = summary.get("at_limits", ())  # which older records do not have
    for name, side in bounded.items():
        value = digits(values[name], 4)
        if name in limits:
            sentences.append(f"{name} is at its limit, {value}: nothing lies beyond.")
        else:
            sentences.append(f"{name} is at its {side} bound, {value}: it may lie beyond.")
    return sentences


def _distance(loop: Loop) -> str:
    """Say how far a simulation is from its test."""
    unit = _UNIT.search(loop.y_name)
    after = f" {unit[1] or unit[2]}" if unit else ""
    if loop.has_number:
        made, measured = float(loop.simulation[0, 0]), float(loop.test[0, 0])
        share = per_cent(made - measured, measured) or "0"
        return (
            f"{digits(made - measured, 3)}{after} ({share} %), for {digits(measured, 4)} measured"
        )
    size = np.abs(loop.residual)
    mean, most = (digits(float(number), 3) + after for number in (size.mean(), size.max()))
    share = per_cent(float(size.mean()), float(np.ptp(loop.test[:, loop.y])))
    of_height = f" ({share} % of the test's height)" if share else ""
    return f"{mean} in the mean{of_height} and {most} at most{'' if unit else ', in units of y'}"


def _runs(search: ShownSearch) -> str:
    evaluations = search.record.evaluations
    outside, count = sum(one.outside for one in evaluations), len(evaluations)
    failed = sum(one.failed for one in evaluations) - outside
    said = f"{count} evaluations, of which {failed} failed." if failed else f"{count} evaluations."
    return f"{said} {outside} were outside of the model's own bounds." if outside else said


def _listed(parts: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))
