"""CommandModel with CalculiX, where it is installed."""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from solver_scripts import posix, wait_until

from curvewise.calibration import CommandModel, SolverError

CCX = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed: apt calculix-ccx"
)

CUBE = """*NODE,NSET=ALL
1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1
*ELEMENT,TYPE=C3D8,ELSET=CUBE
1,1,2,3,4,5,6,7,8
*MATERIAL,NAME=STEEL
*ELASTIC
<<E:.6g>>,0.3
*PLASTIC
<<yield:.6g>>,0.
<<hardened:.6g>>,1.
*SOLID SECTION,ELSET=CUBE,MATERIAL=STEEL
*BOUNDARY
1,1,3\n4,1\n4,3\n5,1,2\n8,1\n2,2,3\n3,3\n6,2
*STEP,INC=100
*STATIC,DIRECT
0.1,1.
*BOUNDARY
2,1,1,0.01\n3,1,1,0.01\n6,1,1,0.01\n7,1,1,0.01
*EL PRINT,ELSET=CUBE
S
*END STEP
"""


def axial_stress(folder: Path) -> Any:
    """Return strain and axial stress at the first integration point, for every increment."""
    rows = [line.split() for line in (folder / "deck.dat").read_text().splitlines()]
    stress = [float(row[2]) for row in rows if row[:2] == ["1", "1"]]
    return np.column_stack([np.linspace(0.001, 0.01, len(stress)), stress])


def calculix(
    tmp_path: Path, deck: str = CUBE, command: Sequence[str] = ("ccx", "-i", "deck")
) -> CommandModel:
    template = tmp_path / "deck.inp"
    template.write_text(deck)
    return CommandModel(
        template,
        command,
        axial_stress,
        parameters=["E", "yield", "hardened"],
        timeout=60,
        environment={"OMP_NUM_THREADS": "1"},
        scratch=tmp_path,
    )


@CCX
def test_calculix_follows_linear_hardening(tmp_path: Path) -> None:
    E, H = 200e3, 2000.0
    curve = calculix(tmp_path)({"E": E, "yield": 300.0, "hardened": 300.0 + H})
    strain = np.linspace(0.001, 0.01, 10)
    stress = np.minimum(E * strain, (300.0 + H * strain) / (1.0 + H / E))
    np.testing.assert_allclose(curve, np.column_stack([strain, stress]), rtol=1e-5)


@CCX
def test_calculix_that_diverges_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match="ccx ended with exit code 201") as caught:
        calculix(tmp_path)({"E": 200e3, "yield": 300.0, "hardened": -250e3})
    first, *quoted = str(caught.value).splitlines()
    assert "no convergence" in Path(first.rpartition("log: ")[2]).read_text()
    assert any("solution seems to diverge" in line for line in quoted)


@CCX
@posix
def test_calculix_that_is_killed_is_an_error(tmp_path: Path) -> None:
    long_run = CUBE.replace("INC=100", "INC=1000000").replace("0.1,1.", "1e-6,1.")
    model = calculix(tmp_path, long_run, ["sh", "-c", "echo $$ > pid; exec ccx -i deck"])
    with ThreadPoolExecutor(1) as pool:
        run = pool.submit(model, {"E": 200e3, "yield": 300.0, "hardened": 2300.0})
        # deck.sta appears when the first increment is computed.
        wait_until(lambda: list(tmp_path.glob("curvewise_*/deck.sta")))
        (pid,) = tmp_path.glob("curvewise_*/pid")
        os.kill(int(pid.read_text()), signal.SIGKILL)
        with pytest.raises(SolverError, match="was killed by signal 9"):
            run.result()
