"""When one curve is a piece of the other: figure 15, and identifications from pieces.

As in figure 15: the test is a whole loop and the simulation its first branch alone, which PCM
finds to be perfect, and so does DTW with an open end once it is the simulation that is matched to
a part of the test (Tormene's, the paper's [42]). Then parameters are identified so, from the
whole load–unload cycle with a model of its loading alone. The other way round: the test is a
piece of the cycle, its record starting late and stopping early, while the model simulates all of
it. Last, what each measure makes of a wrong simulation that stops early.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from cycle import curve_error, parameter_error
from noise_filter import filtered
from problems import (
    LOAD_UNLOAD_TRUTH,
    LOOPS,
    Array,
    load_unload,
    load_unload_bounds,
    load_unload_data,
    test_loops,
)
from report import Run, table
from stores import identify_all
from studies import Effort, Found, Task, evolution

import curvewise
from curvewise.calibration import Criterion, Objective

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PIECE = slice(30, 125)  # x from 0.30 up to 1, and back to 0.81
OPEN = {"step_pattern": "symmetric1", "open_begin": True, "open_end": True}
OPEN_END = {"step_pattern": "symmetric1", "open_end": True}
CONTINUOUS = {"offsets": "continuous"}
SIMULATION = {"part": "simulation"}
FILTERED = "PCM, continuous offsets, filtered"  # the test, as in table6.py
METHODS = {
    "PCM": ("pcm", {}, "#F0E442"),
    "PCM, continuous offsets": ("pcm", CONTINUOUS, "#E69F00"),
    FILTERED: ("pcm", CONTINUOUS, "#D55E00"),
    "DTW, open ends": ("dtw", OPEN, "#009E73"),
    "DTW": ("dtw", {}, "#56B4E9"),
    "Area": ("area", {}, "#0072B2"),
}
BRANCH_METHODS = {
    "PCM": ("pcm", SIMULATION),
    "DTW, open end, part='simulation'": ("dtw", OPEN_END | SIMULATION),
    "DTW, open end": ("dtw", OPEN_END),
    "DTW": ("dtw", {}),
    "Area": ("area", {}),
    "Fréchet": ("frechet", {}),
    "Curve length": ("curve_length", {}),
}
KEPT = (1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2)
SEEDS = 2
# A smaller population misses PCM's optimum, which lies beside plateaus.
EFFORT: Effort = {"de": evolution(25, 200, tol=1e-6), "nelder-mead": {}}
QUICK: Effort = {"de": evolution(4, 10), "nelder-mead": {"restarts": 0, "maxfev": 100}}


def main() -> None:
    """Compare branches, identify from pieces, cut the simulation, print, draw, write."""
    run = Run(__doc__, workers=1, seeds=SEEDS)
    run.section("figure_15", branch_table())
    draw_branch(run)
    run.section("partial_branch", branch_fit_table(branch_fits(run)))
    exact, noisy = (piece_fits(run, noise=noise) for noise in (False, True))
    run.section("partial_piece", piece_table(exact, noisy))
    cut = cut_values()
    run.section("partial_cut", cut_table(cut))
    draw_pieces(run, exact, cut)


def first_branch(loop: Array) -> Array:
    """Return a loop up to its first turning point."""
    return loop[: int(np.argmax(loop[:, 0])) + 1]


def branch_table() -> str:
    """Return every measure of a loop and its own first branch."""
    rows = []
    for name, (measure, options) in BRANCH_METHODS.items():
        values = []
        for loop in test_loops():
            objective = Objective(
                loop, Criterion(measure, preset="paper", min_coverage=0.0, **options)
            )
            values.append(objective(first_branch(loop)))
        rows.append([name, *("0" if value == 0 else f"{value:.4g}" for value in values)])
    return table(["loop against its first branch", *(f"loop {k}" for k in LOOPS)], rows)


def loading(parameters: Mapping[str, float]) -> Array:
    """Return the loading branch of the load–unload cycle alone."""
    return load_unload({**LOAD_UNLOAD_TRUTH, **parameters})[:100]


def branch_tasks(*, quick: bool = False) -> dict[tuple[str, str], Task]:
    """Return the identification of loading from the whole cycle by each method."""
    bounds = {name: load_unload_bounds()[name] for name in ("b0", "b1")}
    return {
        (name, data): Task(
            f"branch_{data}_{name}",
            loading,
            [load_unload_data(noise=data == "noise")],
            bounds,
            measure,
            QUICK if quick else EFFORT,
            options=options,
        )
        for name, (measure, options) in BRANCH_METHODS.items()
        for data in ("exact", "noise")
    }


def branch_fits(run: Run) -> dict[tuple[str, str], Found]:
    """Return what each method identifies of loading from the whole cycle."""
    tasks = branch_tasks(quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("partial"), run.options.workers)
    return {key: found[task.name] for key, task in tasks.items()}


def branch_fit_table(found: Mapping[tuple[str, str], Found]) -> str:
    """Return the parameters of loading, without and with noise."""
    rows = []
    for name in BRANCH_METHODS:
        cells = []
        for data in ("exact", "noise"):
            fit = found[name, data]
            error = max(abs(fit.parameters[b] - LOAD_UNLOAD_TRUTH[b]) for b in fit.parameters)
            cells += [*(f"{value:.4f}" for value in fit.parameters.values()), f"{error:.1e}"]
        rows.append([name, *cells])
    columns = ("b0", "b1", "error")
    header = [f"{c}{data}" for data in ("", ", σ = 0.052") for c in columns]
    return table(["model of loading, test of the cycle", *header], rows)


def piece_tasks(seeds: int, *, noise: bool, quick: bool = False) -> dict[tuple[str, int], Task]:
    """Return the identification from its piece by each method, with each seed."""
    data = "noise" if noise else "exact"
    return {
        (name, seed): Task(
            f"piece_{data}_{name}_{seed}",
            load_unload,
            [piece(name, noise=noise)],
            load_unload_bounds(),
            measure,
            QUICK if quick else EFFORT,
            seed,
            options=options,
        )
        for name, (measure, options, _) in METHODS.items()
        for seed in range(seeds)
    }


def piece_fits(run: Run, *, noise: bool) -> dict[str, Found]:
    """Return the best that each method identifies from its piece, over the seeds."""
    seeds = 1 if run.quick else run.options.seeds
    tasks = piece_tasks(seeds, noise=noise, quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("partial"), run.options.workers)
    return {
        name: min((found[tasks[name, s].name] for s in range(seeds)), key=lambda fit: fit.value)
        for name in METHODS
    }


def piece(name: str, *, noise: bool) -> Array:
    """Return the test that a method fits."""
    test = load_unload_data(noise=noise)[PIECE]
    return filtered(test, 21) if name == FILTERED else test


def piece_table(exact: Mapping[str, Found], noisy: Mapping[str, Found]) -> str:
    """Return what each measure identifies from the piece."""
    rows = [
        [
            name,
            data,
            *(f"{value:.4f}" for value in fit.parameters.values()),
            f"{parameter_error(fit.parameters):.1e}",
            f"{100 * curve_error(fit.parameters):.2g} %",
        ]
        for data, fits in (("exact", exact), ("σ = 0.052", noisy))
        for name, fit in fits.items()
    ]
    header = ["measure", "piece", *LOAD_UNLOAD_TRUTH, "parameter error", "error of the whole cycle"]
    return table(header, rows)


def cut_values() -> list[tuple[float, float, float, float, float]]:
    """Return share kept, PCM and its coverage, DTW with open ends, area, of a cut simulation."""
    data = load_unload_data(noise=False)
    wrong = load_unload({"b0": 1.1, "b1": -1.0, "b2": 0.8, "b3": 0.9})
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


def draw_branch(run: Run) -> None:
    """Draw figure 15: a whole loop, and the branch that a model simulated."""
    from matplotlib.figure import Figure

    loop = test_loops()[4]
    figure = Figure(figsize=(6, 4.4), layout="constrained")
    panel = figure.subplots()
    panel.plot(*loop.T, ".", color="0.6", markersize=4, label="test: the whole loop 5")
    panel.plot(*first_branch(loop).T, color="#E69F00", label="simulation: its first branch")
    value = curvewise.pcm(loop, first_branch(loop))
    panel.set(title=f"PCM is {value:g}", xlabel="strain", ylabel="stress, MPa")
    panel.legend(frameon=False)
    run.picture("figure_15", figure)


def draw_pieces(
    run: Run, exact: Mapping[str, Found], cut: list[tuple[float, float, float, float, float]]
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
    right.legend(frameon=False)
    run.picture("partial", figure)


def draw_fits(panel: Axes, exact: Mapping[str, Found]) -> None:
    """Draw the piece and what was identified from it, each branch by itself."""
    for name, fit in exact.items():
        if name == FILTERED:  # exact data needs no filter
            continue
        curve = load_unload(fit.parameters)
        style = {"color": METHODS[name][2], "linewidth": 4 if name == "PCM" else 1.6}
        panel.plot(*curve[:100].T, label=name, **style)
        panel.plot(*curve[100:].T, **style)
    data = load_unload_data(noise=False)
    panel.plot(*data.T, ":", color="black", linewidth=1, label="whole cycle")
    panel.plot(*data[PIECE].T, ".", color="black", markersize=4, label="piece that was tested")
    panel.set_title("Identified from a piece")
    panel.set(xlabel="x", ylabel="y", ylim=(-0.5, 2.2))
    panel.legend(frameon=False)


if __name__ == "__main__":
    main()
