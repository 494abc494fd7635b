"""curvewise.torch: the bits of numpy's functions, gradcheck, and what PyTorch does to losses.

PyTorch is imported where it is used: every process of a run collects this file, one runs it.
"""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import pytest

import curvewise

# Test by test, because a file that is skipped as a whole would not be in the list of skipped tests.
pytestmark = pytest.mark.skipif(
    find_spec("torch") is None, reason='no PyTorch: pip install "curvewise[torch]"'
)

LOSSES = [
    ("area", {}),
    ("area", {"spacing": "matched"}),
    ("curve_length", {}),
    ("dtw", {"metric": "sqeuclidean"}),
    ("frechet", {}),
    ("frechet_continuous", {}),
    ("soft_dtw", {"gamma": 0.5, "window": 5}),
]
every_loss = pytest.mark.parametrize(("name", "options"), LOSSES)


def pairs(count: int, n: int = 7, m: int = 9, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    return tuple(random.normal(0.3, 1.0, (count, k, 2)).cumsum(axis=1) + 3 for k in (n, m))


def tensors(count: int, **sizes: int):
    import torch

    return tuple(torch.tensor(curves, requires_grad=True) for curves in pairs(count, **sizes))


@every_loss
def test_values_and_slopes_are_numpys(name, options) -> None:
    P, Q = pairs(3)
    p, q = tensors(3)
    values, by_P, by_Q = curvewise.values_and_gradients(P, Q, name, **options)
    loss = getattr(curvewise.torch, name)(p, q, **options)
    single = [getattr(curvewise, name)(*pair, **options) for pair in zip(P, Q, strict=True)]
    assert loss.tolist() == values.tolist() == single
    loss.sum().backward()
    assert (p.grad.numpy() == by_P).all()
    assert (q.grad.numpy() == by_Q).all()
    one = getattr(curvewise.torch, name)(p[1], q[1], **options)
    assert one.shape == ()
    assert one.item() == single[1]


@every_loss
def test_gradcheck(name, options) -> None:
    import torch

    function = getattr(curvewise.torch, name)
    assert torch.autograd.gradcheck(lambda p, q: function(p, q, **options), tensors(2))


@every_loss
def test_vmap_grad_and_both(name, options) -> None:
    import torch

    def loss(p, q):
        return getattr(curvewise.torch, name)(p, q, **options)

    p, q = (curves.detach() for curves in tensors(3))
    _, _, by_Q = curvewise.values_and_gradients(*pairs(3), name, **options)
    assert torch.equal(torch.func.vmap(loss)(p, q), loss(p, q))
    assert torch.equal(torch.func.vmap(lambda q: loss(p[0], q))(q), loss(p[0], q))
    expected = torch.from_numpy(by_Q)
    slopes = torch.func.vmap(torch.func.grad(loss, argnums=1))(p, q)
    assert torch.equal(slopes, expected)
    slopes = torch.func.grad(lambda q: torch.func.vmap(loss)(p, q).sum())(q)
    assert torch.equal(slopes, expected)
    jacobian = torch.func.jacrev(lambda q: loss(p, q))(q)
    assert torch.equal(jacobian[1, 1], expected[1])
    assert not jacobian[1, 0].any()


def test_one_curve_is_compared_with_many() -> None:
    p, q = tensors(4)
    many = curvewise.torch.dtw(p[0], q)
    assert many.tolist() == [curvewise.torch.dtw(p[0], curve).item() for curve in q]
    many.sum().backward()
    assert p.grad[0].any()
    assert not p.grad[1:].any()


def test_a_curve_that_asks_for_no_slopes_gets_none() -> None:
    import torch

    p, q = tensors(1)
    curvewise.torch.soft_dtw(p.detach(), q).sum().backward()
    assert p.grad is None
    with torch.no_grad():
        assert not curvewise.torch.soft_dtw(p, q).requires_grad


def test_other_kinds_of_numbers() -> None:
    import torch

    p, q = (curves.detach() for curves in tensors(2))
    loss = curvewise.torch.dtw(p.float(), q.float().requires_grad_())
    assert loss.dtype == torch.float32
    assert (
        loss.tolist()
        == curvewise.torch.dtw(p.float().double(), q.float().double()).float().tolist()
    )
    assert curvewise.torch.dtw(p, q.float()).dtype == torch.float64
    half = q.bfloat16().requires_grad_()
    loss = curvewise.torch.dtw(p.float(), half)
    loss.sum().backward()
    assert (loss.dtype, half.grad.dtype) == (torch.float32, torch.bfloat16)
    assert curvewise.torch.dtw(torch.arange(3)[:, None], torch.zeros(3, 1)).item() == 3.0
    assert curvewise.torch.dtw(p.transpose(0, 1).contiguous().transpose(0, 1), q).shape == (2,)


def test_under_autocast() -> None:
    import torch

    layer = torch.nn.Linear(2, 2)
    p, q = (curves.detach().float() for curves in tensors(2))
    with torch.autocast("cpu", dtype=torch.bfloat16):
        loss = curvewise.torch.soft_dtw(p, layer(q)).sum()
    loss.backward()
    assert loss.dtype == torch.float32
    assert torch.isfinite(layer.weight.grad).all()


def loss_of_item(item: int) -> float:
    """For a worker process."""
    import torch

    p, q = (torch.tensor(curves[item]) for curves in pairs(4))
    return curvewise.torch.soft_dtw(p, q).item()


class Losses:
    """A data set whose items are computed by curvewise."""

    def __len__(self) -> int:
        return 4

    def __getitem__(self, item: int) -> float:
        return loss_of_item(item)


@pytest.mark.parametrize("context", ["fork", "spawn"])
@pytest.mark.nightly("spawn")
def test_in_the_workers_of_a_loader(context: str) -> None:
    import torch

    curvewise.torch.soft_dtw(*tensors(2))  # threads have been started, and are gone, before a fork
    loader = torch.utils.data.DataLoader(
        Losses(), batch_size=2, num_workers=2, multiprocessing_context=context
    )
    found = [value for batch in loader for value in batch.tolist()]
    assert found == [loss_of_item(item) for item in range(4)]


def test_second_derivatives_are_refused() -> None:
    import torch

    p, q = tensors(1)
    slopes = torch.autograd.grad(curvewise.torch.dtw(p, q).sum(), q, create_graph=True)[0]
    with pytest.raises(NotImplementedError, match="first derivatives only; leave out create_graph"):
        slopes.sum().backward()
    of_q = torch.func.grad(lambda q: curvewise.torch.dtw(p[0].detach(), q))
    with pytest.raises(NotImplementedError, match="first derivatives only"):
        torch.func.jacrev(of_q)(q[0].detach())


def test_errors_are_numpys() -> None:
    import torch

    zeros = torch.zeros
    with pytest.raises(ValueError, match=r"P\[0, 0\] is nan; curves must be finite"):
        curvewise.torch.dtw(torch.full((1, 1), float("nan")), zeros(2, 1))
    Q = zeros(2, 3, 1)
    Q[1, 2] = float("inf")
    with pytest.raises(ValueError, match=r"pair 1: Q\[2, 0\] is inf; curves must be finite"):
        curvewise.torch.dtw(zeros(2, 3, 1), Q)
    with pytest.raises(ValueError, match="dtw needs at least 1 point"):
        curvewise.torch.dtw(zeros(0, 1), zeros(2, 1))
    with pytest.raises(ValueError, match="both need the same number of coordinates"):
        curvewise.torch.dtw(zeros(2, 3), zeros(2, 1))
    with pytest.raises(ValueError, match="give as many curves of each"):
        curvewise.torch.dtw(zeros(2, 2, 2), zeros(3, 2, 2))
    with pytest.raises(ValueError, match="give as many curves of each"):
        curvewise.torch.dtw(zeros(2), zeros(2))
    with pytest.raises(TypeError, match=r"P\[0\] is of type list; give a Tensor"):
        curvewise.torch.dtw([[0.0]], zeros(2, 1))
    with pytest.raises(TypeError, match="P is complex"):
        curvewise.torch.dtw(zeros(2, 1, dtype=torch.complex64), zeros(2, 1))
    with pytest.raises(TypeError, match="dtw has no option 'foo'"):
        curvewise.torch.dtw(zeros(2, 1), zeros(2, 1), foo=1)
    with pytest.raises(NotImplementedError, match="pcm has no derivative"):
        curvewise.torch.pcm(zeros(2, 2), zeros(2, 2))
