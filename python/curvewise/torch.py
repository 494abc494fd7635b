"""The measures as losses of PyTorch: differentiable in both curves, of pairs or of batches of them.

Values and derivatives are those of :func:`curvewise.values_and_gradients`, to the bit, computed in
float64 on the CPU by all its cores. A tensor on another device is brought to the CPU, and the
result back. A contiguous float64 tensor on the CPU is not copied. Errors are those of numpy's
functions. ``pip install "curvewise[torch]"``.

Derivatives are found together with the values, where a curve asks for them; backwards they are only
multiplied. For ``torch.func.vmap`` and ``torch.func.grad``, too. They are not differentiated again:
a second derivative is refused.
"""

from __future__ import annotations

from typing import Any, NoReturn, TypeAlias

import numpy as np

from ._extras import extra
from ._loss_texts import documented_loss
from .curves.layouts import ask_about_curves
from .measures.gradient import NO_DERIVATIVE_OF_PCM, NO_SECOND_DERIVATIVE, of_arrays

with extra("torch", "curvewise.torch needs PyTorch"):
    # Absolute, so this is the package of that name and not this module.
    import torch
    from torch import Tensor

__all__ = ["area", "curve_length", "dtw", "frechet", "frechet_continuous", "pcm", "soft_dtw"]

Slopes: TypeAlias = tuple[Tensor, Tensor, Tensor]


@documented_loss("Tensor")
def area(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
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
    return _measured("area", P, Q, options)


@documented_loss("Tensor")
def curve_length(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
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
    return _measured("curve_length", P, Q, options)


@documented_loss("Tensor")
def dtw(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
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
    return _measured("dtw", P, Q, options)


@documented_loss("Tensor")
def frechet(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
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
    return _measured("frechet", P, Q, options)


@documented_loss("Tensor")
def frechet_continuous(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
    """Compute :func:`curvewise.frechet_continuous` of tensors, differentiable in both.

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
    return _measured("frechet_continuous", P, Q, options)


@documented_loss("Tensor")
def soft_dtw(P: Tensor, Q: Tensor, **options: Any) -> Tensor:
    """Compute :func:`curvewise.soft_dtw` of tensors, differentiable in both, everywhere.

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
    return _measured("soft_dtw", P, Q, options)


def pcm(P: Tensor, Q: Tensor, **options: Any) -> NoReturn:
    """Refuse: partial curve mapping has no useful derivative.

    Its offset is the best of a row of places along the longer curve, and which of the two curves is
    mapped is decided by their lengths: it jumps where another is best.

    Parameters
    ----------
    P, Q : Tensor
        Not looked at.
    **options
        Not looked at.

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


def _measured(measure: str, P: Tensor, Q: Tensor, options: dict[str, Any]) -> Tensor:
    for curve, name in ((P, "P"), (Q, "Q")):
        if not isinstance(curve, Tensor):
            raise TypeError(f"{name} is of type {type(curve).__name__}; give a Tensor")
        if curve.is_complex():
            raise TypeError(f"{name} is complex; curves have real coordinates")
    if P.dim() == 2 and Q.dim() == 3:
        P = P.expand(len(Q), *P.shape)
    elif P.dim() == 3 and Q.dim() == 2:
        Q = Q.expand(len(P), *Q.shape)
    ask_about_curves(P, Q, batched=True)
    by = (torch.is_grad_enabled() and P.requires_grad, torch.is_grad_enabled() and Q.requires_grad)
    values: Tensor = _Measure.apply(P, Q, measure, options, by)[0]
    return values


class _Measure(torch.autograd.Function):  # type: ignore[misc]  # untyped
    """The values, and what they are multiplied by backwards."""

    @staticmethod
    def forward(
        P: Tensor, Q: Tensor, measure: str, options: dict[str, Any], by: tuple[bool, bool]
    ) -> Slopes:
        first, second = (C.detach().to("cpu", torch.float64).numpy() for C in (P, Q))
        values, *slopes = of_arrays(first, second, measure, options, by=by)
        is_double = torch.float64 in (P.dtype, Q.dtype)
        result = torch.from_numpy(np.asarray(values)).to(
            P.device, torch.float64 if is_double else torch.float32
        )
        by_P, by_Q = (
            torch.from_numpy(slope).to(C.device, C.dtype if C.is_floating_point() else None)
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
            None,
            None,
            None,
        )

    @staticmethod
    def vmap(info: Any, in_dims: Any, P: Tensor, Q: Tensor, *rest: Any) -> tuple[Slopes, Any]:
        first, second = (
            curve.expand(info.batch_size, *curve.shape) if dim is None else curve.movedim(dim, 0)
            for curve, dim in zip((P, Q), in_dims, strict=False)
        )
        # A transform further out may ask for derivatives: a batch does not tell.
        by = (torch.is_grad_enabled(),) * 2
        return _Measure.apply(first, second, *rest[:2], by), (0, 0, 0)


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
