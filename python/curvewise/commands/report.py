"""``curvewise report``: from a store to a page that shows the search, or to a table of it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add_report"]


def add_report(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser(
        "report",
        help="write a search as an HTML page or as a table",
        description="Write what a store holds down as one page of HTML, which opens without a "
        "network: tests and simulations, residuals, convergence, parameters with intervals, and "
        "the settings to repeat it. Nothing is run.",
    )
    command.set_defaults(run=_report)
    command.add_argument("file", help="what identify(..., store=) has filled")
    command.add_argument("-o", "--output", metavar="FILE", default="report.html")
    command.add_argument(
        "--search",
        type=int,
        nargs="+",
        metavar="NUMBER",
        help="which of a store's searches; by default all of them, on one page",
    )
    command.add_argument("--list", action="store_true", help="list the searches and write nothing")
    command.add_argument(
        "--csv", metavar="FILE", help="write the evaluations of one search as a table, and no page"
    )
    command.add_argument(
        "--rescue",
        metavar="NEW.db",
        help="copy all that can still be read of a damaged store into a new one, and write no page",
    )


def _report(arguments: argparse.Namespace) -> int:
    from ..calibration import SimulationStore
    from ..calibration.records.rescue import rescue
    from ..calibration.report import records_of, write_report

    if arguments.rescue:
        found = rescue(Path(arguments.file), Path(arguments.rescue))
        listed = ", ".join(f"{count} {table}" for table, count in found.items())
        print(f"rescued: {listed} in {arguments.rescue}")
        return 0
    records = records_of(arguments.file)
    if arguments.list:
        for number, record in records.items():
            settings, best = record.settings, record.best
            value = "nothing evaluated" if best is None else f"best {best.value:.6g}"
            state = "ended" if record.ending else "not ended"
            print(
                f"{number}  {settings['measure']} ({settings['preset']}), {settings['method']}: "
                f"{len(record.evaluations)} evaluations, {value}, {state}"
            )
        return 0
    chosen = arguments.search or list(records)
    if missing := [number for number in chosen if number not in records]:
        known = ", ".join(map(str, records))
        raise ValueError(f"{arguments.file} has no search {missing[0]}; it has {known}")
    if arguments.csv:
        with SimulationStore(arguments.file) as store:
            store.to_csv(arguments.csv, chosen[0] if len(chosen) == 1 else None)
        print(f"table: {arguments.csv}")
        return 0
    write_report(arguments.output, [records[number] for number in chosen])
    print(f"report: {arguments.output}")
    return 0
