"""Every bad input gets its error, by type and exact words, from every function that takes curves.

The same cases go to the compiled functions and to those of the reference: the words are part of
the interface. No input may be changed on the way to an error.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any, NamedTuple, get_args

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import reference
from curvewise._options import Metric, StepPatternName
from curvewise.measures.registry import MEASURES

# Functions that store a table, with the bytes of one cell.
TOO_LARGE = ["frechet_table", "dtw_table"]


class Case(NamedTuple):
    """A call and its expected message."""

    P: Any
    Q: Any
    options: dict[str, Any]
    message: str
    error: type[Exception] = ValueError


PLANAR = ("area", "area_quads", "pcm", "pcm_match", "curve_length", "curve_length_residuals")
TABLES = ("frechet", "frechet_path", "frechet_table", "dtw", "dtw_path", "dtw_table")
POINTWISE = ("sum_of_squares", "mse", "mae")
EVERY = (*PLANAR, *TABLES, *POINTWISE, "normalize", "compare")
ANY_DIMENSION = (*TABLES, *POINTWISE, "normalize")

# What a message calls the measure: variants go by the name of the measure they belong to.
MEASURE = {
    "area_quads": "area",
    "pcm_match": "pcm",
    "curve_length_residuals": "curve_length",
    **{name: name.split("_")[0] for name in TABLES},
}


def good(n: int = 5, d: int = 2) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.arange(1.0, n * d + 1).reshape(n, d) ** 1.5


def with_entry(place: Any, value: float, shape: tuple[int, ...] = (20, 2)) -> Any:
    curve = good(20).reshape(-1)[: int(np.prod(shape))].reshape(shape)
    curve[place] = value
    return curve


def bad_types() -> Iterator[tuple[str, str, Any, str, type[Exception]]]:
    """Yield the errors of all implementations: id, argument, curve, message, error."""
    dates = np.array(["2020-01-01", "2020-01-02"], dtype="datetime64[D]")
    masked = np.ma.masked_array([1.0, 2.0, 3.0], mask=[False, True, False])
    refused: list[tuple[str, Any, str]] = [
        ("complex", [1j, 2], "{} is complex; a curve is real: give real and imaginary as columns"),
        ("text", ["a", "b"], "{} has dtype <U1; a curve holds real numbers"),
        ("bytes", [b"ab", b"c"], "{} has dtype |S2; a curve holds real numbers"),
        ("objects", [object(), 1.0], "{} has dtype object; a curve holds real numbers"),
        ("none", None, "{} is None; give a curve"),
        (
            "none-within",
            [1.0, None],
            "{0} has dtype object; a curve holds real numbers, but {0}[1] is None: leave it out, "
            "or write nan",
        ),
        ("dates", dates, "{} has dtype datetime64[D]; a curve holds real numbers"),
        ("masked", masked, "{} is a masked array with masked entries; drop or fill them first"),
        ("masked rows", [masked] * 3, "{} is a list with masked entries; drop or fill them first"),
        (
            "a masked number",
            [(1.0, 2.0), (1.0, np.ma.masked)],
            "{} is a list with masked entries; drop or fill them first",
        ),
    ]
    dimensions = "{{}} has {} array dimensions; give shape (n, d), or (n,) for d = 1"
    ragged = "{} is ragged; a curve is n points with the same number of coordinates each"
    malformed: list[tuple[str, Any, str]] = [
        ("number", 3.0, dimensions.format(0)),
        ("cube", np.zeros((2, 2, 2)), dimensions.format(3)),
        ("ragged", [(1, 2), (3,)], ragged),
    ]
    for name in ("P", "Q"):
        for label, curve, message in refused:
            yield label, name, curve, message.format(name), TypeError
        for label, curve, message in malformed:
            yield label, name, curve, message.format(name), ValueError


def type_cases(function: str) -> Iterator[tuple[str, Case]]:
    for label, name, curve, message, error in bad_types():
        P, Q = (curve, good()) if name == "P" else (good(), curve)
        yield f"{label}-{name}", Case(P, Q, {}, message, error)
    frames = [pd.DataFrame(good(), columns=columns) for columns in (["x", "y"], ["y", "x"])]
    if function != "normalize":
        message = "P has columns ['x', 'y'] and Q has columns ['y', 'x']; name and order them alike"
        yield "columns", Case(frames[0], frames[1], {}, message)


def finite_cases(function: str) -> Iterator[tuple[str, Case]]:
    finite = "; curves must be finite"
    places = {(17, 1): np.nan, (0, 0): np.inf, (19, 0): -np.inf}
    for (i, c), value in places.items():
        bad = with_entry((i, c), value)
        yield f"{value}-P", Case(bad, good(20), {}, f"P[{i}, {c}] is {value}{finite}")
        yield f"{value}-Q", Case(good(20), bad, {}, f"Q[{i}, {c}] is {value}{finite}")
    both = with_entry((slice(3, None), 1), np.nan), with_entry((2, 0), np.nan)
    yield "first-of-both", Case(*both, {}, f"P[3, 1] is nan{finite}")
    if function in ANY_DIMENSION:
        flat = with_entry(17, np.nan, (20,))
        yield "flat-P", Case(flat, good(20, 1)[:, 0], {}, f"P[17] is nan{finite}")
        yield "flat-Q", Case(good(20, 1)[:, 0], flat, {}, f"Q[17] is nan{finite}")
        column = f"Q[17, 0] is nan{finite}"
        yield "column", Case(good(20, 1), flat[:, np.newaxis], {}, column)
        stride_0 = np.broadcast_to(flat[:, np.newaxis], (20, 1))
        yield "column-of-stride-0", Case(good(20, 1), stride_0, {}, column)


def shape_cases(function: str) -> Iterator[tuple[str, Case]]:
    if function == "compare":
        yield from compare_shape_cases()
        return
    measure = MEASURE.get(function, function)
    none = "a curve needs at least 1 coordinate"
    yield "no-columns-P", Case(np.empty((5, 0)), good(), {}, f"P has shape (5, 0); {none}")
    yield "no-columns-Q", Case(good(), np.empty((4, 0)), {}, f"Q has shape (4, 0); {none}")
    if function in POINTWISE:
        unequal = f"{measure} needs equal shapes"
        rows = f"P has shape (5, 2) and Q has shape (4, 2); {unequal}"
        yield "rows", Case(good(5), good(4), {}, rows)
        columns = f"P has shape (5, 2) and Q has shape (5, 3); {unequal}"
        yield "columns", Case(good(5), good(5, 3), {}, columns)
        yield "both-empty", Case([], [], {}, f"P has shape (0,); {measure} needs at least 1 point")
        yield "empty", Case([], [1], {}, f"P has shape (0,) and Q has shape (1,); {unequal}")
        return
    both = "P has shape (5, 2) and Q has shape (4, 3); both need the same number of coordinates"
    yield "dims", Case(good(), good(4, 3), {}, both)
    flat = "P has shape (5, 2) and Q has shape (4,); both need the same number of coordinates"
    yield "dims-flat", Case(good(), good(4, 1)[:, 0], {}, flat)
    least = 2 if function in PLANAR else 1
    few = f"{measure} needs at least {least} point" + "s" * (least > 1)
    for n in range(least):
        yield f"{n}-P", Case(good(n), good(), {}, f"P has shape ({n}, 2); {few}")
        yield f"{n}-Q", Case(good(), good(n), {}, f"Q has shape ({n}, 2); {few}")
    if function in PLANAR:
        xy = f"{measure} needs 2 coordinates, x and y"
        solid = f"P has shape (5, 3) and Q has shape (4, 3); {xy}"
        yield "solid", Case(good(5, 3), good(4, 3), {}, solid)
        yield "list", Case([1, 2], [1, 2, 3], {}, f"P has shape (2,) and Q has shape (3,); {xy}")
    else:
        yield "empty-list", Case([], [1], {}, f"P has shape (0,); {few}")


def compare_shape_cases() -> Iterator[tuple[str, Case]]:
    """Yield shapes that every measure refuses which compare calls."""
    raw = {"preset": "raw"}
    dims = "P has shape (5, 2) and Q has shape (4, 3); both need the same number of coordinates"
    none = "P has shape (5, 0); a curve needs at least 1 coordinate"
    for label, options in (("scaled", {}), ("raw", raw), ("paper", {"preset": "paper"})):
        yield f"dims-{label}", Case(good(), good(4, 3), options, dims)
        yield f"no-columns-{label}", Case(np.empty((5, 0)), good(), options, none)
    xy = "P has shape (5, 3) and Q has shape (4, 3); pcm needs 2 coordinates, x and y"
    yield "solid", Case(good(5, 3), good(4, 3), {"measures": ["pcm", "area"]}, xy)
    empty = "P has shape (0, 3); frechet needs at least 1 point"
    yield "empty", Case(good(0, 3), good(4, 3), raw, empty)


def unknown(option: str, choices: str, valid: str) -> Iterator[tuple[str, Case]]:
    wrong = {"foo": "foo", "case": valid.upper(), "none": None, "number": 3, "list": [valid]}
    for label, value in {**wrong, "surrogate": valid + "\ud800"}.items():
        meant = f"; did you mean {valid!r}?" if label in ("case", "surrogate") else ""
        message = f"unknown {option} {value!r}; choose from {choices}{meant}"
        yield f"{option}-{label}", Case(good(), good(4), {option: value}, message)


def option_cases(function: str) -> Iterator[tuple[str, Case]]:
    if function.startswith("area"):
        yield from unknown("spacing", "distance, x, arc_length, matched, function", "x")
        yield from unknown("crossing", "rearrange, split, polygon", "split")
    if function.startswith("pcm"):
        for offsets in (0, -1, 1.5, 2.0, True, None, "foo", "200", [200]):
            message = f"offsets is {offsets!r}; give a whole number >= 1, or 'continuous'"
            yield f"offsets={offsets}", Case(good(), good(4), {"offsets": offsets}, message)
    if function.startswith("curve_length"):
        yield from unknown("scale", "mean, mean_abs, range", "mean")
    if function in TABLES:
        yield from metric_cases()
    if function.startswith("dtw"):
        yield from warping_cases()
    if function == "compare":
        yield from unknown("preset", "scaled, paper, raw", "raw")
        for name in ("foo", None, ["dtw"]):
            choices = ", ".join(MEASURES)
            message = f"unknown measure {name!r}; choose from {choices}"
            yield f"measure-{name}", Case(good(), good(4), {"measures": ["dtw", name]}, message)


def metric_cases() -> Iterator[tuple[str, Case]]:
    yield from unknown("metric", ", ".join(get_args(Metric)), "euclidean")
    for p in (0.5, 0, -1, 0.999, -np.inf, np.nan, "two", [3]):
        message = f"p is {p!r}; minkowski needs 1 <= p <= inf"
        yield f"p={p}", Case(good(), good(4), {"metric": "minkowski", "p": p}, message)
    for metric in [metric for metric in get_args(Metric) if metric != "minkowski"]:
        message = f"p applies to metric='minkowski' only, not to '{metric}'"
        yield f"p-{metric}", Case(good(), good(4), {"metric": metric, "p": 2}, message)


def warping_cases() -> Iterator[tuple[str, Case]]:
    patterns = ", ".join(get_args(StepPatternName))
    yield from unknown("step_pattern", patterns, "symmetric1")
    advice = "give a whole number >= 0, a fraction between 0 and 1, or None"
    for window in (-1, 1.5, 2.0, 1.0, 0.0, -0.5, True, "3", [3]):
        message = f"window is {window!r}; {advice}"
        yield f"window={window}", Case(good(), good(5), {"window": window}, message)
    message = "window=0 admits no path between 5 and 4 points; use at least 1"
    yield "window=0", Case(good(), good(4), {"window": 0}, message)
    yield "window=0.1", Case(good(), good(4), {"window": 0.1}, message)
    for ends in ({"open_begin": True}, {"open_end": True}, {"open_begin": True, "open_end": True}):
        options = {**ends, "step_pattern": "typeIa"}
        needs = "needs step_pattern='symmetric1' without a penalty, or a step pattern"
        message = (
            f"open_begin {needs} normalised by N, such as 'asymmetric'; typeIa is not"
            if "open_begin" in ends
            else f"open_end {needs} whose paths all have one weight, such as 'symmetric2' or "
            "'asymmetric'; those of typeIa differ"
        )
        yield f"{'-'.join(ends)}-typeIa", Case(good(), good(4), options, message)
        message = "open_begin and open_end cannot be combined with window"
        yield f"{'-'.join(ends)}-window", Case(good(), good(4), {**ends, "window": 3}, message)


def measure_cases(function: str) -> Iterator[tuple[str, Case]]:
    """Yield what only the measure itself can find."""
    measure = MEASURE.get(function, function)
    point = np.full((4, 2), 3.0)
    if measure in ("pcm", "curve_length"):
        zero = f"has zero length (all its points are equal); {measure} needs two different points"
        yield "zero-length-P", Case(point, good(), {}, f"P {zero}")
        yield "zero-length-Q", Case(good(), point, {}, f"Q {zero}")
        yield "zero-length-both", Case(point, point, {}, f"P {zero}")
    if measure == "curve_length":
        advice = "is 0 to rounding; use scale='mean_abs' or scale='range'"
        angle = np.arange(12) * np.pi / 6
        around_y = np.column_stack((np.cos(angle), np.sin(angle) + 2.0))
        around_x = around_y[:, ::-1]
        yield "mean-x", Case(around_y, good(), {}, f"the mean of P's x {advice}")
        yield "mean-y", Case(around_x, good(), {}, f"the mean of P's y {advice}")
        level = np.array([(1.0, 3.0), (2.0, 3.0)])
        flat = "the range of P's y is 0; use scale='mean' or scale='mean_abs'"
        yield "range-y", Case(level, good(), {"scale": "range"}, flat)


def order_cases(function: str) -> Iterator[tuple[str, Case]]:
    """Yield two faults at once: types, options, columns, dimensions, points, finite."""
    nan = with_entry((2, 1), np.nan)
    for label, wrong in itertools.islice(option_cases(function), 1):
        yield f"{label}-before-finite", wrong._replace(P=nan)
        yield f"{label}-before-dims", wrong._replace(Q=good(4, 3))
        yield f"{label}-before-columns", wrong._replace(P=np.empty((5, 0)))
        text = "Q has dtype <U1; a curve holds real numbers"
        yield f"types-before-{label}", wrong._replace(Q=["a"], message=text, error=TypeError)
    cube = "P has 3 array dimensions; give shape (n, d), or (n,) for d = 1"
    yield "P-before-Q", Case(np.zeros((1, 1, 1)), ["a"], {}, cube)
    if function in (*POINTWISE, "normalize", "compare"):  # whose order is their own
        return
    dims = "P has shape (20, 2) and Q has shape (4, 3); both need the same number of coordinates"
    yield "dims-before-finite", Case(nan, good(4, 3), {}, dims)
    empty = "P has shape (0, 2) and Q has shape (4, 3); both need the same number of coordinates"
    yield "dims-before-points", Case(good(0), good(4, 3), {}, empty)
    few = dict(shape_cases(function))["0-Q"]
    yield "points-before-finite", few._replace(P=with_entry((2, 1), np.nan, (5, 2)))
    if function in ("pcm", "curve_length"):
        point = np.full((4, 2), 3.0)
        message = "Q[2, 1] is nan; curves must be finite"
        yield "finite-before-length", Case(point, nan, {}, message)


def cases_of(function: str) -> Iterator[tuple[str, Case]]:
    for kind in (type_cases, finite_cases, shape_cases, option_cases, measure_cases, order_cases):
        yield from kind(function)


def every_case() -> Iterator[Any]:
    for module in (curvewise, reference):
        for function in EVERY:
            if module is reference and function == "compare":
                continue
            for label, case in cases_of(function):
                yield pytest.param(
                    module, function, case, id=f"{module.__name__}-{function}-{label}"
                )


def snapshot(curve: Any) -> Any:
    if isinstance(curve, np.ndarray):
        return curve.dtype, curve.shape, np.asarray(curve).tobytes()
    return curve.copy() if isinstance(curve, pd.DataFrame) else repr(curve)


def unchanged(curve: Any, before: Any) -> bool:
    if isinstance(curve, pd.DataFrame):
        return bool(curve.equals(before))
    return bool(snapshot(curve) == before)


@pytest.mark.parametrize(("module", "function", "case"), list(every_case()))
def test_a_bad_input_gets_its_error(module: ModuleType, function: str, case: Case) -> None:
    before = snapshot(case.P), snapshot(case.Q)
    call: Callable[..., Any] = getattr(module, function)
    with pytest.raises(case.error) as caught:
        call(case.P, case.Q, **case.options)
    assert str(caught.value) == case.message
    assert type(caught.value) is case.error
    assert unchanged(case.P, before[0])
    assert unchanged(case.Q, before[1])


@pytest.mark.parametrize("function", ["curve_length", "curve_length_residuals"])
def test_a_coordinate_that_is_0_throughout_cannot_scale(function: str) -> None:
    P = np.array([(1.0, 0.0), (2.0, 0.0)])
    words = []
    for module in (curvewise, reference):
        with pytest.raises(ValueError, match="P's y is 0 throughout") as caught:
            getattr(module, function)(P, good(), scale="mean_abs")
        words.append(str(caught.value))
    assert words[0] == words[1]


@pytest.mark.parametrize("function", TOO_LARGE)
def test_a_table_beyond_all_memory_says_its_size(function: str) -> None:
    # More than the 2**47 bytes that a process can address, so that no allocator can promise them.
    n = 13_000_000
    curve = np.broadcast_to(np.float64(1.0), n)
    with pytest.raises(MemoryError) as caught:
        getattr(curvewise, function)(curve, curve)
    size = re.search(r"([0-9.e+]+) GiB", str(caught.value))
    assert size, str(caught.value)
    assert float(size[1]) == pytest.approx(n * n * 8 / 2**30, rel=0.01)
    assert getattr(curvewise, function.split("_")[0])(curve[:3], curve[:5]) == 0.0
