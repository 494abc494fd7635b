"""Tracks of GeoPandas and MovingPandas compared in metres, with labels.

Importing this module adds the accessor ``curvewise`` to GeoDataFrames and GeoSeries of lines:
``tracks.curvewise.pdist("frechet")``. In a projected reference system, coordinates are converted to
metres. In a geographic one (degrees, longitude and latitude in this order, as in geometries),
distances of points are arcs on the sphere, ``metric="haversine"``. Heights and times are ignored.
The methods call :func:`curvewise.cdist` and its relatives, at their cost (``pip install
"curvewise[geopandas]"``).
"""

from __future__ import annotations

import inspect
from typing import Any, SupportsIndex

import numpy as np

from ._extras import extra
from ._names import names_alone
from ._options import Default
from .curves.inputs import Array
from .curves.labels import check_distinct
from .curves.reference_systems import check_degrees, warn_of_stretched_map
from .many.nearest import Index
from .many.pairwise import cdist, pdist
from .measures.registry import MEASURES, MeasureName

with extra("geopandas", "curvewise.geopandas needs geopandas"):
    # Absolute, so this is the package of that name and not this module.
    import geopandas
    import pandas

__all__ = ["Tracks"]
__dir__ = names_alone(__all__)


@pandas.api.extensions.register_dataframe_accessor("curvewise")
@pandas.api.extensions.register_series_accessor("curvewise")
class Tracks:
    """Lines on the Earth as curves, in metres or in degrees with arcs in metres.

    Parameters
    ----------
    data : GeoDataFrame, GeoSeries or TrajectoryCollection
        LineStrings with a reference system (``crs``); the labels are the index. For a collection of
        MovingPandas, the labels are the trajectories' ids.

    Attributes
    ----------
    curves : Series
        The points (x, y) of each line: metres in a projected system, else degrees.
    crs : pyproj.CRS
        The reference system.

    Raises
    ------
    TypeError
        If the data do not hold lines.
    ValueError
        If the reference system is missing, or a geometry is not a LineString.

    Warns
    -----
    UserWarning
        From every method, if lengths on the map differ by more than 2 % from those on the Earth.

    Notes
    -----
    pandas caches the accessor of an object: later changes of its lines have no effect.

    Examples
    --------
    >>> import geopandas
    >>> import curvewise.geopandas
    >>> from shapely import LineString
    >>> lines = {"up": LineString([(9, 50), (9, 51)]), "away": LineString([(9, 50), (10, 51)])}
    >>> tracks = geopandas.GeoSeries(lines, crs="EPSG:4326")
    >>> print(tracks.curvewise.cdist(measure="frechet").round())
               up     away
    up        0.0  69977.0
    away  69977.0      0.0
    """

    def __init__(self, data: Any) -> None:
        labels, lines, crs = _lines_of(data)
        if crs is None:
            raise ValueError(
                "the tracks have no reference system, so that their units are not known: give them "
                'one, tracks.set_crs("EPSG:4326") for degrees, or compare them as numbers by '
                "curvewise.cdist(tracks.geometry)"
            )
        self.crs = crs
        self._lines = lines
        metres = 1.0 if crs.is_geographic else float(crs.axis_info[0].unit_conversion_factor)
        curves = [
            _points_of(line, label) * metres for line, label in zip(lines, labels, strict=True)
        ]
        self.curves = pandas.Series(curves, index=labels, dtype=object)

    def pdist(self, measure: MeasureName = "dtw", **options: Any) -> Any:
        """Compute a symmetric measure between every two tracks.

        Parameters
        ----------
        measure : str
            A measure by its name, see :func:`curvewise.available_measures`.
        **options
            The options of :func:`curvewise.pdist`, lengths in metres.

        Returns
        -------
        Series
            The values by pairs of labels; in metres if the measure is a length.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.pdist`; if a measure does not support degrees.
        """
        return pdist(self.curves, measure, **self._on_earth(measure, options))

    def cdist(self, other: Any = None, measure: MeasureName = "dtw", **options: Any) -> Any:
        """Compute a measure between all tracks and those of `other`, or all pairs.

        Parameters
        ----------
        other : GeoDataFrame, GeoSeries or TrajectoryCollection, optional
            Tracks in the same reference system.
        measure : str
            A measure by its name, see :func:`curvewise.available_measures`.
        **options
            The options of :func:`curvewise.cdist`, lengths in metres.

        Returns
        -------
        DataFrame
            The values with the labels; in metres if the measure is a length.

        Raises
        ------
        ValueError, TypeError
            As for :func:`curvewise.cdist`; if a measure does not support degrees, or `other` has
            another reference system.
        """
        second = None if other is None else self._beside(other)
        return cdist(self.curves, second, measure, **self._on_earth(measure, options))

    def index(self, measure: MeasureName = "dtw", **options: Any) -> Index:
        """Build an index of the tracks for nearest-neighbour queries.

        Parameters
        ----------
        measure : str
            A measure by its name, see :func:`curvewise.available_measures`.
        **options
            The options of the measure, lengths in metres.

        Returns
        -------
        Index
            The index finds neighbours without computing all distances. Its radii and distances are
            in metres if the measure is a length. Query it with the attribute `curves` of other
            tracks.

        Raises
        ------
        ValueError, TypeError
            As for :class:`curvewise.Index`; if a measure does not support degrees.
        """
        return Index(self.curves, measure, **self._on_earth(measure, options))

    def nearest(
        self,
        other: Any = None,
        n_neighbors: SupportsIndex = 1,
        measure: MeasureName = "dtw",
        *,
        workers: SupportsIndex = Default.workers,
        **options: Any,
    ) -> Any:
        """Find the nearest tracks of each track of `other`, or of these tracks.

        Parameters
        ----------
        other : GeoDataFrame, GeoSeries or TrajectoryCollection, optional
            Tracks in the same reference system. By default the neighbours of these tracks are
            found; a track does not count as its own neighbour.
        n_neighbors : int
            Number of neighbours.
        measure : str
            A measure by its name, see :func:`curvewise.available_measures`.
        workers : int
            Number of threads: at least 1, or -1 for one per core. Does not change a result.
        **options
            The options of the measure, lengths in metres.

        Returns
        -------
        distances, labels : DataFrame
            A row for each track, a column for each neighbour, the nearest first.

        Raises
        ------
        ValueError, TypeError
            As for :meth:`curvewise.Index.kneighbors`, and for :meth:`cdist`.
        """
        asked = None if other is None else self._beside(other)
        return self.index(measure, **options).kneighbors(asked, n_neighbors, workers=workers)

    def clusters(
        self,
        n_clusters: SupportsIndex,
        measure: MeasureName = "dtw",
        *,
        workers: SupportsIndex = Default.workers,
        **options: Any,
    ) -> Any:
        """Divide the tracks into clusters, each around one of them, its medoid.

        Parameters
        ----------
        n_clusters : int
            Number of clusters.
        measure : str
            A measure by its name, see :func:`curvewise.available_measures`.
        workers : int
            Threads: at least 1, or -1 for one per core. Never changes a result.
        **options
            The options of the measure, lengths in metres.

        Returns
        -------
        Series
            For each track the label of its cluster's medoid.

        Raises
        ------
        ValueError, TypeError
            As for :class:`curvewise.sklearn.CurveKMedoids`, and for :meth:`cdist`.
        ImportError
            If scikit-learn is missing: ``pip install "curvewise[sklearn]"``.
        """
        from .sklearn import CurveKMedoids

        check_distinct(self.curves.index, "tracks")
        known = self._on_earth(measure, options)
        found = CurveKMedoids(n_clusters, measure=measure, options=known, workers=workers)
        found.fit(list(self.curves))
        medoids = self.curves.index[found.medoid_indices_[found.labels_]]
        return pandas.Series(medoids, index=self.curves.index, name="medoid")

    def _on_earth(self, measure: MeasureName, options: dict[str, Any]) -> dict[str, Any]:
        """Return the options of a measure with the distance of points on the sphere, if in degrees.

        Without that, a degree of longitude would count as much as one of latitude.
        """
        if not self.crs.is_geographic:
            warn_of_stretched_map(self.crs, self._lines, "tracks")
            return options
        check_degrees(self.crs, "tracks")
        info = MEASURES.get(measure)
        if info and "metric" not in inspect.signature(info.function).parameters:
            raise ValueError(
                f"{measure} is for points in a plane, and the tracks are in degrees "
                f"({self.crs.name}): project them, "
                "tracks.to_crs(tracks.estimate_utm_crs()) for example"
            )
        return {"metric": "haversine", **options}

    def _beside(self, other: Any) -> Any:
        """Return other tracks' curves, which must be in the same reference system."""
        others = other if isinstance(other, Tracks) else Tracks(other)
        if others.crs != self.crs:
            raise ValueError(
                f"the tracks are in {self.crs.name}, the others in {others.crs.name}: "
                "other.to_crs(tracks.crs)"
            )
        return others.curves


def _lines_of(data: Any) -> tuple[Any, list[Any], Any]:
    """Return labels, geometries and the reference system."""
    if isinstance(data, geopandas.GeoDataFrame | geopandas.GeoSeries):
        geometry = data.geometry
        return geometry.index, list(geometry), geometry.crs
    if hasattr(data, "trajectories"):  # of MovingPandas
        found = data.trajectories
        labels = pandas.Index([one.id for one in found], name=data.get_traj_id_col())
        return labels, [one.to_linestring() for one in found], found[0].df.crs if found else None
    raise TypeError(
        f"the tracks are a {type(data).__name__}; give a GeoDataFrame or a GeoSeries of lines, or "
        "a TrajectoryCollection of MovingPandas"
    )


def _points_of(line: Any, label: Any) -> Array:
    """Return the points (x, y) of a line, without heights."""
    kind = getattr(line, "geom_type", "missing")
    if kind not in ("LineString", "LinearRing"):
        raise ValueError(
            f"the geometry of {label!r} is {kind}, not a LineString: tracks.explode() divides "
            "several lines, movingpandas.TrajectoryCollection makes lines of points"
        )
    return np.asarray(line.coords, dtype=np.float64)[:, :2]
