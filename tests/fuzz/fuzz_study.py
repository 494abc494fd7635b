"""Any bytes as a study file: a study, or a StudyError that names file and line of every problem.

    python tests/fuzz/fuzz_study.py --seconds 60

No other exception is raised, no process is started, only the study's own tests and decks are read,
and nothing is written. An audit hook of the interpreter checks this while a study is read. Most
random bytes are not TOML. So three changes in four keep to its lines: keys and values of the seeds,
and unexpected values, change their places. Seeds are in corpus/study. An error ends the run, and
writes the bytes to crash-*.
"""

from __future__ import annotations

import contextlib
import os
import random
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fuzz_bytes import FoundError, atheris, changed_bytes, run

READERS = [
    "curvewise.studies",
    "curvewise.files.column_choice",
    "curvewise.calibration.models.templates",
]
with atheris.instrument_imports(include=READERS) if atheris else contextlib.nullcontext():
    from curvewise.calibration.problem.space import Space
    from curvewise.studies import Study, StudyError

SEEDS = Path(__file__).parent / "corpus" / "study"
# What the studies of the seeds name, in the folder in which they are read.
FILES = {
    "test.csv": "time,strain,stress\n0,0,1\n1,0.5,2\n2,1,3\n",
    "plain.csv": "0;0\n1;2,5\n2;3\n",
    "deck.inp": "*ELASTIC\n<<a>>, <<b>>\n",
    "table.inp": "<<c:8.2f>>\n<<hardening>>\n",
}
VALUES = (
    *("0", "-1", "20", "1e400", "nan", "-inf", "1" + 400 * "0", "9" * 4500, "true", '""', "''"),
    *("[]", "{}", "1979-05-27", "07:32:00", "[[]]", "[0, 1]", "[1, 0]", "[0, nan]", "[1, [2]]"),
    *('"nan"', '"a"', '"\u0661"', '"a\\u0000"', '"""\na\n"""', "[" * 2000, 500 * "[" + 500 * "]"),
    *("{ bounds = [0, 1] }", '{ bounds = [1, 2], scale = "log" }', '{ below = "a" }'),
    *('"a * b"', '"1 / 0"', '"((((a))))"', '"$HOME"', '"$NONE/x"', '"~nobody/x"', '"."', '".."'),
    *('["true"]', '"true"', '["test.csv"]', '"test.csv"', '"deck.inp"', '"out.frd"', '"x.mat"'),
    *('"dtw"', '["area", "dtw"]', '"sum_of_squares"', '"sdrm"', '"nelder-mead"', "[1]", '[["a"]]'),
    *('{ a = "a" }', "\n[[tests]]\n", "\n[model]\n", "\r\n", "#"),
)
WORDS = tuple(value.encode() for value in VALUES)
FORBIDDEN = ("subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "pty.")
FORBIDDEN += ("socket.", "sqlite3.", "os.remove", "os.rename", "os.mkdir", "os.rmdir", "shutil.")
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
_PLACE = re.compile(r", line (\d+): ")
_ASSIGNMENT = re.compile(rb"([^=#\[]+)=(.*)", re.DOTALL)


class Watch:
    """What happens while a study is read, as Python's audit events tell of it."""

    def __init__(self) -> None:
        self.is_on = False
        self.wrong: list[str] = []
        sys.addaudithook(self._see)

    def _see(self, event: str, arguments: tuple[Any, ...]) -> None:
        if not self.is_on:
            return
        writes = event == "open" and arguments[2] & WRITING
        if writes or event.startswith(FORBIDDEN):
            self.wrong.append(f"{event} {arguments!r}")


def make_check(folder: Path) -> Callable[[bytes], None]:
    """Return what writes bytes to a study file and reads it."""
    for name, text in FILES.items():
        (folder / name).write_text(text)
    path = folder / "study.toml"
    watch = Watch()

    def check(data: bytes) -> None:
        path.write_bytes(data)
        watch.is_on = True
        try:
            study = Study.read(path)
        except StudyError as error:
            _check_problems(error.problems, path, data.count(b"\n") + 1)
            study = None
        finally:
            watch.is_on = False
        if watch.wrong:
            raise FoundError(f"reading a study does {watch.wrong[0]}")
        if study is not None and not (study.tests and study.models and Space(study.bounds).names):
            raise FoundError("a study without tests, models or parameters")

    return check


def _check_problems(problems: tuple[str, ...], path: Path, lines: int) -> None:
    if not problems:
        raise FoundError("refused without a problem")
    for problem in problems:
        named, rest = problem[: len(str(path))], problem[len(str(path)) :]
        place = _PLACE.match(rest)
        if named != str(path) or place is None or not 1 <= int(place[1]) <= lines:
            raise FoundError(f"a problem without its file and line, of {lines}: {problem!r}")
        if "\n" in problem:
            raise FoundError(f"a problem of several lines: {problem!r}")


def change(data: bytes, choices: random.Random) -> bytes:
    """Return a study changed in some lines, or in some bytes."""
    if choices.random() < 0.25:
        return changed_bytes(data, choices, WORDS)
    lines = data.split(b"\n")
    for _ in range(choices.randint(1, 4)):
        at = choices.randrange(len(lines))
        what = choices.randint(0, 5)
        if what == 0:
            lines[at : at + choices.randint(1, 3)] = []
        elif what == 1:
            lines[at:at] = [choices.choice(_LINES)]
        elif what == 2:
            lines[at] = choices.choice(_LINES)
        elif what == 3:
            lines[at:at] = [lines[choices.randrange(len(lines))]]
        elif assignment := _ASSIGNMENT.fullmatch(lines[at]):
            key, value = assignment[1], assignment[2]
            if what == 4:
                value = b" " + choices.choice(WORDS)
            elif other := _ASSIGNMENT.fullmatch(choices.choice(_LINES)):
                key, value = choices.choice([(key, other[2]), (other[1], value)])
            lines[at] = key + b"=" + value
        lines = lines or [b""]
    return b"\n".join(lines)[:8000]


_LINES = [line for seed in sorted(SEEDS.iterdir()) for line in seed.read_bytes().split(b"\n")]

if __name__ == "__main__":
    run(__doc__.splitlines()[0], make_check, SEEDS, change)
