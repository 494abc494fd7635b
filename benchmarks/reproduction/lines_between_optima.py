"""Objectives along the lines between the optima of the first SDRM run: figures 18 and 19.

Ten lines, one for each pair of measures, without noise and with 35 MPa of it. Every objective is
scaled on each line by Eq. 12: 0 is its best there, 1 its worst; how far apart these are is written
on each panel. Counted: the minima of each on each line, from several depths. Area is shown with the
paper's rearrangement of crossing quadrilaterals; the exact treatment, "split", is counted too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np
from hardening import CLEAN, fits, model, noisy, tests
from landscape import DEPTHS, Landscape, landscape
from problems import COLOURS, MEASURES, TITLES
from report import Run, legend_below, table
from studies import Found

from curvewise.calibration import Criterion, LinePlot, Objective, line_plot

SPLIT = "area_split"
PAIRS = tuple(combinations(MEASURES, 2))
FIGURES = {CLEAN: "figure_18", noisy("35", 0): "figure_19"}
CASES = ("no noise", "noise")


def main() -> None:
    """Scan, count, draw, write."""
    run = Run(__doc__, workers=1)
    found = fits(run, list(FIGURES))
    points = 21 if run.quick else 201
    lines = {name: scans(name, found[name], points) for name in FIGURES}
    scanned = {
        (measure, name): [landscape(line.data[measure]) for line in lines[name]]
        for measure in (*MEASURES, SPLIT)
        for name in lines
    }
    run.section("lines_between_optima", roughness_table(scanned))
    for of in ("range", "value"):
        run.section(f"lines_between_optima_{of}", depth_table(scanned, of))
    run.section("lines_between_optima_missed", missed_table(found, lines))
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


def roughness_table(scanned: Mapping[tuple[str, str], Sequence[Landscape]]) -> str:
    """Return minima deeper than 0.1 % of the value, the deepest further one, steps, ranges."""
    rows = []
    for measure in (*MEASURES, SPLIT):
        cells = []
        for name in FIGURES:
            lines = scanned[measure, name]
            several = sum(line.minima(of="value") > 1 for line in lines)
            ranges = [100 * line.extent / line.value for line in lines]
            cells += [
                f"{sum(line.minima(of='value') for line in lines)}",
                f"{several}",
                f"{max(100 * line.further_depth() / line.value for line in lines):.2f} %",
                f"{np.mean([line.variation for line in lines]):.2f}",
                f"{100 * max(line.step for line in lines):.1f} %",
                f"{min(ranges):.1f} to {max(ranges):.0f} %",
            ]
        rows.append([title(measure), *cells])
    columns = (
        "minima, all lines",
        "lines with several",
        "deepest further minimum, of the value",
        "variation",
        "largest step",
        "range, of the value",
    )
    header = [f"{c}, {case}" for case in CASES for c in columns]
    return table(["measure", *header], rows)


def depth_table(scanned: Mapping[tuple[str, str], Sequence[Landscape]], of: str) -> str:
    """Return the minima on the ten lines that are deeper than shares of the range, or value."""
    rows = [
        [
            title(measure),
            *(
                f"{sum(line.minima(depth, of=of) for line in scanned[measure, name])}"
                for name in FIGURES
                for depth in DEPTHS
            ),
        ]
        for measure in (*MEASURES, SPLIT)
    ]
    header = [f"{100 * depth:g} %, {case}" for case in CASES for depth in DEPTHS]
    return table([f"minima deeper than, of the {of}", *header], rows)


def missed_table(
    found: Mapping[str, Mapping[str, Found]], lines: Mapping[str, Sequence[LinePlot]]
) -> str:
    """Return where a line is lower than the optimum that SDRM found by the same measure."""
    rows = []
    for measure in MEASURES:
        cells = []
        for name in FIGURES:
            optimum = found[name][measure].stages[0].value
            least = [float(line.data[measure].min()) for line in lines[name]]
            below = sum(value < (1 - 1e-4) * optimum for value in least)
            cells += [f"{below}", f"{max(0.0, 100 * (1 - min(least) / optimum)):.2f} %"]
        rows.append([title(measure), *cells])
    header = [f"{c}, {case}" for case in CASES for c in ("lines with a lower point", "lower by")]
    return table(["SDRM's optimum of", *header], rows)


def title(measure: str) -> str:
    """Return a measure's name for people."""
    return TITLES.get(measure, "Area, split")


def draw(run: Run, name: str, title: str, lines: Sequence[LinePlot]) -> None:
    """Draw one panel for each line, with the range that each objective has there."""
    from matplotlib.figure import Figure

    corner = {"fontsize": "small", "ha": "center", "va": "top"}
    figure = Figure(figsize=(14, 6.6), layout="constrained")
    figure.suptitle(f"{title}; above the lines the objectives' ranges, of the best values there")
    panels = figure.subplots(2, 5, sharex=True, sharey=True).ravel()
    for panel, (a, b), line in zip(panels, PAIRS, lines, strict=True):
        for k, measure in enumerate(MEASURES):
            scaled = line.data[f"{measure}_scaled"]
            style = {"color": COLOURS[measure], "linewidth": 1.1}
            panel.plot(line.data.t, scaled, label=TITLES[measure], **style)
            values = line.data[measure]
            extent = f"{100 * (values.max() / values.min() - 1):.3g} %"
            panel.text(0.1 + 0.2 * k, 1.42, extent, color=COLOURS[measure], **corner)
        panel.set_title(f"{TITLES[a]} (0) to {TITLES[b]} (1)", fontsize="medium")
        panel.set(ylim=(-0.03, 1.5), yticks=(0.0, 0.5, 1.0))
    panels[7].set_xlabel("position on the line")
    figure.supylabel("objective, by Eq. 12")
    legend_below(figure, panels[0])
    run.picture(name, figure)


if __name__ == "__main__":
    main()
