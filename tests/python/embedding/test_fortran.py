"""The module of Fortran: everything that it has, and what its compiler and its types refuse."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from programs import MARKS, compiler, loop, numbers, output, run

import curvewise
from curvewise.materials import ChabocheVoce

pytestmark = MARKS

FLAGS = ["-std=f2018", "-Wall", "-Wextra", "-pedantic", "-Werror", "-fcheck=all"]


def compiled(prefix, source: Path, *flags: str) -> list[str | Path]:
    """Return the command that compiles a program with the module and the static library."""
    place = prefix("static")
    module = place / "include" / "curvewise" / "curvewise.f90"
    archive = [place / "lib" / "libcurvewise.a", "-lstdc++", "-pthread"]
    program = source.parent / source.stem
    modules = ["-J", source.parent]
    return ["gfortran", *FLAGS, *flags, *modules, module, source, *archive, "-o", program]


def expected() -> dict[str, float]:
    P, Q = loop(129, 0.5), loop(65, 0.375)
    many = [loop(9, 0.0625 * i) for i in range(1, 101)]
    scaled, raw = (curvewise.compare(P, Q, preset=one).to_dict() for one in ("scaled", "raw"))
    dtw_path = curvewise.dtw_path(P, Q, step_pattern="symmetric2")
    frechet_path = curvewise.frechet_path(P, Q)
    match = curvewise.pcm_match(P, Q, offsets=17)
    quads = curvewise.area_quads(P, Q)
    kept = [curve for i, curve in enumerate(many) if i != 5]
    of_kept = curvewise.cdist([Q], kept, "frechet")[0]
    steel = ChabocheVoce(backstresses=1)
    constants = dict(zip(steel.names, (200e3, 250.0, 0.0, 1.0, 60e3, 300.0), strict=True))
    responded = steel.response_and_slopes([300.0, -0.01], [True, False], constants)
    return {
        "area": scaled["area"],
        "curve_length": scaled["curve_length"],
        "raw_dtw": raw["dtw"],
        "path_distance": dtw_path.distance,
        "path_length": len(dtw_path.path),
        "path_sum": np.sum(dtw_path.path + 1),
        "frechet_distance": frechet_path.distance,
        "frechet_sum": np.sum(frechet_path.path + 1),
        "pcm": match.value,
        "coverage": match.coverage,
        "maps_p": 0.0,
        "quads": quads.quads[19, 2, 1],
        "areas": quads.areas[19],
        "split": curvewise.area(P, Q, crossing="split", squared=True),
        "polygon": curvewise.area(P, Q, crossing="polygon", closed=True),
        "continuous": curvewise.frechet_continuous(P, Q),
        "closed_dtw": curvewise.dtw(P, Q, closed=True),
        "closed_frechet": curvewise.frechet(P, Q, closed=True),
        "closed_continuous": curvewise.frechet_continuous(P, Q, closed=True),
        "cutoff": 1.0,
        "prepared": curvewise.frechet(Q, many[0]),
        "below_cutoff": np.count_nonzero(curvewise.cdist([Q], many, "frechet") <= 0.5),
        "size": 99.0,
        "nearest": float([*range(1, 6), *range(7, 101)][int(np.argmin(of_kept))]),
        "third": np.sort(of_kept)[2],
        "within": 99.0,
        "indices": 5050.0 - 6,
        "third_of_file": np.sort(of_kept)[2],
        "done": 0.0,
        "stopped": 0.0,
        "strain": steel.strain([300.0, -300.0], constants)[1],
        "stress": responded[0][1],
        "by_yield": responded[1][1, 1],
        "driven": steel.stress([0.01], constants)[0],
    }


def test_everything_that_the_module_has(prefix, tmp_path) -> None:
    """The address sanitizer reports what is not freed, too."""
    compiler("gfortran")
    source = tmp_path / "features.f90"
    source.write_text((Path(__file__).parent / "features.f90").read_text(encoding="utf-8"))
    output(*compiled(prefix, source, "-fsanitize=address"))
    printed = output(tmp_path / "features", cwd=tmp_path, ASAN_OPTIONS="detect_leaks=1")
    found = numbers(printed)
    wanted = expected()
    assert {name: found[name] for name in wanted} == wanted
    for name, sum_of in (
        ("points", curvewise.pcm_match(loop(129, 0.5), loop(65, 0.375), offsets=17).points[:, 1]),
        ("pdist", curvewise.pdist([loop(9, 0.0625 * i) for i in range(1, 101)], "dtw")),
    ):
        assert found[name] == pytest.approx(np.sum(sum_of))
    assert "no file: " in printed
    assert "none.index" in printed
    assert "removed twice: indices[0] is 5" in printed
    assert "no neighbours: n_neighbors is 0" in printed
    assert "stopped: stopped before the work was done" in printed


REFUSED = """
program refused
    use curvewise
    implicit none
    double precision, target :: X(2, 9)
    double precision :: untargeted(9, 2)
    type(curve_view) :: view
    X = 0
    untargeted = 0
    view = curve_view(%s)
end program
"""


@pytest.mark.parametrize("points", ["transpose(X)", "untargeted", "2 * transpose(X)"])
def test_the_compiler_refuses_a_view_of_a_temporary(points, prefix, tmp_path) -> None:
    compiler("gfortran")
    source = tmp_path / "refused.f90"
    for given, is_right in ((points, False), ("X(:, 1:9:2)", True)):
        source.write_text(REFUSED % given)
        done = run(*compiled(prefix, source))
        assert (done.returncode == 0) == is_right, done.stdout
        assert is_right or f"view = curve_view({points})" in done.stdout


@pytest.mark.parametrize("kind", ["prepared_curve", "curve_index", "call_control"])
def test_a_handle_is_not_assigned(kind, prefix, tmp_path) -> None:
    compiler("gfortran")
    source = tmp_path / "assigned.f90"
    declaration = f"use curvewise\nimplicit none\ntype({kind}) :: a, b\n"
    source.write_text(f"program assigned\n{declaration}a = b\nend program\n")
    output(*compiled(prefix, source))
    done = run(tmp_path / "assigned")
    assert done.returncode != 0
    assert f"a {kind} cannot be assigned" in done.stdout
