"""Values and derivatives of pairs for other packages' losses: padded batches, and the divergence.

Pairs of the same lengths are computed together, by the compiled library.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from ..curves.inputs import Array
from ..curves.layouts import settled_layout
from .gradient import check_pairs, of_arrays

__all__ = ["Lengths", "check_length_shapes", "loss_and_gradients", "with_lengths_of_lists"]

Counts: TypeAlias = npt.NDArray[np.int64]
Lengths: TypeAlias = tuple[Any, Any] | None
Found: TypeAlias = tuple[Array, Array, Array]


def with_lengths_of_lists(lengths: Any, of_lists: tuple[Any, Any]) -> tuple[Any, Any]:
    """Return the lengths of P and of Q: those given, or those of lists of curves."""
    if lengths is None:
        return of_lists
    if not (isinstance(lengths, tuple | list) and len(lengths) == 2):
        raise TypeError(
            "lengths is not a pair; give lengths=(those of P, those of Q), either or None"
        )
    for given, known, name in zip(lengths, of_lists, "PQ", strict=True):
        if given is not None and known is not None:
            raise TypeError(f"{name} is a list, whose curves have lengths; give None for it")
    return tuple(
        known if given is None else given for given, known in zip(lengths, of_lists, strict=True)
    )


def check_length_shapes(shape: tuple[int, ...], batch: tuple[int, ...], name: str) -> None:
    """Refuse lengths that are not one number a curve."""
    if not batch or shape != batch:
        raise ValueError(
            f"the lengths of {name} have shape {shape} and its batch has shape {batch}; give one "
            "length for each curve of a padded batch (b, n, d)"
        )


def loss_and_gradients(
    P: Array,
    Q: Array,
    measure: str,
    options: Mapping[str, Any],
    *,
    by: tuple[bool, bool] = (True, True),
    lengths: tuple[Any, Any] = (None, None),
) -> Found:
    """Return values and derivatives of arrays of shapes (..., n, d) and (..., m, d).

    Lengths, integers of shape (...), say how many points of each curve count; derivatives by the
    others are 0, and they may be nan.
    """
    check_pairs(P.shape, Q.shape)
    of_P, of_Q = (
        _checked(counts, C.shape, name)
        for counts, C, name in zip(lengths, (P, Q), "PQ", strict=True)
    )
    if (of_P == P.shape[-2]).all() and (of_Q == Q.shape[-2]).all():
        try:
            return _of_pairs(P, Q, measure, options, by)
        except ValueError as error:
            raise ValueError(f"{error}{_advice_on_padding(error, P, Q)}") from None
    return _of_groups(P, Q, measure, options, by, np.stack((of_P, of_Q)).reshape(2, -1))


def _checked(counts: Any, shape: tuple[int, ...], name: str) -> Counts:
    if counts is None:
        return np.full(shape[:-2], shape[-2])
    found = np.asarray(counts)
    if found.dtype.kind not in "iu":
        raise TypeError(f"the lengths of {name} are of type {found.dtype}; give whole numbers")
    wrong = (found < 1) | (found > shape[-2])
    if wrong.any():
        where = tuple(np.argwhere(wrong)[0].tolist())
        raise ValueError(
            f"length {found[where]} of curve {', '.join(map(str, where))} of {name}; give a whole "
            f"number from 1 to {shape[-2]}, the points of the batch"
        )
    return found


def _advice_on_padding(error: ValueError, P: Array, Q: Array) -> str:
    ends_in_nan = any(np.isnan(C[..., -1:, :]).all(axis=-1).any() for C in (P, Q))
    if "is nan" not in str(error) or not ends_in_nan:
        return ""
    return (
        "; curves that end in rows of nan look padded: give lengths=(those of P, those of Q), or "
        "lists of curves"
    )


def _of_groups(
    P: Array,
    Q: Array,
    measure: str,
    options: Mapping[str, Any],
    by: tuple[bool, bool],
    counts: Counts,
) -> Found:
    """Compute pairs of the same lengths together, and each such group in a thread."""
    first, second = (C.reshape(-1, *C.shape[-2:]) for C in (P, Q))
    values = np.empty(len(first))
    slopes = [
        np.zeros(C.shape) if wanted else None for C, wanted in zip((first, second), by, strict=True)
    ]
    sizes, group_of = np.unique(counts, axis=1, return_inverse=True)

    def compute(group: int) -> None:
        members = np.flatnonzero(group_of.reshape(-1) == group)
        used = sizes[:, group]
        P_used, Q_used = (
            np.ascontiguousarray(C[members, :k]) for C, k in zip((first, second), used, strict=True)
        )
        try:
            values[members], *found = _of_pairs(P_used, Q_used, measure, options, by, workers=1)
        except ValueError as error:
            raise ValueError(_renumbered(str(error), members)) from None
        for slope, part, k in zip(slopes, found, used, strict=True):
            if slope is not None:
                slope[members, :k] = part

    with ThreadPoolExecutor() as pool:
        list(pool.map(compute, range(sizes.shape[1])))
    batch = P.shape[:-2]
    by_P, by_Q = (
        np.empty((*batch, 0, 0)) if slope is None else slope.reshape(C.shape)
        for slope, C in zip(slopes, (P, Q), strict=True)
    )
    return values.reshape(batch), by_P, by_Q


def _renumbered(message: str, members: Counts) -> str:
    """Name the pair by its place in the batch, not in its group."""
    numbered = re.match(r"pair (\d+): ", message)
    if numbered is None:
        return f"pair {members[0]}: {message}"
    return f"pair {members[int(numbered[1])]}: {message[numbered.end() :]}"


def _of_pairs(
    P: Array,
    Q: Array,
    measure: str,
    options: Mapping[str, Any],
    by: tuple[bool, bool],
    workers: SupportsIndex = -1,
) -> Found:
    if measure != "soft_dtw_divergence":
        return of_arrays(P, Q, measure, options, by=by, workers=workers)
    values, *slopes = of_arrays(P, Q, "soft_dtw", options, by=by, workers=workers)
    own = []
    with settled_layout():
        for k, (C, wanted) in enumerate(zip((P, Q), by, strict=True)):
            within, first, second = of_arrays(
                C, C, "soft_dtw", options, by=(wanted, wanted), workers=workers
            )
            own.append(within)
            slopes[k] = slopes[k] - 0.5 * (first + second)
    return values - 0.5 * (own[0] + own[1]), slopes[0], slopes[1]
