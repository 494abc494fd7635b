"""The fits of section 3.3 that several scripts draw from: all measures, without and with noise.

Each by the paper's own search: SDRM, whose optimum is one member of the first population of an
evolution that ends by the paper's rule. The loops are those of the paper, and the same with
noise, three draws of each deviation: the text's variance of 35 MPa², and the 35 MPa that Table 5
was made with.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence

from problems import (
    MEASURES,
    Array,
    HardeningModel,
    hardening_bounds,
    paper_responses,
    test_loops,
    with_noise,
)
from report import Run
from stores import identify_all
from studies import STALL, Effort, Found, Task, evolution

import curvewise

NOISE = {"35": 35.0, "5.9": math.sqrt(35.0)}  # MPa; Table 5's first, then the text's
DRAWS = 3
CLEAN = "clean"
DIGITS = {"area": ".1f", "pcm": ".4f", "frechet": ".3f", "dtw": ".1f", "curve_length": ".1f"}

# SDRM by far costs most with PCM, as it minimises predicted responses; 15 iterations are 256 runs.
SDRM = {"maxiter": 15}
SEARCH: Effort = {"sdrm": SDRM, "de": evolution(5, 1000, stall=STALL)}
QUICK: Effort = {"sdrm": {"maxiter": 1}, "de": evolution(2, 3)}


@functools.cache
def model() -> HardeningModel:
    """Return the material point at the strains of the paper's responses."""
    return HardeningModel.of_the_paper()


def noisy(case: str, draw: int) -> str:
    """Return the name of a data set with noise."""
    return f"noise_{case}_{draw}"


def tests(name: str) -> list[Array]:
    """Return the five loops of a data set."""
    if name == CLEAN:
        return test_loops()
    _, case, draw = name.split("_")
    return with_noise(test_loops(), NOISE[case], int(draw))


def data_sets(draws: int = DRAWS) -> dict[str, list[str]]:
    """Return the names of the data sets with noise, draw by draw, for each deviation."""
    return {case: [noisy(case, draw) for draw in range(draws)] for case in NOISE}


def tasks_of(names: Sequence[str], *, quick: bool = False) -> dict[tuple[str, str], Task]:
    """Return the identification from each data set by every measure."""
    return {
        (name, measure): Task(
            f"{name}_{measure}",
            model(),
            tests(name),
            hardening_bounds(),
            measure,
            QUICK if quick else SEARCH,
            material=True,
        )
        for name in names
        for measure in MEASURES
    }


def fits(run: Run, names: Sequence[str]) -> dict[str, dict[str, Found]]:
    """Return what every measure identifies from each data set; searched for where not stored."""
    tasks = tasks_of(names, quick=run.quick)
    found = identify_all(list(tasks.values()), run.store("hardening"), run.options.workers)
    return {name: {m: found[tasks[name, m].name] for m in MEASURES} for name in names}


def all_measures(loops: Sequence[Array], responses: Sequence[Array]) -> dict[str, float]:
    """Return the sum over the loops of every measure, under the conditions of Table 4."""
    pairs = zip(loops, responses, strict=True)
    rows = [curvewise.compare(P, Q, preset="paper").to_dict() for P, Q in pairs]
    return {measure: sum(row[measure] for row in rows) for measure in MEASURES}


def paper_values(measure: str) -> dict[str, float]:
    """Return every measure of the paper's response at the optimum of one, recomputed."""
    return all_measures(test_loops(), paper_responses(measure))


def number(value: float, measure: str, *, bold: bool = False) -> str:
    """Return a value with the digits of Table 4."""
    text = format(value, DIGITS[measure])
    return f"**{text}**" if bold else text


def parameter_error(parameters: Mapping[str, float], truth: Mapping[str, float]) -> float:
    """Return the largest distance of two sets of parameters, as a share of the range."""
    return max(
        abs(parameters[name] - truth[name]) / (high - low)
        for name, (low, high) in hardening_bounds().items()
    )
