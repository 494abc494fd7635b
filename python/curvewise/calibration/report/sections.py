"""The sections of a page, each as HTML, with the figures that belong to it."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence

import numpy as np

from ...comparing.deviations import Deviation, cells
from ...showing.result import Table, paragraph
from ..problem.tables import digits, measure_table, parameter_table, per_cent
from ..records.search_record import SearchRecord, curves_of
from ..uncertainty.determined import THE_RULE
from . import figures
from .figures import Figure
from .repeating import code_to_repeat
from .shown_search import ShownSearch
from .uncertainty_summary import space_of
from .verdict import asked_for

__all__ = ["AddFigure", "most_points", "overview", "sections_of"]

AddFigure = Callable[[Figure, str], str]
"""Takes a figure and what it shows in words, and returns the HTML of its place."""

_MOST_FAILURES = 100  # in the table; the others are counted

# Functions that a page omits, because it does not run models and may have one measure.
_OF_THE_FRONT = (
    "Which runs are good for two measures at once, and what a compromise costs each of them, says "
    "front(store, tests, measures), of the runs that a store holds."
)
_OF_THE_BOUNDS = (
    "All this is of the slopes at the optimum. What the parameters move between their bounds says "
    "screening(found), in 10 runs for each parameter and 10 more. One that hardly moves a loop "
    "here and there need not be searched for: give a number in the place of its bounds."
)


def overview(searches: Sequence[ShownSearch]) -> str:
    """Return the parameters of several searches next to each other."""
    names = list(dict.fromkeys(name for search in searches for name in search.record.names))
    rows = []
    for number, search in enumerate(searches, 1):
        record, best = search.record, search.record.best
        errors = {} if search.summary is None else search.summary["standard_errors"]
        values = [_with_error(name, search.parameters, errors) for name in names]
        value = "" if best is None else f"{best.value:.5g}"
        searched = [f"{number}", search.objective, record.settings["method"]]
        rows.append([*searched, *values, f"{len(record.evaluations)}", value])
    header = ["search", "measure", "method", *names, "evaluations", "value"]
    table = Table(rows, header).html()
    several = len({search.objective for search in searches}) > 1
    return f"{table}\n{paragraph(_OF_THE_FRONT)}" if several else table


def _with_error(name: str, parameters: dict[str, float], errors: dict[str, float]) -> str:
    """Return a value with its error in per cent, if known."""
    if name not in parameters:
        return ""
    share = per_cent(errors[name], parameters[name]) if name in errors else ""
    return f"{parameters[name]:.5g}{f' ± {share} %' if share else ''}"


def sections_of(search: ShownSearch, add: AddFigure, most: int) -> list[tuple[str, str]]:
    """Return the title and the HTML of every section.

    Parameters
    ----------
    search : ShownSearch
    add : callable
        Adds a figure to the page.
    most : int
        Maximum number of drawn points of a curve.
    """
    return [
        ("Parameters", _parameters(search, add)),
        ("Tests and simulations", _tests(search, add, most)),
        ("Residuals by branch", _residuals(search, add, most)),
        ("Convergence", _convergence(search, add)),
        ("Weakest directions", _weakest(search, add, most)),
        ("Failures", _failures(search)),
        ("Settings and versions", _settings(search)),
    ]


def _parameters(search: ShownSearch, add: AddFigure) -> str:
    record, parameters, summary = search.record, search.parameters, search.summary
    space = space_of(record)
    parts = [parameter_table(space, parameters, spread=summary).html()]
    if summary is None:
        parts.append(paragraph(search.reason))
    else:
        noise = ", ".join(f"{sigma:.3g}" for sigma in summary["sigma"])
        note = paragraph(
            f"Intervals from noise of standard deviation {noise} in y, loop by loop. < and >: the "
            "interval ends at a bound, and values beyond it are possible."
        )
        intervals = figures.intervals(space, parameters, summary)
        correlations = figures.correlations(space.names, summary["correlations"])
        left = add(intervals, "Intervals between the bounds")
        if not all(summary["determined"].values()):
            note += paragraph(f"{THE_RULE}.")
        parts += [note, _side_by_side(left, add(correlations, "Correlations of the errors"))]
    if record.ending is not None:
        values, settings = record.ending.measures, record.settings
        measures = measure_table(values, settings["measure"], settings["preset"])
        parts += ["<h4>The optimum under every measure</h4>", measures.html()]
    return "\n".join(parts)


def _side_by_side(*places: str) -> str:
    """Return the places of figures in rows that fit the page."""
    return "\n".join(['<div class="figures">', *places, "</div>"])


def _tests(search: ShownSearch, add: AddFigure, most: int) -> str:
    record, loops = search.record, search.loops
    drawn, numbers = [], []
    for loop in loops:
        if loop.test.size == 1:
            number = f"{loop.simulation[0, 0]:.6g}" if loop.has_number else ""
            numbers.append([loop.title, f"{loop.test[0, 0]:.6g}", number])
            continue
        drawn.append(add(figures.loop(loop, most), f"{loop.title}: test and simulation"))
    asked = asked_for(loops)
    parts = [paragraph(asked) if asked else "", _side_by_side(*drawn)]
    if numbers:
        parts.append(Table(numbers, ["number", "test", "simulation"]).html())
    deviations = [] if record.ending is None else record.ending.deviations
    rows = [
        [loop.title, *cells(Deviation(*deviation))]
        for loop, deviation in zip(loops, deviations, strict=False)
        if deviation is not None
    ]
    if rows:
        parts.append(f"<h4>As {record.settings['measure']} sees it</h4>")
        parts.append(Table(rows, ["loop", "mean deviation, in units of y", "largest"]).html())
    if not record.curves:
        parts.append(paragraph("The simulated curves at the best point are not known."))
    return "\n".join(parts)


def _residuals(search: ShownSearch, add: AddFigure, most: int) -> str:
    drawn, rows = [], []
    for loop in search.loops:
        if loop.branches:
            drawn.append(add(figures.residuals(loop, most), f"{loop.title}: residuals"))
            rows += [[loop.title, *branch.row()] for branch in loop.branches]
    if not rows:
        return paragraph("There is no simulated curve to take from a test.")
    header = ["loop", "branch", "x from", "to", "points", "mean", "rms", "largest"]
    note = "Test minus simulation, in units of y, where a warping path matches them."
    return "\n".join([paragraph(note), _side_by_side(*drawn), Table(rows, header).html()])


def _convergence(search: ShownSearch, add: AddFigure) -> str:
    record = search.record
    if not record.evaluations:
        return paragraph("Nothing has been evaluated yet.")
    seconds = sum(one.seconds for one in record.evaluations)
    best = record.best
    assert best is not None
    text = (
        f"{len(record.evaluations)} parameter sets, which took the model {seconds:.3g} s. "
        f"Best value {best.value:.6g}, at evaluation {best.number}."
    )
    figure = figures.convergence(record.evaluations, search.objective)
    return f'{paragraph(text)}<div class="figures wide">{add(figure, "Convergence")}</div>'


def _weakest(search: ShownSearch, add: AddFigure, most: int) -> str:
    loops, summary, names = search.loops, search.summary, search.record.names
    if summary is None:
        return paragraph(search.reason)
    in_words = summary["in_words"]
    drawn = []
    moved = zip(*map(curves_of, summary["moved"]), strict=True)
    for loop, both in zip(loops, moved, strict=True):
        if loop.test.size > 1 and loop.simulation is not None:
            figure = figures.weakest_direction(loop, both, most)
            drawn.append(add(figure, f"{loop.title}, moved along the weakest direction"))
    changes = [[name, digits(summary["weakest_direction"][name], 4)] for name in names]
    header = ["parameter", "change along the weakest direction"]
    sensitivities = [
        [loop.title, *(f"{100 * value:.3g}" for value in row)]
        for loop, row in zip(loops, summary["sensitivities"], strict=True)
    ]
    noticed = figures.sensitivities(names, [loop.title for loop in loops], summary["sensitivities"])
    singular = ", ".join(f"{100 * value:.3g}" for value in summary["singular_values"])
    parts = [
        paragraph(f"{in_words[:1].upper()}{in_words[1:]}."),
        _side_by_side(*drawn),
        Table(changes, header).html(),
        "<h4>How far each loop moves as a parameter goes through its bounds, % of the loop</h4>",
        _side_by_side(add(noticed, "How far each loop moves with each parameter")),
        Table(sensitivities, ["loop", *names]).html(),
        paragraph(f"The same for combinations of parameters, strongest to weakest: {singular} %."),
        paragraph(_OF_THE_BOUNDS),
    ]
    return "\n".join(parts)


def _failures(search: ShownSearch) -> str:
    record = search.record
    failed = [one for one in record.evaluations if one.failed and not one.outside]
    outside = [one for one in record.evaluations if one.outside]
    said = ""
    if outside:
        why = outside[0].message.partition(": ")[2]
        said = paragraph(
            f"{len(outside)} parameter sets were outside of the model's own bounds, the first: "
            f"{why}."
        )
    if not failed:
        return paragraph("No evaluation has failed.") + said
    rows = []
    for one in failed[:_MOST_FAILURES]:
        values = zip(record.names, one.point, strict=True)
        parameters = ", ".join(f"{name} {value:.4g}" for name, value in values)
        rows.append([f"{one.number}", parameters, one.message])
    made = Table(rows, ["evaluation", "parameters", "why"]).html()
    more = len(failed) - len(rows)
    return made + (paragraph(f"And {more} more.") if more else "") + said


def _settings(search: ShownSearch) -> str:
    details, settings = search.record.details, search.record.settings
    tests = [
        [loop.title, f"{len(loop.test)}", ", ".join(loop.axes), f"{weight:.4g}"]
        for loop, weight in zip(search.loops, settings["weights"], strict=True)
    ]
    rows = [["model", "; ".join(details["model"])], *details["versions"].items()]
    rows.append(["SHA-256 of the tests", settings["experiments"]])
    listed = Table(tests, ["test", "points", "columns", "weight"])
    code = html.escape(code_to_repeat(search.record))
    return "\n".join([f"<pre>{code}</pre>", listed.html(), Table(rows, ["", ""]).html()])


def most_points(records: Sequence[SearchRecord], budget: int) -> int:
    """Return how many points of a curve are drawn, so that all curves are within a budget."""
    # A loop is drawn up to seven times: test, simulation, residuals, and four for the directions.
    curves = sum(7 * len(record.experiments) for record in records)
    return int(np.clip(budget // max(curves, 1), 20, 3000))
