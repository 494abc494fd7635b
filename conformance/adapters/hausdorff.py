"""hausdorff: the Hausdorff distance of points."""

from hausdorff import hausdorff_distance

PACKAGE = "hausdorff"
LICENCE = "GPL-3.0"
CHECKS = {"hausdorff": lambda P, Q: hausdorff_distance(P, Q, distance="euclidean")}
