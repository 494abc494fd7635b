"""How rough an objective is along a line: its minima by depth, its variation, its largest step.

The depth of a minimum is its prominence: how far the objective rises on the lower of its two sides
before it falls below the minimum. How many minima there are depends on the depth from which they
count, and on what a depth is a share of: of the range on the line, which Eq. 12 scales to 1, or of
the value, which is what an identification sees. Cost: O(points) a line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from problems import Array
from scipy.signal import find_peaks

DEPTHS = (1e-4, 1e-3, 1e-2)
DEPTH = 1e-3  # from which a minimum counts where one number is given


@dataclass(frozen=True)
class Landscape:
    """An objective along a line.

    `depths` are those of its minima, `value` the least on the line; `variation` is all ups and
    downs over those of one descent and one ascent, `step` the largest between neighbours, as a
    share of the range.
    """

    depths: Array
    value: float
    extent: float
    variation: float
    step: float

    def minima(self, depth: float = DEPTH, *, of: str = "range") -> int:
        """Return how many minima are deeper than a share of the range, or of the value."""
        whole = self.extent if of == "range" else self.value
        return int((self.depths > depth * whole).sum())

    def further_depth(self) -> float:
        """Return the depth of the deepest minimum beside the lowest one; 0 if there is none."""
        return float(np.sort(self.depths)[-2]) if len(self.depths) > 1 else 0.0


def landscape(values: Array) -> Landscape:
    """Return the minima and the roughness of a scan."""
    extent = float(np.ptp(values))
    padded = np.concatenate(([np.inf], values, [np.inf]))  # a minimum may be at an end
    _, found = find_peaks(-np.minimum(padded, values.max() + extent), prominence=0.0)
    ends = values[0] + values[-1] - 2 * values.min()
    steps = np.abs(np.diff(values))
    return Landscape(
        found["prominences"],
        float(values.min()),
        extent,
        float(steps.sum() / ends),
        float(steps.max() / extent),
    )
