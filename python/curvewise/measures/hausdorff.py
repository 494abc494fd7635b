"""The Hausdorff distance between the points of two curves. Time O(n m), memory O(n + m)."""

from __future__ import annotations

from typing import SupportsFloat

from .._core import hausdorff as compiled_hausdorff
from .._docstrings import filled
from .._options import Default, Metric, Order, Radius
from ..curves.inputs import CurveLike

__all__ = ["hausdorff"]


@filled()
def hausdorff(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = Default.metric,
    p: Order = Default.p,
    radius: Radius = Default.radius,
    cutoff: SupportsFloat | None = Default.cutoff,
) -> float:
    """Compute the Hausdorff distance between the points of two curves.

    It is the largest distance of a point of either curve from the other curve's points.

    Parameters
    ----------
    {curves}
    {metric}
    {cutoff}

    Returns
    -------
    float
        In units of the ground distance. Symmetric. The order of points does not matter.

    Raises
    ------
    {invalid}

    Notes
    -----
    The larger of the two that ``scipy.spatial.distance.directed_hausdorff`` returns for (P, Q)
    and (Q, P). At most the discrete Fréchet distance. Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.hausdorff([0, 1, 2, 3], [3, 0, 1])
    1.0
    """
    return compiled_hausdorff(P, Q, (metric, p, radius, cutoff))
