"""The measures as differentiable losses of JAX, for pairs or batches.

Values and derivatives are bitwise identical to those of :func:`curvewise.values_and_gradients`. A
callback (``jax.pure_callback``) computes them in float64 on the CPU by all its cores, with custom
derivatives (``jax.custom_vjp``). ``jax.jit``, ``jax.vmap`` and ``jax.grad`` are supported. ``pip
install "curvewise[jax]"``. JAX has float64 only if it is enabled (``jax_enable_x64``). Otherwise
values are computed in float64 from float32 coordinates, and returned as float32.

If JAX has float64 and another device than the CPU, JAX's operations compute some measures without a
callback. These are dtw (metric euclidean, sqeuclidean or cityblock, and window), soft_dtw and
soft_dtw_divergence. They agree to about 1e-10 of the values, with nan for curves that are not
finite. Tests run these operations on the CPU, and on a GPU if one exists.

Second derivatives are refused, and JAX refuses forward-mode derivatives. Errors of shapes and
options are those of numpy's functions. In a compiled program, JAX raises its own error for invalid
numbers, with the same message in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NoReturn, TypeAlias

import numpy as np

from ._extras import extra
from ._loss_texts import documented_loss
from ._names import names_alone
from .curves.layouts import ask_about_curves
from .measures.anti_diagonals import ArrayPackage, has_diagonals, values_of_diagonals
from .measures.gradient import NO_DERIVATIVE_OF_PCM, NO_SECOND_DERIVATIVE, check_pairs
from .measures.losses import (
    Lengths,
    check_length_shapes,
    loss_and_gradients,
    with_lengths_of_lists,
)

with extra("jax", "curvewise.jax needs JAX"):
    # Absolute, so this is the package of that name and not this module.
    import jax
    import jax.numpy as jnp
    from jax import Array

__all__ = [
    "area",
    "curve_length",
    "dtw",
    "frechet",
    "frechet_continuous",
    "pcm",
    "soft_dtw",
    "soft_dtw_divergence",
]
__dir__ = names_alone(__all__)

Curves: TypeAlias = Array | Sequence[Array]

Options: TypeAlias = tuple[tuple[str, Any], ...]


@documented_loss("Array")
def area(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
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
    return _measured("area", P, Q, lengths, options)


@documented_loss("Array")
def curve_length(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
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
    return _measured("curve_length", P, Q, lengths, options)


@documented_loss("Array")
def dtw(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
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
    return _measured("dtw", P, Q, lengths, options)


@documented_loss("Array")
def frechet(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
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
    return _measured("frechet", P, Q, lengths, options)


@documented_loss("Array")
def frechet_continuous(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
    """Compute :func:`curvewise.frechet_continuous` as a loss of two arrays.

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
    return _measured("frechet_continuous", P, Q, lengths, options)


@documented_loss("Array")
def soft_dtw(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
    """Compute :func:`curvewise.soft_dtw` as a loss, differentiable everywhere.

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
    return _measured("soft_dtw", P, Q, lengths, options)


@documented_loss("Array")
def soft_dtw_divergence(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Array:
    """Compute :func:`curvewise.soft_dtw_divergence` as a loss of two arrays.

    {loss}

    Examples
    --------
    >>> import jax.numpy as jnp
    >>> import curvewise.jax
    >>> P = [jnp.array([[0.0], [1.0], [2.0]]), jnp.array([[0.0], [1.0]])]
    >>> Q = [jnp.array([[0.0], [1.0], [2.0]]), jnp.array([[0.0], [1.0], [3.0]])]
    >>> curvewise.jax.soft_dtw_divergence(P, Q, gamma=0.1).round(3).tolist()
    [0.0, 4.0]
    """
    return _measured("soft_dtw_divergence", P, Q, lengths, options)


def pcm(P: Array, Q: Array, **options: Any) -> NoReturn:
    """Raise an error: partial curve mapping does not have a useful derivative.

    Its offset is the best of several places along the longer curve, and the lengths decide which of
    the two curves is mapped. The value jumps when another choice is best.

    Parameters
    ----------
    P, Q : Array
        Ignored.
    **options
        Ignored.

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


def _measured(measure: str, P: Any, Q: Any, lengths: Any, options: dict[str, Any]) -> Array:
    (P, of_P), (Q, of_Q) = _padded(P, "P"), _padded(Q, "Q")
    counts = with_lengths_of_lists(lengths, (of_P, of_Q))
    P, Q = (C if jnp.issubdtype(C.dtype, jnp.floating) else C.astype(float) for C in (P, Q))
    if P.ndim == 2 and Q.ndim == 3:
        P = jnp.broadcast_to(P, (len(Q), *P.shape))
    elif P.ndim == 3 and Q.ndim == 2:
        Q = jnp.broadcast_to(Q, (len(P), *Q.shape))
    check_pairs(P.shape, Q.shape)
    ask_about_curves(P, Q, batched=True)
    none = [np.empty((0, *curve.shape[-2:])) for curve in (P, Q)]
    loss_and_gradients(none[0], none[1], measure, options)  # which are refused here, if at all
    of_P, of_Q = (
        _whole_numbers(of, C, name) for of, C, name in zip(counts, (P, Q), "PQ", strict=True)
    )
    return _measure(P, Q, of_P, of_Q, measure, tuple(options.items()))


def _padded(curves: Any, name: str) -> tuple[Array, list[int] | None]:
    """Return an Array, and for a list of curves how many points each has."""
    if not isinstance(curves, list | tuple) or not any(np.ndim(curve) == 2 for curve in curves):
        array = jnp.asarray(curves)
        if jnp.iscomplexobj(array):
            raise TypeError(f"{name} is complex; curves have real coordinates")
        return array, None
    for k, curve in enumerate(curves):
        shape = np.shape(curve)
        if len(shape) != 2 or shape[1] != np.shape(curves[0])[-1]:
            raise ValueError(
                f"{name}[{k}] has shape {shape}; give curves of shape (n, d), all of the same d"
            )
    lengths = [len(curve) for curve in curves]
    arrays = [_padded(jnp.asarray(curve), f"{name}[{k}]")[0] for k, curve in enumerate(curves)]
    longest = max(lengths)
    return jnp.stack([jnp.pad(C, ((0, longest - len(C)), (0, 0))) for C in arrays]), lengths


def _whole_numbers(lengths: Any, curves: Array, name: str) -> Any:
    """Return lengths for the callback; in numpy, which is known where a program is compiled."""
    batch = curves.shape[:-2]
    if lengths is None:
        return np.full(batch, curves.shape[-2])
    counts = lengths if isinstance(lengths, jax.Array) else np.asarray(lengths)
    check_length_shapes(counts.shape, batch, name)
    return counts


@partial(jax.custom_vjp, nondiff_argnums=(4, 5))
def _measure(P: Array, Q: Array, of_P: Any, of_Q: Any, measure: str, options: Options) -> Array:
    """Compute the values alone."""
    return _computed(P, Q, of_P, of_Q, measure, options, False)[0]


def _forward(
    P: Array, Q: Array, of_P: Any, of_Q: Any, measure: str, options: Options
) -> tuple[Array, Any]:
    values, by_P, by_Q = _computed(P, Q, of_P, of_Q, measure, options, True)
    return values, (by_P, by_Q)


def _backward(measure: str, options: Options, slopes: Any, by_values: Array) -> tuple[Any, ...]:
    by_curves = ((by_values[..., None, None] * slope).astype(slope.dtype) for slope in slopes)
    return (*by_curves, None, None)


_measure.defvjp(_forward, _backward)


@partial(jax.custom_jvp, nondiff_argnums=(4, 5, 6))
def _computed(
    P: Array, Q: Array, of_P: Any, of_Q: Any, measure: str, options: Options, by: bool
) -> Any:
    """Return the values and, if requested, the derivatives, both constant in JAX."""
    told = dict(options)
    are_numbers = not any(isinstance(of, jax.Array) for of in (of_P, of_Q))
    if (
        _stays()
        and has_diagonals(measure, told)
        and (are_numbers or told.get("window") is None)
        and 0 not in (*P.shape, *Q.shape)
    ):
        return _along_diagonals(P, Q, of_P, of_Q, measure, told)[: 3 if by else 1]
    return _called_back(P, Q, of_P, of_Q, measure, told, by=by)


@_computed.defjvp  # type: ignore[untyped-decorator]
def _refused(*_: Any) -> NoReturn:
    raise NotImplementedError(NO_SECOND_DERIVATIVE)


def _stays() -> bool:
    """Return whether JAX computes in float64, and not on the CPU."""
    return jax.default_backend() != "cpu" and bool(jax.config.jax_enable_x64)


def _along_diagonals(
    P: Array, Q: Array, of_P: Any, of_Q: Any, measure: str, options: dict[str, Any]
) -> list[Array]:
    """Return values and derivatives in JAX's own operations."""
    counts = (of_P.reshape(-1), of_Q.reshape(-1))
    curves = []
    for of, C in zip(counts, (P, Q), strict=True):
        flat = C.astype(jnp.float64).reshape(-1, *C.shape[-2:])
        used = jnp.arange(C.shape[-2]) < jnp.asarray(of)[:, None]
        curves.append(jnp.where(used[..., None], flat, 0.0))
    package = ArrayPackage(jnp, jnp.asarray, lambda *scanned: jax.lax.scan(*scanned)[1])

    def total(P: Array, Q: Array) -> tuple[Array, Array]:
        values = values_of_diagonals(package, P, Q, counts, measure, options)
        return values.sum(), values

    (_, values), slopes = jax.value_and_grad(total, argnums=(0, 1), has_aux=True)(*curves)
    is_double = jnp.float64 in (P.dtype, Q.dtype)
    return [
        values.reshape(P.shape[:-2]).astype(jnp.float64 if is_double else jnp.float32),
        *(slope.reshape(C.shape).astype(C.dtype) for slope, C in zip(slopes, (P, Q), strict=True)),
    ]


def _called_back(
    P: Array, Q: Array, of_P: Any, of_Q: Any, measure: str, options: dict[str, Any], *, by: bool
) -> Any:
    is_double = jnp.float64 in (P.dtype, Q.dtype)
    value = jax.ShapeDtypeStruct(P.shape[:-2], jnp.float64 if is_double else jnp.float32)
    slopes = [jax.ShapeDtypeStruct(curve.shape, curve.dtype) for curve in (P, Q) if by]

    def compute(first: Any, second: Any, *lengths: Any) -> list[Any]:
        found = loss_and_gradients(
            np.asarray(first, dtype=float),
            np.asarray(second, dtype=float),
            measure,
            options,
            by=(by, by),
            lengths=(np.asarray(lengths[0]), np.asarray(lengths[1])),
        )
        wanted = [value, *slopes]
        return [part.astype(like.dtype) for part, like in zip(found, wanted, strict=False)]

    # Under vmap of one curve alone, the other is repeated.
    return jax.pure_callback(
        compute, [value, *slopes], P, Q, of_P, of_Q, vmap_method="broadcast_all"
    )
