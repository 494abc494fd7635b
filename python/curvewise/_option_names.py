"""Names of options in messages: keywords in Python, ``--options`` on the command line.

The same message reaches both. Code that writes a message asks for the name here, and the command
line says once how its options are called (`named_by`). An option that a command lacks has its name
in Python. The default suits Python and the keys of a study.
"""

from __future__ import annotations

import contextlib
import shlex
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import Any

__all__ = ["called", "command_of", "instead", "named_by", "with_values"]

_FLAG: ContextVar[Callable[[str], str | None] | None] = ContextVar("_FLAG", default=None)


@contextlib.contextmanager
def named_by(flag: Callable[[str], str | None]) -> Iterator[None]:
    """Name options as a command does.

    Parameters
    ----------
    flag : callable
        Takes the name of an option in Python, and returns its flag, or None if the command lacks
        it. Within another `named_by`, None leaves the flag to the outer one.
    """
    outer = _FLAG.get()

    def own(name: str) -> str | None:
        return flag(name) or (None if outer is None else outer(name))

    token = _FLAG.set(own)
    try:
        yield
    finally:
        _FLAG.reset(token)


def command_of(name: str) -> str | None:
    """Return the flag of an option, or None in Python and if the command lacks the option."""
    flag = _FLAG.get()
    return None if flag is None else flag(name)


def called(name: str) -> str:
    """Return the name of an option.

    Examples
    --------
    >>> from curvewise._option_names import called, named_by
    >>> with named_by({"skip_invalid": "--skip-invalid"}.get):
    ...     print(called("skip_invalid"), called("from_"))
    --skip-invalid from
    >>> called("skip_invalid")
    'skip_invalid'
    """
    return command_of(name) or name.rstrip("_")


def with_values(name: str, values: list[Any]) -> str:
    """Return an option with a list of values: ``columns=[1, 3]`` or ``--columns 1 3``."""
    flag = command_of(name)
    return f"{name}={values}" if flag is None else f"{flag} {shlex.join(map(str, values))}"


def instead(name: str, python: str, command: str = "{}") -> str:
    """Return a text for Python, or one for a command that has the option, with {} for its flag."""
    flag = command_of(name)
    return python if flag is None else command.format(flag)
