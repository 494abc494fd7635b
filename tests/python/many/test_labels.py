"""What comes in with labels comes back with them, and has the bits that it has without."""

from __future__ import annotations

import pickle
import sys
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.distance import squareform

import curvewise

NAMES = ["ramp", "step", "peak", "long"]
CURVES = [np.array([0.0, 1, 2, 3]), np.array([0.0, 0, 3, 3]), np.array([0.0, 3, 0]), np.arange(9.0)]
IN_PLANE = [np.column_stack([np.arange(len(curve)), curve]) for curve in CURVES]
MATRIX, TRIANGLE = curvewise.cdist(IN_PLANE), curvewise.pdist(IN_PLANE)


def stacked() -> pd.DataFrame:
    """Return all curves in one table, as a logger or a GPS writes them."""
    parts = [
        pd.DataFrame(curve, columns=["x", "y"]).assign(name=name, day=day)
        for name, day, curve in zip(NAMES, [1, 1, 2, 2], IN_PLANE, strict=True)
    ]
    return pd.concat(parts, ignore_index=True)


def collections() -> dict[str, Any]:
    table = stacked()
    return {
        "dict": dict(zip(NAMES, IN_PLANE, strict=True)),
        "groupby": table[["name", "x", "y"]].groupby("name", sort=False),
        "groupby of a list": table[["name", "x", "y"]].groupby(["name"], sort=False),
        "groupby of columns": table.groupby("name", sort=False)[["x", "y"]],
        "Series": pd.Series(IN_PLANE, index=NAMES),
    }


@pytest.mark.parametrize("kind", collections())
def test_distances_keep_the_labels(kind):
    curves = collections()[kind]
    matrix = curvewise.cdist(curves)
    assert isinstance(matrix, pd.DataFrame)
    assert matrix.index.tolist() == matrix.columns.tolist() == NAMES
    assert np.array_equal(matrix, MATRIX)
    triangle = curvewise.pdist(curves)
    assert np.array_equal(triangle, TRIANGLE)
    assert np.array_equal(squareform(triangle), MATRIX)
    assert triangle["ramp", "peak"] == MATRIX[0, 2]
    assert triangle.index.tolist()[:2] == [("ramp", "step"), ("ramp", "peak")]


def test_labels_of_one_list_only():
    rows = curvewise.cdist(dict(zip(NAMES, IN_PLANE, strict=True)), IN_PLANE[:2])
    assert (rows.index.tolist(), rows.columns.tolist()) == (NAMES, [0, 1])
    columns = curvewise.cdist(IN_PLANE[:2], pd.Series(IN_PLANE, index=NAMES), "frechet")
    assert (columns.index.tolist(), columns.columns.tolist()) == ([0, 1], NAMES)
    assert np.array_equal(columns, curvewise.cdist(IN_PLANE[:2], IN_PLANE, "frechet"))


def test_several_keys_a_callable_and_out():
    out = np.empty((4, 4))
    grouped = stacked().groupby(["day", "name"])
    matrix = curvewise.cdist(grouped, measure=lambda P, Q: float(len(P) - len(Q)), out=out)
    assert matrix.loc[[(1, "ramp")], [(2, "peak")]].to_numpy() == [[1.0]]
    assert np.shares_memory(matrix.to_numpy(), out)
    assert curvewise.pdist(grouped)[(1, "ramp"), (2, "peak")] == MATRIX[0, 2]


def test_equal_labels_stay_apart():
    triangle = curvewise.pdist(pd.Series(IN_PLANE, index=["a", "a", "b", "a"]))
    pairs = [("a", "a"), ("a", "b"), ("a", "a"), ("a", "b"), ("a", "a"), ("b", "a")]
    assert triangle.index.tolist() == pairs
    assert np.array_equal(triangle, TRIANGLE)


@pytest.mark.parametrize("count", [0, 1])
def test_few_curves(count):
    curves = dict(zip(NAMES[:count], IN_PLANE, strict=False))
    assert curvewise.cdist(curves).shape == (count, count)
    assert curvewise.pdist(curves).shape == (0,)


def test_lines_on_a_map():
    shapely, geopandas = pytest.importorskip("shapely"), pytest.importorskip("geopandas")
    lines = geopandas.GeoSeries([shapely.LineString(curve) for curve in IN_PLANE], index=NAMES)
    table = geopandas.GeoDataFrame({"speed": [3, 4, 5, 6]}, index=NAMES, geometry=lines)
    for curves in (lines, table):
        matrix = curvewise.cdist(curves)
        assert matrix.index.tolist() == NAMES
        assert np.array_equal(matrix, MATRIX)
        assert curvewise.medoid(curves) == NAMES[curvewise.medoid(IN_PLANE)]
        assert np.array_equal(curvewise.dtw_mean(curves).curve, curvewise.dtw_mean(IN_PLANE).curve)


def test_neighbours_are_named():
    named, plain = curvewise.Index(dict(zip(NAMES, IN_PLANE, strict=True))), IN_PLANE
    expected, places = curvewise.Index(plain).kneighbors(plain[:2], 3)
    for index in (named, pickle.loads(pickle.dumps(named))):
        distances, found = index.kneighbors({"p": plain[0], "q": plain[1]}, 3)
        assert distances.index.tolist() == found.index.tolist() == ["p", "q"]
        assert np.array_equal(distances, expected)
        assert np.array_equal(found, np.array(NAMES, dtype=object)[places])
    assert named.kneighbors(plain[:2], 1)[1].index.tolist() == [0, 1]
    assert named.kneighbors(n_neighbors=1, return_distance=False).index.tolist() == NAMES
    _, places_only = curvewise.Index(plain).kneighbors({"p": plain[0]}, 2)
    assert places_only.loc["p"].tolist() == places[0, :2].tolist()
    assert named.kneighbors_graph(n_neighbors=1).shape == (4, 4)


def test_neighbours_within_a_radius_are_named():
    named = curvewise.Index(dict(zip(NAMES, IN_PLANE, strict=True)))
    near, found = named.radius_neighbors({"p": IN_PLANE[0]}, MATRIX[0, 1])
    assert found["p"].tolist() == [NAMES[i] for i in np.argsort(MATRIX[0], kind="stable")[:2]]
    assert near["p"].tolist() == np.sort(MATRIX[0])[:2].tolist()
    only = named.radius_neighbors(IN_PLANE[:1], 0.0, return_distance=False)
    assert [found.tolist() for found in only] == [["ramp"]]


def test_curves_are_added_with_labels_or_without_as_those_there_are():
    named, plain = curvewise.Index({"ramp": IN_PLANE[0]}), curvewise.Index(IN_PLANE[:1])
    named.add({"peak": IN_PLANE[2]})
    assert named.kneighbors(n_neighbors=1, return_distance=False)[0].tolist() == ["peak", "ramp"]
    with pytest.raises(ValueError, match="have labels and those to be added none; give all of"):
        named.add(IN_PLANE[1:2])
    with pytest.raises(ValueError, match="have no labels and those to be added some; give all"):
        plain.add({"peak": IN_PLANE[2]})
    assert len(named) == 2
    assert len(plain) == 1


def test_a_label_is_that_of_one_curve_where_labels_answer():
    twice = pd.Series(IN_PLANE, index=["a", "b", "a", "c"])
    said = r"^curves has the label 'a', which another curve has, too; give distinct labels, since"
    for entry in (curvewise.Index, curvewise.medoid):
        with pytest.raises(ValueError, match=said):
            entry(twice)
    index = curvewise.Index({"a": IN_PLANE[0]})
    for more in ({"a": IN_PLANE[1]}, twice[1:].set_axis(["b", "b", "c"]), {"b": 0, "a": 0}):
        with pytest.raises(ValueError, match=r"^curves has the label '[ab]', which another curve"):
            index.add(more)
    assert len(index) == 1
    index.add({"b": IN_PLANE[1]})
    assert index.kneighbors(IN_PLANE[1:2], 1, return_distance=False)[0].tolist() == ["b"]


LOGGED = stacked()[["name", "x", "y"]]
MANY = {  # whose labels are in another order than the alphabet's, except for the first
    "groupby": LOGGED.groupby("name"),
    "unsorted groupby": LOGGED.groupby("name", sort=False),
    "dict": dict(zip(NAMES, IN_PLANE, strict=True)),
    "Series": pd.Series(IN_PLANE, index=NAMES),
}


def fitted(curves: Any, y: Any) -> Any:
    sklearn = pytest.importorskip("curvewise.sklearn", exc_type=ImportError)
    return sklearn.CurveKNeighborsClassifier(1).fit(curves, y)


@pytest.mark.parametrize("kind", MANY)
def test_classes_are_of_the_curves_with_their_labels(kind):
    curves = MANY[kind]
    for order in (NAMES, sorted(NAMES), NAMES[::-1]):
        y = pd.Series([f"class of {name}" for name in order], index=order)
        for classes in (y, y.astype("category")):
            found = fitted(curves, classes).predict(IN_PLANE)
            assert found.tolist() == [f"class of {name}" for name in NAMES]


@pytest.mark.parametrize("kind", MANY)
def test_weights_are_of_the_curves_with_their_labels(kind):
    weights = [1.0, 2.0, 3.0, 4.0]
    expected = curvewise.dtw_mean(IN_PLANE, initial=IN_PLANE[0], weights=weights)
    for order in (NAMES, NAMES[::-1]):
        labelled = pd.Series(weights, index=NAMES)[order]
        mean = curvewise.dtw_mean(MANY[kind], initial=IN_PLANE[0], weights=labelled)
        np.testing.assert_allclose(mean.curve, expected.curve, rtol=1e-12)
        soft = curvewise.soft_dtw_mean(MANY[kind], initial=IN_PLANE[0], weights=labelled)
        of_list = curvewise.soft_dtw_mean(IN_PLANE, initial=IN_PLANE[0], weights=weights)
        np.testing.assert_allclose(soft.curve, of_list.curve, rtol=1e-6)


def test_classes_without_labels_are_in_the_order_of_the_curves():
    numbers = pd.Series(list("pqrs"))
    assert fitted(MANY["dict"], numbers).predict(IN_PLANE).tolist() == list("pqrs")
    assert fitted(MANY["dict"], list("pqrs")).predict(IN_PLANE).tolist() == list("pqrs")
    assert fitted(IN_PLANE, pd.Series(list("pqrs"), NAMES[::-1])).predict(IN_PLANE).tolist() == [
        *"pqrs"
    ]
    backwards = {3 - i: curve for i, curve in enumerate(IN_PLANE)}
    assert fitted(backwards, numbers).predict(IN_PLANE).tolist() == list("srqp")


@pytest.mark.parametrize("order", [[*NAMES[:3], "other"], [*NAMES[:3], "ramp"], [*NAMES, "more"]])
def test_classes_with_other_labels_are_refused(order):
    said = r"^y has the labels 'ramp', 'step', 'peak', .* and the curves have 'ramp', 'step', 'pe"
    with pytest.raises(ValueError, match=said):
        fitted(MANY["dict"], pd.Series(range(len(order)), index=order))


def test_one_curve_against_labelled_ones():
    against = curvewise.Prepared(IN_PLANE[0], "dtw")
    values = against(dict(zip(NAMES, IN_PLANE, strict=True)))
    assert values.index.tolist() == NAMES
    assert np.array_equal(values, MATRIX[0])


def test_groups_with_a_column_too_many():
    said = r"^X has groups with columns \['time', 'x', 'y'\], .*; choose: X\[\['x', 'y'\]\]"
    table = stacked().drop(columns="day").assign(time=0.5)[["time", "name", "x", "y"]]
    with pytest.raises(ValueError, match=said):
        curvewise.pdist(table.groupby("name"))
    assert len(curvewise.pdist(table.groupby("name")[["x", "y"]])) == 6


def test_plain_sequences_stay_plain():
    assert type(curvewise.cdist(IN_PLANE)) is type(curvewise.pdist(tuple(IN_PLANE))) is np.ndarray


def test_without_pandas(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    said = r'pip install "curvewise\[curves\]", or give a list$'
    with pytest.raises(ImportError, match=said):
        curvewise.cdist({"ramp": IN_PLANE[0]})
    assert curvewise.medoid({"ramp": IN_PLANE[0]}) == "ramp"
