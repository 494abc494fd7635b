"""Checks the reference system of tracks before distances are computed.

A GeoDataFrame and a GeoSeries have a reference system. Degrees are not coordinates of a plane. A
plane map, such as Web Mercator, may have a large scale distortion. Tracks of two systems cannot be
compared. The distortion is taken from PROJ, at some points of the tracks (Tissot's indicatrix;
Snyder, Map Projections, 1987). Nothing is imported for tracks without a reference system.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

import numpy as np

from .foreign_curves import warn

__all__ = ["check_degrees", "check_reference_systems", "warn_of_stretched_map"]

_STRETCH = 0.02  # of lengths on a map, which is passed over
_LINES = 50  # number of lines whose ends are checked


def check_reference_systems(
    options: Mapping[str, Any], *, measure: Any = None, known: Any = None, **collections: Any
) -> Any:
    """Return the reference system of collections of curves; None if it is not known.

    Parameters
    ----------
    options : mapping
        The options of the measure.
    measure : str or callable
        The measure; a callable, as a callable metric, may know what degrees are.
    known : pyproj.CRS, optional
        The system of curves that were given before.
    **collections
        The collections by their names.

    Raises
    ------
    ValueError
        If degrees are used with the distance of a plane, or the reverse. If there are two reference
        systems.

    Warns
    -----
    UserWarning
        Lengths on the map differ from those on the Earth by more than 2 %.
    """
    first, first_name = known, "the curves before"
    for name, curves in collections.items():
        crs: Any = getattr(curves, "crs", None)
        if not hasattr(crs, "is_geographic"):  # of a GeoDataFrame and a GeoSeries
            continue
        if first is not None and not crs.equals(first, ignore_axis_order=True):
            raise ValueError(
                f"{name} is in {crs.name}, and {first_name} in {first.name}; give "
                f"{name}.to_crs({first.to_string()!r})"
            )
        first, first_name = crs, name
        if not callable(measure) and not callable(options.get("metric")):
            _check_metric(crs, name, options.get("metric"))
        if crs.is_projected:
            warn_of_stretched_map(crs, list(getattr(curves, "geometry", curves)), name)
    return first


def _check_metric(crs: Any, name: str, metric: Any) -> None:
    """Refuse degrees in a plane, and a plane on the sphere."""
    on_sphere = isinstance(metric, str) and metric == "haversine"
    if crs.is_geographic and not on_sphere:
        raise ValueError(
            f"{name} is in degrees ({crs.name}), which are not lengths; give metric='haversine' "
            f"for metres, {name}.to_crs({name}.estimate_utm_crs()), or use the accessor "
            f"{name}.curvewise of curvewise.geopandas; list({name}.geometry) has the bare numbers"
        )
    if on_sphere and crs.is_projected:
        raise ValueError(
            f"{name} is in a plane ({crs.name}), and metric='haversine' takes degrees; leave the "
            f"metric out, or give {name}.to_crs('EPSG:4326')"
        )
    if on_sphere:
        check_degrees(crs, name)


def check_degrees(crs: Any, name: str) -> None:
    """Refuse a geographic system whose angles have another unit."""
    for axis in crs.axis_info[:2]:
        if axis.unit_name != "degree":
            raise ValueError(
                f"{name} is in units of {axis.unit_name} ({crs.name}), and "
                f"metric='haversine' takes degrees; give {name}.to_crs('EPSG:4326')"
            )


def warn_of_stretched_map(crs: Any, lines: list[Any], name: str) -> None:
    """Warn if lengths on a map are not those on the Earth."""
    stretch = _stretch_of(crs, lines)
    if abs(stretch - 1.0) > _STRETCH:
        warn(
            f"lengths in {crs.name} are up to {stretch:.3g} times those on the Earth where {name} "
            f"lies; give a local projection, {name}.to_crs({name}.estimate_utm_crs())"
        )


def _stretch_of(crs: Any, lines: list[Any]) -> float:
    """Return the scale of a map at the ends of some lines: the one that is farthest from 1."""
    pyproj = import_module("pyproj")
    step = max(1, -(-len(lines) // _LINES))
    ends = [
        line.coords[end][:2]
        for line in lines[::step]
        for end in (0, -1)
        if getattr(line, "geom_type", "") in ("LineString", "LinearRing") and not line.is_empty
    ]
    if not ends:
        return 1.0
    to_degrees = pyproj.Transformer.from_crs(crs, crs.geodetic_crs, always_xy=True)
    places = to_degrees.transform(*np.transpose(ends))
    factors = pyproj.Proj(crs).get_factors(*places)
    scales = np.concatenate([factors.tissot_semimajor, factors.tissot_semiminor])
    scales = scales[np.isfinite(scales) & (scales > 0.0)]
    return float(scales[np.argmax(np.abs(np.log(scales)))]) if len(scales) else 1.0
