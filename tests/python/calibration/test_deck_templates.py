"""Templates of decks: placeholders found, filled in, and refused."""

from __future__ import annotations

import random
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import CommandModel
from curvewise.calibration.models.templates import placeholder_spans


def filled(folder: Path, text: str, value: float | str) -> str:
    """Return a line of a deck as the solver gets it."""
    deck = folder / "deck.inp"
    deck.write_text(text)
    model = CommandModel(
        deck,
        [sys.executable, "-c", ""],
        lambda run: np.frombuffer((run / "deck.inp").read_bytes(), np.uint8).astype(float),
        parameters=["E"],
        timeout=60,
    )
    return bytes(model({"E": value}).astype(np.uint8)).decode()


@pytest.mark.parametrize(
    ("text", "value", "expected"),
    [
        ("*ELASTIC\n<<E>>, 0.3", 0.1, "*ELASTIC\n0.1, 0.3"),
        ("<<E>>", np.float64(2.5), "2.5"),
        ("<<E>>", 3, "3.0"),
        ("<< E : .3e >>,", 205000.0, "2.050e+05,"),
        ("|<<E:10>>|", 205000.0, "|205000.000|"),
        ("|<<E:10>>|", -1.0 / 3.0, "|-0.3333333|"),
        ("|<<E:10>>|", -1.23456789e-12, "|-1.235e-12|"),
        ("|<<E:8>>|", 1.0, "|1.000000|"),
        ("|<<E:20>>|", 0.1, "| 0.10000000000000001|"),
        ("|<<E:10.2f>>|", 1.5, "|      1.50|"),
        ("<<E>>;<<E:.1f>>", 1.0, "1.0;1.0"),
        ("<<E>>", "400, 0\n500, 0.1", "400, 0\n500, 0.1"),
    ],
)
def test_placeholders_are_filled(tmp_path: Path, text: str, value: Any, expected: str) -> None:
    assert filled(tmp_path, text, value) == expected


def test_what_solvers_write_with_signs_is_left_alone(tmp_path: Path) -> None:
    deck = "$ LS-DYNA &E\n** Abaqus <E>\n{E} %E% #E ${E} $E\n! APDL\n 1 << 2 >\n"
    assert filled(tmp_path, deck + "<<E>>", 1.0) == deck + "1.0"


def test_bytes_and_line_ends_survive(tmp_path: Path) -> None:
    template = tmp_path / "deck.inp"
    template.write_bytes(b"** M\xfcller\r\n<<E>>\r\n")
    model = CommandModel(
        template,
        [sys.executable, "-c", ""],
        lambda run: np.array([(run / "deck.inp").read_bytes() == b"** M\xfcller\r\n2.0\r\n"]),
        parameters=["E"],
        timeout=60,
    )
    assert model({"E": 2.0}).tolist() == [1.0]


@pytest.mark.parametrize(
    ("text", "value", "message"),
    [
        ("1\n<<E:8.3e>>", -1.0, r"deck.inp, line 2: <<E:8.3e>>: -1.000e\+00 is longer than"),
        ("<<E:>6.2f>>", 12345.0, "12345.00 is longer than the field"),
        ("<<E:4>>", -1e-9, "does not fit; widen the field"),
        ("<<E:.3f>>", "text", "line 1"),
        ("<<E>>", float("nan"), "parameter E is nan; parameters must be finite"),
    ],
)
def test_values_that_do_not_fit_are_refused(
    tmp_path: Path, text: str, value: Any, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        filled(tmp_path, text, value)


def test_placeholders_are_what_stands_between_two_brackets_of_a_line() -> None:
    rng = random.Random(4)
    for _ in range(3000):
        text = "".join(rng.choices("<>\nE", [6, 6, 1, 2], k=rng.randrange(40)))
        expected = [match.span() for match in re.finditer("<<(.*?)>>", text)]
        assert list(placeholder_spans(text)) == expected, text


def test_open_brackets_take_linear_time(tmp_path: Path) -> None:
    text = "<<" * 300_000  # read again for each of them, they would take an hour
    assert filled(tmp_path, f"<<E>>\n{text}", 1.5) == f"1.5\n{text}"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<<E>>\n<<nu>>", "deck.inp, line 2: <<nu>> is not a parameter; they are E"),
        ("0.3", "no template has a placeholder <<E>>"),
        ("<<E*2>>", r"<<E\*2>> is malformed"),
        ("<<>>", "<<>> is malformed"),
        ("<<E:ten>>", "<<E:ten>> has no format of a number"),
        ("<<E:d>>", "<<E:d>> has no format of a number"),
    ],
)
def test_wrong_placeholders_are_found_before_the_first_run(
    tmp_path: Path, text: str, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        filled(tmp_path, text, 1.0)
