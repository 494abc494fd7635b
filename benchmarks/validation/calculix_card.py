"""A material card of CalculiX against the point of material that it was made of.

Chaboche-Voce with two back stresses is fitted to measured loops, by least squares of the stress
with the point's own slopes. Each card is made along its loop, and one hexahedron of its overlay is
driven along the same strain; then the first card along the other loops, for which it was not made.
Numbers are the largest difference of the stresses in per cent of the height of the loop. Writes
calculix_card.json and calculix_card.webp.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
from itertools import pairwise
from pathlib import Path

import calculix_cube as cube
import numpy as np
from calculix_cube import Array
from matplotlib.figure import Figure
from places import BUILD, LOOPS, RESULTS
from scipy.optimize import least_squares
from stored import save_picture

from curvewise import read_curve
from curvewise.curves import turning_points
from curvewise.materials import ChabocheVoce

TESTS = [
    "dp780_tct_3pct.csv",
    "dp780_tct_6pct.csv",
    "eddq_tct_3pct.csv",
    "tr1180_tct_3pct.csv",
    "resslab_cyclic_2pct.csv",
]
MATERIAL = ChabocheVoce()
# E, yield, Q, b and C, gamma of both back stresses; stresses as shares of the largest stress.
START = (300.0, 0.4, 0.1, 10.0, 200.0, 400.0, 20.0, 40.0)
LOW = (100.0, 0.1, -0.3, 1.0, 10.0, 100.0, 1.0, 1.0)
HIGH = (800.0, 0.9, 1.0, 100.0, 2000.0, 3000.0, 200.0, 100.0)
IS_STRESS = np.array([1, 1, 1, 0, 1, 0, 1, 0], dtype=bool)
INCREMENTS = 40  # of a branch


def main() -> None:
    """Fit, write the cards, run CalculiX, and draw."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--output", type=Path, default=RESULTS, help="for figure and results")
    output = parser.parse_args().output
    tests = [read_curve(LOOPS / name) for name in TESTS]
    paths = [path_of(test[:, 0]) for test in tests]
    fits = [fitted(test) for test in tests]
    cards = [
        MATERIAL.card(fit, "calculix", name="SHEET", along=path[1:])
        for fit, path in zip(fits, paths, strict=True)
    ]
    rows, panels = [], []
    for name, path, fit, card in zip(TESTS, paths, fits, cards, strict=True):
        (curve,) = run(card, [path])
        point = MATERIAL.stress(path, fit)
        stated = float(re.findall(r"^\*\* ([\d.]+) % of the loop's", card, re.MULTILINE)[0])
        rows.append(
            {
                "test": name,
                "layers": card.count("*MATERIAL,"),
                "stated_percent": stated,
                "calculix_percent": difference(curve[:, 1], point),
                "parameters": fit,
            }
        )
        panels.append((name, path, curve[:, 1], point))
        print(
            "{test:26}{layers:4} layers{stated_percent:8.2f}{calculix_percent:8.2f}".format(
                **rows[-1]
            )
        )
    others = run(cards[0], paths[1:])
    for row, path, curve in zip(rows[1:], paths[1:], others, strict=True):
        point = MATERIAL.stress(path, fits[0])
        row["card_of_the_first_percent"] = difference(curve[:, 1], point)
        print("{test:26}{card_of_the_first_percent:8.2f} with the first card".format(**row))
    (output / "calculix_card.json").write_text(json.dumps(rows, indent=1) + "\n")
    save_picture(draw(panels, rows), output / "calculix_card.webp", dpi=90)


def path_of(strain: Array) -> Array:
    """Return the strain from 0 through the turning points, in equal increments of each branch."""
    ends = [0.0, *strain[turning_points(strain, reversal=0.05)], strain[-1]]
    ways = [np.linspace(a, b, INCREMENTS + 1)[1:] for a, b in pairwise(ends)]
    return np.concatenate([[0.0], *ways])


def fitted(test: Array) -> dict[str, float]:
    """Return the parameters with the least squares of the stress."""
    strain, stress = test.T
    units = np.where(IS_STRESS, np.abs(stress).max(), 1.0)

    def named(x: Array) -> dict[str, float]:
        return dict(zip(MATERIAL.names, (x * units).tolist(), strict=True))

    found = least_squares(
        lambda x: MATERIAL.stress(strain, named(x)) - stress,
        START,
        jac=lambda x: MATERIAL.stress_and_slopes(strain, named(x))[1] * units,
        bounds=(LOW, HIGH),
        x_scale="jac",
    )
    return named(found.x)


def run(card: str, paths: list[Array]) -> list[Array]:
    """Return strain and stress of a cube with this card along each path."""
    folder = BUILD / "calculix_card"
    folder.mkdir(parents=True, exist_ok=True)
    names = re.findall(r"^\*MATERIAL,NAME=(\w+)$", card, re.MULTILINE)
    materials: list[tuple[str, list[str]]] = [(name, []) for name in names]
    materials[0] = (names[0], card.splitlines())
    (folder / "cubes.inp").write_text(cube.deck(paths, materials))
    subprocess.run(["ccx", "-i", "cubes"], cwd=folder, check=True, capture_output=True)
    curves = cube.read_curves(folder, [len(path) - 1 for path in paths])
    return [cube.by_increment(curve) for curve in curves]


def difference(stress: Array, point: Array) -> float:
    """Return the largest difference in per cent of the loop's height."""
    return float(100.0 * np.abs(stress - point).max() / np.ptp(point))


def draw(panels: list[tuple[str, Array, Array, Array]], rows: list[dict[str, object]]) -> Figure:
    """Draw the element and the point of each loop, and ten times their difference below."""
    figure = Figure(figsize=(3.4 * len(panels), 3.6), layout="constrained")
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for axis, (name, path, stress, point), row in zip(axes, panels, rows, strict=True):
        axis.plot(100 * path, point, color="#999999", linewidth=4, label="point of material")
        axis.plot(100 * path, stress, color="#0072B2", linewidth=1, label="CalculiX, its card")
        axis.set_title(
            f"{name.removesuffix('.csv')}\n{row['layers']} layers, "
            f"{row['calculix_percent']:.2f} % of the height",
            fontsize=9,
        )
        axis.set_xlabel("true strain, %")
    axes[0].set_ylabel("true stress, MPa")
    axes[0].legend(fontsize=8)
    return figure


if __name__ == "__main__":
    main()
