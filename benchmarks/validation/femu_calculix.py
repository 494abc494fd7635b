"""Finite-element model updating: a sheet steel's cyclic hardening, identified with CalculiX.

The tests are tension–compression loops of DP780 sheet, true strain and true stress (README of the
data), up to 3 and 6 %, or any other CSV files of that kind. The model is one element per test,
loaded along the strain path of that test between its turning points (calculix_cube.py), run by
`CommandModel` in a folder of its own for every set of parameters, two at a time. Four measures, in
the conditions of the paper, identify seven parameters each by successive response surfaces.

First the element is held against an independent integration of the same law; at last an
identification has to survive a solver that is killed and parameters with which it diverges. An
interrupted run is taken up again where it was. Writes femu_calculix.json and femu_calculix.webp.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import multiprocessing
import os
import signal
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import calculix_cube as cube
import numpy as np
from calculix_cube import Array, CubeModel
from matplotlib.figure import Figure
from places import BUILD, LOOPS, RESULTS
from stored import save_picture

from curvewise import read_curve
from curvewise.calibration import (
    Criterion,
    DifferentialEvolution,
    Identification,
    SimulationStore,
    identify,
)
from curvewise.curves.named_curve import NamedCurve

TESTS = ["dp780_tct_3pct.csv", "dp780_tct_6pct.csv"]

BOUNDS = {
    "E": (150e3, 220e3),
    "yield": (200.0, 600.0),
    "Q": (100.0, 600.0),
    "g": (20.0, 600.0),
    "H": (0.0, 3000.0),
    "R": (-0.4, 1.0),
    "b": (1.0, 100.0),
}
MEASURES = ("area", "dtw", "frechet", "pcm")
TITLES = {"area": "Area", "dtw": "DTW", "frechet": "Fréchet", "pcm": "PCM"}
COLOURS = {"area": "#0072B2", "dtw": "#D55E00", "frechet": "#009E73", "pcm": "#CC79A7"}

# The growth of the yield stress may fall below -1: a negative yield stress, where ccx diverges.
DIVERGING_BOUNDS = {**BOUNDS, "R": (-2.0, 1.0)}

# What CalculiX may differ from the integration for small strains by, as a share of the largest
# stress and of the largest strain: finite strains are of first order in the strain.
TOLERANCE = 0.2


def main() -> None:
    """Verify, identify by every measure, survive failures, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("tests", nargs="*", type=Path, help="CSV files: true strain, true stress")
    parser.add_argument("--quick", action="store_true", help="one test, short searches, for CI")
    parser.add_argument("--workers", type=int, default=2, help="solvers at a time; default 2")
    parser.add_argument("--output", type=Path, metavar="DIR", help="for figure and results")
    options = parser.parse_args()
    scratch = BUILD / "femu"
    output = options.output or (scratch / "quick" if options.quick else RESULTS)
    output.mkdir(parents=True, exist_ok=True)
    files = options.tests or [LOOPS / name for name in TESTS[: 1 if options.quick else None]]
    if missing := [file for file in files if not file.is_file()]:
        raise SystemExit(f"no {missing[0]}: name CSV files, or set CURVEWISE_DATA to the data")

    increments = 100 if options.quick else 200
    samples = [sampled(read_curve(file), increments) for file in files]
    tests, paths = [test for test, _ in samples], [path for _, path in samples]
    runs = scratch / "femu_runs"
    verification = verify(paths, runs)
    model = CubeModel(paths, runs)
    stores = scratch / "stores" / ("femu_quick" if options.quick else "femu")
    stores.mkdir(parents=True, exist_ok=True)
    found = {
        measure: fit(model, tests, measure, stores, options.workers, quick=options.quick)
        for measure in (MEASURES[:3] if options.quick else MEASURES)
    }
    failures = survive_failures(model, tests, options.workers)
    results: dict[str, Any] = {
        "tests": [file.name for file in files],
        "increments": [len(path) - 1 for path in paths],
        "verification": verification,
        "measures": {m: summary(found[m], paths) for m in found},
        "failures": failures,
    }
    (output / "femu_calculix.json").write_text(json.dumps(results, indent=1) + "\n")
    figure = draw(found, [file.stem for file in files])
    save_picture(figure, output / "femu_calculix.webp", dpi=90)
    print(table(results["measures"]))
    print(f"written: {output / 'femu_calculix.json'}, {output / 'femu_calculix.webp'}")


def turning_points(strain: Array, threshold: float = 0.05) -> list[int]:
    """Return the indices at which the test turns back by more than a share of its range.

    Measured strain is not monotonic between them: smaller changes of direction are noise.
    """
    least = threshold * float(np.ptp(strain))
    turns: list[int] = []
    direction, extreme = 0, 0
    for i, value in enumerate(strain):
        if direction == 0:
            if abs(value - strain[extreme]) > least:
                direction, extreme = (1 if value > strain[extreme] else -1), i
        elif direction * (value - strain[extreme]) > 0:
            extreme = i
        elif direction * (strain[extreme] - value) > least:
            turns.append(extreme)
            direction, extreme = -direction, i
    return turns


def sampled(test: Array, increments: int) -> tuple[Array, Array]:
    """Return points of a test at equal steps of strain, and the path for the finite elements.

    The path goes from 0 through the turning points. It has an increment for every
    `cube.REFINEMENT` points, so that the simulation has its points where the test has them: a test
    machine writes at equal steps of time, and the area, which refers the points of the two curves
    to each other one by one, would see a difference that is none.
    """
    corners = [0, *turning_points(test[:, 0]), len(test) - 1]
    lengths = np.abs(np.diff(test[corners, 0]))
    counts = np.maximum(1, np.rint(increments * lengths / lengths.sum())).astype(int)
    points, path = [test[:1]], [np.zeros(1)]
    for first, last, count in zip(corners[:-1], corners[1:], counts, strict=True):
        branch = test[first : last + 1]
        # How far the test has come, whatever the noise: the first point at each step is taken.
        progress = np.maximum.accumulate(np.abs(branch[:, 0] - branch[0, 0]))
        steps = np.linspace(0.0, progress[-1], cube.REFINEMENT * count + 1)[1:]
        points.append(branch[np.searchsorted(progress, steps)])
        path.append(np.linspace(path[-1][-1], test[last, 0], count + 1)[1:])
    names = ("true strain", "true stress, MPa")
    return NamedCurve(np.concatenate(points), names), np.concatenate(path)


def verify(paths: Sequence[Array], runs: Path) -> list[dict[str, float]]:
    """Compare CalculiX with the integration, along the paths and along smaller ones."""
    parameters = {name: 0.6 * low + 0.4 * high for name, (low, high) in BOUNDS.items()}
    print("largest difference of CalculiX from an integration for small strains:")
    rows = []
    for scale in (1.0, 0.3, 0.1):
        scaled = [scale * path for path in paths]
        for path, curve in zip(scaled, CubeModel(scaled, runs)(parameters), strict=True):
            expected = cube.integrate(parameters, path)
            stress = cube.by_increment(curve)[:, 1]
            row = {
                "strain": float(np.abs(path).max()),
                "stress_MPa": float(np.abs(expected).max()),
                "difference_MPa": float(np.abs(stress - expected).max()),
            }
            rows.append(row)
            print("  {strain:.4f}: {difference_MPa:.3f} of {stress_MPa:.0f} MPa".format(**row))
            if row["difference_MPa"] > TOLERANCE * row["strain"] * row["stress_MPa"]:
                raise SystemExit("CalculiX does not follow the law it was given")
    return rows


def fit(
    model: CubeModel,
    tests: Sequence[Array],
    measure: str,
    stores: Path,
    workers: int,
    *,
    quick: bool,
) -> Identification:
    """Identify the parameters by one measure, or go on with what its store has."""
    # A store for each measure: each makes all of its runs itself.
    version = hashlib.sha256(model.deck.encode()).hexdigest()[:8]
    identification = identify(
        model,
        tests,
        BOUNDS,
        measure=Criterion(measure, preset="paper"),
        method="sdrm",
        max_runs=18 if quick else None,
        workers=workers,
        store=SimulationStore(stores / f"{measure}.db", version=version),
    )
    print(f"\n{TITLES[measure]}\n{identification}", flush=True)
    return identification


class SolverKiller(threading.Thread):
    """Kills a ccx that a worker of this process runs, as Linux does when memory is short."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.stopped = threading.Event()
        self.killed: list[int] = []

    def run(self) -> None:
        while not self.killed and not self.stopped.wait(0.01):
            for parent in [os.getpid(), *(p.pid for p in multiprocessing.active_children())]:
                # What has ended in the meantime has no files in /proc any more.
                with contextlib.suppress(FileNotFoundError, ProcessLookupError):
                    self._kill_child(Path(f"/proc/{parent}/task/{parent}/children"))

    def _kill_child(self, children: Path) -> None:
        for pid in map(int, children.read_text().split()):
            # Once the first increments are in the file of its status, it is in the middle of a run.
            if (
                not self.killed
                and Path(f"/proc/{pid}/comm").read_text() == "ccx\n"
                and Path(f"/proc/{pid}/cwd/cubes.sta").stat().st_size > 0
            ):
                os.kill(pid, signal.SIGKILL)
                self.killed.append(pid)


def survive_failures(model: CubeModel, tests: Sequence[Array], workers: int) -> dict[str, Any]:
    """Identify with a solver that is killed and parameters that make it diverge among others."""
    killer = SolverKiller()

    def start_killing(_: object) -> None:  # when the worker processes are there
        if killer.ident is None:
            killer.start()

    identification = identify(
        model,
        tests,
        DIVERGING_BOUNDS,
        measure=Criterion(preset="paper"),
        method=DifferentialEvolution(popsize=2),
        max_runs=36,
        workers=workers,
        callback=start_killing,
    )
    killer.stopped.set()
    killer.join()
    killed = [(n, m) for n, m in identification.failures if "killed by signal 9" in m]
    diverged = [(n, m) for n, m in identification.failures if "diverge" in last_error(m)]
    print(f"\nfailed and penalised: {len(identification.failures)}; the first of each kind:")
    for number, message in killed[:1] + diverged[:1]:
        print(f"  evaluation {number}: {message}\n    {last_error(message)}")
    print(f"the search went on to evaluation {identification.evaluations}")
    if not killed or not diverged:
        raise SystemExit("a failure that this was to survive has not happened")
    if max(killed[0][0], diverged[0][0]) >= identification.evaluations:
        raise SystemExit("the search has not gone on after the failures")
    return {
        "evaluations": identification.evaluations,
        "killed": len(killed),
        "diverged": len(diverged),
        "best": identification.value,
    }


def last_error(message: str) -> str:
    """Return the last error in the log that a message names."""
    log = Path(message.rpartition("log: ")[2].partition(" | ")[0])  # quotes of it follow
    errors = [line.strip() for line in log.read_text().splitlines() if "*ERROR" in line]
    return errors[-1] if errors else "(the log has no error)"


def summary(identification: Identification, paths: Sequence[Array]) -> dict[str, Any]:
    """Return what is worth keeping of an identification."""
    record = identification.history
    # The area between the loops over the length of the strain path, so that it is a stress.
    strain = sum(float(np.abs(np.diff(path)).sum()) for path in paths)
    return {
        "objective": identification.value,
        "evaluations": identification.evaluations,
        "failures": len(identification.failures),
        "first_objective": float(record.value[0]),
        "message": identification.message,
        "parameters": identification.parameters,
        "measures": identification.measures,
        "mean_deviation_MPa": identification.measures["area"] / strain,
    }


def table(measures: Mapping[str, dict[str, Any]]) -> str:
    """Return the optimum of every measure under all of them, as Table 4 of the paper has it."""
    lines = [
        "| minimised | " + " | ".join(MEASURES) + " | evaluations | mean deviation, MPa |",
        "|---|" + "---:|" * (len(MEASURES) + 2),
    ]
    for name, row in measures.items():
        values = " | ".join(f"{row['measures'][measure]:.4g}" for measure in MEASURES)
        deviation = row["mean_deviation_MPa"]
        lines.append(f"| {name} | {values} | {row['evaluations']} | {deviation:.1f} |")
    return "\n" + "\n".join(lines)


def draw(found: Mapping[str, Identification], names: Sequence[str]) -> Figure:
    """Draw the fitted loops beside the measured ones, and how every search converged."""
    rows = len(names) + 1
    figure = Figure(figsize=(3.5 * len(found), 3.0 * rows), layout="constrained")
    panels = figure.subplots(rows, len(found), squeeze=False)
    for column, (measure, identification) in zip(panels.T, found.items(), strict=True):
        for ax, name, P, Q in zip(
            column[:-1], names, identification.experiments, identification.simulations, strict=True
        ):
            ax.plot(*P.T, ".", color="#909090", markersize=2.0, label="test")
            ax.plot(*Q.T, color=COLOURS[measure], linewidth=1.3, label="CalculiX")
            ax.set(title=f"{TITLES[measure]}: {name}", xlabel="true strain")
            ax.locator_params(axis="x", nbins=5)
        values = identification.history.value
        best = np.minimum.accumulate(values)
        numbers = np.arange(1, len(best) + 1)
        column[-1].semilogy(numbers, values, ".", color="#909090", markersize=2.0)
        column[-1].semilogy(numbers, best, color=COLOURS[measure], linewidth=1.5)
        # Penalties are orders of magnitude above and would leave no room for the rest.
        column[-1].set(ylim=(best[-1] / 1.3, 2.0 * np.quantile(values, 0.9)))
        column[-1].set(title="convergence", xlabel="evaluation", ylabel=f"objective ({measure})")
    for ax in panels[:-1, 0]:
        ax.set_ylabel("true stress, MPa")
    for ax in panels[0]:
        # Below the virgin curve, inside the loop.
        ax.legend(loc="lower left", bbox_to_anchor=(0.25, 0.2), frameon=False, markerscale=4)
    return figure


if __name__ == "__main__":
    main()
