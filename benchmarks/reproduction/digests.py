"""Which code made a result: digests of the files that decide it, part by part.

A result depends on its task and on code. Counted is what decides numbers: the search of each of its
methods with the problem that it searches, the objective, the compiled measures, and the model. Not
counted is what only passes on, stores or shows (`calibration/answers`, `records`, `report`; the
measures' Python functions, whose defaults stand in the C++ headers that are counted), and searches
that the paper does not use (TrustRegion, LeastSquares, Global). A test runs every kind of task and
fails if code is called that neither list has.

Comments, docstrings and blank lines do not count, nor how C++ is broken into lines, so that an
edit of prose makes nothing stale. Python's files are those of the package that is imported, C++'s
those beside this folder, from which it is to be built. Cost: a few milliseconds, once a process.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import io
import platform
import re
import tokenize
from collections.abc import Iterable
from pathlib import Path

import numpy
import scipy
from arithmetic import is_held

import curvewise
from curvewise.installation import build_info

HERE = Path(__file__).resolve().parent
PACKAGE = Path(curvewise.__file__).resolve().parent
CPP = HERE.parents[1] / "cpp"

CALIBRATION = PACKAGE / "calibration"
SEARCH = (
    HERE / "studies.py",
    CALIBRATION / "answers" / "search.py",
    CALIBRATION / "identify.py",
    CALIBRATION / "methods" / "method.py",
    CALIBRATION / "objective" / "sampling.py",
    CALIBRATION / "problem" / "endings.py",
    CALIBRATION / "problem" / "evaluations.py",
    CALIBRATION / "problem" / "execution.py",
    CALIBRATION / "problem" / "ledger.py",
    CALIBRATION / "problem" / "problem.py",
    CALIBRATION / "problem" / "simulator.py",
    CALIBRATION / "problem" / "space.py",
)
METHODS = {
    "de": (
        CALIBRATION / "methods" / "called_back.py",
        CALIBRATION / "methods" / "differential_evolution.py",
    ),
    "nelder-mead": (
        CALIBRATION / "methods" / "called_back.py",
        CALIBRATION / "methods" / "simplex.py",
    ),
    "sdrm": (
        CALIBRATION / "methods" / "domain_reduction.py",
        CALIBRATION / "surfaces" / "inner_search.py",
        CALIBRATION / "surfaces" / "largest_distances.py",
        CALIBRATION / "surfaces" / "quasi_newton.py",
        CALIBRATION / "surfaces" / "steps.py",
        CALIBRATION / "surfaces" / "surfaces.py",
        PACKAGE / "curves" / "thinning.py",
        PACKAGE / "measures" / "gradient.py",
    ),
}
FOLDS = (CALIBRATION / "cross_validation.py", CALIBRATION / "models" / "forward.py")
OBJECTIVE = (
    CALIBRATION / "objective" / "criterion.py",
    CALIBRATION / "objective" / "objective.py",
    CALIBRATION / "objective" / "of_simulation.py",
    CALIBRATION / "objective" / "terms.py",
    PACKAGE / "curves" / "scaling.py",
)
HEADERS = ("area", "curve_length", "dtw", "frechet", "gradient", "ground_distance", "pcm")
KERNELS = (
    *(CPP / "include" / "curvewise" / f"{name}.hpp" for name in HEADERS),
    CPP / "src" / "curves",
    CPP / "src" / "planar",
    CPP / "src" / "warping",
)
MODEL = (HERE / "problems.py",)
MATERIAL = (
    PACKAGE / "materials" / "point.py",
    PACKAGE / "materials" / "yoshida_uemori.py",
    CPP / "src" / "materials" / "dual.hpp",
    CPP / "src" / "materials" / "flow_series.hpp",
    CPP / "src" / "materials" / "law.hpp",
    CPP / "src" / "materials" / "law.inl.hpp",
    CPP / "src" / "materials" / "path.cpp",
    CPP / "src" / "materials" / "path.hpp",
    CPP / "src" / "materials" / "yoshida_uemori.cpp",
    CPP / "src" / "materials" / "yoshida_uemori.hpp",
    CPP / "src" / "materials" / "yoshida_uemori_course.hpp",
    CPP / "src" / "materials" / "yoshida_uemori_flow.hpp",
    CPP / "src" / "materials" / "yoshida_uemori_steady.hpp",
)

# What runs besides in a task, and decides no number.
NOT_COUNTED = (
    "__init__.py",
    "_environment.py",
    "_extras.py",
    "_names.py",
    "_options.py",
    "calibration/answers/",
    "calibration/methods/__init__.py",
    "calibration/models/",
    "calibration/objective/noisy_tests.py",
    "calibration/problem/details.py",
    "calibration/records/",
    "curves/foreign_curves.py",
    "curves/inputs.py",
    "curves/labels.py",
    "curves/layouts.py",
    "curves/missing.py",
    "curves/named_curve.py",
    "curves/several_curves.py",
    "installation.py",
    "many/",
    "measures/",
    "showing/",
)


def code_digests(methods: Iterable[str], *, folds: bool, material: bool) -> dict[str, str]:
    """Return the digest of each part of the code that makes a result.

    `methods` are the names of its stages, `folds` tells a cross-validation, `material` a model that
    is a point of material.
    """
    searches = [file for method in methods for file in METHODS[method]]
    return {
        "search": _digest((*SEARCH, *searches, *(FOLDS if folds else ()))),
        "objective": _digest(OBJECTIVE),
        "kernels": _digest(KERNELS),
        "model": _digest((*MODEL, *(MATERIAL if material else ()))),
    }


@functools.cache
def made_with() -> str:
    """Return what else the last bits depend on: libraries and processor."""
    libc = " ".join(platform.libc_ver()) or platform.platform()
    libraries = f"numpy {numpy.__version__}, scipy {scipy.__version__}, {libc}"
    if is_held():
        return f"{libraries}, numpy and BLAS held to AVX2"
    return f"{libraries}, {build_info()['active']} on {_processor()}"


def _processor() -> str:
    """Return the processor's name: by it numpy and BLAS choose their arithmetic."""
    information = Path("/proc/cpuinfo")
    text = information.read_text() if information.exists() else ""
    found = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)
    return found[1] if found else platform.processor() or platform.machine()


def _digest(places: tuple[Path, ...]) -> str:
    files = {file for place in places for file in _files(place)}
    return _digest_of(tuple(sorted(files, key=lambda file: (file.name, file.as_posix()))))


@functools.cache
def _digest_of(files: tuple[Path, ...]) -> str:
    text = "\0".join(f"{file.name}\0{code_of(file)}" for file in files)
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def _files(place: Path) -> list[Path]:
    if not place.exists():
        raise FileNotFoundError(f"{place} counts for the paper's results and is not there")
    if place.is_file():
        return [place]
    return [file for file in place.rglob("*") if file.suffix in {".py", ".cpp", ".hpp"}]


@functools.cache
def code_of(file: Path) -> str:
    """Return the code of a file, without comments, docstrings and blank lines."""
    text = file.read_text(encoding="utf-8")
    return _python_code(text) if file.suffix == ".py" else _cpp_code(text)


def _python_code(text: str) -> str:
    lines = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            row, column = token.start
            lines[row - 1] = lines[row - 1][:column]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            for row in range(node.lineno, (node.end_lineno or node.lineno) + 1):
                lines[row - 1] = ""
    return "\n".join(line.rstrip() for line in lines if line.strip())


_CPP = re.compile(
    r"""(?P<kept>"(?:\\.|[^"\\\n])*"|'(?:\\[^'\n]+|[^'\\\n])')|//[^\n]*|/\*.*?\*/""", re.DOTALL
)


def _cpp_code(text: str) -> str:
    without = _CPP.sub(lambda match: match["kept"] or " ", text)
    return " ".join(without.split())
