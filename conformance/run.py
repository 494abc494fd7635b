"""Point the cases at a function, or at the packages of some adapters, and say what comes back.

    python conformance/run.py mymodule:distance --measure frechet
    python conformance/run.py --adapter conformance/adapters/scipy.py
    python conformance/run.py --adapter conformance/adapters/*.py --json results.json

Each package runs in a process of its own (worker.py), which is begun anew after a crash or when a
call takes longer than the time limit. A number passes if it is within `--tolerance` of the exact
value, relative to it, or within one last bit; 0 has to be 0. What differs is made shorter, point by
point and coordinate by coordinate, as long as it differs from the value of exact.py. `--random 200`
asks for that many random pairs a check besides the cases.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import queue
import random
import subprocess
import sys
import threading
from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from exact import certify, nearest_double
from make import parameters, walk
from verify import CHECKS, ROOM, read_cases, verify

Case = dict[str, Any]
FIRST_CALL = 120.0  # seconds: compilers of numba
KINDS = ("usual", "edge", "known", "random", "extreme", "refused")
MOST_FAULTS = 3  # crashes or hangs of a check, after which it is left


class Process:
    """A package in a process that can end at any time."""

    def __init__(self, python: str, target: str, measure: str | None, limit: float):
        self.command = [python, str(ROOM / "worker.py"), target, *([measure] if measure else [])]
        self.limit = limit
        self.warm: set[str] = set()
        self.about = self.begin()

    def begin(self) -> dict[str, Any]:
        """Start the process and return what it says of the package."""
        self.process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            encoding="utf-8",
        )
        self.lines: queue.Queue[str | None] = queue.Queue()
        threading.Thread(target=self.listen, args=(self.process, self.lines), daemon=True).start()
        self.warm.clear()
        return self.hear(FIRST_CALL)

    @staticmethod
    def listen(process: subprocess.Popen[str], lines: queue.Queue[str | None]) -> None:
        """Hand on each line, and None at the end."""
        assert process.stdout
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    def hear(self, seconds: float) -> dict[str, Any]:
        """Return an answer, or what happened in its place."""
        try:
            line = self.lines.get(timeout=seconds)
        except queue.Empty:
            return {"hung": f"no answer within {seconds:g} s"}
        return json.loads(line) if line else {"crashed": f"exit code {self.process.wait()}"}

    def ask(self, case: Case) -> dict[str, str]:
        """Ask for a case's value."""
        question = {key: case[key] for key in ("check", "P", "Q", "parameters")}
        assert self.process.stdin
        with contextlib.suppress(OSError):  # it has ended, which hear() finds
            self.process.stdin.write(json.dumps(question) + "\n")
            self.process.stdin.flush()
        said = self.hear(self.limit if case["check"] in self.warm else FIRST_CALL)
        self.warm.add(case["check"])
        if "hung" in said or "crashed" in said:
            self.end()
            self.begin()
        return said

    def end(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout):
            if stream:
                with contextlib.suppress(OSError):
                    stream.close()


def outcome(case: Case, said: dict[str, str], tolerance: float) -> str:
    """Return what an answer is: pass, differs, raises, ..., or of what is to be refused."""
    (kind,) = said
    if kind != "number":
        return {"raised": "raises"}.get(kind, kind)
    number = float(said["number"])
    if case["kind"] == "refused":
        return "a number" if math.isfinite(number) else "nan" if math.isnan(number) else "inf"
    if not math.isfinite(number):
        return "differs"
    value = float.fromhex(case["value"]["hex"])
    allowed = max(Fraction(tolerance) * Fraction(value), Fraction(math.ulp(value)))
    away = abs(Fraction(number) - Fraction(value))
    return "pass" if away <= (allowed if value else 0) else "differs"


def random_cases(check: str, count: int, seed: int) -> Iterator[Case]:
    """Yield random lattice pairs with their exact values."""
    rng = random.Random(f"{check} {seed}")
    flat = CHECKS[check]["measure"] == "area"
    made = 0
    while made < count:
        dim = 2 if flat else rng.choice((1, 2, 2, 3))
        P, Q = (walk(rng, rng.randrange(2, 9), dim, 1.0) for _ in range(2))
        if check == "dtw-window":
            Q = walk(rng, len(P), dim, 1.0)
        for chosen in parameters(check, P, Q)[:1]:
            case = with_value({"check": check, "P": P, "Q": Q, "parameters": chosen})
            if case:
                made += 1
                yield {**case, "id": f"{check}/random-{seed}-{made}", "kind": "random"}


def with_value(case: Case) -> Case | None:
    """Return a case with its exact value, whose certificate was verified; None without a path."""
    found = certify(case["check"], case["P"], case["Q"], case["parameters"])
    if found is None:
        return None
    number = nearest_double(found[0])
    terms = [[str(k), str(q)] for k, q in found[0]]
    value = {"terms": terms, "double": repr(number), "hex": number.hex()}
    verify({"kind": "random", **case, "value": value, "certificate": found[1]})
    return {**case, "value": value}


def size(case: Case) -> tuple[float, ...]:
    """Return how long a counterexample is: points, coordinates, digits, and their sum."""
    numbers = [x for row in (*case["P"], *case["Q"]) for x in row]
    digits = sum(len(short(x)) for x in numbers)
    return (len(case["P"]) + len(case["Q"]), len(numbers), digits, sum(map(abs, numbers)))


def least_points(check: str) -> int:
    """Return how many points a curve of a counterexample has at least: edges need two."""
    return 2 if CHECKS[check]["measure"] in ("area", "frechet-continuous") else 1


def shrink(process: Process, case: Case, tolerance: float) -> tuple[Case, str]:
    """Make a case that differs shorter while it differs; return it with the package's number."""
    best, number = case, process.ask(case)["number"]
    least = least_points(case["check"])
    again = True
    while again:
        again = False
        for smaller in smaller_cases(best, least):
            valued = with_value(smaller)
            if valued is None or size(valued) >= size(best):
                continue
            said = process.ask(valued)
            if outcome(valued, said, tolerance) == "differs":
                best, number, again = valued, said["number"], True
                break
    return best, number


def smaller_cases(case: Case, least: int) -> Iterator[Case]:
    """Yield the case without a point, then with a coordinate nearer to zero."""
    bare = {"kind": "usual", **{k: case[k] for k in ("check", "P", "Q", "parameters")}}
    paired = case["check"] == "dtw-window"
    if paired and len(case["P"]) > 1:
        for i in range(len(case["P"])):
            for j in range(len(case["Q"])):
                P, Q = case["P"], case["Q"]
                yield {**bare, "P": P[:i] + P[i + 1 :], "Q": Q[:j] + Q[j + 1 :]}
    for name in "PQ":
        rows = case[name]
        for i in range(len(rows) if len(rows) > least and not paired else 0):
            yield {**bare, name: rows[:i] + rows[i + 1 :]}
    for name in "PQ":
        rows = case[name]
        for i, row in enumerate(rows):
            for k, x in enumerate(row):
                for y in {0.0, 1.0, float(int(x / 2))} - {x}:
                    changed = [*row[:k], y, *row[k + 1 :]]
                    yield {**bare, name: [*rows[:i], changed, *rows[i + 1 :]]}


def score(process: Process, cases: Iterable[Case], tolerance: float) -> dict[str, Any]:
    """Ask all cases of one check; count outcomes by kind, and keep the shortest that differs."""
    counts: dict[str, Counter[str]] = {}
    shortest: dict[str, Case] = {}
    raised: dict[str, str] = {}
    faults = 0

    def order(case: Case) -> tuple[float, ...]:
        shortest_curve = min(len(case["P"]), len(case["Q"]))
        return (shortest_curve < least_points(case["check"]), *size(case))

    for case in sorted(cases, key=lambda case: KINDS.index(case["kind"])):
        if faults == MOST_FAULTS:
            result, said = "not run", {"not run": ""}
        else:
            said = process.ask(case)
            result = outcome(case, said, tolerance)
        faults += result in ("hung", "crashed")
        kind = {"extreme": "extreme", "refused": "refused"}.get(case["kind"], "usual")
        counts.setdefault(kind, Counter())[result] += 1
        if result == "differs":
            shortest[kind] = min(shortest.get(kind, case), case, key=order)
        if result in ("raises", "hung", "crashed") and kind != "refused":
            raised.setdefault(f"{kind}: {next(iter(said.values()))}", case["id"])
    found: dict[str, Any] = {"counts": {kind: dict(count) for kind, count in counts.items()}}
    examples = {}
    for kind, case in shortest.items():
        small, number = case, process.ask(case).get("number", "nothing")
        if kind == "usual" and number != "nothing":
            small, number = shrink(process, case, tolerance)
        examples[kind] = {
            "from": case["id"],
            **{key: small[key] for key in ("P", "Q", "parameters")},
            "exact": small["value"]["double"],
            "found": number,
        }
    return {**found, "examples": examples, "raised": raised}


def run(arguments: argparse.Namespace, target: str) -> dict[str, Any]:
    """Score one package with the first Python that has it."""
    for python in arguments.python:
        process = Process(python, target, arguments.measure, arguments.time_limit)
        if "checks" in process.about:
            break
        process.end()
    else:
        return {"target": target, **process.about}
    cases: dict[str, list[Case]] = {}
    for case in read_cases():
        cases.setdefault(case["check"], []).append(case)
    results = {}
    for check in process.about["checks"]:
        extra = random_cases(check, arguments.random, arguments.seed)
        results[check] = score(process, [*cases[check], *extra], arguments.tolerance)
    process.end()
    return {"target": target, **process.about, "checks": results}


def table(result: dict[str, Any]) -> str:
    """Return a package's results as lines of text."""
    if "checks" not in result:
        return f"{result['target']}: {' '.join(f'{k}: {v}' for k, v in result.items())}"
    lines = [f"{result['package']} {result['version']} ({result['licence']})"]
    for check, found in result["checks"].items():
        for kind, counts in found["counts"].items():
            text = ", ".join(f"{name} {count}" for name, count in sorted(counts.items()))
            other = " (another definition)" if check in result["other"] else ""
            lines.append(f"  {check:22} {kind:8} {text}{other}")
        for example in found["examples"].values():
            lines.append(
                f"    shortest: {example['found']} for {example['exact']}; {shown(example)}"
            )
        for text, case in found["raised"].items():
            lines.append(f"    {text} ({case})")
    offered = set(result["checks"])
    missing = [check for check in CHECKS if check not in offered]
    lines.append(f"  not offered: {', '.join(missing) or 'nothing'}")
    return "\n".join(lines)


def shown(example: dict[str, Any]) -> str:
    """Return the curves and parameters of a counterexample."""
    given = "".join(f", {name} {x:g}" for name, x in example["parameters"].items())
    return f"P = {plain(example['P'])}; Q = {plain(example['Q'])}{given}"


def plain(rows: list[list[float]]) -> str:
    """Return a curve as it is written by hand; of one dimension, its numbers."""
    points = [", ".join(short(x) for x in row) for row in rows]
    if all(len(row) == 1 for row in rows):
        return f"[{', '.join(points)}]"
    return ", ".join(f"({point})" for point in points)


def short(x: float) -> str:
    """Return a number without the end of a whole one."""
    return f"{x:g}" if float(f"{x:g}") == x else repr(x)


def main() -> None:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("function", nargs="?", help="module:function, with --measure")
    parser.add_argument("--measure", choices=list(CHECKS), help="the check it computes")
    parser.add_argument("--adapter", nargs="+", type=Path, default=[], metavar="FILE")
    parser.add_argument("--python", nargs="+", default=[sys.executable], help="tried in turn")
    parser.add_argument("--tolerance", type=float, default=1e-9)
    parser.add_argument("--time-limit", type=float, default=10.0, metavar="SECONDS")
    parser.add_argument("--random", type=int, default=0, metavar="PAIRS")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path, help="write the results here, for report.py")
    arguments = parser.parse_args()
    if bool(arguments.function) != bool(arguments.measure):
        parser.error("module:function and --measure belong together")
    if bool(arguments.function) == bool(arguments.adapter):
        parser.error("give module:function with --measure, or --adapter")
    results = []
    for target in [arguments.function] if arguments.function else map(str, arguments.adapter):
        results.append(run(arguments, target))
        print(table(results[-1]), flush=True)
    if arguments.json:
        text = json.dumps(results, indent=1)
        arguments.json.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
