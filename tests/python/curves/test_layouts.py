"""Curves with more coordinates than points are rejected as doubtful, and no others, in every call.

The tests decide which curves are doubtful by a separate definition, and try every entry with it.
"""

from __future__ import annotations

import pickle
import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest

import curvewise
from curvewise import LayoutWarning

SIZES = [1, 2, 3, 4, 7, 12, 40]
SHAPES = [(n, d) for n in SIZES for d in SIZES]


def random(*shape: int) -> np.ndarray[Any, Any]:
    return np.random.default_rng(0).normal(size=shape)


def words_of(call: Callable[[], Any]) -> list[warnings.WarningMessage]:
    """Return what a call says of layouts."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    return [one for one in caught if isinstance(one.message, LayoutWarning)]


PAIRS: dict[str, Callable[[Any, Any], Any]] = {
    **{
        name: getattr(curvewise, name)
        for name in [
            *("dtw", "frechet", "frechet_continuous", "soft_dtw", "hausdorff"),
            *("hausdorff_continuous", "hausdorff_continuous_points"),
            *("erp", "edr", "lcss", "msm", "twe", "wdtw"),
            *("dtw_path", "frechet_path", "dtw_table", "frechet_table", "dtw_info"),
            *("frechet_info", "frechet_continuous_path", "soft_dtw_divergence"),
        ]
    },
    "edit_path": lambda P, Q: curvewise.edit_path(P, Q, "erp"),
    "frechet_within": lambda P, Q: curvewise.frechet_within(P, Q, 1.0),
    "bounds": lambda P, Q: curvewise.frechet_continuous(P, Q, bounds=True),
    "value_and_gradient": curvewise.value_and_gradient,
    "normalize": curvewise.normalize,
    "compare": lambda P, Q: curvewise.compare(P, Q, measures=["dtw", "frechet"]),
    "Prepared": lambda P, Q: curvewise.Prepared(P)(Q),
    "subsequence": curvewise.subsequence,
    "subsequence with a path": lambda P, Q: curvewise.subsequence(P, Q, path=True),
    "subsequence, normalized": lambda P, Q: (
        curvewise.subsequence(P, Q, normalize=True) if len(P) <= len(Q) else None
    ),
}


@pytest.mark.parametrize("entry", PAIRS)
def test_pairs(entry: str) -> None:
    for n, d in SHAPES:
        P = random(n, d)
        words = words_of(lambda P=P: PAIRS[entry](P, P + 1.0))
        assert len(words) == (d > n)
        for word in words:
            assert word.filename == __file__  # the caller's line
            assert str(word.message).startswith(f"P has shape ({n}, {d}), as a curve {n} point")
            assert "transpose: P.T; " in str(word.message)


@pytest.mark.parametrize("entry", [one for one in PAIRS if one not in ("Prepared",)])
def test_curves_of_different_lengths_are_in_no_doubt(entry: str) -> None:
    for n, m, d in [(1, 2, 3), (3, 2, 40), (2, 9, 3)]:
        assert not words_of(lambda n=n, m=m, d=d: PAIRS[entry](random(n, d), random(m, d)))


def kneighbors(curves: Any, **layout: Any) -> Any:
    return curvewise.Index(curves, **layout).kneighbors(curves, 1)


def added(curves: Any, **layout: Any) -> Any:
    index = curvewise.Index(curves, **layout)
    index.add(curves)
    return index.radius_neighbors(curves, 1.0)


def by_sklearn(name: str, **options: Any) -> Callable[..., Any]:
    def fit(curves: Any, **layout: Any) -> Any:
        module = pytest.importorskip("curvewise.sklearn", exc_type=ImportError)
        estimator = getattr(module, name)(**options, **layout)
        return estimator.fit(curves, [0] * len(curves)).predict(curves)

    return fit


def by_dask(call: Callable[..., Any]) -> Callable[..., Any]:
    def computed(curves: Any, **layout: Any) -> Any:
        module = pytest.importorskip("curvewise.dask", exc_type=ImportError)
        lazy = call(module, curves, **layout)
        parts = lazy if isinstance(lazy, tuple) else (lazy,)
        return [part.compute(scheduler="synchronous") for part in parts]

    return computed


LISTS: dict[str, Callable[..., Any]] = {
    "cdist": curvewise.cdist,
    "cdist of two lists": lambda X, **layout: curvewise.cdist(X, X, "frechet", **layout),
    "cdist by pairs": lambda X, **layout: curvewise.cdist(X, measure=curvewise.erp, **layout),
    "pdist": curvewise.pdist,
    "own metric": lambda X, **layout: curvewise.pdist(
        X, metric=lambda p, q: np.abs(p[:, np.newaxis] - q).sum(axis=2), **layout
    ),
    "Index": kneighbors,
    "Index.add": added,
    "pickled": lambda X, **layout: pickle.loads(
        pickle.dumps(curvewise.Index(X, **layout))
    ).kneighbors(X, 1),
    "dtw_mean": curvewise.dtw_mean,
    "soft_dtw_mean": lambda X, **layout: curvewise.soft_dtw_mean(X, iterations=1, **layout),
    "medoid": curvewise.medoid,
    "classifier": by_sklearn("CurveKNeighborsClassifier", n_neighbors=1),
    "medoids": by_sklearn("CurveKMedoids", n_clusters=1),
    "means": by_sklearn("CurveKMeans", n_clusters=1, random_state=0),
    "dask cdist": by_dask(lambda module, X, **layout: module.cdist(X, **layout)),
    "dask pdist": by_dask(lambda module, X, **layout: module.pdist(X, **layout)),
    "dask kneighbors": by_dask(lambda module, X, **layout: module.kneighbors(X, X, 1, **layout)),
}


@pytest.mark.parametrize("entry", LISTS)
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_lists(entry: str) -> None:
    call = LISTS[entry]
    for n, d in [(1, 2), (2, 3), (3, 3), (4, 2), (2, 1), (6, 40), (40, 6)]:
        X = random(3, n, d)
        words = words_of(lambda X=X: call(X))
        assert len(words) == (d > n), (n, d)  # once, and not by a part of the call
        for word in words:
            assert word.filename == __file__
            assert f"[0] has shape ({n}, {d}), as a curve {n} point" in str(word.message)
            assert "give layout='channels_first' if" in str(word.message)
        for layout in ("channels_first", "channels_last"):
            assert not words_of(lambda X=X, layout=layout: call(X, layout=layout))


def of_layout(found: Any) -> Any:
    """Return numbers of whatever an entry returns."""
    if isinstance(found, (tuple, list)):
        return [of_layout(one) for one in found]
    return np.asarray(getattr(found, "curve", found)).tolist()


@pytest.mark.parametrize("entry", LISTS)
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_channels_first_are_curves_transposed(entry: str) -> None:
    X = random(4, 6, 20)
    first = LISTS[entry](X, layout="channels_first")
    last = LISTS[entry](X.transpose(0, 2, 1), layout="channels_last")
    np.testing.assert_equal(of_layout(first), of_layout(last))
    ragged = [X[0], X[1][:, :9], X[2][:, :4]]
    ragged_last = LISTS[entry]([curve.T for curve in ragged])
    np.testing.assert_equal(
        of_layout(LISTS[entry](ragged, layout="channels_first")), of_layout(ragged_last)
    )


@pytest.mark.parametrize("entry", LISTS)
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_lists_of_different_lengths_are_in_no_doubt(entry: str) -> None:
    assert not words_of(lambda: LISTS[entry]([random(2, 9), random(3, 9), random(5, 9)]))


def test_lists_of_a_pair_are_told_apart_together() -> None:
    few, many = random(2, 2, 3), random(2, 9, 3)
    assert not words_of(lambda: curvewise.cdist(few, many))
    assert not words_of(lambda: curvewise.cdist(many, few))
    index = curvewise.Index(many)
    assert not words_of(lambda: (index.add(few), index.kneighbors(few, 1)))
    empty = curvewise.Index([])
    assert len(words_of(lambda: empty.add(few))) == 1
    assert not words_of(lambda: (empty.add(few), empty.kneighbors(few, 1)))
    assert not words_of(lambda: curvewise.Prepared(many[0])(few))
    assert len(words_of(lambda: curvewise.cdist(few, random(1, 2, 3)))) == 1


def test_an_unknown_layout_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^unknown layout 'rows'; choose from channels_first, "):
        curvewise.pdist(random(2, 3, 4), layout="rows")


def test_what_is_known_of_a_layout_is_not_asked() -> None:
    named = pd.DataFrame(random(2, 3), columns=["x", "y", "z"])
    assert not words_of(lambda: curvewise.dtw_path(named, named))
    assert not words_of(lambda: curvewise.pdist([named, named + 1.0]))
    assert not words_of(lambda: curvewise.Prepared(named)(named))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LayoutWarning)
        prepared = curvewise.Prepared(random(2, 3))
    assert not words_of(lambda: pickle.loads(pickle.dumps(prepared)))
    assert words_of(lambda: curvewise.dtw(pd.DataFrame(random(2, 3)), named.to_numpy()))
    assert not words_of(lambda: curvewise.dtw([(0, 0)], [(1, 1)], metric="haversine"))
    assert not words_of(lambda: curvewise.mse(random(2, 9), random(2, 9)))  # the same transposed


def test_lines_are_in_no_doubt() -> None:
    shapely = pytest.importorskip("shapely")
    lines = [shapely.LineString([(0, 0, 0), (1, 1, i)]) for i in range(3)]
    assert not words_of(lambda: (curvewise.frechet(*lines[:2]), curvewise.pdist(lines)))


def as_xarray(array: Any) -> Any:
    return pytest.importorskip("xarray").DataArray(array)


def as_tensor(array: Any) -> Any:
    return pytest.importorskip("torch").tensor(array)


def as_jax(array: Any) -> Any:
    return pytest.importorskip("jax.numpy").asarray(array)


CONTAINERS = {"numpy": np.asarray, "xarray": as_xarray, "torch": as_tensor, "jax": as_jax}
TABLES = {
    "pandas": (pd.DataFrame, "dict(X.items())"),
    "polars": (lambda X: pytest.importorskip("polars").DataFrame(X), "X.to_dict()"),
    "pyarrow": (
        lambda X: pytest.importorskip("pyarrow").table({f"x{i}": x for i, x in enumerate(X.T)}),
        "X.to_pydict()",
    ),
}


@pytest.mark.parametrize("container", CONTAINERS)
def test_one_rule_for_arrays_of_all_packages(container: str) -> None:
    make = CONTAINERS[container]
    for n, d in [(2, 3), (6, 30), (30, 6)]:
        X = make(random(2, n, d))
        assert bool(words_of(lambda X=X: curvewise.pdist(X))) == (d > n)
        assert bool(words_of(lambda X=X: curvewise.Index(list(X)))) == (d > n)
        assert bool(words_of(lambda X=X: curvewise.dtw(X[0], X[1]))) == (d > n)
    for entry in (curvewise.pdist, curvewise.cdist, curvewise.Index, curvewise.dtw_mean):
        with pytest.raises(ValueError, match=r"has 2 array dimensions; .* list\(\w+\) for k"):
            entry(make(random(30, 3)))
    assert curvewise.pdist(list(make(random(4, 3)))).shape == (6,)  # as the message says


@pytest.mark.parametrize("kind", TABLES)
def test_one_rule_for_tables_of_all_packages(kind: str) -> None:
    make, instead = TABLES[kind]
    X = make(random(9, 3))
    for entry in (curvewise.pdist, curvewise.medoid):
        name = "X" if entry is curvewise.pdist else "curves"
        written = re.escape(instead.replace("X", name))
        with pytest.raises(ValueError, match=rf"has 2 array dimensions; .*, {written} for k cu"):
            entry(X)
    assert len(curvewise.pdist(eval(instead, {"X": X}))) == 3  # as the message says


def losses() -> dict[str, Any]:
    return {"torch": as_tensor, "jax": as_jax}


@pytest.mark.parametrize("package", losses())
def test_losses(package: str) -> None:
    array = losses()[package]
    array(0.0)
    measures = getattr(curvewise, package)
    for n, d in [(8, 30), (1, 30), (30, 8), (2, 3), (30, 1)]:
        for name in ("dtw", "soft_dtw", "frechet"):
            P, batch = array(random(n, d)), array(random(5, n, d))
            loss = getattr(measures, name)
            words = words_of(lambda P=P, loss=loss: loss(P, P))
            assert [word.filename for word in words] == [__file__] * (d > n)
            if words:
                said = str(words[0].message)
                assert (
                    f"; for {n} series of {d} points give P[..., None]; if its points are" in said
                )
                assert loss(P[..., None], P[..., None]).shape == (n,)
            words = words_of(lambda P=P, batch=batch, loss=loss: loss(batch, P))
            assert len(words) == (d > n)
            assert all("transpose: P.swapaxes(-1, -2); if" in str(word.message) for word in words)


def test_pairs_of_a_batch() -> None:
    assert words_of(lambda: curvewise.values_and_gradients(random(2, 3, 9), random(2, 3, 9)))
    assert not words_of(lambda: curvewise.values_and_gradients(random(2, 9, 3), random(2, 9, 3)))
    assert not words_of(lambda: curvewise.values_and_gradients(random(2, 3, 9), random(2, 4, 9)))


def test_series_of_aeon_have_a_known_layout() -> None:
    import curvewise.aeon as distances

    X = random(3, 6, 4)  # 6 channels, 4 time points
    assert not words_of(lambda: distances.dtw_distance(X[0], X[1]))
    assert not words_of(lambda: distances.dtw_alignment_path(X[0], X[1]))
    assert not words_of(lambda: distances.dtw_cost_matrix(X[0], X[1]))
    assert not words_of(lambda: distances.dtw_pairwise_distance(X))


@pytest.mark.nightly
@pytest.mark.parametrize("entry", [*PAIRS, *LISTS])
@pytest.mark.filterwarnings("ignore:the mean has not converged")
def test_every_size(entry: str) -> None:
    for n in range(1, 41):
        for d in range(1 + n % 3, 41, 3):
            X = random(3, n, d)
            call = LISTS.get(entry) or (lambda X: PAIRS[entry](X[0], X[1]))
            assert bool(words_of(lambda X=X, call=call: call(X))) == (d > n), (n, d)
