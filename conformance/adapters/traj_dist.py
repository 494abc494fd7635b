"""traj-dist: distances of trajectories in the plane, its compiled functions."""

import traj_dist.distance as package

PACKAGE = "traj-dist"
LICENCE = "MIT"


def plane(call):
    """Return a call for curves in the plane."""

    def checked(P, Q):
        if P.shape[1] != 2:
            raise NotImplementedError("trajectories in the plane")
        return call(P, Q)

    return checked


CHECKS = {
    "frechet": plane(package.discret_frechet),
    "frechet-continuous": plane(package.frechet),
    "hausdorff": plane(package.hausdorff),
    "dtw": plane(package.dtw),
}
OTHER = {"hausdorff": "from the points of one trajectory to the segments of the other"}
