"""How many instructions each public call takes, beside what it took when the table was written.

    python benchmarks/speed/counts/counts.py                     compares, and fails
    python benchmarks/speed/counts/counts.py --write             writes what changed
    python benchmarks/speed/counts/counts.py --write --because "..."    where something rose

More than 1 % is a change. An interpreter's caches go by the addresses of objects, so that a call
from Python takes up to 2.5 % more where they lie badly, as they may in another folder. Its row has
the least of several heaps; where it rose by more than 2 % it is counted in others, too, and what it
fell by less than 4 % is not a change.
A timing does not show one per cent; valgrind's count of instructions does, and is the same whenever
it is taken. It is the same on another machine, too, if compiler, C library and valgrind are (which
shows every program the same processor, without AVX-512), and for calls from Python the interpreter,
numpy and pybind11. Elsewhere nothing is compared, which is said. The programs are `calls.cpp`,
linked to the library of the installed package, and `calls.py`; the table is `counts.json`, with the
most bytes that a call of C++ has of the heap at once. A fall wants to be written down as well: what
is not in the table can be lost again. Cost: half a minute; needs valgrind.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, TypeAlias

import calls

from curvewise._core import build_info

Row: TypeAlias = dict[str, Any]
Changes: TypeAlias = dict[str, dict[str, float]]

HERE = Path(__file__).resolve().parent
TABLE = HERE / "counts.json"
FALL_AND_RISE = {"C++": (0.01, 0.01), "Python": (0.04, 0.02)}
LEVELS = ("baseline", "v3")
# In an interpreter, what the heap looks like depends on the environment, and what malloc does on
# that, by 500 instructions a call. What it keeps for each thread is taken at once.
ONE_WAY_TO_ALLOCATE = "glibc.malloc.tcache_max=1048576:glibc.malloc.tcache_count=65535"
# How many objects a heap has before all others, and what makes them.
HEAPS = (0, 200, 333, 1000, 5000)
WITH_OBJECTS = """
import runpy, sys
kept = [bytearray(1 + 37 * i % 480) for i in range(int(sys.argv.pop(1)))]
runpy.run_path(sys.argv.pop(1), run_name="__main__")
"""
INSTALLED = Path(sys.modules["curvewise"].__file__ or "").parent


def surroundings() -> dict[str, dict[str, str]]:
    """Return what the counts of each program depend on besides this repository."""
    system = {
        "machine": platform.machine(),
        "libc": " ".join(platform.libc_ver()),
        "compiler": build_info()["compiler"],
        "valgrind": run("valgrind", "--version").strip(),
        "levels": " ".join(counted_levels()),
    }
    interpreter = {
        "python": sys.version,
        "numpy": importlib.metadata.version("numpy"),
        "pybind11": build_info()["pybind11"],
    }
    return {"C++": system, "Python": system | interpreter}


def counted_levels() -> list[str]:
    """Return the levels of this machine that valgrind knows."""
    return [level for level in LEVELS if level in build_info()["instruction_sets"]]


def run(*command: str | Path, **more: Any) -> str:
    """Return what a program prints, or end with what it says where it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, **more)
    if done.returncode:
        sys.exit(f"{command[0]} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def count(folder: Path, level: str, *program: str | Path) -> tuple[dict[str, int], str]:
    """Return the instructions of every call of a program by name, and what it printed."""
    counted = folder / f"counted-{Path(program[-1]).stem}-{level}"
    is_python = program[0] == sys.executable
    printed = run(
        "valgrind",
        "--tool=callgrind",
        f"--instr-atstart={'no' if is_python else 'yes'}",  # until the first mark: the imports
        "--combine-dumps=yes",
        "--dump-line=no",
        f"--callgrind-out-file={counted}",
        *program,
        env=os.environ
        | {"CURVEWISE_ISA": level, "PYTHONHASHSEED": "0"}
        | ({"GLIBC_TUNABLES": ONE_WAY_TO_ALLOCATE} if is_python else {}),
    )
    found: dict[str, int] = {}
    name = ""
    for line in counted.read_text(encoding="utf-8").splitlines():
        if line.startswith("desc: Trigger: Client Request: "):
            name = line.rsplit(": ", 1)[1]
        elif line.startswith("totals: ") and name:
            found[name], name = int(line.split()[1]), ""
    return found, printed


def built(*command: str | Path) -> Path:
    """Return what the compiler makes: the last of its arguments."""
    run(shutil.which("c++") or "c++", *command)
    return Path(command[-1])


def count_cpp(folder: Path) -> dict[str, Row]:
    """Return the instructions of the calls of C++ at every level, and their bytes."""
    sources = (HERE / "calls.cpp", INSTALLED / "lib" / "libcurvewise.a")
    options = ("-std=c++17", "-O2", f"-I{INSTALLED / 'include'}", "-pthread")
    program = built(*options, *sources, "-o", folder / "calls")
    rows: dict[str, Row] = {}
    for level in counted_levels():
        found, printed = count(folder, level, program)
        for name, instructions in found.items():
            rows.setdefault(name, {})[level] = instructions
        for line in printed.splitlines():
            name, most_bytes = line.rsplit(",", 1)
            rows[name]["bytes"] = int(most_bytes)
    return rows


def count_python(folder: Path, old: dict[str, Row] | None) -> dict[str, Row]:
    """Return the least instructions of the calls from Python, of so many heaps as it takes.

    With a table these are as many as it takes until no call rises above it; without, all.
    """
    level = counted_levels()[-1]
    marks = built("-O2", "-shared", "-fPIC", HERE / "marks.cpp", "-o", folder / "marks.so")
    program = (sys.executable, "-c", WITH_OBJECTS)
    rows: dict[str, Row] = {}
    for objects in HEAPS:
        found, _ = count(folder, level, *program, str(objects), HERE / "calls.py", marks)
        nothing = found.pop(calls.NOTHING)
        for name, instructions in found.items():
            each = round((instructions - nothing) / calls.REPEATS)
            rows[name] = {level: min(each, rows.get(name, {}).get(level, each))}
        if old is not None and not any(
            rose(changes("Python", old[name], row)) for name, row in rows.items() if name in old
        ):
            break
    return rows


def changes(part: str, old: Row, new: Row, *, writes: bool = False) -> dict[str, float]:
    """Return by what ratio what was counted differs, where that is more than is allowed.

    Where a table is written, every fall is one.
    """
    fall, rise = FALL_AND_RISE[part]
    fall = 0.0 if writes else fall
    ratios = {
        key: new.get(key, 0) / old[key] if old.get(key) else float(bool(new.get(key))) + 1.0
        for key in (*LEVELS, "bytes")
        if key in old or key in new
    }
    return {key: ratio for key, ratio in ratios.items() if not 1 - fall <= ratio <= 1 + rise}


def rose(changed: dict[str, float]) -> bool:
    """Return whether something of a call rose."""
    return any(ratio > 1.0 for ratio in changed.values())


def compared(part: str, old: dict[str, Row], new: dict[str, Row], *, writes: bool) -> Changes:
    """Print every call that differs, and return by what ratios."""
    different = {}
    for name in {**old, **new}:
        changed = changes(part, old.get(name, {}), new.get(name, {}), writes=writes)
        for key, ratio in changed.items():
            before, after = old.get(name, {}).get(key, 0), new.get(name, {}).get(key, 0)
            print(f"{part:7}{name:40}{key:9}{before:>12} -> {after:<12}{ratio:.3f}")
        if changed:
            different[name] = changed
    return different


def write(table: dict[str, Any]) -> None:
    """Write the table, a row a line."""
    lines = ["{", f' "made with": {json.dumps(table["made with"], indent=2)},']
    for part in ("C++", "Python"):
        rows = [f"  {json.dumps(name)}: {json.dumps(row)}" for name, row in table[part].items()]
        lines += [f' "{part}": {{', ",\n".join(rows), " }," if part == "C++" else " }"]
    TABLE.write_text("\n".join([*lines, "}", ""]), encoding="utf-8")


def main() -> int:
    """Count, compare, and write where that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write what changed to the table")
    parser.add_argument("--because", default="", help="why something rose")
    arguments = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("counts.py needs valgrind: apt install valgrind")
    here = surroundings()
    empty: dict[str, Any] = {"made with": here, "C++": {}, "Python": {}}
    table = json.loads(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else empty
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        known = None if arguments.write else table["Python"]
        new = {"C++": count_cpp(folder), "Python": count_python(folder, known)}
    failed = False
    for part, rows in new.items():
        others = {key: table["made with"][part].get(key) for key in here[part]}
        differing = [key for key in here[part] if here[part][key] != others[key]]
        if differing and not arguments.write:
            said = "; ".join(
                f"{key} {others[key]!r}, here {here[part][key]!r}" for key in differing
            )
            print(f"NOT COMPARED, {part}: the table was made with {said}")
            continue
        different = compared(part, table[part], rows, writes=arguments.write)
        if not arguments.write:
            failed |= bool(different)
            continue
        risen = {
            name for name, changed in different.items() if name in table[part] and rose(changed)
        }
        if risen and not arguments.because:
            sys.exit("something rose: say why, with --because")
        for name, changed in different.items():
            if name in rows:
                counted = {key: rows[name][key] for key in changed if key in rows[name]}
                reason = {"because": arguments.because} if name in risen else {}
                table[part][name] = table[part].get(name, {}) | counted | reason
        table[part] = {name: table[part][name] for name in rows}
        table["made with"][part] = here[part]
    if arguments.write:
        write(table)
    elif failed:
        print(
            "\nThese differ from counts.json by more than is allowed. If on purpose:"
            "\n    python benchmarks/speed/counts/counts.py --write --because '...'"
        )
    else:
        print("counts: as in the table, where they were compared")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
