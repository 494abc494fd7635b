"""The tables of parameters and of measures, as every result and report has them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...showing.result import Table
from .space import Space

__all__ = ["digits", "ends_of", "measure_table", "parameter_table", "per_cent"]

_NARROWEST = 12  # characters of a column of numbers


def parameter_table(
    space: Space,
    parameters: Mapping[str, float],
    *,
    spread: Mapping[str, Any] | None = None,
    with_bounds: bool = True,
) -> Table:
    """Return a table of the parameters, their uncertainty, and reached bounds.

    Parameters
    ----------
    space : Space
        The searched space.
    parameters : mapping of str to float
        The optimum.
    spread : mapping, optional
        "standard_errors", "intervals", "open_ends", "determined" and "level" of an uncertainty.
    with_bounds : bool, default True
        Whether the bounds are listed.
    """
    header = ["parameter", "value"]
    if spread is not None:
        header += ["std. error", "%", f"{100 * spread['level']:g} % from", "to"]
    if with_bounds:
        header += ["from", "to"] if spread is None else ["lower bound", "upper bound"]
    at_bounds = space.at_bounds(parameters) if parameters else {}
    limits = space.at_limits(parameters) if parameters else ()
    is_open = {} if spread is None else spread.get("open_ends", {})  # older records do not have it
    rows = []
    for name, value in parameters.items():
        cells = [name, f"{value:.6g}"]
        note = "fixed" if name in space.fixed else "tied"
        if name in space.bounds:
            note = f"at its {at_bounds[name]} bound" if name in at_bounds else ""
            note = "at its limit" if name in limits else note
            if spread is not None:
                error, interval = spread["standard_errors"][name], spread["intervals"][name]
                cells += [digits(error, 3), per_cent(error, value)]
                cells += ends_of(interval, is_open.get(name, (False, False)), 5)
                note = note or ("" if spread["determined"][name] else "not determined")
            if with_bounds:
                cells += [f"{bound:.6g}" for bound in space.bounds[name]]
        rows.append([*cells, *[""] * (len(header) - len(cells)), note])
    return Table(rows, [*header, ""], _NARROWEST)


def ends_of(interval: tuple[float, float], is_open: tuple[bool, bool], count: int) -> list[str]:
    """Return both ends of an interval with `count` digits; "<" and ">" mark ends at a bound."""
    marks = ("<" * is_open[0], ">" * is_open[1])
    return [f"{mark}{digits(end, count)}" for mark, end in zip(marks, interval, strict=True)]


def digits(value: float, count: int) -> str:
    """Return a number with `count` digits, as 176340 rather than 1.7634e+05."""
    return f"{float(f'{value:.{count}g}'):.10g}"


def per_cent(error: float, value: float) -> str:
    """Return an error in per cent of a value, to two digits; nothing where the value is 0."""
    share = 100.0 * abs(error / value) if value else math.inf
    if not math.isfinite(share):
        return ""
    return f"{share:.2g}" if share < 99.5 else f"{share:.0f}"


def measure_table(values: Mapping[str, float], minimised: str, preset: str) -> Table:
    """Return the values at an optimum under every measure, and which of them was minimised."""
    rows = [
        [name, f"{value:.6g}", "minimised" if name == minimised else ""]
        for name, value in values.items()
    ]
    return Table(rows, ["measure", "value", f"(preset {preset})"], _NARROWEST)
