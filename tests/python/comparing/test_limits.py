"""Measures against limits: values, percentages, and where a limit is exceeded."""

from __future__ import annotations

import json

import numpy as np
import pytest

import curvewise
from curvewise.comparing.deviations import largest_places

PAIRED = ["area", "pcm", "frechet", "dtw", "frechet_continuous"]


@pytest.fixture
def compared():
    """A comparison of all measures that pair points, and one of a measure that does not."""
    pair = curvewise.datasets.hysteresis_pair()
    return curvewise.compare(*pair, measures=[*PAIRED, "curve_length"])


def test_a_value_is_within_up_to_its_limit(compared):
    for name, value in compared.values.items():
        (check,) = compared.within({name: value}).checks
        assert check == (name, value, value, "", None)
        assert compared.within({name: value})
        verdict = compared.within({name: np.nextafter(value, 0.0)})
        assert not verdict
        assert (verdict.checks[0].places is None) == (name == "curve_length")
    both = compared.within({"area": 1.0, "frechet": 1e-3})
    assert not both
    assert [check.passed for check in both.checks] == [True, False]


def test_percentages_are_those_of_the_deviations(compared):
    for name, found in compared.deviations.items():
        share = found.largest if name.startswith("frechet") else found.mean
        (check,) = compared.within({name: "3%"}).checks
        assert check.value == pytest.approx(100.0 * share / found.height, rel=1e-12)
        assert (check.limit, check.unit) == (3.0, "%")
        assert check.passed == (check.value <= 3.0)
    assert compared.within({"area": " 4.0 % "})
    assert not compared.within({"area": "3.9%"})


@pytest.mark.parametrize("preset", ["scaled", "raw"])
@pytest.mark.parametrize("measure", PAIRED)
def test_places_are_the_points_with_the_largest_deviation(measure, preset):
    x = np.linspace(0.0, 4.0, 81)
    P = np.column_stack((10.0 + x, 100.0 + 20.0 * np.sin(x)))
    Q = P + np.array([0.0, 0.01])
    Q[37, 1] += 9.0
    compared = curvewise.compare(P, Q, measures=[measure], preset=preset)
    (check,) = compared.within({measure: 0.0}).checks
    in_p, in_q = check.places
    if measure != "pcm":  # which pairs by arc length
        assert in_q == pytest.approx(Q[37], rel=1e-9)
    found = compared.deviations[measure]
    is_scaled = compared.conditions[measure].scaled or measure == "pcm"
    box = np.ptp(P, axis=0) if is_scaled else np.ones(2)
    gap = np.hypot(*((np.array(in_p) - in_q) / box))
    unit = found.height if is_scaled else 1.0
    assert gap * unit == pytest.approx(found.largest, rel=1e-9)


def test_pcm_names_the_points_of_p_and_q_whichever_is_mapped():
    x = np.linspace(0.0, 1.0, 41)
    P = np.column_stack((x, x**2))
    for short, long in ((P[5:30], P), (P, P[5:30])):
        condition = curvewise.compare(short, long, measures=["pcm"]).conditions["pcm"]
        in_p, in_q = largest_places("pcm", condition, short, long + np.array([0.0, 3.0]))
        assert in_p[1] <= 1.0
        assert in_q[1] >= 2.9


def test_series_have_places_too():
    P, Q = np.zeros(9), np.zeros(9)
    Q[4] = 2.0
    verdict = curvewise.compare(P, Q, measures=["frechet"], preset="raw").within({"frechet": 1.0})
    assert verdict.checks[0].places == ((0.0,), (2.0,))


def test_text_names_limits_and_places(compared):
    text = str(compared.within({"area": "2%", "curve_length": 0.2, "frechet": 0.08}))
    area, length, frechet = text.splitlines()
    assert area.startswith("area 3.996 %, above its limit 2 %; largest deviation between (0.01911")
    assert length == "curve_length 1.084, above its limit 0.2"
    assert frechet == "frechet 0.07264, within its limit 0.08"
    assert repr(compared.within({"frechet": 0.08})) == frechet  # what pytest prints


def test_a_measure_without_a_value_is_not_within():
    P = [(0.0, 0.0), (1.0, 0.0)]
    compared = curvewise.compare(P, P, measures=["frechet", "curve_length"])
    verdict = compared.within({"curve_length": 1.0})
    assert not verdict
    assert str(verdict) == "curve_length has no value; its limit is 1"
    assert json.loads(json.dumps(verdict.to_list()))[0]["value"] is None


def test_json_has_the_checks(compared):
    (area,) = json.loads(json.dumps(compared.within({"area": "2%"}).to_list()))
    assert (area["measure"], area["limit"], area["unit"], area["within"]) == (
        *("area", 2.0, "%"),
        False,
    )
    assert [len(place) for place in area["places"]] == [2, 2]


def test_wrong_limits(compared):
    for limit in ("much", "2 MPa", "%", ""):
        with pytest.raises(ValueError, match=r"limit is .*; give a number, or a text such as '2%'"):
            compared.within({"area": limit})
    for limit in (-1.0, "-1%", None, np.nan):
        with pytest.raises(ValueError, match=r"limit is .*; give a number, or a text such as '2%'"):
            compared.within({"area": limit})
    with pytest.raises(ValueError, match=r"'hausdorff' is not among the measures: area, pcm"):
        compared.within({"hausdorff": 1.0})
    with pytest.raises(ValueError, match=r"curve_length has no deviation in %; give a value of"):
        compared.within({"curve_length": "2%"})
    flat = curvewise.compare([(0, 1), (1, 1)], [(0, 1), (1, 2)], measures=["frechet"])
    with pytest.raises(ValueError, match=r"P has no height, of which frechet could be limited in"):
        flat.within({"frechet": "2%"})
