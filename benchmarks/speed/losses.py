"""Soft-DTW with its gradient: a long pair, and batches beside tslearn and pysdtw on the CPU.

Each package computes the values of a batch of pairs and the derivatives by both curves, as a loss
of PyTorch does; medians of alternating calls. Both others compute in float32, whatever they are
given. The long pair has 10,000 points on each side, and is computed by one thread; beside its
seconds stands what memory it took at most.

    pip install torch tslearn pysdtw
    python benchmarks/speed/losses.py

Writes losses.md.
"""

from __future__ import annotations

import argparse
import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import torch

import curvewise
import curvewise.torch

RESULTS = Path(__file__).parent / "results"


def long_pair(n: int) -> str:
    """Return the seconds and the memory of one pair with its gradient, in words."""
    P = np.random.default_rng(0).normal(size=(1, n, 1)).cumsum(axis=1)
    Q = P + np.random.default_rng(1).normal(size=P.shape)
    curvewise.values_and_gradients(P[:, :100], Q[:, :100], "soft_dtw")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    started, cpu = time.perf_counter(), time.process_time()
    curvewise.values_and_gradients(P, Q, "soft_dtw")
    took, cpu = time.perf_counter() - started, time.process_time() - cpu
    memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    return (
        f"{n} x {n} points, value and gradients by both curves, one thread: {took:.2f} s "
        f"({cpu:.2f} s of CPU), {memory:.0f} MB\n"
    )


def losses() -> dict[str, Callable[[Any, Any], Any]]:
    """Return what computes a batch of values, by package."""
    import pysdtw
    from tslearn.metrics import SoftDTWLossPyTorch

    theirs, other = SoftDTWLossPyTorch(gamma=1.0), pysdtw.SoftDTW(gamma=1.0, use_cuda=False)
    return {
        "curvewise": lambda p, q: curvewise.torch.soft_dtw(p, q, gamma=1.0),
        "tslearn": theirs,
        "pysdtw": other,
    }


def seconds(loss: Callable[[Any, Any], Any], p: torch.Tensor, q: torch.Tensor) -> float:
    """Return the time of a value and its derivatives."""
    p, q = (curves.clone().requires_grad_() for curves in (p, q))
    started = time.perf_counter()
    loss(p, q).sum().backward()
    return time.perf_counter() - started


def batches(shapes: list[tuple[int, int]], repetitions: int) -> str:
    """Return a table of the times of batches, and how far the values are apart."""
    lines = [
        "| pairs x points | package | ms, median | times curvewise's | values differ by |",
        "|---|---|---:|---:|---:|",
    ]
    for count, n in shapes:
        random = torch.Generator().manual_seed(0)
        p, q = (torch.randn(count, n, 1, generator=random, dtype=torch.float64) for _ in range(2))
        times: dict[str, list[float]] = {}
        for repetition in range(repetitions + 1):  # the first compiles, and does not count
            for name, loss in losses().items():
                took = seconds(loss, p, q)
                if repetition > 0:
                    times.setdefault(name, []).append(took)
        ours = statistics.median(times["curvewise"])
        values = {name: loss(p, q) for name, loss in losses().items()}
        for name, found in times.items():
            median = statistics.median(found)
            apart = (values[name] - values["curvewise"]).abs().max()
            share = apart / values["curvewise"].abs().max()
            cells = (f"{count} x {n}", name, f"{1e3 * median:.1f}", f"{median / ours:.0f}")
            lines.append(f"| {' | '.join(cells)} | {share:.1e} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--points", type=int, default=10_000, help="of the long pair")
    parser.add_argument("--repetitions", type=int, default=7)
    parser.add_argument("--output", type=Path, default=RESULTS)
    options = parser.parse_args()
    threads = f"curvewise on {torch.get_num_threads()} threads, the others as they come.\n\n"
    text = (
        long_pair(options.points)
        + "\n"
        + threads
        + batches([(64, 256), (64, 64), (8, 1000)], options.repetitions)
    )
    print(text)
    (options.output / "losses.md").write_text(text)


if __name__ == "__main__":
    main()
