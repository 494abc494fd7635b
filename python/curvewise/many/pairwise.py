"""One measure between many curves: all pairs, or one curve against others.

Each curve is checked and packed once, not once for each pair. Threads share the pairs, the largest
first; neither their number nor their order changes a value. The compiled library computes the
values. A callable instead of a measure's name is called pair by pair from Python, and so is a
measure whose ground distance is a callable.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, ValuesView
from functools import partial
from itertools import combinations, product
from typing import Any, Protocol, SupportsFloat, SupportsIndex, TypeAlias, get_args, overload

import numpy as np
import numpy.typing as npt

from .._core import cdist as compiled_cdist
from .._core import check_batch, is_symmetric
from .._core import pdist as compiled_pdist
from .._options import Default, Metric, Missing, WarpingName, check_choice, real_number
from .._progress import Report, reporting
from ..curves.inputs import Array, CurveLike, as_curve_list, as_curve_lists, copy_of
from ..curves.labels import labelled_matrix, labelled_triangle, unlabelled
from ..curves.layouts import Layout, settled_layout
from ..curves.missing import skip_in_list
from ..curves.reference_systems import check_reference_systems
from ..measures.registry import MEASURES, MeasureName
from ..measures.step_pattern import may_be_negative

__all__ = ["Curves", "LabelledCurves", "Measure", "available_measures", "cdist", "pdist"]

Measure: TypeAlias = MeasureName | Callable[..., float]


class Grouped(Protocol):
    """A groupby of pandas."""

    @property
    def ngroups(self) -> int:
        """The number of groups."""

    def __iter__(self) -> Iterator[Any]:
        """Iterate over the labels and the groups."""


class Indexed(Protocol):
    """A Series of curves, or a GeoDataFrame of lines."""

    @property
    def iloc(self) -> Any:
        """The rows by their places."""


Curves: TypeAlias = (
    Sequence[CurveLike] | Iterator[CurveLike] | ValuesView[CurveLike] | npt.NDArray[Any]
)
"""k curves: an array of shape (k, n, d), or curves of different lengths, of a generator too."""
LabelledCurves: TypeAlias = Mapping[Any, CurveLike] | Grouped | Indexed
"""Curves by their labels."""


_NAMES: list[MeasureName] = sorted(info.name for info in MEASURES.values())


def available_measures() -> list[MeasureName]:
    """Return the measures of :func:`cdist`, :func:`pdist` and :class:`Prepared`.

    Returns
    -------
    list of str
        In alphabetical order.

    Notes
    -----
    The options of each are those of the function of that name, except ``workers``.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.available_measures()[:2]
    ['area', 'curve_length']
    """
    return list(_NAMES)


@overload
def cdist(
    XA: Curves,
    XB: Curves | None = None,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Array: ...
@overload
def cdist(
    XA: Curves | LabelledCurves,
    XB: Curves | LabelledCurves | None = None,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Any: ...
# Shared text: measure(all), workers, layout, missing
def cdist(
    XA: Curves | LabelledCurves,
    XB: Curves | LabelledCurves | None = None,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Any:
    """Compute a measure between all curves of two lists.

    Parameters
    ----------
    XA, XB : array_like, shapes (k, n, d) and (l, m, d), or sequences of curves
        The curves of a sequence may differ in length, not in d. A curve of XA is P, one of XB is Q.
        Without XB, XA is compared with itself. Each pair of a symmetric measure is then computed
        once, with the earlier curve as P, unless the metric is user-defined. A dict of curves, a
        groupby, a Series or a GeoDataFrame of lines also has labels.
    measure : str or callable
        The name of a measure: "area", "pcm", "frechet", "dtw", "curve_length",
        "frechet_continuous", "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm",
        "twe", "wdtw". Or a function of two curves that returns a float. A callable runs in this
        thread, holding the GIL, pair by pair: `workers` is ignored, and all pairs are computed.
        `workers` is also ignored for dtw, frechet and frechet_continuous with ``closed=True`` or a
        callable `metric`. A matrix as `metric` raises an error.
    out : ndarray of float64, shape (k, l), C-contiguous, optional
        Array for the result.
    workers : int, default 1
        Number of threads: at least 1, or -1 for one per core. The result does not change.
    cutoff : float >= 0, optional
        Values above it become inf; the computation of their pairs may stop early. It may be
        negative for a callable, and for a step pattern that has a negative weight.
    progress : bool or callable
        True shows a bar (tqdm). A callable is called in this thread with (done, total), about
        twenty times a second. The unit for dtw and frechet is a cell of the tables, n m for a pair.
        The unit for other measures and callables is a point, n + m for a pair.
    layout : {"channels_first", "channels_last"}, optional
        Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
        rows. The default is rows, with a LayoutWarning if there are more coordinates than points.
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.
    **options
        Options of the measure's own function, or of the callable.

    Returns
    -------
    ndarray, shape (k, l), or DataFrame
        The distances; `out` itself if it is given. Entry (i, j) is bitwise identical to
        ``measure(XA[i], XB[j], **options)``. If XA or XB have labels, a DataFrame with them as its
        index and columns.

    Raises
    ------
    ValueError
        If the measure refuses a curve, with the curve's place (``XA[3]``). If curves differ in d,
        `out` does not fit, or a measure or option value is unknown. If tracks are in degrees
        without ``metric="haversine"``, or in two reference systems.
    TypeError
        If a curve does not hold real numbers, or the measure does not have an option.
    ImportError
        If ``progress=True`` and tqdm is missing: ``pip install "curvewise[progress]"``. If curves
        have labels and pandas is missing: ``pip install "curvewise[curves]"``.

    See Also
    --------
    pdist : Distances between all pairs of one list, condensed.
    Index : Nearest curves without all distances.

    Notes
    -----
    Time: the sum of the pairs'. Memory: the result, 0.1 kB for each curve, and packed copies of
    some of the curves at a time. The copies take about 100 MB at most, or four curves per thread if
    that is more. Arrays of float32 are kept in memory and computed in float64, bitwise identical to
    a float64 copy. Ctrl-C ends a call on the main thread, and all its threads, within 0.2 s;
    docs/explanation/guarantees.md lists the exceptions.

    Examples
    --------
    >>> import curvewise
    >>> ramp, step, peak = [0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]
    >>> curvewise.cdist([ramp, step, peak], measure="dtw").tolist()
    [[0.0, 2.0, 5.0], [2.0, 0.0, 3.0], [5.0, 3.0, 0.0]]
    >>> curvewise.cdist([ramp], [step, peak], "frechet").tolist()
    [[1.0, 3.0]]
    >>> print(curvewise.cdist({"ramp": ramp, "step": step}))
          ramp  step
    ramp   0.0   2.0
    step   2.0   0.0
    """
    check_reference_systems(options, measure=measure, XA=XA, XB=XB)
    XA, row_labels = unlabelled(XA, "XA")
    XB, column_labels = (None, row_labels) if XB is None else unlabelled(XB, "XB")
    kept = not callable(measure)
    rows, columns = as_curve_lists(XA, XB, keep_float32=kept, layout=layout)
    rows = skip_in_list(rows, "XA", missing)
    columns = None if columns is None else skip_in_list(columns, "XB", missing)
    shape = (len(rows), len(rows if columns is None else columns))
    values = _checked_out(out, shape, "cdist")
    rows, columns = _apart(rows, out), None if columns is None else _apart(columns, out)
    limit = checked_limit("cutoff", cutoff, measure, options)
    if _is_called_by_pairs(measure, options):
        function = _called_by_pairs(measure, options, limit, rows, columns)
        others = rows if columns is None else columns
        points = _points(rows) * len(others) + len(rows) * _points(others)
        _fill(values, product(rows, others), points, function, limit, progress)
    else:
        name = _check_names(measure, options)
        options = of_compiled(name, options)
        with reporting(progress) as report:
            compiled_cdist(rows, columns, name, options, values, workers, limit, report)
    return labelled_matrix(values, row_labels, column_labels)


@overload
def pdist(
    X: Curves,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Array: ...
@overload
def pdist(
    X: LabelledCurves,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Any: ...
# Shared text: measure(symmetric)
def pdist(
    X: Curves | LabelledCurves,
    measure: Measure = "dtw",
    *,
    out: Array | None = None,
    workers: SupportsIndex = Default.workers,
    cutoff: SupportsFloat | None = None,
    progress: bool | Report = False,
    layout: Layout | None = None,
    missing: Missing = Default.missing,
    **options: Any,
) -> Any:
    """Compute a symmetric measure between every two curves of a list.

    Parameters
    ----------
    X : array_like, shape (k, n, d), or a sequence of curves
        As for :func:`cdist`.
    measure : str or callable
        The name of a symmetric measure: "area", "frechet", "dtw", "frechet_continuous",
        "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm", "twe", "wdtw". They are
        symmetric: dtw without open ends, area without spacing="arc_length" or "matched", and closed
        only with crossing="polygon". A callable, and a callable `metric`, is only called with the
        earlier curve as P; its symmetry is not checked.
    out : ndarray of float64, shape (k (k-1) / 2,), C-contiguous, optional
        Array for the result.
    workers, cutoff, progress, layout, missing, **options
        As for :func:`cdist`.

    Returns
    -------
    ndarray, shape (k (k-1) / 2,), or Series
        The upper triangle of the matrix, row by row, as ``scipy.spatial.distance.pdist`` returns
        it: ``scipy.spatial.distance.squareform`` converts it to a matrix. The value for i < j is
        that of ``measure(X[i], X[j], **options)``. If the curves have labels, a Series whose index
        is the pairs of labels; squareform and scipy's linkage accept it too.

    Raises
    ------
    ValueError, TypeError, ImportError
        As for :func:`cdist`; ValueError also if a measure is not symmetric: use :func:`cdist`.

    Notes
    -----
    As for :func:`cdist`.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.pdist([[0, 1, 2, 3], [0, 0, 3, 3], [0, 3, 0]], "dtw").tolist()
    [2.0, 5.0, 3.0]
    >>> curvewise.pdist({"ramp": [0, 1, 2, 3], "step": [0, 0, 3, 3]})["ramp", "step"]
    np.float64(2.0)
    """
    check_reference_systems(options, measure=measure, X=X)
    X, labels = unlabelled(X, "X")
    curves = as_curve_list(X, "X", keep_float32=not callable(measure), layout=layout)
    curves = skip_in_list(curves, "X", missing)
    values = _checked_out(out, (len(curves) * (len(curves) - 1) // 2,), "pdist")
    curves = _apart(curves, out)
    limit = checked_limit("cutoff", cutoff, measure, options)
    if _is_called_by_pairs(measure, options):
        function = _called_by_pairs(measure, options, limit, curves, None)
        if not callable(measure):
            apart = {"closed", "dependent"} | {o for o in options if callable(options[o])}
            _check_symmetric(measure, {o: v for o, v in options.items() if o not in apart})
        points = (len(curves) - 1) * _points(curves)
        _fill(values, combinations(curves, 2), points, function, limit, progress)
    else:
        name = _check_names(measure, options)
        options = of_compiled(name, options)
        _check_symmetric(name, options)
        with reporting(progress) as report:
            compiled_pdist(curves, name, options, values, workers, limit, report)
    return labelled_triangle(values, labels)


# What users look for among the named measures.
_ELSEWHERE = {
    **{
        name: f"cdist, pdist and estimators take the function, measure=curvewise.{name}"
        for name in ("lb_improved", "lb_keogh", "lb_kim", "sbd", "soft_dtw", "soft_dtw_divergence")
    },
    "ddtw": "give slopes, curvewise.curves.derivative(curve) for each curve, and measure='dtw'",
    "wddtw": "give slopes, curvewise.curves.derivative(curve) for each curve, and measure='wdtw'",
}


# Options of measures that only their functions of one pair have, with their defaults.
_OF_PYTHON = {
    "dtw": {"closed": False, "dependent": True},
    "frechet": {"closed": False},
    "frechet_continuous": {"closed": False},
}


def of_compiled(measure: str, options: dict[str, Any]) -> dict[str, Any]:
    """Return the options without defaults of those that compiled measures do not have."""
    apart = _OF_PYTHON.get(measure, {})
    if apart.keys().isdisjoint(options):
        return options
    if options.get("closed"):
        raise TypeError(
            f"{measure} has closed=True for one pair, in curvewise.cdist and curvewise.pdist; for "
            f"nearest curves, sort the rows of cdist(queries, curves, {measure!r}, closed=True)"
        )
    return {o: v for o, v in options.items() if o not in apart or v is not apart[o]}


def _is_called_by_pairs(measure: Measure, options: Mapping[str, Any]) -> bool:
    """Return whether pairs are called from Python."""
    if callable(measure) or callable(options.get("metric")):
        return True
    if not options or not isinstance(measure, str):
        return False
    apart = _OF_PYTHON.get(measure, {})
    return any(bool(options.get(option, default)) != default for option, default in apart.items())


def _called_by_pairs(
    measure: Measure,
    options: dict[str, Any],
    limit: float,
    rows: list[Array],
    columns: list[Array] | None,
) -> Callable[..., float]:
    """Return the function for every pair: a callable, or a user-defined metric."""
    if callable(measure):
        return partial(measure, **options)
    name = _check_names(measure, options)
    # Measures without user-defined metrics refuse it here, as they refuse curves.
    is_warping = name in get_args(WarpingName)
    of_pair = set(_OF_PYTHON.get(name, ()))
    if is_warping:
        of_pair |= {"metric", "p", "radius"}
    check_batch(rows, columns, name, {o: v for o, v in options.items() if o not in of_pair})
    of_function = options | {"cutoff": limit} if is_warping else options
    return partial(MEASURES[name].function, **of_function)


def _check_names(measure: Any, options: Mapping[str, Any]) -> str:
    """Return the measure's name; explain measures and ground distances to who mixes them up."""
    if "workers" in options:  # of an Index or a Prepared; cdist and pdist have a parameter
        raise TypeError("workers is an option of the calls that compute; give it to them")
    names = _NAMES
    metrics = get_args(Metric)
    if isinstance(measure, str) and measure in metrics:
        raise ValueError(
            f"{measure!r} is a ground distance, between points; the measure is of curves, one of "
            f"{', '.join(names)}: use measure='dtw', metric={measure!r} for example"
        )
    if isinstance(measure, str) and measure in _ELSEWHERE:
        raise ValueError(f"{measure!r} is not a measure by its name: {_ELSEWHERE[measure]}")
    check_choice("measure", measure, names)
    metric = options.get("metric")
    if isinstance(metric, str) and metric in names:
        raise ValueError(
            f"{metric!r} is a measure, of curves; the metric is the ground distance between their "
            f"points, one of {', '.join(metrics)}: use measure={metric!r}"
        )
    return str(measure)


def _check_symmetric(name: str, options: dict[str, Any]) -> None:
    if not is_symmetric(name, options):
        given = "".join(f", {option}={value!r}" for option, value in options.items())
        raise ValueError(
            f"pdist needs a symmetric measure, and {name!r}{given} is not: use cdist, "
            "which computes both directions"
        )


def _checked_out(out: Array | None, shape: tuple[int, ...], name: str) -> Array:
    if out is None:
        try:
            return np.empty(shape)
        except MemoryError as error:
            raise MemoryError(
                f"{name} of these curves returns {8e-9 * math.prod(shape):,.0f} GB, which do not "
                f"fit into memory: curvewise.dask.{name} with store='distances.zarr' writes them "
                "to disk, and curvewise.Index finds the nearest curves without them"
            ) from error
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out is of type {type(out).__name__}; give a numpy array")
    if out.shape != shape:
        raise ValueError(f"out has shape {out.shape}; {name} of these curves needs {shape}")
    if out.dtype != np.float64 or not out.dtype.isnative:
        raise ValueError(f"out has dtype {out.dtype.str}; {name} needs float64")
    if not (out.flags.c_contiguous and out.flags.aligned and out.flags.writeable):
        raise ValueError(f"out must be C-contiguous, aligned and writeable; {name} fills it")
    return out


def _apart(curves: list[Array], out: Array | None) -> list[Array]:
    """Return the curves, copied where writing to the caller's `out` might change them."""
    if out is None:
        return curves
    return [copy_of(curve) if np.may_share_memory(curve, out) else curve for curve in curves]


def checked_limit(
    option: str, given: SupportsFloat | None, measure: object, options: Mapping[str, Any]
) -> float:
    """Return a largest distance, for None infinity; refuse one below all that may be."""
    is_open = callable(measure) or may_be_negative(options.get("step_pattern"))
    least, advice = (-math.inf, "give a number") if is_open else (0.0, "give a number >= 0")
    if option == "cutoff":
        given, advice = math.inf if given is None else given, f"{advice}, or None"
    return real_number(option, given, least, advice)


def _fill(
    out: Array,
    pairs: Iterable[tuple[Array, Array]],
    points: int,
    function: Callable[..., float],
    limit: float,
    progress: bool | Report,
) -> None:
    """Call a Python function for every pair, in the order of `out`."""
    flat = out.reshape(-1)
    done = 0
    with reporting(progress) as report, settled_layout():
        for position, (P, Q) in enumerate(pairs):
            value = float(function(P, Q))
            flat[position] = np.inf if value > limit else value
            done += len(P) + len(Q)
            if report is not None:
                report(done, points)


def _points(curves: Iterable[Array]) -> int:
    return sum(map(len, curves))
