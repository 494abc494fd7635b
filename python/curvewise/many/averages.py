"""One curve for many: their mean under dtw or soft_dtw, and the nearest of them to all others.

The mean is that of Petitjean, Ketterlin & Gançarski, "A global averaging method for dynamic time
warping, with applications to clustering" (2011), found by the compiled library. That under soft_dtw
(Cuturi & Blondel 2017) is found by scipy's L-BFGS-B, from the compiled library's derivatives.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import Any, SupportsFloat, SupportsIndex, overload

import numpy as np
import numpy.typing as npt

from .._core import check_batch, is_symmetric
from .._core import dtw_mean as compiled_dtw_mean
from .._extras import extra
from .._options import Default, Window, real_number, whole_number
from .._progress import Report, reporting
from ..curves.foreign_curves import warn
from ..curves.inputs import Array, CurveLike, as_curve, as_curve_list, copy_of
from ..curves.labels import check_distinct, in_order_of, unlabelled
from ..curves.layouts import Layout, settled_layout
from ..curves.reference_systems import check_reference_systems
from ..drawing.figures import evenly
from ..measures.gradient import values_and_gradients
from ..measures.registry import MeasureName
from ..measures.results import DtwMean
from .pairwise import Curves, LabelledCurves, _check_names, cdist

__all__ = ["dtw_mean", "medoid", "soft_dtw_mean", "soft_mean"]

# Number of curves whose medoid is the default initial mean: their distances take about as long as a
# few rounds.
_CURVES_FOR_START = 50

# A mean of up to this number of curves keeps copies for its plot.
_CURVES_SHOWN = 50

# Distances that are held at once.
_BLOCK = 1 << 20


# Shared text: workers, layout
def dtw_mean(
    curves: Curves | LabelledCurves,
    *,
    initial: CurveLike | None = None,
    weights: npt.ArrayLike | None = None,
    window: Window = Default.window,
    iterations: SupportsIndex = 30,
    tolerance: SupportsFloat = 1e-6,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
    layout: Layout | None = None,
) -> DtwMean:
    """Compute the mean of curves under dtw: DTW barycentre averaging (DBA).

    The mean is the curve with the smallest weighted sum of ``dtw(mean, curve,
    metric="sqeuclidean")``. The result is a local minimum of that sum, which depends on the initial
    curve.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d.
    initial : array_like, shape (n, d), optional
        The initial mean; it has the number of points of the result. By default the medoid of the
        curves, or of 50 of them, evenly spaced in their list.
    weights : array_like, shape (k,), optional
        The weight of each curve, at least 0; not all 0. A Series with the labels of the curves may
        have them in any order.
    window : int >= 0, or float between 0 and 1, optional
        As for :func:`curvewise.dtw`.
    iterations : int >= 0
        Maximum number of rounds.
    tolerance : float >= 0
        The iteration ends if a round lowers the sum by no more than this fraction.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    progress : bool or callable
        As for :func:`curvewise.cdist`; counts cells, and ends early where the mean converges.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Returns
    -------
    DtwMean
        The mean, the sum after every round, and whether it has converged.

    Raises
    ------
    ValueError
        If dtw refuses a curve, with the curve's place (``curves[3]``). If the list is empty, or an
        option or a weight is out of range.
    TypeError
        If a curve does not hold real numbers.
    ImportError
        If ``progress=True`` and tqdm is missing: ``pip install "curvewise[progress]"``.

    Warns
    -----
    UserWarning
        If the sum still fell by more than `tolerance` in the last of the `iterations`.

    Notes
    -----
    Each round finds the best path from the mean to every curve, and moves each point of the mean to
    the weighted mean of its matched points. Neither step can raise the sum. Time O(n m) for each
    curve and round; memory O(n + m) and a few paths. Petitjean, Ketterlin & Gançarski (2011).

    Examples
    --------
    >>> import curvewise
    >>> mean = curvewise.dtw_mean([[0, 0, 2, 0], [0, 2, 2, 0], [0, 0, 0, 5, 0]], initial=[0, 1, 0])
    >>> mean.curve.tolist()
    [0.0, 2.75, 0.0]
    """
    check_reference_systems({}, curves=curves)
    given = as_curve_list(curves, "curves", layout=layout)
    start = _start_of(given, initial, window, workers, layout)
    counts = _checked_weights(in_order_of(weights, curves, "weights"))
    limit = real_number("tolerance", tolerance, -np.inf, "give a number >= 0")
    with reporting(progress) as report:
        mean, costs, converged = compiled_dtw_mean(
            given, counts, start, window, iterations, limit, workers, report
        )
    return _mean_of(given, mean, costs, bool(converged))


# Shared text: workers, layout
def soft_dtw_mean(
    curves: Curves | LabelledCurves,
    *,
    gamma: SupportsFloat = 1.0,
    initial: CurveLike | None = None,
    weights: npt.ArrayLike | None = None,
    window: Window = Default.window,
    iterations: SupportsIndex = 50,
    tolerance: SupportsFloat = 1e-6,
    workers: SupportsIndex = Default.workers,
    layout: Layout | None = None,
) -> DtwMean:
    """Compute the mean of curves under soft_dtw.

    It is smoother than :func:`curvewise.dtw_mean`.

    The curve with the smallest weighted sum of ``soft_dtw(mean, curve)``, or rather a local minimum
    of that sum, which depends on the initial curve less than that of dtw does.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d.
    gamma : float > 0
        As for :func:`curvewise.soft_dtw`.
    initial : array_like, shape (n, d), optional
        As for :func:`curvewise.dtw_mean`.
    weights : array_like, shape (k,), optional
        The weight of each curve, at least 0; not all 0. A Series with the labels of the curves may
        have them in any order.
    window : int >= 0, or float between 0 and 1, optional
        As for :func:`curvewise.dtw`.
    iterations : int >= 0
        Maximum number of rounds.
    tolerance : float >= 0
        The iteration ends if a round lowers the sum by no more than this fraction.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.

    Returns
    -------
    DtwMean
        The mean, the sum after every round, and whether it has converged.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.dtw_mean` and :func:`curvewise.soft_dtw`.
    ImportError
        scipy is missing: ``pip install "curvewise[calibration]"``.

    Warns
    -----
    UserWarning
        As for :func:`curvewise.dtw_mean`.

    Notes
    -----
    Cuturi & Blondel (2017), by L-BFGS-B. Time of one value with its derivatives, O(n m), a curve
    and step; memory O(n sqrt(m)) a thread.

    Examples
    --------
    >>> import curvewise
    >>> curves = [[0, 0, 2, 0], [0, 2, 2, 0], [0, 0, 0, 2, 0]]
    >>> mean = curvewise.soft_dtw_mean(curves, gamma=0.01, initial=[0, 1, 0])
    >>> mean.converged, mean.curve.round(2).tolist()
    (True, [0.0, 2.0, 0.0])
    """
    check_reference_systems({}, curves=curves)
    given = as_curve_list(curves, "curves", layout=layout)
    start = _start_of(given, initial, window, workers, layout)
    counts = _checked_weights(in_order_of(weights, curves, "weights"))
    limit = real_number("tolerance", tolerance, 0.0, "give a number >= 0")
    most = whole_number("iterations", iterations, 0, "give a whole number >= 0")
    # Which refuses what a mean cannot be of, by the names of the curves.
    compiled_dtw_mean(given, counts, start, window, 0, 0.0, workers, None)
    shares = np.array(counts or np.ones(len(given)))
    options = {"gamma": gamma, "window": window, "workers": workers}
    return _mean_of(given, *soft_mean(given, shares, start, most, limit, options))


def soft_mean(
    given: list[Array],
    shares: Array,
    start: Array,
    most: int,
    limit: float,
    options: dict[str, Any],
) -> tuple[Array, Array, bool]:
    """Return a mean under soft_dtw, its costs after every move, and whether it has converged."""
    with extra("calibration", "soft_dtw_mean needs scipy"):
        minimize = import_module("scipy.optimize").minimize
    in_columns = start.reshape(len(start), -1)

    def cost(flat: Array) -> tuple[float, Array]:
        mean = flat.reshape(in_columns.shape)
        total, slopes = 0.0, np.zeros(in_columns.shape)
        for alike, weight in _of_equal_length(given, shares):
            several = np.broadcast_to(mean, (len(alike), *mean.shape))
            with settled_layout():
                values, by_mean, _ = values_and_gradients(several, alike, "soft_dtw", **options)
            total += float(weight @ values)
            slopes += np.tensordot(weight, by_mean, 1)
        return total, slopes.ravel()

    costs = [cost(in_columns.ravel())[0]]
    found = minimize(
        cost,
        in_columns.ravel(),
        jac=True,
        method="L-BFGS-B",
        callback=lambda intermediate_result: costs.append(float(intermediate_result.fun)),
        options={"maxiter": most, "ftol": limit, "gtol": 0.0},
    )
    reached_limit = found.status == 1  # else no step lowers the sum by more, or at all
    return found.x.reshape(start.shape), np.array(costs), not reached_limit


def _mean_of(given: list[Array], mean: Array, costs: Array, converged: bool) -> DtwMean:
    """Return the record of a mean, and warn where it could still be moved."""
    if not converged and len(costs) > 1:
        fell = (costs[-2] - costs[-1]) / abs(costs[-2])
        warn(
            f"the mean has not converged: the last of {len(costs) - 1} moves lowered the sum by "
            f"{100 * fell:.2g} %; give more iterations, or a larger tolerance"
        )
    few = len(given) <= _CURVES_SHOWN
    shown = map(copy_of, given if few else [given[i] for i in evenly(len(given), _CURVES_SHOWN)])
    return DtwMean(mean, costs, converged, tuple(shown))


def _start_of(
    curves: list[Array],
    initial: CurveLike | None,
    window: Window,
    workers: SupportsIndex,
    layout: Layout | None,
) -> Array:
    """Return where a mean begins: `initial`, or the medoid of some of the curves."""
    if initial is not None:
        start = as_curve(initial, "initial")
        return start.T if layout == "channels_first" else start
    chosen = curves[:: max(1, -(-len(curves) // _CURVES_FOR_START))]
    if len(chosen) < 2:
        return curves[0]
    squared: dict[str, Any] = {"metric": "sqeuclidean", "window": window}
    return chosen[medoid(chosen, "dtw", workers=workers, layout="channels_last", **squared)]


def _checked_weights(weights: npt.ArrayLike | None) -> list[float]:
    if weights is not None and np.ndim(weights) != 1:
        raise ValueError(f"weights has {np.ndim(weights)} array dimensions; give one number each")
    return [
        real_number(f"weights[{i}]", weight, -np.inf, "give a finite number >= 0")
        for i, weight in enumerate([] if weights is None else np.asarray(weights).tolist())
    ]


def _of_equal_length(curves: list[Array], weights: Array) -> Iterator[tuple[Array, Array]]:
    """Yield the curves of one length after the other, stacked, with their weights."""
    lengths = np.array([len(curve) for curve in curves])
    for length in np.unique(lengths):
        chosen = np.flatnonzero(lengths == length)
        stacked = np.stack([curves[k].reshape(length, -1) for k in chosen])
        yield stacked, weights[chosen]


@overload
def medoid(
    curves: Curves,
    measure: MeasureName = "dtw",
    *,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
    layout: Layout | None = None,
    **options: Any,
) -> int: ...
@overload
def medoid(
    curves: LabelledCurves,
    measure: MeasureName = "dtw",
    *,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
    layout: Layout | None = None,
    **options: Any,
) -> Any: ...
# Shared text: measure(all), workers, layout
def medoid(
    curves: Curves | LabelledCurves,
    measure: MeasureName = "dtw",
    *,
    workers: SupportsIndex = Default.workers,
    progress: bool | Report = False,
    layout: Layout | None = None,
    **options: Any,
) -> Any:
    """Find the curve with the smallest sum of distances from all curves.

    Parameters
    ----------
    curves : array_like, shape (k, n, d), or a sequence of curves
        The curves of a sequence may differ in length, not in d.
    measure : str
        The name of a measure: "area", "pcm", "frechet", "dtw", "curve_length",
        "frechet_continuous", "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm",
        "twe", "wdtw". If it is not symmetric, the other curves are P and the medoid is Q.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    progress : bool or callable
        As for :func:`curvewise.cdist`; counts pairs.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.
    **options
        Options of the measure's own function.

    Returns
    -------
    int
        Its index, or its label if the curves have labels; the first of equal sums.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`curvewise.cdist`; ValueError if the list is empty, or two curves have the same
        label.

    Notes
    -----
    Time: that of all pairs, each computed once if the measure is symmetric. Memory: about 10^6
    distances at a time.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.medoid([[0, 0, 0], [0, 1, 0], [0, 4, 0]])
    1
    """
    check_reference_systems(options, measure=measure, curves=curves)
    curves, labels = unlabelled(curves, "curves")
    check_distinct(labels, "curves")
    given = as_curve_list(curves, "curves", layout=layout)
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
            block = cdist(
                given[begin:end],
                given[first:],
                measure,
                workers=workers,
                layout="channels_last",
                **options,
            )
            sums[first:] += block.sum(axis=0)
            if halves:
                sums[begin:end] += block[:, end - begin :].sum(axis=1)
            if report is not None:
                report(end, len(given))
    place = int(np.argmin(sums))
    return place if labels is None else labels[place]
