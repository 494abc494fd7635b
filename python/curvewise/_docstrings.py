"""Text that several docstrings share, written once.

A docstring marked with :func:`filled` names a shared paragraph, or a list of choices, in braces: a
line ``{metric}`` becomes the description of that parameter; ``{measures}`` becomes the list of
measures. :func:`inherit` gives a function of the reference the docstring of its measure. Both run
once, at import.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from typing import Any, TypeVar, get_args

from ._core import measures
from ._options import EARTH_RADIUS, Metric

__all__ = ["filled", "inherit", "listed"]

Documented = TypeVar("Documented", bound=Callable[..., Any])


def listed(names: Iterable[str]) -> str:
    """Return names as numpydoc lists choices: {"a", "b"}."""
    return "{" + ", ".join(f'"{name}"' for name in names) + "}"


_ORDER_AND_RADIUS = f"""\
p : float, 1 <= p <= inf, optional
    The order of "minkowski"; 2 if not given.
radius : float > 0, optional
    Of the sphere of "haversine", in whose unit distances are; {EARTH_RADIUS}, the mean radius of
    the Earth in metres, if not given."""
_SHARED = {
    "measures": listed(measures()),
    "curves": """\
P, Q : array_like, shapes (n, d) and (m, d)
    The curves, of any d.""",
    "metric": f"""\
metric : {listed(get_args(Metric))}
    The ground distance between points; "haversine" is that along the great circle, of points
    (longitude, latitude) in degrees.
{_ORDER_AND_RADIUS}""",
    "ground": f"""\
metric : {listed(get_args(Metric))}, array_like of shape (n, m), or callable
    The ground distance between points; "haversine" is that along the great circle, of points
    (longitude, latitude) in degrees. Or one's own: the distances of all points of P and Q, or a
    function that is given some points of each, of shapes (p, d) and (q, d), and returns theirs, of
    shape (p, q); at least 0, or inf where points must not meet.
{_ORDER_AND_RADIUS}""",
    "workers": """\
workers : int
    Threads for this call: at least 1, or -1 for one per core. Never changes the result.""",
    "layout": """\
layout : {"channels_first", "channels_last"}, optional
    Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
    rows. If not given, its rows; a LayoutWarning is raised if there are more coordinates than
    points.""",
    "prune": """\
prune : bool
    Whether to leave out what cannot matter of the table. Never changes the result.""",
    "cutoff": """\
cutoff : float >= 0, optional
    A distance above it is inf, and is found to be so early.""",
    "missing": """\
missing : {"refuse", "skip"}
    Whether points with a nan are refused, or take no part; a warning then says how many.""",
    "closed": """\
closed : bool
    Whether both curves are closed: where they begin does not matter. See Notes.""",
    "closed_notes": """\
``closed=True``: a closed curve begins nowhere, and a point at its end that equals its first one
only closes it. A walk goes once around both curves by steps of one point of either or of both,
and returns to its first pair, which counts once. The value is that of the best walk:
the least of all values for P from any of its points on, and Q from any of its points on.""",
    "invalid": """\
ValueError
    A curve is not finite or empty; the curves differ in d; an option is unknown or out of
    range.
TypeError
    A curve does not hold real numbers.""",
    "own_distances": """\
With a metric of one's own, in one thread and without pruning: a callable is asked once for each
256 rows of the table (fewer where these are more than 2^21 pairs), so that memory stays
O(n + m), and up to three times for a path. It need not be symmetric. Its exceptions pass
through.""",
}
# What the reference does not have: it computes the plain table of whole curves in one thread.
_NOT_OF_THE_REFERENCE = ("workers", "prune", "cutoff", "missing")


def filled(**lists: str) -> Callable[[Documented], Documented]:
    """Replace names in braces by shared text, or by that of `lists`."""

    def fill(documented: Documented) -> Documented:
        doc = inspect.getdoc(documented)
        for name, text in {**_SHARED, **lists}.items():
            doc = doc and doc.replace(f"{{{name}}}", text)
        documented.__doc__ = doc
        return documented

    return fill


def inherit(function: Callable[..., Any], measure: Callable[..., Any]) -> None:
    """Give a function of the reference the docstring of the measure that it computes.

    The docstring that the function has in its source becomes the Notes. The examples call the
    reference instead of the package, and parameters that only the measures have are left out.
    """
    doc, notes = inspect.getdoc(measure), inspect.getdoc(function)
    if doc is None or notes is None:  # python -OO
        return
    for name in reversed(_NOT_OF_THE_REFERENCE):
        if name not in inspect.signature(function).parameters:
            doc = doc.replace(f"{_SHARED[name]}\n", "").replace(f", {name}\n", "\n")
    head, _, tail = doc.partition("\nNotes\n-----\n")
    examples = tail[tail.index("\n\nExamples\n") :]
    examples = examples.replace("import curvewise\n", "from curvewise import reference\n")
    examples = examples.replace("curvewise.", "reference.")
    function.__doc__ = f"{head}\nNotes\n-----\n{notes}{examples}"
