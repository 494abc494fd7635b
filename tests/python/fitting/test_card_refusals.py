"""Cards with a modulus or a yield stress that only the bounds of the search support."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from curvewise.calibration import Uncertainty
from curvewise.commands import main
from curvewise.fitting import MaterialFit, UndeterminedCardError, fit_material
from curvewise.fitting.card_refusals import refusals_of
from curvewise.materials import ChabocheVoce
from curvewise.studies import Study

MATERIAL = ChabocheVoce(backstresses=1)


def tension_test() -> np.ndarray:
    """Return a test in few points whose steep back stress hides the yield stress."""
    made_of = dict(zip(MATERIAL.names, (200e3, 24.0, 190.0, 11.0, 7.2e5, 4900.0), strict=True))
    strain = np.linspace(0.0, 0.2, 81)
    noise = np.random.default_rng(3).normal(0.0, 1.0, strain.size)
    noise[0] = 0.0
    return np.column_stack((strain, MATERIAL.stress(strain, made_of) + noise))


@pytest.fixture(scope="module")
def fit() -> MaterialFit:
    return fit_material(tension_test(), MATERIAL, fixed={"E": 200e3}, progress=False)


@pytest.mark.parametrize(
    ("name", "value", "interval", "reason"),
    [
        ("yield", 7.8, (3.2, 40.0), "interval 3.2 to 40, which reaches the lower bound 3.2"),
        ("yield", 150.0, (90.0, 200.0), "which reaches the upper bound 200"),
        ("Y", 50.0, (10.0, 61.0), "Y = 50 ksi, 95 % interval 10 to 61, which is wider than"),
        ("E", 50.0, (10.0, 60.0), None),
        ("E", 50.0, (3.2, 52.0), "E = 50 ksi, 95 % interval 3.2 to 52, which reaches the lower"),
        ("Q", 7.8, (3.2, 200.0), None),
        ("gamma1", 3.2, (3.2, 200.0), None),
    ],
)
def test_only_a_modulus_and_a_yield_stress_are_doubtful_and_only_by_the_rule(
    name: str, value: float, interval: tuple[float, float], reason: str | None
) -> None:
    determined = {name: False}
    stand_in = SimpleNamespace(
        parameters={name: value}, intervals={name: interval}, determined=determined, level=0.95
    )
    known = cast(Uncertainty, stand_in)
    bounds, yield_stress = {name: (3.2, 200.0)}, "Y" if name == "Y" else "yield"
    doubts = refusals_of(known, bounds, "ksi", yield_stress)
    assert list(doubts) == ([] if reason is None else [name])
    assert reason is None or reason in doubts[name]
    determined[name] = True
    assert refusals_of(known, {name: (3.2, 200.0)}, "ksi", "Y") == {}


def test_what_is_not_searched_for_or_not_known_is_no_doubt(fit: MaterialFit) -> None:
    assert refusals_of(None, {}, "MPa", "yield") == {}
    assert list(fit.doubtful) == ["yield"]  # E is given


def test_a_doubtful_card_is_refused_with_the_way_out(fit: MaterialFit, tmp_path: Path) -> None:
    with pytest.raises(UndeterminedCardError) as caught:
        fit.card("abaqus")
    said = str(caught.value)
    assert said.startswith("no card for abaqus: the tests do not determine yield (yield = ")
    assert "--fix yield=VALUE" in said
    assert "accept_undetermined=True" in said
    stale = tmp_path / "card_ls-dyna.k"
    stale.write_text("of an earlier fit")
    with pytest.raises(UndeterminedCardError, match="no card for abaqus, ls-dyna: "):
        fit.write_cards(tmp_path, ["abaqus", "ls-dyna"])
    assert list(tmp_path.iterdir()) == []
    assert fit.write_cards(tmp_path, []) == []


def test_an_accepted_card_has_its_marks_and_the_suffix_of_its_solver(
    fit: MaterialFit, tmp_path: Path
) -> None:
    files = fit.write_cards(
        tmp_path, ["abaqus", "ansys", "ls-dyna", "mfront", "code_aster"], accept_undetermined=True
    )
    assert [file.name for file in files] == [
        "card_abaqus.inp",
        "card_ansys.mac",
        "card_ls-dyna.k",
        "card_mfront.mfront",
        "card_code_aster.comm",
    ]
    for file in files:
        lines = [one for one in file.read_text(encoding="utf-8").splitlines() if " | " not in one]
        for name, good in fit.verdict.usable.items():
            (line,) = [one for one in lines if f" {name} = " in one and ": " in one]
            assert ("NOT DETERMINED" in line) != good


def test_a_good_fit_with_undetermined_hardening_has_its_card() -> None:
    strain = np.interp(np.arange(121) / 40, range(4), (0.0, 0.02, -0.02, 0.02))
    made_of = dict(zip(MATERIAL.names, (200e3, 300.0, 0.0, 8.0, 80e3, 400.0), strict=True))
    noise = np.random.default_rng(1).normal(0.0, 3.0, strain.size)
    test = np.column_stack((strain, MATERIAL.stress(strain, made_of) + noise))
    found = fit_material(test, MATERIAL, progress=False)
    assert found.uncertainty is not None
    assert not all(found.uncertainty.determined.values())
    assert "NOT DETERMINED" in found.card("abaqus")


def test_the_command_writes_all_but_the_card(tmp_path: Path, capsys) -> None:
    file = tmp_path / "test.csv"
    np.savetxt(file, tension_test(), delimiter=",", header="strain,stress", comments="")
    command = ["fit", str(file), "--backstresses", "1", "--fix", "E=200e3", "--card", "abaqus"]
    command += ["--output", str(tmp_path / "out")]
    assert main(command) == 1
    printed = capsys.readouterr()
    assert "curvewise: no card for abaqus: the tests do not determine yield (" in printed.err
    assert "report.html" in printed.out
    assert "card" not in printed.out.partition("written:")[2]
    assert main([*command, "--accept-undetermined"]) == 0
    assert "card_abaqus.inp" in capsys.readouterr().out


def test_a_study_warns_and_keeps_its_results(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "test.csv", tension_test(), delimiter=",", header="strain,stress")
    text = (
        '[[tests]]\nfile = "test.csv"\n[model]\nmaterial = "chaboche-voce"\nbackstresses = 1\n'
        'cards = ["abaqus"]\n[parameters]\nE = 200e3\n'
    )
    (tmp_path / "study.toml").write_text(text)
    with pytest.warns(UserWarning, match=r"no card for abaqus: .* accept_undetermined = true in"):
        Study.read(tmp_path / "study.toml").run(progress=False)
    results = tmp_path / "study_results"
    assert (results / "result.json").exists()
    assert not (results / "card_abaqus.inp").exists()
    (tmp_path / "study.toml").write_text(
        text.replace("[parameters]", "accept_undetermined = true\n[parameters]")
    )
    Study.read(tmp_path / "study.toml").run(progress=False)
    assert "NOT DETERMINED" in (results / "card_abaqus.inp").read_text(encoding="utf-8")
