"""Objects of other packages are curves with the same value, or rejected with the line to write.

docs/reference/accepted_inputs.md has the table of the tested objects. Packages that are not
installed are skipped.
Substitutes replace torch, which takes gigabytes, and cupy, which needs a graphics card: they have
the attributes that numpy and curvewise use.
"""

from __future__ import annotations

import re
import subprocess
import sys
import warnings
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import reference
from curvewise.calibration import Objective
from curvewise.curves.named_curve import NamedCurve

P = np.array([(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 3.0)])
Q = P + np.array([0.25, 0.5])
FRAME = pd.DataFrame(P, columns=["strain", "stress"])
SHAPES = "shapely"


class Tensor:
    """The attributes of a torch tensor that are used."""

    def __init__(
        self, values: Any, requires_grad: bool = False, device: str = "cpu", dtype: str = "float64"
    ) -> None:
        self.values = np.asarray(values)
        self.requires_grad, self.device, self.dtype = requires_grad, device, f"torch.{dtype}"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        assert not self.requires_grad
        assert (self.device, self.dtype) == ("cpu", "torch.float64")
        return np.array(self.values, dtype=dtype)


class OnTheCard:
    """The attributes of an array of cupy that are used."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        raise TypeError("Implicit conversion to a NumPy array is not allowed. Use `.get()`")


class Line:
    """What speaks GeoJSON and is not of shapely."""

    def __init__(self, points: Any) -> None:
        self.__geo_interface__ = {"type": "LineString", "coordinates": points}


def package(name: str) -> Any:
    return pytest.importorskip(name, reason=f'needs {name}: pip install "curvewise[inputs]"')


def nullable(frame: pd.DataFrame, dtype: str) -> pd.DataFrame:
    if "pyarrow" in dtype:
        package("pyarrow")
    return frame.astype(dtype)


TAKEN: dict[str, Callable[[], Any]] = {
    "zip": lambda: zip(P[:, 0], P[:, 1], strict=True),
    "generator": lambda: (tuple(point) for point in P),
    "DataFrame": lambda: FRAME,
    "Float64": lambda: nullable(FRAME, "Float64"),
    "float64[pyarrow]": lambda: nullable(FRAME, "float64[pyarrow]"),
    "mixed": lambda: FRAME.astype({"strain": "Int64", "stress": "Float32"}),
    "tensor": lambda: Tensor(P),
    "GeoJSON": lambda: Line(P.tolist()),
    "polars": lambda: package("polars").DataFrame(P, schema=["strain", "stress"]),
    "pyarrow": lambda: package("pyarrow").Table.from_pandas(FRAME),
    "xarray": lambda: package("xarray").DataArray(P, dims=("point", "column")),
    "LineString": lambda: package(SHAPES).LineString(P),
    "coords": lambda: package(SHAPES).LineString(P).coords,
}


@pytest.mark.parametrize("kind", TAKEN)
def test_a_curve_of_another_package_is_that_of_its_numbers(kind: str) -> None:
    for module in (curvewise, reference):
        assert module.dtw(TAKEN[kind](), Q) == module.dtw(P, Q)
        assert module.area(Q, TAKEN[kind]()) == module.area(Q, P)
    if kind not in ("zip", "generator"):
        assert curvewise.dtw(TAKEN[kind](), TAKEN[kind]()) == 0.0
    assert curvewise.cdist([TAKEN[kind](), TAKEN[kind]()], [Q]).tolist() == [
        [curvewise.dtw(P, Q)],
        [curvewise.dtw(P, Q)],
    ]
    assert curvewise.Prepared(TAKEN[kind]())(TAKEN[kind]()) == 0.0


@pytest.mark.parametrize("kind", ["polars", "LineString", "DataFrame"])
def test_lists_of_them_are_lists_of_curves(kind: str) -> None:
    curves = [TAKEN[kind](), TAKEN[kind]()]
    assert Objective(curves)([P, P]) == 0.0
    assert curvewise.Prepared(Q)(curves).tolist() == [curvewise.dtw(Q, P)] * 2


def test_a_closed_line_ends_where_it_begins() -> None:
    ring = package(SHAPES).LinearRing(P)
    assert curvewise.dtw(ring, np.vstack([P, P[:1]])) == 0.0


def test_a_third_coordinate_of_a_line_counts() -> None:
    solid = np.column_stack([P, P[:, 0]])
    assert curvewise.frechet(package(SHAPES).LineString(solid), solid) == 0.0


def test_geoseries_of_lines_are_lists_of_curves() -> None:
    shapes, geopandas = package(SHAPES), package("geopandas")
    lines = geopandas.GeoSeries([shapes.LineString(P), shapes.LineString(Q)])
    assert curvewise.pdist(lines, "frechet").tolist() == [curvewise.frechet(P, Q)]
    points = geopandas.GeoSeries([shapes.Point(*point) for point in P])
    assert curvewise.dtw(points.get_coordinates(), P) == 0.0  # what the refusal says
    table = geopandas.GeoDataFrame(geometry=lines)
    curvewise.cdist(table.geometry)


@pytest.mark.parametrize("dtype", ["Float64", "float64[pyarrow]"])
def test_a_missing_value_has_its_place(dtype: str) -> None:
    missing = nullable(FRAME, dtype)
    missing.loc[2, "stress"] = pd.NA
    for module in (curvewise, reference):
        with pytest.raises(ValueError, match=r"^P\[2, 1\] is nan; curves must be finite$"):
            module.dtw(missing, Q)


def test_tables_of_pyarrow_with_other_names_are_refused() -> None:
    table = package("pyarrow").Table.from_pandas(FRAME)
    assert curvewise.dtw(table, FRAME + 1) == curvewise.dtw(P, P + 1)
    with pytest.raises(ValueError, match="name and order them alike"):
        curvewise.dtw(table, table.rename_columns(["stress", "strain"]))


def dated() -> pd.DataFrame:
    return pd.DataFrame({"date": pd.to_datetime(["2020-01-01"] * 2), "x": [0.0, 1.0]})


REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "gradient": (
        lambda: Tensor(P, requires_grad=True, device="cuda:0"),
        "P is a tensor that requires a gradient and is on cuda:0; give P.detach().cpu()",
    ),
    "bfloat16": (
        lambda: Tensor(P, dtype="bfloat16"),
        "P is a tensor that has dtype bfloat16; give P.float()",
    ),
    "graphics card": (
        OnTheCard,
        "P, a OnTheCard, gives no array: Implicit conversion to a NumPy array is not allowed. "
        "Use `.get()`",
    ),
    "dates": (
        dated,
        "P has dtype object; a curve holds real numbers: column 'date' has dtype "
        f"{dated()['date'].dtype}; convert it, or leave it out",
    ),
    "dict": (
        lambda: {"x": P[:, 0], "y": P[:, 1]},
        "P has dtype object; a curve holds real numbers: numpy.column_stack(list(P.values())) has "
        "its values as columns",
    ),
    "file": (
        lambda: "test.csv",
        "P has dtype <U8; a curve holds real numbers: curvewise.read_curve(P) reads a file",
    ),
    "records": (
        lambda: np.rec.fromarrays(P.T, names="x,y"),
        "P has dtype (numpy.record, [('x', '<f8'), ('y', '<f8')]); a curve holds real numbers: "
        "numpy.lib.recfunctions.structured_to_unstructured(P) has its fields as columns",
    ),
    "LazyFrame": (
        lambda: package("polars").LazyFrame(P),
        "P is a LazyFrame, not computed yet; give P.collect()",
    ),
    "Decimal": (
        lambda: (lambda pl: pl.DataFrame(P, schema=["x", "y"]).cast(pl.Decimal(9, 2)))(
            package("polars")
        ),
        "P has dtype object; a curve holds real numbers: column 'x' has dtype object; convert it, "
        "or leave it out",
    ),
    "Dataset": (
        lambda: package("xarray").Dataset({"strain": ("i", P[:, 0]), "stress": ("i", P[:, 1])}),
        "P is a Dataset; give its variables as columns: "
        "numpy.column_stack([P['strain'], P['stress']])",
    ),
    "Point": (
        lambda: package(SHAPES).Point(1, 2),
        "P is a Point, not a line; a curve needs several: shapely.LineString of the points is one",
    ),
    "MultiPoint": (
        lambda: package(SHAPES).MultiPoint(P),
        "P is a MultiPoint, not a line; its points have no order that counts: give "
        "shapely.get_coordinates(P)",
    ),
    "Polygon": (lambda: package(SHAPES).Polygon(P), "P is a Polygon, not a line; give P.exterior"),
    "MultiLineString": (
        lambda: package(SHAPES).MultiLineString([P, Q]),
        "P is a MultiLineString, not a line; give one of its lines, P.geoms[0], or "
        "shapely.line_merge(P)",
    ),
    "GeometryCollection": (
        lambda: package(SHAPES).GeometryCollection([package(SHAPES).LineString(P)]),
        "P is a GeometryCollection, not a line; give a LineString",
    ),
    "list of Points": (
        lambda: [package(SHAPES).Point(*point) for point in P],
        "P has dtype object; a curve holds real numbers: shapely.get_coordinates(P) has the points "
        "as rows",
    ),
    "GeoSeries": (
        lambda: package("geopandas").GeoSeries([package(SHAPES).LineString(P)]),
        "P is a GeoSeries, many shapes; give one of its curves, P.iloc[0], or all of them to cdist",
    ),
    "GeoDataFrame of points": (
        lambda: package("geopandas").GeoDataFrame(geometry=[package(SHAPES).Point(1, 2)]),
        "P is a GeoDataFrame, many shapes; the track along its points is "
        "P.geometry.get_coordinates()",
    ),
}


@pytest.mark.parametrize("module", [curvewise, reference], ids=["compiled", "reference"])
@pytest.mark.parametrize("kind", REFUSED)
def test_what_is_no_curve_is_refused_with_the_line_to_write(kind: str, module: ModuleType) -> None:
    make, message = REFUSED[kind]
    with pytest.raises(TypeError) as caught:
        module.dtw(make(), Q)
    assert str(caught.value) == message


def test_tensors_are_as_what_stands_for_them() -> None:
    torch = package("torch")
    tensor = torch.tensor(P)
    assert curvewise.dtw(tensor, tensor.float()) == 0.0
    with pytest.raises(TypeError, match=r"^P is a tensor that requires a gradient; give P.detach"):
        curvewise.dtw(tensor.clone().requires_grad_(), Q)
    with pytest.raises(TypeError, match=r"^P is a tensor that has dtype bfloat16; give P.float\("):
        curvewise.dtw(tensor.bfloat16(), Q)
    nested = torch.nested.nested_tensor([tensor, tensor[1:]], layout=torch.jagged)
    assert curvewise.cdist(nested, [Q])[1, 0] == curvewise.dtw(P[1:], Q)
    with pytest.raises(TypeError, match=r"^P, a NestedTensor, gives no array: "):
        curvewise.dtw(nested, Q)


@pytest.mark.parametrize(
    ("curve", "message"),
    [
        (None, "P is None; give a curve"),
        ([1.0, None], "P has dtype object; a curve holds real numbers, but P[1] is None: leave"),
        ([[1, 2], [3, None]], "P has dtype object; a curve holds real numbers, but P[1, 1] is No"),
    ],
)
def test_none_has_its_place(curve: Any, message: str) -> None:
    for module in (curvewise, reference):
        with pytest.raises(TypeError, match=f"^{re.escape(message)}"):
            module.dtw(curve, Q)
    with pytest.raises(TypeError, match=re.escape(message[2:]).replace("P", r"X\[1\]")):
        curvewise.pdist([P, curve])


def test_an_empty_line_has_no_points() -> None:
    with pytest.raises(ValueError, match=r"^P has shape \(0, 2\); dtw needs at least 1 point$"):
        curvewise.dtw(package(SHAPES).LineString(), Q)


def test_none_of_the_packages_is_imported() -> None:
    code = (
        "import sys, curvewise; curvewise.dtw(zip([0, 1], [0, 1]), [(0, 0)]);"
        "print([name for name in ('pandas', 'polars', 'xarray', 'shapely', 'torch')"
        " if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stdout == "[]\n"


TRANSPOSED = " (a row is a point: transpose?)"


@pytest.mark.parametrize("module", [curvewise, reference], ids=["compiled", "reference"])
def test_points_as_columns_are_asked_about(module: ModuleType) -> None:
    rows, fewer = P.T, Q[:3].T
    planar = "P has shape (2, 4) and Q has shape (2, 4); area needs 2 coordinates, x and y"
    with pytest.raises(ValueError, match=f"^{re.escape(planar + TRANSPOSED)}$"):
        module.area(rows, rows)
    unequal = "P has shape (2, 4) and Q has shape (4, 2); both need the same number of coordinates"
    for measure in ("dtw", "frechet", "area"):
        with pytest.raises(ValueError, match=f"^{re.escape(unequal + TRANSPOSED)}$"):
            getattr(module, measure)(rows, Q)
    with pytest.raises(ValueError, match=r"transpose\?\)$"):
        module.dtw(rows, fewer)
    with pytest.raises(
        ValueError, match=r"gives? shape \(n, d\), or \(n,\) for d = 1: P\[0\]\.T\?$"
    ):
        module.dtw(rows[np.newaxis], Q)
    with pytest.raises(ValueError, match=r"for d = 1: P\[0\]$"):
        module.dtw(P[np.newaxis], Q)


def test_lists_of_points_as_columns_are_asked_about() -> None:
    with pytest.raises(ValueError, match=r"transpose\?\)$"):
        curvewise.cdist(np.zeros((3, 2, 9)), measure="area")


def timed(n: int, last: bool = False) -> np.ndarray[Any, np.dtype[np.float64]]:
    curve, _ = curvewise.datasets.hysteresis_pair()
    columns = [np.arange(n) * 0.5, *curve[:n].T]
    return np.column_stack(columns[::-1] if last else columns)


def test_compare_warns_of_a_column_of_time() -> None:
    said = "counts as a coordinate, and looks like time; leave it out of P and Q, or say measures="
    for last, place in ((False, "1"), (True, "3")):
        with pytest.warns(UserWarning, match=f"^column {place} of 3 {said}"):
            curvewise.compare(timed(200, last), timed(150, last))
    frame = NamedCurve(np.roll(P.repeat(2, axis=1)[:, :3], 1, 0), ["x", "y", "Time [s]"])
    with pytest.warns(UserWarning, match=f"^column 'Time \\[s\\]' {re.escape(said)}") as caught:
        curvewise.compare(frame, frame)
    assert caught[0].filename == __file__


def test_compare_does_not_warn_of_what_is_no_time_or_was_asked_for() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        curvewise.compare(timed(200), timed(150), measures=["dtw"])
        rising = np.arange(12.0).reshape(4, 3)
        curvewise.compare(
            rising, rising
        )  # a straight line: no column is like time more than others
        curvewise.compare(P, Q)
        track = np.column_stack([P, P[::-1, 1]])
        track[2] = track[1]
        curvewise.compare(track, track)
