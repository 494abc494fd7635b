"""Reports: the same page from the search and from its store, and its contents."""

from __future__ import annotations

import html
import json
import re
import shutil
import sqlite3
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from curvewise.calibration import (
    SDRM,
    Case,
    Criterion,
    Log,
    SimulationStore,
    Tied,
    identify,
    identify_each,
)
from curvewise.calibration.records.evaluation import Evaluation
from curvewise.calibration.report import figures, page, records_of
from curvewise.calibration.report.branches import branches_of
from curvewise.calibration.report.repeating import code_to_repeat
from curvewise.calibration.report.sections import most_points
from curvewise.calibration.report.shown_search import Loop
from curvewise.commands import command_line as cli
from curvewise.curves.named_curve import NamedCurve
from curvewise.drawing.figures import log_ticks

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
X = np.linspace(0.0, 1.0, 20)
BOUNDS = {"a": (0.5, 10.0), "b": Log(0.1, 10.0), "c": 3.0, "d": Tied(lambda p: 2.0 * p["a"])}
SQUARES = Criterion("sum_of_squares", preset="raw")
QUICK = {"measure": SQUARES, "method": "sdrm", "progress": False}
NAMES = ("strain <1>", "stress & more")


def line(parameters):
    if parameters["a"] > 7.0:
        raise ValueError("too <steep>")
    return np.column_stack((X, parameters["a"] * X + parameters["b"]))


def model(parameters):
    return [line(parameters)] * 2


def experiments():
    noise = np.random.default_rng(0).normal(0.0, 0.05, (2, len(X)))
    curve = line({"a": 2.0, "b": 1.0})
    first, second = (curve + np.column_stack([np.zeros(len(X)), one]) for one in noise)
    return [NamedCurve(first, NAMES), second]


@pytest.fixture(scope="module")
def search(tmp_path_factory):
    """Return a search, its folder, and the page that it wrote itself."""
    folder = tmp_path_factory.mktemp("report")
    store = SimulationStore(folder / "s.db", version="1")
    found = identify(model, experiments(), BOUNDS, store=store, **QUICK)
    before = page(list(records_of(store.path).values()))
    found.report(folder / "found.html")
    return found, folder, before


def test_the_page_of_a_store_is_that_of_the_search(search):
    _, folder, before = search
    own = (folder / "found.html").read_bytes()
    assert cli.main(["report", str(folder / "s.db"), "-o", str(folder / "x.html")]) == 0
    assert (folder / "x.html").read_bytes() == own
    assert before.encode() == own  # the uncertainty, from the stored one


def test_a_search_without_a_store_has_the_same_page(search, tmp_path):
    """Apart from the times of the runs, and the model's name without a version."""
    found, _, _ = search
    alone = identify(model, experiments(), BOUNDS, **QUICK)
    record, stored = alone.record(), found.record()
    assert record.ending.to_json() == stored.ending.to_json()
    assert [replace(one, seconds=0.0, simulations=None) for one in record.evaluations] == [
        replace(one, seconds=0.0, simulations=None) for one in stored.evaluations
    ]
    alone.report(tmp_path / "alone.html")
    assert "Residuals by branch" in (tmp_path / "alone.html").read_text()


def test_a_page_is_small_complete_and_loads_nothing(search):
    found, folder, _ = search
    text = (folder / "found.html").read_text()
    assert 1e6 < len(text) < 5e6
    visible = re.sub(r'<script type="text/plain".*?</script>', "", text, flags=re.DOTALL)
    assert not re.search(r'(src|href)="(?!#|data:)', visible)
    for title in ("Parameters", "Residuals by branch", "Weakest directions", "Settings"):
        assert f">{title}" in visible
    assert "screening(found)" in visible
    assert "front(store" not in visible  # of one measure
    assert found.failures
    assert "too &lt;steep&gt;" in visible
    assert "too <steep>" not in visible
    assert "strain &lt;1&gt;" in visible
    for name, error in found.uncertainty().standard_errors.items():
        assert f"{found.parameters[name]:.6g}" in visible
        assert f"{error:.3g}" in visible
    assert found.record().details["versions"]["numpy"] == np.__version__


def figures_of(text):
    (written,) = re.findall(r'<script type="application/json" id="figures">(.*?)</script>', text)
    return written, json.loads(written)


def said_by(text):
    """Return the verdict of a page, without its marks."""
    (verdict,) = re.findall(r'<div class="verdict">(.*?)</div>', text, flags=re.DOTALL)
    return html.unescape(re.sub(r"<.*?>", "", verdict))


def test_no_name_of_a_parameter_ends_the_figures(tmp_path):
    name = "E<!--<script>"
    noisy = experiments()[0]
    found = identify(lambda p: line({"a": p[name], "b": 1.0}), noisy, {name: (0.5, 5.0)}, **QUICK)
    found.report(tmp_path / "x.html")
    written, drawn = figures_of((tmp_path / "x.html").read_text())
    assert "<" not in written
    assert "\\u003c!--\\u003cscript>" in written
    assert name in drawn[0]["data"][0]["y"]


def test_the_page_begins_with_a_verdict_in_units(tmp_path):
    def flat(parameters):
        return np.column_stack((X, parameters["a"] * X + parameters["b"] + 0.0 * parameters["c"]))

    bounds = {"a": (0.5, 10.0), "b": (0.1, 5.0), "c": (1.0, 2.0)}
    test = NamedCurve(np.array(experiments()[0]), ["strain [-]", "stress [MPa]"])
    found = identify(flat, test, bounds, **QUICK)
    found.report(tmp_path / "x.html")
    text = (tmp_path / "x.html").read_text()
    said = said_by(text)
    assert text.index("verdict") < text.index("<nav>")
    assert re.search(r"Use: a = .*± \d.* %, b = .*± \d.* % \(95 % intervals\)", said)
    assert "Do not use c (any value within its bounds): the tests do not determine it" in said
    residual = np.abs(test[:, 1] - found.simulations[0][:, 1])
    rms = np.sqrt(np.mean(residual**2))
    assert f"Deviation: {rms:.2g} MPa root mean square" in said
    assert f"{100 * rms / np.ptp(test[:, 1]):.2g} % of the test's range of stress" in said
    assert f"{residual.max():.2g} MPa at most" in said
    assert said.strip().splitlines() == list(found.verdict.lines)
    assert str(found).splitlines()[: len(found.verdict.lines)] == list(found.verdict.lines)
    assert found.message not in said
    (footnote,) = re.findall(r'<p class="footnote">(.*?)</p>', text)
    assert found.message in footnote


def test_a_verdict_of_several_tests(search):
    said = said_by(search[2])
    assert said.strip().splitlines() == list(search[0].verdict.lines)
    assert said.count("Deviation from Loop 0: 0.") == said.count("Deviation from Loop 1: 0.") == 1
    assert "Use: a = " in said
    assert re.search(r"\d+ evaluations, of which \d+ failed", search[2])
    record = search[0].record()
    share = 100 * record.ending.uncertainty["standard_errors"]["a"] / record.ending.parameters["a"]
    both = page([record, record])
    assert both.count(f"{record.ending.parameters['a']:.5g} ± {share:.2g} %</td>") == 2


def test_a_page_asks_for_names_and_units_that_are_missing(search):
    _, _, before = search
    assert "the names of the columns of Loop 1 are not known" in before
    assert "units of &quot;strain &lt;1&gt;&quot; and &quot;stress &amp; more&quot;" in before
    test = NamedCurve(np.array(experiments()[0]), ["strain [-]", "stress [MPa]"])
    found = identify(model, [test, test], BOUNDS, **QUICK)
    assert "are not known" not in page([found.record()])


def test_the_intervals_of_a_page_are_those_that_were_computed(tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    found = identify(model, experiments(), BOUNDS, store=store, **QUICK)
    uncertainty = found.uncertainty(sigma=0.7, level=0.9)
    assert "90 % from" in page(list(records_of(store.path).values()))
    found.report(tmp_path / "x.html")
    text = (tmp_path / "x.html").read_text()
    assert "90 % from" in text
    assert "95 % from" not in text
    for name, error in uncertainty.standard_errors.items():
        assert f"{100 * error / found.parameters[name]:.2g}</td>" in text


def test_ticks_of_a_logarithm_are_apart_and_the_correlations_have_a_title():
    values = enumerate((90.0, 3.0, 2.0, 1.0))
    evaluations = [Evaluation(i, (0.0,), value, False, 0.0) for i, value in values]
    axis = figures.convergence(evaluations, "area")["layout"]["yaxis"]
    assert (axis["type"], axis["tickvals"]) == ("log", [1.0, 2.0, 5.0, 10.0, 20.0, 50.0])
    near = figures.convergence(evaluations[1:], "area")["layout"]["yaxis"]
    assert "type" not in near  # where a linear axis does
    for low, high in [(1e-12, 1e3), (2e-3, 7e-2), (3.0, 3000.0), (0.9, 1100.0)]:
        ticks = log_ticks(low, high)
        assert 2 <= len(ticks) <= 6
        assert np.diff(np.log(ticks)).min() > 0.1 * np.log(high / low)
    drawn = figures.correlations(["a", "b"], [[1.0, 0.5], [0.5, 1.0]])
    assert "orrelations" in drawn["layout"]["title"]["text"]


def test_what_each_loop_notices_is_drawn_a_row_a_parameter():
    drawn = figures.sensitivities(["a", "b"], ["3 %", "6 %"], [[0.2, 0.0], [0.1, 0.003]])
    first, second = drawn["data"]
    assert (first["name"], first["x"], first["y"]) == ("3 %", [20.0, None], ["a", "b"])
    assert second["x"] == [10.0, 0.3]  # nothing that is 0 has a place on a logarithmic scale
    assert drawn["layout"]["xaxis"]["type"] == "log"


def test_the_call_on_the_page_makes_the_search_again(search):
    found, folder, _ = search
    (record,) = records_of(folder / "s.db").values()
    names = {"model": model, "experiments": experiments()}
    code = code_to_repeat(record)
    assert "# 'd': Tied(...)" in code
    exec(code, names)
    assert names["found"].parameters["a"] == found.parameters["a"]
    assert names["found"].value == found.value


def test_cases_are_written_down_too(tmp_path):
    cases = [
        Case("a curve", line, experiments()[0], measure="sum_of_squares", sigma=0.05),
        Case(
            "a number",
            line,
            1.1,
            measure="sum_of_squares",
            weight=2.0,
            sigma=0.1,
            response=lambda c: c[0, 1],
        ),
    ]
    found = identify(
        cases,
        bounds={"a": (0.5, 8.0), "b": (0.1, 10.0)},
        method="sdrm",
        progress=False,
        store=SimulationStore(tmp_path / "s.db", version="1"),
    )
    before = page(list(records_of(tmp_path / "s.db").values()))
    found.report(tmp_path / "found.html")
    assert (tmp_path / "found.html").read_text() == before
    assert re.search(
        r"Deviation from a number: -?0\.\d+ \(.* %\), for 1.1 measured", said_by(before)
    )


def test_an_interrupted_search_has_a_page(tmp_path):
    calls = []

    def interrupted(parameters):
        calls.append(parameters)
        if len(calls) == 8:
            raise KeyboardInterrupt
        return model(parameters)

    store = SimulationStore(tmp_path / "s.db", version="1")
    with pytest.raises(KeyboardInterrupt):
        identify(interrupted, experiments(), BOUNDS, store=store, **QUICK)
    (record,) = records_of(tmp_path / "s.db").values()
    assert record.ending is None
    assert 0 < len(record.evaluations) < 8
    assert len(record.curves) == 2  # of the best so far, from the store
    text = page([record])
    assert "The search has not ended" in text
    again = identify(interrupted, experiments(), BOUNDS, store=store, **QUICK)
    (record,) = records_of(tmp_path / "s.db").values()  # it takes the place of its former self
    assert record.ending is not None
    assert len(record.evaluations) == again.evaluations


def test_a_page_of_nothing_but_failures(tmp_path):
    def failing(parameters):
        raise ValueError("no licence")

    store = SimulationStore(tmp_path / "s.db", version="1")
    with pytest.raises(RuntimeError, match="no licence"):
        identify(failing, experiments(), BOUNDS, store=store, **QUICK)
    (record,) = records_of(tmp_path / "s.db").values()
    assert page([record]).count("no licence") == len(record.evaluations) > 0
    assert "Nothing has been evaluated yet" in page([replace(record, evaluations=())])


def test_a_result_is_not_lost_where_its_store_is(search, tmp_path):
    store = SimulationStore(tmp_path / "s.db", version="1")
    found = identify(model, experiments(), BOUNDS, store=store, **QUICK)
    store.path.unlink()
    found.report(tmp_path / "x.html")
    assert not store.path.exists()
    assert found.parameters == search[0].parameters
    store.path.write_text("another file")
    with pytest.raises(ValueError, match=r"s\.db is not a store"):
        found.report(tmp_path / "x.html")


@pytest.mark.filterwarnings("ignore::curvewise.calibration.NoisyTestWarning")
def test_several_searches_of_a_store_on_one_page(tmp_path, capsys):
    # A single design over all of the bounds leaves no runs near the optimum: no intervals.
    keywords = {"method": SDRM(initial_range=1.0), "progress": False, "max_runs": 5}
    store = str(tmp_path / "s.db")
    bounds = {"a": (0.5, 8.0), "b": (0.1, 10.0)}
    each = identify_each(
        model,
        experiments(),
        bounds,
        measures=[SQUARES, Criterion("curve_length", preset="raw")],
        store=SimulationStore(store, version="1"),
        **keywords,
    )
    assert cli.main(["report", store, "--list"]) == 0
    assert "2  curve_length (raw), sdrm: 5 evaluations" in capsys.readouterr().out
    one = tmp_path / "one.html"
    assert cli.main(["report", store, "--search", "1", "-o", str(one)]) == 0
    each["sum_of_squares"].report(tmp_path / "found.html")
    assert one.read_bytes() == (tmp_path / "found.html").read_bytes()
    assert cli.main(["report", store, "--search", "7"]) == 1
    assert "has no search 7; it has 1, 2" in capsys.readouterr().err
    text = page(list(records_of(store).values()))
    assert "Search 2: curve_length" in text
    assert "front(store, tests, measures)" in text
    assert "Intervals take" in text
    each.report(tmp_path / "each.html")
    assert (tmp_path / "each.html").read_text() == text


def test_a_function_as_a_measure_is_not_written_down(tmp_path):
    def distance(P, Q):
        return float(np.abs(P[:, 1] - Q[:, 1]).mean())

    keywords = {**QUICK, "measure": distance, "method": "trust-region"}
    bounds = {"a": (0.5, 8.0), "b": (0.1, 10.0)}
    store = SimulationStore(tmp_path / "s.db", version="1")
    found = identify(line, experiments()[0], bounds, store=store, **keywords)
    (record,) = records_of(tmp_path / "s.db").values()
    assert found.uncertainty_runs == 0
    assert "The measure is a function" in page([record])
    found.report(tmp_path / "found.html", uncertainty=found.uncertainty(samples=20))
    (record,) = records_of(tmp_path / "s.db").values()
    assert (tmp_path / "found.html").read_text() == page([record])
    assert "95 % from" in page([record])


def test_runs_without_a_search_say_what_to_do(tmp_path, capsys):
    store = SimulationStore(tmp_path / "runs.db", version="1")
    identify(line, experiments()[0], BOUNDS, store=store, **QUICK)
    with sqlite3.connect(store.path) as database:
        database.executescript("DELETE FROM searches; DELETE FROM evaluations;")
    database.close()
    assert cli.main(["report", str(store.path)]) == 1
    assert "runs are looked up, and none is made again" in capsys.readouterr().err
    found = identify(line, experiments()[0], BOUNDS, store=store, **QUICK)
    assert found.runs == 0
    assert len(records_of(store.path)) == 1
    text = tmp_path / "text.csv"
    text.write_text("strain,stress\n0,0\n1,2\n")
    assert cli.main(["report", str(text)]) == 1
    assert "is not a store" in capsys.readouterr().err
    assert cli.main(["report", str(tmp_path / "none.db")]) == 1
    assert not (tmp_path / "none.db").exists()


def test_without_plotly_the_message_says_what_to_install(search, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "plotly.offline", None)
    with pytest.raises(ImportError, match=r'pip install "curvewise\[report\]"'):
        search[0].report(tmp_path / "x.html")


def test_many_and_long_curves_are_thinned(search):
    record = next(iter(records_of(search[1] / "s.db").values()))
    assert most_points([record], 120_000) == 3000
    assert most_points([record] * 40, 120_000) == 120_000 // (7 * 2 * 40)
    long = np.column_stack([np.arange(100_000.0), np.zeros(100_000)])
    trace = figures.loop(Loop("", ["x", "y"], True, long, None, 1), 3000)["data"][0]
    assert len(trace["x"]) == 3000
    assert (trace["x"][0], trace["x"][-1]) == (0.0, 99_999.0)


def test_residuals_are_told_apart_by_branch():
    x = np.concatenate([X, np.linspace(1.0, -1.0, 41)[1:]])
    test = np.column_stack([x, 2.0 * x])
    branches = branches_of(test, test - (0.0, 0.001), 1)
    assert [len(branch.x) for branch in branches] == [20, 41]  # the turning point is in both
    assert branches[1].name == "branch 2"
    for branch in branches:
        np.testing.assert_allclose(branch.residual, 0.001)
    timed = np.column_stack([x, 2.0 * x, np.arange(len(x))])
    np.testing.assert_allclose(
        branches_of(timed, timed + np.array([0.0, 0.001, 0.0]), 1)[0].residual, -0.001
    )


@pytest.mark.skipif(CHROMIUM is None, reason="no chromium to open the page in")
def test_a_browser_draws_and_prints_the_page(search, tmp_path):
    _, folder, before = search
    count = len(re.findall(r'id="figure-\d+"', before))
    assert count >= 8
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=30000"]
    flags += [f"--user-data-dir={tmp_path / 'profile'}", "--enable-logging=stderr"]
    url = (folder / "found.html").as_uri()
    shown = subprocess.run(
        [CHROMIUM, *flags, "--dump-dom", url], capture_output=True, text=True, timeout=120
    )
    assert f'data-drawn="{count}"' in shown.stdout[:200]
    assert shown.stdout.count('class="main-svg"') >= count
    assert "CONSOLE" not in shown.stderr
    printed = tmp_path / "page.pdf"
    subprocess.run(
        [CHROMIUM, *flags, f"--print-to-pdf={printed}", url], capture_output=True, timeout=120
    )
    assert printed.stat().st_size > 30_000
    assert printed.read_bytes().count(b"/Type /Page\n") >= 2
