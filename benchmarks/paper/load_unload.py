"""A load–unload cycle with four parameters, without and with noise: section 3.2, figures 9 to 11.

Every measure has to find (1, −1, 1, 1) in the bounds of Table 1, from several seeds; then all fit
the paper's noisy data, whose optimum is somewhere else for each measure. The error of a fit is
that of the parameters, and the area between the fitted and the true cycle as a share of the area
under the true one's loading branch.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from problems import (
    COLOURS,
    LOAD_UNLOAD_TRUTH,
    MEASURES,
    TITLES,
    load_unload,
    load_unload_bounds,
    load_unload_data,
)
from report import Run, table
from studies import Effort, Found, Task, identify_all

import curvewise

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REQUIRED = 1e-3  # how exactly the true parameters must be found


def main() -> None:
    """Identify, print, draw, write; fail where a measure does not find the true parameters."""
    run = Run(__doc__, workers=1, seeds=10)
    seeds = 1 if run.quick else run.options.seeds
    effort = Effort("de", 20, restarts=20) if run.quick else Effort(popsize=40, restarts=20)
    tasks = [
        Task(
            f"load_unload_{'noise' if noise else 'true'}_{measure}_{seed}",
            load_unload,
            [load_unload_data(noise=noise)],
            load_unload_bounds(),
            measure,
            seed=seed,
            effort=effort,
        )
        for noise in (False, True)
        for measure in MEASURES
        for seed in range(seeds)
    ]
    found = identify_all(tasks, run.histories, run.options.workers)
    exact, noisy = (
        {m: [found[f"load_unload_{data}_{m}_{s}"] for s in range(seeds)] for m in MEASURES}
        for data in ("true", "noise")
    )
    run.section("load_unload_true", exact_table(exact))
    run.section("load_unload_noise", noisy_table(noisy))
    draw(run, exact, noisy)
    failed = [m for m in MEASURES if max(map(parameter_error, exact[m])) > REQUIRED]
    if failed:
        raise SystemExit(f"not recovered to {REQUIRED}: {', '.join(failed)}")


def parameter_error(found: Found) -> float:
    """Return the largest difference from a true parameter."""
    return max(abs(found.parameters[k] - truth) for k, truth in LOAD_UNLOAD_TRUTH.items())


def curve_error(found: Found) -> float:
    """Return the area between the fitted and the true cycle, as a share of that under loading."""
    truth = load_unload_data(noise=False)
    return curvewise.area(truth, found.simulations[0], spacing="arc_length") / (math.e - 2)


def exact_table(results: dict[str, list[Found]]) -> str:
    """Return how exactly every measure finds the true parameters."""
    rows = [
        [
            TITLES[measure],
            str(len(fits)),
            f"{max(map(parameter_error, fits)):.1e}",
            f"{max(fit.value for fit in fits):.1e}",
            f"{np.median([fit.evaluations for fit in fits]):.0f}",
        ]
        for measure, fits in results.items()
    ]
    header = ["measure", "seeds", "largest parameter error", "largest value", "evaluations"]
    return table(header, rows)


def noisy_table(results: dict[str, list[Found]]) -> str:
    """Return where the optimum goes with noise: the best of the seeds, and how they spread."""
    rows = []
    for measure, fits in results.items():
        best = min(fits, key=lambda fit: fit.value)
        spread = max(fit.value for fit in fits) / best.value - 1
        rows.append(
            [
                TITLES[measure],
                *(f"{value:.3f}" for value in best.parameters.values()),
                f"{parameter_error(best):.3f}",
                f"{100 * curve_error(best):.2f} %",
                f"{100 * spread:.2g} %",
            ]
        )
    header = ["measure", *LOAD_UNLOAD_TRUTH, "parameter error", "curve error", "seeds differ by"]
    return table(header, rows)


def draw(run: Run, exact: dict[str, list[Found]], noisy: dict[str, list[Found]]) -> None:
    """Draw the fits to exact data, to noisy data, and how far the latter are from the truth."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 4.6), layout="constrained")
    panels = figure.subplots(1, 3)
    draw_fits(panels[0], "Without noise", exact, noise=False)
    draw_fits(panels[1], "With noise", noisy, noise=True)
    x = np.linspace(0, 1, 100)
    for measure, fits in noisy.items():
        error = best_simulation(fits)[:100, 1] - (np.exp(x) - 1)
        panels[2].plot(x, error, color=COLOURS[measure])
    panels[2].axhline(0, color="0.6", linewidth=0.8)
    panels[2].set_title("With noise: loading, minus the truth")
    panels[2].set(xlabel="x", ylabel="difference in y")
    handles, labels = panels[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
    run.picture("load_unload", figure)


def draw_fits(panel: Axes, title: str, results: dict[str, list[Found]], *, noise: bool) -> None:
    """Draw the data and the best fit of each measure, in dashes where all are equal."""
    panel.plot(*load_unload_data(noise=noise).T, ".", color="0.6", markersize=5, label="data")
    for k, (measure, fits) in enumerate(results.items()):
        style = {"linewidth": 1.6, "color": COLOURS[measure], "label": TITLES[measure]}
        if not noise:
            style |= {"linewidth": 2.5, "linestyle": (3 * k, (3, 3 * len(results) - 3))}
        panel.plot(*best_simulation(fits).T, **style)
    panel.set_title(title)
    panel.set(xlabel="x", ylabel="y")


def best_simulation(fits: list[Found]) -> np.ndarray:
    """Return the curve of the fit with the lowest value."""
    return min(fits, key=lambda fit: fit.value).simulations[0]


if __name__ == "__main__":
    main()
