"""Labels of curves in the input, and results that keep them.

A dict of curves, a groupby of pandas, a Series of curves and a GeoDataFrame of lines have a label
for each curve; a list and an array do not. Input with labels gives results in pandas, with the
labels as their index; input without labels gives numpy arrays. pandas is imported only for such
results. The cost is that of the index: two numbers for each of the k (k-1) / 2 values of a
triangle.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .._extras import extra
from .column_roles import are_coordinates, coordinates_among
from .foreign_curves import column_names

__all__ = [
    "Labels",
    "check_distinct",
    "in_order_of",
    "labelled_column",
    "labelled_matrix",
    "labelled_triangle",
    "labels_at",
    "taken",
    "unlabelled",
]

Labels: TypeAlias = Any
"""A list, or an index of pandas; None where curves have no labels."""

_UNLABELLED = (list, tuple, np.ndarray)


def unlabelled(curves: Any, name: str) -> tuple[Any, Labels]:
    """Return a collection of curves as a list, and its labels, if any.

    Raises
    ------
    ValueError
        If groups have columns that are probably not all coordinates.
    """
    if isinstance(curves, _UNLABELLED):
        return curves, None
    if isinstance(curves, Mapping) and not hasattr(curves, "shape"):  # as scipy's dok_array has
        return list(curves.values()), list(curves)
    if hasattr(curves, "exclusions") and hasattr(curves, "ngroups"):
        return _groups(curves, name)
    is_table = hasattr(curves, "columns")
    series = getattr(curves, "geometry", curves) if is_table else curves  # of a GeoDataFrame
    if hasattr(series, "iloc") and not hasattr(series, "columns") and series.dtype.kind == "O":
        return list(series), series.index
    return curves, None


def _groups(grouped: Any, name: str) -> tuple[list[Any], list[Any]]:
    """Return the groups of a groupby of pandas, without the columns that they are grouped by."""
    groups, labels = [], []
    for label, group in grouped:
        alone = isinstance(label, tuple) and len(label) == 1  # as of groupby(["track"])
        labels.append(label[0] if alone else label)
        keys = [key for key in grouped.exclusions if key in column_names(group)]
        groups.append(group.drop(columns=keys) if keys else group)
    names = column_names(groups[0]) if groups else []
    if len(names) > 2 and not are_coordinates(names):
        raise ValueError(
            f"{name} has groups with columns {names}, each of which would be a coordinate; choose: "
            f"{name}[{coordinates_among(names)}] for example"
        )
    return groups, labels


def in_order_of(values: Any, curves: Any, name: str) -> Any:
    """Return one value for each curve in the order of the curves, if both have labels.

    An index that only counts, as pandas adds to unlabelled data, does not count as labels, unless
    it counts the curves in another order.

    Raises
    ------
    ValueError
        If labels differ, or are not distinct.
    """
    if not hasattr(values, "iloc"):
        return values
    _, labels = unlabelled(curves, "X")
    if labels is None:
        return values
    ours, theirs = _flat(labels), _flat(values.index)
    if ours.equals(theirs):
        return values
    if ours.is_unique and theirs.is_unique and len(ours) == len(theirs) and ours.isin(theirs).all():
        return values.iloc[theirs.get_indexer(ours)]
    if _only_counts(ours) or _only_counts(theirs):
        return values
    raise ValueError(
        f"{name} has the labels {_some(theirs)} and the curves have {_some(ours)}; give one value "
        f"for each label, or {name}.to_numpy() in the order of the curves"
    )


def _only_counts(index: Any) -> bool:
    return list(index) == list(range(len(index)))


def _some(index: Any) -> str:
    shown = ", ".join(map(repr, index[:4]))
    return f"{shown}, …" if len(index) > 4 else shown


def check_distinct(labels: Labels, name: str, known: Container[Any] = ()) -> None:
    """Refuse a label that two curves have, here or among those `known`, where labels answer."""
    seen = set()
    for label in () if labels is None else labels:
        if label in seen or label in known:
            raise ValueError(
                f"{name} has the label {label!r}, which another curve has, too; give distinct "
                "labels, since the answer is a label"
            )
        seen.add(label)


def labelled_matrix(values: npt.NDArray[Any], rows: Labels, columns: Labels) -> Any:
    """Return a matrix as a DataFrame over the same memory, if its rows or columns have labels."""
    if rows is None and columns is None:
        return values
    return _pandas().DataFrame(values, index=rows, columns=columns, copy=False)


def labelled_column(values: npt.NDArray[Any], labels: Labels) -> Any:
    """Return one value for each curve as a Series, if the curves have labels."""
    return values if labels is None else _pandas().Series(values, index=labels, copy=False)


def labelled_triangle(values: npt.NDArray[Any], labels: Labels) -> Any:
    """Return a condensed matrix as a Series over pairs of labels, if the curves have labels."""
    if labels is None:
        return values
    pandas = _pandas()
    codes, levels = pandas.factorize(_flat(labels))
    pairs = [codes[places] for places in np.triu_indices(len(codes), 1)]
    index = pandas.MultiIndex(levels=[levels, levels], codes=pairs, verify_integrity=False)
    return pandas.Series(values, index=index, copy=False)


def labels_at(labels: Labels, places: npt.NDArray[np.int64]) -> npt.NDArray[Any]:
    """Return the labels of curves by their indices; without labels the indices."""
    return places if labels is None else np.asarray(_flat(labels).to_numpy()[places])


def taken(labels: Labels, places: npt.NDArray[np.int64]) -> Labels:
    """Return the labels of some curves, by their ascending indices, as they came in."""
    if len(places) == len(labels):
        return labels
    return [labels[i] for i in places] if isinstance(labels, list) else labels.take(places)


def _flat(labels: Labels) -> Any:
    """Return an index whose entries are the labels, also where these are tuples."""
    index = _pandas().Index(labels, tupleize_cols=False)
    return index.to_flat_index()


def _pandas() -> Any:
    with extra("curves", "what comes in with labels comes back in pandas", ", or give a list"):
        return import_module("pandas")
