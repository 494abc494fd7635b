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

from ._docstrings import filled
from ._extras import extra
from .measures.gradient import NO_DERIVATIVE_OF_PCM, check_pairs, of_arrays

with extra("jax", "curvewise.jax needs JAX"):
    # Absolute, so this is the package of that name and not this module.
    import jax
    import jax.numpy as jnp
    from jax import Array

__all__ = ["area", "curve_length", "dtw", "frechet", "frechet_continuous", "pcm", "soft_dtw"]

Options: TypeAlias = tuple[tuple[str, Any], ...]


@filled(array="Array")
def area(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.area` of arrays, differentiable in both.

    Parameters
    ----------
    {loss_curves}
    **options
        Those of :func:`curvewise.area`, except ``spacing="arc_length"``. As a loss,
        ``spacing="matched"``, which takes other increments and noise, and does not jump.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.area`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Jekel et al. (2018). The cuts of the refinement, or the matching, are held. Time and memory of
    :func:`curvewise.values_and_gradients`.

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


@filled(array="Array")
def curve_length(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.curve_length` of arrays, differentiable in both.

    Parameters
    ----------
    {loss_curves}
    **options
        Those of :func:`curvewise.curve_length`.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.curve_length`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Andrade-Campos et al. (2012). Not symmetric: P is the experiment. Time and memory of
    :func:`curvewise.values_and_gradients`.

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


@filled(array="Array")
def dtw(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.dtw` of arrays, differentiable in both.

    Parameters
    ----------
    {loss_curves}
    **options
        Those of :func:`curvewise.dtw`.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.dtw`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Sakoe & Chiba (1978). The warping path is held (the envelope theorem); where two cost the same,
    the derivative is that of the one that :func:`curvewise.dtw_path` returns, a member of the
    subdifferential. Time O(n m), memory O(n + m) for each pair and thread.

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


@filled(array="Array")
def frechet(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.frechet` of arrays, differentiable in both.

    Parameters
    ----------
    {loss_curves}
    **options
        Those of :func:`curvewise.frechet`.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.frechet`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Eiter & Mannila (1994). The derivative is 0 except at the one pair of points that decides; of
    two that are equally far apart it is the first along :func:`curvewise.frechet_path`, a member of
    the subdifferential. Time O(n m), memory O(n + m) for each pair and thread.

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


@filled(array="Array")
def frechet_continuous(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.frechet_continuous` of arrays, differentiable in both.

    Parameters
    ----------
    {loss_curves}
    **options
        None: the measure has no options that change its value.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.frechet_continuous`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Alt & Godau (1995). The derivative is that of the leash that decides, or of the two that do
    together, at a point of an edge that lies between two vertices of the other curve. Time of the
    value and of its matching; memory O(n + m) for each pair and thread.

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


@filled(array="Array")
def soft_dtw(P: Array, Q: Array, **options: Any) -> Array:
    """Compute :func:`curvewise.soft_dtw` of arrays, differentiable in both, everywhere.

    Parameters
    ----------
    {loss_curves}
    **options
        Those of :func:`curvewise.soft_dtw`: ``gamma`` and ``window``.

    Returns
    -------
    {loss_value}

    Raises
    ------
    ValueError, TypeError
        As for :func:`curvewise.soft_dtw`; shapes that do not make pairs; complex arrays.

    Notes
    -----
    Cuturi & Blondel (2017). Time O(n m); memory O(n sqrt(m)) for each pair and thread, never the
    table: pairs of 10 000 points take 40 MB.

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
