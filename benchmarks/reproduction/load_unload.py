"""A load–unload cycle with four parameters, without and with noise: section 3.2, figures 9 to 11.

Every measure has to find (1, −1, 1, 1) in the bounds of Table 1, from ten seeds, by an evolution
of 200 generations of 100 members, as long as the paper's genetic algorithm; Nelder–Mead after it
tells whether what is left is the search's or the measure's. Then all fit noisy data: the author's
file (σ = 0.052), and three draws each of σ = 0.05 and of the text's σ² = 0.05.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from cycle import CONDITIONS, FIVE, SCALED, SQUARES, curve_error, parameter_error
from problems import (
    LOAD_UNLOAD_TRUTH,
    Array,
    load_unload,
    load_unload_data,
    load_unload_noisy,
)
from report import Run, legend_below, table
from stores import identify_all
from studies import Effort, Found, Task, evolution

import curvewise

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REQUIRED = 1e-3  # how exactly the true parameters must be found
TEXT = math.sqrt(0.05)  # the standard deviation that the text's variance means
DRAWS = 3
SEEDS = 10
NOISY_SEEDS = 3
GENERATIONS = 200
# An `atol` of 0: the evolution goes on to its last generation, however small the value.
EFFORT: Effort = {"de": evolution(25, GENERATIONS, atol=0.0), "nelder-mead": {"restarts": 20}}
# With noise three seeds tell whether the optimum is found: a population that agrees is enough.
NOISY_EFFORT: Effort = {"de": evolution(15, GENERATIONS, tol=1e-6), "nelder-mead": {}}
# Ten individuals are trapped for one seed in six (pcm), fifteen for none.
QUICK: Effort = {"de": evolution(15, 80), "nelder-mead": {"restarts": 20}}
Noisy: TypeAlias = dict[tuple[str, str], list[list[Found]]]
"""For a condition and the name of the data: for each draw the fits, the best first."""

NOISY = {"file": "0.052", "0.05": "0.05", "text": "0.2236"}
WITH_SQUARES = {"sum_of_squares": SQUARES, **FIVE}
EXACT = {**WITH_SQUARES, **SCALED}


def main() -> None:
    """Identify, print, draw, write; fail where a measure does not find the true parameters."""
    run = Run(__doc__, workers=1, seeds=SEEDS)
    exact = exact_fits(run)
    noisy = noisy_fits(run)
    run.section("load_unload_signal", signal_table())
    run.section("load_unload_true", exact_table(exact))
    for name, title in NOISY.items():
        if not run.quick or name == "file":
            run.section(f"load_unload_{name}", noisy_table(noisy, name, title))
    run.section("load_unload_between", fit_table(noisy))
    run.section("load_unload_generations", generation_table(exact, noisy))
    draw_histories(run, exact, noisy)
    draw_exact(run, exact)
    draw_noisy(run, noisy)
    failed = [c for c in exact if max(parameter_error(f.parameters) for f in exact[c]) > REQUIRED]
    if failed:
        raise SystemExit(f"not recovered to {REQUIRED}: {', '.join(failed)}")


def tests(name: str) -> list[Array]:
    """Return the noisy data of a name: the author's, or our own of one deviation."""
    if name == "file":
        return [load_unload_data(noise=True)]
    deviation = TEXT if name == "text" else float(name)
    return [load_unload_noisy(deviation, draw) for draw in range(DRAWS)]


def exact_tasks(seeds: int, *, quick: bool = False) -> dict[tuple[str, int], Task]:
    """Return the identification without noise under each condition, with each seed."""
    return {
        (key, seed): condition.task(
            f"exact_{key}_{seed}",
            load_unload_data(noise=False),
            QUICK if quick else EFFORT,
            seed,
            traced=seed == 0,
        )
        for key, condition in EXACT.items()
        for seed in range(seeds)
    }


def noisy_tasks(*, quick: bool = False) -> dict[tuple[str, str, int, int], Task]:
    """Return the identification from each noisy data set under each condition, with each seed."""
    return {
        (key, name, draw, seed): condition.task(
            f"{name}_{draw}_{key}_{seed}",
            test,
            QUICK if quick else EFFORT if traced(key, name, seed) else NOISY_EFFORT,
            seed,
            traced=traced(key, name, seed),
        )
        for key, condition in CONDITIONS.items()
        for name in (("file",) if quick else NOISY)
        for draw, test in enumerate(tests(name))
        for seed in range(1 if quick else NOISY_SEEDS)
    }


def exact_fits(run: Run) -> dict[str, list[Found]]:
    """Return what is found without noise from every seed."""
    seeds = 1 if run.quick else run.options.seeds
    tasks = exact_tasks(seeds, quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("load_unload"), run.options.workers)
    return {key: [found[tasks[key, s].name] for s in range(seeds)] for key in EXACT}


def noisy_fits(run: Run) -> Noisy:
    """Return what the seeds find for every condition and data set, draw by draw."""
    tasks = noisy_tasks(quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("load_unload"), run.options.workers)
    results: Noisy = {}
    for (key, name, draw, _), task in tasks.items():
        draws = results.setdefault((key, name), [[] for _ in tests(name)])
        draws[draw].append(found[task.name])
    for draws in results.values():
        for fits in draws:
            fits.sort(key=lambda fit: fit.value)
    return results


def traced(key: str, name: str, seed: int) -> bool:
    """Return whether figure 9 shows this fit: it is searched for as the exact ones are."""
    return name == "file" and seed == 0 and key in WITH_SQUARES


def signal_table() -> str:
    """Return the signal-to-noise ratio, mean of f over σ, and how much noise lengthens a test."""
    truth, test = (load_unload_data(noise=noise)[:, 1] for noise in (False, True))
    cases = {
        "text, σ² = 0.05": (TEXT, tests("text")[0]),
        "author's notebook, σ = 0.05": (0.05, tests("0.05")[0]),
        "author's file": ((test - truth).std(), tests("file")[0]),
    }
    rows = [["*paper, printed*", "*√0.05*", "*3.33*", "", ""]]
    for name, (deviation, noisy) in cases.items():
        ratios = [f"{mean / deviation:.2f}" for mean in (test.mean(), truth.mean())]
        coverage = curvewise.pcm_match(noisy, load_unload_data(noise=False)).coverage
        rows.append([name, f"{deviation:.4f}", *ratios, f"{coverage:.2f}"])
    header = [
        "noise",
        "σ",
        "mean of the noisy f over σ",
        "mean of the true f over σ",
        "length of the true cycle over the test's",
    ]
    note = f"Means: {test.mean():.4f} and {truth.mean():.4f}; the true height: {truth.max():.4f}."
    return f"{table(header, rows)}\n\n{note}"


def exact_table(results: Mapping[str, Sequence[Found]]) -> str:
    """Return how exactly every measure finds the true parameters, by each stage."""
    rows = []
    for key, fits in results.items():
        cells = [EXACT[key].title, str(len(fits))]
        for stages in zip(*(fit.stages for fit in fits), strict=True):
            cells.append(f"{max(parameter_error(stage.parameters) for stage in stages):.1e}")
            cells.append(f"{max(stage.value for stage in stages):.1e}")
            cells.append(f"{np.median([stage.evaluations for stage in stages]):.0f}")
        rows.append(cells)
    columns = ("largest error", "largest value", "runs")
    header = ["measure", "seeds", *(f"{s}: {c}" for s in ("DE", "Nelder–Mead") for c in columns)]
    return table(header, rows)


def noisy_table(results: Noisy, name: str, title: str) -> str:
    """Return where the optimum goes with noise: a number for every draw."""
    rows = []
    for key, condition in CONDITIONS.items():
        fits = [seeds[0].parameters for seeds in results[key, name]]
        cells = [", ".join(f"{fit[b]:.2f}" for fit in fits) for b in LOAD_UNLOAD_TRUTH]
        cells.append(", ".join(f"{parameter_error(fit):.2f}" for fit in fits))
        cells.append(", ".join(f"{100 * curve_error(fit):.1f}" for fit in fits))
        cells.append(", ".join(f"{apart(seeds):.2f}" for seeds in results[key, name]))
        rows.append([condition.title, *cells])
    columns = ("parameter error", "curve error, %", "seeds apart")
    header = [f"σ = {title}", *LOAD_UNLOAD_TRUTH, *columns]
    return table(header, rows)


def apart(seeds: Sequence[Found]) -> float:
    """Return how far the parameters of seeds differ whose values are equal to 0.1 %."""
    return max(
        abs(fit.parameters[name] - seeds[0].parameters[name])
        for fit in as_good(seeds)
        for name in LOAD_UNLOAD_TRUTH
    )


def as_good(seeds: Sequence[Found]) -> list[Found]:
    """Return the fits whose values are the first one's to 0.1 %."""
    return [fit for fit in seeds if fit.value <= 1.001 * seeds[0].value]


def fit_table(results: Noisy) -> str:
    """Return where the fits run through the author's data, and how far from the least squares'.

    The shares of points are those of every seed whose value is the best's to 0.1 %, the best first.
    """
    test = load_unload_data(noise=True)[:, 1]
    deviation = (test - load_unload_data(noise=False)[:, 1]).std()
    squares = load_unload(results["sum_of_squares", "file"][0][0].parameters)[:, 1]
    rows = []
    for key, condition in CONDITIONS.items():
        equal = as_good(results[key, "file"][0])
        curves = [load_unload(fit.parameters)[:, 1] for fit in equal]
        shares = np.array([[part.mean() for part in np.split(test > y, [100])] for y in curves])
        apart = np.abs(curves[0] - squares).mean() / deviation
        misfit = math.sqrt(np.mean((test - curves[0]) ** 2)) / deviation
        cells = [*map(percentages, shares.T), f"{misfit:.2f}", f"{apart:.2f}"]
        rows.append([condition.title, *cells])
    header = [
        "measure",
        "points above, loading",
        "points above, unloading",
        "RMS misfit / σ",
        "mean distance from least squares / σ",
    ]
    return table(header, rows)


def percentages(shares: Array) -> str:
    """Return shares in percent, once where all are alike."""
    texts = list(dict.fromkeys(f"{100 * share:.0f}" for share in shares))
    return f"{', '.join(texts if len(texts) == 1 else [f'{100 * s:.0f}' for s in shares])} %"


def generation_table(exact: Mapping[str, Sequence[Found]], noisy: Noisy) -> str:
    """Return figure 9 in numbers: how much the last generations brought."""
    rows = []
    for key, condition in WITH_SQUARES.items():
        clean, rough = trace(exact[key]), trace(noisy[key, "file"][0])
        end = len(clean) - 1
        still = np.flatnonzero(rough > 1.001 * rough[-1])
        settled = f"{still[-1] + 1 if still.size else 0}"
        cells = [f"{clean[k] / clean[0]:.1e}" for k in (end // 4, end // 2, end)]
        rows.append([condition.title, *cells, settled])
    quarter = [f"{end * share:.0f}" for share in (0.25, 0.5, 1)]
    header = [
        "measure",
        *(f"no noise: after {k}, of the first" for k in quarter),
        "noise: within 0.1 % of its end after",
    ]
    return table(header, rows)


def trace(fits: Sequence[Found]) -> Array:
    """Return the best value after every generation, of the fit that was traced."""
    return np.array(next(s.trace for fit in fits for s in fit.stages if s.trace))


def draw_histories(
    run: Run,
    exact: Mapping[str, Sequence[Found]],
    noisy: Noisy,
) -> None:
    """Draw figure 9: the best value against the generation."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 4.2), layout="constrained")
    panels = figure.subplots(1, 2)
    for key, condition in WITH_SQUARES.items():
        style = {"color": condition.colour, "label": condition.title, "linewidth": 1.4}
        panels[0].plot(trace(exact[key]), **style)
        panels[1].plot(trace(noisy[key, "file"][0]), **style)
    for panel, title in zip(panels, ("Without noise", "With noise, σ = 0.052"), strict=True):
        panel.set_yscale("log")
        panel.set(title=title, xlabel="generation", ylabel="best value")
    legend_below(figure, panels[0])
    run.picture("figure_09", figure)


def draw_exact(run: Run, results: Mapping[str, Sequence[Found]]) -> None:
    """Draw figure 10: the fits without noise, ever narrower, as they cover each other."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6, 4.6), layout="constrained")
    panel = figure.subplots()
    for k, (key, condition) in enumerate(FIVE.items()):
        best = min(results[key], key=lambda fit: fit.value)
        style = {"color": condition.colour, "linewidth": 11 - 2.4 * k}
        panel.plot(*load_unload(best.parameters).T, **style, label=condition.title)
    panel.plot(*load_unload_data(noise=False).T, ".", color="black", markersize=2, label="data")
    panel.set(title="Without noise", xlabel="strain", ylabel="stress")
    panel.legend(frameon=False)
    run.picture("figure_10", figure)


def draw_noisy(run: Run, results: Noisy) -> None:
    """Draw figure 11: the fits with noise of the author's file, and of the text."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.8), layout="constrained")
    names = ("file",) if run.quick else ("file", "text")
    panels = figure.subplots(1, len(names), squeeze=False).ravel()
    for panel, name in zip(panels, names, strict=True):
        draw_fits(panel, tests(name)[0], {k: results[k, name][0][0] for k in WITH_SQUARES})
        panel.set(title=f"Noise of σ = {NOISY[name]}", xlabel="strain", ylabel="stress")
    legend_below(figure, panels[0])
    run.picture("figure_11", figure)


def draw_fits(panel: Axes, test: Array, fits: Mapping[str, Found]) -> None:
    """Draw data and the fits to it, each branch by itself: they need not meet."""
    panel.plot(*test.T, ".", color="0.7", markersize=5, label="data")
    for key, fit in fits.items():
        width = 4 if key == "sum_of_squares" else 1.5  # others cover it
        curve = load_unload(fit.parameters)
        style = {"color": WITH_SQUARES[key].colour, "linewidth": width}
        panel.plot(*curve[:100].T, **style, label=WITH_SQUARES[key].title)
        panel.plot(*curve[100:].T, **style)
    low, high = test[:, 1].min(), test[:, 1].max()
    panel.set_ylim(low - 0.2 * (high - low), high + 0.2 * (high - low))


if __name__ == "__main__":
    main()
