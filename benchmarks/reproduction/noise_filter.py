"""A noise filter for tests, before measures that go by arc length."""

from __future__ import annotations

import numpy as np
from problems import Array
from scipy.signal import savgol_filter


def filtered(test: Array, window: int) -> Array:
    """Return a curve with a Savitzky–Golay filter over y, branch by branch.

    A filter across a turning point would round it off.
    """
    direction = np.sign(np.diff(test[:, 0]))
    moving = np.flatnonzero(direction)
    turns = moving[1:][np.diff(direction[moving]) != 0]
    branches = np.split(test[:, 1], turns)
    y = [savgol_filter(branch, window, 2, mode="interp") for branch in branches]
    return np.column_stack((test[:, 0], np.concatenate(y)))
