"""Loops of records, and their energy, stiffness and damping, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hysteresis import bilinear, driven, ellipse, masing

from curvewise.curves import (
    damping,
    loop_energy,
    loops,
    peaks_and_valleys,
    reversals,
    stiffness,
    turning_points,
)

CLOSE = 2e-5  # what 2000 chords leave of an ellipse, and of its extremes
EVERY = (loops, peaks_and_valleys, loop_energy, stiffness, damping)
STEEL = (200e3, 1000.0, 0.15)  # E, K and n of Ramberg and Osgood


@given(
    phase=st.floats(0.0, 2.0 * math.pi),
    cycles=st.integers(1, 4),
    a=st.floats(1e-3, 1e3),
    k=st.floats(0.5, 50.0),
    b=st.floats(0.1, 10.0),
)
def test_ellipse_has_one_loop_a_cycle_wherever_it_begins(phase, cycles, a, k, b):
    record = ellipse(a, k, b, cycles, phase)
    assert loop_energy(record) == pytest.approx([math.pi * a * b] * cycles, rel=CLOSE)
    tips = peaks_and_valleys(record)
    assert tips.shape == (cycles, 2, 2)
    assert tips[:, :, 0] == pytest.approx(np.array([[a, -a]] * cycles), rel=CLOSE)
    for loop in loops(record):
        assert abs(loop[0, 0] - loop[-1, 0]) < 1e-5 * a


@pytest.mark.parametrize("phase", [0.0, 0.5 * math.pi, math.pi])
def test_damping_of_a_viscous_damper_is_that_of_its_spring(phase):
    record = ellipse(2.0, 5.0, 3.0, 3, phase)
    assert stiffness(record) == pytest.approx([5.0] * 3, rel=1e-12)
    assert damping(record) == pytest.approx([3.0 / (2.0 * 5.0 * 2.0)] * 3, rel=CLOSE)


@pytest.mark.parametrize("points", [1, 40, 41])
@pytest.mark.parametrize("ductility", [1.5, 2.0, 4.0, 8.0])
@pytest.mark.parametrize("hardening", [0.0, 0.05, 0.2])
def test_bilinear_damping_is_that_of_atc_40(ductility, hardening, points):
    # Every corner is a point of the record: with points=1 nothing but corners.
    turn = ductility - 2.0
    ends = [0.0, 1.0, ductility, turn, -ductility, -turn, ductility, turn, -ductility]
    record = bilinear(driven(ends, points), 10.0, 10.0, hardening)
    found = damping(record)
    expected = (
        2.0
        * (ductility - 1.0)
        * (1.0 - hardening)
        / (math.pi * ductility * (1.0 + hardening * ductility - hardening))
    )
    assert found == pytest.approx([expected] * 2, rel=1e-12)
    secant = 10.0 * (1.0 + hardening * (ductility - 1.0)) / ductility
    assert stiffness(record) == pytest.approx([secant] * 2, rel=1e-12)
    if ductility > 1.5:  # otherwise the line is curved within 35 % of the height
        assert stiffness(record, kind="unloading") == pytest.approx([10.0] * 2, rel=1e-12)
        back = stiffness(record, kind="reloading")
        assert back[0] == pytest.approx(10.0, rel=1e-12)
        assert math.isnan(back[1])  # the record ends at this reversal


def test_perfectly_plastic_damping_by_the_formula_of_atc_40():
    # 2 (1 - 1 / mu) / pi in per cent, to three digits.
    for ductility, expected in ((2.0, 31.8), (4.0, 47.7), (6.0, 53.1)):
        record = bilinear(driven([0, ductility, -ductility, ductility], 480), 1.0, 1.0, 0.0)
        assert 100.0 * damping(record)[0] == pytest.approx(expected, abs=0.05)


@pytest.mark.parametrize("stress", [300.0, 500.0])
def test_masing_loop_has_morrows_energy(stress):
    E, K, n = STEEL
    record = masing([stress, -stress, stress, -stress, stress], E, K, n, 2000)
    plastic = 2.0 * (stress / K) ** (1.0 / n)
    expected = 2.0 * stress * plastic * (1.0 - n) / (1.0 + n)
    assert loop_energy(record) == pytest.approx([expected] * 2, rel=1e-5)
    # The tangent after a reversal is E; a chord of the first part is below it by a known amount.
    modulus = stiffness(record, kind="unloading", part=(0.0, 0.05))
    assert modulus == pytest.approx([E] * 2, rel=1e-3)


def test_both_signs_of_the_first_reversal_give_the_same():
    record = bilinear(driven([0.0, 3.0, -3.0, 3.0, -2.0, 3.5, -3.5, 1.0], 50), 2.0, 3.0, 0.1)
    for function in (loop_energy, stiffness, damping):
        assert function(-record) == pytest.approx(function(record), rel=1e-12)
    for kind, other in (("unloading", "reloading"), ("reloading", "unloading")):
        found = stiffness(-record, kind=kind)
        assert found == pytest.approx(stiffness(record, kind=other), rel=1e-12, nan_ok=True)
    tips = peaks_and_valleys(record)
    assert np.array_equal(peaks_and_valleys(-record), -tips[:, ::-1])


def test_energy_follows_units_place_and_direction():
    record = masing([300.0, -400.0, 350.0, -300.0, 400.0], *STEEL, 300)
    energy, secant, ratio = (f(record) for f in (loop_energy, stiffness, damping))
    moved = record + np.array([7.0, -1e3])
    assert loop_energy(moved) == pytest.approx(energy, rel=1e-9)
    scaled = record * [100.0, 1e6]
    assert loop_energy(scaled) == pytest.approx(1e8 * energy, rel=1e-12)
    assert stiffness(scaled) == pytest.approx(1e4 * secant, rel=1e-12)
    assert damping(scaled) == pytest.approx(ratio, rel=1e-12)
    swapped = record[:, ::-1]
    assert (loop_energy(swapped, column=1) < 0.0).all()
    assert loop_energy(swapped, column=1) == pytest.approx(-energy, rel=1e-12)


def test_stress_control_closes_loops_in_stress():
    record = masing([300.0, -300.0, 300.0, -300.0, 300.0], *STEEL, 300)
    assert loop_energy(record, column=1) == pytest.approx(loop_energy(record), rel=1e-9)
    tips = peaks_and_valleys(record, column=1)
    assert tips[:, :, 1].tolist() == [[300.0, -300.0]] * 2


def test_a_growing_loop_ends_where_the_first_reversal_is_passed():
    record = np.array([(0, 0), (1, 5), (-1, -5), (3, 15)], float)
    (loop,) = loops(record)
    assert loop.tolist() == [[1.0, 5.0], [-1.0, -5.0], [1.0, 5.0]]


def test_a_falling_loop_begins_on_the_branch_before():
    record = np.array([(-2, -4), (2, 4), (-2, -4), (1, 4), (-0.5, -1)], float)
    loop = loops(record)[0]
    assert loop.tolist() == [[1.0, 2.0], [2.0, 4.0], [-2.0, -4.0], [1.0, 4.0]]


def test_a_record_that_ends_early_closes_where_it_ends():
    record = np.array([(0, 0), (2, 4), (-2, -4), (0, 2)], float)
    assert loops(record)[0].tolist() == [[0, 0], [2, 4], [-2, -4], [0, 2]]


@pytest.mark.parametrize(
    "x",
    [
        [0.0, 1.0, -1.0],  # no way back
        [0.0, 1.0, 2.0],
        [0.0, 1.0, 0.5],  # cut short
        [3.0],
        [2.0, 2.0, 2.0],
    ],
)
def test_no_complete_cycle_is_refused(x):
    record = np.column_stack((x, x))
    for function in EVERY:
        with pytest.raises(
            ValueError, match=r"the curve lacks a complete cycle: it reverses \d time"
        ):
            function(record)


def test_a_last_branch_that_is_cut_short_is_no_cycle():
    whole = driven([0.0, 1.0, -1.0, 1.0, -1.0, 1.0], 10)
    for last, count in ((0.0, 2), (-0.7, 2), (-0.9, 3), (0.9, 2), (1.0, 2)):
        record = np.concatenate((whole, [last]))
        assert len(loops(record)) == count
    assert len(loops(np.concatenate((whole, [-1.0])))) == 3


@pytest.mark.parametrize("cycles_each", [1, 2, 3])
def test_growing_protocol_of_fema_461(cycles_each):
    amplitudes = 0.048 * 1.4 ** np.arange(10)
    ends = [0.0, *(sign * a for a in amplitudes for _ in range(cycles_each) for sign in (1, -1))]
    record = bilinear(driven([*ends, 0.0], 200), 100.0, 5.0, 0.02)
    tips = peaks_and_valleys(record, reversal=0.02)
    assert tips[:, 0, 0] == pytest.approx(np.repeat(amplitudes, cycles_each))
    ductility = np.repeat(amplitudes / 0.05, cycles_each)
    plastic = np.maximum(ductility - 1.0, 0.0)
    expected = 4.0 * 5.0 * 0.05 * plastic * 0.98
    assert loop_energy(record, reversal=0.02) == pytest.approx(expected, rel=2e-3, abs=1e-12)


def test_loops_of_one_and_of_three_columns():
    x = driven([0.0, 1.0, -1.0, 1.0], 10)
    assert loops(x)[0].shape == (21, 1)
    record = np.column_stack((np.arange(x.size), 2.0 * x, x))
    assert [loop.shape for loop in loops(record, column=2)] == [(21, 3)]
    assert peaks_and_valleys(record, column=-1)[0].tolist() == [[10, 2, 1], [20, -2, -1]]


def test_noise_moves_neither_tips_nor_energy():
    random = np.random.default_rng(3)
    clean = ellipse(1.0, 4.0, 1.0, 3)
    record = clean[np.repeat(np.arange(len(clean)), 5)]  # 10,000 rows a cycle
    record = record + random.normal(0.0, 1.0, record.shape) * [0.01, 0.05]
    by_extremes = record[turning_points(record), 0]
    assert np.abs(by_extremes).min() > 1.02
    tips = peaks_and_valleys(record)
    assert np.abs(np.abs(tips[:, :, 0]) - 1.0).max() < 0.004
    assert loop_energy(record) == pytest.approx([math.pi] * 3, rel=2e-3)
    assert damping(record) == pytest.approx([0.125] * 3, rel=0.01)
    true = 2500 + 5000 * np.arange(6)
    assert np.abs(reversals(record) - true).max() < 150
    swapped = np.column_stack((np.arange(len(record)), record[:, 0]))
    assert np.array_equal(reversals(swapped, column=1), reversals(record))


def test_reversals_of_a_clean_record_are_its_extremes():
    record = bilinear(driven([0.0, 1.0, -1.0, 1.0, -1.0], 17), 1.0, 0.5, 0.1)
    assert reversals(record).tolist() == turning_points(record).tolist() == [17, 34, 51]
    assert reversals([1.0, 2.0]).tolist() == []


def test_vertical_and_flat_branches():
    box = [(0, 0), (0, 1), (2, 1), (2, -1), (-2, -1), (-2, 1), (2, 1)]
    assert loop_energy(box).tolist() == [8.0]
    assert stiffness(box, kind="unloading").tolist() == [math.inf]
    flat = np.array([(0, 0), (1, 0), (-1, 0), (1, 0)], float)
    assert math.isnan(stiffness(flat, kind="unloading")[0])
    assert stiffness(flat).tolist() == [0.0]
    dashpot = [(0, 1), (1, 0), (0, -1), (-1, 0), (0, 1)]
    assert damping(dashpot).tolist() == [math.inf]


def test_wrong_arguments():
    record = ellipse(1.0, 1.0, 1.0, 2)
    with pytest.raises(ValueError, match=r"unknown kind 'tangent'; choose from secant, unl"):
        stiffness(record, kind="tangent")
    for part in ((0.5, 0.2), (-0.1, 0.5), (0.1, 1.1), (0.2, 0.2)):
        with pytest.raises(ValueError, match=r"part is \(.*\); give two fractions, 0 <= low"):
            stiffness(record, kind="unloading", part=part)
    with pytest.raises(ValueError, match=r"part is 'a'; give two fractions"):
        stiffness(record, part=("a", 0.5))
    for function in (loop_energy, stiffness, damping):
        with pytest.raises(ValueError, match=r"curve has shape \(5, 3\); give x and y, shape \(n"):
            function(np.ones((5, 3)))
    for function in (*EVERY, reversals):
        with pytest.raises(ValueError, match=r"reversal is 0; it must be between 0 and 1"):
            function(record, reversal=0)
        with pytest.raises(ValueError, match=r"column is 2; the curve has columns 0 to 1"):
            function(record, column=2)
        with pytest.raises(ValueError, match=r"curve\[1, 1\] is nan; curves must be finite"):
            function([(0, 1), (1, math.nan)])
