"""One curve for many: their mean under dtw, and the one among them that is nearest to all others.

The mean is that of Petitjean, Ketterlin & Gançarski, "A global averaging method for dynamic time
warping, with applications to clustering" (2011), found by the compiled library.
"""

from __future__ import annotations

from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from .._core import check_batch, is_symmetric
from .._core import dtw_mean as compiled_dtw_mean
from .._docstrings import filled
from .._options import Default, Window, real_number
from .._progress import Report, reporting
from ..curves.inputs import Array, CurveLike, as_curve, as_curve_list
from ..measures.registry import MeasureName
from ..measures.results import DtwMean
from .pairwise import Curves, _check_names, cdist

__all__ = ["dtw_mean", "medoid"]

# Curves of which the medoid is the initial mean, where the caller gives none: their distances take
# about as long as a few rounds.
_CURVES_FOR_START = 50

# Distances that are held at once.
_BLOCK = 1 << 20


@filled()
def dtw_mean(
    curves: Curves,
    *,
    initial: CurveLike | None = None,
    weights: npt.ArrayLike | None = None,
    window: Window = Default.window,
    iterations: SupportsIndex = 30,
    tolerance: SupportsFloat = 1e-6,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
) -> DtwMean:
    """Compute the mean of curves under dtw: DTW barycentre averaging (DBA).

    The curve with the smallest weighted sum of ``dtw(mean, curve, metric="sqeuclidean")``, or
    rather a local minimum of that sum, which depends on the initial curve.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d.
    initial : array_like, shape (n, d), optional
        Where to begin, with as many points as the mean will have. If not given, the medoid of the
        curves, or of 50 of them, evenly spaced in their list.
    weights : array_like, shape (k,), optional
        How much each curve counts, at least 0; not all 0.
    window : int >= 0, or float between 0 and 1, optional
        As for :func:`curvewise.dtw`.
    iterations : int >= 0
        How often the mean is moved at most.
    tolerance : float >= 0
        Ends where a move lowers the sum by no more than this part of it.
    {workers}
    progress : bool or callable
        As for :func:`curvewise.cdist`; counts cells, and ends early where the mean converges.

    Returns
    -------
    DtwMean
        The mean, the sum after every move, and whether it has converged.

    Raises
    ------
    ValueError
        What dtw refuses, with the curve's place (``curves[3]``); no curves; an option or a weight
        out of range.
    TypeError
        A curve does not hold real numbers.
    ImportError
        ``progress=True`` without tqdm: ``pip install "curvewise[progress]"``.

    Notes
    -----
    Each round finds the best path from the mean to every curve, and moves each point of the mean to
    the weighted mean of the points that are matched to it: neither can raise the sum. Time O(n m) a
    curve and round; memory O(n + m) and a few paths. Petitjean, Ketterlin & Gançarski (2011).

    Examples
    --------
    >>> import curvewise
    >>> mean = curvewise.dtw_mean([[0, 0, 2, 0], [0, 2, 2, 0], [0, 0, 0, 5, 0]], initial=[0, 1, 0])
    >>> mean.curve.tolist()
    [0.0, 2.75, 0.0]
    """
    given = as_curve_list(curves, "curves")
    if initial is None:
        chosen = given[:: max(1, -(-len(given) // _CURVES_FOR_START))]
        start = given[0] if len(chosen) < 2 else chosen[_start_of(chosen, window, workers)]
    else:
        start = as_curve(initial, "initial")
    if weights is not None and np.ndim(weights) != 1:
        raise ValueError(f"weights has {np.ndim(weights)} array dimensions; give one number each")
    counts = [
        real_number(f"weights[{i}]", weight, -np.inf, "give a finite number >= 0")
        for i, weight in enumerate([] if weights is None else np.asarray(weights).tolist())
    ]
    limit = real_number("tolerance", tolerance, -np.inf, "give a number >= 0")
    with reporting(progress) as report:
        mean, costs, converged = compiled_dtw_mean(
            given, counts, start, window, iterations, limit, workers, report
        )
    return DtwMean(mean, costs, converged)


def _start_of(curves: list[Array], window: Window, workers: SupportsIndex) -> int:
    return medoid(curves, "dtw", metric="sqeuclidean", window=window, workers=workers)


@filled()
def medoid(
    curves: Curves,
    measure: MeasureName = "dtw",
    *,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
    **options: Any,
) -> int:
    """Find the curve with the smallest sum of distances from all curves of a list.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d.
    measure : {measures}
        A measure by its name. Where it is not symmetric, the others are P and the medoid is Q.
    {workers}
    progress : bool or callable
        As for :func:`curvewise.cdist`; counts pairs.
    **options
        Those of the measure's own function.

    Returns
    -------
    int
        Its index; of equal sums the first.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`curvewise.cdist`; ValueError where there are no curves.

    Notes
    -----
    Time: that of all pairs, each computed once where the measure is symmetric. Memory: some 10^6
    distances at a time.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.medoid([[0, 0, 0], [0, 1, 0], [0, 4, 0]])
    1
    """
    given = as_curve_list(curves, "curves")
    if not given:
        raise ValueError("no curves; a medoid needs at least 1")
    name = _check_names(measure, options)
    halves = is_symmetric(name, options)
    check_batch(given, None, name, options)  # A block cannot say where a curve is.
    sums = np.zeros(len(given))
    size = max(1, _BLOCK // len(given))
    with reporting(progress) as report:
        for begin in range(0, len(given), size):
            end = min(begin + size, len(given))
            first = begin if halves else 0
            block = cdist(given[begin:end], given[first:], measure, workers=workers, **options)
            sums[first:] += block.sum(axis=0)
            if halves:
                sums[begin:end] += block[:, end - begin :].sum(axis=1)
            if report is not None:
                report(end, len(given))
    return int(np.argmin(sums))
