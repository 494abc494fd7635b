"""The base of every material: its model for `identify`, its bounds, and its cards."""

from __future__ import annotations

import datetime
from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, ClassVar

from .._bounds import Bounds, Log, on_its_scale
from .._names import did_you_mean
from ..curves.several_curves import curve_list
from ..solvers.cards import CardContent, card_text
from .card_paths import CYCLES, paths_of
from .driven_model import DrivenModel, Part, PointType, given_stresses
from .point import MaterialPoint, parameters_of
from .readings import MaterialReading, Span, reading_of, strain_and_stress

__all__ = ["Material"]


@dataclass(frozen=True)
class Material(MaterialPoint, ABC):
    """A point of material with bounds that tests suggest, and with material cards.

    The attributes are the record of a material, which commands, studies, fits and cards read.

    Attributes
    ----------
    name : str
        The name in C++, C and Fortran, in commands and in studies.
    yield_stress : str
        Parameter that is the initial yield stress; "" if it is none.
    isotropic : mapping of str to float
        Parameters of isotropic hardening, with values for which there is none. Empty if the
        hardening has no such parameters.
    has_kinematic_hardening : bool
        Whether a reversal shows more than a test of tension.
    """

    yield_stress: ClassVar[str]
    isotropic: ClassVar[Mapping[str, float]] = {}
    has_kinematic_hardening: ClassVar[bool] = True

    def driven_by(
        self: PointType,
        experiments: Any,
        *,
        control: Any = "strain",
        parts: Sequence[Part] | None = None,
        rates: Sequence[float] | None = None,
    ) -> DrivenModel[PointType]:
        """Return a model for `identify`: this material along the strains or stresses of loops.

        Parameters
        ----------
        experiments : array_like of shape (n, 2), or sequence of such
            Strain and stress of each test.
        control : {"strain", "stress"}, array_like of bool of shape (n,), or a list of these
            What drives the material: the measured strains, the measured stresses, or, where an
            array is True, the stresses of these points and the strains of the others. A list has
            one entry for each test. Under stress control a test may ratchet: compare it by
            measures such as "area" or "frechet", since a sum of squares needs a common strain.
        parts : sequence of slice or ndarray of int, optional
            For each test the points of the returned curve, such as
            :func:`curvewise.curves.last_cycle`; the whole test drives the material in any case.
        rates : sequence of float, optional
            Rate of strain of each test, for a material with the option `rate`
            (:class:`JohnsonCook`). By default, all tests have the rate of the material.

        Returns
        -------
        DrivenModel
            A callable of a dict of parameters; `jacobian` returns the derivatives.

        Raises
        ------
        ValueError
            If a test does not have two columns, or `control` is none of these. If `rates` has
            another length than the tests, one is not positive, or the material has no rate.
        """
        tests = [
            strain_and_stress(experiment, f"experiments[{i}]")
            for i, experiment in enumerate(curve_list(experiments))
        ]
        if rates is not None:
            if not hasattr(self, "rate"):
                raise ValueError(f"{type(self).__name__} has no rate of strain; leave rates out")
            if len(rates) != len(tests):
                raise ValueError(f"rates has {len(rates)} entries for {len(tests)} tests")
            for rate in rates:
                option: dict[str, Any] = {"rate": float(rate)}
                parameters_of(replace(self, **option))  # raises if the rate is out of its range
        return DrivenModel(
            self,
            tuple(test[:, 0].copy() for test in tests),
            None if parts is None else tuple(parts),
            given_stresses(tests, control),
            None if rates is None else tuple(map(float, rates)),
        )

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

    def _modulus_bounds(self, readings: Sequence[MaterialReading]) -> Bounds:
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
            material=self.name,
            model=type(self).__name__,
            described=repr(self),
            options=asdict(self),
            choices={
                one.name: chosen
                for one in fields(self)
                if isinstance(chosen := getattr(self, one.name), str) and chosen != one.default
            },
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
