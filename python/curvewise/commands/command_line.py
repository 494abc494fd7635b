"""The command line: its parser, and the handling of errors.

Exit status: 0 for success. 1 for data that cannot be compared, a file that cannot be read or
written, curves outside their limits, and a failed self-check, with one line on standard error. 2
for wrong usage. 130 after Ctrl-C and 141 after a closed pipe, without a message. A command imports
its special requirements itself (above all matplotlib), so that the others start fast and run
without them.
"""

from __future__ import annotations

import argparse
import io
import os
import sys
import warnings
from collections.abc import Sequence
from typing import Any

from .._option_names import named_by
from ..installation import build_info, get_cmake_dir, get_include
from .compare import add_compare
from .demo import add_demo
from .fit import add_fit
from .flow import add_flow
from .identify import add_identify
from .info import add_info
from .overlay import add_overlay
from .reading import flags_of
from .report import add_report
from .selfcheck import add_selfcheck

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
        From argparse: status 2 for wrong usage, 0 for --help and --version.

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
            with warnings.catch_warnings(), named_by(flags_of(vars(arguments))):
                warnings.showwarning = _show_warning
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
        if error.errno is None:  # a sentence of our own, as of a store that cannot be used
            return _fail(str(error))
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


def _show_warning(message: Warning | str, *_: Any, **__: Any) -> None:
    """Write a warning without the line of Python that it is about."""
    print("curvewise:", message, file=sys.stderr, flush=True)


def _discard_output() -> None:
    """Discard the output buffer; otherwise Python reports it again when it exits."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class _Print(argparse.Action):
    """An option that prints what the function `const` returns and ends the program."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        print(self.const())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="curvewise",
        description="Measure how similar two curves are, and identify material parameters from "
        "measured curves.",
        epilog="Exit status: 0, 1 (bad data or files, outside limits), 2 (usage).",
    )
    parser.add_argument(
        "--version", action="version", version=f"%(prog)s {build_info()['version']}"
    )
    parser.add_argument(
        "--cmakedir",
        action=_Print,
        nargs=0,
        const=get_cmake_dir,
        help="print the folder for CMake's curvewise_DIR and exit",
    )
    parser.add_argument(
        "--includes",
        action=_Print,
        nargs=0,
        const=lambda: f"-I{get_include()}",
        help="print the flag that lets a compiler find the C++ and C headers and exit",
    )
    commands = parser.add_subparsers(title="commands", metavar="command", required=True)

    for add in (
        add_compare,
        add_fit,
        add_flow,
        add_overlay,
        add_identify,
        add_demo,
        add_report,
        add_selfcheck,
        add_info,
    ):
        add(commands)
    return parser
