"""How rough an objective is along a line: its minima, its variation, its largest step."""

from __future__ import annotations

import numpy as np
from problems import Array
from scipy.signal import find_peaks


def smoothness(values: Array) -> tuple[int, float, float]:
    """Return the number of minima, the relative variation and the largest step of a scan.

    A minimum counts if both its sides rise by 0.1 % of the range; the variation is 1 for one
    descent and one ascent; the step is a share of the range.
    """
    extent = np.ptp(values)
    padded = np.concatenate(([np.inf], values, [np.inf]))  # a minimum may be at an end
    minima, _ = find_peaks(-np.minimum(padded, values.max() + extent), prominence=1e-3 * extent)
    ends = values[0] + values[-1] - 2 * values.min()
    steps = np.abs(np.diff(values))
    return len(minima), float(steps.sum() / ends), float(steps.max() / extent)
