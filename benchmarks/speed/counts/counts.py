"""How many instructions each public call takes, beside what it took when the table was written.

    python benchmarks/speed/counts/counts.py                     compares, and fails
    python benchmarks/speed/counts/counts.py --write             writes what changed
    python benchmarks/speed/counts/counts.py --write --because "..."    where something rose

More than 1 % is a change, of a call from Python 2 %, since an interpreter's caches go by the
addresses of its objects.
A timing does not show one per cent; valgrind's count of instructions does, and is the same whenever
it is taken. It is the same on another machine, too, if compiler, C library and valgrind are (which
shows every program the same processor, without AVX-512), and for calls from Python the interpreter,
numpy and pybind11. Elsewhere nothing is compared, which is said. The programs are `calls.cpp`,
linked to the library of the installed package, and `calls.py`, both with the heap of
`allocator.cpp`; the table is `counts.json`, with the most bytes that a call of C++ has of the heap
at once. A fall wants to be written down as well: what is not in the table can be lost again. Cost:
half a minute; needs valgrind.
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
Table: TypeAlias = dict[str, dict[str, Row]]

HERE = Path(__file__).resolve().parent
TABLE = HERE / "counts.json"
TOLERANCE = {"C++": 0.01, "Python": 0.02}
LEVELS = ("baseline", "v3")
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
        | {"LD_PRELOAD": str(folder / "allocator.so")},
    )
    found: dict[str, int] = {}
    name = ""
    for line in counted.read_text(encoding="utf-8").splitlines():
        if line.startswith("desc: Trigger: Client Request: "):
            name = line.rsplit(": ", 1)[1]
        elif line.startswith("totals: ") and name:
            found[name], name = int(line.split()[1]), ""
    return found, printed


def count_all() -> Table:
    """Return what is counted here, in the form of the table."""
    table: Table = {"C++": {}, "Python": {}}
    levels = counted_levels()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        compiler = (shutil.which("c++") or "c++", "-std=c++17", "-O2")
        for name in ("allocator", "marks"):
            shared = ("-shared", "-fPIC", "-fno-builtin")
            run(*compiler, *shared, HERE / f"{name}.cpp", "-o", folder / f"{name}.so")
        program, library = folder / "calls", INSTALLED / "lib" / "libcurvewise.a"
        include = f"-I{INSTALLED / 'include'}"
        run(*compiler, include, HERE / "calls.cpp", library, "-pthread", "-o", program)
        for level in levels:
            found, printed = count(folder, level, program)
            for name, instructions in found.items():
                table["C++"].setdefault(name, {})[level] = instructions
            for line in printed.splitlines():
                name, most_bytes = line.rsplit(",", 1)
                table["C++"][name]["bytes"] = int(most_bytes)
        found, _ = count(folder, levels[-1], sys.executable, HERE / "calls.py", folder / "marks.so")
        nothing = found.pop(calls.NOTHING)
        for name, instructions in found.items():
            table["Python"][name] = {levels[-1]: round((instructions - nothing) / calls.REPEATS)}
    return table


def changes(old: Row, new: Row, tolerance: float) -> dict[str, float]:
    """Return by what ratio what was counted differs, where that is more than the tolerance."""
    ratios = {
        key: new.get(key, 0) / old[key] if old.get(key) else float(bool(new.get(key))) + 1.0
        for key in (*LEVELS, "bytes")
        if key in old or key in new
    }
    return {key: ratio for key, ratio in ratios.items() if abs(ratio - 1.0) > tolerance}


def compared(part: str, old: dict[str, Row], new: dict[str, Row]) -> list[tuple[str, bool]]:
    """Print every call that differs; return their names, and whether something of them rose."""
    different = []
    for name in {**old, **new}:
        changed = changes(old.get(name, {}), new.get(name, {}), TOLERANCE[part])
        for key, ratio in changed.items():
            before, after = old.get(name, {}).get(key, 0), new.get(name, {}).get(key, 0)
            print(f"{part:7}{name:40}{key:9}{before:>12} -> {after:<12}{ratio:.3f}")
        if changed:
            rose = name in old and any(ratio > 1.0 for ratio in changed.values())
            different.append((name, rose))
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
    here, new = surroundings(), count_all()
    empty: dict[str, Any] = {"made with": here, "C++": {}, "Python": {}}
    table = json.loads(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else empty
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
        different = compared(part, table[part], rows)
        if not arguments.write:
            failed |= bool(different)
            continue
        if any(rose for _, rose in different) and not arguments.because:
            sys.exit("something rose: say why, with --because")
        kept = {name: row for name, row in table[part].items() if name in rows}
        for name, rose in different:
            reason = {"because": arguments.because} if rose else {}
            kept |= {name: rows[name] | reason} if name in rows else {}
        table[part] = {name: kept[name] for name in rows}
        table["made with"][part] = here[part]
    if arguments.write:
        write(table)
    elif failed:
        print(
            "\nThese differ from counts.json by more than 1 %, from Python 2 %. If on purpose:"
            "\n    python benchmarks/speed/counts/counts.py --write --because '...'"
        )
    else:
        print("counts: as in the table, where they were compared")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
