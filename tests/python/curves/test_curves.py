"""Branches, other points, smoothing, trimming and conversion of curves."""

from __future__ import annotations

import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import curves

TEST, SIMULATION = curvewise.datasets.hysteresis_pair()


def zigzag(ends: list[float], steps: int, noise: float = 0.0) -> np.ndarray:
    """Straight branches between `ends`, of `steps` steps each, with noise between the ends."""
    x = np.interp(np.arange(steps * (len(ends) - 1) + 1) / steps, np.arange(len(ends)), ends)
    inner = np.arange(x.size) % steps != 0
    return x + noise * inner * np.random.default_rng(1).uniform(-1, 1, x.size)


def test_turning_points_of_a_loop() -> None:
    assert curves.turning_points(SIMULATION).tolist() == [30, 90]
    assert curves.turning_points(SIMULATION[::-1]).tolist() == [60, 120]
    turns = curves.turning_points(TEST)
    assert turns.tolist() == [60, 150]
    assert curves.turning_points(SIMULATION, column=1).tolist() == [30, 90]
    assert curves.turning_points(-SIMULATION).tolist() == [30, 90]


@pytest.mark.parametrize("magnitude", [1e-300, 1.0, 1e308])
def test_noise_and_a_toe_are_no_turns(magnitude: float) -> None:
    x = zigzag([0, 1, -1, 1, 0.2], 50, noise=0.04)
    x = np.concatenate(([0.0, -0.03, 0.02], x)) * magnitude
    turns = curves.turning_points(x)
    np.testing.assert_allclose(turns, [53, 103, 153], atol=2)  # the noise's own extreme
    assert curves.turning_points(x, reversal=0.45).tolist() == turns[:2].tolist()


def test_curves_without_turns() -> None:
    assert curves.turning_points([1.0]).tolist() == []
    assert curves.turning_points([1, 1, 1]).tolist() == []
    assert curves.turning_points([0, 1, 2, 2, 3]).tolist() == []
    assert curves.turning_points([0, 1, 1, 1, 0]).tolist() == [1]
    assert curves.turning_points([0, 1, 1, 1, 0]).dtype == np.int64


@settings(deadline=None)
@given(st.lists(st.integers(-20, 20), min_size=2, max_size=40), st.floats(0.05, 0.9))
def test_branches_are_reversals_that_count(x: list[int], reversal: float) -> None:
    turns = curves.turning_points(x, reversal=reversal).tolist()
    least = reversal * (max(x) - min(x))
    values = [x[i] for i in turns]
    steps = np.diff(values)
    assert (np.abs(steps) > least - 1e-9).all()
    assert (steps[1:] * steps[:-1] < 0).all()
    for a, b in pairwise(turns):
        assert x[a] in (min(x[a : b + 1]), max(x[a : b + 1]))
        assert x[b] in (min(x[a : b + 1]), max(x[a : b + 1]))


@pytest.mark.parametrize(
    ("turns", "cycle"),
    [
        ([0, 2, -2, 2], (2, 2)),  # it stops at the end of a branch
        ([0, 2, -2, 2, -2, 1], (-2, -2)),  # the last branch is cut short: the cycle before
        ([0, 2, -2, 1.7], (2, 1.7)),  # a tenth of the range may be missing
        ([0, 1, -1, 2, -2, 3], (2, 3)),  # growing
        ([0, -2, 2, -2], (-2, -2)),
    ],
)
def test_last_complete_cycle(turns: list[float], cycle: tuple[float, float]) -> None:
    strain = zigzag(turns, 10)
    found = strain[curves.last_cycle(strain)]
    assert (found[0], found[-1]) == cycle
    assert len(found) == 21
    loop = np.column_stack((np.arange(len(strain)), strain))
    assert curves.last_cycle(loop, column=1) == curves.last_cycle(strain)


@pytest.mark.parametrize(
    ("turns", "message"),
    [
        ([0, 2], "it reverses 0 times, and"),
        ([0, 2, -2], "it reverses 1 time, and"),
        (
            [0, 2, -2, 1],
            "it reverses 2 times, and after two reversals it never returns to the first",
        ),
    ],
)
def test_a_curve_without_a_complete_cycle(turns: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=f"a complete cycle: {message}"):
        curves.last_cycle(zigzag(turns, 10))


def test_resampled_branches_keep_their_ends() -> None:
    turns = curves.turning_points(TEST)
    result = curves.resample(TEST, [11, 21, 31], turns=turns)
    assert result.shape == (61, 2)
    assert (result[[0, 10, 30, 60]] == TEST[[0, *turns, -1]]).all()
    for at in (slice(0, 11), slice(10, 31)):
        lengths = np.hypot(*(np.diff(result[at], axis=0) / np.ptp(TEST, axis=0)).T)
        assert lengths.max() < 1.2 * lengths.mean()
    # All new points lie on the curve, so the continuous distance is that of the cut-off corners.
    scaled = curvewise.normalize(TEST, result)
    assert curvewise.frechet_continuous(*scaled) < 0.04
    assert curves.resample(TEST, 5, turns=turns).shape == (13, 2)


def test_resampling_by_a_column_and_by_time() -> None:
    turns = curves.turning_points(SIMULATION)
    by_strain = curves.resample(SIMULATION, [31, 61, 61], by=0, turns=turns)
    np.testing.assert_allclose(by_strain, SIMULATION, rtol=1e-12, atol=1e-9)
    time = np.array([0.0, 1.0, 3.0, 10.0])
    result = curves.resample([0.0, 10.0, 30.0, 100.0], 6, by=time)
    np.testing.assert_allclose(result, [[0], [20], [40], [60], [80], [100]], rtol=1e-14)
    falling = curves.resample([[3, 0], [1, 2], [0, 5]], 4, by=-2)
    np.testing.assert_allclose(falling, [[3, 0], [2, 1], [1, 2], [0, 5]], rtol=1e-14)


def test_equal_curves_sampled_otherwise_become_equal() -> None:
    strain = zigzag([0, 0.02, -0.02, 0.02], 400)
    loop = np.column_stack((strain, curvewise.datasets.kinematic_hardening(strain)))
    thinned = np.delete(loop, [i for i in range(1200) if i % 400 and i % 5], axis=0)
    P, Q = (curves.resample(c, 100, by=0, turns=curves.turning_points(c)) for c in (loop, thinned))
    # The difference is the corner that thinning cuts off at the knee.
    assert np.abs(P - Q).max(axis=0) == pytest.approx([0, 0], abs=3.0)
    assert curvewise.mae(P, Q) < 0.1


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"count": 1}, ValueError, "count is 1; a branch needs at least 2"),
        ({"count": 2.5}, TypeError, "count is 2.5; give a whole number"),
        ({"count": [3, 3]}, ValueError, r"count has shape \(2,\); there are 1 branches"),
        ({"count": 5, "by": 0}, ValueError, "reverse in branch 0, by 1 before point 2;"),
        ({"count": 5, "by": 2}, ValueError, "column is 2; the curve has columns 0 to 1"),
        ({"count": 5, "by": "time"}, ValueError, "unknown by 'time'"),
        ({"count": 5, "by": [1, 2]}, ValueError, r"by has shape \(2,\); give one value for each"),
        ({"count": 5, "by": [1, 2, np.nan]}, ValueError, r"by\[2\] is not finite"),
        ({"count": 5, "by": [1, 1, 1]}, ValueError, "constant in branch 0"),
        ({"count": 5, "turns": [0]}, ValueError, "they must ascend, from 1 to 1"),
        ({"count": 5, "turns": [1.0]}, TypeError, "turns must be whole numbers"),
    ],
)
def test_errors_of_resample(arguments, error, message) -> None:
    with pytest.raises(error, match=message):
        curves.resample([[0, 0], [2, 1], [1, 2]], **arguments)


def test_trim_of_a_loop() -> None:
    loading = curves.trim(SIMULATION, 0.0, 0.01)
    np.testing.assert_allclose(loading, SIMULATION[:16], rtol=1e-12, atol=1e-12)
    back = curves.trim(SIMULATION, 0.02, -0.02)
    np.testing.assert_allclose(back, SIMULATION[30:91], rtol=1e-9, atol=1e-12)
    assert (curves.trim(SIMULATION) == SIMULATION).all()
    by_time = curves.trim([5.0, 7.0, 9.0], 0.5, 1.5, by=[0, 1, 2])
    assert by_time.tolist() == [[6.0], [7.0], [8.0]]


def test_trim_within_a_segment_and_at_a_point() -> None:
    line = [[0.0, 0.0], [10.0, 1.0], [0.0, 2.0]]
    np.testing.assert_allclose(curves.trim(line, 2.0, 4.0), [[2, 0.2], [4, 0.4]], rtol=1e-14)
    assert curves.trim(line, 10.0, 10.0).tolist() == [[10.0, 1.0]]
    np.testing.assert_allclose(curves.trim(line, 6.0, 5.0), [[6, 0.6], [10, 1], [5, 1.5]])
    with pytest.raises(ValueError, match=r"start is 11, which is never reached; .* 0 to 10"):
        curves.trim(line, 11)
    with pytest.raises(ValueError, match="stop is -1, which is never reached"):
        curves.trim(line, 0, -1)


def test_smoothing_takes_noise_off_and_keeps_turns() -> None:
    strain = zigzag([0, 0.02, -0.02, 0.02], 100)
    clean = np.column_stack((strain, curvewise.datasets.kinematic_hardening(strain)))
    noisy = clean.copy()
    noisy[:, 1] += np.random.default_rng(3).normal(0, 4, len(noisy))
    turns = curves.turning_points(noisy)
    assert turns.tolist() == [100, 200]
    smoothed = curves.smooth(noisy, 15, turns=turns)
    error = np.abs(smoothed - clean)[:, 1]
    assert error[80:101].mean() < 0.6 * np.abs(noisy - clean)[80:101, 1].mean()
    across = np.abs(curves.smooth(noisy, 15) - clean)[:, 1]
    assert across[[100, 200]].min() > 5 * error[[100, 200]].max()
    assert (curves.smooth(noisy, 15, columns=[1], turns=turns)[:, 0] == strain).all()


def test_smoothing_asks_about_longitudes_that_jump() -> None:
    track = np.array([(179.0, 0.0), (-179.0, 0.0), (-178.0, 0.0)])
    with pytest.warns(UserWarning, match="jumps by 358 between points 0 and 1; unwrap it first"):
        curves.smooth(track, 3, order=1)
    track[:, 0] = np.unwrap(track[:, 0], period=360)
    np.testing.assert_allclose(curves.smooth(track, 3, order=1), track, atol=0.5)


def test_a_polynomial_passes_the_filter() -> None:
    x = np.linspace(0, 1, 40)
    parabola = np.column_stack((x, 3 * x**2 - x))
    for window in (7, 0.2, 0.99):
        np.testing.assert_allclose(curves.smooth(parabola, window), parabola, atol=1e-12)
    assert curves.smooth(x).shape == (40, 1)


@pytest.mark.parametrize(
    ("window", "order", "message"),
    [
        (4, 2, "window is 4; give an odd number above order=2"),
        (1, 2, "window is 1; give an odd number"),
        (1.5, 0, "window is 1.5; give an odd number"),
        (13, 2, "window is 13; branch 0 has only 11 points"),
        (0.2, 3, "branch 0 has 11 points, of which window=0.2 leaves 3; order=3 needs more"),
        (5, -1, "order is -1"),
    ],
)
def test_errors_of_smooth(window, order, message) -> None:
    with pytest.raises(ValueError, match=message):
        curves.smooth(np.arange(21.0), window, order=order, turns=[10])


def test_smooth_without_scipy_says_how_to_get_it() -> None:
    code = (
        "import sys; sys.modules['scipy'] = None\n"
        "from curvewise import curves\n"
        "loop = [[0, 0], [2, 1], [1, 2]]\n"
        "assert curves.trim(curves.resample(loop, 9, turns=curves.turning_points(loop)), 1).any()\n"
        "try: curves.smooth(loop)\n"
        "except ImportError as error: print(error)\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == ('curvewise.curves.smooth needs scipy: pip install "curvewise[curves]"\n')


def test_true_stress_and_strain() -> None:
    engineering = np.array([[0.0, 0.0], [0.25, 400.0], [-0.2, -300.0]])
    expected = [[0.0, 0.0], [np.log(1.25), 500.0], [np.log(0.8), -240.0]]
    np.testing.assert_allclose(curves.engineering_to_true(engineering), expected, rtol=1e-14)
    with pytest.raises(ValueError, match=r"curve\[1, 0\] is -12.0; an engineering strain"):
        curves.engineering_to_true([[0, 0], [-12.0, -300]])
    with pytest.raises(ValueError, match=r"curve has shape \(2, 3\); give strain and stress"):
        curves.engineering_to_true(np.ones((2, 3)))


def test_shift_to_the_origin() -> None:
    assert curves.shift_to_origin([[1, 5], [2, 7]]).tolist() == [[0, 0], [1, 2]]
    stress = np.linspace(0, 500, 51)
    strain = 0.003 + stress / 200e3 + 1e-3 * (1 - np.exp(-stress / 10))
    shifted = curves.shift_to_origin(np.column_stack((strain, stress)), elastic=(200, 400))
    np.testing.assert_allclose(shifted[20:, 0], stress[20:] / 200e3, atol=1e-9)
    assert (shifted[:, 1] == stress).all()
    # The unloading line of a loop is not the first loading.
    toe = curves.shift_to_origin(SIMULATION + np.array([0.001, 0]), elastic=(0, 290))
    np.testing.assert_allclose(toe, SIMULATION, atol=1e-12)


@pytest.mark.parametrize(
    ("elastic", "message"),
    [
        ((200, 100), r"elastic is \(200, 100\); give two stresses"),
        ((0.5, 1), "only 0 points of the first loading"),
        ((-900, 0), "only 1 points"),
    ],
)
def test_errors_of_a_toe(elastic, message) -> None:
    with pytest.raises(ValueError, match=message):
        curves.shift_to_origin(SIMULATION, elastic=elastic)
    with pytest.raises(ValueError, match="do not rise with the strain"):
        curves.shift_to_origin([[3, 1], [2, 2], [1, 3]], elastic=(0, 4))


@pytest.mark.parametrize("name", ["turning_points", "smooth", "trim", "shift_to_origin"])
def test_bad_curves_are_refused(name: str) -> None:
    function = getattr(curves, name)
    with pytest.raises(ValueError, match=r"curve\[1, 0\] is nan; curves must be finite"):
        function([[0.0, 0.0], [np.nan, 1.0]])
    with pytest.raises(ValueError, match=r"curve has shape \(0, 2\); at least"):
        function(np.empty((0, 2)))
    with pytest.raises(TypeError, match="curve is complex"):
        function([1j, 2])


def test_inputs_are_not_changed() -> None:
    before = TEST.copy()
    turns = curves.turning_points(TEST)
    curves.smooth(TEST, turns=turns)
    curves.resample(TEST, 9, turns=turns)[:] = 0
    curves.trim(TEST)[:] = 0
    curves.shift_to_origin(TEST)[:] = 0
    assert (before == TEST).all()


def test_the_toe_is_cut_where_that_is_wanted() -> None:
    test = np.array([[0, 0], [0.001, 100], [0.00125, 150], [0.0015, 200], [0.002, 210]])
    whole = curves.shift_to_origin(test, elastic=(100, 200))
    cut = curves.shift_to_origin(test, elastic=(100, 200), cut=True)
    np.testing.assert_array_equal(cut, whole[1:])
    with pytest.raises(ValueError, match=r"cut is True; give the straight part too: elastic="):
        curves.shift_to_origin(test, cut=True)
