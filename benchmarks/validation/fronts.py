"""Which parameters are good for two measures? The fronts of area and Fréchet on measured loops.

Chaboche's back stresses with Voce's hardening on two tension-compression tests; `identify_each`
searches by both measures, and `front` looks at its runs.

    pip install ".[calibration,plot]"
    python benchmarks/validation/fronts.py

Prints the fronts and draws front_<loop>.webp. Ten seconds.
"""

from __future__ import annotations

import argparse
import logging
import warnings
from pathlib import Path

import numpy as np
from places import BUILD, LOOPS, RESULTS
from stored import save_picture
from wrong_models import BOUNDS

import curvewise
from curvewise.calibration import SimulationStore, WideBoundsWarning, front, identify_each
from curvewise.curves import resample
from curvewise.materials import ChabocheVoce


def main() -> None:
    """Search, print, draw."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--loops", nargs="+", default=["dp780_tct_3pct", "tr1180_tct_3pct"])
    parser.add_argument("--points", type=int, default=150)
    parser.add_argument("--output", type=Path, metavar="DIR", default=RESULTS)
    options = parser.parse_args()
    logging.getLogger("curvewise.calibration").setLevel(logging.ERROR)
    warnings.simplefilter("ignore", WideBoundsWarning)
    options.output.mkdir(exist_ok=True)
    BUILD.mkdir(exist_ok=True)
    for name in options.loops:
        loop = curvewise.read_curve(LOOPS / f"{name}.csv")[:, :2]
        test = np.asarray(resample(loop, options.points))
        model = ChabocheVoce(backstresses=2).driven_by(test)
        store = SimulationStore(BUILD / f"front_{name}.db", version="1")
        measures = ["area", "frechet"]
        identify_each(model, test, BOUNDS, measures=measures, store=store, progress=False)
        found = front(store, test, measures)
        print(f"{name}\n\n{found}\n", flush=True)
        save_picture(found.plot(), options.output / f"front_{name}.webp", dpi=90)


if __name__ == "__main__":
    main()
