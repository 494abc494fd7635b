"""Formulas of a study file: "force / (area * (1 + ux))", "E / (2 * (1 + nu))".

Formulas consist of numbers, names, + - * / ** (or ^), brackets, and the functions of a pocket
calculator, for numbers or whole columns. A separate parser replaces Python's, because parameters
have names such as "yield" and "lambda", and because a formula must not be able to do anything else.
It uses recursive descent; the cost is linear in the text, and in the columns when it is evaluated.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from itertools import repeat
from typing import Any, TypeAlias

import numpy as np

from .._names import did_you_mean

__all__ = ["Formula", "undefined_names"]

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>\*\*|[-+*/^(),])|(?P<end>\Z)|(?P<other>\S))"
)
_DEEPEST = 100  # brackets within brackets
_LONGEST = 500  # characters: longer formulas would also be slow to evaluate in a search


def _largest(*columns: Any) -> Any:
    return np.max(columns[0]) if len(columns) == 1 else reduce(np.maximum, columns)


def _smallest(*columns: Any) -> Any:
    return np.min(columns[0]) if len(columns) == 1 else reduce(np.minimum, columns)


_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "abs": np.abs,
    "exp": np.exp,
    "expm1": np.expm1,
    "ln": np.log,
    "log": np.log,
    "log10": np.log10,
    "log1p": np.log1p,
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "max": _largest,
    "min": _smallest,
    "mean": np.mean,
    "sum": np.sum,
    "first": lambda column: np.atleast_1d(column)[0],
    "last": lambda column: np.atleast_1d(column)[-1],
}
_SEVERAL = ("max", "min")
_CONSTANTS = {"pi": np.pi}
_OPERATIONS: dict[str, Callable[..., Any]] = {
    **_FUNCTIONS,
    "negative": operator.neg,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "**": operator.pow,
}

# A number, a name, or an operation with the trees of its operands.
_Tree: TypeAlias = "float | str | tuple[Any, ...]"


class Formula:
    """A formula as a function of the values of its names.

    Parameters
    ----------
    text : str
        The formula. ``max`` and ``min`` of one column are numbers; of several columns they are the
        largest and the smallest at every point. ``first``, ``last``, ``mean`` and ``sum`` are
        numbers.

    Attributes
    ----------
    text : str
        The given text.
    names : tuple of str
        The names that need a value.

    Raises
    ------
    ValueError
        If it is not a formula; the message shows where.

    Examples
    --------
    >>> from curvewise.studies.formulas import Formula
    >>> formula = Formula("force / (4 * (1 + 2 * u)) ^ 2")
    >>> formula.names, float(formula({"force": 100.0, "u": 0.0}))
    (('force', 'u'), 6.25)
    """

    def __init__(self, text: str) -> None:
        if len(text) > _LONGEST:
            raise ValueError(
                f"begins with {text[:30]!r} and has {len(text)} characters; make values of its "
                f"parts, a formula has at most {_LONGEST}"
            )
        self.text = text
        parser = _Parser(text)
        self._tree = parser.tree()
        self.names = tuple(parser.names)

    def __call__(self, values: Mapping[str, Any]) -> Any:
        """Return the value, a number or an array."""
        try:
            with np.errstate(invalid="raise", divide="raise", over="raise"):
                return _value(self._tree, values)
        except FloatingPointError as error:
            raise ValueError(f"{self.text!r}: {error}") from None

    def __repr__(self) -> str:
        return f"Formula({self.text!r})"


def undefined_names(formula: Formula, known: Iterable[str]) -> list[str]:
    """Return an error for each unknown name in a formula."""
    names = list(known)
    listed = ", ".join(names) or "(nothing)"
    return [
        f"uses {name!r}, which is none of {listed}{did_you_mean([name], names)}"
        for name in formula.names
        if name not in names
    ]


class _Parser:
    def __init__(self, text: str) -> None:
        self._text, self._depth, self._at = text, 0, 0
        self.names: dict[str, None] = {}  # from left to right
        self._advance()

    def tree(self) -> _Tree:
        tree = self._sum()
        if self._kind != "end":
            raise self._error(f"{self._token!r} is one too many")
        return tree

    def _advance(self) -> None:
        match = _TOKEN.match(self._text, self._at)
        assert match is not None  # something, or the end
        self._kind = str(match.lastgroup)
        self._token = match[self._kind] or "the end"
        self._begin, self._at = match.span(self._kind)
        if self._kind == "other":
            raise self._error(f"{self._token!r} has no meaning here")

    def _error(self, what: str) -> ValueError:
        return ValueError(f"is {self._text!r}, which is no formula: {what}, at {self._begin + 1}")

    def _take(self, *signs: str) -> str:
        if self._kind != "sign" or self._token not in signs:
            return ""
        token = self._token
        self._advance()
        return token

    def _sum(self) -> _Tree:
        tree = self._product()
        while sign := self._take("+", "-"):
            tree = (sign, tree, self._product())
        return tree

    def _product(self) -> _Tree:
        tree = self._signed()
        while sign := self._take("*", "/"):
            tree = (sign, tree, self._signed())
        return tree

    def _signed(self) -> _Tree:
        if sign := self._take("-", "+"):
            operand = self._signed()
            return ("negative", operand) if sign == "-" else operand
        base = self._atom()
        return ("**", base, self._signed()) if self._take("**", "^") else base

    def _atom(self) -> _Tree:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise self._error(f"more than {_DEEPEST} brackets")
        kind, token = self._kind, self._token
        if kind == "number":
            self._advance()
            tree: _Tree = float(token)
        elif kind == "name":
            self._advance()
            if self._take("("):
                tree = self._call(token)
            else:
                tree = token
                if token not in _CONSTANTS:
                    self.names[token] = None
        elif self._take("("):
            tree = self._sum()
            self._close()
        else:
            raise self._error(f"a number or a name is missing before {token!r}")
        self._depth -= 1
        return tree

    def _call(self, name: str) -> _Tree:
        if name not in _FUNCTIONS:
            hint = (
                did_you_mean([name], _FUNCTIONS, shown=str) or f"; there is {', '.join(_FUNCTIONS)}"
            )
            raise self._error(f"unknown function {name!r}{hint}")
        arguments = [self._sum()]
        while self._take(","):
            arguments.append(self._sum())
        self._close()
        if len(arguments) > 1 and name not in _SEVERAL:
            raise self._error(f"{name} has one argument, not {len(arguments)}")
        return (name, *arguments)

    def _close(self) -> None:
        if not self._take(")"):
            raise self._error(f"')' is missing before {self._token!r}")


def _value(tree: _Tree, values: Mapping[str, Any]) -> Any:
    if isinstance(tree, float):
        return np.float64(tree)
    if isinstance(tree, str):
        value = values[tree] if tree in values else _CONSTANTS[tree]
        return value if isinstance(value, np.ndarray) else np.float64(value)
    # A loop in Python would double the depth of calls, which is limited.
    return _OPERATIONS[tree[0]](*map(_value, tree[1:], repeat(values)))
