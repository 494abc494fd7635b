"""Mutants of the Python package, a sample of all that cosmic-ray would make, and the tests that
catch them.

    pip install cosmic-ray
    python tests/mutation/mutate_python.py --count 60 --seed 1

Each mutant is made in a copy of the installed package in build/mutants, so nothing here is changed.
The tests of its module then run in a process that was forked after the slow imports, and stop at
their first failure. Before the first mutant of a module, its tests must pass. If they take far
longer with a mutant, they have caught it, too. Operators for `|`, which is used in annotations
here, are skipped, and so are mutants that are not valid Python. The survivors are a list to read,
not a mark: some mutants change nothing. The exit status is always 0.
"""

from __future__ import annotations

import argparse
import compileall
import contextlib
import difflib
import importlib
import io
import os
import py_compile
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
# What holds the reference to what does not come from it.
WARPING = (f"{MEASURES}/test_reference_warping.py", f"{MEASURES}/test_reference.py")
PLANAR = (f"{MEASURES}/test_reference_planar.py", f"{MEASURES}/test_reference.py")
# The tests of each module, the fastest first.
TESTS: dict[str, tuple[str, ...]] = {
    "curves/ground_distance.py": (*WARPING, f"{MEASURES}/test_errors.py"),
    "reference/dtw.py": (
        *WARPING,
        f"{MEASURES}/test_errors.py",
        f"{MEASURES}/test_dtw_conventions.py",
    ),
    "reference/frechet.py": WARPING,
    "reference/frechet_continuous.py": (
        f"{MEASURES}/test_reference.py",
        f"{MEASURES}/test_frechet_continuous.py",
    ),
    "reference/area.py": (*PLANAR, f"{MEASURES}/test_planar.py"),
    "reference/refinement.py": (*PLANAR, f"{MEASURES}/test_planar.py"),
    "reference/pcm.py": (*PLANAR, f"{MEASURES}/test_planar.py"),
    "reference/curve_length.py": (*PLANAR, f"{MEASURES}/test_planar.py"),
    "curves/arc_length.py": (*PLANAR, f"{MEASURES}/test_planar.py"),
    "reference/matched_curves.py": (
        f"{MEASURES}/test_matched_area.py",
        "tests/python/comparing/test_deviations.py",
    ),
    "curves/scaling.py": (
        f"{MEASURES}/test_reference.py",
        f"{MEASURES}/test_extreme_scales.py",
    ),
    "reference/nearest.py": (
        "tests/python/many/test_index.py",
        "tests/python/many/test_subsequence.py",
        "tests/python/many/test_averages.py",
    ),
    "reference/checks.py": (f"{MEASURES}/test_errors.py",),
    "curves/inputs.py": (
        f"{MEASURES}/test_errors.py",
        f"{MEASURES}/test_inputs.py",
        f"{MEASURES}/test_column_names.py",
        f"{MEASURES}/test_foreign_curves.py",
    ),
    "many/pairwise.py": (
        "tests/python/many/test_pairwise_errors.py",
        "tests/python/many/test_pairwise.py",
    ),
    "calibration/problem/space.py": (
        f"{CALIBRATION}/test_cases.py",
        f"{CALIBRATION}/test_identify.py",
    ),
    "calibration/objective/objective.py": (
        f"{CALIBRATION}/test_objective.py",
        f"{CALIBRATION}/test_cases.py",
        f"{CALIBRATION}/test_identify.py",
        f"{CALIBRATION}/test_uncertainty.py",
    ),
    "calibration/uncertainty/uncertainty.py": (
        f"{CALIBRATION}/test_uncertainty.py",
        f"{CALIBRATION}/test_cases.py",
    ),
    "calibration/records/store.py": (
        f"{CALIBRATION}/test_store.py",
        f"{CALIBRATION}/test_resuming.py",
    ),
    "calibration/methods/trust_region.py": (
        f"{CALIBRATION}/test_trust_region.py",
        f"{CALIBRATION}/test_methods.py",
    ),
}
STRESS = "tests/python/package/test_stress.py"  # last, for the reference


def copy_package() -> None:
    """Copy the sources, and the compiled module of the installed package."""
    import curvewise

    shutil.rmtree(COPY, ignore_errors=True)
    compiled = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "python" / "curvewise", COPY / "curvewise", ignore=compiled)
    for module in Path(curvewise.__file__).parent.glob("_core*"):
        shutil.copyfile(module, COPY / "curvewise" / module.name)
    for name in [name for name in sys.modules if name.startswith("curvewise")]:
        del sys.modules[name]
    sys.path.insert(0, str(COPY))
    # By their contents: by time and size alone, a mutant may be mistaken for its original.
    by_contents = py_compile.PycInvalidationMode.CHECKED_HASH
    compileall.compile_dir(COPY, quiet=1, invalidation_mode=by_contents)
    sys.dont_write_bytecode = True


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


def tests_of(module: str) -> list[str]:
    """Return the files of tests that a module's mutants must fail."""
    return [*TESTS[module], *([STRESS] if module.startswith("reference") else [])]


def pytest_status(tests: list[str], limit: float) -> int | None:
    """Run tests in a fork of this process; return pytest's status, or None after the time limit."""
    pid = os.fork()
    if pid == 0:
        os.setpgid(0, 0)
        import pytest

        # Hypothesis has been imported before pytest could rewrite its assertions.
        options = ["-W", "ignore::pytest.PytestAssertRewriteWarning", "-p", "no:cacheprovider"]
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            status = pytest.main(["-x", "-q", "-n", "0", *options, *tests])
        os._exit(int(status))
    end = time.monotonic() + limit
    while time.monotonic() < end:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)  # waitpid does not take a time limit
    os.killpg(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return None


def time_limit(module: str) -> float:
    """Run a module's tests without a mutant; return the time limit for each with one."""
    begun = time.monotonic()
    status = pytest_status(tests_of(module), 1200.0)
    if status != 0:
        sys.exit(f"without a mutant the tests of {module} fail: pytest's status is {status}")
    return 20.0 + 5.0 * (time.monotonic() - begun)


def verdict(module: str, limit: float) -> str:
    """Run the tests of a mutated module."""
    status = pytest_status(tests_of(module), limit)
    if status is None:
        return "caught (never ends)"
    # 2 is an error while tests are collected: the package cannot be imported.
    return {0: "SURVIVED", 1: "caught", 2: "caught"}.get(status, f"caught (status {status})")


def is_python(text: str) -> bool:
    """Tell whether a module can be compiled: a `*` of a signature is not a product."""
    try:
        compile(text, "mutant", "exec")
    except SyntaxError:
        return False
    return True


def changed_lines(text: str, mutated: str) -> list[str]:
    """Return the removed and the added text of a mutant."""
    lines = difflib.unified_diff(text.splitlines(), mutated.splitlines(), n=0)
    return [line for line in lines if line[:1] in "+-" and line[:3] not in ("+++", "---")]


def main() -> None:
    """Run as the module's documentation says."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--skip", type=int, default=0, help="the first of the sample, done before")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="modules whose names hold this")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    os.chdir(ROOT)
    copy_package()
    mutants = [mutant for mutant in all_mutants() if args.only in mutant[0]]
    random.Random(args.seed).shuffle(mutants)
    sample = mutants[args.skip : args.skip + args.count]
    print(f"{len(sample)} of {len(mutants)} mutants", flush=True)
    for slow in ("hypothesis", "pandas", "pytest", "scipy.optimize"):
        importlib.import_module(slow)  # once, before the forks
    limits: dict[str, float] = {}
    made = caught = 0
    for module, name, occurrence in sample:
        path = COPY / "curvewise" / module
        text = path.read_text("utf-8")
        mutated = mutate_code(text, cosmic_ray.plugins.get_operator(name)(), occurrence)
        if not is_python(mutated):
            continue
        if module not in limits:
            limits[module] = time_limit(module)
        made += 1
        path.write_text(mutated, "utf-8")
        begun = time.monotonic()
        said = verdict(module, limits[module])
        path.write_text(text, "utf-8")
        caught += said.startswith("caught")
        print(f"{said} after {time.monotonic() - begun:.0f} s: {module} {name.partition('/')[2]}")
        print(*changed_lines(text, mutated), sep="\n", flush=True)
    print(f"{caught} caught of {made}")


if __name__ == "__main__":
    main()
