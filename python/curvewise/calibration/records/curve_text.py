"""Curves as text: what a history and a store write of them, and read again bit for bit.

The shape of each curve, and its float64 numbers in base64: eight bytes are eleven characters.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence

import numpy as np

from ...curves.inputs import Array

__all__ = ["curves_of", "text_of"]


def text_of(curves: Sequence[Array]) -> str:
    """Return curves as text without line breaks, commas or quotation marks."""
    return " ".join(
        f"{'x'.join(map(str, curve.shape))}:{base64.b64encode(curve.tobytes()).decode()}"
        for curve in curves
    )


def curves_of(text: str) -> tuple[Array, ...]:
    """Return the curves that a text stands for; none of an empty text."""
    curves = []
    for part in text.split():
        shape, _, numbers = part.partition(":")
        curve = np.frombuffer(base64.b64decode(numbers))
        curves.append(curve.reshape(tuple(map(int, shape.split("x")))))
    return tuple(curves)
