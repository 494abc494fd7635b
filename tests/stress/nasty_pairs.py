"""Random pairs of curves that break such programs, and options to go with them.

The same kinds as in tests/cpp/hard_curves.hpp: ties, repeated points, one point, signed zeros,
subnormals, both ends of the range of a double, large offsets, last bits, one far point. The draws
depend only on the seed and the number of the pair.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, get_args

import numpy as np
import numpy.typing as npt

from curvewise._options import Metric

Array = npt.NDArray[np.float64]

KINDS = ("lattice", "real", "offset", "zeros", "extremes", "raw", "walk", "loop")
# What measures that are not exact are held to their tolerance on.
TAME = ("lattice", "real", "walk", "loop")
TINY = 5e-324
EXPONENTS = (-1074, -1050, -1022, -600, -512, -501, -500, -499, -1, 0, 1, 2, 3, 4)
EXPONENTS += (499, 500, 501, 512, 1000, 1022)


@dataclass
class Pair:
    """Two curves, the kind of their points, and options by measure."""

    kind: str
    P: Array
    Q: Array
    options: dict[str, dict[str, Any]] = field(default_factory=dict)


def draw(seed: int, number: int, most_points: int = 12) -> Pair:
    """Return a pair and options for every measure."""
    rng = np.random.default_rng([seed, number])
    kind = KINDS[rng.integers(len(KINDS))]
    dim = int(rng.choice([1, 2, 2, 2, 2, 3, 4, 7]))
    n, m = (int(k) for k in rng.integers(1, most_points, 2, endpoint=True))
    with np.errstate(all="ignore"):
        P = _plateaus(_curve(rng, kind, n, dim), rng, 4)
        Q = _other(rng, kind, P, m)
    return Pair(kind, P, Q, _options(rng, len(P), len(Q)))


def _curve(rng: np.random.Generator, kind: str, n: int, dim: int) -> Array:
    shape = (n, dim)
    if kind == "lattice":
        return rng.integers(-3, 3, shape, endpoint=True).astype(np.float64)
    if kind == "real":
        return rng.uniform(-1, 1, shape)
    if kind == "offset":
        return 2.0 ** rng.integers(10, 51) + rng.integers(-8, 8, shape, endpoint=True) / 8
    if kind == "zeros":
        return rng.choice([0.0, -0.0, TINY, -TINY, 3 * TINY, 2.0**-1022, 2.0**-530], shape)
    if kind == "extremes":
        mantissa = rng.choice([1, 1.25, 1.5, 1.75, -1, -1.25, -1.5, -1.75], shape)
        return np.ldexp(mantissa, rng.choice(EXPONENTS, shape))
    if kind == "raw":
        bits = rng.integers(0, 2**64, shape, dtype=np.uint64, endpoint=False)
        values = bits.view(np.float64)
        return np.where(np.isfinite(values), values, 0.0)
    if kind == "walk":
        return np.cumsum(rng.uniform(-0.1, 0.1, shape), axis=0)
    angle = 2 * np.pi * rng.uniform(0.5, 4) * np.arange(n) / n
    radius = 1 + rng.uniform(-0.02, 0.1) * angle
    columns = [radius * (np.cos if c % 2 == 0 else np.sin)(angle) for c in range(dim)]
    return np.column_stack(columns)


def _plateaus(curve: Array, rng: np.random.Generator, one_in: int) -> Array:
    """Repeat points, in one of `one_in` curves."""
    if rng.integers(one_in) != 0:
        return curve
    begins = rng.integers(2, size=len(curve)).astype(bool)
    begins[0] = True
    return curve[np.maximum.accumulate(np.where(begins, np.arange(len(curve)), 0))]


def _other(rng: np.random.Generator, kind: str, P: Array, m: int) -> Array:
    """Return an independent curve, or one that is like P."""
    which = rng.integers(8)
    if which == 0:
        return P.copy()
    if which == 1:
        return P[::-1].copy()
    if which == 2:
        towards = rng.choice([9.0, -9.0], P.shape)
        return np.where(rng.integers(2, size=P.shape), np.nextafter(P, towards), P)
    if which == 3:
        return _plateaus(P, rng, 1)
    if which == 4:
        Q = P.copy()
        i, c = rng.integers(len(P)), rng.integers(P.shape[1])
        Q[i, c] = 8 * Q[i, c] + 1 if abs(Q[i, c]) < 1e270 else 0.0
        return Q
    if which == 5:
        Q = P[np.linspace(0, len(P) - 1, m).astype(int)]
        return Q + rng.uniform(-1 / 128, 1 / 128, Q.shape) if kind in TAME else Q
    return _plateaus(_curve(rng, kind, m, P.shape[1]), rng, 4)


def _options(rng: np.random.Generator, n: int, m: int) -> dict[str, dict[str, Any]]:
    def ground() -> dict[str, Any]:
        metric = rng.choice(get_args(Metric))
        order = {"p": float(rng.choice([1.0, 2.0, np.inf, 1.5, 3.0]))}
        return {"metric": str(metric), **(order if metric == "minkowski" else {})}

    dtw = ground()
    shape = rng.integers(4)
    if shape == 0:
        dtw["window"] = int(rng.integers(1, max(n, m), endpoint=True))
    elif shape == 1:
        dtw["open_begin"], dtw["open_end"] = bool(rng.integers(2)), bool(rng.integers(2))
    elif rng.integers(2):
        dtw["step_pattern"] = "symmetric2"
    spacing = str(rng.choice(["distance", "x", "arc_length", "matched"]))
    crossing = str(rng.choice(["rearrange", "split"]))
    return {
        "dtw": dtw,
        "frechet": ground(),
        "area": {"spacing": spacing, "crossing": crossing, "squared": bool(rng.integers(2))},
        "pcm": {"offsets": int(rng.integers(1, 40))},
        "curve_length": {"scale": str(rng.choice(["mean", "mean_abs", "range"]))},
        "frechet_continuous": {},
    }
