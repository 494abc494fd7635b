"""Tracks with a reference system are never compared in another one."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable
from importlib.util import find_spec
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


def tracks_at(longitude: float, latitude: float, crs: Any = 4326) -> Any:
    import geopandas
    from shapely import LineString

    import curvewise.geopandas  # noqa: F401  # for the accessor

    steps = np.random.default_rng(3).normal(0, 0.01, (4, 6, 2)).cumsum(axis=1)
    lines = [LineString(step + np.array([longitude, latitude])) for step in steps]
    frame = geopandas.GeoDataFrame(geometry=lines, crs=4326, index=list("abcd"))
    return frame.to_crs(crs)


def by_sklearn(name: str) -> Callable[..., Any]:
    def fit(X: Any, measure: str = "frechet", **options: Any) -> Any:
        module = pytest.importorskip("curvewise.sklearn", exc_type=ImportError)
        estimator = getattr(module, name)(1, measure=measure, options=options)
        return estimator.fit(X, [0] * len(X)).predict(X)

    return fit


def by_dask(name: str) -> Callable[..., Any]:
    def call(X: Any, measure: str = "dtw", **options: Any) -> Any:
        module = pytest.importorskip("curvewise.dask", exc_type=ImportError)
        arguments = (X, X, 1) if name == "kneighbors" else (X,)
        return getattr(module, name)(*arguments, measure=measure, **options)

    return call


ENTRIES: dict[str, Callable[..., Any]] = {
    "pdist": curvewise.pdist,
    "cdist": curvewise.cdist,
    "cdist of points": lambda X, **options: curvewise.cdist([np.zeros((3, 2))], X, **options),
    "Index": lambda X, **options: curvewise.Index(X, **options),
    "Index.add": lambda X, **options: _index(X, **options).add(X),
    "queries": lambda X, **options: _index(X, **options).kneighbors(X, 1),
    "Prepared": lambda X, **options: curvewise.Prepared(np.zeros((3, 2)), **options)(X),
    "medoid": curvewise.medoid,
    "classifier": by_sklearn("CurveKNeighborsClassifier"),
    "medoids": by_sklearn("CurveKMedoids"),
    "means": by_sklearn("CurveKMeans"),
    "dask.pdist": by_dask("pdist"),
    "dask.cdist": by_dask("cdist"),
    "dask.kneighbors": by_dask("kneighbors"),
}


def _index(X: Any, **options: Any) -> curvewise.Index:
    return curvewise.Index(dict(enumerate(np.zeros((1, 3, 2)))), **options)


@pytest.mark.parametrize("entry", ENTRIES)
def test_every_entry_knows_degrees_and_stretched_maps(entry: str) -> None:
    call, frame = ENTRIES[entry], tracks_at(11.5, 48)
    for X in (frame, frame.geometry):
        with pytest.raises(ValueError, match=r"is in degrees \(WGS 84\), .* metric='haversine'"):
            call(X)
        call(X, measure="frechet", metric="haversine")
        mercator = X.to_crs(3857)
        with pytest.warns(UserWarning, match=r"up to 1\.\d+ times .*\.to_crs\(\w+\.estimate_utm"):
            call(mercator)
        plane = X.to_crs(32632)
        call(plane)  # warnings are errors
        with pytest.raises(ValueError, match=r"is in a plane \(WGS 84 / UTM zone 32N\), and"):
            call(plane, measure="frechet", metric="haversine")
        call(X.set_crs(None, allow_override=True))


@pytest.mark.parametrize("mean", [curvewise.dtw_mean, curvewise.soft_dtw_mean])
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_means_are_of_a_plane(mean: Any) -> None:
    with pytest.raises(ValueError, match=r"curves is in degrees \(WGS 84\)"):
        mean(tracks_at(9, 50), iterations=1)
    mean(tracks_at(9, 50, 32632), iterations=1)


def test_metres_are_those_of_the_accessor() -> None:
    frame = tracks_at(9, 50)
    metres = frame.curvewise.cdist(measure="frechet")
    assert_array_equal(curvewise.cdist(frame, measure="frechet", metric="haversine"), metres)
    index = curvewise.Index(frame, "frechet", metric="haversine")
    nearest, _ = index.radius_neighbors(frame[:1], 1.0)
    assert list(nearest["a"]) == [0.0]


def test_what_a_function_knows_is_not_asked() -> None:
    frame = tracks_at(9, 50)
    assert curvewise.pdist(frame, lambda P, Q: len(P)).tolist() == [6.0] * 6
    curvewise.pdist(frame, metric=lambda p, q: np.abs(p[:, np.newaxis] - q).sum(axis=2))


def test_two_reference_systems_are_not_compared() -> None:
    frame, plane = tracks_at(9, 50), tracks_at(9, 50, 32632)
    options: dict[str, Any] = {"measure": "frechet", "metric": "haversine"}
    with pytest.raises(ValueError, match=r"^XB is in WGS 84 / UTM zone 32N, and XA in WGS 84; giv"):
        curvewise.cdist(frame, plane, **options)
    index = pickle.loads(pickle.dumps(curvewise.Index(frame, **options)))
    for call in (index.kneighbors, index.radius_neighbors, index.add):
        with pytest.raises(ValueError, match=r"to_crs\('EPSG:4326'\)$"):
            call(plane)
    classifier = pytest.importorskip("curvewise.sklearn").CurveKNeighborsClassifier(1)
    classifier.fit(plane, list("abcd"))
    with pytest.raises(ValueError, match="is in WGS 84 / UTM zone 33N, and the curves before in "):
        classifier.predict(plane.to_crs(32633))


@pytest.mark.parametrize(
    ("crs", "longitude", "latitude", "stretch"),
    [
        *((3857, 11.5, 48.1, 1.5), (3395, 11.5, 48.1, 1.5), (4087, 11.5, 48.1, 1.5)),
        *((3857, 103.8, 1.3, None), (32632, 11.5, 48.1, None), (3035, -4, 40, None)),
        *((27700, -1, 52, None), (2263, -74, 40.7, None), ("ESRI:102100", 10, -60, 2.0)),
    ],
)
def test_how_much_a_map_is_stretched(
    crs: Any, longitude: float, latitude: float, stretch: float | None
) -> None:
    frame = tracks_at(longitude, latitude, crs)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        frame.curvewise.pdist("frechet")
        curvewise.pdist(frame, "frechet")
    assert len(caught) == (0 if stretch is None else 2)
    assert all(one.filename == __file__ for one in caught)
    for one in caught:
        said = float(str(one.message).partition("up to ")[2].split()[0])
        assert_allclose(said, stretch, rtol=0.02)


def test_angles_in_other_units_are_refused() -> None:
    frame = tracks_at(2, 48, 4807)  # grads from Paris
    for call in (
        lambda: frame.curvewise.pdist("frechet"),
        lambda: curvewise.pdist(frame, "frechet", metric="haversine"),
    ):
        with pytest.raises(ValueError, match=r"is in units of grad \(NTF \(Paris\)\), and metric"):
            call()
