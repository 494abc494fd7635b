"""What the columns are called: kept where it is known, dropped where it would be wrong, drawn."""

from __future__ import annotations

import pickle

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

import curvewise
from curvewise import curves, plotting
from curvewise.calibration import identify, identify_each
from curvewise.commands import command_line as cli
from curvewise.curves.named_curve import NamedCurve, axis_names

NAMES = ("strain", "stress")
P, Q = (NamedCurve(np.asarray(curve), NAMES) for curve in curvewise.datasets.hysteresis_pair())


def labels(ax):
    return ax.get_xlabel(), ax.get_ylabel()


def test_names_stay_with_rows_and_copies_and_nothing_else():
    for kept in (P[::2], P[P[:, 0] > 0], P[np.array([3, 1])], P[...], P.copy()):
        assert kept.column_names == NAMES
        assert isinstance(kept, np.ndarray)
    for dropped in (
        P[:, ::-1],
        P[:, [1, 0]],
        P.T,
        2 * P,
        P + P,
        np.diff(P, axis=0),
        P.take([1, 0], 1),
    ):
        assert not getattr(dropped, "column_names", ())
    assert pickle.loads(pickle.dumps(P)).column_names == NAMES
    assert np.array_equal(pickle.loads(pickle.dumps(P.T)), P.T)
    with pytest.raises(ValueError, match=r"there are 2 names for an array of shape \(3,\)"):
        NamedCurve(np.zeros(3), NAMES)


def test_a_named_curve_calculates_and_prints_as_an_array():
    plain = np.asarray(P)
    assert type(plain) is np.ndarray
    assert repr(P) == repr(plain)
    assert str(P) == str(plain)
    for function in (np.max, np.sum, np.mean, np.std, np.median, np.argmax, np.linalg.norm):
        assert function(P) == function(plain)
        assert f"{function(P):.3f}"  # a scalar, and no array of no dimensions
    changed = P.copy()
    changed *= 2.0
    assert type(changed) is np.ndarray
    assert np.array_equal(changed, 2.0 * plain)


def test_names_change_no_value():
    plain = [np.asarray(curve) for curve in (P, Q)]
    assert curvewise.compare(P, Q).values == curvewise.compare(*plain).values
    other = NamedCurve(np.asarray(Q), ("eps", "sigma"))  # not refused, as columns of DataFrames are
    assert curvewise.dtw(P, other) == curvewise.dtw(*plain)


def test_curves_read_from_files_know_their_columns(tmp_path):
    file = tmp_path / "loop.csv"
    file.write_text("time;strain [%];stress\n0;0;0\n1;0,1;199,5\n")
    read = curvewise.read_curve(file, ["strain [%]", 3])
    assert read.column_names == ("strain [%]", "stress")
    scaled = curvewise.read_curve(file, ["strain [%]", 3], factors=[0.01, 1])
    assert scaled.column_names == ("strain [%] × 0.01", "stress")
    file.write_text("0 1\n1 2\n")
    assert curvewise.read_curve(file).column_names == ("column 1", "column 2")


def test_prepared_curves_keep_their_names():
    for made in (
        curves.resample(P, 50),
        curves.trim(P, 0.0, 0.01),
        curves.smooth(P, 9),
        curves.shift_to_origin(P),
    ):
        assert made.column_names == NAMES
    assert not getattr(curves.engineering_to_true(P), "column_names", ())


@pytest.mark.parametrize(
    ("draw", "options"),
    [
        (plotting.plot_area, {}),
        (plotting.plot_pcm, {}),
        (plotting.plot_alignment, {}),
        (plotting.plot_alignment, {"measure": "frechet"}),
        (plotting.plot_matching, {}),
        (plotting.plot_curve_length, {}),
    ],
)
def test_every_picture_names_its_axes(draw, options):
    for given, more, expected in (
        ((P, Q), {}, NAMES),
        ((pd.DataFrame(P, columns=NAMES), pd.DataFrame(Q, columns=NAMES)), {}, NAMES),
        ((np.asarray(P), np.asarray(Q)), {}, ("x", "y")),
        ((P, Q), {"names": ["u", "F"]}, ("u", "F")),
    ):
        ax = Figure().subplots()
        draw(*given, ax, **options, **more)
        assert labels(ax) == expected


def test_wrong_names_are_refused():
    for names, error in ((["u"], ValueError), ("uF", TypeError), (["u", "F", "t"], ValueError)):
        with pytest.raises(error, match=r"^names is "):
            curvewise.compare(P, Q, measures=["frechet"]).plot(names=names)
    assert axis_names(3, None) == ("coordinate 0", "coordinate 1", "coordinate 2")
    assert axis_names(1, None) == ("value",)


def test_comparisons_and_results_name_their_axes():
    frames = [pd.DataFrame(curve, columns=NAMES) for curve in (P, Q)]
    for figure in (
        curvewise.compare(*frames).plot(),
        curvewise.dtw_path(P, Q).plot(),
        curvewise.frechet_path(P, Q).plot(),
        curvewise.pcm_match(P, Q[20:80]).plot(),
        curvewise.frechet_continuous_path(P, Q).plot(),
    ):
        assert {labels(ax) for ax in figure.axes} == {NAMES}


def test_the_shell_names_the_axes_by_the_headers(tmp_path):
    files = []
    for name, curve in (("a.csv", P), ("b.csv", Q)):
        files.append(str(tmp_path / name))
        np.savetxt(files[-1], curve, delimiter=",", header=",".join(NAMES), comments="")
    picture = tmp_path / "picture.svg"
    arguments = ["compare", *files, "--measures", "area", "--plot", str(picture)]
    assert cli.main(arguments) == 0
    assert picture.read_text().count("<!-- strain -->") == 2


def test_identifications_name_their_axes():
    x = np.linspace(0.0, 1.0, 12)

    def line(parameters):
        return np.column_stack((x, parameters["a"] * x))

    test = NamedCurve(line({"a": 2.0}), NAMES)
    keywords = {"bounds": {"a": (0, 10)}, "progress": False, "max_runs": 6}
    found = identify(line, test, measure="sum_of_squares", method="trust-region", **keywords)
    assert labels(found.plot().axes[0]) == NAMES
    assert labels(found.plot(names=["u", "F"]).axes[0]) == ("u", "F")
    uncertain = found.uncertainty().plot()
    assert NAMES in [labels(ax) for part in uncertain.subfigs for ax in part.axes]
    uncertain.draw_without_rendering()
    lower = uncertain.subfigs[1]  # its title is above the loops, its legend below
    (legend,), (panel,), title = lower.legends, lower.axes, lower.texts[0]
    boxes = [artist.get_window_extent() for artist in (legend, panel, title)]
    assert boxes[0].y1 <= boxes[1].y0 < boxes[1].y1 <= boxes[2].y0
    several = identify_each(line, test, measures=["sum_of_squares", "area"], **keywords)
    assert labels(several.plot().axes[0]) == NAMES
