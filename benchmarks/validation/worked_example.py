"""From two files of a test machine to what they determine: worked_example.md, as it was run.

Tension–compression tests of DP780 sheet to 3 and 6 %, a finite element of combined hardening in
CalculiX (calculix_cube.py), seven parameters. One test, then both, by three
measures, with one store; what is determined, and what is not; how far the modulus is a number at
all; and the same with the parameters fixed that the tests do not have. Writes what it prints to
worked_example.txt, the pictures of the page to docs/images, and the report to --scratch. Started
again, it runs the solver for nothing that is in its store.

    pip install ".[calibration,plot,report]"
    CURVEWISE_DATA=... python benchmarks/validation/worked_example.py
    python benchmarks/validation/worked_example.py --generated

The second way needs neither the tests nor CalculiX: it generates two tests of another law, with
noise, and integrates the law of the element instead. It writes everything to --scratch.
"""

from __future__ import annotations

import argparse
import io
import itertools
from collections.abc import Callable, Mapping, Sequence
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path
from typing import TypeAlias

import calculix_cube as cube
import numpy as np
from femu_calculix import BOUNDS
from matplotlib.figure import Figure
from places import LOOPS, RESULTS, ROOT

from curvewise import read_curve
from curvewise.calibration import Case, Identification, Uncertainty, identify, identify_each
from curvewise.curves import resample, smooth, turning_points
from curvewise.curves.named_curve import NamedCurve
from curvewise.datasets import kinematic_hardening

# Parameters in, a curve for each test out.
Model: TypeAlias = Callable[[Mapping[str, float]], list[np.ndarray]]

NAMES = ("true strain", "true stress, MPa")
FILES = ("dp780_tct_3pct.csv", "dp780_tct_6pct.csv")

# What an engineer would say before: a modulus of steel, and the knee of the first loading.
GUESS = {"E": 190e3, "yield": 400.0, "Q": 300.0, "g": 200.0, "H": 500.0, "R": 0.2, "b": 20.0}
MEASURES = ("area", "dtw", "frechet")
INCREMENTS = 24  # of the solver, in each branch
POINTS = 50  # of each branch of a prepared test
# Tests that could be made: the strains at which they turn and end.
TESTS_TO_COME = {
    "3 % as before": (0.0, 0.03, -0.03, 0.03),
    "6 % as before": (0.0, 0.06, -0.06, 0.06),
    "tension to 15 %": (0.0, 0.15),
    "five cycles of 1 %": (0.0, *(0.01, -0.01) * 5),
    "five cycles of 3 %": (0.0, *(0.03, -0.03) * 5),
}
WINDOWS = ((50, 150), (50, 250), (150, 350), (50, 400))  # MPa after the start of a branch


def main() -> None:
    """Go through the steps, print and draw them."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--generated", action="store_true", help="generated tests, and no solver")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--samples", type=int, default=200, help="of each bootstrap")
    parser.add_argument("--scratch", type=Path, default=ROOT / "build" / "worked_example")
    parser.add_argument("--output", type=Path, metavar="DIR", help="in the place of the project's")
    options = parser.parse_args()
    options.scratch.mkdir(parents=True, exist_ok=True)
    output = options.output or (options.scratch if options.generated else None)
    text = output or RESULTS
    images = output or ROOT / "docs" / "images"
    written = io.StringIO()

    def say(title: str, *parts: object) -> None:
        """Print a step, and keep it for the file."""
        with redirect_stdout(written):
            print(f"== {title}\n", *parts, sep="\n", end="\n\n")
        print(written.getvalue().rpartition("== ")[2], flush=True)

    folder = generate(options.scratch) if options.generated else LOOPS
    model_of = Integrated if options.generated else partial(solved, options.scratch / "runs")

    raw = [read_curve(folder / file) for file in FILES]
    tests = [prepared(test) for test in raw]
    draw_tests(raw, tests).savefig(images / "worked_tests.png", dpi=90)
    say("The elastic slopes of the tests", slopes_table(raw))

    model = model_of([path_of(corners_of(test)) for test in raw])
    store = options.scratch / ("generated.db" if options.generated else "dp780.db")
    search = {"store": store, "workers": options.workers, "progress": False}
    search["start"] = GUESS
    small = Case("3 %", model, tests[0], response=lambda curves: curves[0])
    one = identify([small], bounds=BOUNDS, **search)
    say("One test", one, "", one.uncertainty(samples=options.samples))

    both = identify_each(model, tests, BOUNDS, measures=MEASURES, **search)
    say("Both tests, three measures", both)
    both.plot().savefig(images / "worked_measures.png", dpi=80)
    uncertainty = both["area"].uncertainty(samples=options.samples)
    say("What both determine, by area", both["area"], "", uncertainty)
    uncertainty.plot().savefig(images / "worked_uncertainty.png", dpi=80)

    moves = moves_of(TESTS_TO_COME, uncertainty, model_of)
    say("A test that would notice the weakest direction", moves)

    fixed = {**BOUNDS, **fixed_parameters(raw)}
    start = inside(both["area"].parameters, fixed)
    fewer = identify(model, tests, fixed, **search | {"start": start})
    uncertainty = fewer.uncertainty(samples=options.samples)
    say("E and H fixed", fewer, "", uncertainty)
    say("The price of fixing", price(both["area"], fewer))
    fewer.report(store.with_suffix(".html"), uncertainty=uncertainty)
    (text / "worked_example.txt").write_text(written.getvalue())


def generate(folder: Path) -> Path:
    """Write two tests as a test machine would, of a law that the model does not have."""
    random = np.random.default_rng(1)
    for file, strain in zip(FILES, (0.03, 0.06), strict=True):
        path = strain * np.interp(np.linspace(0, 5, 3001), [0, 1, 3, 5], [0, 1, -1, 1])
        stress = kinematic_hardening(
            path, youngs_modulus=195e3, yield_stress=350.0, backstresses=((9e4, 400.0), (1e4, 30.0))
        )
        stress += random.normal(0.0, 1.0, len(stress))
        np.savetxt(folder / file, np.column_stack([path, stress]), delimiter=",", fmt="%.7g")
    return folder


def solved(scratch: Path, paths: Sequence[np.ndarray]) -> cube.CubeModel:
    """Return the finite element of each test, for CalculiX."""
    return cube.CubeModel(paths, scratch)


class Integrated:
    """The law of the finite element along the paths of the tests, for small strains, in Python."""

    identity = "calculix_cube.integrate"  # what a store knows the runs by

    def __init__(self, paths: Sequence[np.ndarray]) -> None:
        self._paths = paths

    def __call__(self, parameters: Mapping[str, float]) -> list[np.ndarray]:
        """Integrate the law for each test."""
        return [np.column_stack([path, cube.integrate(parameters, path)]) for path in self._paths]


def prepared(test: np.ndarray) -> np.ndarray:
    """Return a test with less noise, branch by branch, and as many points in each."""
    turns = turning_points(test)
    smoothed = smooth(test, window=15, turns=turns)
    return NamedCurve(resample(smoothed, POINTS, turns=turns), NAMES)


def path_of(corners: Sequence[float]) -> np.ndarray:
    """Return the strains for the finite element: through the corners, with short steps after each.

    A step as long as the elastic range would make a chord of the unloading, of the solver's own.
    """
    steps = np.linspace(0.0, 1.0, INCREMENTS + 1)[1:] ** 2
    ends = itertools.pairwise(corners)
    return np.concatenate([[corners[0]], *(start + (end - start) * steps for start, end in ends)])


def corners_of(test: np.ndarray) -> list[float]:
    """Return the strains at which a test begins, turns and ends."""
    return [0.0, *test[turning_points(test), 0], test[-1, 0]]


def elastic_slopes(test: np.ndarray) -> np.ndarray:
    """Return the slope of every branch in every window of stress after its start, in GPa."""
    rows = []
    for branch in np.split(test, turning_points(test)):
        after = np.abs(branch[:, 1] - branch[0, 1])
        row = []
        for low, high in WINDOWS:
            window = branch[np.argmax(after >= low) : np.argmax(after >= high)]
            strain_by_stress = np.polyfit(window[:, 1], window[:, 0], 1)[0]
            row.append(1e-3 / strain_by_stress)
        rows.append(row)
    return np.array(rows)


def slopes_table(tests: Sequence[np.ndarray]) -> str:
    """Return the elastic slopes, in GPa, by test and branch."""
    names = ("loading", "unloading", "reloading")
    lines = ["GPa, MPa after the turn  " + "".join(f"{f'{a} to {b}':>12}" for a, b in WINDOWS)]
    for file, test in zip(FILES, tests, strict=True):
        for name, row in zip(names, elastic_slopes(test), strict=True):
            title = f"{file[10:14]}, {name}"
            lines.append(f"{title:<25}" + "".join(f"{slope:>12.0f}" for slope in row))
    return "\n".join(lines)


def fixed_parameters(tests: Sequence[np.ndarray]) -> dict[str, float]:
    """Return E as the mean chord modulus after the turns, and no linear hardening."""
    chords = [slope for test in tests for slope in elastic_slopes(test)[1:, -1]]
    return {"E": round(float(np.mean(chords))) * 1e3, "H": 0.0}


def inside(parameters: Mapping[str, float], bounds: Mapping[str, object]) -> dict[str, float]:
    """Return those of the parameters that are still searched for."""
    return {name: parameters[name] for name, pair in bounds.items() if isinstance(pair, tuple)}


def price(free: Identification, fixed: Identification) -> str:
    """Return what fixing parameters costs: how far the curves are from the tests."""
    lines = []
    for name, found in (("seven parameters", free), ("five, E and H fixed", fixed)):
        means = [deviation.mean for deviation in found.deviations if deviation is not None]
        away = ", ".join(f"{mean:.1f} MPa" for mean in means)
        lines.append(f"{name:<20}  area {found.value:.5f}, mean deviation {away}")
    return "\n".join(lines)


def moves_of(
    tests: Mapping[str, Sequence[float]],
    uncertainty: Uncertainty,
    model_of: Callable[[list[np.ndarray]], Model],
) -> str:
    """Return by how much tests that nobody has made would move along the weakest direction."""
    best = uncertainty.parameters
    moved = {name: best[name] + uncertainty.weakest_direction.get(name, 0.0) for name in best}
    model = model_of([path_of(corners) for corners in tests.values()])
    lines = []
    for name, one, two in zip(tests, model(best), model(moved), strict=True):
        heights = (two - one)[:, 1] / np.ptp(one[:, 1])
        lines.append(f"{name:<28}  moves by {100 * float(np.sqrt(np.mean(heights**2))):.2g} %")
    return "\n".join(lines)


def draw_tests(raw: Sequence[np.ndarray], tests: Sequence[np.ndarray]) -> Figure:
    """Draw the tests as recorded and prepared, and the unloading of one of them near its turn."""
    figure = Figure(figsize=(11, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for test, points, colour in zip(raw, tests, ("#0072B2", "#D55E00"), strict=True):
        left.plot(*test.T, color=colour, linewidth=0.8, label=f"{len(test)} points as recorded")
        left.plot(*points.T, ".", color="k", markersize=2.5)
    left.plot([], [], ".", color="k", label=f"{len(tests[0])} points, as compared")
    left.set(xlabel="true strain", ylabel="true stress, MPa", title="The tests")
    left.set(ylim=(-1600, 1100))
    left.legend(frameon=False, loc="lower center", fontsize=8)
    for test, colour in zip(raw, ("#0072B2", "#D55E00"), strict=True):
        first = turning_points(test)[0]
        branch = test[first : first + 170]
        strain, stress = branch[0, 0] - branch[:, 0], branch[0, 1] - branch[:, 1]
        right.plot(1e3 * strain, stress, ".-", color=colour, markersize=3, linewidth=0.6)
    limit = 620.0
    for modulus, style in ((205, "-"), (150, "--")):
        right.plot((0, limit / modulus), (0, limit), style, color="#909090", label=f"{modulus} GPa")
    right.set(xlabel="strain since the first turn, 10⁻³", ylabel="stress since the turn, MPa")
    right.set_title("Unloading: which slope is the modulus?")
    right.set(xlim=(0, 4.5), ylim=(0, limit))
    right.legend(frameon=False, loc="lower right")
    return figure


if __name__ == "__main__":
    main()
