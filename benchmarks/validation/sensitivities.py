"""Which parameters move a measured loop at all? Sensitivities at the optimum and over the bounds.

Chaboche's back stresses with Voce's hardening on a tension-compression test, by least squares.
Beside what the test determines stand two answers that have nothing to do with noise: how far the
loop moves as a parameter goes through its bounds, by its slope at the optimum (which every report
shows) and by elementary effects from places between the bounds (`screening`). Then the parameter
that moves the loop least and the one that moves it most are each held at a quarter and at three
quarters of its bounds, and all others are searched for anew: what does that cost?

    pip install ".[calibration,plot]"
    python benchmarks/validation/sensitivities.py

Prints both, and draws sensitivities_<loop>.webp. A few seconds.
"""

from __future__ import annotations

import argparse
import logging
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from places import LOOPS, RESULTS
from stored import save_picture
from wrong_models import BOUNDS

import curvewise
from curvewise.calibration import Identification, WideBoundsWarning, identify, screening
from curvewise.curves import resample
from curvewise.materials import ChabocheVoce


def searched(model: Callable[..., Any], test: np.ndarray, bounds: dict[str, Any]) -> Identification:
    """Return what least squares finds."""
    return identify(
        model, test, bounds, measure="sum_of_squares", abscissa="points", progress=False
    )


def main() -> None:
    """Search, print, draw."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--loops", nargs="+", default=["tr1180_tct_3pct", "dp780_tct_3pct"])
    parser.add_argument("--points", type=int, default=300)
    parser.add_argument("--paths", type=int, default=30)
    parser.add_argument("--output", type=Path, metavar="DIR", default=RESULTS)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    warnings.simplefilter("ignore", WideBoundsWarning)
    options.output.mkdir(exist_ok=True)
    for name in options.loops:
        loop = curvewise.read_curve(LOOPS / f"{name}.csv")[:, :2]
        test = np.asarray(resample(loop, options.points))
        model = ChabocheVoce(backstresses=2).driven_by(test)
        found = searched(model, test, BOUNDS)
        uncertainty = found.uncertainty()
        print(f"{name}: value {found.value:.5g}\n\n{uncertainty}\n")
        moves = dict(zip(BOUNDS, uncertainty.sensitivities[0].tolist(), strict=True))
        listed = (f"{key} {100.0 * move:.3g}" for key, move in moves.items())
        print("at the optimum, % of the box:", ", ".join(listed))
        effects = screening(found, paths=options.paths)
        print(f"\n{effects}\n", flush=True)
        for key in (min(moves, key=moves.__getitem__), max(moves, key=moves.__getitem__)):
            for part in (0.25, 0.75):
                low, high = BOUNDS[key]
                held = low + part * (high - low)
                value = searched(model, test, {**BOUNDS, key: held}).value
                rise = 100.0 * (value / found.value - 1.0)
                print(f"{key} held at {held:g}: the sum of squares is {rise:.3g} % higher")
        print()
        save_picture(effects.plot(), options.output / f"sensitivities_{name}.webp", dpi=90)


if __name__ == "__main__":
    main()
