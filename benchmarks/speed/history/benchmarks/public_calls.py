"""Times of every public call that ``counts`` counts, and of long sweeps with their memory.

asv imports this file in the environment of each commit: those before soft-DTW lack calls, and fail.
"""

import sys
from pathlib import Path

import numpy as np

import curvewise

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "counts"))
from calls import calls

CALLS = calls()


class PublicCalls:
    """Short calls: most of their time is what a call costs."""

    params = (sorted(CALLS),)
    param_names = ("call",)

    def setup(self, call: str) -> None:
        """Look the call up, which is not timed."""
        self.call = CALLS[call]

    def time_call(self, call: str) -> None:
        """Time it."""
        self.call()


class Sweeps:
    """Full tables of long curves, whose points are all compared: nothing is pruned."""

    params = (("dtw", "frechet", "soft_dtw", "msm", "erp"), (1000, 10_000))
    param_names = ("measure", "points")

    def setup(self, measure: str, points: int) -> None:
        """Draw two random walks."""
        random = np.random.default_rng(0)
        self.P, self.Q = random.normal(size=(2, points, 2)).cumsum(axis=1)
        self.measure = getattr(curvewise, measure)
        self.options = {"prune": False} if measure in ("dtw", "frechet") else {}

    def time_sweep(self, measure: str, points: int) -> None:
        """Time it."""
        self.measure(self.P, self.Q, **self.options)

    def peakmem_sweep(self, measure: str, points: int) -> None:
        """Take the most memory of a process that does this alone."""
        self.measure(self.P, self.Q, **self.options)
