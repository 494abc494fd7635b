"""The docstrings of the reference, which are those of the measures with other notes."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

__all__ = ["inherit"]

# Parameters that the reference lacks: it computes the plain table of whole curves in one thread.
_NOT_OF_THE_REFERENCE = ("workers", "prune", "cutoff", "missing")


def inherit(function: Callable[..., Any], measure: Callable[..., Any]) -> None:
    """Give a function of the reference the docstring of the measure that it computes.

    The docstring that the function has in its source becomes the Notes. The examples call the
    reference instead of the package. Left out are "See Also", which names the package, and
    parameters that only the measures have.
    """
    doc, notes = inspect.getdoc(measure), inspect.getdoc(function)
    if doc is None or notes is None:  # python -OO
        return
    for name in _NOT_OF_THE_REFERENCE:
        if name not in inspect.signature(function).parameters:
            doc = re.sub(rf"^{name} : .*\n(?: .*\n)+", "", doc, flags=re.MULTILINE)
            doc = re.sub(rf"^(\w+,.*), {name}\b", r"\1", doc, flags=re.MULTILINE)
    head, _, tail = doc.partition("\nNotes\n-----\n")
    head = head.partition("\nSee Also\n")[0]
    examples = tail[tail.index("\n\nExamples\n") :]
    examples = examples.replace("import curvewise\n", "from curvewise import reference\n")
    examples = examples.replace("curvewise.", "reference.")
    function.__doc__ = f"{head}\nNotes\n-----\n{notes}{examples}"
