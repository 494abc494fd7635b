"""Backbone curves, of ASCE 41's first cycles and of stabilised ones."""

from __future__ import annotations

import numpy as np
import pytest
from hysteresis import bilinear, driven, masing

from curvewise.curves import backbone

E, K, N = 200e3, 1000.0, 0.15
TWO_LEVELS = [(0, 0), (1, 10), (-1, -11), (1, 9), (-1, -8), (2, 15), (-2, -16), (2, 13), (-2, -12)]


@pytest.mark.parametrize("cycle", ["first", "last"])
def test_backbone_of_masing_loops_is_their_skeleton(cycle):
    tips = [s * sign for s in (200.0, 300.0, 400.0) for _ in range(3) for sign in (1, -1)]
    # Branches that pass an older tip are not twice the skeleton: each level begins unloaded here.
    parts = [masing(tips[i : i + 6], E, K, N, 100) for i in (0, 6, 12)]
    record = np.concatenate(parts)
    found = backbone(record, cycle=cycle)
    stress = np.array([-400.0, -300.0, -200.0, 0.0, 200.0, 300.0, 400.0])
    assert found[:, 1] == pytest.approx(stress)
    strain = stress / E + np.sign(stress) * (np.abs(stress) / K) ** (1 / N)
    assert found[:, 0] == pytest.approx(strain, rel=1e-9)


def test_backbone_of_kinematic_hardening_is_the_monotonic_curve():
    levels = 0.5 * 1.4 ** np.arange(6)
    ends = [0.0, *(sign * a for a in levels for _ in range(2) for sign in (1, -1)), 0.0]
    record = bilinear(driven(ends, 200), 10.0, 10.0, 0.1)
    found = backbone(record, reversal=0.05)
    assert len(found) == 13
    once = bilinear(np.concatenate(([0.0], levels)), 10.0, 10.0, 0.1)
    assert found[6:] == pytest.approx(once, rel=1e-9)
    assert found[6::-1] == pytest.approx(-once, rel=1e-9)


def test_first_and_last_cycles_of_each_level():
    record = np.array([*TWO_LEVELS, (0, 0)], float)
    assert backbone(record)[:, 1].tolist() == [-16, -11, 0, 10, 15]
    assert backbone(record, cycle="last")[:, 1].tolist() == [-12, -8, 0, 9, 13]


def test_small_cycles_between_give_no_point():
    # CUREE's trailing cycles have 75 % of the amplitude before.
    record = [(0, 0), (1, 10), (-1, -10), (0.75, 6), (-0.75, -6), (1.0, 9), (-1.0, -9), (0, 0)]
    for cycle, force in (("first", 10), ("last", 9)):
        assert backbone(record, cycle=cycle).tolist() == [[-1, -force], [0, 0], [1, force]]
    # A partial unloading does not make a peak, although its minimum is within 10 % of one.
    record = [(0, 0), (10, 10), (9.5, 5), (10, 11), (-10, -10), (0, 0)]
    assert backbone(record, cycle="last", reversal=0.02)[-1].tolist() == [10, 11]


def test_increment_decides_what_is_one_level():
    record = [(0, 0), (1.0, 5), (-1.0, -5), (1.08, 6), (-1.08, -6), (1.16, 7), (-1.16, -7), (0, 0)]
    assert backbone(record)[:, 1].tolist() == [-7, -5, 0, 5, 7]
    assert backbone(record, increment=0.2)[:, 1].tolist() == [-5, 0, 5]
    assert backbone(record, increment=0)[:, 1].tolist() == [-7, -6, -5, 0, 5, 6, 7]


def test_a_final_pull_counts_and_an_unfinished_branch_does_not():
    record = [*TWO_LEVELS, (5, 20)]
    assert backbone(record)[-1].tolist() == [5, 20]
    assert backbone([*record, (4.9, 0)])[-1].tolist() == [5, 20]
    assert backbone([*TWO_LEVELS, (1.9, 12)], cycle="last")[-1].tolist() == [2, 13]
    assert backbone([(0, 0), (1, 3)]).tolist() == [[0, 0], [1, 3]]
    assert backbone([(0, 0), (-1, -3)]).tolist() == [[-1, -3], [0, 0]]


def test_amplitudes_count_from_the_first_point_and_by_the_driving_column():
    record = np.array([*TWO_LEVELS, (0, 0)], float)
    shift = np.array([100.0, 7.0])
    assert np.allclose(backbone(record + shift), backbone(record) + shift)
    assert np.array_equal(backbone(record[:, ::-1], column=1), backbone(record)[:, ::-1])
    with_time = np.column_stack((np.arange(10.0), record))
    assert backbone(with_time, column=1)[:, 0].tolist() == [6, 2, 0, 1, 5]


def test_tips_of_a_noisy_record_are_averages():
    random = np.random.default_rng(5)
    ends = [0.0, 0.5, -0.5, 1.0, -1.0, 0.0]
    record = bilinear(driven(ends, 4000), 10.0, 3.0, 0.1)
    record[:, 0] += random.normal(0.0, 0.004, len(record))
    found = backbone(record)
    assert found[:, 0] == pytest.approx([-1.0, -0.5, 0.0, 0.5, 1.0], abs=0.004)
    assert found[[0, 1, 3, 4], 1] == pytest.approx([-3.7, -3.2, 3.2, 3.7], abs=0.01)


def test_wrong_arguments():
    with pytest.raises(ValueError, match=r"unknown cycle 'second'; choose from first, last"):
        backbone(TWO_LEVELS, cycle="second")
    for increment in (-0.1, np.inf, "much"):
        with pytest.raises(ValueError, match=r"increment is .*; give a fraction, at least 0"):
            backbone(TWO_LEVELS, increment=increment)
    with pytest.raises(ValueError, match=r"reversal is 2; it must be between 0 and 1"):
        backbone(TWO_LEVELS, reversal=2)
