"""What `curvewise fit` prints first, for six tests whose truth is known.

    python first_screens.py now.json                     # of the package that is installed
    python first_screens.py now.json --before then.json  # and results/first_screens.md

The page has both side by side; for `then.json` run this with the package of another commit. Half a
minute on one core.
"""

from __future__ import annotations

import argparse
import html
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from places import RESULTS

from curvewise.materials import ChabocheVoce

STEEL = ChabocheVoce(backstresses=2)
TRUTH = dict(zip(STEEL.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0, 6e3, 40.0), strict=True))


CLEAN = (0.0, 2.0)  # noise in strain, and in stress in MPa


class Case(NamedTuple):
    """A test, or several, and what the command is called with."""

    title: str
    tests: list[np.ndarray]
    options: tuple[str, ...] = ()


def tested(turns: list[float], rows: int, noise: tuple[float, float]) -> np.ndarray:
    """Return a test of the steel between turns, with noise in strain and in stress (MPa)."""
    random = np.random.default_rng(0)
    strain = np.interp(np.linspace(0.0, len(turns) - 1.0, rows), range(len(turns)), turns)
    stress = STEEL.stress(strain, TRUTH)
    scatter = [random.normal(0.0, one, rows) if one else np.zeros(rows) for one in noise]
    return np.column_stack((strain + scatter[0], stress + scatter[1]))


def loop(amplitude: float, cycles: int) -> list[float]:
    """Return the turns of so many cycles."""
    return [0.0, *[amplitude, -amplitude] * cycles, amplitude]


CASES = {
    "clean": Case("two cycles of ± 1 %", [tested(loop(0.01, 2), 601, CLEAN)]),
    "two_amplitudes": Case(
        "two tests, of ± 0.5 % and ± 1.5 %",
        [tested(loop(0.005, 4), 801, CLEAN), tested(loop(0.015, 4), 801, CLEAN)],
    ),
    "last_cycle": Case(
        "the last of 20 cycles of ± 1 %",
        [tested(loop(0.01, 20), 8001, CLEAN)],
        ("--cycles", "last"),
    ),
    "tension_only": Case("tension to 5 %, without a reversal", [tested([0.0, 0.05], 400, CLEAN)]),
    "wrong_units": Case(
        "the first test with strain in per cent, which its header does not say",
        [tested(loop(0.01, 2), 601, CLEAN) * (100.0, 1.0)],
    ),
    "dense_noise": Case(
        "100,000 rows with noise of 1e-5 in strain and 3 MPa in stress",
        [tested(loop(0.01, 2), 100_000, (1e-5, 3.0))],
    ),
}


def screen(name: str, case: Case) -> str:
    """Return what the command prints, standard error first."""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(f"{name}_{i}.csv" if i else f"{name}.csv") for i in range(len(case.tests))]
        for file, test in zip(files, case.tests, strict=True):
            numbers = (f"{strain:.8g},{stress:.8g}" for strain, stress in test)
            Path(folder, file).write_text("\n".join(["strain,stress", *numbers, ""]))
        command = ["fit", *map(str, files), *case.options]
        ran = subprocess.run(
            [sys.executable, "-m", "curvewise", *command],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
    return f"$ curvewise {' '.join(command)}\n{ran.stderr}{ran.stdout}".rstrip()


def side_by_side(before: dict[str, str], after: dict[str, str]) -> str:
    """Return the page."""
    parts = [
        "# First screens of `curvewise fit`",
        "Left: at commit 1799715. Right: now. Made by `first_screens.py`. The steel of all tests "
        f"has {', '.join(f'{name} {value:g}' for name, value in TRUTH.items())}; stresses are in "
        "MPa.",
    ]
    for name, case in CASES.items():
        cells = "".join(
            f"<td><pre>{html.escape(screens[name])}</pre></td>" for screens in (before, after)
        )
        parts.append(f"## {name.replace('_', ' ').capitalize()}")
        parts.append(f"The test: {case.title}.")
        parts.append(f"<table><tr><th>before</th><th>after</th></tr><tr>{cells}</tr></table>")
    return "\n\n".join(parts) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("file", type=Path, help="for the screens, as JSON")
    parser.add_argument("--before", type=Path, help="the screens of another commit, as JSON")
    arguments = parser.parse_args()
    screens = {name: screen(name, case) for name, case in CASES.items()}
    arguments.file.write_text(json.dumps(screens, indent=1, ensure_ascii=False))
    if arguments.before:
        before = json.loads(arguments.before.read_text())
        (RESULTS / "first_screens.md").write_text(side_by_side(before, screens), encoding="utf-8")


if __name__ == "__main__":
    main()
