"""linmdtw: exact dtw in linear memory, on the processor; the cost of its path."""

import linmdtw

PACKAGE = "linmdtw"
LICENCE = "Apache-2.0"


def distance(P, Q):
    """Return the cost of the path, which is what linmdtw returns."""
    path = linmdtw.linmdtw(P, Q, do_gpu=False)[1]
    return linmdtw.get_path_cost(P, Q, path)


CHECKS = {"dtw": distance}
