"""Time matrix_profile next to stumpy, in alternating runs, and compare all neighbours.

    NUMBA_NUM_THREADS=1 python benchmarks/speed/matrix_profile.py [--points 8000] [--length 100]

The records are a random walk, noise, and noisy beats with one odd beat. stumpy excludes a quarter
of the length by default, and so does the script. For each record it prints the number of windows
whose neighbour differs, the largest relative difference of distances, and the median of the ratios
of times. dtw is timed without a peer, in the first 1,500 points.
"""

from __future__ import annotations

import argparse
import statistics
from time import perf_counter

import numpy as np
import stumpy

import curvewise


def records(points: int) -> dict[str, np.ndarray]:
    """Return the records by name."""
    random = np.random.default_rng(0)
    beats = np.sin(np.arange(points) * (2 * np.pi / 150)) ** 5 + 0.05 * random.normal(size=points)
    beats[points // 2 : points // 2 + 20] += 0.8
    noise = random.normal(size=points)
    return {"walk": random.normal(size=points).cumsum(), "noise": noise, "beats": beats}


def main() -> None:
    """Print a line for each record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=8000)
    parser.add_argument("--length", type=int, default=100)
    parser.add_argument("--times", type=int, default=5)
    given = parser.parse_args()
    length, zone = given.length, -(-given.length // 4)
    stumpy.stump(np.random.default_rng(1).normal(size=500), length)  # compiles
    for name, record in records(given.points).items():
        ratios = []
        for _ in range(given.times):
            begin = perf_counter()
            profile = curvewise.matrix_profile(record, length, exclusion=zone)
            middle = perf_counter()
            theirs = stumpy.stump(record, length)
            ratios.append((perf_counter() - middle) / (middle - begin))
        distances, indices = theirs[:, 0].astype(float), theirs[:, 1].astype(int)
        differ = np.count_nonzero(indices != profile.indices)
        error = np.max(np.abs(distances - profile.distances) / profile.distances)
        begin = perf_counter()
        warped = curvewise.matrix_profile(record[:1500], length, exclusion=zone, window=5)
        seconds = perf_counter() - begin
        print(
            f"{name:6} neighbours that differ: {differ}, distances by {error:.1e}; stumpy takes "
            f"{statistics.median(ratios):.2f} times as long ({min(ratios):.2f} to "
            f"{max(ratios):.2f}); motif {profile.motifs()[0]}, discord {profile.discords()[0]}; "
            f"dtw in a window of 5: {seconds:.1f} s, motif {warped.motifs()[0]}, discord "
            f"{warped.discords()[0]}"
        )


if __name__ == "__main__":
    main()
