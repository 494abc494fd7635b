"""``curvewise compare A B``: the measures of two files."""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from .._options import Crossing, Preset, Spacing, WarpingName, Window
from ..comparing.comparison import Comparison, compare
from ..curves.common_span import common_span
from ..measures import curve_length_residuals, normalize
from ..measures.registry import MEASURES, PRESETS
from .passing import add_limits, checked, measures_with_limits
from .questions_of_two import ask_about_units, warn_of_beginning
from .reading import add_for_two, prepared_file, said_of_two, warnings_printed
from .shown import print_table, require_matplotlib, write_picture

__all__ = ["add_compare"]


def add_compare(commands: Any) -> None:
    """Add the command to those of argparse."""
    command = commands.add_parser("compare", help="compare the curves in two files")
    command.set_defaults(run=_compare, usage_error=command.error)
    command.add_argument("A", help="the reference, e.g. the experiment: one point per line")
    command.add_argument("B", help="the other curve, e.g. the simulation")
    add_for_two(command)
    command.add_argument(
        "--preset",
        choices=get_args(Preset),
        default="scaled",
        help="scale by the box of A (default), as in the paper's Table 4, or not at all",
    )
    command.add_argument(
        "--measures",
        nargs="+",
        choices=MEASURES,
        help="by default the five of the paper; frechet and dtw if there are not two columns; the "
        "exit status is 1 if one that is named here has no value",
    )
    command.add_argument(
        "--spacing", choices=get_args(Spacing), help="of area; in place of the preset's"
    )
    command.add_argument(
        "--crossing",
        choices=get_args(Crossing),
        help="of area, without effect on spacing matched; in place of the preset's; polygon, the "
        "exact area that one of two loops encloses alone, needs --closed",
    )
    command.add_argument(
        "--window",
        type=_window,
        metavar="R",
        help="of dtw: how many points the path may leave the diagonal, or which fraction of them",
    )
    command.add_argument(
        "--closed",
        action="store_true",
        help="of area, dtw, frechet, frechet_continuous: compare loops, whose beginnings are free",
    )
    add_limits(command)
    command.add_argument("--json", action="store_true", help="print one JSON object")
    command.add_argument("--plot", metavar="FILE", help="write a picture, e.g. out.png or out.pdf")
    command.add_argument(
        "--output",
        metavar="FILE",
        help="write the bare values, one per line, for Dakota, LS-OPT, HyperStudy and the like",
    )
    command.add_argument(
        "--residuals",
        action="store_true",
        help="write to the --output file the terms of curve_length, for least squares, instead",
    )


def _window(text: str) -> Window:
    """Read an integer, or a fraction between 0 and 1."""
    with contextlib.suppress(ValueError):
        return int(text)
    with contextlib.suppress(ValueError):
        if 0 < (fraction := float(text)) < 1:
            return fraction
    raise argparse.ArgumentTypeError(f"{text} is neither an integer nor between 0 and 1")


def _options(
    arguments: argparse.Namespace, measures: Sequence[str] | None
) -> dict[str, dict[str, Any]]:
    """Return the options of each measure that are given."""
    options: dict[str, dict[str, Any]] = {}
    for measure, option in (("area", "spacing"), ("area", "crossing"), ("dtw", "window")):
        if (value := getattr(arguments, option)) is not None:
            options.setdefault(measure, {})[option] = value
    if not arguments.closed:
        return options
    by_default = ("area", *get_args(WarpingName))
    loops = (*by_default, "frechet_continuous")
    chosen = [name for name in measures or by_default if name in loops]
    if not chosen:
        raise ValueError(f"--closed applies to {', '.join(loops)}; add one to --measures")
    for measure in chosen:
        options.setdefault(measure, {})["closed"] = True
    return options


def _compare(arguments: argparse.Namespace) -> int:
    if arguments.residuals and not arguments.output:
        arguments.usage_error("--residuals needs --output FILE, where to write them")
    if arguments.plot:
        require_matplotlib()
    files = [arguments.A, arguments.B]
    said = said_of_two(arguments)
    factors = [one.numbers() for one in said]
    with warnings_printed():
        tests, names = zip(*map(prepared_file, files, said), strict=True)
        ask_about_units(files, said, tests)
        warn_of_beginning(said, tests)
    measures = measures_with_limits(arguments)
    try:
        with warnings_printed():
            curves = common_span(*tests) if arguments.common_span else tests
            comparison = compare(
                *curves,
                preset=arguments.preset,
                measures=measures,
                options=_options(arguments, measures),
            )
        outcome = checked(arguments, comparison)
    except ValueError as error:
        raise ValueError(f"{error} (P is {files[0]}, Q is {files[1]})") from error
    if arguments.output:
        numbers = _residuals(comparison) if arguments.residuals else _all_values(comparison, files)
        # With all digits: an optimiser takes differences of them.
        lines = "".join(f"{number:.17g}\n" for number in numbers)
        Path(arguments.output).write_text(lines, encoding="ascii")
    if arguments.json:
        steps = [list(getattr(test, "steps", ())) for test in tests]
        read = {"files": files, "columns": names, "factors": factors, "prepared": steps}
        print(json.dumps(read | _in_json(comparison) | outcome.in_json(), indent=2))
    else:
        print_table(comparison, files, list(map(_columns_in_words, names, factors, tests)))
        outcome.print_text()
    if arguments.plot:
        write_picture(comparison, arguments.plot)
        if not arguments.json:
            print(f"\npicture: {arguments.plot}")
    missing = _refusals(comparison, files) if measures else []
    for words in missing:
        print(f"curvewise: {words}", file=sys.stderr)
    return max(outcome.status(files[1]), 1 if missing else 0)


def _refusals(comparison: Comparison, files: list[str]) -> list[str]:
    """Say which measures have no value, and why."""
    of = f"(P is {files[0]}, Q is {files[1]})"
    return [f"{name} has no value: {words} {of}" for name, words in comparison.refusals.items()]


def _all_values(comparison: Comparison, files: list[str]) -> list[float]:
    """Return the values; raise ValueError if one is missing."""
    if missing := _refusals(comparison, files):
        raise ValueError(missing[0])
    return list(comparison.values.values())


def _columns_in_words(names: list[str], factors: list[float] | None, curve: Any) -> str:
    """Return which columns were read and how they were prepared."""
    scaled = names
    if factors is not None:
        scaled = [f"{name} × {factor:g}" for name, factor in zip(names, factors, strict=True)]
    steps = "".join(f"\n   {step}" for step in getattr(curve, "steps", ()))
    return f", columns {', '.join(scaled)}{steps}"


def _in_json(comparison: Comparison) -> dict[str, Any]:
    deviations = comparison.deviations.items()
    return {
        "preset": comparison.preset,
        "n": [len(comparison.P), len(comparison.Q)],
        "values": _json_numbers(comparison.values),
        "refusals": comparison.refusals,
        "deviations": {name: _json_numbers(found._asdict()) for name, found in deviations},
    }


def _json_numbers(values: Mapping[str, float]) -> dict[str, float | None]:
    """Return values for JSON, which lacks infinity and nan: null replaces them."""
    return {name: value if math.isfinite(value) else None for name, value in values.items()}


def _residuals(comparison: Comparison) -> list[float]:
    """Return the terms of curve_length, x and y of one point after the other."""
    condition = PRESETS[comparison.preset]["curve_length"]
    P, Q = comparison.P, comparison.Q
    if condition.scaled:
        P, Q = normalize(P, Q)
    residuals: list[float] = curve_length_residuals(P, Q, **condition.options).ravel().tolist()
    return residuals
