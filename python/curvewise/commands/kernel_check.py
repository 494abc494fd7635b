"""Check the compiled library on this machine against the numpy reference.

Every kernel (recurrence, ground distance, dimension, output) runs on a few hundred generated pairs.
Their sizes straddle SIMD vectors and strips. Half of them have small integers, for which ties are
frequent. Results that must be bitwise identical are compared with ``==``, the others to 1e-12. The
continuous Fréchet distance is checked by exact decisions about it and the double below it. The
reference takes most of the time, about ten seconds. An instruction-set level needs no reference run
if its results are bitwise identical to those of a confirmed level.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any, TextIO, get_args

import numpy as np

from .. import reference
from .._core import build_info, choices, measures
from ..curves.inputs import Array
from ..curves.layouts import settled_layout
from ..measures.edit_distances import EditDistance
from ..measures.registry import MEASURES, MeasureInfo
from ..measures.results import Alignment

__all__ = ["run"]

_SIZES = (1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64)
_DIMENSIONS = (1, 2, 3, 4, 7)
_EDITS = get_args(EditDistance)
_OF_THE_SLOW = ("euclidean",)  # the sweep is the same with every ground distance
_TALL = ((257, 3), (513, 2), (3, 257))
# Options that have no list of choices, and are tried with every ground distance.
_MORE: dict[str, tuple[dict[str, Any], ...]] = {
    "dtw": ({"window": 3}, {"open_begin": True, "open_end": True}),
}


def run(stream: TextIO) -> bool:
    """Run all checks at every instruction-set level of this machine.

    Parameters
    ----------
    stream : text file
        The stream for the report, one line for each check, e.g. ``sys.stdout``.

    Returns
    -------
    bool
        True if every comparison succeeded.

    Notes
    -----
    A process selects its level once, so each level other than the one in use is checked in a
    separate process. About ten seconds in all.

    Examples
    --------
    >>> import sys
    >>> from curvewise.commands import kernel_check
    >>> kernel_check.run(sys.stdout)  # doctest: +SKIP
    """
    info = build_info()
    confirmed = _check_active_level(stream, {})
    all_agree = all(confirmed.values())
    known = json.dumps({name: digest for name, digest in confirmed.items() if digest})
    for level in info["instruction_sets"]:
        if level != info["active"]:
            checked = subprocess.run(
                [sys.executable, "-m", __name__],
                env={**os.environ, "CURVEWISE_ISA": level},
                input=known,
                stdout=subprocess.PIPE,
                text=True,
                check=False,
            )
            stream.write(checked.stdout)
            all_agree &= checked.returncode == 0
    stream.write("all agree with the reference\n" if all_agree else "NOT all agree\n")
    return all_agree


def _check_active_level(stream: TextIO, known: dict[str, str]) -> dict[str, str]:
    """Return the digest of each check's results, or "" where they differ from the reference.

    Results that have the digest in `known` have been compared with the reference before.
    """
    level = build_info()["active"]
    digests = {}
    for info, options in _checks():
        name = _label(info, options)
        every = 24 if _is_slow(info, options) else 1
        pairs = list(_pairs(info, name))[::every]
        results = [_results(info, options, *pair) for pair in pairs]
        digest, verdict = _digest(results), "ok"
        if known.get(name) != digest:
            agree = [_agree(info, options, *both) for both in zip(results, pairs, strict=True)]
            if not all(agree):
                P, Q = pairs[agree.index(False)]
                verdict = f"DIFFERS for {agree.count(False)} pairs, e.g. P {P.shape}, Q {Q.shape}"
                digest = ""
        digests[name] = digest
        print(f"{level:<9} {name:<45} {verdict}", file=stream, flush=True)
    return digests


def _checks() -> Iterator[tuple[MeasureInfo, dict[str, Any]]]:
    """Yield every measure with every combination of its choices, and with some more options."""
    listed = choices()
    for name, defaults in measures().items():
        free = {option: listed[option] for option in defaults if option in listed}
        for values in product(*free.values()):
            options = dict(zip(free, values, strict=True))
            if options.get("crossing") == "polygon" and options["spacing"] != "distance":
                continue  # spacing does not act, and the reference is slow
            if not _is_slow(MEASURES[name], options) or options.get("metric") in _OF_THE_SLOW:
                yield MEASURES[name], options
        for more, metric in product(_MORE.get(name, ()), listed["metric"]):
            yield MEASURES[name], {"metric": metric, **more}


def _is_slow(info: MeasureInfo, options: dict[str, Any]) -> bool:
    """Return whether the reference goes cell by cell, with the steps of any recurrence."""
    patterns = ("symmetric1", "symmetric2")
    return info.name in _EDITS or options.get("step_pattern", patterns[0]) not in patterns


def _label(info: MeasureInfo, options: dict[str, Any]) -> str:
    values = (
        value if isinstance(value, str) else f"{name}={value}" for name, value in options.items()
    )
    return " ".join([info.name, *values])


def _functions(info: MeasureInfo) -> list[Callable[..., Any]]:
    return [info.function, *(() if info.name in _EDITS else info.warping or ())]


def _arguments(options: dict[str, Any]) -> dict[str, Any]:
    more: dict[str, Any] = {}
    if options.get("metric") == "minkowski":
        more = {"p": 3.0}
    elif options.get("metric") == "haversine" and "epsilon" in options:
        more = {"epsilon": options["epsilon"] or 2e5}  # of points that are some degrees apart
    elif options.get("crossing") == "polygon":
        more = {"closed": True}
    return {**options, **more}


def _results(info: MeasureInfo, options: dict[str, Any], P: Array, Q: Array) -> list[Any]:
    """Return what each function of a measure says of two curves."""
    with settled_layout():
        return [function(P, Q, **_arguments(options)) for function in _functions(info)]


def _digest(results: list[list[Any]]) -> str:
    """Return a hash of every bit of the results of a check."""
    digest = hashlib.sha256()
    for value in (value for of_pair in results for value in of_pair):
        parts = (value.distance, value.path) if isinstance(value, Alignment) else (value,)
        for part in parts:
            digest.update(np.ascontiguousarray(part).tobytes())
    return digest.hexdigest()


def _agree(
    info: MeasureInfo, options: dict[str, Any], results: list[Any], pair: tuple[Array, Array]
) -> bool:
    """Return whether the reference says of two curves what the compiled library does."""
    if info.name == "frechet_continuous":
        return _is_rounded_up(results[0], *pair)
    has_bits = info.warping is not None and info.name not in _EDITS
    exact = has_bits and options.get("metric") != "minkowski"
    return all(
        _equal(ours, getattr(reference, function.__name__)(*pair, **_arguments(options)), exact)
        for function, ours in zip(_functions(info), results, strict=True)
    )


def _is_rounded_up(value: float, P: Array, Q: Array) -> bool:
    """Return whether a value is the least double that is not below the continuous distance."""
    below = float(np.nextafter(value, 0.0))
    is_enough = reference.frechet_within(P, Q, value)
    return is_enough and (value == 0.0 or not reference.frechet_within(P, Q, below))


def _equal(ours: Any, theirs: Any, exact: bool) -> bool:
    if isinstance(ours, Alignment):
        # If values are inexact, rounding may decide which path is taken.
        same_path = np.array_equal(ours.path, theirs.path)
        return not exact or (ours.distance == theirs.distance and same_path)
    if exact:
        return np.array_equal(ours, theirs)
    return np.allclose(ours, theirs, rtol=1e-12, atol=0)


def _pairs(info: MeasureInfo, seed: str) -> Iterator[tuple[Array, Array]]:
    rng = np.random.default_rng(sum(seed.encode()))
    sizes = tuple(n for n in _SIZES if n > 1) if info.planar else _SIZES
    dimensions = (2,) if info.planar or "haversine" in seed else _DIMENSIONS
    shapes = [(int(rng.choice(sizes)), int(rng.choice(sizes))) for _ in range(6)]
    shapes += [(300, 170)] if info.planar else _TALL
    if "matched" in seed:  # noise travels far, and is sampled as densely as it does
        shapes[-1] = (60, 40)
    # Whole numbers in Python are slow; all places of a Hausdorff distance are many.
    if info.name in ("frechet_continuous", "hausdorff_continuous"):
        shapes = [(n % 18 + 1, m % 18 + 1) for n, m in shapes]
    # The curves are not centred on zero, since curve_length may divide by their mean.
    centre = 3.0 if info.planar else 0.0
    for (n, m), dim in product(shapes, dimensions):
        P, Q = rng.normal(centre, size=(n, dim)), rng.normal(centre, size=(m, dim))
        if "function" in seed:  # the x coordinate, which must not reverse
            P, Q = P[np.argsort(P[:, 0])], Q[np.argsort(Q[:, 0])]
        yield P, Q
        if not info.planar:
            whole = rng.integers(0, 4, (n, dim)), rng.integers(0, 4, (m, dim))
            yield whole[0].astype(np.float64), whole[1].astype(np.float64)


if __name__ == "__main__":
    sys.exit(0 if all(_check_active_level(sys.stdout, json.load(sys.stdin)).values()) else 1)
