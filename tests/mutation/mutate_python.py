"""Mutants of the Python package, a sample of all that cosmic-ray would make, and what catches them.

    pip install cosmic-ray
    python tests/mutation/mutate_python.py --count 60 --seed 1

Each is made in a copy of the installed package in build/mutants, so nothing here is touched; the
tests of its module then run in a process that was forked after the imports that take long, and end
at their first failure. Operators for `|`, which stands in annotations here, are left out. What
survives is a list to be read, not a mark: some mutants change nothing. Ends with 0 whatever
survives.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import importlib
import io
import os
import random
import shutil
import signal
import sys
import time
import warnings
from pathlib import Path

import cosmic_ray.plugins
from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code

ROOT = Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutants" / "python"
MEASURES = "tests/python/measures"
CALIBRATION = "tests/python/calibration"
# The tests of each module, the fastest first.
TESTS: dict[str, tuple[str, ...]] = {
    "reference/ground_distance.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_errors.py"),
    "reference/dtw.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_errors.py"),
    "reference/frechet.py": (f"{MEASURES}/test_reference.py",),
    "reference/frechet_continuous.py": (
        f"{MEASURES}/test_reference.py",
        f"{MEASURES}/test_frechet_continuous.py",
    ),
    "reference/area.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_planar.py"),
    "reference/refinement.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_planar.py"),
    "reference/pcm.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_planar.py"),
    "reference/curve_length.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_planar.py"),
    "reference/arc_length.py": (f"{MEASURES}/test_reference.py", f"{MEASURES}/test_planar.py"),
    "reference/matching.py": (f"{MEASURES}/test_matched_area.py",),
    "reference/scaling.py": (
        f"{MEASURES}/test_reference.py",
        f"{MEASURES}/test_extreme_scales.py",
    ),
    "reference/nearest.py": (
        "tests/python/nearest/test_subsequence.py",
        "tests/python/nearest/test_averages.py",
    ),
    "reference/checks.py": (f"{MEASURES}/test_errors.py",),
    "_curves.py": (f"{MEASURES}/test_errors.py", f"{MEASURES}/test_inputs.py"),
    "pairwise.py": (
        "tests/python/pairwise/test_pairwise_errors.py",
        "tests/python/pairwise/test_pairwise.py",
    ),
    "calibration/parameters.py": (f"{CALIBRATION}/test_identify.py",),
    "calibration/objective.py": (f"{CALIBRATION}/test_objective.py",),
    "calibration/uncertainty.py": (f"{CALIBRATION}/test_uncertainty.py",),
    "calibration/history.py": (f"{CALIBRATION}/test_history.py",),
    "calibration/store.py": (f"{CALIBRATION}/test_store.py",),
    "calibration/trust_region.py": (f"{CALIBRATION}/test_methods.py",),
}
STRESS = "tests/python/package/test_stress.py"  # last, for the reference


def copy_package() -> None:
    """Copy the sources, and the compiled module of the installed package."""
    import curvewise

    shutil.rmtree(COPY, ignore_errors=True)
    shutil.copytree(ROOT / "python" / "curvewise", COPY / "curvewise")
    for module in Path(curvewise.__file__).parent.glob("_core*"):
        shutil.copyfile(module, COPY / "curvewise" / module.name)
    for name in [name for name in sys.modules if name.startswith("curvewise")]:
        del sys.modules[name]
    sys.path.insert(0, str(COPY))


def all_mutants() -> list[tuple[str, str, int]]:
    """Return module, operator and occurrence of every mutant there is."""
    mutants = []
    for module in TESTS:
        tree = get_ast((COPY / "curvewise" / module).read_text("utf-8"))
        nodes = list(ast_nodes(tree))
        for name in cosmic_ray.plugins.operator_names():
            kind = cosmic_ray.plugins.get_operator(name)
            if kind.arguments() or "BitOr" in name:
                continue
            positions = sum(len(list(kind().mutation_positions(node))) for node in nodes)
            mutants += [(module, name, occurrence) for occurrence in range(positions)]
    return mutants


def run_tests(module: str, limit: float) -> str:
    """Run a module's tests in a fork of this process; say how it ended."""
    tests = [*TESTS[module], *([STRESS] if module.startswith("reference") else [])]
    pid = os.fork()
    if pid == 0:
        os.setpgid(0, 0)
        import pytest

        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            status = pytest.main(["-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests])
        os._exit(int(status))
    end = time.monotonic() + limit
    while time.monotonic() < end:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return "SURVIVED" if status == 0 else "caught"
        time.sleep(0.05)
    os.killpg(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return "caught (never ends)"


def main() -> None:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="modules whose names hold this")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a mutant")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    os.chdir(ROOT)
    copy_package()
    mutants = [mutant for mutant in all_mutants() if args.only in mutant[0]]
    random.Random(args.seed).shuffle(mutants)
    print(f"{args.count} of {len(mutants)} mutants", flush=True)
    for slow in ("hypothesis", "pandas", "pytest", "scipy.optimize"):
        importlib.import_module(slow)  # once, before the forks
    caught = 0
    for module, name, occurrence in mutants[: args.count]:
        path = COPY / "curvewise" / module
        text = path.read_text("utf-8")
        operator = cosmic_ray.plugins.get_operator(name)()
        mutated = mutate_code(text, operator, occurrence)
        path.write_text(mutated, "utf-8")
        said = run_tests(module, args.limit)
        path.write_text(text, "utf-8")
        caught += said.startswith("caught")
        changed = [
            line
            for line in difflib.unified_diff(text.splitlines(), mutated.splitlines(), n=0)
            if line[:1] in "+-" and line[:3] not in ("+++", "---")
        ]
        print(f"{said:10} {module} {name.partition('/')[2]}", *changed, sep="\n    ", flush=True)
    print(f"{caught} caught of {min(args.count, len(mutants))}")


if __name__ == "__main__":
    main()
