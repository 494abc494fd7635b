"""Section 4: the measures as norms, one curve reversed, and the partial mapping of LS-OPT.

On the line with an outlier (figure 7), each measure's best line beside that of the norm that it
is said to behave like: the sum of absolute residuals (L1), of squared ones (L2), the largest (L∞).
Then footnote 1: every measure of a loop against itself traversed backwards. Last, what the PCM
column of Table 4 is compatible with, as LS-OPT's definition is not published.
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
    """Return Table 4's PCM column beside ours, and beside the mean of squared distances."""
    printed = tables()["table_4_without_noise"]
    rows = []
    for measure in MEASURES:
        pairs = list(zip(test_loops(), paper_responses(measure), strict=True))
        integral = sum(curvewise.pcm(P, Q) for P, Q in pairs)
        squares = sum(mean_square_mapped(P, Q) for P, Q in pairs)
        theirs = printed[measure][MEASURES.index("pcm")]
        rows.append(
            [
                TITLES[measure],
                f"{theirs:.4f}",
                f"{integral:.4f}",
                f"{integral / theirs:.0f}",
                f"{squares:.5f}",
                f"{squares / theirs:.2f}",
            ]
        )
    header = [
        "optimum of",
        "printed",
        "integral of the distance",
        "over printed",
        "mean squared distance",
        "over printed",
    ]
    return f"{table(header, rows)}\n\nSums over loops {LOOPS[0]} to {LOOPS[-1]}."


def mean_square_mapped(P: Array, Q: Array, offsets: int = 200) -> float:
    """Return the smallest mean of squared distances at the mapped vertices, over the offsets."""
    curves = curvewise.normalize(P, Q)
    lengths = [np.concatenate(([0.0], np.hypot(*np.diff(c, axis=0).T).cumsum())) for c in curves]
    shorter = 0 if lengths[0][-1] <= lengths[1][-1] else 1
    s, t = lengths[shorter], lengths[1 - shorter]
    short, long = curves[shorter], curves[1 - shorter]
    means = []
    for offset in np.linspace(0.0, t[-1] - s[-1], offsets):
        at = np.minimum(s + offset, t[-1])
        mapped = np.column_stack([np.interp(at, t, column) for column in long.T])
        means.append(((short - mapped) ** 2).sum(axis=1).mean())
    return float(min(means))


if __name__ == "__main__":
    main()
