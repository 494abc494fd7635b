"""Damaged files of every kind, given to the command line.

Bytes are changed, files are cut short, blocks are zeroed, doubled or dropped, and files are empty,
or hold the contents of another kind of file. Curves (csv, xlsx, mat) go to `curvewise compare`,
stores (db) to `curvewise report`. Studies (toml) and solver output (frd, dat, abaqus, nodout,
elout) go to `curvewise identify --check`, whose solver copies the file. Every call is a fork of
this process. It either succeeds, or prints the error in lines that begin with "curvewise:" and name
the file. There must be no traceback, no crash, no call beyond a time limit, no "None" and no
warning of Python's. Whole files are tried first, and must be read. Sentences drawn at random are
printed for reading.

    python tests/faults/damaged_files.py [--times 2000] [--seed 1] [--only mat frd] [--sentences 50]
"""

from __future__ import annotations

import argparse
import io
import os
import random
import re
import signal
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np
import openpyxl
import pandas  # noqa: F401  (once, for all forks)
import scipy.io

import curvewise.calibration.report
import curvewise.studies  # noqa: F401
from curvewise.calibration import SDRM, identify
from curvewise.commands import main as command_line

SECONDS = 30.0
TRACEBACK = 99
TIMES = (0.25, 0.5, 0.75, 1.0)

STUDY = """title = "damaged"

[[tests]]
file = "good.csv"
columns = ["strain", "stress"]

[tests.output]
file = "{file}"
{output}

[parameters]
E = [150e3, 250e3]
b = {{ bounds = [2, 100], scale = "log" }}

[model]
command = ["cp", "{source}", "{file}"]
templates = "deck.inp"
timeout = 20

[search]
measure = "dtw"
"""
CALCULIX = (
    'columns.u = { component = "vx", set = "TOP", node = 2 }\ncolumns.F = { component = "fx", '
)
CALCULIX += 'set = "TOP", combine = "sum" }\nx = "u"\ny = "F"\nfirst_point = [0, 0]'
OUTPUTS = {
    "toml": ("good.csv", "columns = [1, 2]"),
    "dat": ("deck.dat", f'format = "calculix-dat"\n{CALCULIX}'),
    "frd": (
        "deck.frd",
        'columns.u = { component = "D1", node = 7 }\n'
        'columns.F = { component = "F1", node = 7 }\nx = "u"\ny = "F"',
    ),
    "abaqus": (
        "deck.dat",
        'format = "abaqus-dat"\ncolumns.u = { component = "U2", node = 3 }\n'
        'columns.F = { component = "RF2", combine = "sum" }\nx = "u"\ny = "F"',
    ),
    "nodout": (
        "nodout",
        'columns.t = { component = "time" }\n'
        'columns.u = { component = "x-disp", node = 71 }\nx = "t"\ny = "u"',
    ),
    "elout": (
        "elout",
        'columns.t = { component = "time" }\n'
        'columns.s = { component = "sig-xx", element = 12, combine = "mean" }\nx = "t"\ny = "s"',
    ),
}
KINDS = ("csv", "xlsx", "mat", "db", *OUTPUTS)


def curve() -> np.ndarray:
    strain = np.sin(np.linspace(0.0, 7.0, 40)) * 0.02
    return np.column_stack((strain, 400 * np.tanh(200 * strain)))


def texts() -> list[bytes]:
    """Return curves as machines write them."""
    rows = curve().tolist()
    plain = "strain,stress\n" + "".join(f"{x:.6g},{y:.6g}\n" for x, y in rows)
    german = [f"{x:.6f};{y:,.3f}".translate(str.maketrans(".,", ",.")) for x, y in rows]
    block = "Width;12,5\nThickness;1,5\n\nstrain;stress\n%;MPa\n" + "\n".join(german)
    quoted = '"strain","stress"\n' + "".join(
        f'"{x:.6f}","{y:.3f}"\n'.replace(".", ",") for x, y in rows
    )
    tabs = "strain\tstress\r\n" + "".join(f"{x:.5e}\t{y:.5e}\r\n" for x, y in rows)
    return [plain.encode(), block.encode("latin-1"), quoted.encode(), tabs.encode("utf-16")]


def workbooks(folder: Path) -> list[bytes]:
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.append(["strain", "stress"])
    for row in curve().tolist():
        sheet.append(row)
    book.create_sheet("about").append(["operator", "date"])
    book.save(folder / "seed.xlsx")
    return [(folder / "seed.xlsx").read_bytes()]


def mats(folder: Path) -> list[bytes]:
    """Return .mat files of versions 5 (packed or not, with a structure) and 4."""
    strain, stress = curve().T
    found = []
    for keywords in ({"do_compression": True}, {}, {"format": "4"}):
        content = {"strain": strain, "stress": stress}
        if "format" not in keywords:
            content["machine"] = {"name": "A7", "gain": 2.0}
        scipy.io.savemat(folder / "seed.mat", content, **keywords)
        found.append((folder / "seed.mat").read_bytes())
    return found


class Line:
    identity = "line"

    def __call__(self, parameters: dict[str, float]) -> np.ndarray:
        return curve() * [1.0, parameters["a"]] + [0.0, parameters["b"]]


def stores(folder: Path) -> list[bytes]:
    bounds = {"a": (0.5, 2.0), "b": (-50.0, 50.0)}
    file = folder / "seed.db"
    identify(Line(), curve(), bounds, method=SDRM(maxiter=2), store=file, progress=False)
    return [file.read_bytes()]


def dat() -> str:
    rows = [(time, node) for time in TIMES for node in (2, 3)]
    return "\n".join(
        f"\n {what} ({names}) for set TOP and time  {time:.7E}\n\n"
        f"{node:10d}  {time * size:.6E} -{time:.6E}  0.000000E+00\n"
        f"{node + 4:10d}  {time * size:.6E}  {time:.6E}  0.000000E+00"
        for time, node in rows[::2]
        for what, names, size in (("displacements", "vx,vy,vz", 0.01), ("forces", "fx,fy,fz", 500))
    )


def frd() -> str:
    """Return the text of a .frd, with nodes, and two variables at each time."""
    lines = ["    1C", "    2C                             2", " -1         7 0.0 0.0 0.0", " -3"]
    for step, at in enumerate(TIMES, 1):
        for name, component, size in (("DISP", "D", 0.01), ("FORC", "F", 500.0)):
            lines.append(f"  100CL  {100 + step}{at:12.5E}           2{'1':>24}{step:>5}{'1':>12}")
            lines.append(f" -4  {name}        4    1")
            lines += [f" -5  {component}{i}          1    2    {i}    0" for i in (1, 2, 3)]
            lines.append(" -5  ALL         1    2    0    0    1ALL")
            for node in (7, 8):
                lines.append(f" -1{node:10d}{at * size:12.5E}{-at:12.5E}{0.0:12.5E}")
            lines.append(" -3")
    return "\n".join([*lines, " 9999\n"])


def abaqus() -> str:
    return "\n".join(
        f" STEP TIME COMPLETED {time:11.3f}    ,  TOTAL TIME COMPLETED {time:11.3f}\n\n"
        "   THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TOP\n\n"
        "       NODE FOOT-   U2             RF2\n            NOTE\n\n"
        f"          3    {time:11.4E}  {500 * time:9.2f}\n"
        f"          4 SD {time:11.4E}  {-500 * time:9.2f}\n\n"
        f" MAXIMUM       {time:11.4E}    -75.1\n AT NODE             3            3\n"
        for time in TIMES
    )


def nodout() -> str:
    return "\n".join(
        " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1"
        f"     ( at time {time:.7E} )\n\n nodal point  x-disp     y-disp      z-disp\n"
        f"        71 {time / 100:12.4E}{-time:12.4E}{0.0:12.4E}\n"
        f"        72 {time / 100:12.4E}{-time:12.4E}{0.0:12.4E}\n"
        for time in TIMES
    )


def elout() -> str:
    row = "{point:8d} elastic " + "{stress:12.4E}" * 6 + "  2.0000E+02  1.0000E+00\n"
    return "\n".join(
        " e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p        1"
        f"   ( at time {time:.5E} )\n\n element  materl\n     ipt  stress       sig-xx\n"
        "           state\n      12-      1\n"
        + "".join(row.format(point=point, stress=200 * time) for point in (1, 2))
        for time in TIMES
    )


def seeds(kinds: list[str], folder: Path) -> dict[str, list[bytes]]:
    """Return whole files of every kind."""
    makers = {
        "csv": lambda: texts(),
        "xlsx": lambda: workbooks(folder),
        "mat": lambda: mats(folder),
        "db": lambda: stores(folder),
        "toml": lambda: [study("toml", folder / "damaged" / "good.csv")],
    }
    for text in (dat, frd, abaqus, nodout, elout):
        makers[text.__name__] = lambda text=text: [text().encode()]
    return {kind: makers[kind]() for kind in kinds}


def study(kind: str, source: Path) -> bytes:
    file, output = OUTPUTS[kind]
    return STUDY.format(file=file, output=output, source=source).encode()


def damaged(data: bytes, others: list[bytes], choices: random.Random) -> tuple[str, bytes]:
    """Return the kind of damage to a file, and its bytes."""
    how = choices.choices(
        ["bytes", "cut", "zeroed", "doubled", "dropped", "empty", "another"],
        [40, 20, 12, 12, 12, 1, 3],
    )[0]
    begin, end = sorted(choices.randrange(len(data) + 1) for _ in range(2))
    end = min(end, begin + choices.choice((4, 60, 2000)))
    if how == "bytes":
        changed = bytearray(data)
        for _ in range(choices.choice((1, 1, 2, 8))):
            changed[choices.randrange(len(data))] = choices.choice((0, 255, choices.randrange(256)))
        return how, bytes(changed)
    return how, {
        "cut": data[:begin],
        "zeroed": data[:begin] + bytes(end - begin) + data[end:],
        "doubled": data[:end] + data[begin:],
        "dropped": data[:begin] + data[end:],
        "empty": b"",
        "another": choices.choice(others),
    }[how]


def repacked(book: bytes, choices: random.Random) -> tuple[str, bytes]:
    """Return a workbook with a part of it damaged, so that its check sums are right."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    name = choices.choice(list(parts))
    how, parts[name] = damaged(parts[name], list(parts.values()), choices)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for part, data in parts.items():
            archive.writestr(part, data)
    return f"{how} in {name}", packed.getvalue()


class Outcome(NamedTuple):
    status: int
    """The exit status; 99 after an exception, negative after a signal, -SIGKILL for a hang."""
    said: str
    """What stood on standard error."""


def called(arguments: list[str], folder: Path) -> Outcome:
    """Run the command line in a fork of this process, in a folder."""
    errors = folder / "stderr"
    child = os.fork()
    if child == 0:
        status = TRACEBACK
        try:
            os.setsid()
            os.chdir(folder)
            for name, descriptor in (("stdout", 1), (errors, 2)):
                os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), descriptor)
            sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w")
            status = command_line(arguments)
        except SystemExit as end:
            status = int(end.code or 0)
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(status)
    end = time.monotonic() + SECONDS
    while (waited := os.waitpid(child, os.WNOHANG))[0] == 0:
        if time.monotonic() > end:
            os.killpg(child, signal.SIGKILL)
            waited = os.waitpid(child, 0)
            break
        time.sleep(0.002)
    status = os.waitstatus_to_exitcode(waited[1])
    return Outcome(status, errors.read_text(errors="replace"))


def judged(outcome: Outcome, named: str) -> str:
    """Return "read", "refused", or the error."""
    if outcome.status == TRACEBACK or "Traceback (most recent" in outcome.said:
        return "traceback"
    if outcome.status == -signal.SIGKILL:
        return "hang"
    if outcome.status < 0 or outcome.status > 1:
        return "crash"
    lines = outcome.said.splitlines()
    strangers = [line for line in lines if not line.startswith("curvewise:")]
    if outcome.status == 0:
        return "warning of Python's" if strangers else "read"
    if not lines or re.search(r"\bNone\b", outcome.said) or named not in outcome.said:
        return "sentence"
    return "refused" if lines[0] not in strangers else "sentence"


def tried(kind: str, data: bytes, folder: Path) -> tuple[Outcome, str]:
    """Give bytes as a file of a kind to its command; return what came of it."""
    if kind in OUTPUTS:
        path = folder / "damaged" / OUTPUTS[kind][0]
        path.parent.mkdir(exist_ok=True)
        (folder / "study.toml").write_bytes(data if kind == "toml" else study(kind, path))
        path.write_bytes((folder / "good.csv").read_bytes() if kind == "toml" else data)
        named = "study" if kind == "toml" else path.name  # or the folder of the run
        outcome = called(["identify", "study.toml", "--check"], folder)
    else:
        named = f"damaged.{kind}"
        (folder / named).write_bytes(data)
        curves = ["compare", named, "good.csv", "--columns", "1", "2"]
        outcome = called(["report", named] if kind == "db" else curves, folder)
    return outcome, judged(outcome, named)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=2000, help="of all kinds together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--sentences", type=int, default=50)
    arguments = parser.parse_args()
    sentences, wrong = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.savetxt(folder / "good.csv", curve(), delimiter=",", header="strain,stress", comments="")
        (folder / "deck.inp").write_text("*ELASTIC\n<<E>>, <<b>>\n")
        files = seeds(arguments.only, folder)
        for kind in arguments.only:
            for whole in files[kind]:
                outcome, verdict = tried(kind, whole, folder)
                if verdict != "read":
                    raise RuntimeError(f"a whole file of {kind}: {verdict}, {outcome}")
            others = [file for other in KINDS if other != kind for file in files.get(other, ())]
            others.append(b"\x7fELF")
            found = Counter()
            for i in range(-(-arguments.times // len(arguments.only))):
                choices = random.Random(f"{arguments.seed} {kind} {i}")
                how, data = damaged(choices.choice(files[kind]), others, choices)
                if kind == "xlsx" and i % 2:
                    how, data = repacked(choices.choice(files[kind]), choices)
                outcome, verdict = tried(kind, data, folder)
                found[verdict] += 1
                if verdict not in ("read", "refused"):
                    wrong += 1
                    said = " | ".join(map(str.strip, outcome.said.splitlines()[-3:]))
                    print(f"    {kind} {i}, {how}: {verdict}, status {outcome.status}: {said}")
                elif outcome.said:
                    sentences.append(f"{kind:<6} {how:<7} {outcome.said.strip()}")
            counts = ", ".join(f"{count} {verdict}" for verdict, count in sorted(found.items()))
            print(f"{kind}: {counts}", flush=True)
    drawn = random.Random(arguments.seed).sample(
        sentences, min(arguments.sentences, len(sentences))
    )
    print(*drawn, sep="\n")
    print(f"{wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
