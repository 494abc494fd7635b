"""How many cells a second the kernels' inner loops admit by level: computed, and one measured.

    python benchmarks/speed/kernel_limits.py build/dev [--dim 1]

compiles the kernels as that build does, but to assembly, takes the loops that a cell goes through
(its ground distance, what is made of that, the least over the steps), and asks llvm-mca (apt
install llvm) for the cycles of an iteration, with every load from the first cache. What a diagonal
takes besides its loops is not in it. The last column is measured: 1,000 x 1,000 points at this
machine's own level and clock, by CPU time, the least of 50. A minute.
"""

import argparse
import json
import re
import shlex
import subprocess
import time
from pathlib import Path
from typing import Any

import numpy as np

import curvewise
from curvewise._core import step_patterns

GIGAHERTZ, POINTS = 3.0, 1000
PROCESSORS = (("v3", 4, "znver3"), ("v4", 8, "icelake-server"))
Loop = tuple[str, str]  # a pattern of the function, and an instruction of the loop in it


def variants(dim: int) -> dict[str, tuple[list[Loop], str, dict[str, Any]]]:
    """Return of each its loops, its function, and the options that it is called with."""
    plane = "fill_pairs_with<(Mixed|EuclideanCost<2, FastRoot)"
    root = {1: "fill_pairs_with<AbsoluteCost", 2: plane}[dim]
    sweep = {1: "advance<{}, AbsoluteCost", 2: "advance_in_plane<{}, KeepNothing"}[dim]
    square = f"SquaredCost<{dim}>"
    patterns = list(step_patterns())
    compiled = [*patterns, "adtw", "", "erp", "edr", "lcss", "msm", "twe"]  # in their order

    def swept(shape: str, fill: str = root) -> list[Loop]:
        steps = f"CompiledSteps<{compiled.index(shape)}>"  # theirs, or the advance it is inlined in
        return [(fill, "vsubpd"), (steps, "vaddpd")]

    made: dict[str, tuple[list[Loop], str, dict[str, Any]]] = {
        "frechet": ([(f"<DiscreteFrechet, {square}", "vminpd")], "frechet", {"prune": False}),
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
    bodies = re.split(r"\n(?=\S.*\):\n)", text)
    return [(" " + body.partition("\n")[0], at[2]) for body in bodies for at in loop.finditer(body)]


def cycles(processor: str, instructions: str) -> float:
    answer = run("llvm-mca", f"-mcpu={processor}", "-iterations=1000", given=instructions)
    vectors = 4 if "vpsrlq" in instructions else 1  # the start of one root of four is a shift
    return float(answer.partition("Total Cycles:")[2].split()[0]) / 1000 / vectors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("build", type=Path, help="a folder with compile_commands.json")
    parser.add_argument("--dim", type=int, choices=(1, 2), default=2)
    arguments = parser.parse_args()
    kernels = {level: innermost_loops(arguments.build, level) for level, *_ in PROCESSORS}
    P, Q = np.random.default_rng(0).normal(size=(2, POINTS, arguments.dim)).cumsum(axis=1)
    print("Gcells/s     ", *(f"{level} {name:<15}" for level, _, name in PROCESSORS), "measured")
    for name, (loops, function, options) in variants(arguments.dim).items():
        print(f"{name:<13}", end=" ")
        for level, lanes, processor in PROCESSORS:
            spent = 0.0
            for of, sign in loops:  # of loops that differ in what they keep, the one of values
                found = [
                    text
                    for header, text in kernels[level]
                    if re.search(of, header) and sign in text
                ]
                spent += min(cycles(processor, text) for text in found)
            print(f"{GIGAHERTZ * lanes / spent:<18.2f}", end=" ")
        took = []
        for _ in range(50):
            start = time.process_time()
            getattr(curvewise, function)(P, Q, **options)
            took.append(time.process_time() - start)
        print(f"{POINTS**2 / min(took) / 1e9:.2f}", flush=True)
