"""Abaqus' output database to text, to be run by Abaqus' own Python.

    abaqus python odb_to_csv.py deck.odb history.csv
    abaqus python odb_to_csv.py deck.odb history.csv RF2 U2

This writes every history of the database (``*OUTPUT, HISTORY``), or those of the named variables,
as columns of one CSV file. The first column is the time; then follows one column for each variable
and place, called "RF2 NODE TOP.1". All steps follow one another. curvewise does not import this
module. Abaqus up to 2023 runs Python 2.7, so the code suits both versions: types are in comments,
and Abaqus' modules are imported when they are needed. Written from Abaqus' scripting reference; it
has not been run, because Abaqus is not available for development. Cost: linear in the output.
"""

import collections
import importlib
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any  # noqa: F401 (of the types in comments, which ruff does not read)


def main(arguments):  # type: (list[str]) -> None
    """Write the requested histories."""
    if len(arguments) < 2:
        raise SystemExit("give the output database, the CSV file, and perhaps variables")
    path, target, wanted = arguments[0], arguments[1], arguments[2:]
    database = importlib.import_module("odbAccess").openOdb(path=path, readOnly=True)
    try:
        columns = histories(database, wanted)
    finally:
        database.close()
    if not columns:
        raise SystemExit(path + " has no history of " + (", ".join(wanted) or "anything"))
    write(columns, target)


def histories(database, wanted):  # type: (Any, list[str]) -> list[tuple[str, dict[float, float]]]
    """Return name and {time: value} of every history, in the order of the database."""
    columns = collections.OrderedDict()  # type: dict[str, dict[float, float]]
    for step in database.steps.values():
        for region in step.historyRegions.values():
            for variable, output in region.historyOutputs.items():
                if wanted and variable not in wanted:
                    continue
                # "Node TOP.1" is the name of a region; a comma in it would be another column.
                name = variable + " " + region.name.replace(",", " ")
                values = columns.setdefault(name, {})
                for time, value in output.data or ():
                    values[step.totalTime + time] = value
    return list(columns.items())


def write(columns, target):  # type: (list[tuple[str, dict[float, float]]], str) -> None
    """Write the columns, at the times that all of them have."""
    times = set.intersection(*(set(values) for _, values in columns))
    with open(target, "w") as file:
        file.write(",".join(["time"] + [name for name, _ in columns]) + "\n")
        for time in sorted(times):
            numbers = [time] + [values[time] for _, values in columns]
            file.write(",".join(format(number, ".9g") for number in numbers) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
