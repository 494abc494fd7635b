"""The tables of parameters and of measures, as every result and report has them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...showing.result import Table
from .space import Space

__all__ = ["measure_table", "parameter_table"]

_NARROWEST = 12  # characters of a column of numbers


def parameter_table(
    space: Space,
    parameters: Mapping[str, float],
    *,
    spread: Mapping[str, Any] | None = None,
    with_bounds: bool = True,
) -> Table:
    """Return the parameters with what is known of each, and which are at a bound.

    Parameters
    ----------
    space : Space
        What was searched.
    parameters : mapping of str to float
        The optimum.
    spread : mapping, optional
        "standard_errors", "intervals", "determined" and "level" of an uncertainty.
    with_bounds : bool, default True
        Whether the bounds are listed.
    """
    header = ["parameter", "value"]
    if spread is not None:
        header += ["std. error", f"{100 * spread['level']:g} % from", "to"]
    if with_bounds:
        header += ["from", "to"] if spread is None else ["lower bound", "upper bound"]
    at_bounds = space.at_bounds(parameters) if parameters else {}
    rows = []
    for name, value in parameters.items():
        cells = [name, f"{value:.6g}"]
        note = "fixed" if name in space.fixed else "tied"
        if name in space.bounds:
            note = f"at its {at_bounds[name]} bound" if name in at_bounds else ""
            if spread is not None:
                low, high = spread["intervals"][name]
                cells += [f"{spread['standard_errors'][name]:.3g}", f"{low:.5g}", f"{high:.5g}"]
                note = note or ("" if spread["determined"][name] else "not determined")
            if with_bounds:
                cells += [f"{bound:.6g}" for bound in space.bounds[name]]
        rows.append([*cells, *[""] * (len(header) - len(cells)), note])
    return Table(rows, [*header, ""], _NARROWEST)


def measure_table(values: Mapping[str, float], minimised: str, preset: str) -> Table:
    """Return the values at an optimum under every measure, and which of them was minimised."""
    rows = [
        [name, f"{value:.6g}", "minimised" if name == minimised else ""]
        for name, value in values.items()
    ]
    return Table(rows, ["measure", "value", f"(preset {preset})"], _NARROWEST)
