"""The shared docstrings of the losses of PyTorch and JAX.

A loss marked with :func:`documented_loss` has a docstring with its summary, ``{loss}``, and an
example. The sections in between come from the record of its name here. Runs once, at import.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

__all__ = ["documented_loss"]

Loss = TypeVar("Loss", bound=Callable[..., Any])


class _Text(NamedTuple):
    options: str
    notes: str


_HELD_PATH = "Time O(n m), memory O(n + m) for each pair and thread."
_TEXTS = {
    "area": _Text(
        """\
Options of :func:`curvewise.area`, except ``spacing="arc_length"``, "function" and `closed`. Use
    ``spacing="matched"`` as a loss: it tolerates other increments and noise, and is continuous.""",
        """\
Jekel et al. (2018). The cuts of the refinement, or the matching, are fixed. Time and memory of
:func:`curvewise.values_and_gradients`.""",
    ),
    "curve_length": _Text(
        "Options of :func:`curvewise.curve_length`.",
        """\
Andrade-Campos et al. (2012). Not symmetric: P is the experiment. Time and memory of
:func:`curvewise.values_and_gradients`.""",
    ),
    "dtw": _Text(
        "Options of :func:`curvewise.dtw`.",
        f"""\
Sakoe & Chiba (1978). The warping path is fixed (the envelope theorem). If two paths have equal
cost, the derivative is that of the path of :func:`curvewise.dtw_path`, a member of the
subdifferential. {_HELD_PATH}""",
    ),
    "frechet": _Text(
        "Options of :func:`curvewise.frechet`.",
        f"""\
Eiter & Mannila (1994). The derivative is 0 except at the one pair of points that decides. Of
two equally distant pairs it is the first along :func:`curvewise.frechet_path`, a member of the
subdifferential. {_HELD_PATH}""",
    ),
    "frechet_continuous": _Text(
        "None: the measure does not have options that change its value.",
        """\
Alt & Godau (1995). The derivative is that of the pair distance that decides, or of the two that
decide together, at a point of an edge between two vertices of the other curve. Time of the
value and of its matching; memory O(n + m) for each pair and thread.""",
    ),
    "soft_dtw": _Text(
        "Options of :func:`curvewise.soft_dtw`: ``gamma`` and ``window``.",
        """\
Cuturi & Blondel (2017). Time O(n m); memory O(n sqrt(m)) for each pair and thread, never the
table: pairs of 10 000 points take 40 MB.""",
    ),
    "soft_dtw_divergence": _Text(
        "Options of :func:`curvewise.soft_dtw_divergence`: ``gamma`` and ``window``.",
        """\
Blondel, Mensch & Vert (2021). The value and its derivative are 0 for equal curves. Three times the
time of :func:`soft_dtw` for curves of the same length, and its memory.""",
    ),
}
_SECTIONS = """\
Parameters
----------
P, Q : {array}, shapes (n, d) and (m, d), or (b, n, d) and (b, m, d), or lists of {array}
    A pair of curves, or b pairs, of real numbers. P or Q may be a single curve that is compared
    with b curves. Two dimensions are always one curve: write ``P[..., None]`` for b series of shape
    (b, n). A list has one curve of shape (n, d) for each pair, of any n{nested}.
lengths : pair of (b,) integers or None, optional
    Number of points of each curve of P, and of Q, that count in padded batches, from the first. The
    others may be nan; derivatives by them are 0. None counts all.
**options
    {text.options}

Returns
-------
{array}, shape () or (b,)
    The values, bitwise identical to those of :mod:`curvewise`, differentiable in both curves. They
    are computed in float64, and returned as float64 if a curve is, else as float32.

Raises
------
ValueError, TypeError
    As for :func:`curvewise.{name}`. If shapes do not make pairs, numbers are complex, lengths are
    not from 1 to the points of the batch, or a batch is padded with nan without lengths.

Warns
-----
LayoutWarning
    If all curves have the same n, and more coordinates than points.

Notes
-----
{text.notes}"""


def documented_loss(array: str) -> Callable[[Loss], Loss]:
    """Replace ``{loss}`` by the sections of a loss of `array` (Tensor, Array)."""

    def fill(loss: Loss) -> Loss:
        name = loss.__name__
        nested = "; a nested tensor is such a list" if array == "Tensor" else ""
        sections = _SECTIONS.format(array=array, name=name, text=_TEXTS[name], nested=nested)
        doc = inspect.getdoc(loss)
        loss.__doc__ = doc and doc.replace("{loss}", sections)
        return loss

    return fill
