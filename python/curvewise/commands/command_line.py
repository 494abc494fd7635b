"""The command line: from two files, or the built-in pair, to five numbers and a picture.

Exit status: 0; 1 for data that cannot be compared, a file that cannot be read or written, and a
failed self-check, with one line on standard error; 2 for wrong usage; 130 after Ctrl-C and 141
after a closed pipe, quietly. What only some commands need (matplotlib first of all) is imported
by them, so that the others start fast and run without it.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import math
import os
import shlex
import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, get_args

from .._extras import extra
from .._options import Crossing, Preset, Spacing, Window
from ..comparing.comparison import PRESETS, Comparison, compare
from ..curves.inputs import Array
from ..datasets import hysteresis_pair
from ..files.column_choice import TimeColumnWarning
from ..files.curve_files import read_named_columns
from ..installation import build_info, get_cmake_dir, get_include
from ..measures import curve_length_residuals, normalize
from ..measures.registry import MEASURES
from .identify import add_identify
from .report import add_report

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments; those of the process by default.

    Returns
    -------
    int
        The exit status: 0, 1, 130 or 141, as said at the top of this file.

    Raises
    ------
    SystemExit
        By argparse: status 2 for wrong usage, 0 for --help and --version.

    Examples
    --------
    >>> from curvewise.commands import main
    >>> main(["compare", "no_such_file.csv", "nor_this.csv"])  # says so on standard error
    1
    """
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A file name, or "Fréchet", must not fail for the terminal's encoding.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        try:
            arguments = _parser().parse_args(argv)
            status: int = arguments.run(arguments)
            return status
        finally:
            print(end="", flush=True)  # here, where an error of the output can be caught
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        _discard_output()
        return 141
    except OSError as error:
        if error.filename is None:
            _discard_output()
            return _fail(f"the output cannot be written: {error.strerror}")
        return _fail(f"{error.filename}: {error.strerror}")
    except MemoryError as error:
        return _fail(str(error) or "not enough memory")
    except (ImportError, ValueError) as error:
        return _fail(str(error))


def _fail(message: str) -> int:
    print("curvewise:", " ".join(message.split()), file=sys.stderr)
    return 1


def _discard_output() -> None:
    """Send what is still buffered nowhere, or Python reports it again when it exits."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class _Print(argparse.Action):
    """An option that prints what `text` returns and ends the program, as --version does."""

    def __init__(
        self, option_strings: Sequence[str], dest: str, text: Callable[[], str], help: str
    ) -> None:
        super().__init__(option_strings, dest, nargs=0, default=argparse.SUPPRESS, help=help)
        self._text = text

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        print(self._text())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="curvewise",
        description="How alike two curves are: area, partial curve mapping, Fréchet, DTW and "
        "curve length.",
        epilog="Exit status: 0, 1 (bad data or files), 2 (usage).",
    )
    parser.add_argument(
        "--version", action="version", version=f"%(prog)s {build_info()['version']}"
    )
    parser.add_argument(
        "--cmakedir",
        action=_Print,
        text=get_cmake_dir,
        help="print the folder for CMake's curvewise_DIR and exit",
    )
    parser.add_argument(
        "--includes",
        action=_Print,
        text=lambda: f"-I{get_include()}",
        help="print the flag that lets a compiler find the C++ and C headers and exit",
    )
    commands = parser.add_subparsers(title="commands", metavar="command", required=True)

    command = commands.add_parser("compare", help="compare the curves in two files")
    command.set_defaults(run=_compare, usage_error=command.error)
    command.add_argument("A", help="the reference, e.g. the experiment: one point per line")
    command.add_argument("B", help="the other curve, e.g. the simulation")
    _add_columns(command)
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
        help="by default the five of the paper; frechet and dtw if there are not two columns",
    )
    command.add_argument(
        "--spacing", choices=get_args(Spacing), help="of area; in place of the preset's"
    )
    command.add_argument(
        "--crossing",
        choices=get_args(Crossing),
        help="of area, without effect on spacing matched; in place of the preset's",
    )
    command.add_argument(
        "--window",
        type=_window,
        metavar="R",
        help="of dtw: how many points the path may leave the diagonal, or which fraction of them",
    )
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

    add_identify(commands)

    command = commands.add_parser("demo", help="compare the built-in hysteresis loops")
    command.set_defaults(run=_demo)
    command.add_argument("--output", metavar="FILE", default="curvewise_demo.png")

    add_report(commands)

    command = commands.add_parser("selfcheck", help="check every kernel on this machine")
    command.set_defaults(run=_selfcheck)
    command = commands.add_parser("info", help="show version, compiler and instruction sets")
    command.set_defaults(run=_info)
    return parser


def _add_columns(command: argparse.ArgumentParser) -> None:
    """Add what is said of each file: its columns, their units, the sheet of a workbook."""
    command.add_argument(
        "--columns",
        nargs="+",
        metavar="COLUMN",
        help="names from the header, or numbers from 1; by default the first two",
    )
    command.add_argument(
        "--columns-b",
        nargs="+",
        metavar="COLUMN",
        help="those of B, where they are others than those of A",
    )
    for file in "AB":
        command.add_argument(
            f"--factors-{file.lower()}",
            nargs="+",
            type=float,
            metavar="F",
            help=f"what the columns of {file} are multiplied by, to change units: 0.01 1e-6",
        )
        command.add_argument(
            f"--sheet-{file.lower()}",
            metavar="SHEET",
            help=f"of the workbook {file}: its name, or its number from 1; by default the first",
        )


def _window(text: str) -> Window:
    """Read a whole number, or a fraction between 0 and 1."""
    with contextlib.suppress(ValueError):
        return int(text)
    with contextlib.suppress(ValueError):
        if 0 < (fraction := float(text)) < 1:
            return fraction
    raise argparse.ArgumentTypeError(f"{text} is no whole number, and not between 0 and 1")


def _compare(arguments: argparse.Namespace) -> int:
    if arguments.residuals and not arguments.output:
        arguments.usage_error("--residuals needs --output FILE, where to write them")
    if arguments.plot:
        _require_matplotlib()
    files = [arguments.A, arguments.B]
    factors = [arguments.factors_a, arguments.factors_b]
    P, of_p = _read(arguments.A, arguments.columns, arguments.sheet_a, factors[0])
    Q, of_q = _read(
        arguments.B, arguments.columns_b or arguments.columns, arguments.sheet_b, factors[1]
    )
    given = {
        "area": {"spacing": arguments.spacing, "crossing": arguments.crossing},
        "dtw": {"window": arguments.window},
    }
    options = {
        measure: chosen
        for measure, values in given.items()
        if (chosen := {name: value for name, value in values.items() if value is not None})
    }
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always", UserWarning)
            comparison = compare(
                P, Q, preset=arguments.preset, measures=arguments.measures, options=options
            )
    except ValueError as error:
        raise ValueError(f"{error} (P is {files[0]}, Q is {files[1]})") from error
    for words in dict.fromkeys(str(warning.message) for warning in said):
        print("curvewise:", words, file=sys.stderr)
    if arguments.output:
        numbers = _residuals(comparison) if arguments.residuals else comparison.values.values()
        _write_numbers(numbers, arguments.output)
    if arguments.json:
        print(_to_json(comparison, files, [of_p, of_q], factors))
    else:
        columns = [_columns_in_words(*of) for of in zip((of_p, of_q), factors, strict=True)]
        _print_table(comparison, files, columns)
    if arguments.plot:
        _write_picture(comparison, arguments.plot)
        if not arguments.json:
            print(f"\npicture: {arguments.plot}")
    return 0


def _read(
    file: str, columns: list[str] | None, sheet: str | None, factors: list[float] | None
) -> tuple[Array, list[str]]:
    """Read the columns of a file; refuse to guess them where the first of several is time."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", TimeColumnWarning)
        try:
            return read_named_columns(file, columns, sheet=sheet, factors=factors)
        except TimeColumnWarning as guessed:
            wanted = shlex.join(guessed.wanted)
            raise ValueError(f"{guessed.found}; name those wanted: --columns {wanted}") from None


def _columns_in_words(names: list[str], factors: list[float] | None) -> str:
    if factors is None:
        return f", columns {', '.join(names)}"
    scaled = (f"{name} × {factor:g}" for name, factor in zip(names, factors, strict=True))
    return f", columns {', '.join(scaled)}"


def _demo(arguments: argparse.Namespace) -> int:
    _require_matplotlib()
    comparison = compare(*hysteresis_pair())
    names = ["experiment (made by curvewise)", "simulation (likewise)"]
    _print_table(comparison, names, ["", ""])
    _write_picture(comparison, arguments.output)
    print(f"\npicture: {arguments.output}")
    return 0


def _selfcheck(arguments: argparse.Namespace) -> int:
    from .selfcheck import run

    return 0 if run(sys.stdout) else 1


def _info(arguments: argparse.Namespace) -> int:
    for key, value in build_info().items():
        text = " ".join(value) if isinstance(value, list) else value
        print(f"{key.replace('_', ' '):<16}  {text}")
    return 0


def _print_table(comparison: Comparison, names: list[str], columns: list[str]) -> None:
    curves = comparison.P, comparison.Q
    for letter, name, curve, of in zip("PQ", names, curves, columns, strict=True):
        print(f"{letter}  {name}, {len(curve)} points{of}")
    print(f"preset {comparison.preset}\n\n{comparison}\n\ndeviation, in units of y")
    width = max(map(len, comparison.values))
    for name, deviation in comparison.deviations.items():
        print(f"{name:<{width}}  {deviation}")


def _to_json(
    comparison: Comparison,
    files: list[str],
    columns: list[list[str]],
    factors: list[list[float] | None],
) -> str:
    values = {name: _json_number(value) for name, value in comparison.values.items()}
    deviations = {
        name: {key: _json_number(value) for key, value in found._asdict().items()}
        for name, found in comparison.deviations.items()
    }
    n = [len(comparison.P), len(comparison.Q)]
    return json.dumps(
        {
            "files": files,
            "columns": columns,
            "factors": factors,
            "preset": comparison.preset,
            "n": n,
            "values": values,
            "deviations": deviations,
        },
        indent=2,
    )


def _json_number(value: float) -> float | None:
    """JSON has no infinity: a value beyond the range of a double is null."""
    return value if math.isfinite(value) else None


def _residuals(comparison: Comparison) -> list[float]:
    """Return the terms of curve_length, x and y of one point after the other."""
    condition = PRESETS[comparison.preset]["curve_length"]
    P, Q = comparison.P, comparison.Q
    if condition.scaled:
        P, Q = normalize(P, Q)
    residuals: list[float] = curve_length_residuals(P, Q, **condition.options).ravel().tolist()
    return residuals


def _write_numbers(numbers: Iterable[float], file: str) -> None:
    """Write a number a line, with all its digits: an optimiser takes differences of them."""
    Path(file).write_text("".join(f"{number:.17g}\n" for number in numbers), encoding="ascii")


def _require_matplotlib() -> None:
    """Fail before the work rather than after it."""
    with extra("plot", "a picture needs matplotlib"):
        import_module("matplotlib.figure")


def _write_picture(comparison: Comparison, file: str) -> None:
    # With the format given, matplotlib does not append ".png" to a name without an ending.
    comparison.plot().savefig(file, format=Path(file).suffix[1:] or "png")
