"""What identify says before the first run, and while it runs: noise, wide bounds, the progress."""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap
import warnings

import numpy as np
import pytest
from test_methods import BOUNDS, TRUE, model, with_noise

from curvewise import calibration
from curvewise.calibration import (
    Below,
    Case,
    Criterion,
    Log,
    SimulationStore,
    TrustRegion,
    cross_validate,
    identify,
    identify_each,
)
from curvewise.curves.named_curve import NamedCurve

NOISY = with_noise(model(TRUE), 4.0, seed=1)
ONE_RUN = {"max_runs": 1, "progress": False}
EFFECTS = {
    "curve_length": "noise increases the lengths that curve_length compares",
    "pcm": "noise increases the lengths that pcm compares",
    "frechet": "frechet is decided by the one point that noise moves most",
}
REMEDY = ": filter the test (curvewise.curves.smooth), or take another measure"


@pytest.fixture
def said():
    """Return the warnings that are given, and whatever else a test adds, in their order."""
    heard = []
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, category, file, *_: heard.append(
            (category, str(message), file)
        )
        yield heard


@pytest.mark.parametrize("measure", EFFECTS)
def test_noise_is_spoken_of_once_before_the_first_run(measure, said):
    def watched(parameters):
        said.append("run")
        return model(parameters)

    identify(watched, NOISY, BOUNDS, measure=measure, max_runs=6, progress=False)
    assert said[1:] == ["run"] * 6
    category, message, file = said[0]
    assert (category, file) == (calibration.NoisyTestWarning, __file__)
    noise = "the test has noise of about 3.8 in y (0.33 % of its extent), and "
    assert message == f"{noise}{EFFECTS[measure]}{REMEDY}"


@pytest.mark.parametrize("measure", ["area", "dtw", *EFFECTS])
def test_noise_that_does_no_harm_is_not_spoken_of(measure):
    """It averages out, or it is very small. Here warnings are errors."""
    test = NOISY if measure in ("area", "dtw") else with_noise(model(TRUE), 0.2, seed=1)
    identify(model, test, BOUNDS, measure=measure, **ONE_RUN)


def test_a_measure_of_ones_own_is_not_spoken_of():
    class Own:
        __hash__ = None

        def __call__(self, P, Q):
            return float(np.abs(P - Q).max())

    identify(model, NOISY, BOUNDS, measure=Own(), **ONE_RUN)


def test_noise_in_the_words_of_the_tests(said):
    stress = NamedCurve(NOISY, ("strain", "stress"))
    loops = [model(TRUE), stress, with_noise(model(TRUE), 8.0, seed=1)]
    identify(lambda p: [model(p)] * 2, loops[:2], BOUNDS, measure="pcm", **ONE_RUN)
    identify(lambda p: [model(p)] * 3, loops, BOUNDS, measure="pcm", **ONE_RUN)
    cases = [Case("cycle", model, NOISY, measure="frechet"), Case("area", model, NOISY)]
    identify(cases, bounds=BOUNDS, **ONE_RUN)
    beginnings = [message.partition(" (0.")[0] for _, message, _ in said]
    assert beginnings == [
        "Loop 1 has noise of about 3.8 in stress",
        "2 tests have noise, Loop 2 of about 7.6 in y",
        "cycle has noise of about 3.8 in y",
    ]


def test_several_searches_speak_once(said):
    keywords = {**ONE_RUN, "bounds": {**BOUNDS, "C": (1e4, 2e5)}}
    identify_each(model, NOISY, **keywords)
    cross_validate(
        lambda p: [model(p)] * 2, [NOISY] * 2, measure=Criterion("pcm", weights=[1, 2]), **keywords
    )
    noise, wide = calibration.NoisyTestWarning, calibration.WideBoundsWarning
    assert [category for category, *_ in said] == [noise, wide, noise, wide]
    together = " and ".join(EFFECTS.values())
    assert said[0][1].endswith(f", and {together}{REMEDY}")
    assert said[2][1].startswith("2 tests have noise")


@pytest.mark.parametrize("count", [60, 500])
@pytest.mark.parametrize("sigma", [1e-3, 1e-2, 0.1])
@pytest.mark.parametrize("places", ["even", "uneven", "there and back"])
def test_the_noise_of_a_curve_alone(places, sigma, count):
    random = np.random.default_rng(2)
    x = np.linspace(0.0, 1.0, count)
    if places == "uneven":
        x = np.sort(random.random(count))
    elif places == "there and back":
        x = np.abs(2.0 * x - 1.0)
    clean = np.column_stack((x, np.sin(4.0 * x)))
    estimated = calibration.objective.noisy_tests.estimated_noise
    assert estimated(clean, 1) < 1e-4
    noisy = clean + np.column_stack((np.zeros(count), random.normal(0.0, sigma, count)))
    assert estimated(noisy, 1) == pytest.approx(sigma, rel=0.3)
    assert estimated(noisy[:8], 1) == 0.0


@pytest.mark.parametrize(
    ("bounds", "wide"),
    [
        ({"a": (1.0, 11.0), "b": (0.0, 1.0), "c": (2, 300)}, "a (1 to 11), c (2 to 300)"),
        ({"a": (1.0, 10.0)}, None),
        ({"a": Log(1.0, 100.0)}, None),
        ({"a": (0.0, 100.0)}, None),
        ({"a": (-1.0, 100.0)}, None),
        ({"a": Log(1.0, 100.0), "b": Below("a", 1.0, 100.0)}, None),
    ],
)
def test_bounds_over_more_than_a_decade(bounds, wide, said):
    x = np.linspace(0.0, 1.0, 10)

    def line(parameters):
        said.append("run")
        return np.column_stack((x, parameters["a"] * x))

    identify(line, line({"a": 2.0}), bounds, **ONE_RUN)
    if wide is None:
        assert set(said) == {"run"}
    else:
        assert said[1][:2] == (
            calibration.WideBoundsWarning,
            f"the bounds of {wide} go over more than a decade: a logarithmic scale searches small "
            "values like large ones, Log(low, high), in a study scale = 'log'",
        )


def test_every_number_of_the_progress_has_a_name(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr("curvewise.calibration.problem.evaluations._PAUSE", 0.0)
    store = SimulationStore(tmp_path / "s.db", version="1")
    one = TrustRegion(starts=1)
    identify(model, model(TRUE), BOUNDS, store=store, method=one, max_runs=6)
    first = capsys.readouterr().err
    identify(model, model(TRUE), BOUNDS, store=store, method=one, max_runs=9)
    again = capsys.readouterr().err
    line = re.compile(
        r"(trust-region: )?\d\d:\d\d, \d+( of at most [69])? runs(, \d+ of them from the store)?"
        r"(, best value [\d.e+-]+)?(, waiting for \d+ runs?|, choosing the next run)? *"
    )
    for text in (first, again):
        for shown in re.split("[\r\n]+", text.strip()):
            assert line.fullmatch(shown), shown
    assert "0 of at most 6 runs, waiting for 4 runs" in first
    assert ", choosing the next run" in first
    assert re.search(r"6 of at most 6 runs, best value [\d.e+-]+ *\n$", first)
    assert re.search(
        r"9 of at most 9 runs, 6 of them from the store, best value [\d.e+-]+ *\n$", again
    )


def test_a_notebook_has_one_line_and_no_warning():
    """In a kernel without widgets, about which tqdm.auto warns."""
    script = """
        import sys, types
        for name in ("IPython", "ipykernel.zmqshell"):
            sys.modules[name] = types.ModuleType(name)
        sys.modules["IPython"].get_ipython = lambda: types.SimpleNamespace(config=["IPKernelApp"])
        sys.modules["ipywidgets"] = None
        import numpy as np
        import curvewise
        from curvewise.calibration import identify
        x = np.linspace(0.0, 1.0, 9)
        line = lambda p: np.column_stack((x, p["a"] * x))
        identify(line, line({"a": 2.0}), {"a": (0, 9)}, max_runs=3)
        curvewise.pdist([x, 2 * x, x**2], progress=True)
    """
    command = [sys.executable, "-W", "always", "-c", textwrap.dedent(script)]
    said = subprocess.run(command, capture_output=True, check=True).stderr
    assert b"Warning" not in said
    assert said.count(b"\n") == 2


class Solver:
    """A model that counts as a solver, and fails at first."""

    is_solver = True

    def __init__(self, curves, failures, said):
        self.curves, self.failures, self.said = curves, failures, said

    def __call__(self, parameters):
        self.said.append("run")
        if len(self.said) <= self.failures:
            raise ValueError("no licence")
        return self.curves(model(parameters))


def test_a_first_run_in_other_units_is_spoken_of_once(said):
    test = NamedCurve(model(TRUE), ("strain", "stress"))
    in_pascals = Solver(lambda curve: curve * (1.0, 1e6), 0, said)
    identify(in_pascals, test, BOUNDS, max_runs=6, progress=False)
    (warned,) = [one for one in said if one != "run"]
    category, message, file = warned
    assert (category, file) == (calibration.FirstRunWarning, __file__)
    assert re.fullmatch(
        r"the first simulation does not look like its test: stress of the test is \S+e-07 times "
        r"that of the simulation; different units\? If so, stop .*",
        message,
    )
    said.clear()
    identify(lambda p: in_pascals(p), test, BOUNDS, max_runs=6, progress=False)
    assert set(said) == {"run"}


def test_a_first_run_is_looked_at_once_it_succeeds_and_test_by_test(said):
    late = Solver(lambda curve: [curve, curve[:, ::-1]], 1, said)
    identify(late, [model(TRUE)] * 2, BOUNDS, max_runs=8, progress=False)
    (warned,) = [one for one in said if one != "run"]
    assert warned[0] is calibration.FirstRunWarning
    assert ": test 1: " in warned[1]
    assert "swapped columns?" in warned[1]
