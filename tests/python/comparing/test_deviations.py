"""What a value means in units of y: by hand, against the values, and where it means nothing."""

from __future__ import annotations

from importlib import import_module
from typing import Any, get_args

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import curvewise
from curvewise._options import Spacing
from curvewise.comparing.comparison import PRESETS
from curvewise.comparing.deviations import Deviation, deviation
from curvewise.measures.registry import Condition

Array = npt.NDArray[np.float64]

LOOP, SIMULATION = curvewise.datasets.hysteresis_pair()
HEIGHT = float(np.ptp(LOOP[:, 1]))


def of(measure: str, P: Any, Q: Any, preset: Any = "raw", **options: Any) -> Deviation:
    compared = curvewise.compare(
        P, Q, preset=preset, measures=[measure], options={measure: options}
    )
    return compared.deviations[measure]


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_of_a_curve_that_was_moved_up_it_is_by_how_much(preset: Any) -> None:
    P = np.array([(0.0, 0.0), (0.01, 300.0), (0.02, 400.0), (0.0, -200.0)])
    raised = P + np.array((0.0, 3.0))
    assert of("frechet", P, raised, preset) == pytest.approx((3.0, 3.0, 600.0), rel=1e-12)
    line, above = (
        P[:2],
        raised[:2],
    )  # parallel: the distance could be smaller, except at the ends
    assert of("frechet_continuous", line, above, preset)[1:] == pytest.approx((3.0, 300.0))
    # "matched" cuts the corner at the turn.
    tolerance = 0.02 if preset == "scaled" else 1e-12
    assert of("area", P, raised, preset) == pytest.approx((3.0, 3.0, 600.0), rel=tolerance)


def test_it_is_printed_in_per_cent_of_the_height() -> None:
    assert str(Deviation(29.0, 88.04, 1000.0)) == "mean 29 (2.9 %), largest 88.04 (8.8 %)"
    assert str(Deviation(0.5, 1.0, 0.0)) == "mean 0.5, largest 1"
    assert str(Deviation(1052.3, 1980.0, 1798.0)) == "mean 1052 (59 %), largest 1980 (110 %)"
    assert str(Deviation(np.inf, 2.0, 4.0)) == "mean inf, largest 2 (50 %)"


@pytest.mark.parametrize("preset", ["scaled", "raw"])
@pytest.mark.parametrize("measure", ["dtw", "frechet"])
def test_along_a_path(measure: str, preset: Any) -> None:
    P, Q = curvewise.normalize(LOOP, SIMULATION) if preset == "scaled" else (LOOP, SIMULATION)
    unit = HEIGHT if preset == "scaled" else 1.0
    path = getattr(curvewise, f"{measure}_path")(P, Q).path
    found = of(measure, LOOP, SIMULATION, preset)
    value = getattr(curvewise, measure)(P, Q)
    if measure == "dtw":
        assert found.mean == pytest.approx(value / len(path) * unit, rel=1e-12)
    else:
        assert found.largest == pytest.approx(value * unit, rel=1e-12)
    assert 0.0 < found.mean <= found.largest
    assert found.height == HEIGHT


def test_mean_leash_of_a_continuous_matching() -> None:
    # The pair distance of a walk from one end to the other is 1 at the first end and 3 at the last.
    found = of("frechet_continuous", [(0, 0), (8, 0)], [(0, 1), (8, 3)])
    assert found.largest == 3.0
    assert 1.5 < found.mean < 3.0
    assert of("frechet_continuous", [(1, 2)], [(4, 6)]) == (5.0, 5.0, 0.0)
    scaled = of("frechet_continuous", LOOP, SIMULATION, "scaled")
    value = curvewise.frechet_continuous(*curvewise.normalize(LOOP, SIMULATION))
    assert scaled.largest == pytest.approx(value * HEIGHT, rel=1e-12)
    assert 0.0 < scaled.mean < scaled.largest


@pytest.mark.parametrize("preset", ["scaled", "paper"])
def test_area_by_how_far_the_reference_travels(preset: Any) -> None:
    value = curvewise.compare(LOOP, SIMULATION, preset=preset)["area"]
    if preset == "scaled":
        value *= HEIGHT * float(np.ptp(LOOP[:, 0]))
    x = LOOP[:, 0]
    turns = [i for i in range(1, len(x) - 1) if (x[i] - x[i - 1]) * (x[i + 1] - x[i]) < 0]
    travel = np.abs(np.diff(x[[0, *turns, -1]])).sum()
    assert of("area", LOOP, SIMULATION, preset).mean == pytest.approx(value / travel, rel=0.01)


def test_area_faces_vertices_where_quadrilaterals_are_rearranged() -> None:
    P, Q = [(0, 1), (1, -1)], [(0, -3), (1, 3)]
    assert of("area", P, Q, crossing="rearrange").largest == 4.0
    assert of("area", P, Q, crossing="split") == (2.0, 4.0, 2.0)


def test_area_of_curves_without_an_extent_in_x_has_the_mean_of_facing_points() -> None:
    assert of("area", [(0, 0), (0, 1)], [(1, 0), (1, 1)]) == (1.0, 1.0, 1.0)
    assert of("area", [(0, 0), (0, 2)], [(1, 0), (3, 2)]).mean == pytest.approx(2.0)


def test_area_of_other_units_has_no_mean_above_the_largest() -> None:
    per_cent = SIMULATION * (100.0, 1.0)
    for preset in ("scaled", "raw", "paper"):
        found = of("area", LOOP, per_cent, preset)
        assert 0.1 * found.largest < found.mean <= found.largest
    # If the curves travel in parallel, the mean remains the area by how far the reference travels.
    assert str(of("area", LOOP, SIMULATION, "scaled")).startswith("mean 54.09 ")


COORDINATES = st.integers(-4, 4).map(float) | st.floats(-3, 3) | st.floats(-1.7e308, 1.7e308)
PLANAR = st.lists(st.tuples(COORDINATES, COORDINATES), min_size=2, max_size=9).map(np.array)
FACTORS = st.sampled_from([1.0, 100.0, 1e6, 1e-6, 1e-300, 1e300])
MEASURES: list[tuple[str, dict[str, Any]]] = [
    *(("area", {"spacing": spacing}) for spacing in get_args(Spacing)),
    ("area", {"spacing": "distance", "crossing": "rearrange"}),
    ("area", {"spacing": "matched", "squared": True}),
    ("pcm", {}),
    ("frechet", {}),
    ("frechet_continuous", {}),
    ("dtw", {"step_pattern": "symmetric2"}),
]


PRESET_NAMES = ["scaled", "raw"]


@settings(derandomize=True, deadline=None)
@given(st.sampled_from(MEASURES), st.sampled_from(PRESET_NAMES), PLANAR, PLANAR, FACTORS, FACTORS)
def test_the_largest_is_never_below_the_mean(
    measure: tuple[str, dict[str, Any]], preset: str, P: Array, Q: Array, x: float, y: float
) -> None:
    with np.errstate(over="ignore"):
        Q = Q * (x, y)
    assume(np.isfinite(Q).all())
    try:
        found = of(measure[0], P, Q, preset, **measure[1])
    except ValueError as error:
        refused = ("zero length", "reverses in x", "needs a common span")
        assume(not any(words in str(error) for words in refused))
        raise
    assert 0.0 <= found.mean <= found.largest


def test_pcm_by_the_length_of_the_curve_that_is_mapped() -> None:
    match = curvewise.pcm_match(LOOP, SIMULATION)
    mapped = LOOP if match.mapped == "P" else SIMULATION
    scaled = curvewise.normalize(LOOP, mapped)[1]
    length = np.hypot(*np.diff(scaled, axis=0).T).sum()
    found = of("pcm", LOOP, SIMULATION)
    assert found.mean == pytest.approx(match.value / length * HEIGHT, rel=1e-12)
    assert found.largest > found.mean


@pytest.mark.parametrize(
    ("measure", "options", "same_as"),
    [
        ("area", {"squared": True}, {}),
        ("dtw", {"step_pattern": "symmetric2", "normalize": True}, {"step_pattern": "symmetric2"}),
        ("dtw", {"cutoff": 1e-9}, {}),
        ("frechet", {"cutoff": 1e-9}, {}),
    ],
)
def test_options_of_the_value_alone_do_not_change_it(
    measure: str, options: dict[str, Any], same_as: dict[str, Any]
) -> None:
    expected = of(measure, LOOP, SIMULATION, **same_as)
    assert of(measure, LOOP, SIMULATION, **options) == expected


def test_options_of_the_path_do() -> None:
    assert of("dtw", LOOP[20:], SIMULATION) != of("dtw", LOOP[20:], SIMULATION, open_begin=True)
    assert of("area", LOOP, SIMULATION[::3]) != of("area", LOOP, SIMULATION[::3], spacing="matched")


def test_curves_of_any_dimension() -> None:
    assert of("frechet", [0.0, 1.0, 4.0], [0.5, 1.0, 4.0], "scaled") == (0.5 / 3, 0.5, 4.0)
    P = np.array([(0.0, 0.0, 0.0), (1.0, 2.0, 8.0)])
    found = of("dtw", P, P + np.array((0.0, 0.0, 2.0)), "scaled")
    assert found == (2.0, 2.0, 8.0)


def test_a_flat_reference_has_no_height_to_measure_by() -> None:
    for measure in ("area", "frechet", "dtw"):
        found = of(measure, [(0, 1), (2, 1)], [(0, 4), (2, 4)], "scaled")
        assert found == pytest.approx((3.0, 3.0, 0.0), rel=1e-12)


def test_beyond_the_range_of_a_double_it_is_infinite() -> None:
    found = of("dtw", [-1.5e308, 0.0, 1.5e308], [1.5e308, 0.0, -1.5e308])
    assert found.height == np.inf
    assert str(found).startswith("mean inf")


def test_a_simulation_that_is_matched_to_a_part_of_the_experiment() -> None:
    condition = Condition(False, {"open_end": True})
    branch = LOOP[:20] + np.array((0.0, 1.0))
    found = deviation("dtw", condition, LOOP, branch, part="simulation")
    path = curvewise.dtw_path(branch, LOOP, open_end=True)
    assert found == (path.distance / len(path.path), found.largest, HEIGHT)
    assert found.largest < 0.1 * deviation("dtw", condition, LOOP, branch).largest


def test_curve_length_compares_no_points() -> None:
    assert deviation("curve_length", PRESETS["raw"]["curve_length"], LOOP, SIMULATION) is None
    compared = curvewise.compare(LOOP, SIMULATION)
    assert list(compared.deviations) == ["area", "pcm", "frechet", "dtw"]


def test_compare_does_not_wait_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> None:
        raise AssertionError("computed although nobody has asked")

    monkeypatch.setattr(import_module("curvewise.comparing.comparison"), "deviation", fail)
    compared = curvewise.compare(LOOP, SIMULATION)
    assert "area" in str(compared)
    with pytest.raises(AssertionError):
        _ = compared.deviations


def test_options_in_the_place_of_the_presets() -> None:
    given = {"area": {"spacing": "distance"}, "dtw": {"window": 0.2}}
    found = curvewise.compare(LOOP, SIMULATION, options=given)
    P, Q = curvewise.normalize(LOOP, SIMULATION)
    assert found["area"] == curvewise.area(P, Q, crossing="split")
    assert found["dtw"] == curvewise.dtw(P, Q, window=0.2)
    assert found["pcm"] == curvewise.compare(LOOP, SIMULATION)["pcm"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"aera": {}}, r"^unknown measure 'aera'; choose from area, "),
        ({"dtw": {"window": 3}}, r"^options are given for 'dtw', which is not among the measures$"),
        ({"area": {"spacing": "even"}}, r"^unknown spacing 'even'; choose from "),
    ],
)
def test_options_that_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        curvewise.compare(LOOP, SIMULATION, measures=["area"], options=options)
    with pytest.raises(TypeError):
        curvewise.compare(LOOP, SIMULATION, options={"area": {"window": 3}})
