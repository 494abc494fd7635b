"""dtw, soft_dtw and soft_dtw_divergence of arrays on a GPU: the values of the CPU, where they are.

Without a GPU these tests are skipped. test_unequal_losses runs the same operations on the CPU.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from test_unequal_losses import DIAGONALS, LENGTHS, _with_float64, curves_of, one_by_one

import curvewise

__all__ = ["_with_float64"]  # a fixture for all tests here


def gpu(name: str) -> Any:
    """Return the first GPU that a package sees, or None."""
    if find_spec(name) is None:
        return None
    if name == "torch":
        import torch

        return torch.device("cuda") if torch.cuda.is_available() else None
    import jax

    devices = [device for device in jax.devices() if device.platform == "gpu"]
    return devices[0] if devices else None


@pytest.fixture(params=["torch", "jax"])
def name(request) -> str:
    """A package that sees a GPU. It is imported here: every process collects this file."""
    if gpu(request.param) is None:
        pytest.skip(f"no GPU in {request.param}")
    return request.param


def measured(name: str, measure: str, P: list, Q: list, options: dict) -> tuple[Any, list, list]:
    """Return the values, as the package has them, and the derivatives of their sum."""
    device = gpu(name)
    if name == "torch":
        import torch

        given = [
            [torch.tensor(C, device=device, requires_grad=True) for C in part] for part in (P, Q)
        ]
        values = getattr(curvewise.torch, measure)(*given, **options)
        values.sum().backward()
        by_P, by_Q = ([C.grad for C in part] for part in given)
        assert all(slope.device.type == "cuda" for slope in (*by_P, *by_Q))
        return values, *([slope.cpu().numpy() for slope in part] for part in (by_P, by_Q))
    import jax

    def total(P, Q):
        values = getattr(curvewise.jax, measure)(P, Q, **options)
        return values.sum(), values

    given = [[jax.device_put(C, device) for C in part] for part in (P, Q)]
    (_, values), slopes = jax.value_and_grad(total, argnums=(0, 1), has_aux=True)(*given)
    return values, *([np.asarray(slope) for slope in part] for part in slopes)


@pytest.mark.parametrize(("measure", "options"), DIAGONALS)
def test_the_values_of_the_cpu_on_the_gpu(name, measure, options) -> None:
    P, Q = curves_of(LENGTHS[0], 0), curves_of(LENGTHS[1], 1)
    values, by_P, by_Q = measured(name, measure, P, Q, options)
    place = values.device.type if name == "torch" else next(iter(values.devices())).platform
    assert place in ("cuda", "gpu")
    numbers = values.detach().cpu().numpy() if name == "torch" else np.asarray(values)
    for k, (value, slope_P, slope_Q) in enumerate(one_by_one(measure, P, Q, options)):
        assert numbers[k] == pytest.approx(value, rel=1e-10, abs=1e-10)
        np.testing.assert_allclose(by_P[k], slope_P, rtol=1e-8, atol=1e-8)
        np.testing.assert_allclose(by_Q[k], slope_Q, rtol=1e-8, atol=1e-8)


def test_other_losses_return_to_the_gpu(name) -> None:
    P, Q = curves_of(LENGTHS[0], 2), curves_of(LENGTHS[1], 3)
    values, by_P, _ = measured(name, "frechet", P, Q, {})
    numbers = values.detach().cpu().numpy() if name == "torch" else np.asarray(values)
    for k, (value, slope_P, _) in enumerate(one_by_one("frechet", P, Q, {})):
        assert numbers[k] == value
        assert (by_P[k] == slope_P).all()
