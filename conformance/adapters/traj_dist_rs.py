"""traj-dist-rs: distances of trajectories in the plane."""

import traj_dist_rs as package

PACKAGE = "traj-dist-rs"
LICENCE = "MIT"


def plane(call):
    """Return a call for curves in the plane."""

    def checked(P, Q):
        if P.shape[1] != 2:
            raise NotImplementedError("trajectories in the plane")
        found = call(P, Q)
        return getattr(found, "distance", found)

    return checked


CHECKS = {
    "frechet": plane(lambda P, Q: package.discret_frechet(P, Q, "euclidean")),
    "frechet-continuous": plane(package.frechet),
    "hausdorff": plane(lambda P, Q: package.hausdorff(P, Q, "euclidean")),
    "dtw": plane(lambda P, Q: package.dtw(P, Q, "euclidean")),
}
OTHER = {"hausdorff": "from the points of one trajectory to the segments of the other"}
