"""Formulas of study files against Python's own arithmetic, and errors."""

from __future__ import annotations

import random
import re

import numpy as np
import pytest

from curvewise.studies import Formula

VALUES = {"a": 1.25, "b": -0.5, "yield": 300.0, "lambda": 2.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2 * 3", 7.0),
        ("2 ^ 3 ^ 2", 512.0),
        ("-2 ** 2", -4.0),
        ("2 ** -1", 0.5),
        ("(1 - 2) - 3", -4.0),
        ("8 / 4 / 2", 1.0),
        ("- -3", 3.0),
        (".5e1 + 1.", 6.0),
        ("yield / lambda", 150.0),
        ("log(exp(a))", 1.25),
        ("max(a, b, 3)", 3.0),
        ("sqrt(4) * cos(0) + sin(pi)", 2.0),
    ],
)
def test_a_formula_has_the_value_of_the_textbook(text: str, value: float) -> None:
    assert float(Formula(text)(VALUES)) == pytest.approx(value, rel=1e-15, abs=1e-15)


def test_formulas_are_those_of_python() -> None:
    rng = random.Random(1)

    def made(depth: int) -> str:
        if depth == 0 or rng.random() < 0.2:
            return rng.choice(["a", "b", "2", "0.75", "1e-1"])
        if rng.random() < 0.2:
            return f"{rng.choice(['-', '+'])}{made(depth - 1)}"
        if rng.random() < 0.2:
            return f"({made(depth - 1)})"
        return f"{made(depth - 1)} {rng.choice('+-*')} {made(depth - 1)}"

    for _ in range(500):
        text = made(4)
        assert float(Formula(text)(VALUES)) == eval(text, {}, dict(VALUES)), text


def test_columns_give_columns_and_numbers() -> None:
    values = {"f": np.array([1.0, 4.0, 2.0]), "u": np.array([0.0, 1.0, 2.0])}
    assert Formula("f / (1 + u)")(values).tolist() == [1.0, 2.0, 2.0 / 3.0]
    numbers = {"max(f)": 4.0, "min(f)": 1.0, "first(f)": 1.0, "last(f)": 2.0, "sum(u)": 3.0}
    assert {text: float(Formula(text)(values)) for text in numbers} == numbers


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is '', which is no formula: a number or a name is missing before 'the end', at 1"),
        ("1 +", "a number or a name is missing before 'the end', at 4"),
        ("a b", "'b' is one too many, at 3"),
        ("a[0]", "'[' has no meaning here, at 2"),
        ("a.b", "'.' has no meaning here"),
        ("1,5", "',' is one too many"),
        ("sqr(a)", "unknown function 'sqr'; did you mean sqrt?"),
        ("__import__(a)", "unknown function '__import__'"),
        ("log(a, b)", "log has one argument, not 2"),
        ("(" * 200 + "a", "more than 100 brackets"),
        ("a + " * 200 + "a", "has 801 characters; make values of its parts"),
    ],
)
def test_what_is_no_formula_is_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        Formula(text)


def test_the_longest_formulas_are_evaluated() -> None:
    assert float(Formula("a" + "+a" * 249)(VALUES)) == 250 * VALUES["a"]
    assert float(Formula("-" * 498 + "1")(VALUES)) == 1.0
    assert float(Formula("(" * 99 + "1" + ")" * 99)(VALUES)) == 1.0


@pytest.mark.parametrize("text", ["log(b)", "1 / (a - a)", "exp(1000 * a)"])
def test_a_value_that_does_not_exist_is_an_error(text: str) -> None:
    with pytest.raises(ValueError, match=re.escape(repr(text))):
        Formula(text)(VALUES)
