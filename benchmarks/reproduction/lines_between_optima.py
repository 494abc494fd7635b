"""Objectives along the lines between the optima of the first SDRM run: figures 18 and 19.

Ten lines, one for each pair of measures, without noise and with 35 MPa of it. Every objective is
scaled on each line by Eq. 12: 0 is its best there, 1 its worst. Counted: the minima of each on
each line. Area is shown with the paper's rearrangement of crossing quadrilaterals; its exact
treatment, "split", is counted beside it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np
from hardening import CLEAN, fits, model, noisy, tests
from landscape import smoothness
from problems import COLOURS, MEASURES, TITLES
from report import Run, legend_below, table
from studies import Found

from curvewise.calibration import Criterion, LinePlot, Objective, line_plot

SPLIT = "area_split"
PAIRS = tuple(combinations(MEASURES, 2))
FIGURES = {CLEAN: "figure_18", noisy("35", 0): "figure_19"}


def main() -> None:
    """Scan, count, draw, write."""
    run = Run(__doc__, workers=1)
    found = fits(run, list(FIGURES))
    points = 21 if run.quick else 201
    lines = {name: scans(name, found[name], points) for name in FIGURES}
    run.section("lines_between_optima", count_table(list(lines.values())))
    for name, figure in FIGURES.items():
        draw(run, figure, "Without noise" if name == CLEAN else "With noise", lines[name])


def scans(name: str, found: Mapping[str, Found], points: int) -> list[LinePlot]:
    """Return the objectives of a data set along all lines."""
    options = {"preset": "paper", "min_coverage": 0.0}
    criteria = {measure: Criterion(measure, **options) for measure in MEASURES}
    criteria[SPLIT] = Criterion("area", crossing="split", **options)
    objectives = {label: Objective(tests(name), one) for label, one in criteria.items()}
    optima = {measure: found[measure].stages[0].parameters for measure in MEASURES}
    return [
        line_plot(objectives, model(), optima[a], optima[b], points=points, progress=False)
        for a, b in PAIRS
    ]


def count_table(cases: Sequence[Sequence[LinePlot]]) -> str:
    """Return how many minima each objective has on the ten lines, and its largest step."""
    rows = []
    for measure in (*MEASURES, SPLIT):
        cells = []
        for lines in cases:
            minima, variation, step = np.array([smoothness(one.data[measure]) for one in lines]).T
            cells += [
                f"{minima.sum():.0f}",
                f"{(minima > 1).sum()}",
                f"{variation.mean():.2f}",
                f"{100 * step.max():.1f} %",
            ]
        rows.append([TITLES.get(measure, "Area, split"), *cells])
    columns = ("minima, all lines", "lines with several", "variation", "largest step")
    header = [f"{c}{case}" for case in (", no noise", ", noise") for c in columns]
    return table(["measure", *header], rows)


def draw(run: Run, name: str, title: str, lines: Sequence[LinePlot]) -> None:
    """Draw one panel for each line."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 5.4), layout="constrained")
    figure.suptitle(title)
    panels = figure.subplots(2, 5, sharex=True, sharey=True).ravel()
    for panel, (a, b), line in zip(panels, PAIRS, lines, strict=True):
        for measure in MEASURES:
            scaled = line.data[f"{measure}_scaled"]
            style = {"color": COLOURS[measure], "linewidth": 1.1}
            panel.plot(line.data.t, scaled, label=TITLES[measure], **style)
        panel.set_title(f"{TITLES[a]} (0) to {TITLES[b]} (1)", fontsize="medium")
    panels[7].set_xlabel("position on the line")
    figure.supylabel("objective, by Eq. 12")
    legend_below(figure, panels[0])
    run.picture(name, figure)


if __name__ == "__main__":
    main()
