"""Which tables are pruned: by the share of the cells that were swept, not by the time it took."""

from __future__ import annotations

import numpy as np

import curvewise


def test_a_long_curve_that_comes_back_to_its_levels_is_pruned() -> None:
    x = np.sin(np.arange(200_000) / 1000)
    info = curvewise.frechet_info(x, x)
    assert info.value == 0.0
    assert info.pruned
    assert info.share < 0.001
