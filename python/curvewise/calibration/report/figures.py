"""The figures of a page, as what plotly.js draws: dicts of traces and a layout.

They are made here and not by plotly's Python, which gives them random names. Curves are thinned to
a number of points that keeps the page small, and numbers are rounded to seven digits, which no
screen can show. The colours are those of every picture (drawing/palette.py).
"""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...curves.inputs import Array
from ...drawing.loops import xy_labels, xy_of
from ...drawing.palette import ACCENT_COLOUR, FILL_COLOUR, GROUND_COLOUR, P_COLOUR, Q_COLOUR, SERIES
from ..problem.space import Space
from ..records.evaluation import Evaluation

__all__ = [
    "Figure",
    "convergence",
    "correlations",
    "intervals",
    "loop",
    "residuals",
    "weakest_direction",
]

Figure = dict[str, Any]

_DIGITS = 7
_MOST_DOTS = 5000  # of the evaluations in a convergence


def loop(
    experiment: Array, simulation: Array | None, axes: Sequence[str], title: str, most: int
) -> Figure:
    """Return a test and its simulation at the optimum."""
    traces = [_line(experiment, "test", P_COLOUR, most, mode="lines+markers", width=0.7)]
    if simulation is not None:
        traces.append(_line(simulation, "simulation", Q_COLOUR, most, width=2.0))
    return {"data": traces, "layout": _layout(*xy_labels(axes), title=title)}


def residuals(
    branches: Sequence[tuple[str, Array, Array]], axes: Sequence[str], title: str, most: int
) -> Figure:
    """Return the differences of test and simulation against x, a colour for each branch."""
    x, y = xy_labels(axes)
    each = max(10, most // len(branches))
    traces = [
        _line(
            np.column_stack([place, residual]),
            name,
            SERIES[i % len(SERIES)],
            each,
            mode="lines+markers",
            width=0.8,
        )
        for i, (name, place, residual) in enumerate(branches)
    ]
    layout = _layout(x, f"test − simulation: {y}", title=title)
    layout["yaxis"]["zeroline"] = True
    return {"data": traces, "layout": layout}


def weakest_direction(
    experiment: Array,
    simulation: Array,
    moved: Sequence[Array],
    axes: Sequence[str],
    title: str,
    most: int,
) -> Figure:
    """Return a loop, and the same moved both ways along the weakest direction."""
    traces = [
        _line(experiment, "test", FILL_COLOUR, most, mode="markers"),
        _line(simulation, "optimum", ACCENT_COLOUR, most, width=1.5),
    ]
    names = ("weakest direction", "and back")
    for curve, name, colour in zip(moved, names, (P_COLOUR, Q_COLOUR), strict=True):
        traces.append(_line(curve, name, colour, most, width=1.5, dash="dash"))
    return {"data": traces, "layout": _layout(*xy_labels(axes), title=title)}


def convergence(evaluations: Sequence[Evaluation], objective: str) -> Figure:
    """Return the value of every evaluation, the best so far, and which failed."""
    number = np.array([one.number for one in evaluations])
    value = np.array([one.value for one in evaluations])
    failed = np.array([one.failed for one in evaluations])
    good = np.nonzero(~failed)[0]
    shown = good[_evenly(len(good), _MOST_DOTS)]
    best = np.minimum.accumulate(value)
    steps = np.nonzero(np.diff(best, prepend=np.inf, append=-np.inf)[:-1] < 0)[0]
    steps = np.union1d(steps, [len(best) - 1])
    traces = [
        {
            **_trace(number[shown], value[shown], "evaluation", "markers"),
            "marker": {"color": FILL_COLOUR, "size": 5},
        },
        {
            **_trace(number[steps], best[steps], "best so far", "lines"),
            "line": {"color": ACCENT_COLOUR, "width": 2, "shape": "hv"},
        },
    ]
    layout = _layout("evaluation", html.escape(objective, quote=False))
    if failed.any():
        at = np.nonzero(failed)[0][_evenly(int(failed.sum()), _MOST_DOTS)]
        # On an axis of their own: their value, a penalty, would flatten everything else.
        traces.append(
            {
                **_trace(number[at], np.full(len(at), 0.98), "failed", "markers"),
                "yaxis": "y2",
                "hovertemplate": "evaluation %{x} failed<extra></extra>",
                "marker": {"color": Q_COLOUR, "size": 9, "symbol": "line-ns-open"},
            }
        )
        layout["yaxis2"] = {"overlaying": "y", "range": [0, 1], "visible": False}
    of_good = value[good]
    if (of_good > 0).any() and (best[good] > 0).all():
        layout["yaxis"]["type"] = "log"
    return {"data": traces, "layout": layout}


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
        ends, places, texts = [], [], []
        for name in chosen:
            value, (low, high) = parameters[name], summary["intervals"][name]
            first, last, place = (_place(space, parameters, name, x) for x in (low, high, value))
            ends.append((first, last))
            places.append(place)
            texts.append(html.escape(f"{name} = {value:.5g}, {low:.5g} to {high:.5g}"))
        bars = _bars(chosen, ends, label, colour, 3)
        dots = {
            "type": "scatter",
            "x": places,
            "y": chosen,
            "mode": "markers",
            "marker": {"color": colour, "size": 10},
            "legendgroup": label,
            "name": label,
            "text": texts,
            "hovertemplate": "%{text}<extra></extra>",
        }
        traces += [bars | {"legendgroup": label, "showlegend": False}, dots]
    layout = _layout("place between the bounds", "")
    layout["xaxis"]["range"] = [-0.03, 1.03]
    layout["yaxis"] |= {
        "autorange": "reversed",
        "type": "category",
        "categoryorder": "array",
        "categoryarray": names,
    }
    layout["height"] = 130 + 34 * len(names)
    return {"data": traces, "layout": layout}


def _bars(
    names: Sequence[str], ends: Sequence[Sequence[Any]], label: str, colour: str, width: int
) -> dict[str, Any]:
    """Return a bar for each name, from one end to the other."""
    return {
        "type": "scatter",
        "x": [x for both in ends for x in (*both, None)],
        "y": [part for name in names for part in (name, name, None)],
        "mode": "lines",
        "line": {"color": colour, "width": width},
        "hoverinfo": "skip",
        "name": label,
    }


def _place(space: Space, parameters: dict[str, float], name: str, value: float) -> float | None:
    """Return where a value is between its bounds; outside of them the bound."""
    return _rounded(min(max(space.place(name, value, parameters), 0.0), 1.0))


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
        "text": [[f"{value:.2f}" for value in row] for row in rows],
        "texttemplate": "%{text}",
        "colorscale": [[0, Q_COLOUR], [0.5, "#FFFFFF"], [1, P_COLOUR]],
        "hovertemplate": "%{y}, %{x}: %{z}<extra></extra>",
    }
    layout = _layout("", "")
    layout["xaxis"] |= {"type": "category", "showgrid": False}
    layout["yaxis"] |= {"type": "category", "autorange": "reversed", "showgrid": False}
    layout["height"] = 160 + 42 * len(names)
    return {"data": [trace], "layout": layout}


def _line(
    curve: Array,
    name: str,
    colour: str,
    most: int,
    *,
    mode: str = "lines",
    width: float = 1.0,
    dash: str = "solid",
) -> dict[str, Any]:
    x, y = xy_of(curve)
    shown = _evenly(len(x), most)
    return {
        **_trace(x[shown], y[shown], name, mode),
        "line": {"color": colour, "width": width, "dash": dash},
        "marker": {"color": colour, "size": 3},
    }


def _trace(x: npt.NDArray[Any], y: npt.NDArray[Any], name: str, mode: str) -> dict[str, Any]:
    return {
        "type": "scatter",
        "x": [_rounded(value) for value in x.tolist()],
        "y": [_rounded(value) for value in y.tolist()],
        "name": name,
        "mode": mode,
    }


def _rounded(value: float) -> float | None:
    """Return a number with seven digits; JSON has no infinity, and nothing is drawn there."""
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None


def _evenly(count: int, most: int) -> npt.NDArray[np.intp]:
    """Return at most so many of the indices, the first and the last among them."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.intp)


def _layout(x: str, y: str, *, title: str = "") -> dict[str, Any]:
    axis = {"zeroline": False, "gridcolor": "#E6E6E6", "linecolor": "#808080", "mirror": True}
    axis |= {"ticks": "outside", "automargin": True}
    layout: dict[str, Any] = {
        "xaxis": {**axis, "title": {"text": html.escape(x, quote=False)}},
        "yaxis": {**axis, "title": {"text": html.escape(y, quote=False)}},
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
    if title:
        text = html.escape(title, quote=False)
        # To the left, out of the way of the buttons.
        layout["title"] = {"text": text, "font": {"size": 15}, "x": 0.02, "y": 0.97}
    return layout
