"""A measure that refuses curves does not hide the values of the others."""

from __future__ import annotations

import html
import itertools
import math
import re
from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise.measures.registry import MEASURES

CURVES: dict[str, list[tuple[float, float]]] = {
    "flat in y": [(0, 0), (1, 0), (4, 0)],
    "flat in x": [(0, 0), (0, 1), (0, 4)],
    "all points equal": [(2, 3)] * 3,
    "one point": [(2, 3)],
    "two points": [(0, 0), (4, 1)],
    "collinear": [(0, 0), (1, 1), (3, 3)],
    "repeated points": [(0, 0), (0, 0), (2, 1), (2, 1)],
    "mean of zero": [(0, 1), (4, -1)],
    "an arc": [(0, 1), (2, 3), (4, 2)],
}
WIDTH = max(map(len, MEASURES))
PAIRS = list(itertools.product(CURVES, repeat=2))


def alone(name: str, P: Any, Q: Any, preset: Any) -> float | str:
    """Return the value of one measure, or its error."""
    try:
        return curvewise.compare(P, Q, measures=[name], preset=preset)[name]
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_every_measure_of_degenerate_curves(preset: Any) -> None:
    refused = set()
    for names in PAIRS:
        P, Q = (CURVES[name] for name in names)
        found = curvewise.compare(P, Q, preset=preset, measures=list(MEASURES))
        for name in MEASURES:
            expected = alone(name, P, Q, preset)
            if isinstance(expected, float):
                assert found[name] == expected
                assert math.isfinite(expected)
                continue
            refused.add(name)
            assert found.refusals[name] == expected
            assert math.isnan(found.to_dict()[name])
            with pytest.raises(ValueError, match=re.escape(expected)):
                found[name]
            assert f"{name:<{WIDTH}}  no value: {expected}" in str(found).splitlines()
            assert name not in found.deviations
        assert list(found.to_dict()) == list(MEASURES)
        assert not any("times" in note for note in found.notes), (names, found.notes)
    assert refused == {"area", "pcm", "curve_length"}


def test_a_refusal_in_a_notebook_and_in_the_picture() -> None:
    pytest.importorskip("matplotlib")
    found = curvewise.compare(CURVES["one point"], CURVES["an arc"])
    assert list(found.refusals) == ["area", "pcm", "curve_length"]
    shown = found._repr_html_()
    assert "No picture" not in shown
    figure = found.plot()
    titles = {ax.get_title() for ax in figure.axes}
    for name, words in found.refusals.items():
        cell = rf"<td[^>]*>{name}</td><td[^>]*></td><td[^>]*>no value: "
        assert re.search(cell, shown)
        assert html.escape(words) in shown
        assert f"{MEASURES[name].title}: no value" in titles


@pytest.mark.parametrize("names", [names for names in PAIRS if "an arc" in names])
@pytest.mark.nightly
def test_every_pair_has_a_picture(names: tuple[str, str]) -> None:
    pytest.importorskip("matplotlib")
    found = curvewise.compare(*(CURVES[name] for name in names), measures=list(MEASURES))
    assert "No picture" not in found._repr_html_()


def test_a_measure_without_a_path_does_not_hide_the_other_pictures() -> None:
    pytest.importorskip("matplotlib")
    figure = curvewise.compare(CURVES["an arc"], CURVES["an arc"], measures=["msm", "dtw"]).plot()
    words = [text.get_text() for ax in figure.axes for text in ax.texts]
    assert any(text.startswith("no picture: msm has no path") for text in words)
    assert "DTW: 0" in {ax.get_title() for ax in figure.axes}


def test_where_every_measure_refuses() -> None:
    with pytest.raises(ValueError, match="P has zero length"):
        curvewise.compare([(1, 1), (1, 1)], [(0, 0), (1, 1)], measures=["pcm", "curve_length"])
    with pytest.raises(ValueError, match=r"Q\[1, 0\] is nan"):
        curvewise.compare([(0, 0), (1, 1)], [(0, 0), (math.nan, 1)])
    with pytest.raises(ValueError, match="number of coordinates"):
        curvewise.compare([(0, 0), (1, 1)], [(0, 0, 0), (1, 1, 1)])


def test_options_that_fit_no_curves_are_an_error() -> None:
    P, Q = CURVES["an arc"], CURVES["two points"]
    for options in (
        {"dtw": {"window": -1}},
        {"area": {"spacing": "even"}},
        {"pcm": {"offsets": 0}},
    ):
        with pytest.raises(ValueError, match=r"window is -1|spacing|offsets is 0"):
            curvewise.compare(P, Q, options=options)
    found = curvewise.compare(P, CURVES["one point"], options={"area": {"spacing": "x"}})
    assert "area needs at least 2 points" in found.refusals["area"]
    too_narrow = {"dtw": {"window": 0, "step_pattern": "symmetricP2"}}
    found = curvewise.compare(P, Q, options=too_narrow)
    assert "dtw" in found.refusals
    assert found["frechet"] == curvewise.compare(P, Q)["frechet"]


@pytest.mark.parametrize("noise", [0.0, 1e-17, 1e-13])
def test_a_flat_curve_is_not_in_other_units(noise: float) -> None:
    line = np.array([(0.0, 0.0), (2.0, noise), (4.0, 0.0)])
    arc = np.array([(0.0, 1.0), (2.0, 5.0), (4.0, -1.0)])
    for P, Q in ((line, arc), (arc, line)):
        assert curvewise.compare(P, Q, measures=["frechet"]).notes == []
    per_cent = curvewise.compare(arc * (1, 1e-9), arc, measures=["frechet"])
    assert per_cent.notes == ["y of P is 1e-09 times that of Q; different units?"]
