"""Every measure of curves multiplied by a power of two, up to where squares leave the range.

A measure is homogeneous: its value grows by a power of the factor if its constants in units of the
coordinates grow with the curves. Powers of two round nothing, so the digits must stay the same.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import curvewise
from curvewise import reference

Array = np.ndarray[Any, np.dtype[np.float64]]
Options = dict[str, Any]

EXPONENTS = (-900, -600, -501, -500, 500, 501, 600, 900)
METRICS: list[tuple[Options, int]] = [
    ({"metric": "euclidean"}, 1),
    ({"metric": "sqeuclidean"}, 2),
    ({"metric": "cityblock"}, 1),
    ({"metric": "chebyshev"}, 1),
    ({"metric": "minkowski", "p": 3}, 1),
]
EDIT_DISTANCES = ("erp", "edr", "lcss", "msm", "twe", "wdtw")
COUNTS = ("edr", "lcss")
# By name: the constants that are distances, with values for curves of the size 1.
CONSTANTS: dict[str, Options] = {
    "dtw": {"penalty": 0.7},
    "erp": {"gap": 0.3},
    "edr": {"epsilon": 0.9},
    "lcss": {"epsilon": 0.9},
    "msm": {"cost": 0.4},
    "twe": {"stiffness": 0.05, "penalty": 0.6},
}


CASES: list[tuple[str, Options, int]] = [
    *[
        (name, options, degree)
        for name in ("dtw", "erp", "edr", "lcss", "twe", "wdtw", "hausdorff", "frechet")
        for options, degree in METRICS
    ],
    ("msm", {}, 1),
    ("frechet_continuous", {}, 1),
    *[("area", {"spacing": s}, 2) for s in ("distance", "x", "arc_length", "matched")],
    ("area", {"squared": True, "crossing": "split"}, 4),
    ("pcm", {}, 0),
    ("pcm", {"offsets": "continuous"}, 0),
    *[("curve_length", {"scale": scale}, 0) for scale in ("mean", "mean_abs", "range")],
    ("sum_of_squares", {}, 2),
    ("mse", {}, 2),
    ("mae", {}, 1),
]
both_modules = pytest.mark.parametrize("module", [curvewise, reference], ids=["compiled", "numpy"])
every_exponent = pytest.mark.parametrize("exponent", EXPONENTS)


def curves(exponent: int, name: str = "") -> tuple[Array, Array]:
    rng = np.random.default_rng(3)
    sizes = (6, 6) if name in ("sum_of_squares", "mse", "mae") else (6, 5)
    P, Q = (rng.normal(size=(size, 2)).cumsum(axis=0) for size in sizes)
    return np.ldexp(P, exponent), np.ldexp(Q, exponent)


def scaled(value: float, exponent: int) -> float:
    """Return value * 2**exponent, inf or 0 beyond the range."""
    with np.errstate(over="ignore", under="ignore"):
        return float(np.ldexp(value, exponent))


def constants(name: str, degree: int, exponent: int) -> Options | None:
    """Return constants that fit curves of the size 2**exponent; None if out of range."""
    result = {key: scaled(value, degree * exponent) for key, value in CONSTANTS[name].items()}
    if name == "erp":
        result = {"gap": scaled(0.3, exponent)}
    return None if not all(1e-305 < value < 1e305 for value in result.values()) else result


@both_modules
@every_exponent
@pytest.mark.nightly("[56]00")
@pytest.mark.parametrize("with_constants", [False, True], ids=["plain", "constants"])
def test_values_grow_with_the_curves(module: Any, exponent: int, with_constants: bool) -> None:
    for name, options, degree in CASES:
        more: list[Options | None] = [{}, {}]
        if with_constants:
            if name not in CONSTANTS:
                continue
            more = [constants(name, degree, k) for k in (0, exponent)]
        elif name in ("lcss", "msm", "twe") or (name == "edr" and degree == 2):
            continue  # their defaults are constants
        if more[1] is None:
            continue
        plain, large = (
            getattr(module, name)(*curves(k, name), **options, **constant)
            for k, constant in zip((0, exponent), more, strict=True)
        )
        assert 0 < plain < np.inf
        expected = scaled(plain, 0 if name in COUNTS else degree * exponent)
        assert large == pytest.approx(expected, rel=1e-13, abs=1e-320), (name, options)


@both_modules
@every_exponent
@pytest.mark.nightly("[56]00")
def test_constants_that_stay_grow_or_vanish_beside_the_curves(module: Any, exponent: int) -> None:
    """The same as of curves that stay, with constants that vanish or grow."""
    for name, options, degree in CASES:
        if name not in CONSTANTS:
            continue
        function = getattr(module, name)
        large = function(*curves(exponent), **options, **constants(name, degree, 0))
        grown = constants(name, degree, -exponent)
        if name == "erp" and degree == 2:  # the square of a grown gap overflows
            grown = grown if abs(exponent) < 600 else None
        if grown is not None:
            plain = function(*curves(0), **options, **grown)
            expected = scaled(plain, 0 if name in COUNTS else degree * exponent)
        elif exponent < 0:  # relative to the constants, the curves vanish
            expected = function(*(0 * C for C in curves(0)), **options, **constants(name, 1, 0))
        elif name in COUNTS:  # nothing is as near as the constant
            expected = function(*curves(0), **options, epsilon=1e-9)
        else:
            expected = np.inf
        assert large == pytest.approx(expected, rel=1e-12, abs=1e-320), (name, options)


@both_modules
@every_exponent
@pytest.mark.nightly("[56]00")
def test_the_default_epsilon_of_edr_is_in_units_of_the_coordinates(
    module: Any, exponent: int
) -> None:
    P, Q = curves(0)
    epsilon = max(np.std(P), np.std(Q)) / 4
    expected = module.edr(P, Q, metric="sqeuclidean", epsilon=scaled(epsilon, -exponent))
    assert module.edr(*curves(exponent), metric="sqeuclidean") == expected
    assert module.edr(*curves(exponent)) == module.edr(P, Q)


@both_modules
@every_exponent
@pytest.mark.nightly("[56]00")
def test_equal_points_are_nearer_than_any_epsilon(module: Any, exponent: int) -> None:
    P, _ = curves(exponent)
    for epsilon in (5e-324, 1.0, 1e308):
        for name in COUNTS:
            assert getattr(module, name)(P, P, metric="sqeuclidean", epsilon=epsilon) == 0.0


@both_modules
@every_exponent
@pytest.mark.nightly("[56]00")
def test_tables_and_paths_grow_with_the_curves(module: Any, exponent: int) -> None:
    for name in EDIT_DISTANCES:
        options = [constants(name, 1, k) if name in CONSTANTS else {} for k in (0, exponent)]
        metric: Options = {"metric": "euclidean"} if name != "msm" else {}
        plain, large = (
            module.edit_table(*curves(k), name, **metric, **more)
            for k, more in zip((0, exponent), options, strict=True)
        )
        np.testing.assert_array_equal(large, np.ldexp(plain, 0 if name in COUNTS else exponent))
        if name == "msm":
            continue
        plain, large = (
            module.edit_path(*curves(k), name, **metric, **more)
            for k, more in zip((0, exponent), options, strict=True)
        )
        np.testing.assert_array_equal(large.path, plain.path)
        assert large.distance == scaled(plain.distance, 0 if name in COUNTS else exponent)
    for name in ("dtw", "frechet"):
        plain, large = (getattr(module, f"{name}_table")(*curves(k)) for k in (0, exponent))
        np.testing.assert_array_equal(large, np.ldexp(plain, exponent))
        plain, large = (getattr(module, f"{name}_path")(*curves(k)) for k in (0, exponent))
        np.testing.assert_array_equal(large.path, plain.path)


def test_the_reference_agrees_with_constants_of_any_size(rounds: Callable[[int], int]) -> None:
    rng = np.random.default_rng(9)
    sizes = [0, *EXPONENTS, -1000, 1000]
    for _ in range(rounds(250)):
        exponent = int(rng.choice(sizes))
        d, *lengths = rng.integers(1, 7, 3).tolist()
        P, Q = (np.ldexp(rng.normal(size=(n, d)).cumsum(axis=0), exponent) for n in lengths)
        size = scaled(rng.uniform(0.1, 2), int(rng.choice([0, exponent, exponent, -600, 600])))
        metric: Options = {"metric": str(rng.choice([options["metric"] for options, _ in METRICS]))}
        for name in (*EDIT_DISTANCES, "dtw"):
            more = dict.fromkeys(CONSTANTS.get(name, {}), size) | (metric if name != "msm" else {})
            ours = getattr(curvewise, name)(P, Q, **more)
            theirs = getattr(reference, name)(P, Q, **more)
            assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-320), (name, more, exponent)


@every_exponent
@pytest.mark.nightly("[56]00")
def test_many_curves_have_the_values_of_each_pair(exponent: int) -> None:
    P, Q = curves(exponent)
    for name in (*EDIT_DISTANCES, "dtw", "frechet", "hausdorff"):
        options = constants(name, 1, exponent) if name in CONSTANTS else {}
        value = getattr(curvewise, name)(P, Q, **options)
        table = curvewise.cdist([P], [Q, Q[::-1]], name, **options)
        assert table[0, 0] == value
        assert curvewise.Prepared(P, name, **options)(Q) == value
        index = curvewise.Index([Q, Q[::-1]], name, **options)
        assert index.kneighbors([P], 2)[0].tolist() == np.sort(table).tolist()


@both_modules
@pytest.mark.parametrize("exponent", [-501, -500, 500, 501])
def test_soft_dtw_grows_with_the_curves_and_gamma(module: Any, exponent: int) -> None:
    plain = module.soft_dtw(*curves(0), gamma=0.7)
    large = module.soft_dtw(*curves(exponent), gamma=scaled(0.7, 2 * exponent))
    assert large == pytest.approx(scaled(plain, 2 * exponent), rel=1e-13)
