"""Plane measures against their exact values, in numbers of 2300 bits.

These are computed by benchmarks/validation/accuracy.py; docs/explanation/guarantees.md has its
table of more curves, and more kinds of them.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).resolve().parents[3] / "benchmarks" / "validation"
if not BENCHMARKS.is_dir():
    pytest.skip("the source distribution has no benchmarks", allow_module_level=True)
sys.path.insert(0, str(BENCHMARKS))

import accuracy  # noqa: E402 (the path comes first)


@pytest.mark.parametrize("measure", accuracy.MEASURES)
@pytest.mark.parametrize("kind", ["loops", "x 1e-4, y 1e6", "largest 1e153", "largest 1e-156"])
def test_usual_curves_are_within_some_units_in_the_last_place(kind, measure):
    errors = accuracy.errors_of(kind, measure, pairs=1)
    assert errors
    assert max(errors) < 100  # 2e-14; areas below the smallest normal number have fewer places


@pytest.mark.parametrize("measure", ["area", "area, x", "pcm, 20 offsets"])
def test_curves_that_are_nearly_equal_lose_what_they_have_in_common(measure):
    """Of curves that agree to 1e-9 the difference has as many places less."""
    (error,) = accuracy.errors_of("equal but for 1e-9", measure, pairs=1)
    assert accuracy.PROMISED < error < 1e10
    assert np.isfinite(error)
