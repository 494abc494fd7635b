"""A card of CalculiX with several materials on a mesh: copies of elements, and what ccx does."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from curvewise.commands import main
from curvewise.materials import ChabocheVoce
from curvewise.solvers import overlaid_mesh, read_calculix_dat, read_calculix_frd, read_card

STEEL = ChabocheVoce(backstresses=1)
CONSTANTS = dict(zip(STEEL.names, (200e3, 300.0, 40.0, 8.0, 40e3, 300.0), strict=True))
STRAIN = np.concatenate([np.linspace(a, b, 16)[1:] for a, b in ((0.0, 0.012), (0.012, -0.008))])

# A bar of two bricks and, beside it, an element that is no solid.
MESH = """\
** two bricks and a spring
*Node
 1, 0, 0, 0
 2, 1, 0, 0
 3, 2, 0, 0
 4, 0, 1, 0
 5, 1, 1, 0
 6, 2, 1, 0
 7, 0, 0, 1
 8, 1, 0, 1
 9, 2, 0, 1
10, 0, 1, 1
11, 1, 1, 1
12, 2, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=Bar
31, 1, 2, 5, 4, 7,
8, 11, 10
32, 2, 3, 6, 5, 8, 9, 12, 11
*ELEMENT, TYPE=SPRING1, ELSET=GROUND
120, 12
*ELSET, ELSET=FIRST, GENERATE
30, 31
*ELSET, ELSET=BOTH
FIRST, 32
"""


@pytest.fixture(scope="module")
def card(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("card") / "card.inp"
    file.write_text(STEEL.card(CONSTANTS, "calculix", name="STEEL", along=STRAIN))
    return file


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    file = tmp_path / "mesh.inp"
    file.write_text(MESH)
    return file


def elements_of(text: str) -> dict[str, list[list[int]]]:
    """Return the elements of each set, with their nodes."""
    found: dict[str, list[list[int]]] = {}
    rows: list[list[int]] | None = None
    for line in text.splitlines():
        if line.startswith("*"):
            is_block = line.startswith("*ELEMENT")
            rows = found.setdefault(line.rpartition("ELSET=")[2], []) if is_block else None
        elif rows is not None:
            rows.append([int(number) for number in line.split(",")])
    return found


@pytest.mark.parametrize("elset", ["bar", "BOTH", "FIRST"])
def test_every_element_has_a_copy_for_each_further_material(
    mesh: Path, card: Path, elset: str
) -> None:
    text = overlaid_mesh(mesh, card, elset=elset)
    layers = read_card(card).layers
    assert len(layers) > 3
    bricks = [[31, 1, 2, 5, 4, 7, 8, 11, 10], [32, 2, 3, 6, 5, 8, 9, 12, 11]]
    bricks = bricks[:1] if elset == "FIRST" else bricks
    copies = elements_of(text)
    assert list(copies) == [f"IN_{layer.name}" for layer in layers[1:]]
    for k, rows in enumerate(copies.values(), 1):
        assert rows == [[row[0] + 1000 * k, *row[1:]] for row in bricks]
    assert text.startswith(f"*ELSET,ELSET=IN_STEEL_1\n{','.join(str(row[0]) for row in bricks)}\n")
    for layer in layers:
        assert f"*SOLID SECTION,ELSET=IN_{layer.name},MATERIAL={layer.name}\n" in text
    assert card.read_text() in text


def test_quadratic_elements_are_wrapped_and_numbers_never_appear_twice(
    tmp_path: Path, card: Path
) -> None:
    nodes = list(range(1, 21))
    row = ", ".join(map(str, nodes[:10])) + ",\n" + ", ".join(map(str, nodes[10:]))
    file = tmp_path / "mesh.inp"
    file.write_text(f"*ELEMENT, TYPE=C3D20R, ELSET=E\n7, {row}\n99, {row}\n")
    text = overlaid_mesh(file, card, step=100)
    rows = [line for line in text.splitlines() if line.startswith(("107,", "199,"))]
    assert rows == [f"{n},{','.join(map(str, nodes[:15]))}," for n in (107, 199)]
    with pytest.raises(ValueError, match="step is 99; give more than 99, the largest element num"):
        overlaid_mesh(file, card, step=99)


@pytest.mark.parametrize(
    ("old", "new", "elset", "message"),
    [
        ("", "", None, "has elements of type SPRING1; overlays need solids"),
        ("", "", "GROUND", "has elements of type SPRING1"),
        ("", "", "Rod", r"no elements of a set 'Rod'.*\(sets: Bar, GROUND, FIRST, BOTH\)"),
        ("8, 11, 10\n", "8, 11\n", "BAR", r"line 15: the elements of type C3D8 have 17 numbers"),
        ("32, 2, 3", "32, 2, x", "BAR", r"line 15: invalid literal .*'x'; give whole numbers"),
        ("*ELEMENT", "*ELEMENTS", None, "has no elements; give the file with the blocks"),
    ],
)
def test_what_is_no_such_mesh_is_an_error(
    mesh: Path, card: Path, old: str, new: str, elset: str | None, message: str
) -> None:
    mesh.write_text(MESH.replace(old, new) if old else MESH)
    with pytest.raises(ValueError, match=message):
        overlaid_mesh(mesh, card, elset=elset)


def test_a_card_of_another_solver_is_refused(mesh: Path, tmp_path: Path) -> None:
    file = tmp_path / "abaqus.inp"
    file.write_text(STEEL.card(CONSTANTS, "abaqus"))
    with pytest.raises(ValueError, match="is a card of abaqus; give one of calculix"):
        overlaid_mesh(mesh, file, elset="Bar")


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_the_copies_add_up_to_the_material_in_calculix(
    mesh: Path, card: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mesh.write_text(MESH.replace("*ELEMENT, TYPE=SPRING1, ELSET=GROUND\n120, 12\n", ""))
    output = tmp_path / "overlay.inp"
    assert main(["overlay", str(mesh), str(card), "--output", str(output)]) == 0
    count = len(read_card(card).layers)
    assert f"overlay.inp, {count} materials" in capsys.readouterr().out
    deck = ["*INCLUDE,INPUT=mesh.inp", "*INCLUDE,INPUT=overlay.inp", "*NSET,NSET=PULLED"]
    deck += ["3,6,9,12", "*NSET,NSET=CORNER", "12", "*NSET,NSET=MIDDLE", "5", "*BOUNDARY"]
    faces = {1: (1, 4, 7, 10), 2: (1, 2, 3, 7, 8, 9), 3: (1, 2, 3, 4, 5, 6)}
    deck += [f"{node},{axis}" for axis, nodes in faces.items() for node in nodes]
    deck += ["*AMPLITUDE,NAME=PATH", "0.,0."]
    deck += [f"{i},{2 * u:.12g}" for i, u in enumerate(np.expm1(STRAIN), 1)]
    deck += [f"*STEP,NLGEOM,INC={len(STRAIN)}", "*STATIC,DIRECT", f"1.,{len(STRAIN)}."]
    deck += ["*BOUNDARY,AMPLITUDE=PATH", "PULLED,1,1,1.", "*NODE PRINT,NSET=PULLED,TOTALS=ONLY"]
    deck += ["RF", "*NODE PRINT,NSET=CORNER", "U", "*NODE FILE", "U", "*EL FILE", "S", "*END STEP"]
    (tmp_path / "bar.inp").write_text("\n".join([*deck, ""]))
    subprocess.run(["ccx", "-i", "bar"], cwd=tmp_path, check=True, capture_output=True)

    found = read_calculix_dat(tmp_path / "bar.dat")
    force = found.history("fx", set_name="PULLED")
    across = [1.0 + found.history(component, set_name="CORNER") for component in ("vy", "vz")]
    stress = force / (across[0] * across[1])
    point = STEEL.stress(STRAIN, CONSTANTS)
    assert np.abs(stress - point).max() < 0.005 * np.ptp(point)
    # Stresses at nodes are averages over the copies.
    averaged = read_calculix_frd(tmp_path / "bar.frd").history("SXX", number=5)
    assert np.abs(count * averaged - point).max() < 0.01 * np.ptp(point)
