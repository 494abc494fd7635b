"""How many cells a second the kernels' inner loops admit by level: computed, and one measured.

    python benchmarks/speed/kernel_limits.py build/dev [--dim 1] [--gigahertz 3]

compiles the kernels as that build does, but to assembly, takes the loops that a cell goes through
(its ground distance, what is made of that, the least over the steps), and asks llvm-mca (of LLVM 17
or newer: apt install llvm-19) for the cycles of an iteration, with every load from the first cache.
Of a sweep in registers the loop is a diagonal, its way round the shortest one: what is done only
while rows begin or end is not in it. What a diagonal of another sweep takes besides its loops is
not in it either. The last column is measured: 1,000 x 1,000 points at this machine's own level and
clock, by CPU time, the least of 50. A minute.
"""

import argparse
import heapq
import json
import re
import shlex
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

import numpy as np

import curvewise
from curvewise._core import step_patterns

POINTS, RESIDENT_ROWS = 1000, 32
PROCESSORS = (("v3", 4, "znver4"), ("v4", 8, "znver4"), ("v4", 8, "skylake-avx512"))
MCA = shutil.which("llvm-mca-19") or "llvm-mca"
Loop = tuple[str, str]  # a pattern of the function, and an instruction of the loop in it


def variants(dim: int) -> dict[str, tuple[list[Loop], str, dict[str, Any]]]:
    """Return of each its loops, its function, and the options that it is called with."""
    plane = "fill_pairs_with<(Mixed|EuclideanCost<2, FastRoot)"
    root = {1: "fill_pairs_with<AbsoluteCost", 2: plane}[dim]
    sweep = {
        1: "advance_resident<{}, ResidentAbsolutes",
        2: "(advance_resident<{0}, ResidentRoots, 2|advance_in_plane<{0}, KeepNothing)",
    }[dim]
    square = f"SquaredCost<{dim}>"
    patterns = list(step_patterns())
    compiled = [*patterns, "adtw", "", "erp", "edr", "lcss", "msm", "twe"]  # in their order

    def swept(shape: str, fill: str = root) -> list[Loop]:
        steps = f"CompiledSteps<{compiled.index(shape)}>"  # theirs, or the advance it is inlined in
        return [(fill, "vsubpd"), (steps, "vaddpd")]

    made: dict[str, tuple[list[Loop], str, dict[str, Any]]] = {
        "frechet": (
            [(f"advance_resident<DiscreteFrechet, ResidentSquares, {dim}", "vminpd")],
            "frechet",
            {"prune": False},
        ),
        "adtw": (swept("adtw"), "dtw", {"penalty": 0.5}),
        "erp": (swept("erp"), "erp", {}),
        "edr": ([*swept("edr"), (r" fill_pairs\(", "vcmppd")], "edr", {}),
        "lcss": ([*swept("lcss"), (r" fill_pairs\(", "vcmppd")], "lcss", {}),
        "wdtw": (
            [*swept("symmetric1", f"fill_pairs_with<{square}"), (r" fill_pairs\(", "vmulpd")],
            "wdtw",
            {},
        ),
        "twe": (swept("twe"), "twe", {}),
        "msm": (
            [*swept("msm", "fill_pairs_with<AbsoluteCost"), (r" fill_moves\(", "vminpd")] * dim,
            "msm",
            {},
        ),
    }
    for name in patterns:
        of = {"symmetric1": "DtwSymmetric1", "symmetric2": "DtwSymmetric2"}.get(name)
        loops = [(sweep.format(of), "vminpd")] if of else swept(name)
        made[name] = (loops, "dtw", {"step_pattern": name, "prune": False})
    return made


def run(*command: str, given: str | None = None) -> str:
    return subprocess.run(command, input=given, check=True, capture_output=True, text=True).stdout


def innermost_loops(build: Path, level: str) -> list[tuple[str, str]]:
    """Return the loops of a level's kernels that have no label within, each with its function."""
    text = ""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if f"-DCURVEWISE_LEVEL={level} " in entry["command"]:
            command = shlex.split(entry["command"])
            without_lines = ("-g0", "-S", "-o", "-", entry["file"])
            text += run(*command[: command.index("-o")], *without_lines)
    text = re.sub(r"curvewise::kernels::|\(anonymous namespace\)::", "", run("c++filt", given=text))
    loop = re.compile(r"\n(\.L\d+):\n((?:\t[^.\n].*\n)+?)\tj\w+\t\1\n")
    loops = []
    for function in re.split(r"\n(?=\S.*\):\n)", text):
        header = " " + function.partition("\n")[0]
        if "advance_resident<" in header:
            loops += [(header, around) for around in shortest_rounds(function)]
        else:
            loops += [(header, at[2]) for at in loop.finditer(function)]
    return loops


def shortest_rounds(function: str) -> list[str]:
    """Return, of each place where most minima are taken, the fewest instructions back to it."""
    blocks: list[tuple[str, list[str]]] = [("", [])]
    for line in function.splitlines():
        if label := re.match(r"(\.L\d+):", line):
            blocks.append((label[1], []))
        elif re.match(r"\t[^.\s]", line):
            blocks[-1][1].append(line)
            if line.startswith("\tj"):
                blocks.append(("", []))
    places = {label: place for place, (label, _) in enumerate(blocks) if label}

    def followers(place: int) -> list[int]:
        last = (blocks[place][1] or [""])[-1].split()
        jumps = [places[last[1]]] if last and last[0][0] == "j" and last[1] in places else []
        return jumps if last and last[0] in ("jmp", "ret") else [*jumps, place + 1]

    def shortest(start: int) -> str:
        ways, known = [(0, [start])], set()
        while ways:
            length, way = heapq.heappop(ways)
            if len(way) > 1 and way[-1] == start:
                lines = [line for place in way[:-1] for line in blocks[place][1]]
                return "\n".join(line for line in lines if not line.startswith("\tj")) + "\n"
            for place in followers(way[-1]):
                if place < len(blocks) and place not in known:
                    known.add(place)
                    heapq.heappush(ways, (length + len(blocks[place][1]), [*way, place]))
        raise ValueError(f"no way round in {function[:80]}")

    minima = ["".join(lines).count("vminpd") for _, lines in blocks]
    return [shortest(place) for place, count in enumerate(minima) if count == max(minima)]


def cycles(processor: str, instructions: str) -> float:
    answer = run(MCA, f"-mcpu={processor}", "-iterations=1000", given=instructions)
    vectors = 4 if "vpsrlq" in instructions else 1  # the start of one root of four is a shift
    return float(answer.partition("Total Cycles:")[2].split()[0]) / 1000 / vectors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("build", type=Path, help="a folder with compile_commands.json")
    parser.add_argument("--dim", type=int, choices=(1, 2), default=2)
    parser.add_argument("--gigahertz", type=float, default=3.0)
    arguments = parser.parse_args()
    kernels = {level: innermost_loops(arguments.build, level) for level in ("v3", "v4")}
    P, Q = np.random.default_rng(0).normal(size=(2, POINTS, arguments.dim)).cumsum(axis=1)
    print("Gcells/s     ", *(f"{level} {name:<15}" for level, _, name in PROCESSORS), "measured")
    for name, (loops, function, options) in variants(arguments.dim).items():
        print(f"{name:<13}", end=" ")
        for level, lanes, processor in PROCESSORS:
            spent = 0.0
            for of, sign in loops:  # of loops that differ in what they keep, the one of values
                found = [
                    cycles(processor, text)
                    / (RESIDENT_ROWS // lanes if "advance_resident<" in header else 1)
                    for header, text in kernels[level]
                    if re.search(of, header) and sign in text
                ]
                spent += min(found)
            print(f"{arguments.gigahertz * lanes / spent:<18.2f}", end=" ")
        took = []
        for _ in range(50):
            start = time.process_time()
            getattr(curvewise, function)(P, Q, **options)
            took.append(time.process_time() - start)
        print(f"{POINTS**2 / min(took) / 1e9:.2f}", flush=True)
