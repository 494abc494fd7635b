"""A point of material: names of parameters in, stresses or strains and their derivatives out.

A material is a frozen dataclass of its options; the compiled library computes its stresses
(cpp/include/curvewise/materials.hpp says how). O(n) time and memory for n strains, and for slopes
by k parameters k / 8 times that.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from .._core import material_parameters, material_response, material_stress
from .._names import did_you_mean
from ..curves.inputs import Array, as_curve

__all__ = ["MaterialPoint", "Parameter", "parameters_of"]


class Parameter(NamedTuple):
    """One parameter of a material.

    Attributes
    ----------
    name : str
        The name in the dict of parameters.
    unit : str
        "stress", the unit of the stresses, or "-".
    meaning : str
        The meaning.
    """

    name: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class MaterialPoint:
    """A point of material under uniaxial strain or stress, unloaded at the start, without rate."""

    name: ClassVar[str]
    """The material's name in C++, C and Fortran, in commands and in studies."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters in their order, with units and meaning."""
        return parameters_of(self)

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
            The bounds, in the order of `names`.
        """
        stress, slopes = self._call(strain, parameters, True)
        return stress, slopes

    def strain(self, stress: npt.ArrayLike, parameters: Mapping[str, float]) -> Array:
        """Return the strain at each stress of a path: `response` where all stresses are given.

        Examples
        --------
        Ratcheting: each cycle between unequal stresses leaves more strain.

        >>> from curvewise.materials import ChabocheVoce
        >>> steel = ChabocheVoce(backstresses=1)
        >>> constants = dict(zip(steel.names, (200e3, 300.0, 0.0, 1.0, 80e3, 400.0)))
        >>> steel.strain([450.0, -400.0, 450.0, -400.0, 450.0], constants)[::2].round(5)
        array([0.00572, 0.00706, 0.00841])
        """
        return self.response(stress, True, parameters)

    def response(
        self, given: npt.ArrayLike, by_stress: npt.ArrayLike, parameters: Mapping[str, float]
    ) -> Array:
        """Return the stress where strains of a path are given, and the strain where stresses are.

        Parameters
        ----------
        given : array_like, shape (n,)
            Strain [-] or stress, in the order of loading.
        by_stress : bool, or array_like of bool of shape (n,)
            Whether a point gives the stress.
        parameters : mapping of str to float
            A number for each of `names`.

        Returns
        -------
        ndarray, shape (n,)
            The other coordinate of each point. A stress is reached by the first strain that a
            search finds. For a material that hardens it is the only one.

        Raises
        ------
        ValueError
            As for `stress`; and if hardening ends before a stress.

        Notes
        -----
        About ten times the time of `stress`. If the stress falls in the loading direction (Q below
        0), a stress near the peak may be reached by more than one strain.
        """
        found: Array = self._respond(given, by_stress, parameters, False)
        return found

    def response_and_slopes(
        self, given: npt.ArrayLike, by_stress: npt.ArrayLike, parameters: Mapping[str, float]
    ) -> tuple[Array, Array]:
        """Return what `response` does, and its derivative by every parameter, shape (n, k)."""
        found, slopes = self._respond(given, by_stress, parameters, True)
        return found, slopes

    def _call(self, strain: npt.ArrayLike, parameters: Mapping[str, float], slopes: bool) -> Any:
        path = as_curve(strain, "strain")
        if path.ndim != 1:
            raise ValueError(f"strain has shape {path.shape}; give one value per point, shape (n,)")
        return material_stress(_text_of(self), self._values(parameters), path, slopes)

    def _respond(
        self,
        given: npt.ArrayLike,
        by_stress: npt.ArrayLike,
        parameters: Mapping[str, float],
        slopes: bool,
    ) -> Any:
        path = as_curve(given, "given")
        if path.ndim != 1:
            raise ValueError(f"given has shape {path.shape}; give one value per point, shape (n,)")
        stresses = np.asarray(by_stress)
        if stresses.dtype != np.bool_ or stresses.shape not in ((), path.shape):
            raise ValueError(
                f"by_stress has shape {stresses.shape} of {stresses.dtype}; give True, False, or "
                f"one of them for each of the {len(path)} points"
            )
        every = np.ascontiguousarray(np.broadcast_to(stresses, path.shape))
        return material_response(_text_of(self), self._values(parameters), path, every, slopes)

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


@cache  # not within the material: a model that has run must be the same to a store
def parameters_of(material: MaterialPoint) -> tuple[Parameter, ...]:
    """Return the parameters of a material; raise ValueError if its options make no sense."""
    return tuple(Parameter(*row) for row in material_parameters(_text_of(material)))


@cache
def _text_of(material: MaterialPoint) -> str:
    """Return the name and the options as the compiled library reads them."""
    return " ".join(
        [material.name, *(f"{name}={value}" for name, value in asdict(material).items())]
    )
