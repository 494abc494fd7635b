"""A run of a model as a row of the store: parameters as a key, curves as bytes, and back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list
from ..models.pool import Outcome

__all__ = ["StoredRun", "decoded", "encoded", "key_of", "parameters_of"]


class StoredRun(NamedTuple):
    """One run of a model.

    Attributes
    ----------
    parameters : dict of str to float
        The parameters of the call.
    simulations : list of ndarray, or None
        The returned curves, with None for a curve that it did not return; None if it failed.
    message : str
        The reason for the failure; empty if it succeeded.
    seconds : float
        The run time.
    """

    parameters: dict[str, Any]
    simulations: list[Array | None] | None
    message: str
    seconds: float


def key_of(parameters: Mapping[str, Any]) -> str:
    """Return parameters as a text that is the same for the same numbers, bit for bit."""
    texts = {
        name: value if isinstance(value, str) else float(value).hex()
        for name, value in parameters.items()
    }
    return json.dumps(texts, sort_keys=True)


def parameters_of(key: str) -> dict[str, Any]:
    """Return the parameters that `key_of` has encoded."""
    return {name: _number(text) for name, text in json.loads(key).items()}


def _number(text: str) -> Any:
    try:
        return float.fromhex(text)
    except ValueError:
        return text


def encoded(outcome: Outcome) -> tuple[str, bytes]:
    """Return the shapes of the curves as JSON, null for one that is missing, and their numbers.

    Raises
    ------
    TypeError, ValueError
        If the model returned something other than curves of real numbers.
    """
    if outcome.message:
        return "null", b""
    if outcome.simulations is None:
        return "[null]", b""
    shapes: list[tuple[int, ...] | None] = []
    numbers = []
    for curve in curve_list(outcome.simulations):
        if curve is None:
            shapes.append(None)
            continue
        if isinstance(curve, BaseException) or np.iscomplexobj(curve):
            raise TypeError("not a curve of real numbers")
        points = as_points([[curve]] if np.ndim(curve) == 0 else curve, "Q")
        shapes.append(points.shape)
        numbers.append(points.tobytes())
    return json.dumps(shapes), b"".join(numbers)


def decoded(seconds: float, message: str, shapes: str, numbers: bytes) -> Outcome:
    """Return what came of a run, of the columns of its row."""
    if message:
        return Outcome(None, message, seconds)
    flat = np.frombuffer(numbers)
    curves: list[Array | None] = []
    for shape in json.loads(shapes):
        if shape is None:
            curves.append(None)
            continue
        size = int(np.prod(shape))
        curves.append(flat[:size].reshape(shape).copy())
        flat = flat[size:]
    is_missing = all(curve is None for curve in curves)
    return Outcome(None if is_missing else curves, message, seconds)
