"""Tables of three columns or more: taken where all are coordinates, else asked about by all."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import curves, reference
from curvewise.calibration import Objective
from curvewise.curves.column_roles import are_coordinates, coordinates_among

P = np.array([(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 3.0)])
Q = P + np.array([0.25, 0.5])


def logged(curve: Any, **others: Any) -> pd.DataFrame:
    """Return a table as a logger writes it: the others, then strain and stress."""
    return pd.DataFrame({**others, "strain": curve[:, 0], "stress": curve[:, 1]})


SECONDS = np.arange(4.0)
TABLES = {
    "time": logged(P, time=SECONDS),
    "id": logged(P, id=[7, 7, 7, 7]),
    "index": logged(P).reset_index(),
    "temperature": logged(P).assign(temperature=20.0),
    "Unnamed: 0": logged(P, **{"Unnamed: 0": range(4)}),
}


@pytest.mark.parametrize("third", TABLES)
def test_a_third_column_is_asked_about(third: str) -> None:
    table = TABLES[third]
    message = (
        f"P has columns {list(table.columns)}, each of which would be a coordinate; choose: "
        "P[['strain', 'stress']] for example, or P.to_numpy() for all"
    )
    for module in (curvewise, reference):
        for measure in ("dtw", "frechet", "area", "frechet_continuous"):
            with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
                getattr(module, measure)(table, table)
    assert curvewise.dtw(table[["strain", "stress"]], Q) == curvewise.dtw(P, Q)
    assert curvewise.dtw(table.to_numpy(), table.to_numpy()) == 0.0


def test_the_place_in_a_list_is_said() -> None:
    table = TABLES["time"]
    chosen = re.escape("[['strain', 'stress']] for example")
    calls = {
        "XA": lambda: curvewise.cdist([P, table]),
        "X": lambda: curvewise.pdist([P, table]),
        "curves": lambda: curvewise.Index([P, table]),
    }
    for name, call in calls.items():
        with pytest.raises(
            ValueError, match=rf"^{name}\[1\] has columns .* choose: {name}\[1\]{chosen}"
        ):
            call()
    with pytest.raises(ValueError, match=r"^curves\[1\] has columns"):
        curvewise.dtw_mean([P, table])
    with pytest.raises(ValueError, match=r"has columns .* each of which would be a coordinate"):
        Objective(table, measure="frechet")
    with pytest.raises(ValueError, match=r"^P has columns"):
        curvewise.compare(table, table)


@pytest.mark.parametrize(
    "names",
    [
        *(["x", "y", "z"], ["X [mm]", "Y [mm]", "Z [mm]"], ["x_mm", "y_mm", "z_mm"]),
        *(["z", "y", "x"], ["u", "v", "w"], ["a", "b", "c"], ["ux", "uy", "uz"]),
        *([0, 1, 2], ["0", "1", "2", "3"], ["x1", "x2", "x3"], [f"joint {i}" for i in range(12)]),
        *(["strain_xx", "strain_yy", "strain_xy"], ["s11", "s22", "s12"], ["x1", "y1", "x2", "y2"]),
        *(["lon", "lat", "alt"], ["Longitude", "Latitude", "Altitude (m)"], ["x", "y", "height"]),
        [("head", "x"), ("head", "y"), ("head", "z")],
    ],
    ids=str,
)
def test_coordinates_of_a_point_need_no_word(names: list[Any]) -> None:
    assert are_coordinates(names)
    solid = np.random.default_rng(0).normal(size=(5, len(names)))
    frame = pd.DataFrame(solid, columns=pd.Index(names))
    assert curvewise.dtw(frame, frame + 1.0) == curvewise.dtw(solid, solid + 1.0)
    assert curvewise.cdist([frame], [solid]).tolist() == [[0.0]]


@pytest.mark.parametrize(
    ("names", "meant"),
    [
        (["t", "x", "y"], ["x", "y"]),
        (["Time [s]", "x", "y", "z"], ["x", "y", "z"]),
        (["lon", "lat", "timestamp"], ["lon", "lat"]),
        (["x", "y", "track_id"], ["x", "y"]),
        (["step", "force", "displacement"], ["force", "displacement"]),
        (["strain", "stress", "T"], ["strain", "stress"]),
        (["r", "s", "t"], ["r", "s"]),
        (["left_x", "left_y", "right_x", "right_y"], ["left_x", "left_y"]),
        (["time", "id", "frame"], ["time", "id"]),
        (["x", "y", "y"], ["x", "y"]),
    ],
)
def test_what_is_proposed(names: list[str], meant: list[str]) -> None:
    assert not are_coordinates(names)
    assert coordinates_among(names) == meant


def test_other_packages_tables() -> None:
    polars, pyarrow = pytest.importorskip("polars"), pytest.importorskip("pyarrow")
    with pytest.raises(
        ValueError, match=r"choose: P\[\['strain', 'stress'\]\] for example, or P\.to_"
    ):
        curvewise.dtw(polars.from_pandas(TABLES["time"]), P)
    table = pyarrow.Table.from_pandas(TABLES["time"])
    message = (
        r"choose: P\.select\(\['strain', 'stress'\]\) .* or numpy\.column_stack\(P\.columns\) for"
    )
    with pytest.raises(ValueError, match=message):
        curvewise.dtw(table, P)
    assert curvewise.dtw(table.select(["strain", "stress"]), P) == 0.0
    assert curvewise.dtw(np.column_stack(table.columns), TABLES["time"].to_numpy()) == 0.0


def test_two_columns_and_what_prepares_curves_take_any_names() -> None:
    assert curvewise.dtw(logged(P)[["stress"]].assign(time=SECONDS), Q) > 0
    table = TABLES["time"]
    assert curves.trim(table, 1.0, 2.0, by=0).tolist() == table.to_numpy()[1:3].tolist()
    assert curves.resample(table, 7, by=0).shape == (7, 3)


def test_groups_of_polars_are_a_dict_to_be() -> None:
    polars = pytest.importorskip("polars")
    grouped = polars.from_pandas(logged(P, id=[1] * 4)).group_by("id")
    instead = "{key: group[['strain', 'stress']] for key, group in XA}"
    with pytest.raises(TypeError, match=f"^XA is a GroupBy; give {re.escape(instead)}$"):
        curvewise.cdist(grouped)
    assert curvewise.cdist(eval(instead, {"XA": grouped})).index.tolist() == [(1,)]


def test_a_dict_of_curves_is_no_curve() -> None:
    with pytest.raises(TypeError, match=r"list\(P\.values\(\)\) is a list of curves, for cdist$"):
        curvewise.dtw({"first": P, "second": Q}, P)
