"""What is said first of a fit: the same words everywhere, and tests that would tell do tell."""

from __future__ import annotations

import html
import re
from pathlib import Path

import numpy as np
import pytest

from curvewise import read_curve
from curvewise.calibration.report.misfit import misfit_of, scatter_share
from curvewise.calibration.report.shown_search import Loop
from curvewise.commands import main
from curvewise.fitting import MaterialFit, fit_material
from curvewise.materials import ChabocheVoce
from curvewise.solvers import read_card

STEEL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(STEEL.names, (206e3, 310.0, 90.0, 12.0, 90e3, 600.0), strict=True))


def loaded(turns: list[float]) -> np.ndarray:
    """Return a test with scatter of 1 MPa."""
    places = np.linspace(0.0, len(turns) - 1.0, 40 * (len(turns) - 1) + 1)
    strain = np.interp(places, range(len(turns)), turns)
    scatter = np.random.default_rng(0).normal(0.0, 1.0, strain.size)
    return np.column_stack((strain, STEEL.stress(strain, MADE_OF) + scatter))


LOOP = loaded([0.0, 0.01, -0.01, 0.01])
SMALL = loaded([0.0, 0.0017, -0.0017, 0.0017])  # hardly any plastic strain


@pytest.fixture(scope="module")
def fit() -> MaterialFit:
    return fit_material(LOOP, STEEL, progress=False)


@pytest.fixture(scope="module")
def small() -> MaterialFit:
    return fit_material(SMALL, STEEL, seed=1, progress=False)  # 0 ends in another minimum


def test_console_python_report_and_card_begin_with_the_same_words(tmp_path: Path, capsys) -> None:
    file = tmp_path / "loop.csv"
    np.savetxt(file, LOOP, delimiter=",", header="strain,stress", comments="")
    cards = ["--card", "abaqus"]
    options = ["--backstresses", "1", "--output", str(tmp_path)]
    assert main(["fit", str(file), *options, *cards]) == 0
    printed = capsys.readouterr().out.split("\n\n")[0].splitlines()
    assert {line.split(":")[0].split(" ")[0] for line in printed} == {
        "Deviation",
        "Use",
        "Do",
        "Search",
    }
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    (shown,) = re.findall(r'<div class="verdict">(.*?)</div>', page, flags=re.DOTALL)
    assert html.unescape(re.sub(r"<.*?>", "", shown)).strip().splitlines() == printed
    fit = fit_material(np.loadtxt(file, delimiter=",", skiprows=1), STEEL, progress=False)
    assert list(fit.verdict.lines) == printed
    assert str(fit).splitlines()[: len(printed)] == printed
    path = tmp_path / "card_abaqus.inp"
    text = path.read_text(encoding="utf-8")
    assert text.isascii()
    bars = re.findall(r"^\*\* \| +(.*)$", text, flags=re.MULTILINE)
    assert " ".join(bars) == " ".join(printed).replace("±", "+-")
    assert read_card(path).parameters == pytest.approx(fit.parameters, rel=1e-12)


def test_a_verdict_on_a_card_is_not_read_as_parameters(tmp_path: Path) -> None:
    linear = {**MADE_OF, "gamma1": 0.0}
    verdict = ["Use: E = 1 ± 2 %, b = 2 ± 3 %, " + "and a long line " * 9, "b = 7"]
    path = tmp_path / "card.txt"
    path.write_text(STEEL.card(linear, "calculix", verdict=verdict), encoding="utf-8")
    assert read_card(path).parameters == linear


@pytest.mark.filterwarnings("ignore:the test has noise")
def test_a_deviation_by_other_measures_is_normal_to_the_curve(fit: MaterialFit) -> None:
    of_squares = float(re.search(r"Deviation: (\S+) MPa", str(fit))[1])
    for measure in ("area", "frechet"):
        other = fit_material(LOOP, STEEL, measure=measure, max_runs=30, progress=False)
        residual = other.tests[0][:, 1] - other.found.simulations[0][:, 1]
        said = re.match(
            r"Deviation: (\S+) MPa root mean square, (\S+) %.*; (\S+) MPa at", str(other)
        )
        rms, share, largest = map(float, said.groups())
        assert 0.2 * of_squares < rms < 1.1 * np.sqrt(np.mean(residual**2))  # no farther than in y
        assert share == pytest.approx(100.0 * rms / np.ptp(LOOP[:, 1]), rel=0.1)
        assert largest >= rms


@pytest.mark.parametrize("points", [300, 30_000])
def test_a_deviation_is_in_units_of_y_and_says_what_it_is(points: int) -> None:
    x = np.linspace(0.0, 6.0, points)
    curve = np.column_stack((x, 100.0 * np.sin(x)))
    scatter = np.random.default_rng(0).normal(0.0, 3.0, points)
    for deviation, share in ((scatter, 1.0), (3.0 * np.cos(5.0 * x), 0.0)):
        test = curve + np.column_stack((np.zeros(points), deviation))
        misfit = misfit_of(Loop("t", ("x", "y"), True, test, curve, 1))
        assert misfit.rms == pytest.approx(np.sqrt(np.mean(deviation**2)), rel=0.05)
        assert misfit.scatter == pytest.approx(share, abs=0.25)
    assert misfit_of(Loop("t", ("x", "y"), True, curve, curve, 1)).scatter is None
    assert scatter_share(np.zeros(3)) == 1.0


def test_the_test_that_is_named_tells(small: MaterialFit) -> None:
    """Made with the true material, and fitted together with the first one."""
    left = [name for name, good in small.verdict.usable.items() if not good]
    assert {"Q", "b"} <= set(left)
    told = {
        name: float(match[1]) / 100.0
        for names, sentence in small.doubts
        for name in names
        if (match := re.search(r"Add a test of a larger amplitude, ± (\S+) % or more", sentence))
    }
    assert "Q" in told
    (beyond,) = (one for one in small.doubts if "b" in one.names)  # at the lowest value
    assert "wherever it is beyond the bounds that were read off the tests" in beyond.sentence
    size = max(told.values())
    further = loaded([0.0, *[size, -size] * 5])
    both = fit_material([SMALL, further], STEEL, progress=False)
    for name in {*told, "b"}:
        assert both.verdict.usable[name]
        assert both.parameters[name] == pytest.approx(MADE_OF[name], rel=0.25)


def test_what_reversed_loading_would_tell_is_asked_for() -> None:
    tension = fit_material(loaded([0.0, 0.05]), STEEL, progress=False)
    assert not any(tension.verdict.usable[name] for name in ("Q", "b", "C1", "gamma1"))
    (line,) = (one for one in tension.verdict.lines if one.startswith("Do not use"))
    assert line.endswith("Add a test with reversed loading.")


def test_a_better_model_is_asked_for_where_no_test_would_help(data_dir: Path) -> None:
    loop = read_curve(data_dir / "loops" / "dp780_tct_6pct.csv")
    fit = fit_material(loop, ChabocheVoce(backstresses=2), progress=False)
    assert "It is systematic: the model does not follow the test." in fit.verdict.lines[0]
    assert "noise" not in str(fit)
    assert "Use a model that follows them more closely." in str(fit.verdict)


def test_no_sentence_of_the_inner_life_and_no_advice_for_others(
    fit: MaterialFit, small: MaterialFit
) -> None:
    last = fit_material(loaded([0.0, *[0.01, -0.01] * 4]), STEEL, cycles="last", progress=False)
    for one in (fit, small, last):
        for word in ("surrogate", "trust", "region", "promise", "start=", "method"):
            assert word not in str(one.verdict)
    assert not any(last.verdict.usable[name] for name in ("yield", "Q", "b"))
    assert "starts from the virgin state" in str(last.verdict)


def test_the_table_of_parameters_and_the_verdict_agree(small: MaterialFit, tmp_path: Path) -> None:
    rows = small.write(tmp_path)[0].read_text(encoding="utf-8").splitlines()[1:]
    table = {row.split(",")[0]: row.split(",")[5] for row in rows}
    assert table == {name: str(good) for name, good in small.verdict.usable.items()}
