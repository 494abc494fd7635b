"""``curvewise fit TEST…``: from files of strain and stress to parameters, a report, a card."""

from __future__ import annotations

import argparse
import re
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .._bounds import on_its_scale
from ..curves.inputs import Array
from ..files.column_units import factor_of, in_mpa
from ..materials import MATERIALS, Material
from ..materials.options import MaterialOption, material_options
from ..solvers.cards import FORMATS
from .reading import (
    ColumnsError,
    Said,
    add_repeated,
    one_for_each,
    prepared_file,
    said_of_each,
    warnings_printed,
)
from .shown import failures_unlogged, require_matplotlib

if TYPE_CHECKING:
    from ..fitting import PreparedTest

__all__ = ["Quantity", "add_fit", "quantity_of"]

_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\d\s].*)?")


def add_fit(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser(
        "fit",
        help="fit a material to tests: parameters with intervals, a report, a card",
        description="Fit a material to measured strain and stress: loops, single tension tests, "
        "raw records of a machine. Writes parameters.csv, report.html, fit.png and, if asked for, "
        "material cards. No solver is needed.",
    )
    command.set_defaults(run=_fit)
    command.add_argument(
        "tests", nargs="+", metavar="TEST", help="a file with strain and stress, one point per line"
    )
    add_repeated(command)
    command.add_argument(
        "--material",
        choices=list(MATERIALS),
        default="chaboche-voce",
        help="; ".join(f"{name}: {_summary(kind)}" for name, kind in MATERIALS.items()),
    )
    for option in material_options(MATERIALS.values()).values():
        command.add_argument(
            _flag(option),
            type=type(option.default),
            choices=option.choices or None,
            metavar=None if option.choices else "N",
            help=f"option of {', '.join(option.materials)} (default: {option.default})",
        )
    command.add_argument(
        "--rate",
        action="append",
        type=float,
        metavar="N",
        help="rate of strain [1/s] of johnson-cook: once for all tests, or once for each, in "
        "their order (default: 1.0)",
    )
    _add_known(command)
    command.add_argument(
        "--measure", default="sum_of_squares", help="what is minimised; sum_of_squares by default"
    )
    command.add_argument(
        "--cycles",
        choices=["all", "last"],
        default="all",
        help="last: compare the last complete cycle of each test alone, the stabilised one",
    )
    command.add_argument(
        "--no-zero",
        action="store_true",
        help="fit tests that do not begin at zero strain and stress as they are",
    )
    _add_output(command)


def _flag(option: MaterialOption) -> str:
    """Return the flag of an option of a material."""
    return "--" + option.name.replace("_", "-")


def _summary(kind: type[Material]) -> str:
    """Return the first line of a material's docstring."""
    return (kind.__doc__ or "").partition("\n")[0].rstrip(".")


def _add_known(command: argparse.ArgumentParser) -> None:
    """Add the options for known parameters."""
    command.add_argument(
        "--fix",
        nargs="+",
        type=_known,
        default=[],
        metavar="NAME=VALUE",
        help="parameters that are known, with a unit of stress or in that of --units: E=206e3, "
        "E=206GPa",
    )
    command.add_argument(
        "--bounds",
        nargs="+",
        type=_bounded,
        default=[],
        metavar="NAME=LOW:HIGH",
        help="bounds of parameters (default: read off the tests):  Q=0:200 E=180GPa:230GPa",
    )


def _add_output(command: argparse.ArgumentParser) -> None:
    """Add the options for the output."""
    command.add_argument(
        "--card",
        nargs="+",
        default=[],
        choices=list(FORMATS),
        help="write a material card for each of these solvers",
    )
    command.add_argument(
        "--accept-undetermined",
        action="store_true",
        help="write cards even if the tests do not determine the modulus or the yield stress",
    )
    command.add_argument("--name", default="material", help="of the material, in the card")
    command.add_argument(
        "--units", default="MPa", help="of the stresses, on axes and in cards; MPa by default"
    )
    command.add_argument("--seed", type=int, default=0, help="of the search")
    command.add_argument(
        "--output",
        metavar="DIR",
        default="fit",
        help="the folder for what is written; by default fit",
    )


class Quantity(NamedTuple):
    """A number, with a unit of stress if it was written with one."""

    number: float
    unit: str

    def within(self, units: str) -> float:
        """Return the number in a unit of stress."""
        return self.number * (factor_of(self.unit, units) if self.unit else 1.0)


def _known(text: str) -> tuple[str, Quantity]:
    """Read a name and a number."""
    name, _, number = text.partition("=")
    return name, quantity_of(number, text, "NAME=VALUE, for example E=206e3 or E=206GPa")


def _bounded(text: str) -> tuple[str, tuple[Quantity, Quantity]]:
    """Read a name and two numbers."""
    wanted = "NAME=LOW:HIGH, for example Q=0:200"
    name, _, both = text.partition("=")
    low, _, high = both.partition(":")
    return name, (quantity_of(low, text, wanted), quantity_of(high, text, wanted))


def quantity_of(written: str, text: str, wanted: str) -> Quantity:
    """Read a number with or without a unit of stress."""
    found = _NUMBER.fullmatch(written.strip())
    if found is None or (found[2] and in_mpa(found[2]) is None):
        raise argparse.ArgumentTypeError(f"expected {wanted}; got {text!r}")
    return Quantity(float(found[1]), found[2] or "")


def _in_units(arguments: argparse.Namespace) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the fixed and the bounded parameters, in the unit of stresses."""
    units = arguments.units
    fixed = {name: quantity.within(units) for name, quantity in arguments.fix}
    bounds = {}
    for name, (low, high) in arguments.bounds:
        ends = low.within(units), high.within(units)
        if not ends[0] < ends[1]:
            raise ValueError(f"--bounds {name} is {ends[0]:g}:{ends[1]:g}; give low below high")
        bounds[name] = on_its_scale(*ends) if ends[0] > 0.0 else ends
    return fixed, bounds


def _fit(arguments: argparse.Namespace) -> int:
    from ..fitting import (
        BeginningWarning,
        UndeterminedCardError,
        UnitsWarning,
        fit_material,
    )

    require_matplotlib()
    material = _material(arguments)
    rates = _rates(arguments, material)
    fixed, bounds = _in_units(arguments)
    files = arguments.tests
    with warnings_printed():
        each = zip(files, said_of_each(arguments, len(files)), strict=True)
        tests = [_test(file, said, arguments.units) for file, said in each]
    if not arguments.no_zero and arguments.cycles == "all":
        _ask_about_beginnings(tests, arguments.units)
    with failures_unlogged(), warnings.catch_warnings():
        for asked in (BeginningWarning, UnitsWarning):
            warnings.simplefilter("ignore", asked)
        fit = fit_material(
            tests,
            material,
            measure=arguments.measure,
            fixed=fixed,
            bounds=bounds,
            cycles=arguments.cycles,
            rates=rates,
            seed=arguments.seed,
            units=arguments.units,
            progress=sys.stderr.isatty(),
        )
    print(fit)
    names = [Path(file).name for file in files]
    written = fit.write(arguments.output, names=names)
    refusal = ""
    try:
        written += fit.write_cards(
            arguments.output,
            arguments.card,
            name=arguments.name,
            accept_undetermined=arguments.accept_undetermined,
        )
    except UndeterminedCardError as error:  # the other files help to check the fit
        refusal = str(error)
    print("\nwritten:", ", ".join(map(str, written)))
    if refusal:
        raise ValueError(refusal)
    return 0


def _material(arguments: argparse.Namespace) -> Material:
    """Return the material with the options that are given."""
    kind = MATERIALS[arguments.material]
    given: dict[str, Any] = {}
    for option in material_options(MATERIALS.values()).values():
        value = getattr(arguments, option.name)
        if value is None:
            continue
        if kind.name not in option.materials:
            raise ValueError(
                f"{_flag(option)} is an option of {', '.join(option.materials)}; leave it out for "
                f"{kind.name}"
            )
        given[option.name] = value
    return kind(**given)


def _rates(arguments: argparse.Namespace, material: Material) -> list[float] | None:
    """Return the rate of strain of each test, if it is given."""
    if arguments.rate is None:
        return None
    if not hasattr(material, "rate"):
        raise ValueError(
            f"--rate is an option of johnson-cook; leave it out for {arguments.material}"
        )
    return one_for_each("--rate", arguments.rate, len(arguments.tests))


def _ask_about_beginnings(tests: list[Any], units: str) -> None:
    """Refuse tests that do not begin at zero, with what to write if they are right."""
    from ..fitting.beginnings import BeginningError, check_beginnings

    try:
        check_beginnings(tests, units)
    except BeginningError as error:
        raise ValueError(f"{error}; or fit the tests as they are (--no-zero)") from None


def _test(file: str, said: Said, units: str) -> Array | PreparedTest:
    """Read and prepare a test; if no factors are given, ask about units that it seems to have."""
    from ..fitting.units_of_tests import doubt_of

    def ask(test: Any) -> None:
        if doubt := doubt_of(test, units):
            raise ValueError(doubt.asked("command"))

    asked = ask if said.factors is None else None
    try:
        return prepared_file(file, said, units, asked)[0]
    except ColumnsError as question:
        try:  # which question would come next
            prepared_file(file, said._replace(columns=question.wanted), units, asked)
        except ValueError as error:
            raise ValueError(f"{question}. Of these, {error}") from None
        raise
    except ValueError as error:
        raise ValueError(f"{error}" if file in str(error) else f"{file}: {error}") from None
