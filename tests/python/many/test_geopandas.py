"""curvewise.geopandas: metres by the reference system, labels, MovingPandas and its own tests."""

from __future__ import annotations

from importlib.util import find_spec
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import curvewise

# Importing geopandas takes seconds.
pytestmark = [
    pytest.mark.skipif(
        find_spec("geopandas") is None, reason='no geopandas: pip install "curvewise[geopandas]"'
    ),
    pytest.mark.nightly,
]
needs_movingpandas = pytest.mark.skipif(
    find_spec("movingpandas") is None, reason="no movingpandas: pip install movingpandas"
)


@pytest.fixture
def tracks() -> Any:
    """Six tracks near (9, 50), of 5 to 10 points, in degrees."""
    import geopandas
    from shapely import LineString

    import curvewise.geopandas  # noqa: F401  # for the accessor

    random = np.random.default_rng(2)
    steps = [random.normal(0, 0.01, (5 + k, 2)).cumsum(axis=0) for k in range(6)]
    lines = [LineString(step + np.array([9, 50])) for step in steps]
    return geopandas.GeoDataFrame({"who": list("abcdef")}, geometry=lines, crs=4326).set_index(
        "who"
    )


def points(frame: Any) -> list[np.ndarray]:
    return [np.asarray(line.coords) for line in frame.geometry]


@pytest.mark.parametrize("measure", ["dtw", "frechet", "hausdorff", "erp", "lcss"])
def test_degrees_are_arcs_on_the_sphere(tracks: Any, measure: Any) -> None:
    options = {"epsilon": 500.0} if measure == "lcss" else {}
    expected = curvewise.cdist(points(tracks), measure=measure, metric="haversine", **options)
    found = tracks.curvewise.cdist(measure=measure, workers=2, **options)
    assert_array_equal(found, expected)
    assert list(found.index) == list(found.columns) == list("abcdef")
    assert tracks.curvewise.pdist(measure, **options)["b", "e"] == expected[1, 4]


def test_an_arc_of_one_degree() -> None:
    import geopandas
    from shapely import LineString

    import curvewise.geopandas  # noqa: F401  # for the accessor

    lines = [LineString([(9, 50), (9, 51)]), LineString([(9, 51), (9, 52)])]
    apart = geopandas.GeoSeries(lines, crs=4326).curvewise.pdist("frechet")
    assert_allclose(apart, np.radians(1) * 6371008.8, rtol=1e-12)


def test_projected_systems_are_metres(tracks: Any) -> None:
    from pyproj import CRS

    utm = tracks.to_crs(tracks.estimate_utm_crs())
    expected = curvewise.cdist(points(utm), measure="frechet_continuous")
    found = utm.curvewise.cdist(measure="frechet_continuous")
    assert_array_equal(found, expected)
    assert_allclose(found["a"], tracks.curvewise.cdist(measure="frechet")["a"], rtol=0.5)
    feet = CRS.from_proj4("+proj=utm +zone=32 +datum=WGS84 +units=ft")
    in_feet = tracks.to_crs(feet).curvewise.cdist(measure="frechet_continuous")
    assert_allclose(in_feet, expected, rtol=1e-9, atol=1e-6)


def test_heights_do_not_count(tracks: Any) -> None:
    import shapely

    high = tracks.set_geometry(shapely.force_3d(tracks.geometry, 99.0), crs=4326)
    assert high.curvewise.pdist("frechet").equals(tracks.curvewise.pdist("frechet"))


def test_nearest_and_clusters_have_labels(tracks: Any) -> None:
    matrix = tracks.curvewise.cdist(measure="frechet")
    distances, labels = tracks.curvewise.nearest(n_neighbors=2, measure="frechet")
    for who in "abcdef":
        near = matrix.loc[who].drop(who).sort_values(kind="stable")
        assert list(labels.loc[who]) == list(near.index[:2])
        assert list(distances.loc[who]) == list(near[:2])
    _, of_others = tracks[:4].curvewise.nearest(tracks[4:], measure="frechet")
    assert list(of_others[0]) == [matrix.loc[who, list("abcd")].idxmin() for who in "ef"]
    medoids = tracks.curvewise.clusters(2, "frechet")
    assert set(medoids) <= set("abcdef")
    assert medoids.nunique() == 2
    for who, medoid in medoids.items():
        assert matrix.loc[who, medoid] == matrix.loc[who, medoids.unique()].min()


def test_errors(tracks: Any) -> None:
    import curvewise.geopandas

    with pytest.raises(ValueError, match=r"frechet_continuous is for points in a plane, and the t"):
        tracks.curvewise.pdist("frechet_continuous")
    with pytest.raises(ValueError, match="msm is for points in a plane"):
        tracks.curvewise.index("msm")
    with pytest.raises(ValueError, match=r"the others in WGS 84 / UTM zone 32N: other.to_crs\(tra"):
        tracks.curvewise.cdist(tracks.to_crs(32632))
    with pytest.raises(ValueError, match="the tracks have no reference system"):
        _ = tracks.set_crs(None, allow_override=True).curvewise
    with pytest.raises(ValueError, match="the geometry of 'a' is Point, not a LineString"):
        _ = tracks.to_crs(32632).centroid.curvewise
    with pytest.raises(TypeError, match="the tracks are a list; give a GeoDataFrame or a GeoSeri"):
        curvewise.geopandas.Tracks([1])
    with pytest.raises(ValueError, match=r"measure = 'nearly'|unknown measure|'nearly'"):
        tracks.curvewise.pdist("nearly")


@needs_movingpandas
def test_a_collection_of_movingpandas(tracks: Any) -> None:
    import movingpandas
    import pandas as pd

    from curvewise.geopandas import Tracks

    vertices = tracks.get_coordinates().reset_index()
    vertices["time"] = pd.date_range("2026-01-01", periods=len(vertices), freq="min")
    collection = movingpandas.TrajectoryCollection(
        vertices, "who", t="time", x="x", y="y", crs="EPSG:4326"
    )
    found = Tracks(collection).cdist(measure="dtw")
    assert_array_equal(found, tracks.curvewise.cdist(measure="dtw"))
    assert list(found.index) == list("abcdef")


def behind(movingpandas: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """Replace the distance function of MovingPandas by curvewise."""
    import shapely

    def distance(measure: Any) -> Any:
        return lambda P, Q: measure(np.asarray(P.coords), np.asarray(Q.coords))

    trajectory = movingpandas.Trajectory
    theirs = trajectory._lcss_match_count

    def matches(P: Any, Q: Any, epsilon: float, delta: int | None) -> int:
        if delta is not None:  # of indices, which is another band where the lengths differ
            return theirs(P, Q, epsilon, delta)
        return round((1 - curvewise.lcss(P, Q, epsilon=epsilon)) * min(len(P), len(Q)))

    monkeypatch.setattr(trajectory, "_dtw_cost_exact", staticmethod(curvewise.dtw))
    monkeypatch.setattr(trajectory, "_lcss_match_count", staticmethod(matches))
    monkeypatch.setattr(shapely, "frechet_distance", distance(curvewise.frechet))
    monkeypatch.setattr(shapely.LineString, "hausdorff_distance", distance(curvewise.hausdorff))


@needs_movingpandas
@pytest.mark.filterwarnings("ignore")
def test_the_tests_of_movingpandas_pass_with_curvewise_behind(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import movingpandas
    from movingpandas.tests.test_trajectory import TestTrajectory

    words = ("hausdorff_distance", "frechet_distance", "dtw_distance", "lcss_distance")
    names = [name for name in dir(TestTrajectory) if name.startswith("test_")]
    chosen = [name for name in names if any(word in name for word in words)]
    chosen.remove("test_frechet_distance_requires_shapely_2")  # which takes the function away
    assert len(chosen) > 20
    behind(movingpandas, monkeypatch)
    for name in chosen:
        test = TestTrajectory()
        test.setup_method()
        getattr(test, name)()
