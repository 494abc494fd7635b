"""scipy: directed_hausdorff, in both directions for the distance that has none."""

from scipy.spatial.distance import directed_hausdorff

PACKAGE = "scipy"
LICENCE = "BSD-3-Clause"
CHECKS = {
    "hausdorff-directed": lambda P, Q: directed_hausdorff(P, Q)[0],
    "hausdorff": lambda P, Q: max(directed_hausdorff(P, Q)[0], directed_hausdorff(Q, P)[0]),
}
