"""The figures of a page, as what plotly.js draws: dicts of traces and a layout.

They are made here and not with plotly's Python, which gives them random names. Curves are thinned
to a number of points that keeps the page small, and numbers are rounded to seven digits, more than
a screen can show. The colours are those of all figures (drawing/palette.py).
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ...drawing.figures import evenly, log_ticks, xy_labels, xy_of
from ...drawing.palette import (
    ACCENT_COLOUR,
    FILL_COLOUR,
    GROUND_COLOUR,
    P_COLOUR,
    Q_COLOUR,
    series_colours,
)
from ..problem.space import Space
from ..problem.tables import ends_of, per_cent
from ..records.evaluation import Evaluation
from .shown_search import Loop

__all__ = [
    "Figure",
    "before_and_after",
    "convergence",
    "correlations",
    "intervals",
    "loop",
    "residuals",
    "sensitivities",
    "weakest_direction",
]

Figure = dict[str, Any]

_DIGITS = 7
_MOST_DOTS = 5000  # of the evaluations in a convergence
_DOWNWARDS = {"type": "category", "autorange": "reversed"}  # an axis of names, as in a table


def loop(shown: Loop, most: int) -> Figure:
    """Return a test and its simulation at the optimum."""
    traces = [_line(shown.test, "test", P_COLOUR, most, mode="lines+markers", width=0.7)]
    if shown.simulation is not None:
        traces.append(_line(shown.simulation, "simulation", Q_COLOUR, most, width=2.0))
    return _figure(traces, *xy_labels(shown.axes), shown.title)


def before_and_after(curves: Sequence[Array], axes: Sequence[str], most: int) -> Figure:
    """Return the beginning of a test before and after it was prepared."""
    traces = [
        _line(curve, name, colour, most, mode="lines+markers", width=1.0)
        for curve, name, colour in zip(
            curves, ("before", "after"), (P_COLOUR, Q_COLOUR), strict=True
        )
    ]
    return _figure(traces, *xy_labels(axes), "The first per cent of strain")


def residuals(shown: Loop, most: int) -> Figure:
    """Return the differences of test and simulation against x, a colour for each branch."""
    branches = shown.branches
    x, _ = xy_labels(shown.axes)
    each = max(10, most // len(branches))
    traces = [
        _line(np.column_stack(both), name, colour, each, mode="lines+markers", width=0.8)
        for (name, *both), colour in zip(branches, series_colours(len(branches)), strict=True)
    ]
    y = f"test − simulation: {shown.y_name}"
    return _figure(traces, x, y, shown.title, yaxis={"zeroline": True})


def weakest_direction(shown: Loop, moved: Sequence[Array], most: int) -> Figure:
    """Return a loop, and the same moved both ways along the weakest direction."""
    traces = [
        _line(shown.test, "test", FILL_COLOUR, most, mode="markers"),
        _line(shown.simulation, "optimum", ACCENT_COLOUR, most, width=1.5),
        _line(moved[0], "one way", P_COLOUR, most, width=1.5, dash="dash"),
        _line(moved[1], "and back", Q_COLOUR, most, width=1.5, dash="dash"),
    ]
    return _figure(traces, *xy_labels(shown.axes), shown.title)


def convergence(evaluations: Sequence[Evaluation], objective: str) -> Figure:
    """Return the value of every evaluation, the best so far, and which failed."""
    number = np.array([one.number for one in evaluations])
    value = np.array([one.value for one in evaluations])
    failed = np.array([one.failed for one in evaluations])
    good = np.nonzero(~failed)[0]
    shown = good[evenly(len(good), _MOST_DOTS)]
    best = np.minimum.accumulate(value)
    steps = np.nonzero(np.diff(best, prepend=np.inf, append=-np.inf)[:-1] < 0)[0]
    steps = np.union1d(steps, [len(best) - 1])
    dots = _trace(number[shown], value[shown], "evaluation", FILL_COLOUR, "markers", size=5)
    so_far = _trace(number[steps], best[steps], "best so far", ACCENT_COLOUR, width=2)
    so_far["line"]["shape"] = "hv"
    traces = [dots, so_far]
    layout: dict[str, Any] = {}
    if failed.any():
        at = np.nonzero(failed)[0][evenly(int(failed.sum()), _MOST_DOTS)]
        marks = _trace(number[at], [0.98] * len(at), "failed", Q_COLOUR, "markers", size=9)
        marks["marker"]["symbol"] = "line-ns-open"
        # Failures have a separate axis: their value, a penalty, would flatten everything else.
        said = "evaluation %{x} failed<extra></extra>"
        traces.append(marks | {"yaxis": "y2", "hovertemplate": said})
        layout["yaxis2"] = {"overlaying": "y", "range": [0, 1], "visible": False}
    drawn = value[good]
    if drawn.size and best[-1] > 0 and (ticks := log_ticks(best[-1], drawn.max())):
        texts = [f"{tick:g}" for tick in ticks]
        layout["yaxis"] = {"type": "log", "tickvals": ticks, "ticktext": texts}
    return _figure(traces, "evaluation", objective, **layout)


def intervals(space: Space, parameters: dict[str, float], summary: dict[str, Any]) -> Figure:
    """Return every parameter with its interval between its bounds, a row each."""
    names = list(space.names)
    traces = [_bars(names, [(0.0, 1.0)] * len(names), "bounds", GROUND_COLOUR, 8)]
    for good, label, colour in (
        (True, "determined", P_COLOUR),
        (False, "not determined", Q_COLOUR),
    ):
        chosen = [name for name in names if summary["determined"][name] == good]
        if not chosen:
            continue
        ends, texts = [], []
        for name in chosen:
            value, (low, high) = parameters[name], summary["intervals"][name]
            places = (space.place(name, x, parameters) for x in (low, high, value))
            ends.append([min(max(place, 0.0), 1.0) for place in places])
            share = per_cent(summary["standard_errors"][name], value)
            error = f" ± {share} %" if share else ""
            is_open = summary.get("open_ends", {}).get(name, (False, False))
            within = " to ".join(ends_of((low, high), is_open, 5))
            texts.append(html.escape(f"{name} = {value:.5g}{error}, {within}"))
        bars = _bars(chosen, [(low, high) for low, high, _ in ends], label, colour, 3)
        at = [place for *_, place in ends]
        dots = _trace(at, chosen, label, colour, "markers", size=10, legendgroup=label)
        dots |= {"text": texts, "hovertemplate": "%{text}<extra></extra>"}
        traces += [bars | {"legendgroup": label, "showlegend": False}, dots]
    return _figure(
        traces,
        "place between the bounds",
        title=f"{100 * summary['level']:g} % intervals",
        xaxis={"range": [-0.03, 1.03]},
        yaxis={**_DOWNWARDS, "categoryorder": "array", "categoryarray": names},
        height=155 + 34 * len(names),
    )


def _bars(
    names: Sequence[str], ends: Sequence[tuple[float, float]], label: str, colour: str, width: int
) -> dict[str, Any]:
    """Return a bar for each name, from one end to the other."""
    x = [x for both in ends for x in (*both, None)]
    y = [part for name in names for part in (name, name, None)]
    return _trace(x, y, label, colour, width=width, hoverinfo="skip")


def sensitivities(names: Sequence[str], titles: Sequence[str], table: Any) -> Figure:
    """Return each loop's sensitivity to each parameter, a row per parameter.

    The scale is logarithmic, so that small sensitivities are visible next to large ones.
    """
    per_cents = 100.0 * np.asarray(table)
    traces = []
    for title, row, colour in zip(titles, per_cents, series_colours(len(titles)), strict=True):
        noticed = [value if value > 0.0 else None for value in row]
        dots = _trace(noticed, names, title, colour, "markers", size=11)
        traces.append(dots | {"hovertemplate": "%{y}: %{x:.3g} % of the loop<extra></extra>"})
    return _figure(
        traces,
        "% of the loop, as the parameter goes through its bounds",
        title="What each loop notices",
        xaxis={"type": "log"},
        yaxis={**_DOWNWARDS, "categoryorder": "array", "categoryarray": list(names)},
        height=155 + 34 * len(names),
    )


def correlations(names: Sequence[str], table: Sequence[Sequence[float]]) -> Figure:
    """Return the correlations of the errors as a map, with their numbers."""
    rows = [[round(value, 2) for value in row] for row in table]
    trace = {
        "type": "heatmap",
        "x": list(names),
        "y": list(names),
        "z": rows,
        "zmin": -1,
        "zmax": 1,
        "texttemplate": "%{z:.2f}",
        "colorscale": [[0, Q_COLOUR], [0.5, "#FFFFFF"], [1, P_COLOUR]],
        "hovertemplate": "%{y}, %{x}: %{z}<extra></extra>",
    }
    return _figure(
        [trace],
        title="Correlations of the errors",
        xaxis={"type": "category", "showgrid": False},
        yaxis={**_DOWNWARDS, "showgrid": False},
        height=185 + 42 * len(names),
    )


def _line(
    curve: Array, name: str, colour: str, most: int, *, mode: str = "lines", **look: Any
) -> dict[str, Any]:
    """Return a curve, thinned to at most `most` points."""
    shown = evenly(len(curve), most)
    x, y = xy_of(curve)
    return _trace(x[shown], y[shown], name, colour, mode, **look)


def _trace(
    x: Iterable[Any],
    y: Iterable[Any],
    name: str,
    colour: str,
    mode: str = "lines",
    *,
    width: float = 1.0,
    size: int = 3,
    dash: str = "solid",
    **more: Any,
) -> dict[str, Any]:
    return {
        "type": "scatter",
        "x": [_written(value) for value in x],
        "y": [_written(value) for value in y],
        "name": name,
        "mode": mode,
        "line": {"color": colour, "width": width, "dash": dash},
        "marker": {"color": colour, "size": size},
        **more,
    }


def _written(value: Any) -> str | float | None:
    """Return a number with seven digits; None for infinity, which JSON lacks."""
    if value is None or isinstance(value, str):
        return value
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None


def _figure(
    traces: list[dict[str, Any]], x: str = "", y: str = "", title: str = "", **layout: Any
) -> Figure:
    """Return traces with a layout; the given layout extends that of every figure."""
    axis = {"zeroline": False, "gridcolor": "#E6E6E6", "linecolor": "#808080", "mirror": True}
    axis |= {"ticks": "outside", "automargin": True}
    usual: dict[str, Any] = {
        "margin": {"l": 70, "r": 20, "t": 70 if title else 45, "b": 55},
        "legend": {
            "orientation": "h",
            "x": 0,
            "y": 1.0,
            "yanchor": "bottom",
            "bgcolor": "rgba(0,0,0,0)",
        },
        "hovermode": "closest",
        "paper_bgcolor": "#FFFFFF",
        "plot_bgcolor": "#FFFFFF",
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": "#202020"},
        "height": 420,
    }
    for name, label in (("xaxis", x), ("yaxis", y)):
        text = html.escape(label, quote=False)
        layout[name] = {**axis, "title": {"text": text}, **layout.get(name, {})}
    if title:
        text = html.escape(title, quote=False)
        # To the left, out of the way of the buttons.
        usual["title"] = {"text": text, "font": {"size": 15}, "x": 0.02, "y": 0.97}
    return {"data": traces, "layout": {**usual, **layout}}
