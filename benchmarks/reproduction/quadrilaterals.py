"""Simple and complex quadrilaterals: figures 16 and 17, and the statements of Appendix A.

Random quadrilaterals with whole-number corners, so that crossing sides are recognised exactly:
whether the signs of Eqs. 8 to 11 tell the complex ones, whether the angles add up to 360° and
720°, whether rearranging makes every complex one simple, and what area that gives beside the two
triangles which the crossing sides enclose.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from problems import Array
from report import Run, table

import curvewise

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EXAMPLES = {
    "convex": [(0, 0), (4, 0.3), (3.4, 3), (0.5, 2.6)],
    "concave": [(0, 0), (4, 0.2), (1.6, 1.2), (1, 3)],
    "complex": [(0, 0), (0.4, 2.4), (4, 0.3), (3.6, 2.8)],
}


def main() -> None:
    """Draw, count, write."""
    run = Run(__doc__)
    draw_kinds(run)
    draw_rearranged(run)
    run.section("quadrilaterals", count_table(2_000 if run.quick else 200_000))


def count_table(count: int) -> str:
    """Return how often each statement holds."""
    random = np.random.Generator(np.random.PCG64(16))
    quads = random.integers(-1000, 1001, (count, 4, 2))
    products = cross_products(quads)
    quads = quads[(products != 0).all(axis=1)]  # three corners on a line are neither kind
    products = cross_products(quads)
    positive = (products > 0).sum(axis=1)
    by_signs = positive == 2
    crossing = sides_cross(quads, 0) | sides_cross(quads, 1)
    angles = interior_angles(quads)
    swapped = quads[crossing][:, [1, 0, 2, 3]]
    second = quads[crossing][:, [0, 2, 1, 3]]
    at_once, at_all = (~(sides_cross(q, 0) | sides_cross(q, 1)) for q in (swapped, second))
    rearranged, split = effective_areas(quads[crossing][:2000])
    ratio = rearranged / split
    rows = [
        ["quadrilaterals, of them with crossing sides", f"{len(quads)}, {crossing.sum()}"],
        ["two signs of each kind if and only if sides cross", share(by_signs == crossing)],
        ["angles of the others add up to 360°", share(angles[~crossing] == 360)],
        ["angles of those that cross add up to 720°", share(angles[crossing] == 720)],
        ["simple once the first two corners are swapped", share(at_once)],
        ["simple by one of two swaps", share(at_once | at_all)],
        [
            "rearranged area over that of the two triangles, 5 % to 95 %",
            f"{np.quantile(ratio, 0.05):.2f} to {np.quantile(ratio, 0.95):.2f}",
        ],
    ]
    return table(["statement", "of random quadrilaterals"], rows)


def share(holds: npt.NDArray[np.bool_]) -> str:
    """Return how often something holds."""
    return f"{holds.sum()} of {len(holds)}"


def cross_products(quads: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Return Eqs. 8 to 11: the cross products of consecutive edges."""
    edges = np.roll(quads, -1, axis=1) - quads
    return cross(edges, np.roll(edges, -1, axis=1))


def cross(a: npt.NDArray[np.int64], b: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Return the cross products of vectors, exact in whole numbers."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def sides_cross(quads: npt.NDArray[np.int64], first: int) -> npt.NDArray[np.bool_]:
    """Return whether a side and the opposite one cross: 0 for AB and CD, 1 for BC and DA."""
    a, b, c, d = (quads[:, (first + k) % 4] for k in range(4))
    on_both_sides = np.sign(cross(b - a, c - a)) * np.sign(cross(b - a, d - a)) < 0
    and_back = np.sign(cross(d - c, a - c)) * np.sign(cross(d - c, b - c)) < 0
    return on_both_sides & and_back


def interior_angles(quads: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Return the sum of the angles on the inner side, in whole degrees.

    The angle at a corner is 180° minus the turn there, measured on one side all the way round;
    the inner side is the one that gives a simple quadrilateral 360° and not 1080°.
    """
    edges = np.roll(quads, -1, axis=1) - quads
    following = np.roll(edges, -1, axis=1)
    turns = np.degrees(np.arctan2(cross(edges, following), (edges * following).sum(axis=-1)))
    return np.rint(720 - np.abs(turns.sum(axis=1))).astype(np.int64)


def effective_areas(quads: npt.NDArray[np.int64]) -> tuple[Array, Array]:
    """Return the library's areas of quadrilaterals, rearranged and split."""
    pairs = [(quad[:2], quad[:1:-1]) for quad in quads.astype(float)]
    rearranged = np.array([curvewise.area(P, Q) for P, Q in pairs])
    split = np.array([curvewise.area(P, Q, crossing="split") for P, Q in pairs])
    return rearranged, split


def draw_kinds(run: Run) -> None:
    """Draw figure 16: a complex, a concave and a convex quadrilateral."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 3.2), layout="constrained")
    for panel, name in zip(figure.subplots(1, 3), ("complex", "concave", "convex"), strict=True):
        draw_quad(panel, EXAMPLES[name], ("1", "2", "3", "4"))
        panel.set_title(name)
    run.picture("figure_16", figure)


def draw_rearranged(run: Run) -> None:
    """Draw figure 17: the complex one, and simple with its first two corners swapped."""
    from matplotlib.figure import Figure

    quad = EXAMPLES["complex"]
    figure = Figure(figsize=(7, 3.2), layout="constrained")
    before, after = figure.subplots(1, 2)
    draw_quad(before, quad, ("1", "2", "3", "4"))
    draw_quad(after, [quad[1], quad[0], *quad[2:]], ("2", "1", "3", "4"))
    before.set_title("(a) complex")
    after.set_title("(b) simple: 1 and 2 swapped")
    run.picture("figure_17", figure)


def draw_quad(panel: Axes, corners: Sequence[tuple[float, float]], names: Sequence[str]) -> None:
    """Draw a quadrilateral, its corners numbered."""
    closed = np.array([*corners, corners[0]])
    panel.fill(*closed.T, color="0.88")
    panel.plot(*closed.T, "o-", color="black", markersize=4, linewidth=1.2)
    for corner, name in zip(corners, names, strict=True):
        beside = (-10, -4) if corner[0] < 2 else (6, -4)
        panel.annotate(name, corner, textcoords="offset points", xytext=beside)
    panel.margins(0.15)
    panel.set_axis_off()


if __name__ == "__main__":
    main()
