"""The stress–strain loops and their fits: figures 2, 12, 13, 14 and 20 to 29.

Figure 2: a test beside a model's response that is not yet fitted. Figure 12: the tests without
and with noise. 13 and 14: the responses of all five optima, without and with noise. 20 to 29: the
same, measure by measure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from hardening import CLEAN, NOISE, fits, model, noisy, tests
from problems import COLOURS, LOOPS, MEASURES, TITLES, Array, paper_parameters, test_loops
from report import Run, legend_below

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NOISY = noisy("35", 0)
LABELS = {"xlabel": "strain", "ylabel": "stress, MPa"}


def main() -> None:
    """Draw all."""
    run = Run(__doc__, workers=1)
    found = fits(run, [CLEAN, NOISY])
    draw_unfitted(run)
    draw_noise(run)
    for name, number, first in ((CLEAN, 13, 20), (NOISY, 14, 25)):
        responses = {m: model()(found[name][m].parameters) for m in MEASURES}
        draw_together(run, f"figure_{number}", tests(name), responses)
        for k, measure in enumerate(MEASURES):
            draw_alone(run, f"figure_{first + k}", tests(name), measure, responses[measure])


def draw_unfitted(run: Run) -> None:
    """Draw figure 2: one test loop and a model at other parameters, and the points of both."""
    from matplotlib.figure import Figure

    parameters = {**paper_parameters("area"), "SIGY": 550.0, "C": 280.0, "RSAT": 300.0}
    test, response = test_loops()[2], model()(parameters)[2]
    figure = Figure(figsize=(10, 4.4), layout="constrained")
    whole, detail = figure.subplots(1, 2)
    for panel in (whole, detail):
        panel.plot(*test.T, "o", color="0.4", markersize=3, label=f"test, {len(test)} points")
        panel.plot(
            *response.T, ".-", color="#D55E00", linewidth=0.9, label=f"model, {len(response)}"
        )
        panel.set(**LABELS)
    peak = test[np.argmax(test[:, 1])]
    detail.set_xlim(peak[0] - 0.004, peak[0] + 0.0005)
    detail.set_ylim(0.9 * peak[1], 1.03 * peak[1])
    whole.set_title("Loop 3")
    detail.set_title("Its points: no strain in common")
    whole.legend(frameon=False)
    run.picture("figure_02", figure)


def draw_noise(run: Run) -> None:
    """Draw figure 12: the tests, and with the noise of the tables; signal over noise above."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 3.4), layout="constrained")
    panels = figure.subplots(1, len(LOOPS), sharey=True)
    for k, (panel, clean, rough) in enumerate(zip(panels, tests(CLEAN), tests(NOISY), strict=True)):
        panel.plot(*rough.T, ".", color="#D55E00", markersize=3, label="with noise of 35 MPa")
        panel.plot(*clean.T, color="black", linewidth=1, label="test")
        signal = np.abs(clean[:, 1]).mean()
        ratios = [f"{signal / NOISE[case]:.1f}" for case in ("35", "5.9")]
        panel.set_title(f"Loop {k + 1}: {ratios[0]}\n({ratios[1]} at √35 MPa)", fontsize="medium")
        panel.set_xlabel("strain")
    panels[0].set_ylabel(LABELS["ylabel"])
    legend_below(figure, panels[0])
    run.picture("figure_12", figure)


def draw_together(
    run: Run, name: str, loops: Sequence[Array], responses: Mapping[str, Sequence[Array]]
) -> None:
    """Draw figures 13 and 14: every loop with the responses of all optima."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 7.5), layout="constrained")
    panels = figure.subplots(2, 3).ravel()
    for k, panel in enumerate(panels[: len(LOOPS)]):
        draw_test(panel, k, loops[k])
        for measure, response in responses.items():
            style = {"color": COLOURS[measure], "linewidth": 1.2}
            panel.plot(*response[k].T, label=TITLES[measure], **style)
        panel.set(**LABELS)
    panels[-1].axis("off")
    panels[-1].legend(*panels[0].get_legend_handles_labels(), loc="center", frameon=False)
    run.picture(name, figure)


def draw_alone(
    run: Run, name: str, loops: Sequence[Array], measure: str, response: Sequence[Array]
) -> None:
    """Draw figures 20 to 29: the five loops and the response of one optimum, not stored."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 3.4), layout="constrained")
    panels = figure.subplots(1, len(LOOPS), sharey=True)
    for k, panel in enumerate(panels):
        draw_test(panel, k, loops[k])
        panel.plot(*response[k].T, color=COLOURS[measure], linewidth=1.2, label=TITLES[measure])
        panel.set_xlabel(LABELS["xlabel"])
    panels[0].set_ylabel(LABELS["ylabel"])
    legend_below(figure, panels[0])
    run.picture(name, figure, stored=False)


def draw_test(panel: Axes, k: int, loop: Array) -> None:
    """Draw the points of a test."""
    panel.plot(*loop.T, ".", color="0.6", markersize=4, label="test")
    panel.set_title(f"Loop {k + 1}")


if __name__ == "__main__":
    main()
