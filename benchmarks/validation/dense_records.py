"""Do intervals of `fit_material` cover the truth of dense records with noise in strain and stress?

Five branches between 1 and -1 % of strain in 200,000 rows, from a Chaboche material with two back
stresses. The noise is normal: 10 or 30 µm/m in strain and 3 MPa in stress. Reversals at the largest
noise would be wrong here. Prints for each parameter the share of the intervals of 95 % that hold
the truth, and the median error and half width in per cent of it.

    python benchmarks/validation/dense_records.py --seeds 10

A fit takes 2 to 6 s.
"""

from __future__ import annotations

import argparse
import logging
import warnings

import numpy as np

from curvewise.fitting import fit_material
from curvewise.materials import ChabocheVoce

ROWS, STRAINS, STRESS_NOISE = 200_000, (1e-5, 3e-5), 3.0
MATERIAL = ChabocheVoce(backstresses=2)
TRUTH = np.array((206e3, 310.0, 90.0, 12.0, 90e3, 600.0, 6e3, 40.0))


def record(seed: int, noise: float) -> np.ndarray:
    """Return strain and stress of a test."""
    random = np.random.default_rng(seed)
    strain = np.interp(np.linspace(0, 5, ROWS), range(6), (0.0, 0.01, -0.01, 0.01, -0.01, 0.01))
    stress = MATERIAL.stress(strain, dict(zip(MATERIAL.names, TRUTH, strict=True)))
    noises = random.normal(0.0, noise, ROWS), random.normal(0.0, STRESS_NOISE, ROWS)
    return np.column_stack((strain + noises[0], stress + noises[1]))


def main() -> None:
    """Fit and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=10)
    options = parser.parse_args()
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")
    print(f"| noise in strain | | {' | '.join(MATERIAL.names)} |")
    print(f"|---|---|{'---:|' * len(MATERIAL.names)}")
    for noise in STRAINS:
        fits = [
            fit_material(record(seed, noise), MATERIAL, progress=False)
            for seed in range(options.seeds)
        ]
        found = np.array([[fit.parameters[name] for name in MATERIAL.names] for fit in fits])
        ends = [[fit.uncertainty.intervals[name] for name in MATERIAL.names] for fit in fits]
        low, high = np.moveaxis(np.array(ends), 2, 0)
        held = 100.0 * ((low <= TRUTH) & (high >= TRUTH)).mean(axis=0)
        errors = 100.0 * np.median(np.abs(found - TRUTH), axis=0) / TRUTH
        widths = 50.0 * np.median(high - low, axis=0) / TRUTH
        for title, numbers in (("held, %", held), ("error, %", errors), ("half width, %", widths)):
            cells = " | ".join(f"{number:.3g}" for number in numbers)
            print(f"| {1e6 * noise:.0f} µm/m | {title} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
