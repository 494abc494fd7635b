"""Options of the commands for reading and preparing their files.

The options are made from their declarations (`files.file_options`). A command that reads several
files of one kind takes each option once for all files, or once for each, in their order
(`add_repeated`, `said_of_each`). A command that reads A and B takes the option with a suffix for
one of them (`add_for_two`, `said_of_two`).
"""

from __future__ import annotations

import argparse
import contextlib
import shlex
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from .._option_names import command_of, named_by, with_values
from ..curves.inputs import Array
from ..files.column_choice import TimeColumnWarning
from ..files.column_units import factor_of
from ..files.curve_files import read_named_columns
from ..files.file_options import CYCLE_COLUMN, PREPARATION, READING, FileOption, Reading
from ..files.number_texts import SIGNS

if TYPE_CHECKING:
    from ..fitting import PreparedTest

__all__ = [
    "ColumnsError",
    "Said",
    "add_for_two",
    "add_repeated",
    "flags_of",
    "named_for",
    "one_for_each",
    "prepared_file",
    "read_file",
    "said_of_each",
    "said_of_two",
    "warnings_printed",
]


def _factor(text: str) -> str:
    """Read a number or a unit, which is converted when the unit of the stresses is known."""
    try:
        factor_of(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return text


_COLUMNS = FileOption(
    "columns",
    "names",
    "names from the header, or numbers from 1 (default: the first two); capitals, blanks and the "
    "unit of a name do not count",
    "COLUMN",
)
_FACTORS = FileOption(
    "factors",
    "factors",
    "numbers that the columns are multiplied by, or their units, which are converted to "
    "fractions, MPa, N and mm: 0.01 1, or %% psi",
    "F",
)
_OPTIONS = (_COLUMNS, _FACTORS, *READING, *PREPARATION)
_OPTIONS_OF_TESTS = (*_OPTIONS, CYCLE_COLUMN)
_SIZES = ("area", "gauge_length")
_SETTINGS: dict[str, dict[str, Any]] = {
    "names": {"nargs": "+"},
    "factors": {"nargs": "+", "type": _factor},
    "row": {"type": int},
    "sign": {"choices": list(SIGNS)},
    "size": {"type": float},
    "stresses": {"nargs": "*", "type": float},
}


class Said(NamedTuple):
    """The options for one file.

    Attributes
    ----------
    columns : list of str or int, or None
    factors : list of str or float, or None
        The given numbers and units.
    reading : Reading
    preparation : dict
        Keywords of `curvewise.fitting.prepare`.
    cycle_column : str, or None
    ending : str
        The ending of the options that are for this file alone: "-a", "-b" or none.
    """

    columns: Sequence[str | int] | None
    factors: Sequence[str | float] | None
    reading: Reading
    preparation: dict[str, Any]
    cycle_column: str | None
    ending: str = ""

    def numbers(self, units: str = "MPa") -> list[float] | None:
        """Return the factors as numbers, those of stresses for a unit of stress."""
        if self.factors is None:
            return None
        return [factor_of(factor, units) for factor in self.factors]


def add_repeated(command: argparse.ArgumentParser) -> None:
    """Add the file options, once for all files or once for each."""
    group = command.add_argument_group(
        "files", "Give an option once for all files, or once for each file, in their order."
    )
    for option in _OPTIONS_OF_TESTS:
        _add(group, option, option.flag, repeated=True)


def add_for_two(command: argparse.ArgumentParser) -> None:
    """Add the file options, for A and B together or for one of them."""
    group = command.add_argument_group(
        "files",
        "An option is said of both files; with the ending -a or -b, such as --columns-b, of one.",
    )
    for option in _OPTIONS:
        _add(group, option, option.flag)
        for ending in "ab":
            _add(group, option, f"{option.flag}-{ending}", is_shown=False)


def _add(
    group: Any, option: FileOption, flag: str, *, repeated: bool = False, is_shown: bool = True
) -> None:
    """Add an option; its value is None where it is not given."""
    settings: dict[str, Any] = {"help": option.help if is_shown else argparse.SUPPRESS}
    settings["dest"] = flag[2:].replace("-", "_")
    if option.kind == "flag":
        group.add_argument(flag, action="store_true", default=None, **settings)
        return
    settings |= _SETTINGS.get(option.kind, {})
    if option.metavar:
        settings["metavar"] = option.metavar
    group.add_argument(flag, action="append" if repeated else "store", **settings)


def said_of_each(arguments: argparse.Namespace, count: int) -> list[Said]:
    """Return the options of each of `count` files from `add_repeated`."""
    given = vars(arguments)
    each: list[dict[str, Any]] = [{} for _ in range(count)]
    for option in _OPTIONS_OF_TESTS:
        values = given[option.word]
        if values is None:
            continue
        if option.kind == "flag":
            values = [values]
        for one, value in zip(each, one_for_each(option.flag, values, count), strict=True):
            one[option.name] = value
    return list(map(_said, each))


def one_for_each(flag: str, values: Sequence[Any], count: int) -> list[Any]:
    """Return the value of an option for each of `count` files, given once or once for each."""
    if len(values) not in (1, count):
        raise ValueError(
            f"{flag} is given {len(values)} times for {count} files; give it once for all files, "
            "or once for each"
        )
    return [values[i % len(values)] for i in range(count)]


def said_of_two(arguments: argparse.Namespace) -> list[Said]:
    """Return the options of A and of B from `add_for_two`."""
    given = vars(arguments)
    both: list[dict[str, Any]] = [{}, {}]
    for option in _OPTIONS:
        for one, ending in zip(both, "ab", strict=True):
            own = given[f"{option.word}_{ending}"]
            one[option.name] = given[option.word] if own is None else own
    each = []
    for one, ending in zip(both, ("-a", "-b"), strict=True):
        with named_for(ending):
            each.append(_said(one)._replace(ending=ending))
    return each


def flags_of(given: Mapping[str, Any], ending: str = "") -> Callable[[str], str | None]:
    """Return what names the options of a command, for `named_by`.

    Parameters
    ----------
    given : mapping
        The options of the command, by their names in Python.
    ending : str
        The ending of options that are for one of two files.
    """

    def flag(name: str) -> str | None:
        word = name.rstrip("_")
        return f"--{word.replace('_', '-')}{ending}" if word in given else None

    return flag


@contextlib.contextmanager
def named_for(ending: str) -> Iterator[None]:
    """Name the options of a file in messages by their ending for this file, if it has one."""
    if not ending:
        yield
        return
    own = flags_of(dict.fromkeys(option.word for option in _OPTIONS), ending)
    with named_by(own):
        yield


def _said(values: Mapping[str, Any]) -> Said:
    given = {name: value for name, value in values.items() if value is not None}
    if "toe" in given:
        given["toe"] = given["toe"] or True
    reading = {one.name: given[one.name] for one in READING if one.name in given}
    preparation = {one.name: given[one.name] for one in PREPARATION if one.name in given}
    columns, factors, cycle_column = map(given.get, ("columns", "factors", "cycle_column"))
    return Said(columns, factors, Reading(**reading), preparation, cycle_column)


class ColumnsError(ValueError):
    """The columns of a file are to be named; `wanted` are the likely ones."""

    def __init__(self, question: str, wanted: Sequence[str]) -> None:
        super().__init__(question)
        self.wanted = wanted


@contextlib.contextmanager
def warnings_printed() -> Iterator[None]:
    """Print each warning once, unless an error says more."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", UserWarning)
        yield
    for words in dict.fromkeys(str(warning.message) for warning in said):
        print("curvewise:", words, file=sys.stderr)


def prepared_file(
    file: str, said: Said, units: str = "MPa", asked: Callable[[Any], None] | None = None
) -> tuple[Array | PreparedTest, list[str]]:
    """Read the columns of a file and prepare the test; return their names, too.

    Without preparation options, the result is the raw curve.

    Parameters
    ----------
    file : str
    said : Said
    units : str
        The unit of stresses.
    asked : callable, optional
        Called with strain and stress before their zero is corrected; it may raise ValueError.
    """
    with named_for(said.ending):
        return _prepared(file, said, units, asked)


def _prepared(
    file: str, said: Said, units: str, asked: Callable[[Any], None] | None
) -> tuple[Array | PreparedTest, list[str]]:
    """Read and prepare a file whose options have their names."""
    curve, names = read_file(file, said, units)
    if not said.preparation and said.cycle_column is None:
        if asked is not None:
            asked(curve)
        return curve, names
    from ..fitting import prepare

    sizes = {name: said.preparation[name] for name in _SIZES if name in said.preparation}
    try:
        if asked is not None:
            asked(prepare(curve, units=units, **sizes))
        numbers = None if said.cycle_column is None else _cycle_numbers(file, said, curve)
        return prepare(curve, cycle_numbers=numbers, units=units, **said.preparation), names
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _cycle_numbers(file: str, said: Said, curve: Array) -> Array:
    """Return the cycle of each point of a curve that was read from the same file."""
    assert said.cycle_column is not None
    columns = [*(said.columns or range(1, curve.shape[1] + 1)), said.cycle_column]
    with_cycles = said._replace(columns=columns, factors=None)
    numbers: Array = read_file(file, with_cycles)[0][:, -1]
    return numbers


def read_file(file: str, said: Said, units: str = "MPa") -> tuple[Array, list[str]]:
    """Read the columns of a file; refuse to guess them where the first of several is time."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", TimeColumnWarning)
        try:
            return read_named_columns(file, said.columns, said.reading, factors=said.numbers(units))
        except TimeColumnWarning as guessed:
            wanted = with_values("columns", guessed.wanted)
            more = ""
            if guessed.counter and (flag := command_of("cycle_column")):
                more = f", and {flag} {shlex.quote(guessed.counter)} if it leaves out cycles"
            question = f"{guessed.found}; name those wanted: {wanted}{more}"
            raise ColumnsError(question, guessed.wanted) from None
