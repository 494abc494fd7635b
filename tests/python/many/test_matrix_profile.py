"""Matrix profiles against the reference, which computes every distance."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
from curvewise import reference
from curvewise.curves import z_normalized


def record_of(kind: str, n: int, d: int = 1, seed: int = 0) -> np.ndarray:
    random = np.random.default_rng([n, d, seed])
    if kind == "walk":
        record = random.normal(size=(n, d)).cumsum(axis=0)
    elif kind == "noise":
        record = random.normal(size=(n, d))
    elif kind == "steps":  # with constant windows, and windows that are equal
        record = random.integers(0, 3, (n // 6 + 1, d)).repeat(6, axis=0)[:n].astype(float)
    elif kind == "level":
        record = 1e9 + random.normal(size=(n, d))
    elif kind == "spike":  # the rounding of its products is larger than all other numbers
        record = 1e-7 * random.normal(size=(n, d))
        record[n // 3] = 1e5
    else:
        assert kind == "periodic"
        record = np.tile(random.normal(size=(7, d)), (n // 7 + 1, 1))[:n]
    return record


KINDS = ["walk", "noise", "steps", "level", "spike", "periodic"]


def check_equal(found: curvewise.MatrixProfile, expected: curvewise.MatrixProfile) -> None:
    np.testing.assert_array_equal(found.indices, expected.indices)
    np.testing.assert_array_equal(found.distances, expected.distances)
    assert found.indices.dtype == np.int64
    assert found.exclusion == expected.exclusion


@pytest.mark.parametrize("window", [0, 2, None])
@pytest.mark.parametrize("kind", KINDS)
def test_equal_to_the_reference(kind, window):
    for n, d, length, exclusion in ((25, 1, 6, None), (16, 2, 5, 0), (17, 3, 2, 5), (15, 7, 5, 4)):
        record = record_of(kind, n, d)
        options = {"window": window, "exclusion": exclusion}
        expected = reference.nearest.matrix_profile(record, length, **options)
        for workers in (1, 3):
            found = curvewise.matrix_profile(record, length, workers=workers, **options)
            check_equal(found, expected)
        one = curvewise.matrix_profile(record[:, 0], length, **options)
        check_equal(one, curvewise.matrix_profile(record[:, :1], length, **options))


def brute(record: np.ndarray, length: int, zone: int) -> curvewise.MatrixProfile:
    """Return the Euclidean profile, with sums over points and coordinates in their order."""
    count = len(record) - length + 1
    windows = np.array([z_normalized(record[i : i + length]) for i in range(count)])
    distances, indices = np.full(count, np.inf), np.full(count, -1)
    for i in range(count):
        points = np.square(windows - windows[i]).cumsum(axis=2)[..., -1]
        sums = points.cumsum(axis=1)[:, -1]
        sums[max(i - zone, 0) : i + zone + 1] = np.inf
        if not np.isinf(sums).all():
            indices[i] = np.argmin(sums)
            distances[i] = np.sqrt(sums[indices[i]])
    return curvewise.MatrixProfile(distances, indices, zone)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("d", "length", "zone"), [(1, 3, 1), (1, 50, 25), (2, 20, 3)])
def test_long_records_are_equal_to_all_distances(kind, d, length, zone):
    record = record_of(kind, 600, d)
    expected = brute(record, length, zone)
    found = curvewise.matrix_profile(record, length, exclusion=zone, workers=2)
    check_equal(found, expected)


@pytest.mark.parametrize("exponent", [-900, -300, 300, 900])
def test_scales_do_not_change_a_bit(exponent):
    for window in (0, 3):
        record = record_of("walk", 120, 2)
        expected = curvewise.matrix_profile(record, 16, window=window)
        found = curvewise.matrix_profile(np.ldexp(record, exponent), 16, window=window)
        check_equal(found, expected)


def test_scales_that_differ_within_a_record():
    record = record_of("walk", 90)
    record[30:60] = np.ldexp(record[30:60], -600)
    record[60:] = np.ldexp(record[60:], 300)
    check_equal(curvewise.matrix_profile(record, 8), brute(record, 8, 4))


@settings(max_examples=50, deadline=None)
@given(st.data())
def test_small_records(data):
    values = st.sampled_from([0.0, 1.0, 2.0, -1.0, 1e-9, 1e9])
    record = np.array(data.draw(st.lists(values, min_size=8, max_size=40)))
    length = data.draw(st.integers(2, 5))
    zone = data.draw(st.integers(0, len(record) - length - 1))
    found = curvewise.matrix_profile(record, length, exclusion=zone)
    check_equal(found, brute(record[:, np.newaxis], length, zone))
    starts = np.arange(len(found.indices))
    has_neighbor = found.indices >= 0
    assert (np.abs(found.indices - starts)[has_neighbor] > zone).all()
    assert np.isinf(found.distances[~has_neighbor]).all()
    pairs = found.motifs(k=100)
    distances = [max(found.distances[i], found.distances[j]) for i, j in pairs]
    assert distances == sorted(distances)
    for chosen in ([start for pair in pairs for start in pair], found.discords(k=100)):
        apart = np.abs(np.subtract.outer(chosen, chosen))
        assert (apart[~np.eye(len(chosen), dtype=bool)] > zone).all()


def test_a_fraction_is_one_of_the_length():
    record = record_of("walk", 90)
    for fraction, window in ((0.3, 3), (0.05, 0)):
        found = curvewise.matrix_profile(record, 12, window=fraction)
        check_equal(found, curvewise.matrix_profile(record, 12, window=window))


def test_memory_layouts():
    record = record_of("walk", 60, 3)
    expected = curvewise.matrix_profile(record, 10)
    for given_as in (
        np.asfortranarray(record),
        np.repeat(record, 2, axis=0)[::2],
        record[::-1][::-1],
        record.astype(">f8"),
        record.tolist(),
    ):
        check_equal(curvewise.matrix_profile(given_as, 10), expected)


def test_motifs_and_discords_are_where_they_were_put():
    random = np.random.default_rng(3)
    record = random.normal(size=1000).cumsum()
    shape = 5 * random.normal(size=40)
    for at, scale in ((200, 1.0), (700, 7.0)):
        record[at : at + 40] = scale * shape + record[at] + 0.01 * random.normal(size=40)
    wave = np.sin(np.arange(600) * (2 * np.pi / 50)) + 0.01 * random.normal(size=600)
    wave[300:310] += 1.5
    for window in (0, 4):
        profile = curvewise.matrix_profile(record, 40, window=window)
        assert profile.motifs() == [(200, 700)]
        (odd,) = curvewise.matrix_profile(wave, 50, window=window).discords()
        assert 250 < odd < 310


def test_later_motifs_and_discords_keep_their_distance():
    distances = np.array([3.0, 1.0, 1.0, 2.0, 5.0, 1.0, 2.0, np.inf])
    indices = np.array([4, 5, 6, 6, 0, 1, 3, -1])
    profile = curvewise.MatrixProfile(distances, indices, 0)
    assert profile.motifs(10) == [(1, 5), (2, 6), (0, 4)]
    assert profile.discords(3) == [4, 0, 3]
    wide = curvewise.MatrixProfile(distances, indices, 1)
    assert wide.motifs(10) == [(1, 5)]
    assert wide.discords(10) == [4, 0, 6, 2]


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((np.arange(9.0), 1), {}, r"length is 1; give a whole number >= 2"),
        ((np.arange(9.0), 2.5), {}, r"length is 2.5; give a whole number >= 2"),
        (
            (np.arange(9.0), 3),
            {"window": -1},
            r"window is -1; give a whole number >= 0, a fraction",
        ),
        ((np.arange(9.0), 3), {"exclusion": -1}, r"exclusion is -1; give a whole number >= 0"),
        (
            (np.arange(9.0), 6),
            {},
            r"record has shape \(9, 1\); length 6 and exclusion 3 need at least 10 points",
        ),
        ((np.zeros((9, 0)), 3), {}, r"record has shape \(9, 0\)"),
        (([0, 1, np.nan, 3, 4, 5], 2), {}, r"record\[2\] is nan; curves must be finite"),
        ((np.array([[0, 1.0], [np.inf, 0]] * 4), 2), {}, r"record\[1, 0\] is inf"),
        ((np.arange(9.0), 3), {"workers": 0}, r"workers is 0"),
    ],
)
def test_errors(arguments, options, message):
    with pytest.raises(ValueError, match=message):
        curvewise.matrix_profile(*arguments, **options)


def test_errors_of_k_and_of_types():
    profile = curvewise.matrix_profile(np.arange(20.0), 4)
    for choose in (profile.motifs, profile.discords):
        with pytest.raises(ValueError, match="k is 0; give a whole number >= 1"):
            choose(0)
    with pytest.raises(TypeError, match="record"):
        curvewise.matrix_profile(["a", "b"], 4)
