"""The examples in cpp/examples, and the limits of embedding: unchanged results, no exported
symbols.

Each example is built by CMake with the static and with the shared library. Its output equals
Python's results, to the last bit. See test_embed.py for the rest.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from programs import (
    MARKS,
    ROOT,
    WARNINGS,
    build,
    compiler,
    eigen,
    loop,
    numbers,
    output,
    pkg_config,
    write_page,
)

import curvewise
from curvewise.materials import ChabocheVoce

pytestmark = MARKS

EXAMPLES = ROOT / "cpp" / "examples"


P, Q = loop(129, 0.5), loop(65, 0.375)


def test_quickstart(examples) -> None:
    p = [(0.0, 0.0), (0.1, 1.3), (0.3, 2.2), (0.7, 2.9)]
    q = [(0.0, 0.1), (0.2, 1.6), (0.8, 2.7)]
    *values, path = output(examples / "quickstart").splitlines()
    measures = ["area", "pcm", "frechet", "dtw", "curve_length"]
    assert numbers("\n".join(values)) == {name: getattr(curvewise, name)(p, q) for name in measures}
    alignment = curvewise.dtw_path(p, q, metric="cityblock", step_pattern="symmetric2")
    pairs = " ".join(f"{i},{j}" for i, j in alignment.path)
    assert path == f"dtw_path {alignment.distance:.17g} {pairs}"


@pytest.mark.parametrize("preset", ["scaled", "paper", "raw"])
def test_compare_csv(preset, examples, tmp_path) -> None:
    experiment, simulation = curvewise.datasets.hysteresis_pair()
    files = tmp_path / "A.csv", tmp_path / "B.csv"
    np.savetxt(files[0], experiment, "%.17g", ",", header="strain,stress", comments="")
    np.savetxt(files[1], simulation, "%.17g", "; ")
    expected = curvewise.compare(experiment, simulation, preset=preset).to_dict()
    assert numbers(output(examples / "compare_csv", *files, preset)) == expected


def test_compare_csv_says_what_is_wrong(examples) -> None:
    done = subprocess.run([examples / "compare_csv", "none", "none"], capture_output=True)
    assert (done.returncode, done.stderr) == (1, b"compare_csv: none cannot be read\n")


def test_calibrate(examples, tmp_path) -> None:
    """It finds the constants of a loop, and its objective is Python's, to the last bit."""
    strain = curvewise.datasets.hysteresis_pair()[0][:, 0]
    stress = curvewise.datasets.kinematic_hardening(
        strain, youngs_modulus=210e3, yield_stress=250.0, backstresses=[(60e3, 300.0)]
    )
    experiment, fitted = tmp_path / "experiment.csv", tmp_path / "fitted.csv"
    np.savetxt(experiment, np.column_stack([strain, stress]), "%.17g", ",")
    printed = output(examples / "calibrate", experiment, fitted).replace(" MPa", "")
    found = numbers(printed)
    expected = {"E": 210e3, "yield_stress": 250.0, "C": 60e3, "gamma": 300.0}
    assert {name: found[name] for name in expected} == pytest.approx(expected, rel=1e-4)
    measured, simulated = (np.loadtxt(file, delimiter=",") for file in (experiment, fitted))
    assert found["area"] == curvewise.area(measured, simulated, spacing="x")


def test_batch(examples) -> None:
    loops = [loop(65 if i % 2 == 0 else 129, 0.125 * i) for i in range(40)]
    done = subprocess.run([examples / "batch"], capture_output=True, text=True, check=True)
    *values, last = done.stdout.splitlines()
    expected = curvewise.pdist(loops, "dtw", step_pattern="symmetric2")
    assert list(map(float, values)) == expected.tolist()
    assert last == "stopped before the work was done"
    assert done.stderr.endswith("100 %\n")


def test_nearest(examples) -> None:
    library = [loop(65 if i % 2 == 0 else 129, 0.125 * i) for i in range(40)]
    test = loop(65, 1.3)
    index = curvewise.Index(library)
    distances, indices = index.kneighbors([test], 3)
    lines = [f"{i} {d:.17g}" for i, d in zip(indices[0], distances[0], strict=True)]
    near = index.radius_neighbors([test], 10.0, return_distance=False)[0]
    lines += [f"within 10: {i}" for i in near]
    record = np.concatenate([loop(65, height) for height in (0.5, 1.5, 1.0, 1.25)])
    found = curvewise.subsequence(test, record, k=2)
    lines += [f"{one.start} to {one.stop}: {one.distance:.17g}" for one in found]
    assert output(examples / "nearest").splitlines() == lines
    assert len(near) > 1


STEEL = ChabocheVoce()
CONSTANTS = (200e3, 300.0, -50.0, 8.0, 80e3, 400.0, 5e3, 20.0)
DRIVEN, SLOPES = STEEL.stress_and_slopes(
    [0.001, 0.02, -0.02], dict(zip(STEEL.names, CONSTANTS, strict=True))
)

C_VALUES = {
    "area": curvewise.area(P, Q),
    "pcm": curvewise.pcm(P, Q),
    "frechet": curvewise.frechet(P, Q),
    "dtw": curvewise.dtw(P, Q, step_pattern="symmetric2", window=80),
    "curve_length": curvewise.curve_length(P, Q, scale="range"),
    "P_and_Q": curvewise.dtw(P, Q, step_pattern="symmetric2", window=80),
    "P_and_beginning": curvewise.dtw(P, P[:60], step_pattern="symmetric2", window=80),
    "Q_and_beginning": curvewise.dtw(Q, P[:60], step_pattern="symmetric2", window=80),
    "driven": DRIVEN[2],
    "driven_by_yield": SLOPES[2, 1],
}
FORTRAN_VALUES = {
    **C_VALUES,
    "scaled": curvewise.dtw(P, curvewise.normalize(P, Q)[1]),
    "section": curvewise.dtw(P[::2], Q[::-1]),
    "stress": curvewise.dtw(P[:, 1], Q[:, 1]),
    "history": curvewise.dtw(Q, P),
    "table": curvewise.dtw(P, P[:60]),
}


def test_c_program(examples) -> None:
    printed = output(examples / "c_program")
    assert numbers(printed) == C_VALUES
    assert printed.endswith("refused: Q has shape (1, 2); area needs at least 2 points\n")


def test_fortran_program(examples) -> None:
    compiler("gfortran")
    printed = output(examples / "fortran_program")
    assert numbers(printed) == FORTRAN_VALUES
    assert "refused: P has shape (129, 2) and Q has shape (2, 65); both" in printed


def test_c_and_fortran_without_cmake(prefix, tmp_path) -> None:
    """The commands of the page: the static library brings what C++ needs."""
    for name in ("gcc", "gfortran", "pkg-config"):
        compiler(name)
    folder = write_page(tmp_path / "tool", "c_and_fortran.sh")
    for name in ("c_program.c", "fortran_program.f90"):
        shutil.copy(EXAMPLES / name, folder)
    place = prefix("static")
    output(
        "sh", "-e", "c_and_fortran.sh", cwd=folder, PKG_CONFIG_PATH=str(place / "lib" / "pkgconfig")
    )
    assert numbers(output(folder / "c_program")) == C_VALUES
    assert numbers(output(folder / "fortran_program")) == FORTRAN_VALUES
    strict = ["-std=c99", "-pedantic", *WARNINGS, *pkg_config(place, "--cflags")]
    output("gcc", *strict, "-fsyntax-only", EXAMPLES / "c_program.c")


def test_fortran_project(prefix, tmp_path) -> None:
    compiler("gfortran")
    folder = write_page(tmp_path / "tool", "fortran/CMakeLists.txt")
    shutil.copy(EXAMPLES / "fortran_program.f90", folder)
    flags = "-std=f2018 -Wall -Wextra -pedantic -Werror -fcheck=all"
    build(
        folder,
        tmp_path / "build",
        f"-DCMAKE_PREFIX_PATH={prefix('static')}",
        f"-DCMAKE_Fortran_FLAGS={flags}",
    )
    assert numbers(output(tmp_path / "build" / "model")) == FORTRAN_VALUES


def test_c_project(prefix, tmp_path) -> None:
    """A project of C alone links the runtime of C++ that is in the static library."""
    folder = write_page(tmp_path / "tool", "c/CMakeLists.txt")
    shutil.copy(EXAMPLES / "c_program.c", folder)
    build(folder, tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix('static')}")
    assert numbers(output(tmp_path / "build" / "tool")) == C_VALUES


EIGEN_VALUES = {
    "column_and_row_major": curvewise.dtw(P, Q),
    "strided_map": curvewise.dtw(P, Q),
    "transposed": curvewise.dtw(P, Q),
    "block": curvewise.dtw(P[:40], Q[-50:]),
    "reversed": curvewise.area(P, Q[::-1]),
    "scaled": curvewise.dtw(0.5 * P, Q),
    "flat": curvewise.dtw(P[:, 1], Q[:, 1]),
}


def test_eigen_caller(examples) -> None:
    """-march=native in the caller, not in the library."""
    assert numbers(output(examples / "eigen_caller")) == EIGEN_VALUES


@pytest.mark.parametrize(
    "flag",
    ["-march=native", "-mavx512f -mfma", pytest.param("-mno-avx", marks=pytest.mark.nightly)],
)
@pytest.mark.parametrize("cxx", ["g++", "clang++"])
def test_eigen_caller_under_the_address_sanitizer(cxx, flag, prefix, tmp_path) -> None:
    # Eigen asks for -mfma where there is AVX-512.
    levels = curvewise.installation.build_info()["instruction_sets"]
    if "avx512f" in flag and "v4" not in levels:
        pytest.skip("this machine has no AVX-512")
    if flag == "-mno-avx" and "v3" not in levels:
        pytest.skip("this machine has no AVX")
    compiler(cxx)
    options = ["-std=c++17", "-O1", "-fsanitize=address", *flag.split()]
    flags = pkg_config(prefix("static"), "--cflags", "--libs")
    source, program = EXAMPLES / "eigen_caller.cpp", tmp_path / "eigen_caller"
    # Not warnings of ours: Eigen's headers, on the system path.
    include = ["-isystem", str(eigen() / "include/eigen3")]
    output(cxx, *options, *WARNINGS, *include, source, "-o", program, *flags)
    assert numbers(output(program)) == EIGEN_VALUES


@pytest.mark.nightly
@pytest.mark.skipif(sys.platform != "linux", reason="reads ELF symbols with nm")
def test_the_shared_library_shows_its_interface_alone(prefix) -> None:
    shared = prefix("shared")
    table = output("nm", "-D", "-C", "--defined-only", shared / "lib" / "libcurvewise.so")
    names = [line.split(maxsplit=2)[2] for line in table.splitlines()]
    functions = {re.sub(r"\(.*|\[.*", "", name) for name in names}
    headers = "".join(
        header.read_text(encoding="utf-8")
        for header in (shared / "include" / "curvewise").iterdir()
        if header.suffix in (".h", ".hpp") and header.name != "export.h"
    )
    declared = set(re.findall(r"CURVEWISE_EXPORT[^;(]*?(\w+)\(", headers))
    declared -= {"Stopped", "operator"}
    assert len(declared) >= 25
    expected = {
        name if name.startswith("curvewise_") else f"curvewise::{name}" for name in declared
    }
    expected -= {"curvewise::shape", "curvewise::Prepared"}
    expected |= {"curvewise::CurveView::shape", "curvewise::Prepared::Prepared"}
    expected |= {"curvewise::Prepared::operator"}
    of_index = {"Index", "add", "size", "curves", "kneighbors", "radius_neighbors"}
    expected -= {f"curvewise::{name}" for name in of_index}
    expected |= {f"curvewise::Index::{name}" for name in of_index | {"~Index", "operator="}}
    expected |= {f"{what} for curvewise::Stopped" for what in ("typeinfo", "typeinfo name")}
    # code that constructs one has it; link-time optimisation
    unused = {"vtable for curvewise::Stopped"}
    assert functions - unused == expected


@pytest.mark.parametrize("cxx", ["g++", "clang++"])
@pytest.mark.nightly
def test_headers_compile_fast(cxx, prefix, tmp_path) -> None:
    """Without a warning, each by itself (by one compiler: it is about our own includes)."""
    compiler(cxx)
    installed = prefix("static") / "include"
    include = [f"-I{installed}", "-isystem", str(eigen() / "include/eigen3")]
    command = [cxx, "-std=c++17", *WARNINGS, *include, "-fsyntax-only", "-x", "c++"]
    headers = sorted((installed / "curvewise").glob("*.h*")) if cxx == "g++" else []
    source = tmp_path / "only.cpp"
    for name in [*(header.name for header in headers), "curvewise.hpp"]:
        source.write_text(f"#include <curvewise/{name}>\n")
        output(*command, source)
    compile_it = [cxx, "-std=c++17", *include, "-c", str(source), "-o", str(tmp_path / "only.o")]
    seconds = []
    for _ in range(3):
        before = os.times()
        output(*compile_it)
        after = os.times()
        seconds.append(after.children_user - before.children_user)
    assert min(seconds) < 1.0
