"""The pictures of find_nearest_curves.md: python benchmarks/speed/nearest_pictures.py"""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import curvewise
from curvewise.datasets import kinematic_hardening
from curvewise.drawing.palette import P_COLOUR, Q_COLOUR

IMAGES = Path(__file__).parents[2] / "docs" / "images"
GREY = "0.75"


def loop(random, yield_stress, hardening, cycles=1.25):
    strain = 0.02 * np.sin(np.linspace(0, 2 * np.pi * cycles, int(random.integers(150, 220))))
    stress = kinematic_hardening(
        strain,
        yield_stress=yield_stress * random.normal(1, 0.02),
        backstresses=[(hardening * random.normal(1, 0.03), 300.0)],
    )
    return np.column_stack([strain / 0.02, (stress + random.normal(0, 4, len(strain))) / 500])


def neighbours(random):
    """A library of four steels, a test, and the library's nearest."""
    steels = [(220, 50e3), (300, 30e3), (300, 80e3), (420, 50e3)]
    library = [loop(random, *steels[i % 4]) for i in range(80)]
    test = loop(random, *steels[2])
    distances, indices = curvewise.Index(library).kneighbors([test], 5)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for curve in library:
        left.plot(*curve.T, color=GREY, linewidth=0.5)
    for k, i in enumerate(indices[0]):
        label = "its five nearest" if k == 0 else None
        left.plot(*library[i].T, color=Q_COLOUR, linewidth=0.9, label=label)
    left.plot(*test.T, color=P_COLOUR, linewidth=1.4, label="the test")
    left.set(xlabel="strain / 0.02", ylabel="stress / 500 MPa", title="80 loops of four steels")
    left.set(xticks=(-1, 0, 1))
    left.legend(frameon=False, fontsize=8, loc=(0.25, 0.3))
    table = curvewise.cdist([test], library)[0]
    for steel in range(4):
        own = np.arange(steel, 80, 4)
        right.plot(np.full(len(own), steel), table[own], "o", color=GREY, markersize=4)
    right.plot(indices[0] % 4, distances[0], "o", color=Q_COLOUR, markersize=5)
    right.set(xticks=range(4), xlabel="steel", ylabel="dtw from the test", ylim=(0, None))
    right.set_title("How far they are from the test")
    return figure


def cycles(random):
    """A cycle, a long record, and where it occurs."""
    t = np.arange(6000)
    amplitude = np.interp(t, [0, 1500, 3000, 4500, 6000], [0.4, 1.0, 0.6, 1.0, 0.5])
    strain = 0.02 * amplitude * np.sin(2 * np.pi * t / 240 + 0.5 * np.sin(t / 700))
    stress = kinematic_hardening(strain, yield_stress=300.0, backstresses=[(60e3, 300.0)])
    record = np.column_stack([strain / 0.02, (stress + random.normal(0, 4, len(t))) / 500])
    phase = np.linspace(0, 2 * np.pi, 161)
    cycle_strain = 0.0195 * np.sin(np.concatenate([np.linspace(-3 * np.pi, 0, 300), phase]))
    cycle_stress = kinematic_hardening(
        cycle_strain, yield_stress=300.0, backstresses=[(60e3, 300.0)]
    )
    cycle = np.column_stack([cycle_strain / 0.02, cycle_stress / 500])[300:]
    found = curvewise.subsequence(cycle, record, k=6)
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9, 3), layout="constrained", width_ratios=[1, 2.6]
    )
    left.plot(*cycle.T, color=P_COLOUR, linewidth=1.4, label="the cycle")
    for k, one in enumerate(found):
        run = record[one.start : one.stop + 1]
        left.plot(*run.T, color=Q_COLOUR, linewidth=0.6, label="six runs" if k == 0 else None)
    left.set(xlabel="strain / 0.02", ylabel="stress / 500 MPa")
    left.legend(frameon=False, fontsize=8)
    right.plot(record[:, 0], color=GREY, linewidth=0.8)
    for rank, one in enumerate(found, 1):
        places = np.arange(one.start, one.stop + 1)
        right.plot(places, record[places, 0], color=Q_COLOUR, linewidth=1.6)
        right.annotate(str(rank), (places.mean(), 1.12), ha="center", fontsize=8)
    right.set(xlabel="point of the record", ylabel="strain / 0.02", ylim=(-1.2, 1.3))
    return figure


def means(random):
    """Curves that are shifted against each other, their mean point by point, and under dtw."""
    x = np.linspace(0, 1, 120)
    curves = []
    for shift in random.normal(0, 0.06, 15):
        bump = np.exp(-(((x - 0.35 - shift) / 0.05) ** 2)) + np.exp(
            -(((x - 0.7 - shift / 2) / 0.1) ** 2)
        )
        curves.append(np.column_stack([4 * x, bump + random.normal(0, 0.02, len(x))]))
    heights = [curve[:, 1] for curve in curves]
    mean = curvewise.dtw_mean(heights).curve
    chosen = curvewise.medoid(heights)
    figure, axes = plt.subplots(figsize=(6, 2.8), layout="constrained")
    for height in heights:
        axes.plot(x, height, color=GREY, linewidth=0.6)
    axes.plot(x, np.mean(heights, axis=0), "k--", linewidth=1.2, label="mean, point by point")
    axes.plot(x, heights[chosen], color=Q_COLOUR, linewidth=1.0, label="medoid")
    axes.plot(x, mean, color=P_COLOUR, linewidth=1.6, label="dtw_mean")
    axes.legend(frameon=False, fontsize=8)
    axes.set(xlabel="time", ylabel="height")
    return figure


def main() -> None:
    for name, draw in {"nearest": neighbours, "cycles": cycles, "means": means}.items():
        figure = draw(np.random.default_rng(3))
        figure.savefig(IMAGES / f"{name}.png", dpi=110)


if __name__ == "__main__":
    main()
