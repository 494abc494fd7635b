"""The measures as differentiable losses of PyTorch, for pairs or batches.

Values and derivatives are bitwise identical to those of :func:`curvewise.values_and_gradients`,
computed in float64 on the CPU by all its cores. Tensors on another device with float64 are computed
there, in PyTorch's operations, for dtw (metric euclidean, sqeuclidean or cityblock, and window),
soft_dtw and soft_dtw_divergence. They agree to about 1e-10 of the values. Tests run these
operations on the CPU, and on a GPU if one exists. For other measures and options a tensor is copied
to the CPU, and the result back. A contiguous float64 tensor on the CPU is not copied. Errors are
those of numpy's functions. ``pip install "curvewise[torch]"``.

Derivatives are computed together with the values, if a curve requires them; the backward pass only
multiplies. ``torch.func.vmap`` and ``torch.func.grad`` work, too. Second derivatives are refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any, NoReturn, TypeAlias

import numpy as np

from ._extras import extra
from ._loss_texts import documented_loss
from ._names import names_alone
from .curves.layouts import ask_about_curves
from .measures.anti_diagonals import ArrayPackage, has_diagonals, values_of_diagonals
from .measures.gradient import NO_DERIVATIVE_OF_PCM, NO_SECOND_DERIVATIVE
from .measures.losses import (
    Lengths,
    check_length_shapes,
    loss_and_gradients,
    with_lengths_of_lists,
)

with extra("torch", "curvewise.torch needs PyTorch"):
    # Absolute, so this is the package of that name and not this module.
    import torch
    from torch import Tensor
    from torch.nn.utils.rnn import pad_sequence

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

Curves: TypeAlias = Tensor | Sequence[Tensor]

Slopes: TypeAlias = tuple[Tensor, Tensor, Tensor]


@documented_loss("Tensor")
def area(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.area` of tensors, differentiable in both.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[0.0, 0.0], [1.0, 0.0]])
    >>> Q = torch.tensor([[0.0, 1.0], [1.0, 2.0]], requires_grad=True)
    >>> loss = curvewise.torch.area(P, Q)
    >>> loss.backward()
    >>> loss.item(), Q.grad.tolist()
    (1.5, [[-1.0, 0.5], [0.5, 0.5]])
    """
    return _measured("area", P, Q, lengths, options)


@documented_loss("Tensor")
def curve_length(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.curve_length` of tensors, differentiable in both.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[1.0, 1.0], [2.0, 2.0]])
    >>> Q = torch.tensor([[1.0, 1.5], [2.0, 2.5]], requires_grad=True)
    >>> round(curvewise.torch.curve_length(P, Q).item(), 4)
    0.4068
    """
    return _measured("curve_length", P, Q, lengths, options)


@documented_loss("Tensor")
def dtw(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.dtw` of tensors, differentiable in both.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[0.0], [1.0], [2.0]])
    >>> Q = torch.tensor([[0.5], [1.25], [4.0]], requires_grad=True)
    >>> loss = curvewise.torch.dtw(P, Q)
    >>> loss.backward()
    >>> loss.item(), Q.grad.ravel().tolist()
    (2.75, [1.0, 1.0, 1.0])
    """
    return _measured("dtw", P, Q, lengths, options)


@documented_loss("Tensor")
def frechet(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.frechet` of tensors, differentiable in both.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[0.0], [1.0], [2.0]])
    >>> Q = torch.tensor([[0.5], [1.25], [4.0]], requires_grad=True)
    >>> loss = curvewise.torch.frechet(P, Q)
    >>> loss.backward()
    >>> loss.item(), Q.grad.ravel().tolist()
    (2.0, [0.0, 0.0, 1.0])
    """
    return _measured("frechet", P, Q, lengths, options)


@documented_loss("Tensor")
def frechet_continuous(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.frechet_continuous` as a loss of two tensors.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[0.0, 0.0], [10.0, 0.0]])
    >>> Q = torch.tensor([[0.0, 0.0], [5.0, 2.0], [10.0, 0.0]], requires_grad=True)
    >>> loss = curvewise.torch.frechet_continuous(P, Q)
    >>> loss.backward()
    >>> loss.item(), Q.grad.tolist()
    (2.0, [[0.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    """
    return _measured("frechet_continuous", P, Q, lengths, options)


@documented_loss("Tensor")
def soft_dtw(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.soft_dtw` as a loss, differentiable everywhere.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = torch.tensor([[0.0], [1.0], [2.0]])
    >>> Q = torch.tensor([[0.0], [1.0], [3.0]], requires_grad=True)
    >>> loss = curvewise.torch.soft_dtw(P, Q, gamma=0.1)
    >>> loss.backward()
    >>> round(loss.item(), 4), round(Q.grad[2].item(), 4)
    (1.0, 2.0)
    """
    return _measured("soft_dtw", P, Q, lengths, options)


@documented_loss("Tensor")
def soft_dtw_divergence(P: Curves, Q: Curves, *, lengths: Lengths = None, **options: Any) -> Tensor:
    """Compute :func:`curvewise.soft_dtw_divergence` as a loss of two tensors.

    {loss}

    Examples
    --------
    >>> import torch
    >>> import curvewise.torch
    >>> P = [torch.tensor([[0.0], [1.0], [2.0]]), torch.tensor([[0.0], [1.0]])]
    >>> Q = [torch.tensor([[0.0], [1.0], [2.0]]), torch.tensor([[0.0], [1.0], [3.0]])]
    >>> curvewise.torch.soft_dtw_divergence(P, Q, gamma=0.1).round(decimals=3).tolist()
    [0.0, 4.0]
    """
    return _measured("soft_dtw_divergence", P, Q, lengths, options)


def pcm(P: Tensor, Q: Tensor, **options: Any) -> NoReturn:
    """Raise an error: partial curve mapping does not have a useful derivative.

    Its offset is the best of several places along the longer curve, and the lengths decide which of
    the two curves is mapped. The value jumps when another choice is best.

    Parameters
    ----------
    P, Q : Tensor
        Ignored.
    **options
        Ignored.

    Raises
    ------
    NotImplementedError
        Always, with advice.

    Examples
    --------
    >>> import curvewise.torch
    >>> curvewise.torch.pcm(None, None)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    NotImplementedError: pcm has no derivative: ...
    """
    raise NotImplementedError(NO_DERIVATIVE_OF_PCM)


def _measured(measure: str, P: Any, Q: Any, lengths: Any, options: dict[str, Any]) -> Tensor:
    (P, of_P), (Q, of_Q) = _padded(P, "P"), _padded(Q, "Q")
    of_P, of_Q = with_lengths_of_lists(lengths, (of_P, of_Q))
    if P.dim() == 2 and Q.dim() == 3:
        P = P.expand(len(Q), *P.shape)
    elif P.dim() == 3 and Q.dim() == 2:
        Q = Q.expand(len(P), *Q.shape)
    counts = tuple(
        None if of is None else _whole_numbers(of, curves, name)
        for of, curves, name in ((of_P, P, "P"), (of_Q, Q, "Q"))
    )
    ask_about_curves(P, Q, batched=True)
    by = (torch.is_grad_enabled() and P.requires_grad, torch.is_grad_enabled() and Q.requires_grad)
    values: Tensor = _Measure.apply(P, Q, measure, options, by, counts)[0]
    return values


def _padded(curves: Any, name: str) -> tuple[Tensor, list[int] | None]:
    """Return a Tensor, and for a list or a nested tensor how many points its curves have."""
    if isinstance(curves, Tensor) and curves.is_nested:
        curves = curves.unbind()
    if not isinstance(curves, list | tuple):
        return _checked(curves, name), None
    if not curves:
        raise ValueError(f"{name} is an empty list; give at least 1 curve")
    for k, curve in enumerate(curves):
        _checked(curve, f"{name}[{k}]")
        if curve.dim() != 2 or curve.shape[1] != curves[0].shape[1]:
            raise ValueError(
                f"{name}[{k}] has shape {tuple(curve.shape)}; give curves of shape (n, d), all of "
                "the same d"
            )
    kind = reduce(torch.promote_types, (curve.dtype for curve in curves))
    padded = pad_sequence([curve.to(kind) for curve in curves], batch_first=True)
    return padded, [len(curve) for curve in curves]


def _checked(curve: Any, name: str) -> Tensor:
    if not isinstance(curve, Tensor):
        raise TypeError(f"{name} is of type {type(curve).__name__}; give a Tensor")
    if curve.is_complex():
        raise TypeError(f"{name} is complex; curves have real coordinates")
    return curve


def _whole_numbers(lengths: Any, curves: Tensor, name: str) -> Any:
    counts = np.asarray(lengths.cpu() if isinstance(lengths, Tensor) else lengths)
    check_length_shapes(counts.shape, tuple(curves.shape[:-2]), name)
    return counts


def _computed(P: Tensor, Q: Tensor, measure: str, options: Any, by: Any, lengths: Any) -> Slopes:
    """Return values and derivatives in float64: on the device if they can be, else on the CPU."""
    lengths = tuple(
        None if of is None else np.broadcast_to(of, C.shape[:-2])
        for of, C in zip(lengths, (P, Q), strict=True)
    )
    if _stays(P) and _stays(Q) and has_diagonals(measure, options):
        found = _along_diagonals(P, Q, measure, options, lengths)
        if found is not None:
            return found
    first, second = (C.detach().to("cpu", torch.float64).numpy() for C in (P, Q))
    values, *slopes = loss_and_gradients(first, second, measure, options, by=by, lengths=lengths)
    by_P, by_Q = (torch.from_numpy(slope) for slope in slopes)
    return torch.from_numpy(np.asarray(values)), by_P, by_Q


def _stays(curves: Tensor) -> bool:
    """Return whether a Tensor is on a device that computes in float64 and is not the CPU."""
    return curves.device.type not in ("cpu", "mps")


def _along_diagonals(
    P: Tensor, Q: Tensor, measure: str, options: dict[str, Any], lengths: tuple[Any, Any]
) -> Slopes | None:
    """Return values and derivatives, or nothing of curves that have to be refused in words."""
    none = [np.empty((0, *C.shape[-2:])) for C in (P, Q)]
    loss_and_gradients(none[0], none[1], measure, options)  # which are refused here, if at all
    batch = P.shape[:-2]
    if P.shape[-1] != Q.shape[-1] or batch != Q.shape[:-2] or 0 in (*P.shape, *Q.shape):
        return None
    counts = [
        np.full(batch.numel(), C.shape[-2]) if of is None else np.array(of).reshape(-1)
        for of, C in zip(lengths, (P, Q), strict=True)
    ]
    curves = []
    for of, C in zip(counts, (P, Q), strict=True):
        flat = C.detach().to(torch.float64).reshape(-1, *C.shape[-2:])
        used = (
            torch.arange(C.shape[-2], device=C.device)
            < torch.as_tensor(of, device=C.device)[:, None]
        )
        curves.append(torch.where(used[..., None], flat, 0.0).requires_grad_())
        if (of < 1).any() or (of > C.shape[-2]).any() or not torch.isfinite(curves[-1]).all():
            return None
    package = ArrayPackage(torch, lambda array: torch.as_tensor(array, device=P.device), _scan)
    with torch.enable_grad():
        values = values_of_diagonals(
            package, curves[0], curves[1], (counts[0], counts[1]), measure, options
        )
        by_P, by_Q = torch.autograd.grad(values.sum(), curves)
    return values.detach().reshape(batch), by_P.reshape(P.shape), by_Q.reshape(Q.shape)


def _scan(step: Any, carry: Any, stacked: tuple[Tensor, Tensor]) -> Tensor:
    found = []
    for pair in zip(*stacked, strict=True):
        carry, result = step(carry, pair)
        found.append(result)
    return torch.stack(found)


class _Measure(torch.autograd.Function):  # type: ignore[misc]  # untyped
    """The values, and their factors in the backward pass."""

    @staticmethod
    def forward(
        P: Tensor, Q: Tensor, measure: str, options: dict[str, Any], by: Any, lengths: Any
    ) -> Slopes:
        values, *slopes = _computed(P, Q, measure, options, by, lengths)
        is_double = torch.float64 in (P.dtype, Q.dtype)
        result = values.to(P.device, torch.float64 if is_double else torch.float32)
        by_P, by_Q = (
            slope.to(C.device, C.dtype if C.is_floating_point() else None)
            for slope, C in zip(slopes, (P, Q), strict=True)
        )
        return result, by_P, by_Q

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Any, ...], output: Slopes) -> None:
        ctx.mark_non_differentiable(*output[1:])
        ctx.save_for_backward(*inputs[:2], *output[1:])

    @staticmethod
    def backward(ctx: Any, *by_values: Tensor) -> tuple[Tensor | None, ...]:
        P, Q, by_P, by_Q = ctx.saved_tensors
        return (
            *(
                _Slopes.apply(by_values[0], slopes, curve) if wanted else None
                for slopes, curve, wanted in zip(
                    (by_P, by_Q), (P, Q), ctx.needs_input_grad[:2], strict=True
                )
            ),
            *(None,) * 4,
        )

    @staticmethod
    def vmap(info: Any, in_dims: Any, P: Tensor, Q: Tensor, *rest: Any) -> tuple[Slopes, Any]:
        first, second = (
            curve.expand(info.batch_size, *curve.shape) if dim is None else curve.movedim(dim, 0)
            for curve, dim in zip((P, Q), in_dims, strict=False)
        )
        # A transform further out may ask for derivatives: a batch does not tell.
        by = (torch.is_grad_enabled(),) * 2
        return _Measure.apply(first, second, *rest[:2], by, rest[3]), (0, 0, 0)


class _Slopes(torch.autograd.Function):  # type: ignore[misc]  # untyped
    """Derivatives by a curve, which refuse to be differentiated again."""

    generate_vmap_rule = True

    @staticmethod
    def forward(by_value: Tensor, slopes: Tensor, curve: Tensor) -> Tensor:
        return (by_value[..., None, None] * slopes).to(curve.dtype)

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Any, ...], output: Tensor) -> None:
        pass

    @staticmethod
    def backward(ctx: Any, *by_slopes: Tensor) -> NoReturn:
        raise NotImplementedError(NO_SECOND_DERIVATIVE)
