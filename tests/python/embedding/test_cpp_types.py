"""What a C++ compiler says of calls: designated initialisers pass, forgotten results do not."""

from __future__ import annotations

from pathlib import Path

import pytest
from programs import MARKS, ROOT, WARNINGS, compiler, run

pytestmark = MARKS

PROGRAM = """
#include <curvewise/curvewise.hpp>
using namespace curvewise;
double use(const std::vector<CurveView>& X, const CurveView& P, const CurveView& Q) {{
    double sum = 0.0;
    {statement}
    return sum + P(0, 0) + Q(0, 0) + X[0](0, 0);
}}
"""

# A member without a default would be a warning where the initialiser leaves it out.
DESIGNATED = [
    "sum += dtw(P, Q, {.step_pattern = StepPattern::symmetric2, .window = 3, .cutoff = 10.0});",
    "sum += dtw(P, Q, {.ground = {.metric = Metric::minkowski, .p = 3}, .workers = 2});",
    "sum += frechet(P, Q, {.cutoff = 2.0});",
    "sum += hausdorff(P, Q, HausdorffOptions{.cutoff = 2.0});",
    "sum += soft_dtw(P, Q, {.gamma = 2.0});",
    "sum += area(P, Q, {.squared = true}) + pcm(P, Q, {.continuous = true});",
    "sum += closed_dtw(P, Q, {.ground = {.metric = Metric::cityblock}});",
    "sum += pdist(X, DtwOptions{.normalize = true}, {.cutoff = 2.0})[0];",
    "SearchOptions o{.sort_results = false}; sum += static_cast<double>(o.workers);",
    "ChabocheVoce o{.modulus = Modulus::decaying}; sum += o.backstresses;",
]

FORGOTTEN = [
    "dtw(P, Q);",
    "frechet_path(P, Q);",
    "compare(P, Q);",
    "evaluate(DtwOptions(), P, Q);",
    "cdist(X, X, DtwOptions());",
    "pdist(X, DtwOptions());",
    "Index(X, DtwOptions()).radius_neighbors(1.0);",
    "Prepared(P, DtwOptions())(Q);",
]


def compiled(cxx: str, statement: str, folder: Path):
    compiler(cxx)
    source = folder / "statement.cpp"
    source.write_text(PROGRAM.format(statement=statement))
    include = f"-I{ROOT / 'cpp' / 'include'}"
    return run(cxx, "-std=c++20", *WARNINGS, include, "-fsyntax-only", source)


@pytest.mark.parametrize("cxx", ["g++", "clang++"])
def test_designated_initialisers(cxx, tmp_path) -> None:
    blocks = " ".join(f"{{ {statement} }}" for statement in DESIGNATED)
    done = compiled(cxx, blocks, tmp_path)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("cxx", ["g++", "clang++"])
def test_a_forgotten_result_is_a_warning(cxx, tmp_path) -> None:
    blocks = "\n".join(f"{{ {statement} }}" for statement in FORGOTTEN)
    done = compiled(cxx, blocks, tmp_path)
    assert done.returncode != 0
    for statement in FORGOTTEN:
        assert f"{{ {statement} }}" in done.stdout, done.stdout
    assert "nodiscard" in done.stdout
