"""Where in a long curve a short one occurs: subsequence DTW, and the same under Fréchet.

Müller, "Information Retrieval for Music and Motion" (2007), chapter 7, for curves of any dimension
and for several answers that do not overlap. The work is done by the compiled library.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import SupportsFloat, SupportsIndex, get_args

import numpy as np

from .._core import dtw_subsequences, frechet_subsequences
from .._docstrings import filled, listed
from .._options import Default, Metric, Order, Radius, WarpingName, check_choice, whole_number
from ..curves.inputs import Array, CurveLike, as_curves, warn_if_transposed
from ..measures.registry import WARPINGS
from ..measures.results import Subsequence

__all__ = ["subsequence"]


@filled(warpings=listed(get_args(WarpingName)))
def subsequence(
    P: CurveLike,
    Q: CurveLike,
    *,
    k: SupportsIndex = 1,
    measure: WarpingName = "dtw",
    metric: Metric = Default.metric,
    p: Order = Default.p,
    radius: Radius = Default.radius,
    cutoff: SupportsFloat | None = Default.cutoff,
    path: bool = False,
    workers: SupportsIndex = Default.workers,
) -> list[Subsequence]:
    """Find the runs of Q that are most like P.

    The first answer is the best of all runs of consecutive points of Q: what ``dtw(P, Q,
    open_begin=True, open_end=True)`` finds. Each later one is the best run of what the answers
    before it have left of Q, where every piece that is left is searched as if it were all of Q. So
    the answers do not overlap, and their distances never fall. Of equal distances the run that ends
    first is the better.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        What is looked for, e.g. a cycle, and where, e.g. a long record; of any d.
    k : int >= 1
        The most answers to return.
    measure : {warpings}
        dtw has the step pattern "symmetric1" and no window.
    {metric}
    {p}
    {radius}
    cutoff : float >= 0, optional
        Runs with a distance above it are no answers.
    path : bool
        Whether the answers come with their paths.
    {workers}

    Returns
    -------
    list of Subsequence
        The best first; fewer than `k` where Q has no more runs, or none within the cutoff.

    Raises
    ------
    ValueError
        A curve is not finite or empty; the curves differ in d; an option is unknown or out of
        range.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Exact. One sweep of the table, O(n m) time, which carries along where in Q every path began;
    after each answer, only the ends behind it whose paths began before its end are swept again.
    Memory O(n + m). A path takes that of dtw_path, or frechet_path, for its run.

    Examples
    --------
    >>> import curvewise
    >>> record = [0, 0, 1, 2, 1, 0, 0, 1, 2.5, 1, 0]
    >>> for found in curvewise.subsequence([1, 2, 1], record, k=2):
    ...     print(found.distance, found.start, found.stop)
    0.0 2 4
    0.5 7 9
    """
    P, Q = as_curves(P, Q)
    warn_if_transposed(P, "P")
    count = min(whole_number("k", k, 1, "give a whole number >= 1"), sys.maxsize)
    check_choice("measure", measure, get_args(WarpingName))
    find = dtw_subsequences if measure == "dtw" else frechet_subsequences
    how = {"metric": metric, "p": p, "radius": radius, "workers": workers, "cutoff": cutoff}
    answers = [Subsequence(*answer) for answer in find(P, Q, count, how)]
    if not path:
        return answers
    return [_with_path(P, Q, measure, metric, p, radius, answer) for answer in answers]


def _with_path(
    P: Array,
    Q: Array,
    measure: WarpingName,
    metric: Metric,
    p: Order,
    radius: Radius,
    answer: Subsequence,
) -> Subsequence:
    """Return an answer with its path, which begins and ends with the run."""
    run = Q[answer.start : answer.stop + 1]
    alignment = WARPINGS[measure].path(P, run, metric=metric, p=p, radius=radius)
    return replace(answer, path=alignment.path + np.array([0, answer.start]))
