"""curvewise.compat gives the names, signatures and numbers of similaritymeasures 1.5.0.

Its numbers come from the golden data. Cases without a golden pair (integer curves, vertical
segments, further columns) have literals that the package printed. The area is also compared with
plain loops over its definition, written below. If that package is installed (the extra "test"
installs it), random curves of every kind are compared with it, bit for bit.
"""

from __future__ import annotations

import inspect
import json
import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import curvewise
import curvewise.compat as similaritymeasures

Array = npt.NDArray[Any]
Convert = Callable[[Array], Any]

SIGNATURES = {
    "area_between_two_curves": "(exp_data, num_data)",
    "curve_length_measure": "(exp_data, num_data)",
    "dtw": "(exp_data, num_data, metric='euclidean', **kwargs)",
    "dtw_path": "(d)",
    "frechet_dist": "(exp_data, num_data, p=2)",
    "get_arc_length": "(dataset)",
    "get_length": "(x, y, norm_seg_length=True)",
    "is_simple_quad": "(ab, bc, cd, da)",
    "mae": "(exp_data, num_data)",
    "makeQuad": "(x, y)",
    "mse": "(exp_data, num_data)",
    "normalizeTwoCurves": "(x, y, w, z)",
    "pcm": "(exp_data, num_data, norm_seg_length=False)",
    "poly_area": "(x, y)",
}

# A pair of integers with a segment of each kind; the numbers next to its uses are that package's.
P = np.array([[0, 0], [2, 3], [5, 4], [7, 1], [9, 0], [11, 2]])
Q = np.array([[0, 1], [4, 6], [11, -3]])
PF, QF = P.astype(float), Q.astype(float)

PLANE_MEASURES = (
    similaritymeasures.area_between_two_curves,
    similaritymeasures.pcm,
    similaritymeasures.curve_length_measure,
)


# ---------------------------------------------------------------- names, signatures, types


def test_public_names_and_version() -> None:
    assert sorted(similaritymeasures.__all__) == sorted(SIGNATURES)
    assert similaritymeasures.__version__ == "1.5.0"


@pytest.mark.parametrize("name", SIGNATURES)
def test_signature(name: str) -> None:
    signature = inspect.signature(getattr(similaritymeasures, name))
    bare = [p.replace(annotation=inspect.Parameter.empty) for p in signature.parameters.values()]
    assert str(inspect.Signature(bare)) == SIGNATURES[name]


def test_return_types() -> None:
    for measure in (*PLANE_MEASURES, similaritymeasures.frechet_dist, similaritymeasures.mae):
        assert type(measure(PF, PF)) is np.float64
    assert type(similaritymeasures.mse(P, P)) is np.float64
    assert type(similaritymeasures.poly_area([0, 1, 0], [0, 0, 1])) is np.float64
    assert type(similaritymeasures.makeQuad([0, 1, 1, 0], [0, 0, 1, 1])) is np.float64
    assert type(similaritymeasures.is_simple_quad([1, 0], [0, 1], [-1, 0], [0, -1])) is bool
    r, d = similaritymeasures.dtw(P, Q)
    assert type(r) is np.float64
    assert d.dtype == np.float64
    assert d.shape == (6, 3)
    assert d[-1, -1] == r
    path = similaritymeasures.dtw_path(d)
    assert path.dtype == np.int64
    assert path.ndim == 2
    total, lengths = similaritymeasures.get_arc_length(P)
    assert type(total) is np.float64
    assert lengths.dtype == np.float64
    assert lengths.shape == (5,)
    le, le_total, le_cum = similaritymeasures.get_length(P[:, 0], P[:, 1])
    assert type(le_total) is np.float64
    assert le.shape == le_cum.shape == (6,)
    scaled = similaritymeasures.normalizeTwoCurves(P[:, 0], P[:, 1], Q[:, 0], Q[:, 1])
    assert [(type(part), part.shape) for part in scaled] == [
        (np.ndarray, (6,)),
        (np.ndarray, (6,)),
        (np.ndarray, (3,)),
        (np.ndarray, (3,)),
    ]


# ---------------------------------------------------------------- golden numbers


def as_float64(curve: Array) -> Array:
    return curve


def as_list(curve: Array) -> list[list[float]]:
    rows: list[list[float]] = curve.tolist()
    return rows


def as_fortran_big_endian(curve: Array) -> Array:
    return np.asfortranarray(curve.astype(">f8"))


def as_frame(curve: Array) -> pd.DataFrame:
    return pd.DataFrame(curve)


def golden(data_dir: Path) -> Iterator[tuple[dict[str, Any], Array, Array]]:
    expected = json.loads((data_dir / "golden" / "expected.json").read_text(encoding="utf-8"))
    with np.load(data_dir / "golden" / "cases.npz") as cases:
        for name, values in expected["values"].items():
            yield values, cases[f"{name}/P"], cases[f"{name}/Q"]


def assert_golden(value: np.floating[Any], expected: float | None) -> None:
    if expected is None:
        assert not np.isfinite(value)
    else:
        assert value == pytest.approx(expected, rel=1e-12, abs=0)


@pytest.mark.parametrize("convert", [as_float64, as_list, as_fortran_big_endian, as_frame])
def test_golden_numbers(data_dir: Path, convert: Convert) -> None:
    seen = set()
    for values, P_golden, Q_golden in golden(data_dir):
        exp, num = convert(P_golden), convert(Q_golden)
        for name, compute in (
            ("area", similaritymeasures.area_between_two_curves),
            ("curve_length", similaritymeasures.curve_length_measure),
            ("compat_pcm", similaritymeasures.pcm),
            ("compat_pcm_norm_seg_length", lambda a, b: similaritymeasures.pcm(a, b, True)),
        ):
            if name in values:
                assert_golden(compute(exp, num), values[name])
                seen.add(name)
        for order, expected in values["frechet"].items():
            assert_golden(similaritymeasures.frechet_dist(exp, num, float(order)), expected)
        for metric, expected in values["dtw"].items():
            known = ("minkowski", {"p": 3}) if metric == "minkowski_p3" else (metric, {})
            r, d = similaritymeasures.dtw(exp, num, known[0], **known[1])
            assert_golden(r, expected)
            assert d.shape == (len(P_golden), len(Q_golden))
    assert seen == {"area", "curve_length", "compat_pcm", "compat_pcm_norm_seg_length"}


def test_golden_numbers_by_keyword(data_dir: Path) -> None:
    for values, exp, num in golden(data_dir):
        curves = {"num_data": num, "exp_data": exp}
        assert_golden(similaritymeasures.frechet_dist(**curves, p=1), values["frechet"]["1"])
        r, _ = similaritymeasures.dtw(**curves, metric="cityblock")
        assert_golden(r, values["dtw"]["cityblock"])
        if "area" in values:
            assert_golden(similaritymeasures.area_between_two_curves(**curves), values["area"])
            assert_golden(similaritymeasures.curve_length_measure(**curves), values["curve_length"])
            pcm = similaritymeasures.pcm(**curves, norm_seg_length=True)
            assert_golden(pcm, values["compat_pcm_norm_seg_length"])


@pytest.mark.parametrize("dtype", [np.int64, np.int8, np.float32, np.float64])
def test_integers_give_the_numbers_of_floats(dtype: npt.DTypeLike) -> None:
    exp, num = P.astype(dtype), Q.astype(dtype)
    rel = 1e-6 if dtype is np.float32 else 1e-12
    assert similaritymeasures.pcm(exp, num) == pytest.approx(0.9901459246812818, rel=rel)
    assert similaritymeasures.frechet_dist(exp, num) == math.sqrt(32)


# ---------------------------------------------------------------- area


def area_by_loops(exp: Array, num: Array) -> float:
    longer, shorter = exp.tolist(), num.tolist()
    if len(longer) < len(shorter):
        longer, shorter = shorter, longer
    while len(shorter) < len(longer):
        lengths = [math.sqrt((c - a) ** 2 + (d - b) ** 2) for (a, b), (c, d) in pairwise(shorter)]
        k = lengths.index(max(lengths))
        (x0, y0), (x1, y1) = sorted(shorter[k : k + 2], key=lambda point: point[0])
        x = (x0 + x1) / 2
        # A vertical segment has its first point repeated: what numpy.interp makes of two equal x.
        y = (y1 - y0) / (x1 - x0) * (x - x0) + y0 if x0 < x1 else shorter[k][1]
        shorter.insert(k + 1, [x, y])
    quads = zip(pairwise(longer), pairwise(shorter), strict=True)
    return math.fsum(quad_area([a, b, c, d]) for (a, b), (d, c) in quads)


def quad_area(corners: list[list[float]]) -> float:
    a, b, c, d = corners
    for order in ([a, b, c, d], [b, a, c, d], [a, c, b, d]):
        edges = [(v[0] - u[0], v[1] - u[1]) for u, v in pairwise([*order, order[0]])]
        turns = [u[0] * v[1] - u[1] * v[0] for u, v in pairwise([*edges, edges[0]])]
        if sum(turn > 0 for turn in turns) < 2 or sum(turn < 0 for turn in turns) < 2:
            break
    shoelace = math.fsum(u[0] * v[1] - u[1] * v[0] for u, v in pairwise([*order, order[0]]))
    return abs(shoelace) / 2


curves_in_the_plane = st.lists(
    st.tuples(st.integers(-5, 5), st.integers(-5, 5)), min_size=2, max_size=12
).map(lambda points: np.array(points, dtype=float))


@settings(deadline=None)
@given(curves_in_the_plane, curves_in_the_plane)
def test_area_equals_loops_over_its_definition(exp: Array, num: Array) -> None:
    area = similaritymeasures.area_between_two_curves(exp, num)
    assert area == pytest.approx(area_by_loops(exp, num), rel=1e-12, abs=1e-12)


def test_area_truncates_midpoints_of_integer_curves() -> None:
    assert similaritymeasures.area_between_two_curves(PF, QF) == 14.5
    assert similaritymeasures.area_between_two_curves(P, Q) == 13.0
    assert similaritymeasures.area_between_two_curves(PF, Q) == 13.0
    assert similaritymeasures.area_between_two_curves(P, QF) == 14.5
    assert similaritymeasures.area_between_two_curves(P.tolist(), Q.tolist()) == 13.0


def test_area_of_vertical_segments_further_columns_and_single_points() -> None:
    zigzag = np.array([[0.0, 0], [1, 1], [2, 2], [3, 1], [4, 0]])
    vertical = np.array([[0.0, 0], [0, 3], [1, 3]])
    assert similaritymeasures.area_between_two_curves(zigzag, vertical) == 6.0
    assert similaritymeasures.area_between_two_curves(vertical, zigzag) == 6.0
    exp, num = np.c_[PF, [0, 1, 0, 1, 0, 1]], np.c_[QF, [0, 9, 0]]
    assert similaritymeasures.area_between_two_curves(exp, num) == 14.75
    assert similaritymeasures.area_between_two_curves(PF[:1], QF[:1]) == 0.0


def test_area_repeats_the_first_point_of_a_vertical_segment() -> None:
    """Where curvewise.area bisects: 0.75 there and 0.25 here."""
    exp = np.array([[0, 0], [0, 1], [1, 1]], dtype=float)
    num = np.array([[0, 0], [0, 1], [0, 2], [0.5, 1], [1, 1], [1, 0.9]])
    assert similaritymeasures.area_between_two_curves(exp, num) == 0.75
    assert curvewise.area(exp, num) == 0.25
    up, down = np.array([[1.0, 0.0], [1.0, 4.0]]), np.array([[1.0, 4.0], [1.0, 0.0]])
    aside = np.column_stack([np.full(5, 3.0), np.arange(5.0)])
    assert similaritymeasures.area_between_two_curves(up, aside) == 8.0
    assert similaritymeasures.area_between_two_curves(down, aside) == 8.0


def random_curve(kind: str, n: int, random: np.random.Generator) -> Array:
    """Return a curve with what makes an area's refinement hard: equal x, equal points, ties."""
    if kind == "grid":
        return random.integers(-3, 4, (n, 2)).astype(float)
    if kind == "runs of equal x":
        x = np.repeat(random.integers(-2, 3, n), 3)[:n]
        return np.column_stack([x, random.integers(-2, 3, n)]).astype(float)
    if kind == "one x":
        return np.column_stack([np.full(n, 1.5), random.normal(size=n)])
    if kind == "repeated points":
        return np.repeat(random.integers(-2, 3, (n, 2)).astype(float), 2, axis=0)[:n]
    if kind == "integers":
        return random.integers(-5, 6, (n, 2))
    if kind == "small integers":
        return random.integers(-100, 100, (n, 2)).astype(np.int8)
    if kind == "float32":
        return random.normal(size=(n, 2)).astype(np.float32)
    if kind == "further columns":
        return random.integers(-3, 4, (n, 4)).astype(float)
    assert kind == "walk"
    return random.normal(size=(n, 2)).cumsum(axis=0)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of that package: nan, overflowing integers
@pytest.mark.parametrize(
    "kind",
    [
        *("grid", "runs of equal x", "one x", "repeated points", "integers", "small integers"),
        *("float32", "further columns", "walk"),
    ],
)
def test_the_bits_of_that_package(kind: str, rounds: Callable[[int], int]) -> None:
    theirs = pytest.importorskip(
        "similaritymeasures", reason="no similaritymeasures: pip install similaritymeasures==1.5.0"
    )
    if theirs.__version__ != similaritymeasures.__version__:
        pytest.skip(f"similaritymeasures is {theirs.__version__}, the numbers are those of 1.5.0")
    random = np.random.default_rng(len(kind))
    for i in range(rounds(150)):
        exp, num = (random_curve(kind, n, random) for n in random.integers(2, 40, 2))
        values = [bits(similaritymeasures, exp, num, with_pcm=i % 10 == 0)]
        values.append(bits(theirs, exp, num, with_pcm=i % 10 == 0))
        assert np.array_equal(*values, equal_nan=True), (exp, num)


def bits(package: Any, exp: Array, num: Array, *, with_pcm: bool) -> Array:
    """Return what a package gives for two curves; partial curve mapping takes it milliseconds."""
    values = [
        package.area_between_two_curves(exp, num),
        package.curve_length_measure(exp, num),
        package.get_arc_length(exp)[0],
    ]
    if with_pcm:
        values += [package.pcm(exp, num, flag) for flag in (False, True)]
    return np.array(values)


def test_polygons_and_quadrilaterals() -> None:
    assert similaritymeasures.poly_area([0, 2, 2, 0], [0, 0, 3, 3]) == 6.0
    assert similaritymeasures.poly_area(np.array([0.0, 0, 3]), np.array([0.0, 2, 0])) == 3.0
    x, y = [0, 1, 0, 1], [0, 1, 1, 0]
    assert similaritymeasures.makeQuad(x, y) == 1.0
    assert (x, y) == ([0, 1, 0, 1], [0, 1, 1, 0])
    assert similaritymeasures.makeQuad(x=(0, 2, 1, 2), y=(0, 2, 0, -1)) == 1.5
    assert similaritymeasures.makeQuad([0, 0, 1, 1], [0, 1, 0, 1]) == 1.0
    assert similaritymeasures.is_simple_quad([1, 1], [-1, 0], [1, -1], [-1, 0]) is False
    assert similaritymeasures.is_simple_quad(ab=[0, 0], bc=[0, 0], cd=[1, 0], da=[0, 1]) is True


# ---------------------------------------------------------------- lengths and pcm


def test_lengths_and_scaling() -> None:
    le, total, le_cum = similaritymeasures.get_length([0, 3, 6], [0, 4, 4], norm_seg_length=False)
    assert [le.tolist(), float(total), le_cum.tolist()] == [[0, 5, 3], 8, [0, 5, 8]]
    le, total, le_cum = similaritymeasures.get_length([0, 0, 0], [0, -4, 0])
    assert [le.tolist(), float(total), le_cum.tolist()] == [[0, 1, 1], 2, [0, 1, 2]]
    total, lengths = similaritymeasures.get_arc_length([[0, 0, 0], [1, 2, 2], [1, 2, 3]])
    assert [float(total), lengths.tolist()] == [4, [3, 1]]
    xi, eta, xiP, etaP = similaritymeasures.normalizeTwoCurves([1, 3], [0, 4], [2, 5], [1, 8])
    assert [xi.tolist(), eta.tolist(), xiP.tolist(), etaP.tolist()] == [
        [0, 1],
        [0, 1],
        [0.5, 2],
        [0.25, 2],
    ]


def test_pcm_and_curve_length_of_the_integer_pair() -> None:
    assert similaritymeasures.pcm(P, Q) == pytest.approx(0.9901459246812818, rel=1e-12)
    assert similaritymeasures.pcm(P, Q, True) == pytest.approx(1.135041917355484, rel=1e-12)
    r = similaritymeasures.curve_length_measure(P + 1, Q + 5)
    assert r == pytest.approx(2.6174308734599787, rel=1e-12)


def test_pcm_in_one_chunk_and_in_many(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = similaritymeasures.pcm(PF, QF)
    monkeypatch.setattr("curvewise.compat._arc_length._CHUNK", 7)
    assert similaritymeasures.pcm(PF, QF) == whole
