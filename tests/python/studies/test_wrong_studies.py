"""Wrong studies, and their messages: file, line, key, the error, and the correction."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from curvewise.commands import main
from curvewise.studies import Study, StudyError
from curvewise.studies.toml_source import Source

STUDY = f"""\
title = "a line"

[[tests]]
name = "line"
file = "test.csv"
columns = ["strain", "stress"]

[tests.output]
file = "out.csv"

[model]
command = ['{sys.executable}', "deck.py"]
templates = "deck.py"
timeout = 60

[parameters]
a = [0, 10]
b = [-5, 5]

[search]
measure = "area"
method = "trust-region"
workers = 1
"""
DECK = "<<a>> <<b>>\n"
TEST = "time,strain,stress\n0,0,1\n1,0.5,2\n2,1,3\n"


def problems(folder: Path, text: str, deck: str = DECK) -> list[str]:
    (folder / "test.csv").write_text(TEST)
    (folder / "deck.py").write_text(deck)
    (folder / "study.toml").write_text(text)
    with pytest.raises(StudyError) as caught:
        Study.read(folder / "study.toml")
    assert "\n".join(caught.value.problems) == str(caught.value)
    return [problem.removeprefix(f"{folder}/") for problem in caught.value.problems]


WRONG = {
    "a misspelt key": (
        'columns = ["strain", "stress"]',
        'colums = ["strain", "stress"]',
        "study.toml, line 5: tests[1].file cannot be used: the first two of the 3 columns of "
        "{folder}/test.csv are time and strain; name those wanted: "
        'columns = ["strain", "stress"]\n'
        "study.toml, line 6: tests[1].colums is not a known key; did you mean 'columns'?",
    ),
    "a column that is not there": (
        'columns = ["strain", "stress"]',
        'columns = ["strain", "force"]',
        "study.toml, line 6: tests[1].columns cannot be used: {folder}/test.csv has no column "
        "'force'; its columns are time, strain, stress; by number, give 1 to 3",
    ),
    "a test that is not there": (
        'file = "test.csv"',
        'file = "tets.csv"',
        "study.toml, line 5: tests[1].file {folder}/tets.csv: No such file or directory",
    ),
    "a variable that is not set": (
        'file = "test.csv"',
        'file = "$NO_SUCH_FOLDER/test.csv"',
        "study.toml, line 5: tests[1].file is '$NO_SUCH_FOLDER/test.csv', and no variable "
        "NO_SUCH_FOLDER is set; set it",
    ),
    "a command as for a shell": (
        f"command = ['{sys.executable}', \"deck.py\"]",
        'command = "ccx -i deck"',
        "study.toml, line 12: model.command is 'ccx -i deck'; commands run without a shell: give a "
        'list, ["ccx", "-i", "deck"]',
    ),
    "a program that is not there": (
        f"command = ['{sys.executable}', \"deck.py\"]",
        'command = ["cxc", "-i", "deck"]',
        "study.toml, line 12: model.command starts with 'cxc', which does not exist on "
        "this machine",
    ),
    "bounds the wrong way round": (
        "a = [0, 10]",
        "a = [10, 0]",
        "study.toml, line 17: parameters.a is [10, 0]; give [low, high], low below high",
    ),
    "a number in quotes": (
        "a = [0, 10]",
        'a = [0, "10"]',
        "study.toml, line 17: parameters.a is '10'; give a number, without quotes",
    ),
    "a parameter that no template has": (
        "b = [-5, 5]",
        "b = [-5, 5]\nc = [0, 1]",
        "study.toml, line 19: parameters.c is used nowhere: no template has <<c>>, and no formula "
        "uses it",
    ),
    "a placeholder that is no parameter": (
        "b = [-5, 5]",
        "B = [-5, 5]",
        "study.toml, line 13: model.templates deck.py, line 1: <<b>>: nothing is called b; there "
        "is a, B; did you mean <<B>>?",
    ),
    "a tied parameter that goes before": (
        "a = [0, 10]",
        'a = "2 * b"',
        "study.toml, line 17: parameters.a uses 'b', which is none of (nothing); list those it "
        "uses before it",
    ),
    "a formula that is none": (
        "a = [0, 10]",
        'a = "2 * (b"',
        "study.toml, line 17: parameters.a is '2 * (b', which is no formula: ')' is missing before "
        "'the end', at 7",
    ),
    "a misspelt measure": (
        'measure = "area"',
        'measure = "frechte"',
        "study.toml, line 21: search.measure is 'frechte'; did you mean 'frechet'?",
    ),
    "an option of another method": (
        'method = "trust-region"',
        'method = { name = "sdrm", popsize = 20 }',
        "study.toml, line 22: search.method cannot be: method 'sdrm' has no option "
        "popsize; it has gamma_osc, gamma_pan, eta, initial_range, tol, maxiter",
    ),
    "a method that needs squares": (
        'method = "trust-region"',
        'method = "least-squares"',
        "study.toml, line 22: search.method does not go together: measure 'area' is not a sum of "
        "squares; method 'least-squares' needs measure='curve_length' or 'sum_of_squares'",
    ),
    "a file that several solvers write": (
        'file = "out.csv"',
        'file = "deck.dat"',
        "study.toml, line 9: tests[1].output.file is 'deck.dat', which may be CalculiX's, Abaqus' "
        "or plain columns; give format, one of columns, calculix-dat, calculix-frd, abaqus-dat, "
        "ls-dyna-nodout, ls-dyna-elout, ls-dyna-binout",
    ),
    "formulas of columns without names": (
        'file = "out.csv"',
        'file = "out.csv"\nx = "log(1 + u)"\ny = "f"',
        "study.toml, line 10: tests[1].output.x is a formula; give columns as a table of the names "
        "in it",
    ),
    "a text without quotes": (
        'name = "line"',
        "name = line",
        'study.toml, line 4: Invalid value; texts and formulas stand in quotes: "line"',
    ),
    "a formula without quotes": (
        'file = "out.csv"',
        'file = "out.csv"\ny = F * (1 + u)',
        'study.toml, line 10: Invalid value; texts and formulas stand in quotes: "F * (1 + u)"',
    ),
    "a number as Fortran has it": (
        "b = [-5, 5]",
        "b = [1.e5, 2.e5]",
        "study.toml, line 18: Unclosed array; a number has digits on both sides of its point: "
        "0.5, 1.0e5",
    ),
    "a comma as the decimal sign": (
        "b = [-5, 5]",
        "b = 1,5",
        "study.toml, line 18: Expected newline or end of document after a statement; numbers have "
        "a decimal point",
    ),
    "a key that is there twice": (
        "b = [-5, 5]",
        "a = [-5, 5]",
        "study.toml, line 18: Cannot overwrite a value",
    ),
    "no time limit": (
        "timeout = 60\n",
        "",
        "study.toml, line 11: model has no timeout; give the seconds that a run may take",
    ),
    # Found by tests/fuzz/fuzz_study.py: errors that did not name a study.
    "a number that is longer than Python reads": (
        "b = [-5, 5]",
        f"b = [0, {5000 * '9'}]",
        "study.toml, line 18: a number of thousands of digits",
    ),
    "a whole number that no double holds": (
        "b = [-5, 5]",
        f"b = [0, 1{400 * '0'}]",
        "study.toml, line 18: parameters.b[2] is a whole number beyond 64 bits; write it with a "
        "point or an e",
    ),
    "brackets without end": (
        "b = [-5, 5]",
        f"b = {3000 * '['}",
        "study.toml, line 18: too many brackets within brackets",
    ),
    "a character that no path has": (
        'file = "out.csv"',
        'file = "out.csv"\n[results]\nfolder = "a\\u0000b"',
        "study.toml, line 11: results.folder is 'a\\x00b'; no path has a character \\0",
    ),
    "a key with a line break": (
        "b = [-5, 5]",
        'b = [-5, 5]\n"c\\nd" = 1',
        "study.toml, line 16: parameters.c\\nd is 'c\\nd'; a name has letters, digits and _, and "
        "no digit first",
    ),
    "scratch that is a file": (
        "timeout = 60",
        'timeout = 60\nscratch = "test.csv"',
        "study.toml, line 15: model.scratch is {folder}/test.csv, which is not a folder",
    ),
    "workers that nobody is": (
        "workers = 1",
        "workers = 0",
        "study.toml, line 23: search.workers is 0; give at least 1, or -1 for one for each core",
    ),
}


@pytest.mark.parametrize("case", WRONG.values(), ids=WRONG)
def test_a_wrong_study_says_where_and_what_to_write(
    tmp_path: Path, case: tuple[str, str, str]
) -> None:
    right, wrong, message = case
    assert STUDY.count(right) == 1
    expected = message.replace("{folder}", str(tmp_path.resolve())).splitlines()
    assert problems(tmp_path, STUDY.replace(right, wrong)) == expected


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ("values = 3", "line 15: model.values is 3; it is a table, [values]"),
        ("tables = ['a']", "line 15: model.tables is ['a']; it is a table, [tables]"),
        ("values = false", "line 15: model.values is False; it is a table, [values]"),
    ],
)
def test_what_is_no_table_is_named(tmp_path: Path, wrong: str, message: str) -> None:
    text = STUDY.replace("timeout = 60", f"timeout = 60\n{wrong}")
    assert problems(tmp_path, text) == [f"study.toml, {message}"]


def test_models_that_are_no_table(tmp_path: Path) -> None:
    text = STUDY[: STUDY.index("[model]")] + STUDY[STUDY.index("[parameters]") :]
    found = problems(tmp_path, f"models = ['bar']\n{text}")
    assert found[0] == "study.toml, line 1: models is ['bar']; it is a table, [models]"


def test_reading_a_study_makes_no_folder(tmp_path: Path) -> None:
    (tmp_path / "test.csv").write_text(TEST)
    (tmp_path / "deck.py").write_text(DECK)
    text = STUDY.replace("timeout = 60", 'timeout = 60\nscratch = "runs/of/it"')
    (tmp_path / "study.toml").write_text(text)
    study = Study.read(tmp_path / "study.toml")
    assert not (tmp_path / "runs").exists()
    study.study_models()
    assert (tmp_path / "runs" / "of" / "it").is_dir()


def test_all_problems_are_named_at_once(tmp_path: Path) -> None:
    text = STUDY.replace('"area"', '"aera"').replace("timeout = 60", "timeout = -1")
    text = text.replace("[0, 10]", "[0]").replace("title", "titel")
    found = problems(tmp_path, text)
    assert [problem.partition(":")[0] for problem in found] == [
        "study.toml, line 1",
        "study.toml, line 14",
        "study.toml, line 17",
        "study.toml, line 21",
    ]


def test_the_shell_has_a_line_for_each_problem(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    problems(tmp_path, STUDY.replace('"area"', '"aera"').replace("workers = 1", "workers = 0"))
    assert main(["identify", str(tmp_path / "study.toml")]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line.startswith(f"curvewise: {tmp_path}/study.toml, line") for line in lines] == [
        True,
        True,
    ]


def test_a_study_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["identify", str(tmp_path / "study.toml")]) == 1
    assert "study.toml: No such file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("one", "other"), [("shear (1)", "shear [1]"), ("Shear", "shear"), ("\uac00", "\u1100\u1161")]
)
def test_two_tests_do_not_write_one_file(tmp_path: Path, one: str, other: str) -> None:
    """Nor where a file system ignores case, or how a letter is written."""
    text = STUDY.replace('name = "line"', f'name = "{one}"')
    begin, end = text.index("[[tests]]"), text.index("[model]")
    (found,) = problems(tmp_path, f"{text}\n{text[begin:end].replace(one, other)}")
    assert found.startswith(f"study.toml, line 25: tests[2] is called {other!r}, and its results ")
    assert found.endswith(f".csv, as those of {one!r} would; rename one of them")


def test_several_measures_do_not_go_with_tests_of_different_kinds(tmp_path: Path) -> None:
    text = STUDY.replace('measure = "area"', 'measures = ["area", "dtw"]')
    text = text.replace('name = "line"', 'name = "line"\nsigma = 4.0')
    (found,) = problems(tmp_path, text)
    assert found.startswith("study.toml, line 3: tests[1] has settings of its own, ")


def test_lines_are_those_of_keys_wherever_they_stand(tmp_path: Path) -> None:
    path = tmp_path / "any.toml"
    path.write_text(
        '# a comment with [brackets] and "quotes\n'  # 1
        "a.b = 1  # and = more\n"  # 2
        'c = """\n[not.a.table]\nx = 1"""\n'  # 3 to 5
        "d = [\n  { e = 1 },\n  { 'e.f' = [1,\n 2] },\n]\n"  # 6 to 10
        "[[t]]\n[t.u]\nv = 1979-05-27T07:32:00Z\n"  # 11 to 13
        '[[t]]\n[[t.w]]\nx = -1.5e+3\n[ "q r" . s ]\ny = true\n'  # 14 to 18
    )
    source = Source(path)
    lines = {
        ("a",): 2,
        ("a", "b"): 2,
        ("c",): 3,
        ("d", 0): 7,
        ("d", 0, "e"): 7,
        ("d", 1, "e.f"): 8,
        ("d", 1, "e.f", 1): 9,
        ("t", 0): 11,
        ("t", 0, "u", "v"): 13,
        ("t", 1): 14,
        ("t", 1, "w", 0, "x"): 16,
        ("q r", "s", "y"): 18,
        ("no", "such"): 1,
        ("t", 1, "no such"): 14,
    }
    assert {place: source.line(place) for place in lines} == lines
