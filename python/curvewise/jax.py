"""The measures as losses of JAX: differentiable in both curves, of pairs or of batches of them.

Values and derivatives are those of :func:`curvewise.values_and_gradients`, to the bit, computed in
float64 on the CPU by all its cores, as a callback (``jax.pure_callback``) with derivatives of its
own (``jax.custom_vjp``). For ``jax.jit``, ``jax.vmap`` and ``jax.grad``. ``pip install
"curvewise[jax]"``. JAX has float64 only where it is asked for it (``jax_enable_x64``); else values
are computed in float64 of float32 coordinates, and returned as float32.

They are not differentiated again, nor forwards: JAX refuses both. Errors of shapes and options are
those of numpy's functions; what is found out about the numbers, where a program is compiled, JAX
raises as an error of its own that has the same words in it.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NoReturn, TypeAlias

import numpy as np

from ._extras import extra
from ._loss_texts import documented_loss
from .curves.layouts import ask_about_curves
from .measures.gradient import NO_DERIVATIVE_OF_PCM, check_pairs, of_arrays

with extra("jax", "curvewise.jax needs JAX"):
    # Absolute, so this is the package of that name and not this module.
    import jax
    import jax.numpy as jnp
    from jax import Array

__all__ = ["area", "curve_length", "dtw", "frechet", "frechet_continuous", "pcm", "soft_dtw"]

Options: TypeAlias = tuple[tuple[str, Any], ...]


@documented_loss("Array")
def area(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.area` of arrays, differentiable in both.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[0.0, 0.0], [1.0, 0.0]])
    >>> Q = jnp.array([[0.0, 1.0], [1.0, 2.0]])
    >>> loss, slopes = jax.value_and_grad(curvewise.jax.area, argnums=1)(P, Q)
    >>> loss.item(), slopes.tolist()
    (1.5, [[-1.0, 0.5], [0.5, 0.5]])
    """
    return _measured("area", P, Q, options)


@documented_loss("Array")
def curve_length(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.curve_length` of arrays, differentiable in both.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[1.0, 1.0], [2.0, 2.0]])
    >>> Q = jnp.array([[1.0, 1.5], [2.0, 2.5]])
    >>> round(curvewise.jax.curve_length(P, Q).item(), 4)
    0.4068
    """
    return _measured("curve_length", P, Q, options)


@documented_loss("Array")
def dtw(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.dtw` of arrays, differentiable in both.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[0.0], [1.0], [2.0]])
    >>> Q = jnp.array([[0.5], [1.25], [4.0]])
    >>> loss, slopes = jax.value_and_grad(curvewise.jax.dtw, argnums=1)(P, Q)
    >>> loss.item(), slopes.ravel().tolist()
    (2.75, [1.0, 1.0, 1.0])
    """
    return _measured("dtw", P, Q, options)


@documented_loss("Array")
def frechet(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.frechet` of arrays, differentiable in both.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[0.0], [1.0], [2.0]])
    >>> Q = jnp.array([[0.5], [1.25], [4.0]])
    >>> loss, slopes = jax.value_and_grad(curvewise.jax.frechet, argnums=1)(P, Q)
    >>> loss.item(), slopes.ravel().tolist()
    (2.0, [0.0, 0.0, 1.0])
    """
    return _measured("frechet", P, Q, options)


@documented_loss("Array")
def frechet_continuous(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.frechet_continuous` of arrays, differentiable in both.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[0.0, 0.0], [10.0, 0.0]])
    >>> Q = jnp.array([[0.0, 0.0], [5.0, 2.0], [10.0, 0.0]])
    >>> loss, slopes = jax.value_and_grad(curvewise.jax.frechet_continuous, argnums=1)(P, Q)
    >>> loss.item(), slopes.tolist()
    (2.0, [[0.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    """
    return _measured("frechet_continuous", P, Q, options)


@documented_loss("Array")
def soft_dtw(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.soft_dtw` of arrays, differentiable in both, everywhere.

    {loss}

    Examples
    --------
    >>> import jax
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = jnp.array([[0.0], [1.0], [2.0]])
    >>> Q = jnp.array([[0.0], [1.0], [3.0]])
    >>> def loss(Q):
    ...     return curvewise.jax.soft_dtw(P, Q, gamma=0.1)
    >>> round(loss(Q).item(), 4), round(jax.grad(loss)(Q)[2].item(), 4)
    (1.0, 2.0)
    """
    return _measured("soft_dtw", P, Q, options)


def pcm(P: Array, Q: Array, **options: Any) -> NoReturn:
    """Refuse: partial curve mapping has no useful derivative.

    Its offset is the best of a row of places along the longer curve, and which of the two curves is
    mapped is decided by their lengths: it jumps where another is best.

    Parameters
    ----------
    P, Q : Array
        Not looked at.
    **options
        Not looked at.

    Raises
    ------
    NotImplementedError
        Always, with advice.

    Examples
    --------
    >>> import curvewise.jax
    >>> curvewise.jax.pcm(None, None)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    NotImplementedError: pcm has no derivative: ...
    """
    raise NotImplementedError(NO_DERIVATIVE_OF_PCM)


def _measured(measure: str, P: Any, Q: Any, options: dict[str, Any]) -> Array:
    P, Q = jnp.asarray(P), jnp.asarray(Q)
    for curve, name in ((P, "P"), (Q, "Q")):
        if jnp.iscomplexobj(curve):
            raise TypeError(f"{name} is complex; curves have real coordinates")
    P, Q = (C if jnp.issubdtype(C.dtype, jnp.floating) else C.astype(float) for C in (P, Q))
    if P.ndim == 2 and Q.ndim == 3:
        P = jnp.broadcast_to(P, (len(Q), *P.shape))
    elif P.ndim == 3 and Q.ndim == 2:
        Q = jnp.broadcast_to(Q, (len(P), *Q.shape))
    check_pairs(P.shape, Q.shape)
    ask_about_curves(P, Q, batched=True)
    none = [np.empty((0, *curve.shape[-2:])) for curve in (P, Q)]
    of_arrays(none[0], none[1], measure, options)  # which are refused here, if at all
    return _measure(P, Q, measure, tuple(options.items()))


@partial(jax.custom_vjp, nondiff_argnums=(2, 3))
def _measure(P: Array, Q: Array, measure: str, options: Options) -> Array:
    """Call back for the values alone."""
    return _called_back(P, Q, measure, options, by=False)[0]


def _forward(P: Array, Q: Array, measure: str, options: Options) -> tuple[Array, Any]:
    values, by_P, by_Q = _called_back(P, Q, measure, options, by=True)
    return values, (by_P, by_Q)


def _backward(measure: str, options: Options, slopes: Any, by_values: Array) -> tuple[Any, ...]:
    return tuple((by_values[..., None, None] * slope).astype(slope.dtype) for slope in slopes)


_measure.defvjp(_forward, _backward)


def _called_back(P: Array, Q: Array, measure: str, options: Options, *, by: bool) -> Any:
    is_double = jnp.float64 in (P.dtype, Q.dtype)
    value = jax.ShapeDtypeStruct(P.shape[:-2], jnp.float64 if is_double else jnp.float32)
    slopes = [jax.ShapeDtypeStruct(curve.shape, curve.dtype) for curve in (P, Q) if by]

    def compute(first: Any, second: Any) -> list[Any]:
        found = of_arrays(
            np.asarray(first, dtype=float),
            np.asarray(second, dtype=float),
            measure,
            dict(options),
            by=(by, by),
        )
        wanted = [value, *slopes]
        return [part.astype(like.dtype) for part, like in zip(found, wanted, strict=False)]

    # Under vmap of one curve alone, the other is repeated.
    return jax.pure_callback(compute, [value, *slopes], P, Q, vmap_method="broadcast_all")
