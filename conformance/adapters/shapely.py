"""shapely (GEOS): discrete Fréchet and Hausdorff distances of two lines in the plane."""

from shapely import LineString, frechet_distance, hausdorff_distance

PACKAGE = "shapely"
LICENCE = "BSD-3-Clause (GEOS: LGPL-2.1)"


def line(curve):
    """Return a geometry; it keeps two coordinates for distances."""
    if curve.shape[1] != 2:
        raise NotImplementedError("distances in the plane")
    return LineString(curve)


CHECKS = {
    "frechet": lambda P, Q: frechet_distance(line(P), line(Q)),
    "hausdorff": lambda P, Q: hausdorff_distance(line(P), line(Q)),
}
OTHER = {"hausdorff": "from the vertices of one line to the nearest place of the other line"}
NOTES = {"frechet": "the case leash-past-a-corner has a coupling with the right value"}
