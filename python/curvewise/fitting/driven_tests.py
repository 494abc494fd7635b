"""Tests of a fit: thinned, and driving a material-point model.

A test of thousands of points determines no more than some hundreds of them with its reversals. A
dense, noisy test is averaged first (`curves.averaging`). If only the last cycle is compared, the
earlier part is driven by its reversals. The same holds for cycles that a record leaves out
(`recorded_cycles`). Cost: linear in the tests.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

from ..calibration import Criterion, LeastSquares
from ..calibration.methods.method import Method
from ..curves.inputs import Array
from ..curves.named_curve import name_of_test
from ..materials import DrivenModel, Material
from .recorded_cycles import driven_test

__all__ = ["CYCLES", "Cycles", "DrivenTests", "fit_criterion", "fit_method"]

Cycles: TypeAlias = Literal["all", "last"]
CYCLES: tuple[str, ...] = get_args(Cycles)

# The simulation has the strains of the test, even if these reverse.
_POINT_BY_POINT: dict[str, dict[str, Any]] = {"sum_of_squares": {"abscissa": "points"}}
# A run takes 0.1 ms, so fewer starts save little time. Ten starts were within 0.05 % of the best of
# scipy's least_squares from fifty places, on thirteen measured tests.
_MANY_STARTS = {"sum_of_squares": LeastSquares(starts=10, most_starts=20)}


class DrivenTests(NamedTuple):
    """The compared part of some tests, and the model that they drive.

    Attributes
    ----------
    model : DrivenModel
    compared : tuple of ndarray
        Strain and stress of each test, point by point like the model's.
    """

    model: DrivenModel[Material]
    compared: tuple[Array, ...]

    @classmethod
    def of(
        cls,
        material: Material,
        tests: Sequence[Any],
        *,
        cycles: str = "all",
        points: int = 300,
        rates: Sequence[float] | None = None,
    ) -> DrivenTests:
        """Return the tests, thinned to about `points` points; see `fit_material`."""
        if cycles not in CYCLES:
            raise ValueError(f"cycles is {cycles!r}; give {' or '.join(map(repr, CYCLES))}")
        driven = [
            driven_test(test, name_of_test(test, i), cycles, points) for i, test in enumerate(tests)
        ]
        paths = tuple(one.path for one in driven)
        parts = [one.compared for one in driven]
        is_whole = all(isinstance(part, slice) and part == slice(None) for part in parts)
        model = material.driven_by(paths, parts=None if is_whole else parts, rates=rates)
        return cls(model, tuple(path[part] for path, part in zip(paths, parts, strict=True)))


def fit_criterion(measure: str, **settings: Any) -> Criterion:
    """Return how a material is compared with the tests that drive it."""
    return Criterion(measure, **{**_POINT_BY_POINT.get(measure, {}), **settings})


def fit_method(measure: str) -> str | Method:
    """Return how its parameters are searched for."""
    return _MANY_STARTS.get(measure, "auto")
