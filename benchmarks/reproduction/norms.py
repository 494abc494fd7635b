"""Section 4: the measures as norms, one curve reversed, and the partial mapping of LS-OPT.

On the line with an outlier (figure 7), each measure's best line beside that of the norm that it
is said to behave like: the sum of absolute residuals (L1), of squared ones (L2), the largest (L∞).
Then footnote 1: every measure of a loop against itself traversed backwards. Last, what the PCM
column of Table 4 is compatible with, as LS-OPT's definition is not published in full.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np
from problems import (
    LOOPS,
    MEASURES,
    TITLES,
    Array,
    line_with_outlier,
    paper_responses,
    tables,
    test_loops,
)
from report import Run, table
from straight_line import PROBLEMS, best_line

import curvewise

SYMMETRIC2 = {"step_pattern": "symmetric2"}


def residual_norm(P: Array, Q: Array, *, order: float) -> float:
    """Return a norm of the differences in y at the common x."""
    return float(np.linalg.norm(P[:, 1] - Q[:, 1], ord=order))


FITS: dict[str, tuple[str, Callable[[Array, Array], float]]] = {
    "L1: least absolute deviations": ("norm", functools.partial(residual_norm, order=1)),
    "Area": ("L1", curvewise.area),
    "DTW": ("L1", functools.partial(curvewise.dtw, **SYMMETRIC2)),
    "L2: least squares": ("norm", curvewise.sum_of_squares),
    "Area of squared quadrilaterals": ("L2", functools.partial(curvewise.area, squared=True)),
    "Area of squared quadrilaterals, split": (
        "L2",
        functools.partial(curvewise.area, squared=True, crossing="split"),
    ),
    "DTW of squared distances": (
        "L2",
        functools.partial(curvewise.dtw, metric="sqeuclidean", **SYMMETRIC2),
    ),
    "L∞: smallest largest deviation": ("norm", functools.partial(residual_norm, order=np.inf)),
    "Fréchet": ("L∞", curvewise.frechet),
}


def main() -> None:
    """Fit, reverse, compare, write."""
    run = Run(__doc__)
    cells, starts = (41, 8) if run.quick else (201, 40)
    run.section("norms", norm_table(cells, starts))
    run.section("reversed", reversed_table())
    run.section("partial_mapping_of_ls_opt", mapping_table())


def norm_table(cells: int, starts: int) -> str:
    """Return the best line of each norm, and of the measures that are like it."""
    problem = PROBLEMS["Fig. 7"]
    outlier = line_with_outlier()[4]
    rows = []
    for title, (kind, fit) in FITS.items():
        slope, intercept, value = best_line(problem, fit, cells, starts)
        missed = outlier[1] - (slope * outlier[0] + intercept)
        name = f"**{title}**" if kind == "norm" else f"{title} (like {kind})"
        numbers = (f"{slope:.4f}, {intercept:.4f}", f"{value:.5g}", f"{missed:.2f}")
        rows.append([name, *numbers])
    return table(["minimised", "slope, intercept", "value", "line below the outlier by"], rows)


def reversed_table() -> str:
    """Return every measure of a loop against itself backwards, and against the paper's fit."""
    rows = []
    for measure in MEASURES:
        backwards, fitted = [], []
        for P, Q in zip(test_loops(), paper_responses("area"), strict=True):
            backwards.append(curvewise.compare(P, P[::-1], preset="paper")[measure])
            fitted.append(curvewise.compare(P, Q, preset="paper")[measure])
        cells = [f"{sum(values):.4g}" for values in (backwards, fitted)]
        rows.append([TITLES[measure], "0", *cells, f"{sum(backwards) / sum(fitted):.0f}"])
    header = ["sum of the loops", "forwards", "backwards", "of the paper's fit", "ratio"]
    return table(header, rows)


def mapping_table() -> str:
    """Return what each definition of partial mapping gives, over Table 4's printed PCM column."""
    printed = tables()["table_4_without_noise"]
    rows = []
    for measure in MEASURES:
        pairs = list(zip(test_loops(), paper_responses(measure), strict=True))
        theirs = printed[measure][MEASURES.index("pcm")]
        cells = []
        for definition in DEFINITIONS.values():
            total = sum(definition(P, Q) for P, Q in pairs)
            cells.append(f"{total / theirs:.3g}")
        rows.append([TITLES[measure], f"{theirs:.4f}", *cells])
    return (
        f"{table(['optimum of', 'printed', *DEFINITIONS], rows)}\n\n"
        f"Sums over loops {LOOPS[0]} to {LOOPS[-1]}, divided by what is printed."
    )


def scaled_alike(P: Array, Q: Array) -> tuple[Array, Array]:
    """Return both curves scaled by the test's box, as section 2.1 has it."""
    P, Q = curvewise.normalize(P, Q)
    return P, Q


def scaled_apart(P: Array, Q: Array) -> tuple[Array, Array]:
    """Return each curve scaled by its own box, as claim 1 of US 8,521,484 begins."""
    return curvewise.normalize(P)[0], curvewise.normalize(Q)[0]


def smallest(
    P: Array,
    Q: Array,
    *,
    scaled: Callable[[Array, Array], tuple[Array, Array]],
    worth: Callable[[Array, Array, Array], float],
    offsets: int = 200,
) -> float:
    """Return the least worth of mapped points, of all offsets of the shorter curve."""
    curves = scaled(P, Q)
    lengths = [np.concatenate(([0.0], np.hypot(*np.diff(c, axis=0).T).cumsum())) for c in curves]
    shorter = 0 if lengths[0][-1] <= lengths[1][-1] else 1
    s, t = lengths[shorter], lengths[1 - shorter]
    short, long = curves[shorter], curves[1 - shorter]
    found = []
    for offset in np.linspace(0.0, t[-1] - s[-1], offsets):
        at = np.minimum(s + offset, t[-1])
        mapped = np.column_stack([np.interp(at, t, column) for column in long.T])
        found.append(worth(short, mapped, s))
    return float(min(found))


def integral(short: Array, mapped: Array, s: Array) -> float:
    """Return the distance integrated over the arc length."""
    d = np.hypot(*(short - mapped).T)
    return float(((d[1:] + d[:-1]) / 2 * np.diff(s)).sum())


def mean_square(short: Array, mapped: Array, s: Array) -> float:
    """Return the mean of the squared distances at the vertices."""
    return float(((short - mapped) ** 2).sum(axis=1).mean())


def mean_square_by_length(short: Array, mapped: Array, s: Array) -> float:
    """Return the squared distance integrated over the arc length, over the length."""
    d = ((short - mapped) ** 2).sum(axis=1)
    return float(((d[1:] + d[:-1]) / 2 * np.diff(s)).sum() / s[-1])


def closed_polygon(short: Array, mapped: Array, s: Array) -> float:
    """Return the area of the polygon: along one curve, and back along the other."""
    x, y = np.concatenate((short, mapped[::-1])).T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


DEFINITIONS: dict[str, Callable[[Array, Array], float]] = {
    f"{name}{scaling}": functools.partial(smallest, scaled=scaled, worth=worth)
    for scaling, scaled in (("", scaled_alike), (", own boxes", scaled_apart))
    for name, worth in {
        "integral of the distance": integral,
        "mean squared distance": mean_square,
        "squared distance over length": mean_square_by_length,
        "closed polygon": closed_polygon,
    }.items()
}


if __name__ == "__main__":
    main()
