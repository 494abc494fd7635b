"""Where in a long curve one occurs that differs by a shift and a scale: z-normalised windows.

Rakthanmanon et al., "Searching and mining trillions of time series subsequences under dynamic time
warping" (2012), for curves of any dimension and for several answers that do not overlap. Each
window is bounded by the envelope of what is looked for (Keogh & Ratanamahatana 2005), and windows
are looked at in the order of their bounds (Seidl & Kriegel 1998), up to the best distance so far.
Time O(n) a window for its bound, and O(n m) for each window whose bound does not settle it; O(m)
memory and some megabytes.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from .._options import Metric, WarpingName
from ..curves.ground_distance import ground_distances
from ..curves.inputs import Array
from ..curves.z_normalization import normalized_windows
from .pairwise import cdist

__all__ = ["NormalizedRuns"]

_NUMBERS_IN_A_BLOCK = 1 << 18
_COMPUTED_AT_ONCE = 64
# The bound adds up the terms of a path in another order.
_SLACK = 1.0 - 1e-12


@dataclass
class NormalizedRuns:
    """The runs of Q with as many points as P, both of shape (., d) and P normalised.

    `window` is the half-width of the band of dtw, or None; `options` are those of the measure.
    """

    P: Array
    Q: Array
    measure: WarpingName
    metric: Metric
    order: float
    window: int | None
    options: dict[str, Any]
    workers: int
    _revisited: list[tuple[float, int, bool]] = field(default_factory=list)

    def best(self, count: int, cutoff: float) -> Iterator[tuple[float, int]]:
        """Yield the distance and the start of each answer, the best of what those before leave."""
        bounds = self._bounds()
        waiting = iter(np.argsort(bounds, kind="stable").tolist())
        following = next(waiting, None)
        is_left = np.ones(len(bounds), dtype=np.bool_)
        n = len(self.P)
        while count > 0:
            best = self._best_known(is_left)
            limit = min(best, cutoff)
            batch: list[int] = []
            while len(batch) < _COMPUTED_AT_ONCE:
                if self._revisited and not self._revisited[0][2] and self._revisited[0][0] <= limit:
                    start = heapq.heappop(self._revisited)[1]
                elif following is not None and bounds[following] <= limit:
                    start, following = following, next(waiting, None)
                else:
                    break
                if is_left[start]:
                    batch.append(start)
            if batch:
                self._compute(batch, limit)
            elif best <= cutoff and self._revisited:
                distance, start, _ = heapq.heappop(self._revisited)
                yield distance, start
                count -= 1
                is_left[max(start - n + 1, 0) : start + n] = False
            else:
                return

    def _best_known(self, is_left: npt.NDArray[np.bool_]) -> float:
        """Return the least distance that is known of a window that is left."""
        while self._revisited and not is_left[self._revisited[0][1]]:
            heapq.heappop(self._revisited)
        known = (value for value, start, is_exact in self._revisited if is_exact and is_left[start])
        return min(known, default=math.inf)

    def _compute(self, batch: list[int], limit: float) -> None:
        """Compute distances as far as they are at most `limit`; of others that is a bound."""
        windows = [normalized_windows(self.Q, len(self.P), i, i + 1)[0] for i in batch]
        (row,) = cdist(
            [self.P],
            windows,
            self.measure,
            cutoff=None if limit == math.inf else limit,
            workers=self.workers,
            **self.options,
        )
        for start, value in zip(batch, row.tolist(), strict=True):
            is_exact = value <= limit
            bound = value if is_exact else math.nextafter(limit, math.inf)
            heapq.heappush(self._revisited, (bound, start, is_exact))

    def _bounds(self) -> Array:
        """Return a lower bound of the distance of each window."""
        low, high = self._envelope()
        n, d = self.P.shape
        count = max(len(self.Q) - n + 1, 0)
        bounds = np.empty(count)
        step = max(_NUMBERS_IN_A_BLOCK // (n * d), 1)
        for first in range(0, count, step):
            end = min(first + step, count)
            windows = normalized_windows(self.Q, n, first, end)
            beyond = windows - np.clip(windows, low, high)
            terms = ground_distances(beyond, np.zeros(d), self.metric, self.order)
            total = terms.max(axis=1) if self.measure == "frechet" else terms.sum(axis=1)
            bounds[first:end] = total * _SLACK
        return bounds

    def _envelope(self) -> tuple[Array, Array]:
        """Return the box of the points that each point of a window may be matched to."""
        n = len(self.P)
        reach = n if self.window is None else min(self.window, n)
        around = [self.P[max(i - reach, 0) : i + reach + 1] for i in range(n)]
        return np.array([a.min(axis=0) for a in around]), np.array([a.max(axis=0) for a in around])
