"""Lower bounds of the distance between z-normalised windows and a curve.

A point of a window may be matched to some points of the curve only; their box is its envelope. The
excesses of the window's points beyond their envelopes give a lower bound (Keogh & Ratanamahatana
2005): their sum for dtw, the largest for frechet. The compiled library computes it for all windows
of a block with one mean and deviation. The effect of rounding is subtracted. Let n be the number of
points of a window, X the largest number, and g = (n + d + 16) 2^-52. This g is more than twice the
relative rounding error of sums of n numbers in any order:

- Two means differ by g X at most, for each is within g X / 2 of the true one.
- The root of the mean square about a number changes by at most the change of the number. Its
  rounding is g / 2 of its value, which is at most 2 X. Two deviations differ by 3 g X at most.
- Two windows (x - mean) / deviation then differ, as root mean square, by at most 5 g X / deviation
  and terms of higher order. The value eta = 8 g X / deviation covers these.
- A norm of d coordinates is at most the sum of these. Let eta be added up over the coordinates. The
  sum of n distances then differs by n eta at most, and so does the largest; the root of a sum of
  squares differs by sqrt(n) eta.
- The rest, (1 - 4 g), is for the rounding of distances and of their sums.

A window that barely varies, compared with its level, has a large eta. It is normalised exactly as
in the measure, so that only the last step remains. The same is done for blocks with numbers whose
squares leave the range of a double, and for metrics without bounds in the library.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .._core import runs_outside
from .._options import Metric, WarpingName
from ..curves.ground_distance import ground_distances
from ..curves.inputs import Array
from ..curves.z_normalization import normalized_windows

__all__ = ["run_bounds"]

_NUMBERS_IN_A_BLOCK = 1 << 22
_LEAST_WINDOWS_IN_A_BLOCK = 256
_NUMBERS_AT_ONCE = 1 << 16
_LARGEST_ETA = 1e-4


def run_bounds(
    P: Array, Q: Array, measure: WarpingName, metric: Metric, order: float, window: int | None
) -> Array:
    """Return a lower bound for each window of Q, both of shape (., d) and P normalised."""
    return _Bounds(P, Q, measure, metric, order, window).all()


class _Bounds:
    def __init__(
        self,
        P: Array,
        Q: Array,
        measure: WarpingName,
        metric: Metric,
        order: float,
        window: int | None,
    ) -> None:
        n, d = self.shape = P.shape
        self.Q, self.metric, self.order = Q, metric, order
        self.of_largest = measure == "frechet"
        reach = n if window is None else min(window, n)
        around = [P[max(i - reach, 0) : i + reach + 1] for i in range(n)]
        self.low = np.array([points.min(axis=0) for points in around])
        self.high = np.array([points.max(axis=0) for points in around])
        self.rounding = (n + d + 16) * 2.0**-52

    def all(self) -> Array:
        """Return the bound of each window, block by block."""
        n, d = self.shape
        bounds = np.empty(max(len(self.Q) - n + 1, 0))
        step = max(_NUMBERS_IN_A_BLOCK // (n * d), _LEAST_WINDOWS_IN_A_BLOCK)
        for first in range(0, len(bounds), step):
            block = bounds[first : first + step]
            is_certain = self._find(self.Q[first : first + len(block) + n - 1], block)
            at_once = max(_NUMBERS_AT_ONCE // (n * d), 1)
            for i in range(0, len(block), at_once):
                if not is_certain[i : i + at_once].all():
                    end = min(i + at_once, len(block))
                    block[i:end] = self._find_precisely(slice(first + i, first + end))
        bounds *= 1.0 - 4.0 * self.rounding
        return bounds

    def _find(self, part: Array, bounds: Array) -> npt.NDArray[np.bool_]:
        """Find the bounds of the windows of a part of Q, and return which are to be relied on."""
        n, d = self.shape
        sizes = np.abs(part)
        least = sizes.min(where=sizes > 0, initial=1.0)
        is_in_range = least > 2.0**-400 and sizes.max() < 2.0**400
        if not is_in_range or (self.metric == "minkowski" and d > 1):
            return np.zeros(len(bounds), dtype=np.bool_)
        options = {"metric": self.metric}
        totals, scales = runs_outside(self.low, self.high, part, options, self.of_largest)
        with np.errstate(invalid="ignore"):
            eta = 8.0 * self.rounding * (sizes.max(axis=0) @ scales)
            if self.metric == "sqeuclidean":
                bounds[:] = np.square(np.maximum(np.sqrt(totals) - np.sqrt(n) * eta, 0.0))
            else:
                bounds[:] = totals - n * eta
        return np.asarray(eta <= _LARGEST_ETA)

    def _find_precisely(self, starts: slice) -> Array:
        n, d = self.shape
        windows = normalized_windows(self.Q, n, starts)
        beyond = windows - np.clip(windows, self.low, self.high)
        terms = ground_distances(beyond, np.zeros(d), self.metric, self.order)
        return np.asarray(terms.max(axis=1) if self.of_largest else terms.sum(axis=1))
