"""What the docstrings of the losses say, the same for PyTorch as for JAX, written once.

A loss marked with :func:`documented_loss` has in its own docstring its summary, ``{loss}``, and an
example: the sections between come from its record here, found by its name. Runs once, at import.
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
Those of :func:`curvewise.area`, except ``spacing="arc_length"`` and "function". As a loss,
    ``spacing="matched"``, which takes other increments and noise, and does not jump.""",
        """\
Jekel et al. (2018). The cuts of the refinement, or the matching, are held. Time and memory of
:func:`curvewise.values_and_gradients`.""",
    ),
    "curve_length": _Text(
        "Those of :func:`curvewise.curve_length`.",
        """\
Andrade-Campos et al. (2012). Not symmetric: P is the experiment. Time and memory of
:func:`curvewise.values_and_gradients`.""",
    ),
    "dtw": _Text(
        "Those of :func:`curvewise.dtw`.",
        f"""\
Sakoe & Chiba (1978). The warping path is held (the envelope theorem); where two cost the same,
the derivative is that of the one that :func:`curvewise.dtw_path` returns, a member of the
subdifferential. {_HELD_PATH}""",
    ),
    "frechet": _Text(
        "Those of :func:`curvewise.frechet`.",
        f"""\
Eiter & Mannila (1994). The derivative is 0 except at the one pair of points that decides; of
two that are equally far apart it is the first along :func:`curvewise.frechet_path`, a member of
the subdifferential. {_HELD_PATH}""",
    ),
    "frechet_continuous": _Text(
        "None: the measure has no options that change its value.",
        """\
Alt & Godau (1995). The derivative is that of the leash that decides, or of the two that do
together, at a point of an edge that lies between two vertices of the other curve. Time of the
value and of its matching; memory O(n + m) for each pair and thread.""",
    ),
    "soft_dtw": _Text(
        "Those of :func:`curvewise.soft_dtw`: ``gamma`` and ``window``.",
        """\
Cuturi & Blondel (2017). Time O(n m); memory O(n sqrt(m)) for each pair and thread, never the
table: pairs of 10 000 points take 40 MB.""",
    ),
    "soft_dtw_divergence": _Text(
        "Those of :func:`curvewise.soft_dtw_divergence`: ``gamma`` and ``window``.",
        """\
Blondel, Mensch & Vert (2021). 0 for equal curves, where its derivative is 0, too. Three times the
time of :func:`soft_dtw` for curves of the same length, and its memory.""",
    ),
}
_SECTIONS = """\
Parameters
----------
P, Q : {array}, shapes (n, d) and (m, d), or (b, n, d) and (b, m, d), or lists of {array}
    A pair of curves, or b pairs. Of real numbers; one of them may be a single curve that is
    compared with b. Two dimensions are always one curve: b series of shape (b, n) are
    ``P[..., None]``. A list has one curve of shape (n, d) for each pair, of any n{nested}.
lengths : pair of (b,) integers or None, optional
    How many points of each curve of P, and of Q, count in batches that are padded, from the first.
    The others may be nan; derivatives by them are 0. None counts all.
**options
    {text.options}

Returns
-------
{array}, shape () or (b,)
    The values, with the bits of :mod:`curvewise`, differentiable in both curves. Computed in
    float64; returned as float64 if a curve is, else as float32.

Raises
------
ValueError, TypeError
    As for :func:`curvewise.{name}`; shapes that do not make pairs; complex numbers; lengths
    that are not from 1 to the points of the batch; padding with nan without lengths.

Warns
-----
LayoutWarning
    All curves have the same n, and more coordinates than points.

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
