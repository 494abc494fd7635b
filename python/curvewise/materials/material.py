"""The base of every point of material: names of parameters in, stresses and slopes out.

A material is a frozen dataclass of its options; the compiled library computes its stresses
(cpp/include/curvewise/materials.hpp says how). O(n) time and memory for n strains, and for slopes
by k parameters k / 8 times that.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._names import did_you_mean
from ..curves.inputs import Array, as_curve
from ..curves.several_curves import as_points, curve_list

__all__ = ["DrivenModel", "Material", "Parameter"]


class Parameter(NamedTuple):
    """One parameter of a material.

    Attributes
    ----------
    name : str
        As in the dict of parameters.
    unit : str
        "stress", the unit that the stresses are to have, or "-".
    meaning : str
        What it is, in words.
    """

    name: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Material(ABC):
    """A point of material under uniaxial strain, unloaded at the start, without rate."""

    @property
    @abstractmethod
    def _compiled(self) -> tuple[Any, Any]:
        """The compiled functions of parameters and of stresses."""

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters in their order, with units and meaning."""
        return tuple(Parameter(*row) for row in self._compiled[0](asdict(self)))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters, in their order."""
        return tuple(parameter.name for parameter in self.parameters)

    def stress(self, strain: npt.ArrayLike, parameters: Mapping[str, float]) -> Array:
        """Return the stress at each strain of a path.

        Parameters
        ----------
        strain : array_like, shape (n,)
            Strain [-], in the order of loading; it runs monotonically from each value to the next,
            and from 0 to the first.
        parameters : mapping of str to float
            A number for each of `names`.

        Returns
        -------
        ndarray, shape (n,)
            In the unit of the parameters that are stresses.

        Raises
        ------
        ValueError
            A strain or a parameter is not finite or makes no sense, or a name is missing or
            unknown.
        """
        found: Array = self._call(strain, parameters, False)
        return found

    def stress_and_slopes(
        self, strain: npt.ArrayLike, parameters: Mapping[str, float]
    ) -> tuple[Array, Array]:
        """Return the stress, and its derivative by every parameter.

        Exact derivatives of what `stress` computes, in the same pass. Parameters and errors are
        those of `stress`.

        Returns
        -------
        stress : ndarray, shape (n,)
        slopes : ndarray, shape (n, k)
            In the order of `names`.
        """
        stress, slopes = self._call(strain, parameters, True)
        return stress, slopes

    def driven_by(self, experiments: Any) -> DrivenModel:
        """Return a model for `identify`: this material along the strains of measured loops.

        Parameters
        ----------
        experiments : array_like of shape (n, 2), or sequence of such
            Strain and stress of each test.

        Returns
        -------
        DrivenModel
            A callable of a dict of parameters; `jacobian` has the slopes.

        Raises
        ------
        ValueError
            A test has other than two columns.
        """
        strains = []
        for i, experiment in enumerate(curve_list(experiments)):
            points = as_points(experiment, f"experiments[{i}]")
            if points.shape[1] != 2:
                raise ValueError(
                    f"experiments[{i}] has shape {points.shape}; give strain and stress, (n, 2)"
                )
            strains.append(points[:, 0].copy())
        return DrivenModel(self, tuple(strains))

    def _call(self, strain: npt.ArrayLike, parameters: Mapping[str, float], slopes: bool) -> Any:
        path = as_curve(strain, "strain")
        if path.ndim != 1:
            raise ValueError(f"strain has shape {path.shape}; give one value per point, shape (n,)")
        return self._compiled[1](asdict(self), self._values(parameters), path, slopes)

    def _values(self, parameters: Mapping[str, float]) -> Array:
        """Return the numbers in the order of `names`."""
        names = self.names
        if set(parameters) != set(names):
            wrong = [name for name in parameters if name not in names]
            missing = [name for name in names if name not in parameters]
            what = f"has no parameter {wrong[0]!r}" if wrong else f"needs {', '.join(missing)}"
            raise ValueError(
                f"{type(self).__name__} {what}{did_you_mean(wrong, names)} "
                f"(its parameters: {', '.join(names)})"
            )
        return np.array([parameters[name] for name in names], dtype=np.float64)


@dataclass(frozen=True)
class DrivenModel:
    """A material along given paths of strain: a model for `identify`, with its slopes.

    Attributes
    ----------
    material : Material
    strains : tuple of ndarray
        The path of each test.
    """

    material: Material
    strains: Sequence[Array]

    def __call__(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return the curve of each test, shape (n, 2): strain and stress."""
        return [
            np.column_stack((strain, self.material.stress(strain, parameters)))
            for strain in self.strains
        ]

    def jacobian(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return for each test the derivatives of its points by every parameter, (n, 2, k)."""
        found = []
        for strain in self.strains:
            slopes = self.material.stress_and_slopes(strain, parameters)[1]
            found.append(np.stack((np.zeros_like(slopes), slopes), axis=1))
        return found
