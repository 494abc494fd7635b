"""Readers of solvers' files: CalculiX's as it writes them here, the others' written by hand.

The samples of Abaqus and LS-DYNA follow the formats as their manuals and public listings show
them; neither program is on the machines where these tests run.
"""

from __future__ import annotations

import re
import runpy
import shutil
import subprocess
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise.solvers import (
    read_abaqus_dat,
    read_calculix_dat,
    read_calculix_frd,
    read_ls_dyna_binout,
    read_ls_dyna_elout,
    read_ls_dyna_nodout,
)

DECK = """*NODE,NSET=ALL
1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1
*ELEMENT,TYPE=C3D8,ELSET=CUBE
1,1,2,3,4,5,6,7,8
*NSET,NSET=PULLED\n2,3,6,7
*NSET,NSET=CORNER\n7
*MATERIAL,NAME=STEEL
*ELASTIC\n2E5,0.3
*PLASTIC\n1E9,0.
*SOLID SECTION,ELSET=CUBE,MATERIAL=STEEL
*BOUNDARY
1,1,3\n4,1\n4,3\n5,1,2\n8,1\n2,2,3\n3,3\n6,2
*STEP,INC=100\n*STATIC,DIRECT\n0.25,1.
*BOUNDARY
2,1,1,0.01\n3,1,1,0.01\n6,1,1,0.01\n7,1,1,0.01
*EL PRINT,ELSET=CUBE\nS,PEEQ
*EL PRINT,ELSET=CUBE,TOTALS=ONLY\nEVOL
*NODE PRINT,NSET=PULLED,TOTALS=YES\nRF
*NODE PRINT,NSET=CORNER\nU
*NODE FILE\nU,RF
*EL FILE\nS
*END STEP
"""


@pytest.fixture(scope="module")
def cube(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which CalculiX has pulled an elastic cube of unit length by 1 %."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX (ccx) is not installed: apt calculix-ccx")
    folder = tmp_path_factory.mktemp("cube")
    (folder / "deck.inp").write_text(DECK)
    subprocess.run(["ccx", "-i", "deck"], cwd=folder, check=True, capture_output=True)
    return folder


def test_calculix_dat_has_forces_displacements_and_stresses(cube: Path) -> None:
    output = read_calculix_dat(cube / "deck.dat")
    strain = np.array([0.0025, 0.005, 0.0075, 0.01])
    exact = {"rtol": 1e-6}
    np.testing.assert_allclose(output.history("vx", set_name="CORNER"), strain, **exact)
    np.testing.assert_allclose(output.history("vy", set_name="corner"), -0.3 * strain, **exact)
    force = output.history("fx", variable="total force", set_name="PULLED")
    np.testing.assert_allclose(force, 2e5 * strain, **exact)
    summed = output.history("fx", variable="forces", combine="sum")
    np.testing.assert_allclose(summed, force, **exact)
    stress = output.history("sxx", number=1, point=8)
    np.testing.assert_allclose(stress, 2e5 * strain, **exact)
    assert output.history("pe", combine="max").tolist() == [0.0] * 4
    assert output.history("value", variable="total volume").tolist() == [1.0] * 4
    assert output.history("time", set_name="CORNER").tolist() == [0.25, 0.5, 0.75, 1.0]


def test_calculix_frd_has_the_same_with_six_digits(cube: Path) -> None:
    output = read_calculix_frd(cube / "deck.frd")
    strain = np.array([0.0025, 0.005, 0.0075, 0.01])
    np.testing.assert_allclose(output.history("D1", number=7), strain, rtol=1e-5)
    np.testing.assert_allclose(output.history("D3", number=7), -0.3 * strain, rtol=1e-5)
    assert output.history("F1", number=7) == pytest.approx(0.25 * 2e5 * strain, rel=1e-5)
    assert output.history("SXX", combine="mean") == pytest.approx(2e5 * strain, rel=1e-4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"component": "vz", "set_name": "CORNRE"}, "has no set 'CORNRE': there is CUBE, PULLED, "),
        ({"component": "vz", "set_name": "CORNRE"}, "did you mean 'CORNER'?"),
        ({"component": "uz"}, "has no component 'uz': there is sxx, syy, szz, sxy, sxz, syz, pe"),
        ({"component": "fx"}, "has 'fx' in several tables: forces of set PULLED (fx, fy, fz), tot"),
        ({"component": "fx", "variable": "forces"}, "there are 4 rows (2, 3, 6, 7); give the numb"),
        ({"component": "fx", "variable": "forces", "number": 5}, "there is no 5; there is 2, 3,"),
        ({"component": "sxx", "number": 1}, "there are 8 integration points (1, 2, 3, 4, 5, 6, 7"),
        ({"component": "sxx", "number": 1, "point": 9}, "there is no point 9; there is 1, 2, 3, "),
        ({"component": "vx", "combine": "median"}, "combine is 'median'; choose from sum, mean"),
    ],
)
def test_what_is_not_there_is_said_with_what_is(
    cube: Path, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        read_calculix_dat(cube / "deck.dat").history(**arguments)


def test_an_output_prints_as_what_it_holds(cube: Path) -> None:
    assert str(read_calculix_dat(cube / "deck.dat")).splitlines() == [
        "stresses of set CUBE (sxx, syy, szz, sxy, sxz, syz): 4 times from 0.25 to 1, 8 rows",
        "equivalent plastic strain of set CUBE (pe): 4 times from 0.25 to 1, 8 rows",
        "total volume of set CUBE (value): 4 times from 0.25 to 1, 1 row",
        "forces of set PULLED (fx, fy, fz): 4 times from 0.25 to 1, 4 rows",
        "total force of set PULLED (fx, fy, fz): 4 times from 0.25 to 1, 1 row",
        "displacements of set CORNER (vx, vy, vz): 4 times from 0.25 to 1, 1 row",
    ]


def test_an_empty_output_is_an_error_only_when_it_is_asked(tmp_path: Path) -> None:
    (tmp_path / "deck.dat").write_text("\n")
    output = read_calculix_dat(tmp_path / "deck.dat")
    assert str(output) == "nothing that can be read as a table"
    with pytest.raises(ValueError, match="holds no results that can be read"):
        output.history("vx")


def test_a_binary_frd_is_refused(tmp_path: Path) -> None:
    line = "  100CL  101 5.00000E-01           8                     0    1           2\n"
    (tmp_path / "deck.frd").write_text(line)
    with pytest.raises(ValueError, match="line 1: the results are binary"):
        read_calculix_frd(tmp_path / "deck.frd")


def test_fortran_numbers_without_e_and_overflows(tmp_path: Path) -> None:
    text = " displacements (vx,vy,vz) for set A and time  0.1000000E+01\n\n 7 {} 1.-100 0.\n"
    (tmp_path / "deck.dat").write_text(text.format("2.5-101"))
    assert read_calculix_dat(tmp_path / "deck.dat").history("vx").tolist() == [2.5e-101]
    (tmp_path / "deck.dat").write_text(text.format("*********"))
    with pytest.raises(ValueError, match=r"deck.dat, line 3: '\*{9}' is no number"):
        read_calculix_dat(tmp_path / "deck.dat")


ABAQUS = """
                              N O D E   P R I N T

 THE FOLLOWING TABLE IS PRINTED AT EVERY 1 INCREMENT FOR NODES BELONGING TO NODE SET TOP

        TABLE  1  U2        RF2

          INCREMENT     1 SUMMARY

 TIME INCREMENT COMPLETED  0.500    ,  FRACTION OF STEP COMPLETED  0.500
 STEP TIME COMPLETED       0.500    ,  TOTAL TIME COMPLETED        0.500

                      E L E M E N T   O U T P U T

   THE FOLLOWING TABLE IS PRINTED FOR ALL ELEMENTS WITH TYPE CPE4 AT THE INTEGRATION POINTS

       ELEMENT  PT FOOT-       S11         S22
                   NOTE

          1   1          1.5         -150.2
          1   2          1.7         -150.4

 MAXIMUM                 1.7         -150.2
 ELEMENT                   1              1

                      N O D E   O U T P U T

   THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TOP

       NODE FOOT-   U2             RF2
            NOTE

          3    -1.0000E-03    -75.1
          4 SD -1.0000E-03    -75.3

 MAXIMUM       -1.0000E-03    -75.1
 AT NODE             3            3

          INCREMENT     2 SUMMARY

 TIME INCREMENT COMPLETED  0.500    ,  FRACTION OF STEP COMPLETED   1.00
 STEP TIME COMPLETED        1.00    ,  TOTAL TIME COMPLETED         1.00

   THE FOLLOWING TABLE IS PRINTED FOR ALL ELEMENTS WITH TYPE CPE4 AT THE INTEGRATION POINTS

       ELEMENT  PT FOOT-       S11         S22
                   NOTE

          1   1          3.0         -300.2
          1   2          3.4         -300.4

   THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TOP

       NODE FOOT-   U2             RF2
            NOTE

          3    -2.0000E-03    -150.1
          4    -2.0000E-03    -150.3

          THE ANALYSIS HAS BEEN COMPLETED
"""


def test_abaqus_dat(tmp_path: Path) -> None:
    (tmp_path / "deck.dat").write_text(ABAQUS)
    output = read_abaqus_dat(tmp_path / "deck.dat")
    assert str(output).splitlines() == [
        "elements CPE4 (S11, S22): 2 times from 0.5 to 1, 2 rows",
        "nodes of set TOP (U2, RF2): 2 times from 0.5 to 1, 2 rows",
    ]
    assert output.history("RF2", set_name="TOP", combine="sum") == pytest.approx([-150.4, -300.4])
    assert output.history("U2", number=4).tolist() == [-1e-3, -2e-3]
    assert output.history("S22", number=1, point=2).tolist() == [-150.4, -300.4]


NODOUT = """ Cube
                         ls-dyna mpp.123                  date 01/01/2026
{BEGIN LEGEND}
 Entity #        Title
       71
{END LEGEND}



 n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1     ( at time 0.0000000E+00 )

 nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel
        71  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00
        72  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00

 nodal point  x-rot      y-rot       z-rot
        71  1.0000E-01  0.0000E+00  0.0000E+00
        72  0.0000E+00  0.0000E+00  0.0000E+00


 n o d a l   p r i n t   o u t   f o r   t i m e  s t e p     100     ( at time 1.0000000E-03 )

 nodal point  x-disp     y-disp      z-disp      x-vel       y-vel       z-vel
        71  1.0000E-02 -3.0000E-03 -3.0000E-03  1.0000E+01 -1.0000E+00-1.00000E+100
        72  2.0000E-02 -3.0000E-03
"""


def test_ls_dyna_nodout(tmp_path: Path) -> None:
    (tmp_path / "nodout").write_text(NODOUT)
    output = read_ls_dyna_nodout(tmp_path / "nodout")
    assert output.history("y-disp", number=71).tolist() == [0.0, -0.003]
    assert output.history("x-rot", number=71).tolist() == [0.1]
    assert output.history("z-vel", number=71).tolist() == [0.0, -1e100]
    with pytest.raises(ValueError, match=r"at time 0.001: there is no 72; there is 71"):
        output.history("x-disp", number=72)  # the run was killed while it wrote this line


ELOUT = """
 e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p      100   {at}

 element  materl
     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx     yield
           state                                                                   effsg   function
      12-      1
       1 elastic   2.0000E+02 1.0000E+00-1.0000E+00 0.0000E+00 0.0000E+00 0.0000E+00 2.0E+02 1.0E+00
       2 plastic   2.2000E+02 1.0000E+00-1.0000E+00 0.0000E+00 0.0000E+00 0.0000E+00 2.2E+02 1.0E+00
      13-      1
       1 plastic   2.4000E+02 1.0000E+00-1.0000E+00 0.0000E+00 0.0000E+00 0.0000E+00 2.2E+02 1.0E+00

 strains (global)      eps-xx      eps-yy      eps-zz      eps-xy      eps-yz      eps-zx
      12-      1
 lower ipt  1.0000E-03-3.0000E-04-3.0000E-04 0.0000E+00 0.0000E+00 0.0000E+00
 upper ipt  2.0000E-03-3.0000E-04-3.0000E-04 0.0000E+00 0.0000E+00 0.0000E+00
"""


def test_ls_dyna_elout(tmp_path: Path) -> None:
    times = ("( at time 1.00000E-03 )", "( at time 2.00000E-03 )")
    (tmp_path / "elout").write_text("\n".join(ELOUT.replace("{at}", time) for time in times))
    output = read_ls_dyna_elout(tmp_path / "elout")
    assert output.history("sig-xx", number=12, point=2).tolist() == [220.0, 220.0]
    assert output.history("sig-zz", number=13).tolist() == [-1.0, -1.0]
    assert output.history("sig-xx", number=12, combine="mean").tolist() == [210.0, 210.0]
    assert output.history("effsg", number=12, point=1).tolist() == [200.0, 200.0]
    assert output.history("eps-xx", number=12, point=2).tolist() == [0.002, 0.002]
    assert output.history("time", variable="stress").tolist() == [0.001, 0.002]


FRD = "  100CL  101 5.00000E-01           1                     0    1           1\n -4  DISP\n"
DAT = " displacements (vx,vy) for set A and time  {}\n\n {}\n"


@pytest.mark.parametrize(
    ("read", "text", "message"),
    [
        (read_calculix_dat, DAT.format("1.0", "inf 1. 2."), "line 3: 'inf' is not an integer"),
        (read_calculix_dat, DAT.format("1.0", "1.5 1. 2."), "line 3: '1.5' is not an integer"),
        (read_calculix_dat, DAT.format("x", "7 1. 2."), "line 1: 'x' is no number; was the run cu"),
        (read_calculix_frd, FRD + " -1  x\n", "line 3: 'x' is no number; was the run cut short?"),
        (read_calculix_frd, FRD + " -1\n", "line 3: a number is missing; was the run cut short?"),
        (read_calculix_frd, FRD[:12] + "\n", "line 1: a number is missing; was the run cut short?"),
        (
            read_abaqus_dat,
            ABAQUS.replace(" 3    -1", 400 * "9" + " -1"),
            "line 33: '9{40}' is not",
        ),
        (read_abaqus_dat, ABAQUS.replace("-75.1", ""), "line 33: 2 words for 3 columns"),
        (
            read_ls_dyna_nodout,
            NODOUT.replace(" 71  0", 400 * "9" + "  0"),
            "line 13: '9{40}' is not",
        ),
        (
            read_ls_dyna_elout,
            ELOUT.replace("12-", 400 * "9" + "-"),
            "line 7: '9{40}' is not an integer",
        ),
    ],
)
def test_every_reader_says_where_a_number_is_wrong(tmp_path: Path, read, text, message) -> None:
    (tmp_path / "deck").write_text(text)
    with pytest.raises(ValueError, match=f"^{re.escape(str(tmp_path))}/deck, {message}"):
        read(tmp_path / "deck")


@pytest.mark.parametrize(
    ("read", "text", "component", "message"),
    [
        (
            read_calculix_frd,
            FRD + " -5  D1\n -5\n -1         7 1.00000E+00\n",
            "D2",
            "no component",
        ),
        (
            read_calculix_frd,
            FRD + " -5  D1\n -5  D2\n -1         7 1.00000E+00\n",
            "D2",
            "the row of 7 has 1 values; was the run cut short",
        ),
        (
            read_calculix_dat,
            DAT.format("1.0", ""),
            "vx",
            "there are no rows; was the run cut short",
        ),
        (read_ls_dyna_nodout, NODOUT[: NODOUT.index("x-disp")], "x-disp", "no component 'x-disp'"),
        (read_ls_dyna_nodout, NODOUT.replace("z-vel", "z?vel", 1), "x-disp", "is the file damaged"),
    ],
)
def test_what_was_cut_short_is_said(tmp_path: Path, read, text, component, message) -> None:
    (tmp_path / "deck").write_text(text)
    with pytest.raises(ValueError, match=message):
        read(tmp_path / "deck").history(component)


def test_ls_dyna_binout(tmp_path: Path) -> None:
    """Written by the writer that lasso-python provides with its reader."""
    pytest.importorskip("lasso", reason="lasso-python is not installed: curvewise[ls-dyna]")
    from lasso.dyna.lsda_py3 import Lsda

    file = Lsda(str(tmp_path / "binout0000"), "w")
    file.cd("/nodout/metadata")
    file.write("ids", Lsda.I4, (71, 72))
    for i, time in enumerate((0.0, 0.5)):
        file.cd(f"/nodout/d{i + 1:06}")
        file.write("time", Lsda.R8, (time,))
        file.write("x_displacement", Lsda.R8, (0.01 * i, 0.02 * i))
    file.close()
    output = read_ls_dyna_binout(tmp_path / "binout*", ["nodout"])
    assert output.history("x_displacement", number=72).tolist() == [0.0, 0.02]
    with pytest.raises(ValueError, match="has no branch 'rcforc'; there is nodout"):
        read_ls_dyna_binout(tmp_path / "binout*", ["rcforc"])
    with pytest.raises(FileNotFoundError, match="there is no binout"):
        read_ls_dyna_binout(tmp_path / "no_such*")


def test_the_script_for_abaqus_writes_the_histories(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a substitute for Abaqus' module that has the attributes in its reference."""

    def history(*values: float) -> Any:
        times = [0.1 * (i + 1) for i in range(len(values))]
        return types.SimpleNamespace(data=tuple(zip(times, values, strict=True)))

    def step(begin: float, *forces: float) -> Any:
        region = types.SimpleNamespace(
            name="Node TOP.1", historyOutputs={"RF2": history(*forces), "U2": history(1, 2)}
        )
        return types.SimpleNamespace(totalTime=begin, historyRegions={"Node TOP.1": region})

    database = types.SimpleNamespace(
        steps={"Step-1": step(0.0, 5, 6), "Step-2": step(1.0, 7, 8)}, close=lambda: None
    )
    module = types.ModuleType("odbAccess")
    module.openOdb = lambda path, readOnly: database  # type: ignore[attr-defined]  # made here
    monkeypatch.setitem(sys.modules, "odbAccess", module)
    import curvewise.solvers as solvers

    script = Path(solvers.__file__).with_name("odb_to_csv.py")
    target = tmp_path / "history.csv"
    monkeypatch.setattr(sys, "argv", [str(script), "deck.odb", str(target), "RF2"])
    runpy.run_path(str(script), run_name="__main__")
    assert target.read_text() == "time,RF2 Node TOP.1\n0.1,5\n0.2,6\n1.1,7\n1.2,8\n"
    compile(script.read_text(), str(script), "exec", flags=0)
