"""One curve against others as they come: it is checked, packed and scaled once.

The work is done by the compiled library.
"""

from __future__ import annotations

from typing import Any, SupportsFloat, SupportsIndex, overload

import numpy as np

from .._core import Prepared as CompiledPrepared
from .._options import Default
from ..curves.foreign_curves import is_curve_of_another_package
from ..curves.inputs import (
    Array,
    CurveLike,
    as_curve,
    as_curve_list,
    check_column_names,
    column_names,
    copy_of,
)
from ..curves.labels import labelled_column, unlabelled
from ..curves.layouts import ask_about_curves, settled_layout
from ..curves.reference_systems import check_reference_systems
from ..measures.registry import MeasureName
from .pairwise import _check_names, checked_limit, of_compiled

__all__ = ["Prepared"]


# Shared text: measure(all)
class Prepared:
    """A curve P prepared for comparison with many curves.

    ``Prepared(P, measure, **options)(Q)`` is bitwise identical to ``measure(P, Q, **options)``. P
    is checked, packed and scaled only once. The object may be called from several threads at once.
    P is copied: later changes of the array have no effect.

    Parameters
    ----------
    P : array_like, shape (n, d)
        The reference, e.g. the experiment.
    measure : str
        The name of a measure: "area", "pcm", "frechet", "dtw", "curve_length",
        "frechet_continuous", "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm",
        "twe", "wdtw".
    **options
        Options of the measure's own function, except ``workers``.

    Raises
    ------
    ValueError, TypeError
        As for the measure.

    Notes
    -----
    Each call saves work of O(n): the checks and the packing of P, for pcm its scaling and arc
    lengths, for curve_length its arc lengths.

    Examples
    --------
    >>> import curvewise
    >>> against_ramp = curvewise.Prepared([0, 1, 2, 3], "dtw")
    >>> against_ramp([0, 0, 3, 3])
    2.0
    >>> against_ramp([[0, 0, 3, 3], [0, 3, 0]]).tolist()
    [2.0, 5.0]
    """

    def __init__(self, P: CurveLike, measure: MeasureName = "dtw", **options: Any) -> None:
        curve = as_curve(P, "P")
        ask_about_curves(curve)  # and not about any Q, which has the same number of coordinates
        self._curve = copy_of(curve)
        self._columns = column_names(P)
        self._measure = _check_names(measure, options)
        self._options = of_compiled(self._measure, options)
        self._prepared = CompiledPrepared(self._curve, self._measure, self._options)

    def __repr__(self) -> str:
        options = "".join(f", {name}={value!r}" for name, value in self._options.items())
        return f"Prepared(<P of shape {self._curve.shape}>, {self._measure!r}{options})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _prepare, (self._curve, self._columns, self._measure, self._options)

    @overload
    def __call__(
        self,
        Q: Array,
        *,
        workers: SupportsIndex = Default.workers,
        cutoff: SupportsFloat | None = None,
    ) -> float: ...
    @overload
    def __call__(
        self,
        Q: Any,
        *,
        workers: SupportsIndex = Default.workers,
        cutoff: SupportsFloat | None = None,
    ) -> Any: ...
    def __call__(
        self,
        Q: Any,
        *,
        workers: SupportsIndex = Default.workers,
        cutoff: SupportsFloat | None = None,
    ) -> Any:
        """Return the measure of P and Q, or of P and each curve of a list.

        Parameters
        ----------
        Q : array_like, shape (m, d); or an array of shape (k, m, d), or a list or tuple of curves
            A list or tuple is a list of curves if its first element has the same number of array
            dimensions as `P`. Labelled collections, as for :func:`cdist`, are also lists of curves.
        workers : int
            Number of threads for a list, as for :func:`cdist`.
        cutoff : float, optional
            Upper limit for this call: return inf for distances above it, which takes less time.

        Returns
        -------
        float, or ndarray of shape (k,), or Series
            A float for one curve, an array for several, and a Series for several with labels.

        Raises
        ------
        ValueError, TypeError
            As for the measure, and for :func:`cdist`.
        """
        if cutoff is None:
            limit = np.inf
            if isinstance(Q, np.ndarray) and Q.ndim < 3:  # the usual case, without names
                return self._prepared.value(as_curve(Q, "Q"))
        else:
            limit = checked_limit("cutoff", cutoff, self._measure, self._options)
        check_reference_systems(self._options, Q=Q)
        Q, labels = unlabelled(Q, "Q")
        if labels is not None or self._is_list(Q):
            for i, curve in enumerate(Q):
                check_column_names(self._columns, "P", column_names(curve), f"Q[{i}]")
            curves = as_curve_list(Q, "Q", keep_float32=True, layout="channels_last")
            return labelled_column(self._prepared.values(curves, workers, limit), labels)
        check_column_names(self._columns, "P", column_names(Q), "Q")
        return self._prepared.value_within(as_curve(Q, "Q"), limit)

    def _is_list(self, Q: Any) -> bool:
        if isinstance(Q, list | tuple):
            if len(Q) == 0 or is_curve_of_another_package(Q[0]):
                return True
            return bool(np.ndim(Q[0]) == self._curve.ndim)
        return np.ndim(Q) == 3


def _prepare(
    P: Array, columns: list[Any], measure: MeasureName, options: dict[str, Any]
) -> Prepared:
    with settled_layout():
        prepared = Prepared(P, measure, **options)
    prepared._columns = columns  # of the DataFrame that P once was
    return prepared
