"""The measures: what each means, its options, its cost and where it comes from.

Every function takes two curves, ``P`` (the reference, e.g. the experiment) and ``Q`` (e.g. the
simulation): anything ``numpy.asarray`` turns into an array of shape (n, d), or (n,) for d = 1, of
finite real numbers. The two may have different n. Inputs are never changed. All work is done in
float64 by the compiled library; :mod:`curvewise.reference` has the same functions in plain numpy.

"The paper" is Jekel, Venter, Venter, Stander & Haftka, "Similarity measures for identifying
material parameters from hysteresis loops using inverse analysis", Int. J. Material Forming
(2018).
"""

from __future__ import annotations

from typing import Literal, SupportsFloat, SupportsIndex, TypeAlias

from . import _core
from ._curves import Array, CurveLike, as_curve, as_curves
from .results import Alignment, AreaQuads, PcmMatch

__all__ = [
    "area",
    "area_quads",
    "curve_length",
    "curve_length_residuals",
    "dtw",
    "dtw_path",
    "dtw_table",
    "frechet",
    "frechet_path",
    "frechet_table",
    "mae",
    "mse",
    "normalize",
    "pcm",
    "pcm_match",
    "sum_of_squares",
]

Metric: TypeAlias = Literal["euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"]
StepPattern: TypeAlias = Literal["symmetric1", "symmetric2"]
Spacing: TypeAlias = Literal["distance", "x", "arc_length"]
Crossing: TypeAlias = Literal["rearrange", "split"]
LengthScale: TypeAlias = Literal["mean", "mean_abs", "range"]
Order: TypeAlias = SupportsFloat | None


def area(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
    squared: bool = False,
) -> float:
    """Area between two curves in the plane.

    The curve with fewer points is refined, its longest segment bisected again and again, until
    both have the same number; the value is the sum of the areas of the quadrilaterals between
    corresponding segments.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 points.
    spacing : {"distance", "x", "arc_length"}
        What the refinement measures a segment by. "distance" is sqrt(dx² + dy²), the paper's
        text. "x" is abs(dx), with which the paper's Table 4 was computed (within 1.4 %; on raw
        stress and strain "distance" gives 174 where the table says 45.1, because stress
        dominates the length): raw stress–strain data want "x", or curves scaled by
        :func:`normalize`. "arc_length" gives each curve a vertex wherever the other has one, by
        relative arc length after scaling by P's box, so that the value does not depend on how
        either curve was sampled, as long as they do not cross; not symmetric then, as P's box
        scales.
    crossing : {"rearrange", "split"}
        What becomes of a quadrilateral that intersects itself. "rearrange" (the paper) swaps two
        vertices until it is simple: the value jumps where a quadrilateral turns complex. "split"
        takes the two triangles at the crossing point: the value changes continuously, which an
        optimiser likes.
    squared : bool
        Sum the squares of the areas instead (the paper's section 4, the analogue of
        sum-of-squares).

    Returns
    -------
    float
        In units of x times units of y (squared: of that squared). Symmetric to rounding, except
        with "arc_length".

    Raises
    ------
    ValueError
        A curve is not finite, has fewer than 2 points or other than 2 coordinates; an unknown
        option.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Algorithm 1 of the paper; the cross product CD of its Eq. 6 is misprinted. Time
    O(n + m + abs(n - m) log m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.area([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 1)])
    2.0
    >>> crossed = [(0, 1), (1, -1)], [(0, -1), (1, 1)]
    >>> curvewise.area(*crossed), curvewise.area(*crossed, crossing="split")
    (2.0, 1.0)
    """
    P, Q = as_curves(P, Q)
    return _core.area(P, Q, spacing, crossing, squared)


def area_quads(
    P: CurveLike,
    Q: CurveLike,
    *,
    spacing: Spacing = "distance",
    crossing: Crossing = "rearrange",
) -> AreaQuads:
    """Return the quadrilaterals whose areas :func:`area` adds up.

    Parameters
    ----------
    P, Q, spacing, crossing
        As for :func:`area`.

    Returns
    -------
    AreaQuads
        ``quads``, shape (k, 4, 2), with vertices in the order whose area is given (the original
        order (A[i], A[i+1], B[i+1], B[i]) where a complex one was split), and ``areas``, (k,).

    Raises
    ------
    ValueError, TypeError
        As for :func:`area`.

    Notes
    -----
    Algorithm 1 of the paper. Time and memory as for :func:`area`.

    Examples
    --------
    >>> import curvewise
    >>> quads, areas = curvewise.area_quads([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 1)])
    >>> quads.shape, areas.tolist()
    ((2, 4, 2), [1.0, 1.0])
    """
    P, Q = as_curves(P, Q)
    return AreaQuads(*_core.area_quads(P, Q, spacing, crossing))


def pcm(
    P: CurveLike, Q: CurveLike, *, offsets: SupportsIndex | Literal["continuous"] = 200
) -> float:
    """Partial curve mapping: the area to the best-matching part of the longer curve.

    Both curves are scaled by P's bounding box. The vertices of the shorter one are laid onto the
    longer one at equal arc length, starting at an offset along it; the value is the smallest
    area between the two over all offsets.

    A short curve that agrees with a part of the other scores well by design: a simulation that
    died early may score 0. :func:`pcm_match` says which part of the longer curve was covered.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 different points.
    offsets : int >= 1, or "continuous"
        The number of evenly spaced offsets (1: none), or the minimum over all offsets, to 1e-12
        of the shorter length; never above that of 200 offsets.

    Returns
    -------
    float
        Dimensionless. Not symmetric: P's box scales both.

    Raises
    ------
    ValueError
        A curve is not finite, has fewer than 2 points, other than 2 coordinates or no length;
        `offsets` is out of range.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Witowski & Stander (2012), as section 2.1 of the paper describes it. Time O(offsets (n + m));
    "continuous" needs about 10³ evaluations of O(n + m) for curves that bend, and up to n m of
    them where the area is level over long stretches of offsets (zigzags along one line: 4 s for
    2201 and 4401 points). Memory O(n + m). The error of the grid is at most
    S (T - S) / (2 (offsets - 1)) for lengths S <= T.

    Examples
    --------
    >>> import curvewise
    >>> loop = [(0, 0), (1, 1), (2, 0), (3, 1)]
    >>> round(curvewise.pcm(loop, loop[1:3], offsets="continuous"), 9)
    0.0
    """
    P, Q = as_curves(P, Q)
    return _core.pcm(P, Q, offsets)


def pcm_match(
    P: CurveLike, Q: CurveLike, *, offsets: SupportsIndex | Literal["continuous"] = 200
) -> PcmMatch:
    """Partial curve mapping, with where the shorter curve lies on the longer.

    Parameters
    ----------
    P, Q, offsets
        As for :func:`pcm`.

    Returns
    -------
    PcmMatch
        ``value``, ``offset``, ``coverage`` (shorter length over longer), ``mapped`` ("P" or "Q",
        the shorter curve) and ``points``: for each of its vertices the point on the other curve,
        in original units.

    Raises
    ------
    ValueError, TypeError
        As for :func:`pcm`.

    Notes
    -----
    As for :func:`pcm`.

    Examples
    --------
    >>> import curvewise
    >>> match = curvewise.pcm_match([(0, 0), (1, 0), (4, 0)], [(1, 0), (2, 0)])
    >>> match.mapped, match.coverage
    ('Q', 0.25)
    """
    P, Q = as_curves(P, Q)
    return PcmMatch(*_core.pcm_match(P, Q, offsets))


def frechet(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    workers: SupportsIndex = 1,
) -> float:
    """Discrete Fréchet distance: the shortest leash for two walks along the points.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"}
        The ground distance between points.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    workers : int
        Threads for this call: at least 1, or -1 for one per core. Never changes the result.

    Returns
    -------
    float
        In units of the ground distance. At most the longest edge of either curve above the
        continuous Fréchet distance, and never below it. Symmetric.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is unknown or out of
        range.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Eiter & Mannila (1994): c[i, j] = max(d(P[i], Q[j]), min(c[i-1, j], c[i, j-1],
    c[i-1, j-1])). Exact. Time O(n m), memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)])
    3.0
    """
    P, Q = as_curves(P, Q)
    return _core.frechet(P, Q, metric, p, workers)


def frechet_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    workers: SupportsIndex = 1,
) -> Alignment:
    """Discrete Fréchet distance with a coupling that attains it.

    Parameters
    ----------
    P, Q, metric, p, workers
        As for :func:`frechet`.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1). The largest ground distance along the path equals the
        distance to the bit.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.

    Notes
    -----
    As for :func:`frechet`, by divide and conquer over rows: up to three times the time of the
    distance, memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_path([(0, 0), (1, 0), (2, 0)], [(0, 1), (2, 3)]).path.tolist()
    [[0, 0], [1, 0], [2, 1]]
    """
    P, Q = as_curves(P, Q)
    return Alignment(*_core.frechet_path(P, Q, metric, p, workers))


def frechet_table(
    P: CurveLike, Q: CurveLike, *, metric: Metric = "euclidean", p: Order = None
) -> Array:
    """Return the cumulative table of the discrete Fréchet distance.

    Parameters
    ----------
    P, Q, metric, p
        As for :func:`frechet`.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j]: the distance between the first i + 1 points of P and the first j + 1 of Q.

    Raises
    ------
    ValueError, TypeError
        As for :func:`frechet`.
    MemoryError
        The table does not fit.

    Notes
    -----
    As for :func:`frechet`. Time O(n m), memory 8 n m bytes.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.frechet_table([0, 1, 2], [0, 2]).tolist()
    [[0.0, 2.0], [1.0, 1.0], [2.0, 1.0]]
    """
    P, Q = as_curves(P, Q)
    return _core.frechet_table(P, Q, metric, p)


def dtw(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
    workers: SupportsIndex = 1,
) -> float:
    """Dynamic time warping: the smallest sum of ground distances along a warping path.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves, of any d.
    metric : {"euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski"}
        The ground distance between points.
    p : float, 1 <= p <= inf, optional
        The order of "minkowski"; 2 if not given.
    step_pattern : {"symmetric1", "symmetric2"}
        "symmetric2" counts a diagonal step twice; it is R's default, with which the paper's
        tables were made.
    window : int >= 0, optional
        Sakoe–Chiba band: abs(i (m-1) - j (n-1)) <= window (max(n, m) - 1), that is
        abs(i - j) <= window where n = m. No limit where n = 1 or m = 1.
    open_begin, open_end : bool
        Subsequence DTW: P is matched to a part of Q, which may begin, or end, anywhere. Not
        normalised by length. With "symmetric1" and without a window only.
    workers : int
        Threads for this call: at least 1, or -1 for one per core. Never changes the result.

    Returns
    -------
    float
        In units of the ground distance. Symmetric in P and Q without open ends.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is unknown or out of
        range; no path fits the window (window = 0 and n != m).
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Sakoe & Chiba (1978): c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d), with
    w = 1 for "symmetric1" and 2 for "symmetric2"; open ends: Müller (2007). Exact. Time O(n m),
    or the cells of the band; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw([0, 1, 2, 3], [0, 2, 3])
    1.0
    >>> curvewise.dtw([1, 2], [9, 1, 2, 9], open_begin=True, open_end=True)
    0.0
    """
    P, Q = as_curves(P, Q)
    return _core.dtw(
        P,
        Q,
        metric,
        p,
        step_pattern,
        window,
        open_begin,
        open_end,
        workers,
    )


def dtw_path(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
    workers: SupportsIndex = 1,
) -> Alignment:
    """Dynamic time warping with a warping path that attains it.

    Parameters
    ----------
    P, Q, metric, p, step_pattern, window, open_begin, open_end, workers
        As for :func:`dtw`.

    Returns
    -------
    Alignment
        ``distance`` and ``path``, shape (k, 2). Among equal predecessors the diagonal is taken,
        then (i-1, j), then (i, j-1). The sum of step weight times ground distance, in path
        order, equals the distance to the bit.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.

    Notes
    -----
    As for :func:`dtw`, by divide and conquer over rows: up to three times the time of the
    distance, memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw_path([0, 1, 2, 3], [0, 2, 3]).path.tolist()
    [[0, 0], [1, 0], [2, 1], [3, 2]]
    """
    P, Q = as_curves(P, Q)
    return Alignment(
        *_core.dtw_path(
            P,
            Q,
            metric,
            p,
            step_pattern,
            window,
            open_begin,
            open_end,
            workers,
        )
    )


def dtw_table(
    P: CurveLike,
    Q: CurveLike,
    *,
    metric: Metric = "euclidean",
    p: Order = None,
    step_pattern: StepPattern = "symmetric1",
    window: SupportsIndex | None = None,
    open_begin: bool = False,
    open_end: bool = False,
) -> Array:
    """Return the cumulative table of dynamic time warping.

    Parameters
    ----------
    P, Q, metric, p, step_pattern, window, open_begin, open_end
        As for :func:`dtw`. An open end does not change the table: the value is then the smallest
        entry of its last row.

    Returns
    -------
    ndarray, shape (n, m)
        c[i, j]; ``inf`` outside the window.

    Raises
    ------
    ValueError, TypeError
        As for :func:`dtw`.
    MemoryError
        The table does not fit.

    Notes
    -----
    As for :func:`dtw`. Time O(n m), memory 8 n m bytes.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.dtw_table([0, 1], [0, 2, 3]).tolist()
    [[0.0, 2.0, 5.0], [1.0, 1.0, 3.0]]
    """
    P, Q = as_curves(P, Q)
    return _core.dtw_table(
        P,
        Q,
        metric,
        p,
        step_pattern,
        window,
        open_begin,
        open_end,
    )


def curve_length(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> float:
    """Curve-length measure: log-relative differences at equal fractions of arc length.

    Every point of P is compared with the point of Q at the same fraction of its curve's length.

    Parameters
    ----------
    P, Q : array_like, shapes (n, 2) and (m, 2)
        The curves, each of at least 2 different points.
    scale : {"mean", "mean_abs", "range"}
        What differences in x and in y are divided by: the mean of P's x ("mean", the paper's),
        the mean of abs(x), or the range. Loops centred on zero need one of the last two: on a
        loop with 1 % error in stress "mean" gives 55 where "mean_abs" gives 0.1.

    Returns
    -------
    float
        Dimensionless. Not symmetric.

    Raises
    ------
    ValueError
        A curve is not finite, has fewer than 2 points, other than 2 coordinates or no length;
        the scale is 0 (for "mean", to rounding); an unknown option.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    OF2 of Andrade-Campos, de-Carvalho & Valente (2012); section 2.4 of the paper. Arc lengths
    are taken after dividing by each curve's own max abs(x) and max abs(y). The value is the
    Euclidean norm of :func:`curve_length_residuals`. Time and memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> P = [(0, 0), (1, 1), (2, 2)]
    >>> round(curvewise.curve_length(P, [(0, 1), (1, 2), (2, 3)]), 6)  # sqrt(3) ln 2
    1.200566
    """
    P, Q = as_curves(P, Q)
    return _core.curve_length(P, Q, scale)


def curve_length_residuals(P: CurveLike, Q: CurveLike, *, scale: LengthScale = "mean") -> Array:
    """Return the terms of :func:`curve_length`, for ``scipy.optimize.least_squares``.

    Parameters
    ----------
    P, Q, scale
        As for :func:`curve_length`.

    Returns
    -------
    ndarray, shape (n, 2)
        ln(1 + abs(dx / x̄)) and ln(1 + abs(dy / ȳ)) for every point of P.

    Raises
    ------
    ValueError, TypeError
        As for :func:`curve_length`.

    Notes
    -----
    As for :func:`curve_length`.

    Examples
    --------
    >>> import curvewise
    >>> curvewise.curve_length_residuals([(0, 0), (2, 2)], [(0, 0), (2, 2)]).tolist()
    [[0.0, 0.0], [0.0, 0.0]]
    """
    P, Q = as_curves(P, Q)
    return _core.curve_length_residuals(P, Q, scale)


def sum_of_squares(P: CurveLike, Q: CurveLike) -> float:
    """Sum of squared differences of two curves of equal shape, entry by entry.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError
        The shapes differ; a curve is empty or not finite.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Eq. 1 of the paper. Time O(n d).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.sum_of_squares([1, 2, 3], [1, 3, 5])
    5.0
    """
    P, Q = as_curves(P, Q)
    return _core.sum_of_squares(P, Q)


def mse(P: CurveLike, Q: CurveLike) -> float:
    """Mean squared difference over all n d entries of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In squared units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    :func:`sum_of_squares` over n d. Time O(n d).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.mse([1, 2, 3, 4], [1, 3, 5, 4])
    1.25
    """
    P, Q = as_curves(P, Q)
    return _core.mse(P, Q)


def mae(P: CurveLike, Q: CurveLike) -> float:
    """Mean absolute difference over all n d entries of two curves of equal shape.

    Parameters
    ----------
    P, Q : array_like, both of shape (n, d) or (n,)
        The curves.

    Returns
    -------
    float
        In units of the curves. Symmetric.

    Raises
    ------
    ValueError, TypeError
        As for :func:`sum_of_squares`.

    Notes
    -----
    Time O(n d).

    Examples
    --------
    >>> import curvewise
    >>> curvewise.mae([1, 2, 3, 4], [1, 3, 5, 4])
    0.75
    """
    P, Q = as_curves(P, Q)
    return _core.mae(P, Q)


def normalize(P: CurveLike, *others: CurveLike) -> list[Array]:
    """Scale curves by P's bounding box: P comes to lie in [0, 1] in every coordinate.

    Parameters
    ----------
    P : array_like, shape (n, d) or (n,)
        The curve whose minimum is subtracted and by whose extent is divided (not in a
        coordinate in which it has none).
    *others : array_like, shape (m, d) or (m,)
        Curves to scale alike.

    Returns
    -------
    list of ndarray
        P and the others, scaled, each in the shape it came in.

    Raises
    ------
    ValueError
        A curve is empty, not finite, or differs from P in d.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Section 2.1 of the paper. Time and memory O(n d) a curve.

    Examples
    --------
    >>> import curvewise
    >>> P, Q = curvewise.normalize([(0, 10), (2, 30)], [(1, 40)])
    >>> P.tolist(), Q.tolist()
    ([[0.0, 0.0], [1.0, 1.0]], [[0.5, 1.5]])
    """
    box = as_curve(P, "P")
    names = ["P", "Q"] if len(others) == 1 else ["P", *(f"others[{i}]" for i in range(len(others)))]
    curves = [box, *(as_curve(curve, name) for curve, name in zip(others, names[1:], strict=True))]
    return [_core.normalize(box, curve, name) for curve, name in zip(curves, names, strict=True)]
