"""Flow curves of tension tests, laws and tables, against the laws that they were made of."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from curvewise.commands import main
from curvewise.fitting import flow_curve
from curvewise.solvers import read_calculix_dat

E = 206e3
VOCE = {"s0": 262.0, "Q": 214.0, "b": 17.0}
SWIFT = {"K": 720.0, "e0": 0.004, "n": 0.21}


def voce(p: np.ndarray) -> np.ndarray:
    return VOCE["s0"] + VOCE["Q"] * (1.0 - np.exp(-VOCE["b"] * p))


def swift(p: np.ndarray) -> np.ndarray:
    return SWIFT["K"] * (SWIFT["e0"] + p) ** SWIFT["n"]


def tension(law, last: float, rows: int = 3000, noise: float = 0.0) -> np.ndarray:
    """Return true strain and stress of an elastic loading and a law up to a plastic strain."""
    plastic = np.linspace(0.0, last, rows)
    strain = np.append(np.linspace(0.0, law(0.0) / E, 40), plastic[1:] + law(plastic[1:]) / E)
    stress = np.append(E * strain[:40], law(plastic[1:]))
    stress[1:] += np.random.default_rng(2).normal(0.0, noise, len(stress) - 1)
    return np.column_stack((strain, stress))


@pytest.mark.parametrize(("law", "name", "given"), [(voce, "voce", VOCE), (swift, "swift", SWIFT)])
@pytest.mark.parametrize("noise", [0.0, 2.0])
def test_a_law_is_found_again_and_the_table_is_on_it(law, name, given, noise) -> None:
    flow = flow_curve(tension(law, 0.12, noise=noise), modulus=E)
    found = getattr(flow, name)
    assert found.parameters == pytest.approx(given, rel=0.05 if noise else 5e-3)
    other = flow.swift if name == "voce" else flow.voce
    assert found.misfit < 0.5 < other.misfit
    assert flow.plastic_strain[0] == 0.0
    assert np.all(np.diff(flow.plastic_strain) > 0.0)
    assert np.all(np.diff(flow.stress) > 0.0)
    close = np.abs(flow.stress[1:] - law(flow.plastic_strain[1:]))
    assert close.max() < (2.5 if noise else 0.3)
    assert flow.stress[0] == pytest.approx(law(0.002), rel=0.01)
    assert flow.plastic_strain[-1] == pytest.approx(0.12, rel=0.05)
    assert flow.left_out == ""
    np.testing.assert_allclose(found.stress([0.0, 0.1]), law(np.array([0.0, 0.1])), rtol=0.02)


def test_the_modulus_is_read_off_the_test_and_units_are_kept() -> None:
    flow = flow_curve(tension(voce, 0.1), units="ksi")
    assert flow.modulus == pytest.approx(E, rel=0.02)
    assert re.search(r"^voce +s0 = 26\d\.?\d*, Q = 2\d\d\S*, b = 1\d", str(flow), re.MULTILINE)
    assert " ksi at a plastic strain of 0.002" in str(flow)
    assert "misfit, ksi" in str(flow)
    assert flow.plot().axes[0].get_ylabel() == "true stress [ksi]"


def test_a_neck_and_an_unloading_are_left_out() -> None:
    test = tension(voce, 0.3)
    force = test[:, 1] * np.exp(-test[:, 0])
    largest = test[np.argmax(force), 0]
    flow = flow_curve(test, modulus=E)
    assert "rows after the largest force" in flow.left_out
    assert "the specimen necks" in str(flow)
    assert flow.plastic_strain[-1] == pytest.approx(largest - voce(largest) / E, rel=0.15)
    short = tension(voce, 0.06)
    back = np.linspace(1.0, 0.0, 50)[1:, None] * (short[-1, 1] / E, short[-1, 1])
    unloaded = np.concatenate((short, short[-1] - (short[-1, 1] / E, short[-1, 1]) + back))
    found = flow_curve(unloaded, modulus=E)
    assert re.fullmatch(r"left out: \d+ rows of unloading and reloading", found.left_out)
    middle = len(short) // 2
    between = np.concatenate((short[:middle], short[middle] - back[::-1] / 2, short[middle:]))
    looped = flow_curve(between, modulus=E)
    np.testing.assert_allclose(looped.stress, flow_curve(short, modulus=E).stress, rtol=2e-3)
    assert found.plastic_strain[-1] == pytest.approx(0.06, rel=0.05)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"points": 4}, "points is 4; give at least 5"),
        ({"offset": 0.0}, "offset is 0.0; give a plastic strain above 0"),
        ({"offset": 0.5}, r"rows with a plastic strain above 0.5; give a test that yields"),
        ({"modulus": -1.0}, r"modulus is -1.0; give a positive number"),
        ({"test": np.ones((9, 3))}, r"test has shape \(9, 3\); give strain and stress"),
    ],
)
def test_arguments_that_make_no_sense(arguments, message) -> None:
    given = {"test": tension(voce, 0.1, rows=200), "modulus": E} | arguments
    with pytest.raises(ValueError, match=message):
        flow_curve(**given)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"solver": "abacus"}, "solver is 'abacus'; give one of 'abaqus', .*did you mean 'abaqus'"),
        ({"name": "2 steel"}, "name is '2 steel'; give a letter"),
        ({"poisson": 0.5}, "poisson is 0.5"),
        ({"to": 1.0}, "to is given without a law"),
        ({"to": 0.01, "law": "voce"}, "to is 0.01; the test ends at"),
        ({"law": "hollomon"}, "law is 'hollomon'; give 'voce' or 'swift'"),
    ],
)
def test_tables_that_make_no_sense(arguments, message) -> None:
    flow = flow_curve(tension(voce, 0.1, rows=200), modulus=E)
    with pytest.raises(ValueError, match=message):
        flow.table(**({"solver": "abaqus"} | arguments))


def test_each_table_has_every_number_in_its_place() -> None:
    flow = flow_curve(tension(voce, 0.1, rows=300), modulus=E, points=8)
    pairs = list(zip(flow.plastic_strain.tolist(), flow.stress.tolist(), strict=True))
    for solver in ("abaqus", "calculix"):
        lines = flow.table(solver, name="STEEL").splitlines()
        assert all(line.startswith("** ") for line in lines[:3])
        assert lines[3:7] == ["*MATERIAL,NAME=STEEL", "*ELASTIC", "206000.0,0.3", "*PLASTIC"]
        rows = [tuple(map(float, line.split(","))) for line in lines[7:]]
        np.testing.assert_allclose([(p, s) for s, p in rows], pairs, rtol=1e-12)
    lines = flow.table("ansys").splitlines()
    assert f"TB,PLASTIC,card_mat,1,{len(pairs)},MISO" in lines
    assert [line for line in lines if line.startswith("TBPT")] == [
        f"TBPT,DEFI,{p!r},{s!r}" for p, s in pairs
    ]
    lines = flow.table("ls-dyna", name="STEEL").splitlines()
    first = lines[lines.index("*MAT_PIECEWISE_LINEAR_PLASTICITY_TITLE+") + 2]
    fields = [first[i : i + 20].strip() for i in range(0, 160, 20)]
    assert fields[:4] == ["1", "&density", "206000.0", "0.3"]
    assert float(fields[4]) == pytest.approx(flow.stress[0])
    begin = lines.index("*DEFINE_CURVE_TITLE") + 3
    rows = [(float(line[:20]), float(line[20:])) for line in lines[begin:]]
    np.testing.assert_allclose(rows, pairs, rtol=1e-12)
    further = flow.table("abaqus", law="swift", to=1.0).splitlines()
    assert "the law of Swift, K = " in further[0]
    stress, plastic = map(float, further[-1].split(","))
    assert plastic == 1.0
    assert stress == pytest.approx(float(flow.swift.stress(1.0)))


def test_the_command_writes_tables_and_a_picture(tmp_path: Path, capsys) -> None:
    file = tmp_path / "tension.csv"
    test = tension(voce, 0.1, rows=400)
    np.savetxt(file, test, delimiter=",", header="strain,stress", comments="")
    output = tmp_path / "out"
    command = ["flow", str(file), "--modulus", "206GPa", "--table", "abaqus", "ls-dyna"]
    command += ["--law", "swift", "--to", "0.8", "--name", "STEEL", "--output", str(output)]
    assert main(command) == 0
    printed = capsys.readouterr().out
    assert "swift  K = " in printed
    names = {"flow_curve.csv", "flow_curve.png", "flow_abaqus.inp", "flow_ls-dyna.k"}
    assert {path.name for path in output.iterdir()} == names
    assert "*MATERIAL,NAME=STEEL" in (output / "flow_abaqus.inp").read_text()
    table = np.loadtxt(output / "flow_curve.csv", delimiter=",", skiprows=1)
    assert table[0, 0] == 0.0


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_calculix_pulls_the_table_that_it_was_given(tmp_path: Path) -> None:
    flow = flow_curve(tension(voce, 0.1), modulus=E)
    deck = ["*NODE", *(f"{i},{x},{y},{z}" for i, (x, y, z) in enumerate(CORNERS, 1))]
    deck += ["*ELEMENT,TYPE=C3D8,ELSET=ONE", "1,1,2,3,4,5,6,7,8"]
    deck += [flow.table("calculix", name="STEEL").rstrip()]
    deck += ["*SOLID SECTION,ELSET=ONE,MATERIAL=STEEL", "*NSET,NSET=PULLED", "2,3,6,7"]
    deck += ["*NSET,NSET=CORNER", "7", "*BOUNDARY"]
    faces = {1: (1, 4, 5, 8), 2: (1, 2, 5, 6), 3: (1, 2, 3, 4)}
    deck += [f"{node},{axis}" for axis, nodes in faces.items() for node in nodes]
    deck += ["*STEP,NLGEOM,INC=60", "*STATIC,DIRECT", "1.,40.", "*BOUNDARY", "PULLED,1,1,0.08"]
    deck += ["*NODE PRINT,NSET=PULLED,TOTALS=ONLY", "RF", "*NODE PRINT,NSET=CORNER", "U"]
    (tmp_path / "cube.inp").write_text("\n".join([*deck, "*END STEP", ""]))
    subprocess.run(["ccx", "-i", "cube"], cwd=tmp_path, check=True, capture_output=True)
    found = read_calculix_dat(tmp_path / "cube.dat")
    u, v, w = (found.history(c, set_name="CORNER") for c in ("vx", "vy", "vz"))
    stress = found.history("fx", set_name="PULLED") / ((1 + v) * (1 + w))
    strain = np.log1p(u)
    expected = np.interp(strain - stress / E, flow.plastic_strain, flow.stress)
    assert np.abs(stress - expected)[2:].max() < 0.005 * stress.max()


CORNERS = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
