"""When one curve is a piece of the other: partial curve mapping, and DTW with open ends.

As in the paper's figure 15, but measured. First, the test is a piece of the load–unload cycle: its
record starts late and stops early, while the model simulates the whole cycle. PCM and DTW with
open ends can identify the parameters from the piece; area and DTW between the whole curves cannot.
Second, the other way round: the simulation stops early, and PCM likes that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from load_unload import curve_error, parameter_error
from problems import (
    LOAD_UNLOAD_TRUTH,
    Array,
    load_unload,
    load_unload_bounds,
    load_unload_data,
)
from report import Run, table
from studies import Effort, Found, Task, identify_all
from table6 import filtered

import curvewise

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PIECE = slice(30, 125)  # x from 0.30 up to 1, and back to 0.81
OPEN = {"step_pattern": "symmetric1", "open_begin": True, "open_end": True}
CONTINUOUS = {"offsets": "continuous"}
FILTERED = "PCM, continuous offsets, filtered"  # the test, as in table6.py
METHODS = {
    "PCM": ("pcm", {}, "#F0E442"),
    "PCM, continuous offsets": ("pcm", CONTINUOUS, "#E69F00"),
    FILTERED: ("pcm", CONTINUOUS, "#D55E00"),
    "DTW, open ends": ("dtw", OPEN, "#009E73"),
    "DTW": ("dtw", {}, "#56B4E9"),
    "Area": ("area", {}, "#0072B2"),
}
KEPT = (1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2)


def main() -> None:
    """Identify from a piece, cut the simulation, print, draw, write."""
    run = Run(__doc__, workers=1, seeds=3)
    exact, noisy = (identified(run, noise=noise) for noise in (False, True))
    run.section("partial_piece", piece_table(exact, noisy))
    cut = cut_values()
    run.section("partial_cut", cut_table(cut))
    draw(run, exact, cut)


def identified(run: Run, *, noise: bool) -> dict[str, Found]:
    """Return the best that each method identifies from its piece, over the seeds."""
    effort = Effort("de", 10, 100, 3) if run.quick else Effort(popsize=20, restarts=20)
    data = "noise" if noise else "true"
    tasks = {
        (name, seed): Task(
            f"partial_{data}_{name}_{seed}".replace(" ", "_").replace(",", ""),
            load_unload,
            [piece(name, noise=noise)],
            load_unload_bounds(),
            measure,
            seed=seed,
            effort=effort,
            options=options,
        )
        for name, (measure, options, _) in METHODS.items()
        for seed in range(1 if run.quick else run.options.seeds)
    }
    found = identify_all(list(tasks.values()), run.histories, run.options.workers)
    fits: dict[str, Found] = {}
    for (name, _), task in tasks.items():
        fit = found[task.name]
        if name not in fits or fit.value < fits[name].value:
            fits[name] = fit
    return fits


def piece(name: str, *, noise: bool) -> Array:
    """Return the test that a method fits."""
    test = load_unload_data(noise=noise)[PIECE]
    return filtered(test, 21) if name == FILTERED else test


def piece_table(exact: dict[str, Found], noisy: dict[str, Found]) -> str:
    """Return what each measure identifies from the piece."""
    rows = [
        [
            name,
            data,
            *(f"{value:.4f}" for value in fit.parameters.values()),
            f"{parameter_error(fit):.1e}",
            f"{100 * curve_error(fit):.2g} %",
        ]
        for data, fits in (("exact", exact), ("with noise", noisy))
        for name, fit in fits.items()
    ]
    header = ["measure", "piece", *LOAD_UNLOAD_TRUTH, "parameter error", "error of the whole cycle"]
    return table(header, rows)


def cut_values() -> list[tuple[float, float, float, float, float]]:
    """Return share kept, PCM and its coverage, DTW with open ends, area, of a cut simulation."""
    data = load_unload_data(noise=False)
    wrong = load_unload({**LOAD_UNLOAD_TRUTH, "b1": 1.2, "b2": -1.1})
    values = []
    for share in KEPT:
        cut = wrong[: round(share * len(wrong))]
        match = curvewise.pcm_match(data, cut)
        scaled = curvewise.normalize(data, cut)
        dtw = curvewise.dtw(*scaled, **OPEN)
        values.append((share, match.value, match.coverage, dtw, curvewise.area(*scaled)))
    return values


def cut_table(values: list[tuple[float, float, float, float, float]]) -> str:
    """Return what a simulation with wrong parameters is worth when it stops early."""
    rows = [
        [f"{share:.0%}", f"{pcm:.4f}", f"{coverage:.2f}", f"{dtw:.2f}", f"{area:.3f}"]
        for share, pcm, coverage, dtw, area in values
    ]
    return table(["points kept", "PCM", "coverage", "DTW, open ends", "area"], rows)


def draw(
    run: Run, exact: dict[str, Found], cut: list[tuple[float, float, float, float, float]]
) -> None:
    """Draw the fits to the piece, and the measures of the cut simulation."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_fits(left, exact)
    shares, pcm, coverage, dtw, area = np.array(cut).T
    for values, label, colour in (
        (pcm, "PCM", "#E69F00"),
        (dtw, "DTW, open ends", "#009E73"),
        (area, "Area", "#0072B2"),
    ):
        right.plot(shares, values / values[0], "o-", color=colour, markersize=3, label=label)
    right.plot(shares, coverage, "--", color="0.5", label="coverage of PCM")
    right.set_yscale("log")
    right.set_title("A wrong simulation that stops early")
    right.set(xlabel="share of the points that it has", ylabel="value over that of the whole")
    right.invert_xaxis()
    right.legend()
    run.picture("partial", figure)


def draw_fits(panel: Axes, exact: dict[str, Found]) -> None:
    """Draw the piece and what was identified from it."""
    for name, fit in exact.items():
        if name == FILTERED:  # exact data needs no filter
            continue
        style = {"linewidth": 4} if name == "PCM" else {"linewidth": 1.6}
        panel.plot(*fit.simulations[0].T, color=METHODS[name][2], label=name, **style)
    data = load_unload_data(noise=False)
    panel.plot(*data.T, ":", color="black", linewidth=1, label="whole cycle")
    panel.plot(*data[PIECE].T, ".", color="black", markersize=4, label="piece that was tested")
    panel.set_title("Identified from a piece")
    panel.set(xlabel="x", ylabel="y")
    panel.legend()


if __name__ == "__main__":
    main()
