"""Stores that are damaged: a changed byte, or a missing end.

A study fills a store. Copies of it are damaged, one byte each; every tenth is cut off instead. They
are processed by the real command line: listed, written as a table, rescued, and, every fifth of
them, used for another search. Each command must either print its output for the whole store, or end
with status 1 and one sentence that names the file. Rescued data must be a part of the whole store.
A few commands run as separate processes. The others run within this one, to save time.

    python tests/faults/stores.py [--times 400] [--show 10]
"""

from __future__ import annotations

import argparse
import contextlib
import io
import random
import subprocess
import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path

from curvewise.commands import main as curvewise

STUDY = f"""
[[tests]]
file = "test.csv"
output = {{ file = "out.csv" }}
[model]
command = ['{sys.executable}', "-I", "-S", "deck.py"]
templates = "deck.py"
timeout = 60
[parameters]
a = [0, 10]
b = [-5, 5]
[search]
method = {{ name = "sdrm", maxiter = 6 }}
uncertainty = false
"""
DECK = (
    "print('x,y', '0,%r' % <<b>>, '1,%r' % (<<a>> + <<b>>), sep='\\n', file=open('out.csv', 'w'))"
)


def called(arguments: list[str], as_process: bool) -> tuple[int, str, str]:
    """Return the exit status of a command, its output, and its errors."""
    if as_process:
        command = [sys.executable, "-m", "curvewise", *arguments]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        return run.returncode, run.stdout, run.stderr
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            status = curvewise(arguments)
        except Exception:
            traceback.print_exc()
            status = 1
    return status, out.getvalue(), errors.getvalue()


def damaged(whole: bytes, rng: random.Random, *, is_cut: bool) -> bytes:
    """Return a store without its end, or with another byte somewhere."""
    if is_cut:
        return whole[: rng.randrange(1, len(whole))]
    content = bytearray(whole)
    content[rng.randrange(len(content))] ^= rng.randrange(1, 256)
    return bytes(content)


class Trial:
    """A study in a folder, its store, and what the commands say of that."""

    def __init__(self, folder: Path) -> None:
        self.store, self.table = folder / "study.db", folder / "table.csv"
        (folder / "test.csv").write_text("x,y\n0,1\n0.5,2\n1,3\n2,5\n")
        (folder / "deck.py").write_text(DECK)
        (folder / "study.toml").write_text(STUDY)
        search = ["identify", str(folder / "study.toml")]
        status, _, errors = called(search, as_process=False)
        assert status == 0, errors
        file, new = str(self.store), str(folder / "new.db")
        self.commands = {
            "list": ["report", file, "--list"],
            "table": ["report", file, "--csv", str(self.table)],
            "rescue": ["report", file, "--rescue", new],
            "identify": search,
        }
        self.new = Path(new)
        self.whole = self.store.read_bytes()
        self.expected = {name: self.answer(name, as_process=False) for name in self.commands}

    def answer(self, name: str, as_process: bool) -> tuple[int, str, str]:
        """Return the output of a command, and its file."""
        self.new.unlink(missing_ok=True)
        status, out, errors = called(self.commands[name], as_process)
        written = self.table.read_text() if name == "table" and status == 0 else ""
        return status, out + written, errors

    def wrong(self, name: str, content: bytes, as_process: bool) -> tuple[str, str]:
        """Damage the store, run a command; return the error, or "", and the sentence."""
        for file in self.store.parent.glob("study.db*"):
            file.unlink()
        self.store.write_bytes(content)
        status, out, errors = self.answer(name, as_process)
        if "Traceback" in errors:
            return f"{name}: a traceback: {errors.splitlines()[-1]}", ""
        if status == 0:
            # Some of it may have been rescued, and what the store lacks is run again.
            is_right = (
                name == "rescue" or out.splitlines()[1:] == self.expected[name][1].splitlines()[1:]
            )
            return ("" if is_right else f"{name}: other results"), ""
        sentences = errors.strip().splitlines()
        if len(sentences) != 1 or str(self.store) not in sentences[0]:
            return f"{name}: {errors}", ""
        return "", sentences[0]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=400)
    parser.add_argument("--show", type=int, default=0, help="print so many of the sentences")
    arguments = parser.parse_args()
    rng = random.Random(arguments.times)
    wrong: list[str] = []
    sentences: list[str] = []
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(Path(name))
        for k in range(arguments.times):
            content = damaged(trial.whole, rng, is_cut=k % 10 == 9)
            for command in trial.commands:
                if command == "identify" and k % 5:
                    continue
                problem, sentence = trial.wrong(command, content, as_process=k % 50 == 0)
                wrong += [problem] if problem else []
                sentences += [sentence] if sentence else []
                counts["wrong" if problem else "a sentence" if sentence else "right"] += 1
    print(f"{arguments.times} damaged stores: {dict(counts)}")
    tracebacks = sum("traceback" in problem for problem in wrong)
    print(f"{tracebacks} tracebacks")
    print(*Counter(wrong).most_common(20), sep="\n")
    print(*rng.sample(sentences, min(arguments.show, len(sentences))), sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
