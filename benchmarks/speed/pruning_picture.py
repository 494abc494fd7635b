"""The picture of exact_and_fast.md: the Fréchet table of two real loops, taken apart into blocks.

Beside the blocks, the corridor that bounds leave of the DTW table. Everything is computed again
here in numpy, from boxes around runs of points and from whole tables, as the page explains it: the
compiled search has its own trees, thresholds and order. The loops are two tests of one steel from
CURVEWISE_DATA/loops, dp780_tct_3pct and dp780_tct_6pct, resampled.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from pruning_curves import MODERATE, pair
from timing import Array

import curvewise

POINTS = 1024
LEAF = 4
PICTURE = Path(__file__).resolve().parents[2] / "docs" / "images" / "pruning.png"
BLOCKED, FREE, SWEPT = range(3)
COLOURS = ("#E4E4E4", "#9CCBE8", "#D55E00")
LIVE = "#E69F00"


def main() -> None:
    """Classify both tables and draw them."""
    P, Q = pair(MODERATE, POINTS)
    distance = np.sqrt(((P[:, None] - Q[None]) ** 2).sum(axis=2))
    answer = curvewise.frechet(P, Q)
    kinds = np.full(distance.shape, -1)
    split(kinds, P, Q, (0, len(P)), (0, len(Q)), answer)
    block_unreached(kinds, distance <= answer)
    live = live_cells(distance, curvewise.dtw(P, Q))
    for kind, name in enumerate(("blocked", "free", "swept")):
        print(f"frechet, {name}: {100 * (kinds == kind).mean():.1f} %")
    print(f"dtw, live: {100 * live.mean():.1f} %")
    draw(kinds, live, curvewise.frechet_path(P, Q).path, curvewise.dtw_path(P, Q).path)


def split(
    kinds: Array, P: Array, Q: Array, rows: tuple[int, int], columns: tuple[int, int], answer: float
) -> None:
    """Write what a block is, or split it in four."""
    smallest, largest = box_distances(P[slice(*rows)], Q[slice(*columns)])
    block = kinds[slice(*rows), slice(*columns)]
    if smallest > answer:
        block[:] = BLOCKED
    elif largest <= answer:
        block[:] = FREE
    elif max(block.shape) <= LEAF:
        block[:] = SWEPT
    else:
        for part in halves(*rows):
            for other in halves(*columns):
                split(kinds, P, Q, part, other, answer)


def halves(first: int, end: int) -> list[tuple[int, int]]:
    """Return the two halves of a range, or the range where it is a single point."""
    middle = (first + end + 1) // 2
    return [(a, b) for a, b in ((first, middle), (middle, end)) if a < b]


def box_distances(P: Array, Q: Array) -> tuple[float, float]:
    """Return the smallest and the largest distance between the boxes around two runs of points."""
    low, high = P.min(axis=0), P.max(axis=0)
    other_low, other_high = Q.min(axis=0), Q.max(axis=0)
    gap = np.maximum(np.maximum(low - other_high, other_low - high), 0.0)
    span = np.maximum(high - other_low, other_high - low)
    return float(np.sqrt((gap**2).sum())), float(np.sqrt((span**2).sum()))


def block_unreached(kinds: Array, is_near: Array) -> None:
    """Mark the blocks of a leaf's size as blocked that no coupling from the start reaches."""
    reached = np.zeros_like(is_near)
    for i, j in np.ndindex(is_near.shape):
        before = reached[max(i - 1, 0) : i + 1, max(j - 1, 0) : j + 1].any() or i == j == 0
        reached[i, j] = is_near[i, j] and before
    for i in range(0, len(kinds), LEAF):
        for j in range(0, kinds.shape[1], LEAF):
            block = np.s_[i : i + LEAF, j : j + LEAF]
            if not reached[block].any():
                kinds[block] = BLOCKED


def live_cells(distance: Array, most: float) -> Array:
    """Return the cells of the DTW table from which the end may be reached for `most`.

    The lower bound of what is to come is the sum over the rows, or the columns, that are left of
    the smallest distance in each.
    """
    table = np.full(np.add(distance.shape, 1), np.inf)
    table[0, 0] = 0.0
    for i, j in np.ndindex(distance.shape):
        step = min(table[i, j + 1], table[i + 1, j], table[i, j])
        table[i + 1, j + 1] = step + distance[i, j]
    to_come = [suffix_sums(distance.min(axis=axis)) for axis in (1, 0)]
    slack = 1.0 - sum(distance.shape) * 2.0**-52
    return np.asarray((table[1:, 1:] + np.maximum.outer(*to_come)) * slack <= most)


def suffix_sums(terms: Array) -> Array:
    """Return for each term the sum of those behind it."""
    return np.append(np.cumsum(terms[:0:-1])[::-1], 0.0)


def draw(kinds: Array, live: Array, coupling: Any, warping: Any) -> None:
    """Draw both tables, the paths on them."""
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    figure = Figure(figsize=(11, 5.6), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    left.imshow(kinds, cmap=ListedColormap(COLOURS), vmin=0, vmax=2, interpolation="nearest")
    right.imshow(live, cmap=ListedColormap((COLOURS[BLOCKED], LIVE)), interpolation="nearest")
    names = ("blocked", "free", "filled")
    patches = [Patch(color=c, label=name) for c, name in zip(COLOURS, names, strict=True)]
    lives = [Patch(color=COLOURS[BLOCKED], label="pruned"), Patch(color=LIVE, label="active")]
    titles = ("Discrete Fréchet: blocks", "DTW: active cells")
    for panel, path, title, handles in zip(
        (left, right), (coupling, warping), titles, (patches, lives), strict=True
    ):
        line = panel.plot(path[:, 1], path[:, 0], "k", linewidth=1.0, label="path")
        panel.set_title(title)
        panel.set_xlabel("point of Q")
        panel.legend(handles=[*handles, *line], loc="upper right", fontsize=9)
    left.set_ylabel("point of P")
    figure.savefig(PICTURE, dpi=110)
    print(f"written: {PICTURE}")


if __name__ == "__main__":
    main()
