"""compare as a test that passes or fails: --within, --tube and --common-span."""

from __future__ import annotations

import json

import numpy as np
import pytest
from command_runs import USAGE, assert_failed

import curvewise
from curvewise import read_curve


def test_limits_decide_the_exit_status(run, files):
    P, Q = map(read_curve, files)
    compared = curvewise.compare(P, Q, measures=["area", "frechet"])
    status, out, error = run("compare", *files, "--within", "area=90%", "frechet=2")
    assert (status, error) == (0, "")
    assert f"\nlimits\n{compared.within({'area': '90%', 'frechet': 2})}\n" in out
    assert "dtw" not in out  # the measures with a limit are those computed
    status, out, error = run("compare", *files, "--within", "area=0.01%", "frechet=2")
    assert status == 1
    assert error == "curvewise: B.csv is outside its limits: area\n"
    assert f"\nlimits\n{compared.within({'area': '0.01%', 'frechet': 2})}\n" in out
    assert "largest deviation between (" in out
    status, _, error = run("compare", *files, "--within", "area=0", "--tube", "1e-9", "1e-9")
    assert (status, error) == (1, "curvewise: B.csv is outside its limits: area, tube\n")


def test_measures_and_limits_are_joined(run, files):
    status, out, _ = run(
        "compare", *files, "--measures", "dtw", "area", "--within", "frechet=9", "area=9", "--json"
    )
    assert status == 0
    assert list(json.loads(out)["values"]) == ["dtw", "area", "frechet"]


def test_a_tube_has_numbers_or_percentages_of_the_extents(run, files):
    P, Q = map(read_curve, files)
    for dx, dy in ((0.002, 50.0), (1.0, 1e4)):
        expected = curvewise.tube(P, Q, dx, dy)
        status, out, _ = run("compare", *files, "--tube", str(dx), str(dy))
        assert status == (0 if expected else 1)
        assert f"\nlimits\ntube: {expected}\n" in out
    status, out, _ = run("compare", *files, "--tube", "10%", "500%", "--json")
    size = np.ptp(P, axis=0) * [0.1, 5.0]
    loaded = json.loads(out)
    assert [loaded["tube"][name] for name in ("dx", "dy")] == pytest.approx(size)
    assert loaded["tube"]["within"] == (status == 0)


def test_the_common_span_is_compared(run, files):
    t = np.linspace(0.0, 2.0, 41)
    np.savetxt("A.csv", np.column_stack((t, np.sin(t))), delimiter=",")
    np.savetxt("B.csv", np.column_stack((t, np.sin(t)))[:30], delimiter=",")
    assert run("compare", *files, "--tube", "0.01", "0.01")[0] == 1
    status, out, _ = run("compare", *files, "--tube", "0.01", "0.01", "--common-span")
    assert status == 0
    assert "A.csv, 30 points" in out
    np.savetxt("B.csv", [(0, 0), (1, 1), (0.5, 2)], delimiter=",")
    assert_failed(
        run("compare", *files, "--common-span"), "column 0 of Q reverses at row 2", "Q is B.csv"
    )


def test_json_has_the_limits(run, files):
    status, out, _ = run("compare", *files, "--within", "area=0.01%", "--json")
    loaded = json.loads(out)
    assert status == 1
    assert loaded["limits"][0]["within"] is False
    assert "tube" not in loaded
    assert "limits" not in json.loads(run("compare", *files, "--json")[1])


def test_a_measure_that_refuses_the_curves_is_not_within(run, files):
    np.savetxt("A.csv", [(0, 0), (1, 0)], delimiter=",")
    np.savetxt("B.csv", [(0, 0), (1, 0)], delimiter=",")
    status, out, error = run("compare", *files, "--within", "frechet=1", "curve_length=1")
    assert status == 1
    assert "curve_length has no value; its limit is 1" in out
    assert error.endswith("curvewise: B.csv is outside its limits: curve_length\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--within", "area"), "expected MEASURE=LIMIT, such as area=2%; got 'area'"),
        (("--within", "aera=2"), "unknown measure 'aera'; choose from area, pcm"),
        (("--within", "area=two"), "limit is 'two'; give a number, or a text such as '2%', as the"),
        (("--within", "area=-1"), "give a number"),
        (("--tube", "1"), "expected 2 arguments"),
        (("--tube", "0", "1"), "expected a number above 0, or 1%; got '0'"),
        (("--tube", "1", "wide"), "expected a number above 0, or 1%; got 'wide'"),
        (("--tube", "1", "inf"), "expected a number above 0, or 1%; got 'inf'"),
    ],
)
def test_wrong_usage(run, files, arguments, message):
    status, _, error = run("compare", *files, *arguments)
    assert status == USAGE
    assert message in error


def test_a_percentage_of_no_extent(run, files):
    np.savetxt("A.csv", [(0, 1), (1, 1)], delimiter=",")
    assert_failed(
        run("compare", *files, "--measures", "frechet", "--tube", "1", "2%"),
        "the tube has 2% of an extent of P that is 0; give a number",
    )
