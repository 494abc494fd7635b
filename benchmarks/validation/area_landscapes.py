"""Is an area an objective? Minima along lines, and how far noise and outliers move the optimum.

Two problems of Jekel et al. (2018): the load–unload cycle of their Eq. 2, four parameters, with
noise of both standard deviations that the paper's data and text have, and with outliers of 0.5 (the
cycle is 1.72 high); and their five hardening loops, nine parameters, with noise of 35 MPa, for
which the material point of reproduction/problems.py takes the place of LS-DYNA. "matched"
stands beside the spacing that it replaces, and dtw.

Lines go through the truth (of the loops: through the paper's optimum for area) in random
directions; the number of minima of 161 values on each. An optimum is that of Nelder and Mead (1965)
from the truth and from two points about it, by simplices that become smaller; its error is the root
mean square difference of the identified curve from the true one, in per cent of its height. "64
points": the simulation has 64 points of its own, the test 150.
Everything on curves scaled by the test's box.

Reads the golden data; writes area_landscapes.json.xz. Half an hour or more.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
from places import RESULTS
from problems import HardeningModel, hardening_bounds, paper_parameters
from scipy.optimize import minimize
from stored import write_json
from timing import Array, machine, print_table

import curvewise

Matching: TypeAlias = Callable[[Array, Array], float]
MEASURES: Mapping[str, Matching] = {
    "distance, rearrange": curvewise.area,
    "distance, split": partial(curvewise.area, crossing="split"),
    "x, split": partial(curvewise.area, spacing="x", crossing="split"),
    "matched": partial(curvewise.area, spacing="matched"),
    "dtw": curvewise.dtw,
}


class Problem(NamedTuple):
    """A model, the parameters about which lines are drawn and searches begin, and their ranges."""

    model: Callable[[Array], list[Array]]
    truth: Array
    ranges: Array
    span: float  # of a line through the truth, to either side, in ranges


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--output", type=Path, default=RESULTS)
    parser.add_argument("--samples", type=int, default=10, help="sets of data of the cycle")
    parser.add_argument("--lines", type=int, default=12)
    options = parser.parse_args()
    cycle, sparse, loops = load_unload(100, 50), load_unload(41, 23), hardening()
    results: dict[str, dict[str, dict[str, object]]] = {"minima": {}, "error": {}}
    for name, measure in MEASURES.items():
        results["minima"][name] = {
            case: minima(measure, problem, tests, options.lines)
            for case, problem, tests in line_cases(cycle, sparse, loops)
        }
        results["error"][name] = {
            f"{case}{points}": [error(measure, problem, [test]) for test in tests]
            for points, problem in (("", cycle), (", 64 points", sparse))
            for case, tests in cycle_data(cycle, options.samples).items()
        }
        results["error"][name]["loops, 35 MPa"] = [
            error(measure, loops, noisy_loops(loops, seed)) for seed in range(3)
        ]
        print(name, json.dumps({kind: row[name] for kind, row in results.items()}), flush=True)
    for kind, rows in results.items():
        cases = list(rows["matched"])
        cells = [(name, *(f"{summary(row[case])}" for case in cases)) for name, row in rows.items()]
        print_table(f"{kind}: mean; median (worst)", ("", *cases), cells)
    content = {"machine": machine(("numpy", "scipy")), **results}
    write_json(options.output / "area_landscapes.json.xz", content)


def summary(found: object) -> str:
    """Return a mean as it is; of errors the median and the worst."""
    if isinstance(found, list):
        return f"{np.median(found):.2f} ({max(found):.2f})"
    return f"{found:.1f}"


def load_unload(loading: int, unloading: int) -> Problem:
    """Return Eq. 2, with as many points on its branches."""
    up = np.linspace(0.0, 1.0, loading)
    down = np.linspace(1.0, np.log((1 + np.e) / 2), unloading)
    x = np.concatenate((up, down))

    def model(b: Array) -> list[Array]:
        y_up = np.exp(b[0] * up) + b[1]
        y_down = 2 * np.exp(b[2] * down) - 2 * np.exp(b[3]) + np.e - 1
        return [np.column_stack((x, np.concatenate((y_up, y_down))))]

    return Problem(model, np.array((1.0, -1.0, 1.0, 1.0)), np.ones(4), 0.5)


def hardening() -> Problem:
    """Return the five loops, simulated at the strains of the paper's responses."""
    material = HardeningModel.of_the_paper()
    bounds = hardening_bounds()
    optimum = paper_parameters("area")

    def model(values: Array) -> list[Array]:
        parameters = dict(zip(bounds, values, strict=True))
        # Beyond this there is no such material; an optimiser only needs to be kept from it.
        parameters["CB"] = max(parameters["CB"], parameters["SIGY"] + 1e-6)
        return material(parameters)

    ranges = np.array([high - low for low, high in bounds.values()])
    return Problem(model, np.array([optimum[name] for name in bounds]), ranges, 0.1)


def cycle_data(cycle: Problem, samples: int) -> dict[str, list[Array]]:
    """Return sets of data of the cycle."""
    (true,) = cycle.model(cycle.truth)
    data: dict[str, list[Array]] = {}
    for name, deviation in (("sigma 0.052", 0.052), ("sigma 0.224", 0.05**0.5)):
        data[name] = [true.copy() for _ in range(samples)]
        for seed, test in enumerate(data[name]):
            test[:, 1] += np.random.default_rng(seed).normal(0.0, deviation, len(test))
    for count in (1, 5):
        data[f"outliers: {count}"] = [true.copy() for _ in range(samples)]
        for seed, test in enumerate(data[f"outliers: {count}"]):
            rng = np.random.default_rng(seed)
            test[rng.choice(len(test), count, replace=False), 1] += rng.choice((-0.5, 0.5), count)
    return data


def noisy_loops(loops: Problem, seed: int) -> list[Array]:
    """Return simulated tests with noise of 35 MPa."""
    rng = np.random.default_rng(seed)
    return [test + rng.normal(size=test.shape) * (0.0, 35.0) for test in loops.model(loops.truth)]


def line_cases(
    cycle: Problem, sparse: Problem, loops: Problem
) -> list[tuple[str, Problem, list[Array]]]:
    """Return what lines are drawn for: simulation, and tests."""
    data = cycle_data(cycle, 1)
    exact = cycle.model(cycle.truth)
    cases = [("exact", cycle, exact), ("exact, 64 points", sparse, exact)]
    for name in ("sigma 0.052", "sigma 0.224"):
        cases += [(name, cycle, data[name]), (f"{name}, 64 points", sparse, data[name])]
    cases += [("loops", loops, loops.model(loops.truth))]
    cases += [("loops, 35 MPa", loops, noisy_loops(loops, 0))]
    return cases


def objective(measure: Matching, problem: Problem, tests: list[Array]) -> Callable[[Array], float]:
    """Return the sum of a measure over the tests; infinity where the model has no curves."""

    def value(parameters: Array) -> float:
        curves = problem.model(parameters)
        if not all(np.isfinite(curve).all() for curve in curves):
            return np.inf
        pairs = zip(tests, curves, strict=True)
        return sum(measure(*curvewise.normalize(test, curve)) for test, curve in pairs)

    return value


def minima(measure: Matching, problem: Problem, tests: list[Array], lines: int) -> float:
    """Return the mean number of minima on a line."""
    value = objective(measure, problem, tests)
    rng = np.random.default_rng(1)
    count = 0
    for _ in range(lines):
        direction = rng.normal(size=len(problem.truth))
        direction *= problem.ranges / np.linalg.norm(direction)
        steps = np.linspace(-problem.span, problem.span, 161)
        values = np.array([value(problem.truth + step * direction) for step in steps])
        change = np.diff(values)
        rises = change[np.abs(change) > 1e-12 * values.max()] > 0
        count += int((rises[1:] & ~rises[:-1]).sum()) + int(rises[0]) + int(not rises[-1])
    return count / lines


def error(measure: Matching, problem: Problem, tests: list[Array]) -> float:
    """Return how far the identified curves are from the true ones, in % of their heights."""
    value = objective(measure, problem, tests)
    scale = problem.ranges * problem.span
    starts = np.random.default_rng(2).uniform(-0.6, 0.6, (2, len(scale)))
    best = None
    for start in np.vstack((np.zeros_like(scale), starts)):
        found = search(value, problem.truth + start * scale, scale)
        best = found if best is None or found.fun < best.fun else best
    squares = [
        np.mean((found[:, 1] - true[:, 1]) ** 2) / np.ptp(true[:, 1]) ** 2
        for found, true in zip(problem.model(best.x), problem.model(problem.truth), strict=True)
    ]
    return float(100 * np.sqrt(np.mean(squares)))


def search(value: Callable[[Array], float], start: Array, scale: Array):  # type: ignore[no-untyped-def]  # scipy has no types
    """Minimise by Nelder–Mead, from simplices that become smaller."""
    size = 0.2
    found = None
    while size > 0.01:
        simplex = np.vstack((start, start + size * np.diag(scale)))
        options = {"initial_simplex": simplex, "xatol": 1e-6, "fatol": 1e-9, "maxfev": 4000}
        found = minimize(value, start, method="Nelder-Mead", options=options)
        start, size = found.x, size / 2
    return found


if __name__ == "__main__":
    main()
