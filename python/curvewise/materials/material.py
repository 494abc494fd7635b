"""The base of every point of material: names of parameters in, stresses and slopes out.

A material is a frozen dataclass of its options; the compiled library computes its stresses
(cpp/include/curvewise/materials.hpp says how). O(n) time and memory for n strains, and for slopes
by k parameters k / 8 times that.
"""

from __future__ import annotations

import datetime
import hashlib
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from .._bounds import Bounds, Log, OutsideModelError, on_its_scale
from .._names import did_you_mean
from ..curves.inputs import Array, as_curve
from ..curves.several_curves import curve_list
from ..installation import build_info
from ..solvers.cards import CardContent, card_text
from .card_paths import CYCLES, paths_of
from .readings import Reading, Span, reading_of, strain_and_stress

__all__ = ["DrivenModel", "Material", "Parameter", "Part"]

Part: TypeAlias = "slice | npt.NDArray[np.int64]"


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
class Material(ABC):
    """A point of material under uniaxial strain, unloaded at the start, without rate."""

    @property
    @abstractmethod
    def _compiled(self) -> tuple[Any, Any]:
        """The compiled functions of parameters and of stresses."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters in their order, with units and meaning."""
        return _parameters_of(self)

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

    def driven_by(self, experiments: Any, *, parts: Sequence[Part] | None = None) -> DrivenModel:
        """Return a model for `identify`: this material along the strains of loops.

        Parameters
        ----------
        experiments : array_like of shape (n, 2), or sequence of such
            Strain and stress of each test.
        parts : sequence of slice or ndarray of int, optional
            For each test the points of the returned curve, such as
            :func:`curvewise.curves.last_cycle`; the whole test drives the material in any case.

        Returns
        -------
        DrivenModel
            A callable of a dict of parameters; `jacobian` returns the derivatives.

        Raises
        ------
        ValueError
            If a test does not have two columns.
        """
        strains = [
            strain_and_stress(experiment, f"experiments[{i}]")[:, 0].copy()
            for i, experiment in enumerate(curve_list(experiments))
        ]
        return DrivenModel(self, tuple(strains), None if parts is None else tuple(parts))

    def bounds_from(self, experiments: Any) -> Bounds:
        """Return bounds for `identify`, derived from the tests.

        They follow from the modulus, the yield stress, and the largest stresses and plastic strains
        (`readings`). Hardening ranges from saturation within a hundredth of a branch to barely any
        within the whole test, up to several times the stress. Bounds of more than a decade use
        :class:`curvewise.calibration.Log`. They are wide on purpose: the tests do not determine a
        parameter that ends at one of them. Bounds at 0 are limits: nothing lies beyond.

        Parameters
        ----------
        experiments : array_like of shape (n, 2), or sequence of such
            Strain [-] and stress of each test, from the unloaded state.

        Returns
        -------
        dict of str to (low, high), Log or Below
            The bounds, in the order of `names`.

        Raises
        ------
        ValueError
            If a test does not have two columns, has strains in per cent, or is elastic.
        """
        readings = [
            reading_of(experiment, f"experiments[{i}]")
            for i, experiment in enumerate(curve_list(experiments))
        ]
        found = {**self._modulus_bounds(readings), **self._hardening_bounds(Span.of(readings))}
        return {name: found[name] for name in self.names}

    @abstractmethod
    def _hardening_bounds(self, span: Span) -> Bounds:
        """Return the bounds of all parameters except for those of the modulus."""

    def _modulus_bounds(self, readings: Sequence[Reading]) -> Bounds:
        moduli = [modulus for reading in readings for modulus in reading.moduli]
        low, high = min(moduli), 4.0 * max(moduli)
        bounds: dict[str, Any] = {"E": on_its_scale(0.5 * low, high)}
        if "Ea" in self.names:
            path = max(reading.path for reading in readings)
            bounds["Ea"] = on_its_scale(0.3 * low, high)
            bounds["xi"] = Log(1 / path, 1000 / path)
        return bounds

    def card(
        self,
        parameters: Mapping[str, float],
        solver: str,
        *,
        name: str = "material",
        units: str = "MPa",
        poisson: float = 0.3,
        intervals: Mapping[str, tuple[float, float]] | None = None,
        undetermined: Collection[str] = (),
        date: str | None = None,
        along: Any = None,
        verdict: Sequence[str] = (),
    ) -> str:
        """Return the material card of a solver, with these parameters.

        Parameters
        ----------
        parameters : mapping of str to float
            A number for each of `names`, such as the result of `identify`.
        solver : {"abaqus", "ansys", "ls-dyna", "calculix", "mfront", "code_aster"}
        name : str, default "material"
            The name of the material: a letter, then letters, digits and underscores.
        units : str, default "MPa"
            The unit of the stresses among the parameters. It is written; nothing is converted.
        poisson : float, default 0.3
            Poisson's ratio, between -1 and 0.5: uniaxial tests do not determine it.
        intervals : mapping of str to (low, high), optional
            Intervals to write next to the parameters, such as the `intervals` of an `Uncertainty`.
        undetermined : collection of str, optional
            Parameters that the comments mark as NOT DETERMINED.
        date : str, optional
            The date of the fit; by default today.
        along : array_like of shape (n,), or sequence of such, optional
            Strains on which a card of "calculix" must follow the material, such as the `strains` of
            a `DrivenModel`; by default cycles that grow to ±3 %. The other solvers do not need it.
        verdict : sequence of str, optional
            Lines for the comments, such as those of `MaterialFit.verdict`.

        Returns
        -------
        str
            Comments with parameters, units, date, intervals and the manual's section, and the
            solver's keywords. Numbers have the digits that give the same double when read. If a
            field is too short for them, a comment lists the rounded ones.

        Raises
        ------
        ValueError
            If the solver does not have this model, or cannot represent these numbers; the message
            states the remedy. If an argument or a parameter is out of its range.
        ImportError
            If scipy is missing for CalculiX.

        Notes
        -----
        "calculix": if a back stress has recall (gamma), the card is an overlay of several elements.
        It follows the material along the paths `along`, within a stated fraction of the loop's
        stress range: about 0.3 % for one loop.

        Examples
        --------
        >>> from curvewise.materials import ChabocheVoce
        >>> steel = ChabocheVoce(backstresses=1)
        >>> constants = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0)))
        >>> card = steel.card(constants, "abaqus", name="DP780")
        >>> print(card[card.index("*MATERIAL") :])
        *MATERIAL, NAME=DP780
        *ELASTIC
        200000.0, 0.3
        *PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS, NUMBER BACKSTRESSES=1
        300.0, 80000.0, 400.0
        *CYCLIC HARDENING, PARAMETERS
        300.0, -50.0, 8.0
        <BLANKLINE>
        """
        numbers = dict(zip(self.names, self._values(parameters).tolist(), strict=True))
        self.stress([0.0, 1e-3], numbers)  # refuses parameters that make no sense
        if not -1.0 < poisson < 0.5:
            raise ValueError(f"poisson is {poisson}; give a ratio between -1 and 0.5")
        date = str(date or datetime.date.today())
        needed = {
            "units": (units, "name the unit of stress, such as 'MPa'"),
            "date": (date, "give it in one line of printable characters, such as '2026-11-23'"),
        }
        for argument, (text, what_to_do) in needed.items():  # a second line would be a keyword
            if not text.isprintable() or not text.strip():
                raise ValueError(f"{argument} is {text!r}; {what_to_do}")
        for argument, given in {"intervals": intervals or {}, "undetermined": undetermined}.items():
            if wrong := [parameter for parameter in given if parameter not in numbers]:
                raise ValueError(
                    f"{argument} has {wrong[0]!r}{did_you_mean(wrong, numbers)} (the parameters: "
                    f"{', '.join(numbers)})"
                )
        content = CardContent(
            model=type(self).__name__,
            described=repr(self),
            options=asdict(self),
            parameters=numbers,
            units={p.name: units if p.unit == "stress" else p.unit for p in self.parameters},
            meanings={p.name: p.meaning for p in self.parameters},
            name=name,
            date=date,
            poisson=float(poisson),
            intervals={
                parameter: (float(low), float(high))
                for parameter, (low, high) in (intervals or {}).items()
            },
            undetermined=frozenset(undetermined),
            along=CYCLES if along is None else paths_of(along),
            stress=lambda strain: self.stress(strain, numbers),
            verdict=tuple(verdict),
        )
        return card_text(content, solver)

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


@cache  # not within the material: a model that has run must be the same to a store
def _parameters_of(material: Material) -> tuple[Parameter, ...]:
    return tuple(Parameter(*row) for row in material._compiled[0](asdict(material)))


@dataclass(frozen=True)
class DrivenModel:
    """A material along given paths of strain: a model for `identify`, with its slopes.

    Attributes
    ----------
    material : Material
    strains : tuple of ndarray
        The path of each test.
    parts : tuple of slice or ndarray of int, or None
        Which of its points the curve of each test has; None for all.
    """

    material: Material
    strains: Sequence[Array]
    parts: Sequence[Part] | None = None

    def __call__(self, parameters: Mapping[str, float]) -> list[Array]:
        """Return the curve of each test, shape (n, 2): strain and stress.

        Raises
        ------
        OutsideModelError
            If the material does not have a stress with these parameters, such as Q below -yield.
        """
        try:
            return [
                np.column_stack((strain, self.material.stress(strain, parameters)))[part]
                for strain, part in self._paths()
            ]
        except ValueError as error:
            raise OutsideModelError(str(error)) from None

    @property
    def identity(self) -> str:
        """The identity of runs in a store: material, paths, and the computing version."""
        digest = hashlib.sha256(repr(self.parts).encode())
        for path in (*self.strains, *self._indices()):
            digest.update(path.tobytes())
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
        for strain, part in self._paths():
            slopes = self.material.stress_and_slopes(strain, parameters)[1][part][:, order]
            found.append(np.stack((np.zeros_like(slopes), slopes), axis=1))
        return found

    def _indices(self) -> list[npt.NDArray[np.int64]]:
        """Return the parts that are arrays, which their repr shortens."""
        return [part for part in self.parts or () if not isinstance(part, slice)]

    def _paths(self) -> Iterator[tuple[Array, Part]]:
        parts = self.parts or [slice(None)] * len(self.strains)
        return zip(self.strains, parts, strict=True)
