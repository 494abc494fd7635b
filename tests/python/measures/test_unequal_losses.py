"""Losses of curves of unequal lengths, the divergence, and dtw and soft_dtw along anti-diagonals.

One test for PyTorch and for JAX, which are imported where they are used.
"""

from __future__ import annotations

import re
from functools import partial
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from test_torch import LOSSES

import curvewise
from curvewise.measures.losses import loss_and_gradients


def package(name: str) -> Any:
    reason = f'no {name}: pip install "curvewise[{name}]"'
    return pytest.param(name, marks=pytest.mark.skipif(find_spec(name) is None, reason=reason))


both_packages = pytest.mark.parametrize("name", [package("jax"), package("torch")])
SOFT = [("soft_dtw_divergence", {"gamma": 0.5}), ("soft_dtw_divergence", {"window": 5})]
every_loss = pytest.mark.parametrize(("measure", "options"), [*LOSSES, *SOFT])


@pytest.fixture(autouse=True)
def _with_float64():
    if find_spec("jax") is None:
        yield
        return
    import jax

    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


@pytest.fixture(autouse=True)
def _compiled(monkeypatch):
    """Compute with the compiled library if JAX sees a GPU too."""
    if find_spec("jax"):
        monkeypatch.setattr(curvewise.jax, "_stays", lambda: False)


def curves_of(lengths: list[int], seed: int) -> list[np.ndarray]:
    random = np.random.default_rng(seed)
    return [random.normal(0.3, 1.0, (n, 2)).cumsum(axis=0) + 3 for n in lengths]


def padded(curves: list[np.ndarray], filling: float = np.nan) -> np.ndarray:
    batch = np.full((len(curves), max(map(len, curves)), 2), filling)
    for k, curve in enumerate(curves):
        batch[k, : len(curve)] = curve
    return batch


def measured(name: str, measure: str, P: Any, Q: Any, **options: Any) -> Any:
    """Return the values and the derivatives of their weighted sum, as numpy arrays."""
    if name == "torch":
        import torch

        given = [
            [torch.tensor(C, requires_grad=True) for C in curves]
            if isinstance(curves, list)
            else torch.tensor(curves, requires_grad=True)
            for curves in (P, Q)
        ]
        values = getattr(curvewise.torch, measure)(*given, **options)
        (values * (torch.arange(len(values)) + 1)).sum().backward()
        slopes = [
            [C.grad.numpy() for C in curves] if isinstance(curves, list) else curves.grad.numpy()
            for curves in given
        ]
        return values.detach().numpy(), *slopes
    import jax
    import jax.numpy as jnp

    def total(P, Q):
        values = getattr(curvewise.jax, measure)(P, Q, **options)
        return (values * (jnp.arange(len(values)) + 1)).sum(), values

    given = [jax.tree.map(jnp.asarray, curves) for curves in (P, Q)]
    (_, values), slopes = jax.value_and_grad(total, argnums=(0, 1), has_aux=True)(*given)
    return np.asarray(values), *(jax.tree.map(np.asarray, part) for part in slopes)


def one_by_one(measure: str, P: list, Q: list, options: dict) -> list[tuple]:
    return [loss_and_gradients(*pair, measure, options) for pair in zip(P, Q, strict=True)]


LENGTHS = [7, 3, 9, 7, 5], [8, 4, 9, 8, 6]


@both_packages
@every_loss
def test_lists_and_lengths_are_pairs_one_by_one(name, measure, options) -> None:
    P, Q = curves_of(LENGTHS[0], 0), curves_of(LENGTHS[1], 1)
    expected = one_by_one(measure, P, Q, options)
    by_list = measured(name, measure, P, Q, **options)
    by_lengths = measured(name, measure, padded(P), padded(Q), lengths=LENGTHS, **options)
    for k, (value, by_P, by_Q) in enumerate(expected):
        assert by_list[0][k] == by_lengths[0][k] == value
        for slopes, own in ((1, by_P), (2, by_Q)):
            assert (by_list[slopes][k] == own * (k + 1)).all()
            assert (by_lengths[slopes][k][: len(own)] == own * (k + 1)).all()
            assert not by_lengths[slopes][k][len(own) :].any()


@both_packages
def test_one_curve_with_a_list(name) -> None:
    (P,), Q = curves_of([6], 0), curves_of([3, 8, 6], 1)
    values, by_P, by_Q = measured(name, "dtw", P, Q)
    expected = one_by_one("dtw", [P] * 3, Q, {})
    assert values.tolist() == [value for value, _, _ in expected]
    np.testing.assert_allclose(by_P, sum((k + 1) * e[1] for k, e in enumerate(expected)))
    assert [len(slopes) for slopes in by_Q] == [3, 8, 6]


def test_divergence_is_numpys_with_the_limits_of_differences() -> None:
    (P,), (Q,) = curves_of([6], 0), curves_of([5], 1)
    for options in ({}, {"gamma": 0.1}, {"window": 2}):
        divergence = partial(curvewise.soft_dtw_divergence, **options)
        value, by_P, by_Q = loss_and_gradients(P, Q, "soft_dtw_divergence", options)
        assert value == divergence(P, Q)
        for curve, slopes, place in ((P, by_P, 0), (Q, by_Q, 1)):
            for at in np.ndindex(curve.shape):
                pair = [P.copy(), Q.copy()]
                pair[place][at] += 1e-5
                above = divergence(*pair)
                pair[place][at] -= 2e-5
                assert slopes[at] == pytest.approx((above - divergence(*pair)) / 2e-5, abs=1e-6)
    _, by_P, by_Q = loss_and_gradients(P, P, "soft_dtw_divergence", {})
    assert abs(by_P).max() < 1e-12 > abs(by_Q).max()


@both_packages
@pytest.mark.parametrize("form", ["lists", "lengths"])
@every_loss
def test_gradients_of_batches_are_limits_of_differences(name, measure, options, form) -> None:
    """By each package's own check; what fills padded curves has no slope."""
    P, Q = curves_of(LENGTHS[0], 0), curves_of(LENGTHS[1], 1)
    if form == "lengths":
        P, Q, options = [padded(P, 0.0)], [padded(Q, 0.0)], options | {"lengths": LENGTHS}
    function = partial(getattr(getattr(curvewise, name), measure), **options)

    def loss(*curves: Any) -> Any:
        first, second = curves[: len(P)], curves[len(P) :]
        return function(*first, *second) if form == "lengths" else function([*first], [*second])

    if name == "torch":
        import torch

        given = [torch.tensor(curve, requires_grad=True) for curve in (*P, *Q)]
        assert torch.autograd.gradcheck(loss, given)
    else:
        from jax.test_util import check_grads

        check_grads(loss, (*P, *Q), order=1, modes=["rev"], eps=1e-6, rtol=1e-4)


@both_packages
def test_a_model_is_trained_on_unequal_series(name) -> None:
    P, Q = curves_of([5, 9, 7], 0), curves_of([6, 9, 4], 1)
    before, one_by_one = None, list(Q)
    for _ in range(30):
        values, _, by_Q = measured(name, "soft_dtw_divergence", P, Q)
        before = before or values.sum()
        weights = [1.0, 2.0, 3.0]
        Q = [C - 0.02 * slope / w for C, slope, w in zip(Q, by_Q, weights, strict=True)]
        for k, pair in enumerate(zip(P, one_by_one, strict=True)):
            value, _, slope = loss_and_gradients(*pair, "soft_dtw_divergence", {})
            assert values[k] == value
            one_by_one[k] = one_by_one[k] - 0.02 * (slope * weights[k]) / weights[k]
            assert np.array_equal(Q[k], one_by_one[k])
    assert values.sum() < 0.2 * before


def test_the_errors_of_lengths() -> None:
    P, Q = padded(curves_of([3, 5], 0)), padded(curves_of([4, 5], 1), 0.0)
    message = re.escape("rows of nan look padded: give lengths=(those of P, those of Q), or lists")
    with pytest.raises(ValueError, match=message):
        loss_and_gradients(P, Q, "dtw", {})
    with pytest.raises(
        ValueError, match="length 6 of curve 1 of P; give a whole number from 1 to 5"
    ):
        loss_and_gradients(P, Q, "dtw", {}, lengths=(np.array([3, 6]), None))
    with pytest.raises(TypeError, match="the lengths of Q are of type float64; give whole numbers"):
        loss_and_gradients(P, Q, "dtw", {}, lengths=(None, np.array([3.0, 4.0])))
    Q[1, 2, 0] = np.inf
    with pytest.raises(ValueError, match=r"pair 1: Q\[2, 0\] is inf"):
        loss_and_gradients(P, Q, "dtw", {}, lengths=(np.array([3, 5]), None))


@both_packages
def test_the_errors_of_lists(name) -> None:
    P, Q = curves_of([3, 5], 0), curves_of([4, 5], 1)
    with pytest.raises(TypeError, match="P is a list, whose curves have lengths; give None for it"):
        measured(name, "dtw", P, Q, lengths=([3, 5], None))
    with pytest.raises(TypeError, match="lengths is not a pair"):
        measured(name, "dtw", padded(P), padded(Q), lengths=[3, 5, 4])
    with pytest.raises(ValueError, match=r"lengths of Q have shape \(3,\) and its batch has shape"):
        measured(name, "dtw", padded(P), padded(Q), lengths=([3, 5], [4, 5, 5]))
    with pytest.raises(
        ValueError, match=r"Q\[1\] has shape \(5, 1\); give curves of shape \(n, d\)"
    ):
        measured(name, "dtw", P, [Q[0], Q[1][:, :1]])


DIAGONALS = [
    *[("dtw", {"metric": m}) for m in ("euclidean", "sqeuclidean", "cityblock")],
    ("dtw", {"window": 4}),
    ("dtw", {"window": 0.6, "metric": "cityblock"}),
    ("soft_dtw", {"gamma": 1e-6}),
    ("soft_dtw", {"window": 4}),
    *SOFT,
]


@pytest.fixture
def _along_diagonals(monkeypatch):
    """Compute as on another device, and nothing by the compiled losses."""
    used = []

    def refused(P, *rest, **options):
        used.append(P.shape)
        assert P.shape[0] == 0, "the compiled library was called for pairs"
        return loss_and_gradients(P, *rest, **options)

    for name in ("jax", "torch"):
        if find_spec(name):
            module = getattr(curvewise, name)
            monkeypatch.setattr(module, "_stays", lambda *_: True)
            monkeypatch.setattr(module, "loss_and_gradients", refused)
    yield
    assert used


@both_packages
@pytest.mark.parametrize(("measure", "options"), DIAGONALS)
@pytest.mark.usefixtures("_along_diagonals")
def test_anti_diagonals_are_the_compiled_values(name, measure, options) -> None:
    for lengths in (LENGTHS, ([6, 1], [9, 1])):
        P, Q = curves_of(lengths[0], 0), curves_of(lengths[1], 1)
        found = measured(name, measure, P, Q, **options)
        for k, (value, by_P, by_Q) in enumerate(one_by_one(measure, P, Q, options)):
            assert found[0][k] == pytest.approx(value, rel=1e-10, abs=1e-10)
            np.testing.assert_allclose(found[1][k], by_P * (k + 1), rtol=1e-8, atol=1e-8)
            np.testing.assert_allclose(found[2][k], by_Q * (k + 1), rtol=1e-8, atol=1e-8)


@both_packages
@pytest.mark.usefixtures("_along_diagonals")
def test_anti_diagonals_of_equal_points(name) -> None:
    P = curves_of([4, 4], 0)
    values, by_P, by_Q = measured(name, "dtw", P, [C.copy() for C in P])
    assert values.tolist() == [0.0, 0.0]
    assert not np.any([*by_P, *by_Q])


@pytest.mark.skipif(find_spec("jax") is None, reason='no JAX: pip install "curvewise[jax]"')
@pytest.mark.usefixtures("_along_diagonals")
def test_anti_diagonals_under_jit_and_vmap() -> None:
    import jax

    P, Q = np.stack(curves_of([5] * 3, 0)), np.stack(curves_of([7] * 3, 1))
    expected = [value for value, _, _ in one_by_one("soft_dtw", list(P), list(Q), {})]
    for function in (jax.jit, jax.vmap):
        found = function(curvewise.jax.soft_dtw)(P, Q)
        np.testing.assert_allclose(found, expected, rtol=1e-10)
    at_run_time = jax.jit(lambda of_P: curvewise.jax.soft_dtw(P, Q, lengths=(of_P, None)))
    of_P = np.array([2, 5, 4])
    expected = [curvewise.soft_dtw(p[:n], q) for p, q, n in zip(P, Q, of_P, strict=True)]
    np.testing.assert_allclose(at_run_time(jax.numpy.asarray(of_P)), expected, rtol=1e-10)


@pytest.mark.skipif(find_spec("jax") is None, reason='no JAX: pip install "curvewise[jax]"')
def test_lengths_that_are_known_at_run_time() -> None:
    import jax

    P, Q = padded(curves_of([5, 3], 0)), padded(curves_of([4, 7], 1))
    loss = jax.jit(lambda P, Q, a, b: curvewise.jax.area(P, Q, lengths=(a, b)).sum())
    counts = jax.numpy.array([5, 3]), jax.numpy.array([4, 7])
    expected = sum(
        value for value, _, _ in one_by_one("area", curves_of([5, 3], 0), curves_of([4, 7], 1), {})
    )
    assert float(loss(P, Q, *counts)) == pytest.approx(float(expected), rel=1e-15)
    slopes = jax.grad(loss)(P, Q, *counts)
    assert np.isfinite(slopes).all()
    assert not slopes[1, 3:].any()


@pytest.mark.skipif(find_spec("torch") is None, reason='no torch: pip install "curvewise[torch]"')
@pytest.mark.filterwarnings("ignore:The PyTorch API of nested tensors is in prototype stage")
@pytest.mark.parametrize("layout", ["strided", "jagged"])
def test_nested_tensors(layout) -> None:
    import torch

    P, Q = ([torch.tensor(C) for C in curves_of(lengths, 2)] for lengths in LENGTHS)
    kind = getattr(torch, layout)
    nested = [torch.nested.nested_tensor(C, layout=kind, requires_grad=True) for C in (P, Q)]
    values = curvewise.torch.dtw(*nested)
    assert torch.equal(values, curvewise.torch.dtw(P, Q))
    values.sum().backward()
    for curves, place in zip(nested, (1, 2), strict=True):
        for k, slopes in enumerate(curves.grad.unbind()):
            expected = loss_and_gradients(P[k].numpy(), Q[k].numpy(), "dtw", {})[place]
            assert (slopes.numpy() == expected).all()
