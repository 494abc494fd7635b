"""Labels of the curves of an index.

Searches read labels without a lock while other threads add and remove curves. So labels are there
before their curves, and the label of a removed curve stays for the searches that still see it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from ..curves.labels import Labels, check_distinct, labels_at, taken

__all__ = ["IndexLabels", "with_gaps"]

Places = npt.NDArray[np.int64]


class IndexLabels:
    """Labels by the indices of curves; none if the first curves have none.

    Parameters
    ----------
    labels : list, pandas.Index or None
        The labels of all curves, with those removed.
    indices : ndarray of int64, optional
        The indices of the curves that remain, by default all.

    Raises
    ------
    ValueError
        If two remaining curves have the same label.
    """

    def __init__(self, labels: Labels, indices: Places | None = None) -> None:
        self.all = labels
        self._values: tuple[Labels, npt.NDArray[Any]] | None = None
        self._indices: dict[Any, int] = {}
        if labels is not None:
            places = range(len(labels)) if indices is None else indices.tolist()
            remaining = labels if indices is None else taken(labels, indices)
            check_distinct(remaining, "curves")
            self._indices = dict(zip(remaining, places, strict=True))

    def at(self, indices: Places) -> npt.NDArray[Any]:
        """Return the labels of these curves; without labels the indices."""
        labels, kept = self.all, self._values
        if labels is None:
            return indices
        if kept is None or kept[0] is not labels:  # pandas takes a while for many labels
            kept = self._values = (labels, labels_at(labels, np.arange(len(labels))))
        return kept[1][indices]

    def of_rows(self, indices: Places) -> Labels:
        """Return the labels of these curves, which ascend, as the index of a result."""
        return None if self.all is None else taken(self.all, indices)

    @contextmanager
    def added(self, labels: Labels) -> Iterator[None]:
        """Add labels in front of the code that adds the curves; restore them if it fails.

        Raises
        ------
        ValueError
            If the labels are not distinct, or if only some curves would have labels.
        """
        if (labels is None) != (self.all is None):
            known, new = ("no labels", "some") if self.all is None else ("labels", "none")
            raise ValueError(
                f"the curves of the index have {known} and those to be added {new}; give all of "
                "them labels, as the keys of a dict, or none"
            )
        if labels is None:
            yield
            return
        check_distinct(labels, "curves", self._indices)
        before = self.all
        self.all = [*before, *labels]
        try:
            yield
        except BaseException:
            self.all = before
            raise
        self._indices.update(zip(labels, range(len(before), len(self.all)), strict=True))

    def indices_of(self, labels: Iterable[Any]) -> list[int]:
        """Return the indices of the curves with these labels.

        Raises
        ------
        ValueError
            If a label is unknown or given twice.
        """
        found: dict[Any, int] = {}
        for label in labels:
            if label not in self._indices:
                raise ValueError(
                    f"indices has the label {label!r}, which no curve of the index has; give "
                    "labels of its curves"
                )
            if label in found:
                raise ValueError(f"indices has the label {label!r} twice; give each label once")
            found[label] = self._indices[label]
        return list(found.values())

    def remove(self, labels: Iterable[Any]) -> None:
        """Forget which curves have these labels, so that others may have them."""
        for label in labels:
            del self._indices[label]


def with_gaps(labels: list[Any] | None, indices: Places, count: int) -> list[Any] | None:
    """Return `count` labels: those of the curves of `indices`, and any of them in between."""
    if not labels:  # of no curves
        return labels if labels is None else [None] * count
    spread = [labels[0]] * count
    for label, index in zip(labels, indices.tolist(), strict=True):
        spread[index] = label
    return spread
