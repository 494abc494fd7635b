"""Messages name the options as the user writes them: keywords in Python, flags of a command."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import curvewise
from curvewise import read_curve
from curvewise._option_names import called, instead, named_by, with_values
from curvewise.commands import main
from curvewise.commands.reading import flags_of
from curvewise.files.file_options import CYCLE_COLUMN, PREPARATION, READING

OPTIONS = (*READING, *PREPARATION, CYCLE_COLUMN)
WORDS = [*(option.word for option in OPTIONS), "columns", "factors"]
PACKAGE = Path(curvewise.__file__).parent
# What reads and prepares the files of the commands, and writes messages about options.
MODULES = sorted(
    [
        *PACKAGE.glob("files/*.py"),
        *(
            PACKAGE / "fitting" / f"{name}.py"
            for name in ("preparation", "recorded_cycles", "beginnings", "moduli", "card_refusals")
        ),
        PACKAGE / "materials" / "readings.py",
    ]
)
# A word that is written out instead of asked for: "(until)", "sheet is", "omit sheet", "until=".
WORD = "|".join(WORDS)
WRITTEN_OUT = re.compile(
    rf"\(({WORD})\)|^({WORD}) (is|has) |(omit|leave) ({WORD})\b|\b({WORD})=(?!\w)"
    r"|\b(skip_invalid|header_row|gauge_length|cycle_column)\b"
)
# Names in code and in texts for Python alone, which `instead` tells from those of a command.
FOR_PYTHON = re.compile(
    r"^(curvewise fit: )?--\w+|^gauge_length$|^header_row$|^skip_invalid$|^cycle_column$"
)


def messages_of(path: Path) -> list[tuple[int, str]]:
    """Return the literal texts of a module that are neither docstrings nor help texts."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = {
        id(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    return [
        (node.lineno, node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and id(node) not in documented
    ]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_no_message_writes_out_the_name_of_an_option(path: Path) -> None:
    found = [
        f"{path.name}:{line}: {text!r}"
        for line, text in messages_of(path)
        if WRITTEN_OUT.search(text) and not FOR_PYTHON.search(text)
    ]
    assert not found, "ask for the name: f'({called(\"until\")})'"


def test_the_search_for_written_out_names_finds_them() -> None:
    for text in ("leave it out (skip_invalid)", "sheet is ", "; omit sheet", "give columns="):
        assert WRITTEN_OUT.search(text)


STATISTICS = "strain,stress\n0,0\n0.001,200\nStatistics,\n0.002,300\n"
WRONG = {
    "from": (STATISTICS, ["--from", ""]),
    "header-row": (STATISTICS, ["--header-row", "77"]),
    "until": (STATISTICS, ["--until", ""]),
    "skip-invalid": (STATISTICS, []),
    "sheet": (STATISTICS, ["--sheet", "2"]),
    "encoding": (STATISTICS, ["--encoding", "no such"]),
    "decimal": ("strain;stress\n0.001;200\n0,002;300\n", []),
    "columns": ("time (s),strain,stress\n0,0,0\n1,0.001,200\n2,0.002,300\n", []),
    "factors": ("strain,stress\n0,0\n0.001,200\n", ["--factors", "1"]),
    "area": ("strain,stress\n0,0\n0.001,200\n", ["--area", "-1", "--factors", "1", "1"]),
    "gauge-length": ("strain,stress\n0,0\n0.001,200\n", ["--gauge-length", "-1"]),
}


@pytest.mark.parametrize("option", WRONG)
def test_commands_name_their_options(option: str, tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    text, given = WRONG[option]
    Path("wrong.csv").write_text(text)
    Path("right.csv").write_text("strain,stress\n0,0\n0.001,200\n0.002,300\n")
    assert main(["fit", "wrong.csv", *given]) == 1
    said = capsys.readouterr().err
    assert re.search(rf"--{option}\b(?!-)", said)
    assert not WRITTEN_OUT.search(said)
    of_b = [f"{one}-b" if one.startswith("--") else one for one in given]
    assert main(["compare", "right.csv", "wrong.csv", *of_b]) == 1
    said = capsys.readouterr().err
    assert f"--{option}-b" in said
    assert not WRITTEN_OUT.search(said)


def test_python_names_its_keywords(tmp_path: Path) -> None:
    path = tmp_path / "wrong.csv"
    path.write_text(STATISTICS)
    with pytest.raises(ValueError, match=r"\(from\).*\(until\).*\(skip_invalid\)"):
        read_curve(path)


def test_a_command_leaves_other_options_to_python() -> None:
    with named_by(flags_of({"skip_invalid": None, "measures": None})):
        assert called("skip_invalid") == "--skip-invalid"
        assert called("from_") == "from"
        assert with_values("measures", ["a b", 2]) == "--measures 'a b' 2"
        assert instead("toe", "Python") == "Python"
        with named_by(flags_of({"toe": None}, "-b")):
            assert (called("toe"), called("skip_invalid")) == ("--toe-b", "--skip-invalid")
    assert (called("skip_invalid"), with_values("columns", [1])) == ("skip_invalid", "columns=[1]")
