"""``curvewise fit TEST…``: from files of strain and stress to parameters, a report, a card."""

from __future__ import annotations

import argparse
import sys
import warnings
from dataclasses import fields
from pathlib import Path
from typing import Any

from ..curves.inputs import Array
from ..materials import MATERIALS
from ..solvers.cards import FORMATS
from .reading import Said, add_repeated, read_file, said_of_each, warnings_printed
from .shown import failures_unlogged, require_matplotlib

__all__ = ["add_fit"]


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
        help="chaboche-voce (default): back stresses and isotropic hardening or softening; "
        "yoshida-uemori: two surfaces, for sheet steel",
    )
    command.add_argument(
        "--backstresses", type=int, default=2, metavar="N", help="of chaboche-voce; 2 by default"
    )
    command.add_argument(
        "--modulus",
        choices=["constant", "decaying"],
        default="constant",
        help="whether Young's modulus decays with the plastic strain",
    )
    command.add_argument(
        "--fix",
        nargs="+",
        type=_known,
        default=[],
        metavar="NAME=VALUE",
        help="parameters that are known, such as E=206e3",
    )
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
        "--zero",
        action=argparse.BooleanOptionalAction,
        help="make the first point of each test the origin, if strain or stress was not zeroed; "
        "--no-zero: fit tests that do not begin at zero as they are",
    )
    command.add_argument(
        "--toe",
        nargs="*",
        type=float,
        metavar="STRESS",
        help="cut the toe of each test: its straight part, between two stresses (default: read off "
        "the test), goes through the origin",
    )
    command.add_argument(
        "--card",
        nargs="+",
        default=[],
        choices=list(FORMATS),
        help="write a material card for each of these solvers",
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


def _known(text: str) -> tuple[str, float]:
    """Read a name and a number."""
    name, _, number = text.partition("=")
    try:
        return name, float(number)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no NAME=VALUE, such as E=206e3") from None


def _fit(arguments: argparse.Namespace) -> int:
    from ..fitting import BeginningWarning, UnitsWarning, fit_material

    require_matplotlib()
    kind = MATERIALS[arguments.material]
    given = vars(arguments)
    material = kind(**{one.name: given[one.name] for one in fields(kind) if one.name in given})
    files = arguments.tests
    with warnings_printed():
        each = zip(files, said_of_each(arguments, len(files)), strict=True)
        tests = [_test(file, said, arguments.units) for file, said in each]
    tests = [_from_zero(test, arguments) for test in tests]
    if arguments.zero is not False and arguments.cycles == "all":
        _ask_about_beginnings(tests, arguments.units)
    with failures_unlogged(), warnings.catch_warnings():
        for asked in (BeginningWarning, UnitsWarning):
            warnings.simplefilter("ignore", asked)
        fit = fit_material(
            tests,
            material,
            measure=arguments.measure,
            fixed=dict(arguments.fix),
            cycles=arguments.cycles,
            seed=arguments.seed,
            units=arguments.units,
            progress=sys.stderr.isatty(),
        )
    print(fit)
    names = [Path(file).name for file in files]
    written = fit.write(arguments.output, names=names)
    written += fit.write_cards(arguments.output, arguments.card, name=arguments.name)
    print("\nwritten:", ", ".join(map(str, written)))
    return 0


def _from_zero(test: Array, arguments: argparse.Namespace) -> Array:
    """Correct where a test begins, as --zero and --toe ask for."""
    from ..curves import shift_to_origin
    from ..fitting.beginnings import cut_toe

    if arguments.zero:
        test = shift_to_origin(test)
    if arguments.toe is None:
        return test
    if len(arguments.toe) not in (0, 2):
        raise ValueError(
            f"--toe has {len(arguments.toe)} stresses; give two, low and high, or none"
        )
    return cut_toe(test, arguments.toe)


def _ask_about_beginnings(tests: list[Array], units: str) -> None:
    """Refuse tests that do not begin at zero, with what to write if they are right."""
    from ..fitting.beginnings import BeginningError, check_beginnings

    try:
        check_beginnings(tests, units)
    except BeginningError as error:
        raise ValueError(f"{error}; or fit the tests as they are (--no-zero)") from None


def _test(file: str, said: Said, units: str) -> Array:
    """Read a test; ask about units that it seems to have, where no factors are given."""
    from ..fitting.units_of_tests import doubt_of

    test, _ = read_file(file, said, units)
    if said.factors is None and (doubt := doubt_of(test, units)):
        raise ValueError(f"{file}: {doubt.asked('command')}")
    return test
