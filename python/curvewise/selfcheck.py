"""Check the compiled library on this machine against the numpy reference.

Every kernel (recurrence, ground distance, dimension, output) is run on a few hundred generated
pairs whose sizes straddle SIMD vectors and strips, half of them on small integers, where ties
abound. What must have the same bits is compared with ``==``, the rest to 1e-12. Takes seconds.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any, TextIO

import numpy as np
import numpy.typing as npt

from . import _core, measures, reference

__all__ = ["run"]

_Pair = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]

_SIZES = (1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64)
_DIMENSIONS = (1, 2, 3, 4, 7)
_TALL = ((257, 3), (513, 2), (3, 257))
_GROUND = ("euclidean", "sqeuclidean", "cityblock", "chebyshev", "minkowski")
_DTW_OPTIONS: tuple[dict[str, Any], ...] = (
    {},
    {"step_pattern": "symmetric2"},
    {"window": 3},
    {"open_begin": True, "open_end": True},
)


def run(stream: TextIO) -> bool:
    """Run all checks at every instruction-set level of this machine.

    Parameters
    ----------
    stream : text file
        Where one line for each check is written, e.g. ``sys.stdout``.

    Returns
    -------
    bool
        True where every comparison held.

    Notes
    -----
    The level of a process is chosen once, so each level other than the one in use is checked in a
    process of its own. Some seconds a level.

    Examples
    --------
    >>> import sys
    >>> from curvewise import selfcheck
    >>> selfcheck.run(sys.stdout)  # doctest: +SKIP
    """
    info = _core.build_info()
    all_agree = _check_active_level(stream)
    for level in info["instruction_sets"]:
        if level != info["active"]:
            checked = subprocess.run(
                [sys.executable, "-m", __name__],
                env={**os.environ, "CURVEWISE_ISA": level},
                stdout=subprocess.PIPE,
                text=True,
                check=False,
            )
            stream.write(checked.stdout)
            all_agree &= checked.returncode == 0
    stream.write("all agree with the reference\n" if all_agree else "NOT all agree\n")
    return all_agree


def _check_active_level(stream: TextIO) -> bool:
    level = _core.build_info()["active"]
    all_agree = True
    for name, agrees in _checks():
        failed = [pair for pair in _pairs(name) if not agrees(*pair)]
        all_agree &= not failed
        verdict = "ok" if not failed else f"DIFFERS for {len(failed)} pairs, e.g. {_shapes(failed)}"
        stream.write(f"{level:<9} {name:<45} {verdict}\n")
        stream.flush()
    return all_agree


def _shapes(failed: list[_Pair]) -> str:
    return f"P {failed[0][0].shape}, Q {failed[0][1].shape}"


def _checks() -> Iterator[tuple[str, Callable[..., bool]]]:
    for metric in _GROUND:
        exact = metric != "minkowski"
        ground = {"metric": metric} if exact else {"metric": metric, "p": 3.0}
        yield f"frechet {metric}", _same_table("frechet", ground, exact)
        for options in _DTW_OPTIONS:
            label = " ".join(f"{key}={value}" for key, value in options.items())
            yield f"dtw {metric} {label}".rstrip(), _same_table("dtw", ground | options, exact)
    for spacing in ("distance", "x", "arc_length"):
        for crossing in ("rearrange", "split"):
            options = {"spacing": spacing, "crossing": crossing}
            yield f"area {spacing} {crossing}", _close("area", options)
    yield "pcm", _close("pcm", {})
    yield "curve_length", _close("curve_length", {"scale": "mean_abs"})


def _same_table(
    measure: str, options: dict[str, Any], exact: bool
) -> Callable[[npt.NDArray[np.float64], npt.NDArray[np.float64]], bool]:
    def agrees(P: npt.NDArray[np.float64], Q: npt.NDArray[np.float64]) -> bool:
        ours = _everything(measures, measure, P, Q, options)
        theirs = _everything(reference, measure, P, Q, options)
        if exact:
            return all(np.array_equal(a, b) for a, b in zip(ours, theirs, strict=True))
        return all(
            np.allclose(a, b, rtol=1e-12, atol=0) for a, b in zip(ours[:2], theirs, strict=False)
        )

    return agrees


def _everything(
    module: Any,
    measure: str,
    P: npt.NDArray[np.float64],
    Q: npt.NDArray[np.float64],
    options: dict[str, Any],
) -> list[Any]:
    alignment = getattr(module, f"{measure}_path")(P, Q, **options)
    return [
        getattr(module, measure)(P, Q, **options),
        getattr(module, f"{measure}_table")(P, Q, **options),
        alignment.distance,
        alignment.path,
    ]


def _close(measure: str, options: dict[str, Any]) -> Callable[..., bool]:
    def agrees(P: npt.NDArray[np.float64], Q: npt.NDArray[np.float64]) -> bool:
        ours = getattr(measures, measure)(P, Q, **options)
        theirs = getattr(reference, measure)(P, Q, **options)
        return bool(abs(ours - theirs) <= 1e-12 * abs(theirs))

    return agrees


def _pairs(name: str) -> Iterator[_Pair]:
    quadratic = name.startswith(("dtw", "frechet"))
    rng = np.random.default_rng(sum(name.encode()))
    sizes = _SIZES if quadratic else tuple(n for n in _SIZES if n > 1)
    dimensions = _DIMENSIONS if quadratic else (2,)
    shapes = [(int(rng.choice(sizes)), int(rng.choice(sizes))) for _ in range(6)]
    shapes += _TALL if quadratic else [(300, 170)]
    for n, m in shapes:
        for dim in dimensions:
            yield rng.normal(size=(n, dim)), rng.normal(size=(m, dim))
            if quadratic:
                yield (
                    rng.integers(0, 4, (n, dim)).astype(np.float64),
                    rng.integers(0, 4, (m, dim)).astype(np.float64),
                )


if __name__ == "__main__":
    sys.exit(0 if _check_active_level(sys.stdout) else 1)
