"""The picture of a comparison shows what its numbers were computed from, and can be read."""

from __future__ import annotations

import itertools
import pickle
import subprocess
import sys

import numpy as np
import pandas as pd
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
    segments,
)
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import curvewise
from curvewise import plotting


def panel(figure: Figure, title: str) -> Axes:
    (ax,) = (ax for ax in figure.axes if ax.get_title().startswith(f"{title}: "))
    return ax


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_panels_show_what_the_preset_measured(preset):
    comparison = curvewise.compare(P, Q, preset=preset)
    figure = plotting.plot_comparison(comparison)
    shown = in_box if preset == "scaled" else np.asarray
    quads = np.array(
        [path.vertices[:4] for path in panel(figure, "Area").collections[0].get_paths()]
    )
    curves = curvewise.normalize(P, Q) if preset == "scaled" else (P, Q)
    spacing = {"scaled": "matched", "paper": "x", "raw": "distance"}[preset]
    expected = curvewise.area_quads(*curves, spacing=spacing)
    # Of "matched" some count against their piece.
    np.testing.assert_allclose(areas(shown(quads)), np.abs(expected.areas), rtol=1e-9, atol=1e-12)
    assert expected.areas.sum() == pytest.approx(comparison["area"], rel=1e-12)

    shown = np.asarray if preset == "raw" else in_box
    (pair,) = (line for line in panel(figure, "Fréchet").lines if line.get_label()[0] == "F")
    length = np.linalg.norm(np.diff(shown(pair.get_xydata()), axis=0))
    assert length == pytest.approx(comparison["frechet"], rel=1e-12)

    options = {"step_pattern": "symmetric2"} if preset == "paper" else {}
    expected = plotting.plot_alignment(
        P, Q, Figure().subplots(), normalized=preset != "raw", **options
    )
    drawn = panel(figure, "DTW").collections[0].get_segments()
    np.testing.assert_array_equal(drawn, segments(expected))

    links = np.array(panel(figure, "Curve length").collections[0].get_segments())
    links = in_box(links) if preset == "scaled" else links
    reference = np.abs(links[:, 0]).mean(axis=0) if preset == "scaled" else links[:, 0].mean(axis=0)
    residuals = np.log1p(np.abs((links[:, 1] - links[:, 0]) / reference))
    assert np.linalg.norm(residuals) == pytest.approx(comparison["curve_length"], rel=1e-9)


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("measures", [None, ["dtw"], ["dtw", "frechet"]])
def test_every_value_is_printed(dim, measures):
    curves = {1: (SERIES_P, SERIES_Q), 2: (P, Q), 3: (SPACE_P, SPACE_Q)}[dim]
    comparison = curvewise.compare(*curves, measures=measures)
    titles = [ax.get_title() for ax in comparison.plot().axes if ax.get_title()]
    printed = [float(title.split(": ")[1]) for title in titles]
    assert printed == pytest.approx(list(comparison.values.values()), rel=1e-3)
    assert not any("scaled" in title for title in titles)


@pytest.mark.parametrize(
    "pair",
    [
        ("dp780_tct_3pct", "dp780_tct_6pct"),
        ("resslab_cyclic_2pct", "resslab_random_protocol"),
        (SERIES_P, SERIES_Q),
        (SPACE_P, SPACE_Q),
    ],
    ids=["dp780", "resslab", "series", "space"],
)
@pytest.mark.nightly("resslab")
def test_no_texts_overlap(pair, data_dir, monkeypatch):
    if isinstance(pair[0], str):
        files = (data_dir / "loops" / f"{name}.csv" for name in pair)
        pair = [np.loadtxt(file, delimiter=",", skiprows=1) for file in files]
    figure = curvewise.compare(*pair).plot()
    canvas = FigureCanvasAgg(figure)
    figure.draw_without_rendering()  # the layout settles
    texts, draw = [], Text.draw
    monkeypatch.setattr(Text, "draw", lambda text, *args: texts.append(text) or draw(text, *args))
    canvas.draw()
    shown = (text for text in texts if text.get_visible() and text.get_text())
    boxes = [(text, text.get_window_extent().padded(1)) for text in shown]
    assert len(boxes) > 20
    for (one, box), (other, other_box) in itertools.combinations(boxes, 2):
        assert not box.overlaps(other_box), f"{one} and {other}"
        assert figure.bbox.containsx(box.x0)
        assert figure.bbox.containsx(box.x1)


def test_pictures_name_the_files(tmp_path):
    for file, curve in (("test.csv", P), ("simulation.csv", Q)):
        np.savetxt(tmp_path / file, curve, delimiter=",", header="strain,stress", comments="")
    test, simulated = (curvewise.read_curve(tmp_path / f"{n}.csv") for n in ("test", "simulation"))
    files = ["test.csv", "simulation.csv"]
    comparison = curvewise.compare(test, simulated)
    figures = [
        comparison.plot(),
        curvewise.dtw_path(test, simulated).plot(),
        curvewise.pcm_match(test, simulated[5:30]).plot(),
        curvewise.frechet_continuous_path(test[::2], pickle.loads(pickle.dumps(simulated))).plot(),
    ]
    for figure in figures:
        labels = [text.get_text() for text in figure.legends[0].get_texts()]
        assert labels[:2] == files
        assert "P" not in labels
    assert plotting.plot_alignment(test, simulated, figures[0].axes[0]).Q.get_label() == files[1]
    twice = curvewise.compare(test, test).plot().legends[0].get_texts()
    assert [text.get_text() for text in twice[:2]] == ["test.csv (P)", "test.csv (Q)"]
    table = plotting.plot_table(test, simulated, Figure().subplots())[0].axes
    assert table.get_xlabel() == "index in simulation.csv"
    frame = pd.DataFrame(P, columns=["file", "stress"])  # its column does not hold a file name
    assert plotting.plot_alignment(frame, Q, Figure().subplots()).P.get_label() == "P"


@pytest.mark.parametrize("format", ["png", "svg", "pdf"])
@pytest.mark.nightly("svg|pdf")
def test_figures_save_without_pyplot(format, tmp_path):
    code = f"""
import sys
import curvewise
assert not any(name.startswith("matplotlib") for name in sys.modules), "imported too early"
comparison = curvewise.compare(*curvewise.datasets.hysteresis_pair())
comparison.plot().savefig({str(tmp_path / "picture")!r}, format={format!r})
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)
    assert (tmp_path / "picture").stat().st_size > 10_000


def test_without_matplotlib_the_error_says_what_to_install(monkeypatch):
    comparison = curvewise.compare(P, Q)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(ImportError, match=r'pip install "curvewise\[plot\]"'):
        comparison.plot()


@pytest.mark.parametrize("dim", [1, 2, 3])
def test_the_continuous_distance_in_a_comparison(dim: int) -> None:
    P, Q = np.random.default_rng(dim).normal(size=(2, 9, dim))
    comparison = curvewise.compare(P, Q, measures=["frechet_continuous"])
    figure = comparison.plot()
    title = f"Continuous Fréchet: {comparison['frechet_continuous']:.4g}"
    assert figure.axes[1].get_title() == title
