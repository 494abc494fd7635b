"""The C interface, called from Python by ctypes: every option, and every error.

The library is loaded next to the Python module, which contains a copy; both give the same bits.
"""

from __future__ import annotations

import math
import sys
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_ssize_t
from typing import get_args

import numpy as np
import pytest
from c_structs import (
    FAILED,
    INVALID_ARGUMENT,
    MEASURES,
    OK,
    Area,
    Batch,
    Curve,
    CurveLength,
    Dtw,
    Error,
    Frechet,
    FrechetContinuous,
    Pcm,
    curves,
    doubles,
    integers,
    view,
)
from programs import MARKS, run

import curvewise
from curvewise._options import CoordinateMetric, Crossing, Spacing
from curvewise.materials import MATERIALS as MATERIALS_OF_PYTHON
from curvewise.materials import ChabocheVoce, JohnsonCook, Swift, YoshidaUemori

pytestmark = MARKS

METRICS = get_args(CoordinateMetric)


@pytest.fixture
def call(library):
    """Call a measure; return its value, or raise what the status and the message say."""

    def measure(name: str, P, Q, options: Structure | None = None) -> float:
        value, error = c_double(math.nan), Error()
        given = None if options is None else byref(options)
        function = getattr(library, f"curvewise_{name}")
        p, q = (curve if curve is None else byref(view(curve)) for curve in (P, Q))
        status = function(p, q, given, byref(value), byref(error))
        message = error.message.decode()
        assert (status == OK) == (message == "") == (not math.isnan(value.value))
        if status == INVALID_ARGUMENT:
            raise ValueError(message)
        assert status == OK, message
        return value.value

    return measure


random = np.random.default_rng(5)
P, Q = (np.cumsum(random.normal(size=(n, 2)), axis=0) for n in (60, 45))


@pytest.mark.parametrize("name", MEASURES)
def test_null_options_are_the_defaults(name, call) -> None:
    assert call(name, P, Q) == getattr(curvewise, name)(P, Q)
    assert call(name, P[::-2], np.asfortranarray(Q)) == getattr(curvewise, name)(P[::-2], Q)


@pytest.mark.parametrize("metric", METRICS)
def test_table_options(metric, call) -> None:
    order = {"p": 3.5} if metric == "minkowski" else {}
    code = METRICS.index(metric)
    value = call("frechet", P, Q, Frechet(code, 3.5, 2, 1, math.inf))
    assert value == curvewise.frechet(P, Q, metric=metric, **order)
    for pattern, window in ((0, None), (1, None), (0, 7), (1, 20)):
        options = Dtw(code, 3.5, pattern, 0, 0, -1 if window is None else window, 1, 0, math.inf)
        expected = curvewise.dtw(
            P, Q, metric=metric, step_pattern=f"symmetric{pattern + 1}", window=window, **order
        )
        assert call("dtw", P, Q, options) == expected
    for begin, end in ((1, 0), (0, 1), (1, 1)):
        expected = curvewise.dtw(
            P, Q, metric=metric, open_begin=bool(begin), open_end=bool(end), **order
        )
        assert call("dtw", P, Q, Dtw(code, 3.5, 0, begin, end, -1, -1, 1, math.inf)) == expected


def per_step_or_fraction(
    pattern: int = 1, window: int = -1, fraction: float = 0.0, normalize: int = 0
) -> Structure:
    return Dtw(0, 2.0, pattern, 0, 0, window, 1, 1, math.inf, fraction, normalize)


def test_distance_per_step_and_window_as_a_fraction(call) -> None:
    symmetric2 = {"step_pattern": "symmetric2"}
    expected = curvewise.dtw(P, Q, normalize=True, **symmetric2)
    assert call("dtw", P, Q, per_step_or_fraction(normalize=1)) == expected
    expected = curvewise.dtw(P, Q, window=0.2, **symmetric2)
    assert expected != curvewise.dtw(P, Q, **symmetric2)
    assert call("dtw", P, Q, per_step_or_fraction(fraction=0.2)) == expected


def relaxed(*relax: int) -> Structure:
    return Dtw(0, 2.0, 0, 0, 0, -1, 1, 1, math.inf, 0.0, 0, 0.0, 6371008.8, *relax)


def test_points_left_out_at_the_ends(call) -> None:
    for relax in ((9, 0, 0, 0), (0, 8, 0, 0), (0, 0, 7, 0), (0, 0, 0, 6), (1, 2, 3, 4)):
        expected = curvewise.dtw(P, Q, relax=relax)
        assert expected != curvewise.dtw(P, Q)
        assert call("dtw", P, Q, relaxed(*relax)) == expected


def closed(name: str, **given: int) -> Structure:
    """Return options of closed curves, by default with the distance of sums of coordinates."""
    options = {
        "dtw": Dtw(2, 2.0, 0, 0, 0, -1, 1, 1, math.inf),
        "frechet": Frechet(2, 2.0, 1, 1, math.inf),
        "frechet_continuous": FrechetContinuous(1),
    }[name]
    for option, value in ({"closed": 1} | given).items():
        setattr(options, option, value)
    return options


@pytest.mark.parametrize("name", ["dtw", "frechet", "frechet_continuous"])
def test_closed_curves(name, call, library) -> None:
    given = {"closed": True} | ({} if name == "frechet_continuous" else {"metric": "cityblock"})
    expected = getattr(curvewise, name)(P, Q, **given)
    assert call(name, P, Q, closed(name)) == expected
    assert call(name, P, Q, closed(name, closed=0)) != expected
    options, value, error = closed(name), c_double(), Error()
    pair, code = curves(P, Q), MEASURES.index(name)
    chosen = byref(pair[0]), byref(pair[1]), code, byref(options)
    assert library.curvewise_evaluate(*chosen, byref(value), byref(error)) == OK
    assert value.value == expected
    out = np.empty(1)
    batch = pair, c_ssize_t(2), code, byref(options), None, doubles(out), byref(error)
    assert library.curvewise_pdist(*batch) == INVALID_ARGUMENT
    assert error.message.decode() == (
        "closed is an option of single pairs; call dtw, frechet or frechet_continuous for each"
    )
    if name != "frechet_continuous":
        path, count = np.empty((len(P) + len(Q), 2), dtype=np.int64), c_ssize_t()
        room = integers(path), c_ssize_t(len(path)), byref(count), byref(error)
        chosen = byref(pair[0]), byref(pair[1]), byref(options), byref(value)
        assert getattr(library, f"curvewise_{name}_path")(*chosen, *room) == OK
        found = getattr(curvewise, f"{name}_path")(P, Q, **given)
        assert value.value == found.distance
        assert path[: count.value].tolist() == found.path.tolist()


def test_cutoff(call) -> None:
    for name, options in (("frechet", Frechet(0, 2.0, 1, 1)), ("dtw", Dtw(0, 2.0, 0, 0, 0, -1, 1))):
        distance = getattr(curvewise, name)(P, Q)
        options.cutoff = distance
        assert call(name, P, Q, options) == distance
        options.cutoff = math.nextafter(distance, 0)
        assert call(name, P, Q, options) == math.inf


def test_planar_options(call) -> None:
    for code, spacing in enumerate(get_args(Spacing)):
        for crossing in ("rearrange", "split"):
            for squared in (False, True):
                given = {"spacing": spacing, "crossing": crossing, "squared": squared}
                codes = (
                    code,
                    ["rearrange", "split"].index(crossing),
                    int(squared),
                )
                pair = [curve[np.argsort(curve[:, 0])] for curve in (P, Q)]
                p, q = pair if spacing == "function" else (P, Q)
                assert call("area", p, q, Area(*codes)) == curvewise.area(p, q, **given)
    for code, crossing in enumerate(get_args(Crossing)):
        expected = curvewise.area(P, Q, crossing=crossing, closed=True)
        assert call("area", P, Q, Area(0, code, 0, 1)) == expected
    assert call("pcm", P, Q, Pcm(17, 0)) == curvewise.pcm(P, Q, offsets=17)
    assert call("pcm", P, Q, Pcm(0, 1)) == curvewise.pcm(P, Q, offsets="continuous")
    for code, scale in enumerate(("mean", "mean_abs", "range")):
        expected = curvewise.curve_length(P, Q, scale=scale)
        assert call("curve_length", P, Q, CurveLength(code)) == expected


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("area", Area(5, 0, 0), "unknown spacing 5; choose from 0 to 4"),
        ("area", Area(0, -1, 0), "unknown crossing -1; choose from 0 to 2"),
        ("area", Area(0, 2, 0), "crossing='polygon' is for closed curves"),
        ("pcm", Pcm(0, 0), "offsets is 0; give a whole number >= 1, or 'continuous'"),
        ("frechet", Frechet(6, 2.0, 1), "unknown metric 6; choose from 0 to 5"),
        ("frechet", Frechet(4, 0.5, 1), "minkowski needs 1 <= p <= inf"),
        ("frechet", Frechet(), "workers is 0"),
        ("frechet", Frechet(0, 2.0, 1, 1, -1.0), "cutoff is -1"),
        ("dtw", Dtw(), "workers is 0"),
        ("dtw", Dtw(0, 2.0, 27, 0, 0, -1, 1), "unknown step_pattern 27; choose from 0 to 26"),
        ("dtw", Dtw(0, 2.0, 1, 1, 0, -1, 1), "open_begin needs step_pattern="),
        ("dtw", per_step_or_fraction(pattern=0, normalize=1), "normalize needs step_pattern="),
        ("dtw", per_step_or_fraction(fraction=1.5), "window is 1.5"),
        ("dtw", relaxed(0, 0, -1, 0), r"relax is \(0, 0, -1, 0\); give four whole numbers"),
        (
            "dtw",
            per_step_or_fraction(window=3, fraction=0.5),
            "window and window_fraction are both",
        ),
        (
            "dtw",
            closed("dtw", step_pattern=1),
            "^closed has no step_pattern; leave its default$",
        ),
        ("dtw", closed("dtw", window=3), "^closed has no window;"),
        ("dtw", closed("dtw", open_end=1), "^closed has no open_end;"),
        ("dtw", closed("dtw", relax_q_begin=1), "^closed has no relax;"),
        ("frechet", closed("frechet", metric=6), "unknown metric 6; choose from 0 to 5"),
        ("curve_length", CurveLength(7), "unknown scale 7; choose from 0 to 2"),
    ],
)
def test_options_refused(name, options, message, call) -> None:
    with pytest.raises(ValueError, match=message):
        call(name, P, Q, options)


@pytest.mark.parametrize("name", MEASURES)
def test_curves_refused(name, call) -> None:
    bad = Q.copy()
    bad[17, 1] = math.nan
    with pytest.raises(ValueError, match=r"^Q\[17, 1\] is nan; curves must be finite$"):
        call(name, P, bad)
    with pytest.raises(ValueError, match=r"^P is a null pointer$"):
        call(name, None, Q)
    nowhere = np.empty((0, 2))
    with pytest.raises(ValueError, match=rf"^P has shape \(0, 2\); {name} needs at least"):
        call(name, nowhere, Q)


def test_null_data_and_results(library) -> None:
    p, error = view(P), Error()
    nothing = Curve(None, 5, 2, 2, 1)
    value = c_double()
    dtw = library.curvewise_dtw
    assert dtw(byref(nothing), byref(p), None, byref(value), byref(error)) == INVALID_ARGUMENT
    assert error.message == b"P->data is a null pointer"
    assert dtw(byref(p), byref(p), None, None, byref(error)) == INVALID_ARGUMENT
    assert error.message == b"value is a null pointer"
    assert dtw(byref(p), byref(p), None, None, None) == INVALID_ARGUMENT
    assert dtw(byref(p), byref(p), None, byref(value), None) == OK


def test_normalize(library) -> None:
    p, q, error = view(P), view(Q), Error()
    out = np.empty_like(Q)
    call = library.curvewise_normalize
    pointer = out.ctypes.data_as(POINTER(c_double))
    assert call(byref(p), byref(q), pointer, byref(error)) == OK
    np.testing.assert_array_equal(out, curvewise.normalize(P, Q)[1])
    one = view(Q[:, :1])
    assert call(byref(p), byref(one), pointer, byref(error)) == INVALID_ARGUMENT
    assert error.message.startswith(b"P has shape (60, 2) and C has shape (45, 1)")


@pytest.mark.parametrize("name", MEASURES)
def test_batches(name, library) -> None:
    XA, XB = [P[:20], P[10:50], Q], [Q[:30], P]
    a, b, error = curves(*XA), curves(*XB), Error()
    out = np.empty((3, 2))
    pointer = out.ctypes.data_as(POINTER(c_double))
    sizes = c_ssize_t(3), c_ssize_t(2)
    code = MEASURES.index(name)
    expected = curvewise.cdist(XA, XB, name)
    cutoff = float(np.median(expected))
    for batch in (None, Batch(2, math.inf), Batch(1, cutoff)):
        status = library.curvewise_cdist(
            a, sizes[0], b, sizes[1], code, None, batch and byref(batch), pointer, byref(error)
        )
        assert (status, error.message) == (OK, b"")
        limit = math.inf if batch is None else batch.cutoff
        np.testing.assert_array_equal(out, np.where(expected > limit, math.inf, expected))


def test_batches_take_the_options_of_their_measure(library) -> None:
    X = [P[:20], P[10:50], Q]
    error, out = Error(), np.empty(3)
    pointer, count = out.ctypes.data_as(POINTER(c_double)), c_ssize_t(3)
    options = Dtw(2, 2.0, 1, 0, 0, -1, 1, 1, math.inf)
    arguments = byref(options), None, pointer, byref(error)
    assert library.curvewise_pdist(curves(*X), count, 3, *arguments) == OK
    expected = curvewise.pdist(X, "dtw", metric="cityblock", step_pattern="symmetric2")
    np.testing.assert_array_equal(out, expected)

    def refused(curves_given, count, measure, pointer=pointer) -> str:
        arguments = None, None, pointer, byref(error)
        status = library.curvewise_pdist(curves_given, c_ssize_t(count), measure, *arguments)
        assert status == INVALID_ARGUMENT
        return error.message.decode()

    assert refused(curves(*X), 3, 6) == "unknown measure 6; choose from 0 to 5"
    assert refused(curves(*X), -1, 3) == "X has -1 curves; give a whole number >= 0"
    assert refused(None, 3, 3) == "X is a null pointer"
    assert refused(curves(*X), 3, 3, None) == "out is a null pointer"
    assert "d(P, Q) = d(Q, P)" in refused(curves(*X), 3, 1)
    holes = (Curve * 2)(view(P), Curve(None, 5, 2, 2, 1))
    assert refused(holes, 2, 3) == "X[1]->data is a null pointer"


MATERIALS = [
    ("chaboche-voce", ChabocheVoce(), (200e3, 300.0, -50.0, 8.0, 80e3, 400.0, 5e3, 20.0)),
    (
        "chaboche-voce backstresses=1 modulus=decaying",
        ChabocheVoce(1, "decaying"),
        (200e3, 160e3, 30.0, 300.0, -50.0, 8.0, 80e3, 400.0),
    ),
    ("yoshida-uemori", YoshidaUemori(), (200e3, 420.0, 300.0, 300.0, 12.0, 150.0, 120.0, 0.4)),
    ("swift", Swift(), (200e3, 720.0, 0.004, 0.21)),
    ("johnson-cook rate=1e3", JohnsonCook(rate=1e3), (200e3, 350.0, 275.0, 0.36, 0.022)),
    (
        "  yoshida-uemori rtol=1e-6  growth=power ",
        YoshidaUemori(growth="power", rtol=1e-6),
        (200e3, 420.0, 300.0, 300.0, 12.0, 150.0, 120.0, 0.4, 0.01, 0.3),
    ),
]


def driven(library, text, parameters, strain, *, slopes=None, stress=None, n=None):
    """Return status, message and stresses of a material of C."""
    stress, error = np.full(len(strain), math.nan) if stress is None else stress, Error()
    pointers = [
        None if array is None else array.ctypes.data_as(POINTER(c_double))
        for array in (np.array(parameters), np.asarray(strain), stress, slopes)
    ]
    status = library.curvewise_material_stress(
        text.encode(),
        pointers[0],
        c_ssize_t(len(parameters)),
        pointers[1],
        c_ssize_t(len(strain) if n is None else n),
        *pointers[2:],
        byref(error),
    )
    return status, error.message.decode(), stress


@pytest.mark.parametrize(("text", "material", "constants"), MATERIALS)
def test_materials(text, material, constants, library) -> None:
    strain = np.array([0.001, 0.02, 0.018, -0.02, 0.03])
    named = dict(zip(material.names, constants, strict=True))
    expected, slopes = material.stress_and_slopes(strain, named)
    found = np.full(slopes.shape, math.nan)
    assert driven(library, text, constants, strain, slopes=found)[:2] == (OK, "")
    np.testing.assert_array_equal(found, slopes)
    np.testing.assert_array_equal(driven(library, text, constants, strain)[2], expected)


@pytest.mark.parametrize(("text", "material", "constants"), MATERIALS)
def test_response_to_stresses(text, material, constants, library) -> None:
    named = dict(zip(material.names, constants, strict=True))
    parameters, count = np.array(constants), c_ssize_t(len(constants))
    respond, error = library.curvewise_material_response, Error()
    for by_stress in ([1, 0, 7, 0], None):
        given = np.array([350.0, 0.02, -300.0, -0.01] if by_stress else [350.0, 400.0, -350.0, 0.0])
        flags = None if by_stress is None else (c_int * 4)(*by_stress)
        answer, slopes = np.full(4, math.nan), np.full((4, len(constants)), math.nan)
        for place in (None, doubles(slopes)):
            status = respond(
                text.encode(),
                doubles(parameters),
                count,
                doubles(given),
                flags,
                c_ssize_t(4),
                doubles(answer),
                place,
                byref(error),
            )
            assert status == OK, error.message
        expected = material.response_and_slopes(
            given, True if by_stress is None else np.array(by_stress) != 0, named
        )
        np.testing.assert_array_equal(answer, expected[0])
        np.testing.assert_array_equal(slopes, expected[1])
    none = respond(
        text.encode(), doubles(parameters), count, None, None, c_ssize_t(-1), None, None, None
    )
    assert none == INVALID_ARGUMENT


def test_materials_refused(library) -> None:
    text, _, constants = MATERIALS[0]
    strain = np.array([0.001, math.nan])

    def refused(*given, **others) -> str:
        status, message, stress = driven(library, *given, **others)
        assert status == INVALID_ARGUMENT
        assert np.isnan(stress).all()
        return message

    assert refused(text, constants, strain) == "strain[1] is nan; strains must be finite"
    expected = "there are 3 parameters; the material has 8: E, yield, Q, b, C1, gamma1, C2, gamma2"
    assert refused(text, constants[:3], strain) == expected
    assert "there are -2 strains" in refused(text, constants, strain, n=-2)
    for wrong, message in {
        "chaboche": f"unknown material 'chaboche'; choose from {', '.join(MATERIALS_OF_PYTHON)}",
        "": f"unknown material ''; choose from {', '.join(MATERIALS_OF_PYTHON)}",
        f"{text} modulus=5": "unknown modulus '5'; choose from constant, decaying",
        f"{text} modulus": "unknown modulus ''; choose from constant, decaying",
        f"{text} backstresses=-1": "backstresses is -1; give a whole number from 0 to 99",
        f"{text} backstresses=2.5": "backstresses is 2.5; give a whole number",
        f"{text} backstresses=": "backstresses is ; give a whole number",
        f"{text} growth=power": "unknown option 'growth' of chaboche-voce; choose from "
        "backstresses, modulus",
        "yoshida-uemori growth=2": "unknown growth '2'; choose from saturating, power",
        "yoshida-uemori rtol=1e-6x": "rtol is 1e-6x; give a number",
        "yoshida-uemori rtol=0.5": "rtol is 0.5; give a number from 1e-12 to 1e-3",
    }.items():
        numbers = MATERIALS[2][2] if wrong.startswith("yoshida") else constants
        assert refused(wrong, numbers, [0.0]) == message
    function, error = library.curvewise_material_stress, Error()
    for given, missing in ((text.encode(), b"parameters"), (None, b"material")):
        none = function(given, None, c_ssize_t(8), None, c_ssize_t(0), None, None, byref(error))
        assert (none, error.message) == (INVALID_ARGUMENT, missing + b" is a null pointer")


def test_version(library) -> None:
    library.curvewise_version.restype = c_char_p
    assert library.curvewise_version().decode() == curvewise.__version__


def test_what_is_no_argument_is_a_failure(library) -> None:
    """CURVEWISE_ISA names a level that no machine has."""
    program = (
        "import ctypes, sys\n"
        "library = ctypes.CDLL(sys.argv[1])\n"
        "point = (ctypes.c_double * 2)()\n"
        "curve = (ctypes.c_ssize_t * 5)(ctypes.addressof(point), 1, 2, 2, 1)\n"
        "error, value = ctypes.create_string_buffer(256), ctypes.c_double()\n"
        "print(library.curvewise_dtw(curve, curve, None, ctypes.byref(value), error))\n"
        "print(error.value.decode())\n"
    )
    done = run(sys.executable, "-c", program, library._name, CURVEWISE_ISA="v9")
    assert done.stdout.startswith(f"{FAILED}\nCURVEWISE_ISA is 'v9'; this machine has baseline")
