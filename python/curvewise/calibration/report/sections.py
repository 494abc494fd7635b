"""The sections of a page, each as HTML, with the figures that belong to it."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...comparing.deviations import Deviation, cells
from ...showing.result import Table, paragraph
from ..problem.tables import measure_table, parameter_table
from ..records.search_record import SearchRecord, curves_of
from . import figures
from .branches import branches_of
from .figures import Figure
from .repeating import code_to_repeat
from .uncertainty_summary import space_of

__all__ = ["AddFigure", "headline", "most_points", "objective_name", "overview", "sections_of"]

AddFigure = Callable[[Figure, str], str]
"""Takes a figure and what it shows in words, and returns the HTML of its place."""

_MOST_FAILURES = 100  # in the table; the others are counted


def headline(record: SearchRecord, summary: dict[str, Any] | None) -> str:
    """Return the state of a search as a sentence; what is undetermined has not converged."""
    failed = sum(one.failed for one in record.evaluations)
    count = f"{len(record.evaluations)} evaluations" + (f", {failed} failed" if failed else "")
    if record.ending is None:
        return f"The search has not ended: it was interrupted, or goes on. So far {count}."
    determined = {} if summary is None else summary["determined"]
    loose = [name for name, good in determined.items() if not good]
    if record.ending.converged and loose:
        names = ", ".join(loose)
        return f"Undetermined: {names}. The search ended: {record.ending.message}. {count}."
    state = "Converged" if record.ending.converged else "Not converged"
    return f"{state}: {record.ending.message}. {count}."


def objective_name(record: SearchRecord) -> str:
    """Return what is minimised, with its preset."""
    return f"{record.settings['measure']} ({record.settings['preset']})"


def overview(records: dict[int, SearchRecord]) -> str:
    """Return the parameters that several searches have found, side by side."""
    names = list(dict.fromkeys(name for record in records.values() for name in record.names))
    rows = []
    for number, record in records.items():
        parameters, best = _parameters(record), record.best
        values = [f"{parameters[name]:.5g}" if name in parameters else "" for name in names]
        value = "" if best is None else f"{best.value:.5g}"
        searched = [f"{number}", objective_name(record), record.settings["method"]]
        rows.append([*searched, *values, f"{len(record.evaluations)}", value])
    header = ["search", "measure", "method", *names, "evaluations", "value"]
    return Table(rows, header).html()


def sections_of(
    record: SearchRecord,
    summary: dict[str, Any] | None,
    reason: str,
    add: AddFigure,
    most: int,
) -> list[tuple[str, str]]:
    """Return the title and the HTML of every section.

    Parameters
    ----------
    record : SearchRecord
    summary, reason
        What `summary_of_record` gives.
    add : callable
        Adds a figure to the page.
    most : int
        How many points are drawn of a curve.
    """
    return [
        ("Parameters", _parameters_section(record, summary, reason, add)),
        ("Tests and simulations", _tests(record, add, most)),
        ("Residuals by branch", _residuals(record, add, most)),
        ("Convergence", _convergence(record, add)),
        ("Weakest directions", _weakest(record, summary, reason, add, most)),
        ("Failures", _failures(record)),
        ("Settings and versions", _settings(record)),
    ]


def _parameters(record: SearchRecord) -> dict[str, float]:
    if record.ending is not None:
        return record.ending.parameters
    best = record.best
    return {} if best is None else dict(zip(record.names, best.point, strict=True))


def _parameters_section(
    record: SearchRecord, summary: dict[str, Any] | None, reason: str, add: AddFigure
) -> str:
    space, parameters = space_of(record), _parameters(record)
    parts = [parameter_table(space, parameters, spread=summary).html()]
    if summary is None:
        parts.append(paragraph(reason))
    else:
        noise = ", ".join(f"{sigma:.3g}" for sigma in summary["sigma"])
        note = paragraph(f"Intervals from noise of standard deviation {noise} in y, loop by loop.")
        intervals = figures.intervals(space, parameters, summary)
        correlations = figures.correlations(space.names, summary["correlations"])
        left = add(intervals, "Intervals between the bounds")
        parts += [note, _side_by_side(left, add(correlations, "Correlations of the errors"))]
    if record.ending is not None:
        values, settings = record.ending.measures, record.settings
        measures = measure_table(values, settings["measure"], settings["preset"])
        parts += ["<h4>The optimum under every measure</h4>", measures.html()]
    return "\n".join(parts)


def _side_by_side(*places: str) -> str:
    """Return the places of figures beside each other, as many as the page is wide."""
    return "\n".join(['<div class="figures">', *places, "</div>"])


def _loops(record: SearchRecord) -> list[tuple[str, list[str], Any, Any]]:
    """Return title, names of the axes, test, and simulation or None, of every loop with points."""
    tests = record.experiments
    simulated: list[Any] = [*record.curves, *[None] * (len(tests) - len(record.curves))]
    details = record.details
    return list(zip(details["titles"], details["axes"], tests, simulated, strict=True))


def _tests(record: SearchRecord, add: AddFigure, most: int) -> str:
    drawn, numbers = [], []
    for title, axes, test, simulation in _loops(record):
        if test.size == 1:
            number = "" if simulation is None else f"{simulation[0, 0]:.6g}"
            numbers.append([title, f"{test[0, 0]:.6g}", number])
            continue
        figure = figures.loop(test, simulation, axes, title, most)
        drawn.append(add(figure, f"{title}: test and simulation"))
    parts = [_side_by_side(*drawn)]
    if numbers:
        parts.append(Table(numbers, ["number", "test", "simulation"]).html())
    deviations = [] if record.ending is None else record.ending.deviations
    rows = [
        [title, *cells(Deviation(*deviation))]
        for title, deviation in zip(record.details["titles"], deviations, strict=False)
        if deviation is not None
    ]
    if rows:
        parts.append(f"<h4>As {record.settings['measure']} sees it</h4>")
        parts.append(Table(rows, ["loop", "mean deviation, in units of y", "largest"]).html())
    if not record.curves:
        parts.append(paragraph("The simulated curves at the best point are not known."))
    return "\n".join(parts)


def _residuals(record: SearchRecord, add: AddFigure, most: int) -> str:
    drawn, rows = [], []
    for (title, axes, test, simulation), y in zip(_loops(record), record.details["y"], strict=True):
        if simulation is None or len(test) < 2:
            continue
        branches = branches_of(test, simulation, y)
        names = axes if len(axes) == 1 else [axes[0], axes[y]]
        drawn.append(add(figures.residuals(branches, names, title, most), f"{title}: residuals"))
        rows += [[title, *branch.row()] for branch in branches]
    if not rows:
        return paragraph("There is no simulated curve to take from a test.")
    header = ["loop", "branch", "x from", "to", "points", "mean", "rms", "largest"]
    note = "Test minus simulation, in units of y, where a warping path matches them."
    return "\n".join([paragraph(note), _side_by_side(*drawn), Table(rows, header).html()])


def _convergence(record: SearchRecord, add: AddFigure) -> str:
    if not record.evaluations:
        return paragraph("Nothing has been evaluated yet.")
    seconds = sum(one.seconds for one in record.evaluations)
    best = record.best
    assert best is not None
    text = (
        f"{len(record.evaluations)} parameter sets, which took the model {seconds:.3g} s. "
        f"Best value {best.value:.6g}, at evaluation {best.number}."
    )
    figure = figures.convergence(record.evaluations, objective_name(record))
    return f'{paragraph(text)}<div class="figures wide">{add(figure, "Convergence")}</div>'


def _weakest(
    record: SearchRecord, summary: dict[str, Any] | None, reason: str, add: AddFigure, most: int
) -> str:
    if summary is None:
        return paragraph(reason)
    names, in_words = record.names, summary["in_words"]
    drawn = []
    moved = zip(*map(curves_of, summary["moved"]), strict=True)
    for (title, axes, test, simulation), both in zip(_loops(record), moved, strict=True):
        if test.size > 1 and simulation is not None:
            figure = figures.weakest_direction(test, simulation, both, axes, title, most)
            drawn.append(add(figure, f"{title}, moved along the weakest direction"))
    changes = [
        [name, f"{summary['weakest_direction'][name]:.4g}", f"{summary['unnoticed'][name]:.4g}"]
        for name in names
    ]
    header = ["parameter", "change along the weakest direction", "change that raises the value 1 %"]
    sensitivities = [
        [title, *(f"{100 * value:.3g}" for value in row)]
        for title, row in zip(record.details["titles"], summary["sensitivities"], strict=True)
    ]
    singular = ", ".join(f"{100 * value:.3g}" for value in summary["singular_values"])
    parts = [
        paragraph(f"{in_words[:1].upper()}{in_words[1:]}."),
        _side_by_side(*drawn),
        Table(changes, header).html(),
        "<h4>How far each loop moves as a parameter goes through its bounds, % of the loop</h4>",
        Table(sensitivities, ["loop", *names]).html(),
        paragraph(f"The same for combinations of parameters, strongest to weakest: {singular} %."),
    ]
    return "\n".join(parts)


def _failures(record: SearchRecord) -> str:
    failed = [one for one in record.evaluations if one.failed]
    if not failed:
        return paragraph("No evaluation has failed.")
    rows = []
    for one in failed[:_MOST_FAILURES]:
        values = zip(record.names, one.point, strict=True)
        parameters = ", ".join(f"{name} {value:.4g}" for name, value in values)
        rows.append([f"{one.number}", parameters, one.message])
    made = Table(rows, ["evaluation", "parameters", "why"]).html()
    more = len(failed) - len(rows)
    return made + (paragraph(f"And {more} more.") if more else "")


def _settings(record: SearchRecord) -> str:
    details, settings = record.details, record.settings
    loops = zip(_loops(record), settings["weights"], strict=True)
    tests = [
        [title, f"{len(curve)}", ", ".join(axes), f"{weight:.4g}"]
        for (title, axes, curve, _), weight in loops
    ]
    rows = [["model", "; ".join(details["model"])], *details["versions"].items()]
    rows.append(["SHA-256 of the tests", settings["experiments"]])
    listed = Table(tests, ["test", "points", "columns", "weight"])
    code = html.escape(code_to_repeat(record))
    return "\n".join([f"<pre>{code}</pre>", listed.html(), Table(rows, ["", ""]).html()])


def most_points(records: Sequence[SearchRecord], budget: int) -> int:
    """Return how many points of a curve are drawn, so that all curves are within a budget."""
    # A loop is drawn up to seven times: test, simulation, residuals, and four for the directions.
    curves = sum(7 * len(record.experiments) for record in records)
    return int(np.clip(budget // max(curves, 1), 20, 3000))
