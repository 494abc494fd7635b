"""The table [model] with a material instead of a command: a study without solver.

The tests drive a compiled material-point model, as in `fit_material`. They are thinned, and missing
bounds are derived from them. Cost: linear in the tests.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from .._names import did_you_mean
from ..calibration.problem.space import Space
from ..curves.named_curve import NamedCurve, name_of_test
from ..fitting.beginnings import warn_of_beginnings
from ..fitting.driven_tests import CYCLES, Cycles, DrivenTests
from ..fitting.moduli import check_units, modulus_of
from ..fitting.recorded_cycles import whole_record
from ..fitting.units_of_tests import doubt_of
from ..materials import MATERIALS, DrivenModel, Material
from ..materials.options import MaterialOption, material_options
from ..solvers.cards import FORMATS
from . import keys
from .keys import StudyTable, key
from .measured_tests import MeasuredTest
from .toml_source import KeyPath, Source

__all__ = ["MaterialModel", "drive", "is_material", "read_material"]

T = TypeVar("T")


def _cards(value: Any) -> tuple[str, ...]:
    return tuple(keys.choice(tuple(FORMATS))(item) for item in keys.texts(value))


@dataclass(frozen=True)
class MaterialModel:
    """The table [model] of a study without a solver.

    Attributes
    ----------
    options : mapping of str to object
        The options of the material that the file gives.
    driven : DrivenModel
        The material, driven by the study's tests.
    modulus_read : float
        The slope with which these unload.
    """

    material: str = key(keys.choice(tuple(MATERIALS)), "")
    cycles: Cycles = key(keys.choice(CYCLES), "all")
    cards: tuple[str, ...] = key(_cards, ())
    accept_undetermined: bool = key(keys.flag, False)
    name: str = key(keys.text, "material")
    units: str = key(keys.text, "MPa")
    options: Mapping[str, Any] = field(default_factory=dict)
    driven: DrivenModel[Material] | None = None
    modulus_read: float = 0.0
    beginning: str = ""

    def made(self) -> Material:
        """Return the material with its options."""
        return MATERIALS[self.material](**self.options)


def _reader_of(option: MaterialOption) -> Any:
    """Return what reads an option of a material."""
    if option.choices:
        return keys.choice(option.choices)
    return keys.positive if isinstance(option.default, float) else keys.at_least(0)


def is_material(given: Any) -> bool:
    """Whether a table [model] has a material."""
    return isinstance(given, Mapping) and "material" in given


def read_material(source: Source, path: KeyPath, given: Mapping[str, Any]) -> MaterialModel | None:
    """Return the model, or None where something is wrong."""
    table = StudyTable(source, path, given)
    if "command" in given:
        table.problem("material", "stands beside command; give one of them, a solver or a material")
        return None
    options = material_options(MATERIALS.values())
    chosen = table.take({option.name: _reader_of(option) for option in options.values()})
    model = table.read(MaterialModel, options=chosen)
    if not table.is_right:
        return None
    own = [option.name for option in options.values() if model.material in option.materials]
    for option in chosen:
        if option not in own:
            listed = ", ".join(own) or "none"
            table.problem(option, f"is no option of {model.material} (its own: {listed})")
    if table.is_right:
        try:
            _ = model.made().names
        except ValueError as error:
            table.problem("", f"cannot be: {error}")
    return model if table.is_right else None


def _rates(
    source: Source, material: Material, name: str, tests: Sequence[MeasuredTest]
) -> list[float] | None:
    """Return the rate of strain of each test, or None if no test has one."""
    rates = [test.rate for test in tests if test.rate is not None]
    for i, test in enumerate(tests):
        if test.rate is not None and not hasattr(material, "rate"):
            source.problem(("tests", i, "rate"), f"is a rate of strain, and {name} has none")
        if rates and test.rate is None:
            source.problem(("tests", i), "needs a rate, because another test has one")
    return rates or None


def drive(
    source: Source,
    model: MaterialModel,
    tests: Sequence[MeasuredTest],
    given: Mapping[str, Any],
) -> tuple[MaterialModel, tuple[MeasuredTest, ...], dict[str, Any]]:
    """Return the model driven by the tests, the compared tests, and all bounds.

    Errors are recorded and raised, because the result would be unusable.
    """
    material = model.made()
    for name in given:
        if name not in material.names:
            hint = did_you_mean([name], material.names)
            source.problem(
                ("parameters", name),
                f"is no parameter of {model.material}{hint} (they are {', '.join(material.names)})",
            )

    given_tests = [test.prepared or test.experiment for test in tests]
    for i, test in enumerate(tests):
        told = test.factors or test.x is not None
        if not told and (doubt := doubt_of(given_tests[i], model.units)):
            source.problem(("tests", i), doubt.asked("study"))
    rates = _rates(source, material, model.material, tests)
    source.raise_problems()

    def each(what: Callable[[list[Any]], T]) -> None:
        for i, test in enumerate(given_tests):
            try:
                what([test])
            except ValueError as error:
                named = f"{name_of_test(test, 0)}: "
                said = str(error).removeprefix("experiments[0] ").removeprefix(named)
                source.problem(("tests", i), f"cannot drive a material: {said}")

    each(lambda one: material.bounds_from(list(map(whole_record, one))))
    source.raise_problems()
    each(lambda one: DrivenTests.of(material, one, cycles=model.cycles))
    source.raise_problems()
    beginning = ""
    if model.cycles == "all":
        beginning = warn_of_beginnings(given_tests, model.units, level=2)
    bounds = {**material.bounds_from(list(map(whole_record, given_tests))), **given}
    try:
        Space(bounds)
        check_units(given, given_tests, model.units, material.yield_stress)
    except ValueError as error:
        source.problem(("parameters",), f"{error} (the others are read off the tests)")
    source.raise_problems()
    driven = DrivenTests.of(material, given_tests, cycles=model.cycles, rates=rates)
    modulus = modulus_of(given_tests)
    made = replace(model, driven=driven.model, modulus_read=modulus, beginning=beginning)
    compared = zip(tests, driven.compared, strict=True)
    axes = ("strain [-]", f"stress [{model.units}]")
    named = (
        replace(test, experiment=NamedCurve(curve, axes, test.name)) for test, curve in compared
    )
    return made, tuple(named), bounds
