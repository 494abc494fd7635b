"""``curvewise flow TEST``: from a tension test to tables of stress over plastic strain."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from ..solvers.cards import FORMATS, TABLES
from .fit import Quantity, quantity_of
from .reading import add_repeated, prepared_file, said_of_each, warnings_printed
from .shown import require_matplotlib

__all__ = ["add_flow"]


def add_flow(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser(
        "flow",
        help="make tables of true stress over plastic strain from a tension test, with laws",
        description="Write the flow curve of a tension test (true strain and stress; --true "
        "converts engineering values) and the material of solvers with it, and fit the laws of "
        "Voce and Swift. Rows after a reversal of strain or the largest force are left out.",
    )
    command.set_defaults(run=_flow)
    command.add_argument("test", metavar="TEST", help="file with true strain and true stress")
    add_repeated(command)
    command.add_argument(
        "--modulus",
        type=_modulus,
        metavar="E",
        help="Young's modulus: 206e3 or 206GPa (default: read off the test)",
    )
    command.add_argument(
        "--offset",
        type=float,
        default=0.002,
        metavar="P",
        help="plastic strain of the yield stress (default: 0.002)",
    )
    command.add_argument(
        "--points", type=int, default=40, metavar="N", help="rows of the table (default: 40)"
    )
    command.add_argument(
        "--table",
        nargs="+",
        default=[],
        choices=list(TABLES),
        help="write a material with this table for each of these solvers",
    )
    command.add_argument(
        "--law", choices=["voce", "swift"], help="put the stresses of a law into the tables"
    )
    command.add_argument(
        "--to", type=float, metavar="P", help="plastic strain up to which the law continues"
    )
    command.add_argument("--name", default="material", help="name of the material")
    command.add_argument("--units", default="MPa", help="unit of stress (default: MPa)")
    command.add_argument(
        "--output", metavar="DIR", default="flow", help="folder for the files (default: flow)"
    )


def _modulus(text: str) -> Quantity:
    """Read a number with or without a unit of stress."""
    return quantity_of(text, text, "a modulus, for example 206e3 or 206GPa")


def _flow(arguments: argparse.Namespace) -> int:
    from ..fitting import flow_curve

    require_matplotlib()
    units, modulus = arguments.units, arguments.modulus
    with warnings_printed():
        (said,) = said_of_each(arguments, 1)
        test, _ = prepared_file(arguments.test, said, units)
    flow = flow_curve(
        test,
        modulus=None if modulus is None else modulus.within(units),
        offset=arguments.offset,
        points=arguments.points,
        units=units,
    )
    print(flow)
    folder = Path(arguments.output)
    folder.mkdir(parents=True, exist_ok=True)
    written = [folder / "flow_curve.csv", folder / "flow_curve.png"]
    np.savetxt(
        written[0],
        np.column_stack((flow.plastic_strain, flow.stress)),
        delimiter=",",
        header=f"plastic strain [-],true stress [{units}]",
        comments="",
        fmt="%.10g",
    )
    flow.plot().savefig(written[1], dpi=120)
    for solver in arguments.table:
        written.append(folder / f"flow_{solver}{FORMATS[solver].suffix}")
        text = flow.table(solver, law=arguments.law, to=arguments.to, name=arguments.name)
        written[-1].write_text(text, encoding="utf-8")
    print("\nwritten:", ", ".join(map(str, written)))
    return 0
