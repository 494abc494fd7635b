"""Text that several docstrings share, written once.

A docstring marked with :func:`filled` names a shared paragraph, or a list of choices, in braces. A
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
    The radius of the sphere of "haversine", in the unit of the distances. The default is
    {EARTH_RADIUS}, the mean radius of the Earth in metres."""
_SHARED = {
    "measures": listed(measures()),
    "curves": """\
P, Q : array_like, shapes (n, d) and (m, d)
    The curves, of any d.""",
    "metric": f"""\
metric : {listed(get_args(Metric))}
    The ground distance between points. "haversine" is the distance along the great circle, for
    points (longitude, latitude) in degrees.
{_ORDER_AND_RADIUS}""",
    "ground": f"""\
metric : {listed(get_args(Metric))}, array_like of shape (n, m), or callable
    The ground distance between points; "euclidean" by default. "haversine" is the distance along
    the great circle, for points (longitude, latitude) in degrees. A user-defined distance is an
    array of the distances of all points of P and Q, or a function. The function receives some
    points of each curve, of shapes (p, d) and (q, d), and returns their distances, of shape (p, q).
    Distances are at least 0; inf forbids a pair.
{_ORDER_AND_RADIUS}""",
    "workers": """\
workers : int, default 1
    Number of threads: at least 1, or -1 for one per core. The result does not change.""",
    "layout": """\
layout : {"channels_first", "channels_last"}, optional
    Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
    rows. The default is rows, with a LayoutWarning if there are more coordinates than points.""",
    "prune": """\
prune : bool, default True
    Whether to skip table cells that cannot affect the result. The result does not change.""",
    "cutoff": """\
cutoff : float >= 0, optional
    Upper limit: return inf for distances above it, which takes less time.""",
    "missing": """\
missing : {"refuse", "skip"}, default "refuse"
    Whether points with a nan raise an error, or are skipped with a warning of how many.""",
    "closed": """\
closed : bool, default False
    Whether both curves are closed, so that their first points do not matter. See Notes.""",
    "closed_notes": """\
``closed=True``: the first point of a closed curve is arbitrary, and a last point that equals it
only closes the curve. A path goes once around both curves by steps of one point of either or of
both, and returns to its first pair, which counts once. The value is the smallest over all first
points of P and of Q.""",
    "invalid": """\
ValueError
    If a curve is not finite or empty, the curves differ in d, or an option is unknown or out of
    range.
TypeError
    If a curve does not hold real numbers.""",
    "own_distances": """\
A user-defined metric is computed in one thread and without pruning. A callable is called once for
every 256 rows of the table (fewer if these are more than 2^21 pairs), so that memory stays
O(n + m), and up to three times for a path. It need not be symmetric. Its exceptions are not
caught.""",
}
# Parameters that the reference lacks: it computes the plain table of whole curves in one thread.
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
    reference instead of the package. Left out are "See Also", which names the package, and
    parameters that only the measures have.
    """
    doc, notes = inspect.getdoc(measure), inspect.getdoc(function)
    if doc is None or notes is None:  # python -OO
        return
    for name in reversed(_NOT_OF_THE_REFERENCE):
        if name not in inspect.signature(function).parameters:
            doc = doc.replace(f"{_SHARED[name]}\n", "").replace(f", {name}\n", "\n")
    head, _, tail = doc.partition("\nNotes\n-----\n")
    head = head.partition("\nSee Also\n")[0]
    examples = tail[tail.index("\n\nExamples\n") :]
    examples = examples.replace("import curvewise\n", "from curvewise import reference\n")
    examples = examples.replace("curvewise.", "reference.")
    function.__doc__ = f"{head}\nNotes\n-----\n{notes}{examples}"
