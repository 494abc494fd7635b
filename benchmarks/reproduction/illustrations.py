"""The introduction's and the methods' pictures, drawn by the library: figures 1, 3, 4, 5 and 6.

(Figure 2 has a stress–strain loop: hardening_figures.py.) With them what section 2 says of area
and of the Fréchet distance, measured on the paper's loops: whether points added to a curve change
its area, and how far the discrete Fréchet distance is from the continuous one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from problems import (
    LOOPS,
    Array,
    load_unload,
    load_unload_data,
    paper_responses,
    test_loops,
)
from report import Run, legend_below, table

import curvewise
from curvewise import plotting

FITTED = {"b0": 1.0, "b1": -1.0, "b2": 1.0, "b3": 1.0}


def main() -> None:
    """Draw, measure, write."""
    run = Run(__doc__)
    draw_noise(run)
    draw_mapping(run)
    draw_quads(run)
    draw_warping(run)
    draw_lengths(run)
    run.section("shared_strains", shared_table())
    run.section("added_points", added_table())
    run.section("discrete_frechet", frechet_table())


def draw_noise(run: Run) -> None:
    """Draw figure 1: noisy data and a model, whole and in detail with the points' order."""
    from matplotlib.figure import Figure

    test = load_unload_data(noise=True)
    model = load_unload(FITTED)[::3]  # a model has its own points
    figure = Figure(figsize=(10, 4.2), layout="constrained")
    whole, detail = figure.subplots(1, 2)
    for panel in (whole, detail):
        panel.plot(*test.T, "o-", color="0.5", markersize=3, linewidth=0.6, label="test")
        panel.plot(*model.T, ".-", color="#D55E00", linewidth=1.4, label="model")
        panel.set(xlabel="strain", ylabel="stress")
    detail.set(xlim=(0.78, 0.86), ylim=(0.55, 1.5))
    for i in np.flatnonzero((test[:, 0] > 0.78) & (test[:, 0] < 0.86)):
        offset = {"textcoords": "offset points", "xytext": (4, 3), "fontsize": "x-small"}
        detail.annotate(str(i), test[i], annotation_clip=True, **offset)
    whole.set_title("(a)")
    detail.set_title("(b), with the order of the test's points")
    legend_below(figure, whole)
    run.picture("figure_01", figure)


def draw_mapping(run: Run) -> None:
    """Draw figure 3: partial curve mapping between curves of different lengths."""
    x = np.linspace(0, 1, 30)
    longer = np.column_stack((x, np.sin(3 * x)))
    shorter = np.column_stack((0.15 + 0.6 * x[::3], np.sin(3 * (0.12 + 0.6 * x[::3])) - 0.15))
    draw(run, "figure_03", plotting.plot_pcm, longer, shorter)


def draw_quads(run: Run) -> None:
    """Draw figure 4: five points against four, the longest segment of which is bisected."""
    test = np.array([(0, 0), (1, 1.6), (2, 2.6), (3, 3.1), (4, 3.3)])
    model = np.array([(0.3, -0.2), (1.4, 1.2), (2.3, 1.9), (4.2, 2.4)])
    draw(run, "figure_04", plotting.plot_area, test, model)


def draw_warping(run: Run) -> None:
    """Draw figure 5: two curves, and the cumulative table with the path."""
    from matplotlib.figure import Figure

    t = np.linspace(0, 1, 24)
    P = np.column_stack((t, np.sin(6 * t) + t))
    Q = np.column_stack((t[::2] ** 1.3, np.sin(6 * t[::2] + 0.5) + t[::2] - 0.3))
    figure = Figure(figsize=(10, 4.2), layout="constrained")
    curves, cells = figure.subplots(1, 2)
    plotting.plot_alignment(P, Q, curves, measure="dtw")
    image, _ = plotting.plot_table(P, Q, cells, measure="dtw")
    figure.colorbar(image, label="cumulative distance")
    curves.set_title("(a)")
    cells.set_title(f"(b): the corner is {curvewise.dtw(P, Q):.3f}")
    curves.legend(frameon=False)
    run.picture("figure_05", figure)


def draw_lengths(run: Run) -> None:
    """Draw figure 6: points compared at equal fractions of the arc length."""
    x = np.linspace(0, 1, 14)
    test = np.column_stack((x, np.sqrt(x)))
    model = np.column_stack((1.05 * x[::2], 0.85 * np.sqrt(x[::2]) + 0.02))
    draw(run, "figure_06", plotting.plot_curve_length, test, model)


def draw(run: Run, name: str, picture: Callable[..., object], P: Array, Q: Array) -> None:
    """Draw what a measure sees into a picture of its own, with the points of both curves."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.5, 4), layout="constrained")
    panel = figure.subplots()
    picture(P, Q, panel)
    panel.plot(*np.concatenate((P, Q)).T, ".", color="black", markersize=5, label="points")
    panel.legend(frameon=False)
    run.picture(name, figure)


def shared_table() -> str:
    """Return how many points have a strain, or a stress, in common: what Eq. 1 would need."""
    rows = []
    for k, P, Q in zip(LOOPS, test_loops(), paper_responses("area"), strict=True):
        # The first point of both is the unloaded state, read from the figure to 1e-7.
        shared = [np.intersect1d(P[1:, c], Q[1:, c]).size for c in (0, 1)]
        rows.append([f"loop {k}", *(str(n) for n in (len(P), len(Q), *shared))])
    header = ["loop", "points, test", "points, model", "strains shared", "stresses shared"]
    return table(header, rows)


def added_table() -> str:
    """Return what points added on the straight lines between points do to the area."""
    treatments = {
        "as they are": lambda P, Q: (P, Q),
        "every segment of both bisected": lambda P, Q: (bisected(P), bisected(Q)),
        "of both, thrice": lambda P, Q: (bisected(P, 3), bisected(Q, 3)),
        "first half of the model bisected": lambda P, Q: (P, half_bisected(Q)),
    }
    options = {
        "text (Euclidean)": {"spacing": "distance"},
        "Table 4 (spacing x)": {"spacing": "x"},
        "scaled, split": {"crossing": "split"},
        "scaled, split, by arc length": {"crossing": "split", "spacing": "arc_length"},
    }
    rows = []
    for name, treatment in treatments.items():
        cells = []
        for title, chosen in options.items():
            total = 0.0
            for P, Q in zip(test_loops(), paper_responses("area"), strict=True):
                curves = curvewise.normalize(P, Q) if "scaled" in title else (P, Q)
                total += curvewise.area(*treatment(*curves), **chosen)
            cells.append(f"{total:.4g}")
        rows.append([name, *cells])
    return table(["area, sum of five loops", *options], rows)


def bisected(curve: Array, times: int = 1) -> Array:
    """Return a curve with the middle of every segment as a further point."""
    for _ in range(times):
        at = np.arange(0, len(curve) - 0.5, 0.5)
        curve = np.column_stack([np.interp(at, np.arange(len(curve)), c) for c in curve.T])
    return curve


def half_bisected(curve: Array) -> Array:
    """Return a curve whose first half alone is bisected."""
    middle = len(curve) // 2
    return np.concatenate((bisected(curve[: middle + 1]), curve[middle + 1 :]))


def frechet_table() -> str:
    """Return the discrete Fréchet distance beside the continuous one, and what bounds their gap."""
    rows = []
    for k, P, Q in zip(LOOPS, test_loops(), paper_responses("area"), strict=True):
        P, Q = curvewise.normalize(P, Q)
        discrete = curvewise.frechet(P, Q)
        continuous = curvewise.frechet_continuous(P, Q)
        edge = max(map(longest_edge, (P, Q)))
        swept = curvewise.frechet_info(P, Q).share
        values = (discrete, continuous, edge)
        cells = [*(f"{value:.5f}" for value in values), f"{continuous / discrete:.2f}"]
        rows.append([f"loop {k}", *cells, f"{100 * swept:.0f} %"])
    header = ["loop", "discrete", "continuous", "longest edge", "continuous over discrete"]
    return table([*header, "cells of the table computed"], rows)


def longest_edge(curve: Array) -> float:
    """Return the length of the longest segment."""
    return float(np.hypot(*np.diff(curve, axis=0).T).max())


if __name__ == "__main__":
    main()
