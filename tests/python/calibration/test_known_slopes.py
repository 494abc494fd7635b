"""Slopes that a model knows take the place of runs: in the trust region and in the uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from curvewise.calibration import TrustRegion, identify
from curvewise.materials import ChabocheVoce, DrivenModel

MATERIAL = ChabocheVoce(backstresses=1)
MADE_OF = dict(zip(MATERIAL.names, (200e3, 300.0, 60.0, 8.0, 80e3, 400.0), strict=True))
STRAIN = np.interp(np.arange(91) / 30, range(4), (0.0, 0.02, -0.02, 0.02))
LOOP = np.column_stack((STRAIN, MATERIAL.stress(STRAIN, MADE_OF)))
BOUNDS = {name: (0.4 * value, 2.2 * value) for name, value in MADE_OF.items()}
MODEL = MATERIAL.driven_by(LOOP)


@dataclass
class WithoutSlopes:
    """The same model, which says nothing of its slopes."""

    model: DrivenModel

    def __call__(self, parameters):
        return self.model(parameters)


@pytest.fixture(scope="module")
def found():
    return identify(MODEL, LOOP, BOUNDS, method=TrustRegion(starts=1), progress=False)


def test_the_trust_region_needs_no_runs_for_slopes(found) -> None:
    for name, value in MADE_OF.items():
        assert found.parameters[name] == pytest.approx(value, rel=1e-3), name
    blind = identify(
        WithoutSlopes(MODEL),
        LOOP,
        BOUNDS,
        method=TrustRegion(starts=1),
        max_runs=2 * found.evaluations,
        progress=False,
    )
    assert blind.value > 10.0 * found.value
    assert blind.evaluations == 2 * found.evaluations


def test_the_uncertainty_needs_no_runs_for_slopes(found) -> None:
    assert found.uncertainty_runs == 0
    assert found.uncertainty(sigma=1.0, samples=20).runs == 0


def test_known_slopes_give_the_errors_that_differences_give(found) -> None:
    problem = found.problem
    exact = found.uncertainty(sigma=1.0)
    blind = identify(
        WithoutSlopes(MODEL),
        LOOP,
        BOUNDS,
        start=found.parameters,
        method=TrustRegion(starts=1),
        progress=False,
    ).uncertainty(sigma=1.0)
    for name in problem.space.names:
        assert exact.standard_errors[name] == pytest.approx(blind.standard_errors[name], rel=0.1)
