"""curvewise.jax: values with the bits of numpy's functions, under jit, vmap and grad.

JAX is imported where it is used: every process of a run collects this file, one runs it.
"""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import pytest
from test_torch import every_loss, pairs

import curvewise

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
pytestmark = pytest.mark.skipif(
    find_spec("jax") is None, reason='no JAX: pip install "curvewise[jax]"'
)


@pytest.fixture(autouse=True)
def _with_float64(monkeypatch):
    """Compute in float64, and with the compiled library if JAX sees a GPU too."""
    import jax

    monkeypatch.setattr(curvewise.jax, "_stays", lambda: False)
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


@every_loss
def test_under_jit_vmap_and_grad(name, options) -> None:
    import jax
    import jax.numpy as jnp

    def loss(p, q):
        return getattr(curvewise.jax, name)(p, q, **options)

    P, Q = pairs(3)
    values, by_P, by_Q = curvewise.values_and_gradients(P, Q, name, **options)
    p, q = jnp.array(P), jnp.array(Q)
    for function in (loss, jax.jit(loss), jax.vmap(loss), jax.jit(jax.vmap(loss))):
        assert function(p, q).tolist() == values.tolist()
    slopes = jax.grad(lambda p, q: loss(p, q).sum(), argnums=(0, 1))(p, q)
    assert (np.asarray(slopes[0]) == by_P).all()
    assert (np.asarray(slopes[1]) == by_Q).all()
    one_by_one = jax.jit(jax.vmap(jax.grad(loss, argnums=1)))(p, q)
    assert (np.asarray(one_by_one) == by_Q).all()
    assert loss(p[0], q)[0] == values[0]
    assert jax.vmap(lambda q: loss(p[0], q))(q)[0] == values[0]


def test_slopes_are_limits_of_differences() -> None:
    import jax
    from jax.test_util import check_grads

    P, Q = pairs(1)
    for name, options in (("soft_dtw", {"gamma": 0.3}), ("area", {"spacing": "matched"})):

        def loss(p, q, name=name, options=options):
            return getattr(curvewise.jax, name)(p, q, **options)

        check_grads(loss, (P[0], Q[0]), order=1, modes=["rev"], eps=1e-5)
    assert jax.grad(loss)(P[0], Q[0]).shape == P[0].shape


def test_float32_is_computed_in_float64() -> None:
    import jax.numpy as jnp

    P, Q = (jnp.array(curves, dtype=jnp.float32) for curves in pairs(2))
    found = curvewise.jax.dtw(P, Q)
    expected, _, _ = curvewise.values_and_gradients(np.asarray(P, float), np.asarray(Q, float))
    assert found.dtype == jnp.float32
    assert found.tolist() == expected.astype(np.float32).tolist()


def test_errors() -> None:
    import jax
    import jax.numpy as jnp

    zeros = jnp.zeros
    with pytest.raises(ValueError, match="both need the same number of coordinates"):
        jax.jit(curvewise.jax.dtw)(zeros((2, 3)), zeros((2, 1)))
    with pytest.raises(ValueError, match="give as many curves of each"):
        curvewise.jax.dtw(zeros((2, 2, 2)), zeros((3, 2, 2)))
    with pytest.raises(TypeError, match="dtw has no option 'foo'"):
        curvewise.jax.dtw(zeros((2, 1)), zeros((2, 1)), foo=1)
    with pytest.raises(TypeError, match="P is complex"):
        curvewise.jax.dtw(zeros((2, 1), dtype=complex), zeros((2, 1)))
    with pytest.raises(Exception, match=r"P\[0, 0\] is nan; curves must be finite"):
        jax.block_until_ready(curvewise.jax.dtw(jnp.full((1, 1), jnp.nan), zeros((2, 1))))
    with pytest.raises(NotImplementedError, match="pcm has no derivative"):
        curvewise.jax.pcm(zeros((2, 2)), zeros((2, 2)))


def test_second_derivatives_are_refused() -> None:
    import jax
    import jax.numpy as jnp

    def loss(q):
        return curvewise.jax.dtw(jnp.zeros((2, 1)), q)

    q = jnp.ones((3, 1))
    for second in (jax.hessian(loss), jax.grad(lambda q: jax.grad(loss)(q).sum())):
        with pytest.raises(NotImplementedError, match="first derivatives only"):
            second(q)
