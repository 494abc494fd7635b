"""A material along the paths of tests: a model for `identify`, with its derivatives.

A test drives the material by its strains, by its stresses, or by the strains of some points and the
stresses of the others. Cost: that of the material.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from .._bounds import OutsideModelError
from ..curves.inputs import Array
from ..installation import build_info
from .point import MaterialPoint

__all__ = ["DrivenModel", "GivenStresses", "Part", "PointType", "given_stresses"]

PointType = TypeVar("PointType", bound=MaterialPoint)
Part: TypeAlias = "slice | npt.NDArray[np.int64]"


class GivenStresses(NamedTuple):
    """The stresses that drive a test.

    Attributes
    ----------
    points : ndarray of bool, shape (n,)
        Which points of the test give the stress.
    values : ndarray, shape (n,)
        The stresses of all points.
    """

    points: npt.NDArray[np.bool_]
    values: Array


def given_stresses(tests: Sequence[Array], control: Any) -> tuple[GivenStresses | None, ...] | None:
    """Return which stresses drive each test; None if strains alone drive all of them.

    Parameters
    ----------
    tests : sequence of ndarray of shape (n, 2)
    control
        As for :meth:`Material.driven_by`.

    Raises
    ------
    ValueError
        If `control` is neither a name, nor an array of bool of each test's length.
    """
    is_list = isinstance(control, list | tuple) and not _are_bools(control)
    controls = list(control) if is_list else [control] * len(tests)
    if len(controls) != len(tests):
        raise ValueError(f"control has {len(controls)} entries for {len(tests)} tests")
    found = []
    for i, (test, one) in enumerate(zip(tests, controls, strict=True)):
        if isinstance(one, str) and one in ("strain", "stress"):
            points = np.full(len(test), one == "stress")
        elif not isinstance(one, str) and _are_bools(one) and np.shape(one) == (len(test),):
            points = np.array(one)
        else:
            shown = repr(one) if isinstance(one, str) else f"of shape {np.shape(one)}"
            raise ValueError(
                f"control of test {i} is {shown}; give 'strain', 'stress', or for each of its "
                f"{len(test)} points True where the stress is given"
            )
        found.append(GivenStresses(points, test[:, 1].copy()) if points.any() else None)
    return tuple(found) if any(found) else None


def _are_bools(control: Any) -> bool:
    return (
        not isinstance(control, str)
        and np.asarray(control, dtype=object).ndim == 1
        and all(isinstance(one, bool | np.bool_) for one in control)
    )


@dataclass(frozen=True)
class DrivenModel(Generic[PointType]):
    """A material along given paths of strain or stress: a model for `identify`, with its slopes.

    Attributes
    ----------
    material : Material
    strains : tuple of ndarray
        The strains of each test.
    parts : tuple of slice or ndarray of int, or None
        Which of its points the curve of each test has; None for all.
    stresses : tuple of GivenStresses or None, or None
        For each test the stresses that drive it; None if strains do.
    rates : tuple of float, or None
        The rate of strain of each test; None for the material's own.
    """

    material: PointType
    strains: Sequence[Array]
    parts: Sequence[Part] | None = None
    stresses: Sequence[GivenStresses | None] | None = None
    rates: Sequence[float] | None = None

    def __call__(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return the curve of each test, shape (n, 2): strain and stress.

        Raises
        ------
        OutsideModelError
            If the material does not have a stress with these parameters, such as Q below -yield, or
            does not reach a stress that is given.
        """
        try:
            return [
                _curve(material, strain, stresses, parameters)[part]
                for material, strain, stresses, part in self._paths()
            ]
        except ValueError as error:
            raise OutsideModelError(str(error)) from None

    @property
    def identity(self) -> str:
        """The identity of runs in a store: material, paths, and the computing version."""
        rates = "" if self.rates is None else repr(self.rates)
        digest = hashlib.sha256((repr(self.parts) + rates).encode())
        for path in (*self.strains, *self._indices()):
            digest.update(path.tobytes())
        for one in self.stresses or ():
            digest.update(b"-" if one is None else one.points.tobytes() + one.values.tobytes())
        version = build_info()["version"]
        return f"{self.material!r}, strains {digest.hexdigest()[:16]}, curvewise {version}"

    def jacobian(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return for each test the derivatives of its points by every parameter, (n, 2, k).

        In the order in which `parameters` has them.
        """
        order = [
            self.material.names.index(name) for name in parameters if name in self.material.names
        ]
        found = []
        for material, strain, stresses, part in self._paths():
            if stresses is None:
                slopes = material.stress_and_slopes(strain, parameters)[1][part][:, order]
                found.append(np.stack((np.zeros_like(slopes), slopes), axis=1))
                continue
            given = np.where(stresses.points, stresses.values, strain)
            slopes = material.response_and_slopes(given, stresses.points, parameters)[1]
            by_stress = stresses.points[:, np.newaxis]
            both = np.stack((np.where(by_stress, slopes, 0.0), np.where(by_stress, 0.0, slopes)), 1)
            found.append(both[part][:, :, order])
        return found

    def _indices(self) -> list[npt.NDArray[np.int64]]:
        """Return the parts that are arrays, which their repr shortens."""
        return [part for part in self.parts or () if not isinstance(part, slice)]

    def _paths(self) -> Iterator[tuple[PointType, Array, GivenStresses | None, Part]]:
        parts = self.parts or [slice(None)] * len(self.strains)
        stresses = self.stresses or [None] * len(self.strains)
        materials = [self.material] * len(self.strains)
        if self.rates is not None:
            options = ({"rate": rate} for rate in self.rates)
            materials = [replace(self.material, **option) for option in options]
        return zip(materials, self.strains, stresses, parts, strict=True)


def _curve(
    material: MaterialPoint,
    strain: Array,
    stresses: GivenStresses | None,
    parameters: Mapping[str, float],
) -> Array:
    """Return all points of a test."""
    if stresses is None:
        return np.column_stack((strain, material.stress(strain, parameters)))
    points, values = stresses
    answer = material.response(np.where(points, values, strain), points, parameters)
    return np.column_stack((np.where(points, answer, strain), np.where(points, values, answer)))
