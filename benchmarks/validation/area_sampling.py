"""Does an area measure the curves, or how they were sampled?

A measured loop against itself: thinned, sampled anew, with gaps, noise, outliers, its turns cut
off; and each of these moved up by 5 % of the loop's height as well. All values are given in per
cent of what moving up alone gives. Ideally a thinned loop gives 0, or what its missing vertices
really enclose ("true": each vertex matched with the one it is); and a loop that is moved up gives
100, whatever else was done to it. Curves are scaled by the loop's box. Then the time of a call.

Reads the golden data; writes area_sampling.json.xz and, of the loops, area_sampling.webp. Loops
take a few minutes, the times, which want a quiet machine, half a minute; a part is put beside the
one that is there.
"""

from __future__ import annotations

import argparse
import itertools
import statistics
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from places import DATA, RESULTS
from stored import read_json, save_picture, write_json
from timing import Array, curve_pair, duration, machine, print_table

import curvewise

Matching: TypeAlias = Callable[[Array, Array], float]
MATCHINGS: Mapping[str, Matching] = {
    "distance, rearrange": curvewise.area,
    "distance, split": partial(curvewise.area, crossing="split"),
    "x, split": partial(curvewise.area, spacing="x", crossing="split"),
    "arc_length, split": partial(curvewise.area, spacing="arc_length", crossing="split"),
    "matched": partial(curvewise.area, spacing="matched"),
}
RAISED = np.array((0.0, 0.05))
SHOWN = ("every 2nd", "60 increments", "noise y", "noise xy")  # in the picture


class Variant(NamedTuple):
    """A loop to compare with, and, if known, the index in the original that each vertex has."""

    curve: Array
    index: Array | None = None


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--output", type=Path, default=RESULTS)
    parser.add_argument("--part", nargs="+", choices=("loops", "times"), default=["loops", "times"])
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    file = options.output / "area_sampling.json.xz"
    content = read_json(file)
    for part in options.part:
        measured_on = machine(("numpy", "similaritymeasures"))
        results = measure_loops() if part == "loops" else times()
        content[part] = {"machine": measured_on, "results": results}
    write_json(file, content)
    if "loops" in options.part:
        draw(content["loops"]["results"], options.output / "area_sampling.webp")


def measure_loops() -> dict[str, dict[str, dict[str, tuple[float, float]]]]:
    """Return the values of every way, by loop, and print them."""
    results = {}
    for name, loop in loops().items():
        results[name] = measure(loop)
        print_loop(f"{name}, {len(loop)} points", results[name])
    return results


def loops() -> dict[str, Array]:
    """Return the golden data's loops, scaled by their boxes."""
    files = sorted((DATA / "loops").glob("*.csv"))
    files += [DATA / "paper" / "test" / f"loop_{k}.csv" for k in (1, 5)]
    curves = {}
    for file in files:
        header = int(not file.read_text()[0].lstrip("-").isdigit())
        name = f"paper_{file.stem}" if file.parent.name == "test" else file.stem
        curves[name] = curvewise.normalize(np.loadtxt(file, delimiter=",", skiprows=header))[0]
    return curves


def variants(loop: Array) -> dict[str, Variant]:
    """Return what each loop is compared with."""
    n = len(loop)
    index = np.arange(n)
    rng = np.random.default_rng(0)
    turns = turning_points(loop[:, 0])
    lengths = arc_lengths(loop)

    def kept(which: npt.NDArray[np.bool_]) -> Variant:
        which = which.copy()
        which[[0, -1]] = True
        return Variant(loop[which], index[which].astype(float))

    def noisy(curve: Array, x: float, y: float) -> Variant:
        return Variant(curve + rng.normal(size=curve.shape) * (x, y))

    increments = solver_increments(lengths, turns)
    even = np.linspace(0, lengths[-1], int(0.9 * n))
    near_turn = np.zeros(n, bool)
    for turn in turns[1:-1]:
        near = np.abs(index - turn) < n // (2 * len(turns))
        near_turn |= near & (np.abs(loop[:, 0] - loop[turn, 0]) < 0.02)
    spikes = loop.copy()
    struck = rng.random(n) < 0.01
    spikes[struck, 1] += rng.choice([-0.3, 0.3], struck.sum())
    few = loop.copy()
    few[rng.choice(n, 3, replace=False), 1] += 0.3
    return {
        "every 2nd": kept(index % 2 == 0),
        "every 10th": kept(index % 10 == 0),
        "30 %": kept(rng.random(n) < 0.3),
        "dense, sparse": kept((index < n // 2) | (index % 10 == 0)),
        "60 increments": Variant(loop[increments], increments.astype(float)),
        "resampled": Variant(at(loop, lengths, even), np.interp(even, lengths, index)),
        "turns cut off": kept(~near_turn),
        "gap": kept((index < 0.3 * n) | (index > 0.4 * n)),
        "noise y": noisy(loop, 0.0, 0.02),
        "noise xy": noisy(loop, 0.01, 0.01),
        "thinned, noise": noisy(loop[::2], 0.01, 0.01),
        "outliers 1 %": Variant(spikes),
        "3 outliers": Variant(few),
    }


def turning_points(x: Array, least: float = 0.05) -> list[int]:
    """Return the ends, and where x turns to go back by at least `least`."""
    turns, extreme, direction = [0], 0, 0.0
    for i in range(1, len(x)):
        if (x[i] - x[extreme]) * direction > 0 or (direction == 0 and x[i] == x[extreme]):
            extreme = i
        elif abs(x[i] - x[extreme]) >= least:
            turns.append(extreme)
            direction = np.sign(x[i] - x[extreme])
            extreme = i
    return sorted({*turns, len(x) - 1})


def solver_increments(lengths: Array, turns: list[int]) -> Array:
    """Return the vertices nearest to what a solver gives: 60 increments, growing in each branch."""
    per_branch = max(3, 60 // (len(turns) - 1))
    wanted = [
        lengths[a] + (lengths[b] - lengths[a]) * np.linspace(0, 1, per_branch + 1) ** 1.5
        for a, b in itertools.pairwise(turns)
    ]
    vertices = np.searchsorted(lengths, np.concatenate(wanted)).clip(0, len(lengths) - 1)
    return np.unique(np.concatenate((vertices, turns)))


def measure(loop: Array) -> dict[str, dict[str, tuple[float, float]]]:
    """Return, by matching and variant, the value and that of the variant moved up, in per cent."""
    compared = variants(loop)
    found = {}
    for name, matching in MATCHINGS.items():
        unit = matching(loop, loop + RAISED) / 100
        found[name] = {
            how: (matching(loop, v.curve) / unit, matching(loop, v.curve + RAISED) / unit)
            for how, v in compared.items()
        }
    unit = curvewise.area(loop, loop + RAISED) / 100
    found["true"] = {
        how: (true_area(loop, v) / unit, true_area(loop, v._replace(curve=v.curve + RAISED)) / unit)
        for how, v in compared.items()
        if v.index is not None
    }
    return found


def arc_lengths(curve: Array) -> Array:
    """Return the arc length at every vertex."""
    return np.concatenate(([0.0], np.hypot(*np.diff(curve, axis=0).T).cumsum()))


def at(curve: Array, positions: Array, wanted: Array) -> Array:
    """Return the points of a curve at wanted positions, of which its vertices have `positions`."""
    return np.column_stack([np.interp(wanted, positions, coordinate) for coordinate in curve.T])


def swept(A: Array, B: Array) -> float:
    """Return the area that the line between facing curves sweeps, forward or backward."""
    motion = np.diff(A + B, axis=0) / 2
    leash = B - A
    begin, end = (motion[:, 0] * v[:, 1] - motion[:, 1] * v[:, 0] for v in (leash[:-1], leash[1:]))
    total = np.abs(begin) + np.abs(end)
    crossed = (begin**2 + end**2) / np.where(total > 0, total, 1.0)
    return float(np.where(begin * end < 0, crossed, total).sum() / 2)


def true_area(loop: Array, variant: Variant) -> float:
    """Return the area between vertices matched with those that they are."""
    index = np.arange(len(loop), dtype=float)
    places = np.union1d(index, variant.index)
    return swept(at(loop, index, places), at(variant.curve, variant.index, places))


def times() -> dict[str, dict[str, float]]:
    """Return the seconds of a call, by numbers of points and way, and print them."""
    calls: dict[str, Matching] = {
        key: MATCHINGS[key] for key in ("distance, rearrange", "arc_length, split", "matched")
    }
    try:
        import similaritymeasures
    except ImportError:
        print("similaritymeasures is not installed: not timed")
    else:
        calls["similaritymeasures"] = similaritymeasures.area_between_two_curves
    seconds: dict[str, dict[str, float]] = {}
    for n, m in ((155, 102), (1000, 900), (7816, 3908)):
        P, Q = curve_pair(n, m, 2)
        row = seconds[f"{n}, {m}"] = {}
        for name, call in calls.items():
            if name == "similaritymeasures" and n > 1000:
                continue  # half a minute a call
            samples = []
            for _ in range(3 if name == "similaritymeasures" else 51):
                begin = time.perf_counter()
                call(P, Q)
                samples.append(time.perf_counter() - begin)
            row[name] = statistics.median(samples)
    rows = [
        (size, *(duration(row[way]) if way in row else "" for way in calls))
        for size, row in seconds.items()
    ]
    print_table("median time of a call", ("points", *calls), rows)
    return seconds


def print_loop(title: str, found: dict[str, dict[str, tuple[float, float]]]) -> None:
    """Print values, and behind them those of the variant moved up."""
    columns = list(found["matched"])
    rows = [
        (name, *(f"{row[c][0]:.1f} {row[c][1]:.0f}" if c in row else "" for c in columns))
        for name, row in found.items()
    ]
    print_table(f"{title}: % of the shift, % when moved up", ("", *columns), rows)


def draw(results: dict[str, dict[str, dict[str, tuple[float, float]]]], file: Path) -> None:
    """Draw how far each way is from 0, and from 100 when moved up, on every loop."""
    from matplotlib.figure import Figure

    ways = list(MATCHINGS)
    figure = Figure(figsize=(11, 3.6), layout="constrained")
    axes = figure.subplots(1, len(SHOWN), sharey=True)
    for ax, how in zip(axes, SHOWN, strict=True):
        for k, way in enumerate(ways):
            values = np.array([found[way][how] for found in results.values()])
            for moved, colour, marker in ((0, "#0072B2", "o"), (1, "#D55E00", "x")):
                distance = np.abs(values[:, moved] - 100 * moved).clip(0.01)
                ax.plot(distance, [k] * len(distance), marker, color=colour, alpha=0.7, ms=5)
        ax.set(xscale="log", xlim=(0.008, 1e5), title=how)
        ax.axvline(2 if how in SHOWN[:2] else 25, color="0.6", lw=1, zorder=0)
        ax.grid(axis="y", color="0.92")
    axes[0].set_yticks(range(len(ways)), ways)
    axes[0].invert_yaxis()
    axes[0].plot([], [], "o", color="#0072B2", label="from 0")
    axes[0].plot([], [], "x", color="#D55E00", label="from 100, moved up by 5 %")
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    figure.suptitle("Distance from the ideal, in % of a shift by 5 % of the height: every loop")
    save_picture(figure, file, dpi=110)
    print(f"written: {file}")


if __name__ == "__main__":
    main()
