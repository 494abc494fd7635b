"""Search for z-normalised occurrences of a curve in a long one.

The occurrences may differ by a shift and a scale. The algorithm is that of Rakthanmanon et al.,
"Searching and mining trillions of time series subsequences under dynamic time warping" (2012). It
is extended to curves of any dimension and to several answers that do not overlap. The envelope of
the query gives a lower bound for each window (Keogh & Ratanamahatana 2005). Windows are processed
in the order of their bounds (Seidl & Kriegel 1998), up to the best distance so far. Time O(n) for
the bound of each window, and O(n m) for each window that its bound does not exclude; O(m) memory
and some megabytes.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .._options import WarpingName
from ..curves.inputs import Array
from ..curves.z_normalization import normalized_windows
from .pairwise import cdist

__all__ = ["NormalizedRuns"]

_COMPUTED_AT_ONCE = 64
_SORTED_FIRST = 1024


def _in_order(bounds: Array) -> Iterator[int]:
    """Yield the indices of the bounds, the least first; few are usually needed."""
    rest = np.arange(len(bounds))
    some = _SORTED_FIRST
    while rest.size > 0:
        if rest.size > some:
            rest = rest[np.argpartition(bounds[rest], some)]
        yield from rest[:some][np.argsort(bounds[rest[:some]])].tolist()
        rest = rest[some:]
        some *= 8


@dataclass
class NormalizedRuns:
    """The runs of Q with as many points as P, both of shape (., d) and P normalised.

    `bounds` are of their distances, and `options` those of the measure.
    """

    P: Array
    Q: Array
    bounds: Array
    measure: WarpingName
    options: dict[str, Any]
    workers: int
    # Heaps of (distance, start), and of (bound, start) for computations that stopped at a limit.
    _known: list[tuple[float, int]] = field(default_factory=list)
    _given_up: list[tuple[float, int]] = field(default_factory=list)

    def best(self, count: int, cutoff: float) -> Iterator[tuple[float, int]]:
        """Yield the distance and the start of each answer, the best of what those before leave."""
        bounds = self.bounds
        waiting = _in_order(bounds)
        following = next(waiting, None)
        is_left = np.ones(len(bounds), dtype=np.bool_)
        n = len(self.P)
        while count > 0:
            while self._known and not is_left[self._known[0][1]]:
                heapq.heappop(self._known)
            best = self._known[0][0] if self._known else math.inf
            limit = reach = min(best, cutoff)
            batch: list[int] = []
            while len(batch) < _COMPUTED_AT_ONCE:
                if self._given_up and self._given_up[0][0] <= limit:
                    start = heapq.heappop(self._given_up)[1]
                    reach = 2.0 * limit  # or each answer would have it computed again
                elif following is not None and bounds[following] <= limit:
                    start, following = following, next(waiting, None)
                else:
                    break
                if is_left[start]:
                    batch.append(start)
            if batch:
                self._compute(batch, reach)
            elif best <= cutoff and self._known:
                distance, start = heapq.heappop(self._known)
                yield distance, start
                count -= 1
                is_left[max(start - n + 1, 0) : start + n] = False
            else:
                return

    def _compute(self, batch: list[int], limit: float) -> None:
        """Compute distances up to `limit`; larger ones are replaced by lower bounds."""
        (row,) = cdist(
            [self.P],
            list(normalized_windows(self.Q, len(self.P), batch)),
            self.measure,
            cutoff=None if limit == math.inf else limit,
            workers=self.workers,
            **self.options,
        )
        for start, value in zip(batch, row.tolist(), strict=True):
            if value <= limit:
                heapq.heappush(self._known, (value, start))
            else:
                heapq.heappush(self._given_up, (math.nextafter(limit, math.inf), start))
