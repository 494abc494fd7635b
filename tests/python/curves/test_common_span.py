"""The span of a column over which two curves are known."""

from __future__ import annotations

import numpy as np
import pytest

from curvewise.curves import common_span


def test_ends_are_interpolated_and_points_between_are_kept():
    P = np.array([(0, 0), (1, 2), (2, 4), (4, 8)], float)
    Q = np.array([(0.5, 1), (2, 4), (3, 6)], float)
    p, q = common_span(P, Q)
    assert p.tolist() == [[0.5, 1], [1, 2], [2, 4], [3, 6]]
    assert np.array_equal(q, Q)
    q, p = common_span(Q, P)
    assert len(p) == 4
    both = common_span(P, P)
    assert all(np.array_equal(one, P) for one in both)


def test_any_column_that_does_not_turn_back():
    P = np.column_stack((np.sin(np.arange(9.0)), np.arange(9.0)))
    Q = np.column_stack((np.cos(np.arange(5.0)), np.arange(5.0) + 1.0))
    p, q = common_span(P, Q, by=1)
    assert (p[0, 1], p[-1, 1], len(p)) == (1.0, 5.0, 5)
    assert np.array_equal(q, Q)
    p, q = common_span(P, Q, by=-1)
    assert len(p) == 5
    steps = np.array([(0, 0), (1, 0), (1, 5), (2, 5)], float)  # a jump
    assert common_span(steps, steps)[0].tolist() == steps.tolist()


def test_curves_without_a_span_are_refused():
    line = [(0.0, 0.0), (1.0, 1.0)]
    with pytest.raises(
        ValueError, match=r"column 0 of Q reverses at row 2, from 1.0 to 0.5; a common span needs"
    ):
        common_span(line, [(0, 0), (1, 0), (0.5, 0)])
    for later in ([(2, 0), (3, 0)], [(1, 0), (3, 0)]):
        with pytest.raises(ValueError, match=r"P and Q have no common span: column 0 is 0.0 to 1."):
            common_span(line, later)
    with pytest.raises(ValueError, match=r"column is 2; the curve has columns 0 to 1"):
        common_span(line, line, by=2)
    with pytest.raises(ValueError, match=r"at least 2 points are needed"):
        common_span(line, line[:1])
