"""What notebooks and terminals show of a result."""

from __future__ import annotations

import base64
import gc
import io
import re
import sys
import types
import weakref

import numpy as np
import pytest

import curvewise
from curvewise.calibration import cross_validate, identify, identify_each, line_plot
from curvewise.drawing.palette import P_COLOUR, Q_COLOUR, SERIES
from curvewise.showing.result import Result, Table

P, Q = curvewise.datasets.hysteresis_pair()
X = np.linspace(0.0, 1.0, 12)
KEYWORDS = {"bounds": {"a": (0, 10)}, "progress": False, "max_runs": 6}


def line(parameters):
    return np.column_stack((X, parameters["a"] * X))


@pytest.fixture(scope="module")
def found():
    return identify(line, line({"a": 2.0}), measure="sum_of_squares", **KEYWORDS)


@pytest.fixture(scope="module")
def results(found):
    return [
        curvewise.compare(P, Q, measures=["area"]),
        curvewise.frechet_path(P[:, 1], Q[:, 1]),
        curvewise.dtw_path(np.column_stack([P, P]), np.column_stack([Q, Q])),
        curvewise.frechet_continuous_path(P, Q),
        curvewise.pcm_match(P, Q[20:80]),
        curvewise.dtw_mean([P[:, 1], Q[:, 1]]),
        found,
        found.uncertainty(),
        identify_each(line, line({"a": 2.0}), measures=["area", "dtw"], **KEYWORDS),
    ]


def test_notebooks_show_a_table_and_a_picture(results):
    for result in results:
        shown = result._repr_html_()
        assert shown.startswith(("<table>", "<p>Deviation"))
        (data,) = re.findall(
            r'<img alt="[^"]+" style="[^"]+" src="data:image/png;base64,(.+?)">', shown
        )
        assert base64.b64decode(data).startswith(b"\x89PNG")
        assert len(shown) < 400_000


def test_without_matplotlib_the_table_stands_alone(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    for result in results:
        shown = result._repr_html_()
        assert shown.startswith(("<table>", "<p>Deviation"))
        assert "<img" not in shown
        assert "No picture: pictures need matplotlib, which is not installed: pip install" in shown


def test_a_result_without_tables_or_picture_is_an_error():
    class Forgetful(Result):
        picture_shows = "nothing"

    with pytest.raises(TypeError, match=r"abstract methods '?parts'?(,| and) '?plot"):
        Forgetful()


def test_a_table_is_the_same_as_text_and_in_a_notebook():
    table = Table([["a", "1.5", "at <1>"], ["long", "", ""]], ["", "value", ""], narrowest=7)
    assert table.text() == "        value\na         1.5  at <1>\nlong"
    shown = table.html()
    assert '<td style="text-align: right">1.5</td>' in shown
    assert '<td style="text-align: left">at &lt;1&gt;</td>' in shown
    assert Table([], ["measure", "value"]).text() == "measure  value"


def test_terminals_show_no_coordinates(results):
    two = [line({"a": 2.0}), line({"a": 2.1})]
    folds = cross_validate(lambda p: [line(p)] * 2, two, measure="sum_of_squares", **KEYWORDS)
    others = [
        curvewise.area_quads(P, Q),
        curvewise.subsequence(P[20:40], P)[0],
        line_plot(line({"a": 2}), line, {"a": 1}, {"a": 3}, points=3, progress=False),
        folds,
        curvewise.compare(P, Q).deviations["area"],
    ]
    for result in [*results, *others]:
        assert "array(" not in repr(result)
        assert "object at 0x" not in repr(result)
        assert len(repr(result)) < 500
    assert repr(curvewise.dtw_path([0, 1], [0, 1])) == (
        "Alignment(distance=0.0, path=<array of shape (2, 2)>)"
    )
    assert "curve" not in repr(curvewise.pcm_match(P, Q))
    assert folds._repr_html_().startswith("<table>")


def test_deviations_are_a_dict_that_shows_a_table():
    deviations = curvewise.compare(P, Q, measures=["area", "dtw"]).deviations
    assert list(deviations) == ["area", "dtw"]
    assert str(deviations).splitlines()[0] == f"area  {deviations['area']}"
    assert "54.09 (4 %)" in deviations._repr_html_()


def test_a_figure_shows_itself_in_a_notebook():
    figure = curvewise.dtw_path(P, Q).plot()
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert figure._repr_png_() == curvewise.dtw_path(P, Q).plot()._repr_png_()


class Notebook:
    """A shell as IPython's, which shows pictures and tells when a cell has run."""

    def __init__(self, monkeypatch, *formats):
        self.shown, self.callbacks = [], []
        self.display_formatter = self.displayhook = self.events = self
        self.active_types, self.exec_result = formats, "a cell is running"
        module = types.ModuleType("IPython")
        module.version_info = (9, 0)  # which matplotlib asks for
        module.get_ipython = lambda: self
        module.display = types.ModuleType("IPython.display")
        module.display.display = self.shown.append
        monkeypatch.setitem(sys.modules, "IPython", module)
        monkeypatch.setitem(sys.modules, "IPython.display", module.display)

    def register(self, event, callback):
        assert event == "post_run_cell"
        self.callbacks.append(callback)

    def unregister(self, event, callback):
        self.callbacks.remove(callback)

    def ends_cell(self, result=None, success=True):
        for callback in list(self.callbacks):
            callback(types.SimpleNamespace(result=result, success=success))
        shown = self.shown.copy()
        self.shown.clear()
        return shown


def test_a_notebook_shows_a_picture_though_a_semicolon_hides_the_value(found, monkeypatch):
    notebook = Notebook(monkeypatch, "text/plain", "image/png")
    comparison = curvewise.compare(P, Q, measures=["area"])
    for plot in (comparison.plot, found.plot, found.uncertainty().plot):
        figure = plot()
        (shown,) = notebook.ends_cell()
        assert shown is figure
        assert notebook.ends_cell() == []  # once
    figure = comparison.plot()
    assert notebook.ends_cell(result=figure) == []  # the cell's value is shown by itself
    comparison._repr_html_()
    assert notebook.ends_cell(result=comparison) == []
    comparison.plot().savefig(io.BytesIO())
    assert notebook.ends_cell() == []  # a file was wanted
    comparison.plot()
    assert notebook.ends_cell(success=False) == []
    assert notebook.callbacks == []
    notebook.exec_result = None  # not in a cell, as in a widget's callback
    comparison.plot()
    assert notebook.callbacks == []


def test_scripts_and_terminals_keep_no_pictures(monkeypatch):
    notebook = Notebook(monkeypatch, "text/plain")
    kept = weakref.ref(curvewise.compare(P, Q, measures=["area"]).plot())
    gc.collect()
    assert kept() is None
    assert notebook.callbacks == []


def test_results_keep_copies_of_their_curves():
    changed = np.array(P)
    found = curvewise.dtw_path(changed, Q)
    changed[:] = 0.0
    assert np.array_equal(found.curves[0], P)
    with pytest.raises(ValueError, match="does not know its curves"):
        curvewise.reference.pcm_match(P, Q).plot()
    assert curvewise.reference.pcm_match(P, Q)._repr_html_().startswith("<table>")
    assert curvewise.reference.dtw_path(P[:9], Q[:9]).plot().axes  # the path alone


@pytest.mark.parametrize(("kind", "begin"), [("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_pictures_are_written_as_vectors(found, kind, begin):
    file = io.BytesIO()
    found.plot().savefig(file, format=kind)
    assert file.getvalue().startswith(begin)
    assert b"<image" not in file.getvalue()
    assert b"/Subtype /Image" not in file.getvalue()


def test_the_colours_are_apart_for_any_eye():
    """The difference of colours for eyes without green cones (Machado et al. 2009)."""
    deuteranopia = np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.01182, 0.04294, 0.968881],
        ]
    )

    def seen(colour):
        rgb = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
        return deuteranopia @ np.where(rgb > 0.04045, ((rgb + 0.055) / 1.055) ** 2.4, rgb / 12.92)

    assert SERIES[0] == Q_COLOUR
    assert SERIES[-1] == P_COLOUR
    views = [seen(colour) for colour in SERIES]
    apart = [np.linalg.norm(a - b) for i, a in enumerate(views) for b in views[:i]]
    assert min(apart) > 0.1
    assert np.linalg.norm(seen(P_COLOUR) - seen(Q_COLOUR)) > 0.3
