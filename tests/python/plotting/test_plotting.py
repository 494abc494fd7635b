"""The pictures show what the numbers were computed from, and can be read.

Most tests recompute a measure's value from the artists alone: a picture that showed something
else than the number could not pass them.
"""

from __future__ import annotations

import io
import time

import numpy as np
import pytest
from drawn_curves import (
    SERIES_P,
    SERIES_Q,
    SPACE_P,
    SPACE_Q,
    P,
    Q,
    areas,
    in_box,
    loop,
    polygons,
    segments,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import curvewise
from curvewise import plotting

BOTH_MEASURES = pytest.mark.parametrize("measure", ["dtw", "frechet"])
PICTURES = {
    "area": plotting.plot_area,
    "pcm": plotting.plot_pcm,
    "dtw": plotting.plot_alignment,
    "frechet": lambda *args: plotting.plot_alignment(*args, measure="frechet"),
    "curve_length": plotting.plot_curve_length,
    "frechet_continuous": plotting.plot_matching,
}
EVERY_PICTURE = pytest.mark.parametrize("picture", PICTURES.values(), ids=PICTURES.keys())


@pytest.fixture
def ax() -> Axes:
    return Figure().subplots()


# --- What all pictures of curves have in common


@EVERY_PICTURE
def test_both_curves_are_drawn_labelled_and_alike(picture, ax):
    artists = picture(P, Q, ax)
    np.testing.assert_array_equal(artists.P.get_xydata(), P)
    np.testing.assert_array_equal(artists.Q.get_xydata(), Q)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x", "y")
    assert ax.get_legend_handles_labels()[1][:2] == ["P", "Q"]
    assert (artists.P.get_color(), artists.Q.get_color()) == ("#0072B2", "#D55E00")
    assert artists.P.get_linewidth() == artists.Q.get_linewidth()
    drawn = [*ax.lines, *ax.collections]
    assert len(drawn) == len([artist for artist in artists if artist is not None])
    assert all(artist in drawn for artist in artists if artist is not None)


@EVERY_PICTURE
def test_labels_that_are_there_stay(picture, ax):
    ax.set(xlabel="strain", ylabel="stress [MPa]")
    picture(P, Q, ax)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("strain", "stress [MPa]")


@EVERY_PICTURE
def test_lists_are_taken_and_inputs_left_alone(picture, ax):
    first, second = P.copy(), Q.copy()
    first.flags.writeable = second.flags.writeable = False
    from_arrays = picture(first, second, ax)
    from_lists = picture(P.tolist(), Q.tolist(), Figure().subplots())
    paths = (artists.between.get_paths() for artists in (from_arrays, from_lists))
    for one, other in zip(*paths, strict=True):
        np.testing.assert_array_equal(one.vertices, other.vertices)


@EVERY_PICTURE
def test_bad_curves_are_refused_before_anything_is_drawn(picture, ax):
    broken = Q.copy()
    broken[17, 1] = np.nan
    with pytest.raises(ValueError, match=r"Q\[17, 1\] is nan; curves must be finite"):
        picture(P, broken, ax)
    with pytest.raises(ValueError, match=r"\(60, 2\).*\(41, 3\)"):
        picture(P, SPACE_Q, ax)
    assert not ax.lines
    assert not ax.collections


@EVERY_PICTURE
def test_twenty_thousand_points_are_few_artists_drawn_quickly(picture, ax):
    angle = np.linspace(0, 40, 20_000)
    big = np.column_stack([np.sin(angle), np.sin(angle + 0.5)])
    if picture in (PICTURES["dtw"], PICTURES["frechet"]):
        big = big[::5]  # quadratic: as many points as take a moment
    artists = picture(big, 1.1 * big + 0.05, ax)
    assert len(ax.lines) + len(ax.collections) <= 4
    if picture is not plotting.plot_area:
        assert len(segments(artists)) == 80
    start = time.perf_counter()
    ax.figure.savefig(io.BytesIO())
    assert time.perf_counter() - start < 10


# --- Area


@pytest.mark.parametrize("crossing", ["rearrange", "split"])
@pytest.mark.parametrize("spacing", ["distance", "x", "arc_length", "matched"])
def test_polygons_are_the_quadrilaterals(spacing, crossing, ax):
    options = {"spacing": spacing, "crossing": crossing}
    artists = plotting.plot_area(P, Q, ax, **options)
    np.testing.assert_array_equal(polygons(artists), curvewise.area_quads(P, Q, **options).quads)


def test_normalized_polygons_have_the_area_of_the_scaled_curves(ax):
    quads = polygons(plotting.plot_area(P, Q, ax, normalized=True))
    expected = curvewise.area(*curvewise.normalize(P, Q))
    assert areas(in_box(quads)).sum() == pytest.approx(expected, rel=1e-12)
    raw = polygons(plotting.plot_area(P, Q, ax))
    assert not np.allclose(quads, raw)  # stress dominates the lengths that place the cuts


# --- Alignments


@BOTH_MEASURES
@pytest.mark.parametrize("normalized", [False, True])
def test_segments_are_the_path(measure, normalized, ax):
    measured = curvewise.normalize(P, Q) if normalized else (P, Q)
    path = getattr(curvewise, f"{measure}_path")(*measured).path
    options = {"measure": measure, "normalized": normalized}
    artists = plotting.plot_alignment(P, Q, ax, every=1, **options)
    expected = np.stack([P[path[:, 0]], Q[path[:, 1]]], axis=1)
    np.testing.assert_array_equal(segments(artists), expected)
    seventh = plotting.plot_alignment(P, Q, ax, every=7, **options)
    np.testing.assert_array_equal(segments(seventh), expected[::7])


def test_a_long_path_is_thinned_evenly_between_its_ends(ax):
    path = curvewise.dtw_path(SPACE_P[:, :2], loop(300)).path
    drawn = segments(plotting.plot_alignment(P, loop(300), ax))
    assert len(drawn) == 80
    expected = np.stack([P[path[:, 0]], loop(300)[path[:, 1]]], axis=1)
    np.testing.assert_array_equal(drawn[[0, -1]], expected[[0, -1]])
    places = [np.flatnonzero((expected == link).all(axis=(1, 2)))[0] for link in drawn]
    assert set(np.diff(places)) <= {len(path) // 79, len(path) // 79 + 1}


@pytest.mark.parametrize(
    "options",
    [
        {"step_pattern": "symmetric2"},
        {"window": 20},
        {"open_begin": True, "open_end": True},
        {"metric": "minkowski", "p": 3},
    ],
)
def test_dtw_options_reach_the_path(options, ax):
    P, Q = np.random.default_rng(3).normal(size=(2, 40, 2))
    path = curvewise.dtw_path(P, Q[:30], **options).path
    artists = plotting.plot_alignment(P, Q[:30], ax, every=1, **options)
    expected = np.stack([P[path[:, 0]], Q[path[:, 1]]], axis=1)
    np.testing.assert_array_equal(segments(artists), expected)


@pytest.mark.parametrize(
    ("options", "order"),
    [
        ({}, 2),
        ({"metric": "cityblock"}, 1),
        ({"metric": "chebyshev"}, np.inf),
        ({"metric": "minkowski", "p": 4}, 4),
        ({"metric": "minkowski", "p": np.inf}, np.inf),
        ({"metric": "minkowski"}, 2),
    ],
)
def test_the_frechet_accent_is_as_long_as_the_distance(options, order, ax):
    for seed in range(20):
        P, Q = np.random.default_rng(seed).normal(size=(2, 12, 2))
        artists = plotting.plot_alignment(P, Q, ax, measure="frechet", every=1, **options)
        pair = artists.accent.get_xydata()
        assert (segments(artists) == pair).all(axis=(1, 2)).any()
        distance = curvewise.frechet(P, Q, **options)
        assert np.linalg.norm(pair[0] - pair[1], order) == pytest.approx(distance, rel=1e-12)


def test_the_normalized_frechet_accent_has_the_scaled_distance(ax):
    artists = plotting.plot_alignment(P, Q, ax, measure="frechet", normalized=True)
    pair = in_box(artists.accent.get_xydata())
    expected = curvewise.frechet(*curvewise.normalize(P, Q))
    assert np.linalg.norm(pair[0] - pair[1]) == pytest.approx(expected, rel=1e-12)
    assert plotting.plot_alignment(P, Q, ax).accent is None


@BOTH_MEASURES
@pytest.mark.parametrize("shape", [(-1,), (-1, 1)])
def test_series_are_drawn_apart_against_the_index(measure, shape, ax):
    first, second = SERIES_P.reshape(shape), SERIES_Q.reshape(shape)
    artists = plotting.plot_alignment(first, second, ax, measure=measure, every=1)
    p, q = artists.P.get_xydata(), artists.Q.get_xydata()
    np.testing.assert_array_equal(p, np.column_stack([np.arange(50), SERIES_P]))
    np.testing.assert_array_equal(q[:, 0], np.arange(40))
    shift = SERIES_Q - q[:, 1]
    assert np.ptp(shift) < 1e-12
    assert q[:, 1].max() < p[:, 1].min() - 0.2 * np.ptp(SERIES_P)
    assert artists.Q.get_label() == f"Q − {shift[0]:g}"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("index", f"value (Q − {shift[0]:g})")
    path = getattr(curvewise, f"{measure}_path")(SERIES_P, SERIES_Q).path
    expected = np.stack([p[path[:, 0]], q[path[:, 1]]], axis=1)
    np.testing.assert_array_equal(segments(artists), expected)


@pytest.mark.parametrize("value", [0.0, 1e-9, -7.0, 1e9])
def test_constant_and_single_point_series(value, ax):
    artists = plotting.plot_alignment([value] * 3, [value], ax, measure="frechet")
    assert artists.Q.get_ydata()[0] < value
    assert len(segments(artists)) == 3


def test_alignment_refuses_what_it_cannot_draw(ax):
    with pytest.raises(ValueError, match=r"P has shape \(60, 3\).*plot_table"):
        plotting.plot_alignment(SPACE_P, SPACE_Q, ax)
    for every in (0, -1, 2.5):
        with pytest.raises(ValueError, match=f"every is {every}; give a whole number >= 1"):
            plotting.plot_alignment(P, Q, ax, every=every)
    for plot in (plotting.plot_alignment, plotting.plot_table):
        with pytest.raises(ValueError, match="unknown measure 'area'; choose from dtw, edr"):
            plot(P, Q, ax, measure="area")
        with pytest.raises(ValueError, match="unknown step_pattern 'x'"):
            plot(P, Q, ax, step_pattern="x")
    assert not ax.lines


# --- Partial curve mapping and curve length


@pytest.mark.parametrize("offsets", [1, 7, 200, "continuous"])
@pytest.mark.parametrize("first_is_shorter", [True, False])
def test_pcm_lines_give_the_value(first_is_shorter, offsets, ax):
    part, whole = loop(30, end=1.4), loop(70, stretch=1.1)
    pair = (part, whole) if first_is_shorter else (whole, part)
    artists = plotting.plot_pcm(*pair, ax, offsets=offsets)
    links = in_box(segments(artists), pair[0])
    np.testing.assert_array_equal(segments(artists)[:, 0], part)
    distance = np.linalg.norm(links[:, 0] - links[:, 1], axis=1)
    edges = np.linalg.norm(np.diff(links[:, 0], axis=0), axis=1)
    value = ((distance[1:] + distance[:-1]) / 2 * edges).sum()
    assert value == pytest.approx(curvewise.pcm(*pair, offsets=offsets), rel=1e-9)

    stretch = in_box(artists.accent.get_xydata(), pair[0])
    length = np.linalg.norm(np.diff(stretch, axis=0), axis=1).sum()
    assert length == pytest.approx(edges.sum(), rel=1e-9)
    np.testing.assert_array_equal(stretch[[0, -1]], links[[0, -1], 1])
    assert artists.accent.get_label() == f"stretch of {'QP'[not first_is_shorter]} in use"


@pytest.mark.parametrize("scale", ["mean", "mean_abs", "range"])
@pytest.mark.parametrize("normalized", [False, True])
def test_curve_length_lines_give_the_residuals(scale, normalized, ax):
    artists = plotting.plot_curve_length(P, Q, ax, scale=scale, normalized=normalized)
    measured = curvewise.normalize(P, Q) if normalized else [P, Q]
    links = in_box(segments(artists)) if normalized else segments(artists)
    weight = {"mean": np.mean, "mean_abs": lambda c, axis: np.mean(abs(c), axis), "range": np.ptp}
    residuals = np.log1p(np.abs((links[:, 1] - links[:, 0]) / weight[scale](measured[0], axis=0)))
    expected = curvewise.curve_length_residuals(*measured, scale=scale)
    np.testing.assert_allclose(residuals, expected, rtol=1e-9, atol=1e-12)


def test_curve_length_has_no_picture_where_it_has_no_value(ax):
    centred = [[-1.0, 0.0], [1.0, 2.0]]
    with pytest.raises(ValueError, match="scale='mean_abs'"):
        plotting.plot_curve_length(centred, Q, ax)
    assert len(segments(plotting.plot_curve_length(centred, Q, ax, scale="range"))) == 2


# --- Tables


@BOTH_MEASURES
@pytest.mark.parametrize("curves", [(P, Q), (SPACE_P, SPACE_Q), (SERIES_P, SERIES_Q)])
def test_the_image_is_the_table_and_the_line_the_path(measure, curves, ax):
    image, line = plotting.plot_table(*curves, ax, measure=measure)
    table = getattr(curvewise, f"{measure}_table")(*curves)
    np.testing.assert_array_equal(image.get_array(), table)
    path = getattr(curvewise, f"{measure}_path")(*curves).path
    np.testing.assert_array_equal(line.get_xydata(), path[:, ::-1])
    n, m = table.shape
    assert image.get_extent() == pytest.approx([-0.5, m - 0.5, -0.5, n - 0.5])
    assert image.origin == "lower"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("index in Q", "index in P")


def test_cells_outside_the_window_are_blank(ax):
    image, _ = plotting.plot_table(P, Q, ax, window=20, normalized=True)
    table = curvewise.dtw_table(*curvewise.normalize(P, Q), window=20)
    assert np.isinf(table).any()
    np.testing.assert_array_equal(np.ma.getmaskarray(image.get_array()), np.isinf(table))
    assert image.cmap.get_bad()[3] == 0


def test_a_large_table_is_thinned_in_place(ax):
    series = np.sin(np.linspace(0, 9, 2500))
    image, _ = plotting.plot_table(series, series[:1200], ax)
    shown = image.get_array()
    left, right, bottom, top = image.get_extent()
    x = left + (np.arange(shown.shape[1]) + 0.5) * (right - left) / shown.shape[1]
    y = bottom + (np.arange(shown.shape[0]) + 0.5) * (top - bottom) / shown.shape[0]
    assert max(shown.shape) <= 1000
    table = curvewise.dtw_table(series, series[:1200])
    rows, columns = np.rint(y).astype(int), np.rint(x).astype(int)
    np.testing.assert_allclose(y, rows, atol=1e-9)
    np.testing.assert_allclose(x, columns, atol=1e-9)
    np.testing.assert_array_equal(shown, table[np.ix_(rows, columns)])
    assert (ax.get_xlim(), ax.get_ylim()) == ((-0.5, 1199.5), (-0.5, 2499.5))


# --- Matchings along both curves, and films


def test_a_matching_is_drawn_along_both_curves(ax) -> None:
    t = np.linspace(0, 6, 30)
    P, Q = np.column_stack([t, np.sin(t)]), np.column_stack([t[::3], np.sin(t[::3]) + 0.2])
    artists = plotting.plot_matching(P, Q, ax)
    links = np.array(artists.between.get_segments())
    assert links.shape == (80, 2, 2)
    np.testing.assert_array_equal(links[0], [P[0], Q[0]])
    np.testing.assert_array_equal(links[-1], [P[-1], Q[-1]])
    lengths = np.linalg.norm(links[:, 0] - links[:, 1], axis=1)
    value = curvewise.frechet_continuous(P, Q)
    assert lengths.max() <= value * (1 + 1e-12)
    assert np.linalg.norm(np.diff(artists.accent.get_xydata(), axis=0)) == pytest.approx(value)
    with pytest.raises(ValueError, match=r"plot_matching draws 1 or 2 coordinates"):
        plotting.plot_matching(np.zeros((3, 3)), np.zeros((3, 3)), ax)


def test_the_farthest_points_of_lines_are_drawn(ax) -> None:
    square = [(0, 0), (10, 0), (10, 6), (0, 6), (0, 0)]
    other = [(0, 0), (0, 6), (10, 6), (10, 0)]
    artists = plotting.plot_farthest_of_lines(square, other, ax)
    links = np.array(artists.between.get_segments())
    found = curvewise.hausdorff_continuous_points(square, other)
    np.testing.assert_array_equal(links, found.points)
    np.testing.assert_array_equal(artists.accent.get_xydata(), found.points[0])
    assert artists.accent.get_label() == "Hausdorff distance"
    directed = plotting.plot_farthest_of_lines(other, square, ax, directed=True)
    assert len(directed.between.get_segments()) == 1
    with pytest.raises(ValueError, match=r"plot_farthest_of_lines draws 1 or 2 coordinates"):
        plotting.plot_farthest_of_lines(np.zeros((3, 3)), np.zeros((3, 3)), ax)


def test_free_space_is_where_a_leash_reaches(ax) -> None:
    P, Q = [(0, 0), (10, 0)], [(0, 0), (7, 0), (3, 0), (10, 0)]
    image, path = plotting.plot_free_space(P, Q, ax)
    free = np.asarray(image.get_array())
    assert image.get_extent() == [0, 3, 0, 1]
    # Across from the first vertex of Q, 2 of the 10 are in reach.
    assert free[:, 0].mean() == pytest.approx(0.2, abs=0.01)
    for y, x in np.clip(path.get_xydata()[:, ::-1], 0, [0.999, 2.999]):
        assert free[max(0, int(y * 600) - 1) : int(y * 600) + 2, int(x * 200)].any()
    image, path = plotting.plot_free_space(P, Q, ax, distance=1.9)
    assert path is None
    assert np.asarray(image.get_array()).mean() < free.mean()


def test_a_warping_is_animated(tmp_path):
    image = pytest.importorskip("PIL.Image", reason="matplotlib brings Pillow")
    file = tmp_path / "warping.gif"
    t = np.linspace(0, 6, 30)
    plotting.animate_alignment(np.sin(t), np.sin(t[::2]), file, frames=3, seconds=1)
    with image.open(file) as picture:
        assert picture.n_frames == 3
        assert picture.info["duration"] == 330
    with pytest.raises(ValueError, match="frames is 1; give a whole number >= 2"):
        plotting.animate_alignment(t, t, file, frames=1)
    with pytest.raises(ValueError, match="animate_alignment draws 1 or 2 coordinates"):
        plotting.animate_alignment(np.ones((3, 3)), np.ones((3, 3)), file)
