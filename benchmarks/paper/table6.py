"""Table 6 made quantitative: what noise and outliers do to each measure, and how smooth it is.

How far the optimum moves, on the load–unload cycle, whose truth is known: many fits to data with
noise or outliers of its own each, the error of a fit being the area between the fitted and the
true cycle, as a share of the area under the true one's loading branch. How smooth the landscape
is, on the five hardening loops, without and with noise: the objective along straight lines
through the paper's optimum, in random directions; the number of its minima, its variation over
what one descent and one ascent would have, and its largest step between neighbours. PCM and curve
length are measured with and without a noise filter before them, area with both treatments of
crossings.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from load_unload import curve_error
from problems import (
    COLOURS,
    Array,
    HardeningModel,
    hardening_bounds,
    load_unload,
    load_unload_bounds,
    load_unload_data,
    paper_parameters,
    test_loops,
    with_noise,
)
from report import Run, table
from scipy.signal import find_peaks, savgol_filter
from studies import Effort, Found, Task, identify_all

from curvewise.calibration import Objective

HALF_LENGTH = 0.1  # of a line through the optimum, as a share of the parameters' ranges
OUTLIER = 0.5  # how far an outlier is moved; the cycle is 1.72 high


@dataclass(frozen=True)
class Variant:
    """A measure, its options, and whether the test is filtered first."""

    measure: str
    options: Mapping[str, Any] = field(default_factory=dict)
    filtered: bool = False

    def prepared(self, test: Array, window: int) -> Array:
        """Return the test as it is fitted; `window` is the filter's, in points."""
        return filtered(test, window) if self.filtered else test


VARIANTS = {
    "Area": Variant("area"),
    "Area, split": Variant("area", {"crossing": "split"}),
    "PCM": Variant("pcm"),
    "PCM, filtered": Variant("pcm", filtered=True),
    "Fréchet": Variant("frechet"),
    "DTW": Variant("dtw"),
    "Curve length": Variant("curve_length"),
    "Curve length, filtered": Variant("curve_length", filtered=True),
}


def filtered(test: Array, window: int) -> Array:
    """Return a curve with a Savitzky–Golay filter over y, branch by branch.

    A filter across a turning point would round it off.
    """
    direction = np.sign(np.diff(test[:, 0]))
    moving = np.flatnonzero(direction)
    turns = moving[1:][np.diff(direction[moving]) != 0]
    branches = np.split(test[:, 1], turns)
    y = [savgol_filter(branch, window, 2, mode="interp") for branch in branches]
    return np.column_stack((test[:, 0], np.concatenate(y)))


def noisy(deviation: float, random: np.random.Generator) -> Array:
    """Return the cycle with normal noise in y."""
    data = load_unload_data(noise=False)
    data[:, 1] += random.normal(0.0, deviation, len(data))
    return data


def outlying(count: int, random: np.random.Generator) -> Array:
    """Return the cycle with some points moved up or down."""
    data = load_unload_data(noise=False)
    which = random.choice(len(data), count, replace=False)
    data[which, 1] += OUTLIER * random.choice((-1.0, 1.0), count)
    return data


CASES: dict[str, Callable[[np.random.Generator], Array]] = {
    "noise 0.01": partial(noisy, 0.01),
    "noise 0.05": partial(noisy, 0.05),
    "1 outlier": partial(outlying, 1),
    "5 outliers": partial(outlying, 5),
}


def main() -> None:
    """Fit, scan, print, draw, write."""
    run = Run(__doc__, workers=1, samples=10, lines=12)
    samples = 1 if run.quick else run.options.samples
    lines = 3 if run.quick else run.options.lines
    run.section("table6_shift", shift_table(shifts(run, samples)))
    tests = {"no noise": test_loops(), "noise 35 MPa": with_noise(test_loops(), 35.0, seed=0)}
    simulations = simulated_lines(lines, 51 if run.quick else 501)
    scans = {
        (name, case): scan(variant, loops, simulations)
        for name, variant in VARIANTS.items()
        for case, loops in tests.items()
    }
    run.section("table6_smoothness", smoothness_table(scans, list(tests)))
    draw(run, scans, list(tests))


def sample(case: str, number: int) -> Array:
    """Return one set of data of a case, the same in every run."""
    return CASES[case](np.random.Generator(np.random.PCG64([list(CASES).index(case), number])))


def shifts(run: Run, samples: int) -> dict[tuple[str, str], list[Found]]:
    """Return the fits of every variant to all data of every case."""
    quick = Effort("de", popsize=8, generations=25, restarts=1, evaluations=400)
    effort = quick if run.quick else Effort("de", popsize=20, generations=150)
    tasks = {
        (name, case, number): Task(
            f"table6_{name}_{case}_{number}".replace(" ", "_").replace(",", ""),
            load_unload,
            [variant.prepared(sample(case, number), 21)],
            load_unload_bounds(),
            variant.measure,
            seed=number,
            effort=effort,
            options=variant.options,
        )
        for name, variant in VARIANTS.items()
        for case in CASES
        for number in range(samples)
    }
    found = identify_all(list(tasks.values()), run.histories, run.options.workers)
    return {
        (name, case): [found[tasks[name, case, k].name] for k in range(samples)]
        for name in VARIANTS
        for case in CASES
    }


def shift_table(fits: Mapping[tuple[str, str], list[Found]]) -> str:
    """Return the median error of the fitted cycle, and the worst."""
    rows = []
    for name in VARIANTS:
        cells = []
        for case in CASES:
            errors = [100 * curve_error(fit) for fit in fits[name, case]]
            cells.append(f"{np.median(errors):.2f} ({max(errors):.2f})")
        rows.append([name, *cells])
    return table(["error in %, median (worst)", *CASES], rows)


def simulated_lines(lines: int, points: int) -> list[list[list[Array]]]:
    """Return the five loops at every point of every line."""
    model = HardeningModel.of_the_paper()
    centre = paper_parameters("area")
    ranges = np.array([high - low for low, high in hardening_bounds().values()])
    random = np.random.Generator(np.random.PCG64(6))
    simulations = []
    for _ in range(lines):
        direction = random.normal(size=len(centre))
        direction *= HALF_LENGTH * ranges / np.linalg.norm(direction)
        steps = np.linspace(-1, 1, points)[:, np.newaxis] * direction
        points_of_line = np.array(list(centre.values())) + steps
        simulations.append([model(dict(zip(centre, p, strict=True))) for p in points_of_line])
    return simulations


def scan(
    variant: Variant, tests: Sequence[Array], simulations: list[list[list[Array]]]
) -> list[Array]:
    """Return the objective along every line."""
    objective = Objective(
        [variant.prepared(test, 11) for test in tests],
        variant.measure,
        preset="paper",
        min_coverage=0.0,
        **variant.options,
    )
    return [np.array([objective(loops) for loops in line]) for line in simulations]


def smoothness(values: Array) -> tuple[int, float, float]:
    """Return the number of minima, the relative variation and the largest step of a scan.

    A minimum counts if both its sides rise by 0.1 % of the range; the variation is 1 for one
    descent and one ascent; the step is a share of the range.
    """
    extent = np.ptp(values)
    padded = np.concatenate(([np.inf], values, [np.inf]))  # a minimum may be at an end
    minima, _ = find_peaks(-np.minimum(padded, values.max() + extent), prominence=1e-3 * extent)
    ends = values[0] + values[-1] - 2 * values.min()
    steps = np.abs(np.diff(values))
    return len(minima), float(steps.sum() / ends), float(steps.max() / extent)


def smoothness_table(scans: Mapping[tuple[str, str], list[Array]], cases: list[str]) -> str:
    """Return means over the lines of minima and variation, and the largest step of all."""
    rows = []
    for name in VARIANTS:
        cells = []
        for case in cases:
            minima, variation, step = np.array([smoothness(v) for v in scans[name, case]]).T
            cells += [
                f"{minima.mean():.1f}",
                f"{variation.mean():.2f}",
                f"{100 * step.max():.1f} %",
            ]
        rows.append([name, *cells])
    columns = ("minima", "variation", "largest step")
    return table(
        ["landscape", *(f"{column}, {case}" for case in cases for column in columns)], rows
    )


def draw(run: Run, scans: Mapping[tuple[str, str], list[Array]], cases: list[str]) -> None:
    """Draw every variant along the first line."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 5), layout="constrained")
    panels = figure.subplots(2, len(VARIANTS) // 2, sharex=True).ravel()
    for panel, (name, variant) in zip(panels, VARIANTS.items(), strict=True):
        for case, style in zip(cases, ("--", "-"), strict=True):
            values = scans[name, case][0]
            t = np.linspace(-HALF_LENGTH, HALF_LENGTH, len(values))
            scaled = (values - values.min()) / np.ptp(values)
            colour = COLOURS[variant.measure]
            panel.plot(t, scaled, style, color=colour, linewidth=1, label=case)
        panel.set_title(name)
        panel.set_yticks([])
    panels[0].legend()
    figure.supxlabel("distance from the paper's optimum along a line, as a share of the ranges")
    figure.supylabel("objective, scaled on the line")
    run.picture("table6", figure)


if __name__ == "__main__":
    main()
