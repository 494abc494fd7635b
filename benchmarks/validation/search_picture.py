"""The figure of how_the_search_works.md: an objective of one parameter, and its surrogates.

    python benchmarks/validation/search_picture.py

A damped oscillation with noise is fitted by area over its frequency. Left: the curves. Right: the
objective, and what kriging surrogates of the curves through three and five runs predict of it.
Writes docs/images/search.png.
"""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from curvewise.calibration import Criterion, Objective
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.surfaces.inner_search import CurveSearch
from curvewise.calibration.surfaces.kriged_surface import KrigedSurface

PICTURE = Path(__file__).resolve().parents[2] / "docs" / "images" / "search.png"
LOW, HIGH, TRUE = 1.0, 3.0, 2.1
TIME = np.linspace(0.0, 4.0, 120)
FIRST, MORE = (0.2, 0.5, 0.8), (0.56, 0.35)


def oscillation(place: float) -> np.ndarray:
    """Return the curve at a place between the bounds of the frequency."""
    frequency = LOW + place * (HIGH - LOW)
    return np.column_stack((TIME, np.exp(-0.4 * TIME) * np.cos(frequency * TIME)))


def main() -> None:
    """Draw the figure."""
    test = oscillation((TRUE - LOW) / (HIGH - LOW))
    test[:, 1] += np.random.default_rng(1).normal(0.0, 0.05, TIME.size)
    objective = Objective(test, Criterion("area"))
    places = np.linspace(0.0, 1.0, 201)
    frequencies = LOW + places * (HIGH - LOW)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.4), layout="constrained")
    left.plot(*test.T, ".", color="#555555", markersize=3, label="test")
    for place in FIRST:
        left.plot(*oscillation(place).T, linewidth=1.0, label=f"{LOW + place * (HIGH - LOW):.1f}")
    left.set(xlabel="time", ylabel="displacement", title="The curves bend little")
    left.legend(title="frequency", frameon=False, fontsize=8)
    right.plot(frequencies, [objective(oscillation(p)) for p in places], "k", label="the objective")
    for chosen, style in ((FIRST, "--"), ((*FIRST, *MORE), ":")):
        right.plot(
            frequencies,
            predicted(objective, chosen, places),
            style,
            color="#D55E00",
            label=f"predicted after {len(chosen)} runs",
        )
    runs = np.array((*FIRST, *MORE))
    values = [objective(oscillation(place)) for place in runs]
    right.plot(LOW + runs * (HIGH - LOW), values, "o", color="#0072B2", markersize=5, label="runs")
    right.set(xlabel="frequency", ylabel="area", title="The measure of them has kinks")
    right.legend(frameon=False, fontsize=8)
    figure.savefig(PICTURE, dpi=120)


def predicted(objective: Objective, chosen: tuple[float, ...], places: np.ndarray) -> np.ndarray:
    """Return the measure of the curves that a surrogate through some runs predicts."""
    inner = CurveSearch(objective, 1e-3, lambda: None)
    curves = [oscillation(place) for place in chosen]
    runs = [
        Evaluation(i, (place,), objective(curve), False, 0.0, simulations=(curve,))
        for i, (place, curve) in enumerate(zip(chosen, curves, strict=True))
    ]
    vectors = np.array([inner.taken(run)[0] for run in runs])
    best = int(np.argmin([run.value for run in runs]))
    points = np.array(chosen)[:, np.newaxis]
    surrogate = KrigedSurface(points, vectors, points[best], inner.sides)
    return inner.values(surrogate, places[:, np.newaxis])


if __name__ == "__main__":
    main()
