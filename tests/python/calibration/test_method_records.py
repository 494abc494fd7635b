"""The record of a method: what each says of itself, and that nothing else has to be told of one."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import pytest
from test_near_names import line

from curvewise import calibration
from curvewise.calibration import (
    SDRM,
    DifferentialEvolution,
    LeastSquares,
    NelderMead,
    TrustRegion,
    identify,
    identify_each,
)
from curvewise.calibration.methods import METHODS, method_with
from curvewise.calibration.methods.method import Method
from curvewise.calibration.problem.ledger import Finish


@dataclass(frozen=True, kw_only=True, repr=False)
class Grid(Method, name="grid", keeps_curves=True, needs_squares=False):
    """Points of a grid, finer near an optimum."""

    points: int = 11
    step: float = 0.1

    def fewest_runs(self, parameters, *, has_start):
        return self.points**parameters

    def near_optimum(self):
        return replace(self, step=0.01)

    def course(self, ledger, start, seed):
        middle = np.full(ledger.dimensions, 0.5) if start is None else start
        steps = self.step * (np.arange(self.points) - self.points // 2)
        yield np.clip(middle + steps[:, np.newaxis], 0.0, 1.0)
        return Finish(True, f"{self.points} points")


@pytest.mark.parametrize("name", METHODS)
def test_every_record_is_whole(name):
    method = METHODS[name]
    assert type(method)() == replace(method, **({"after": None} if "+" in name else {}))
    assert str(method) == name
    assert method.fewest_runs(3, has_start=True) <= method.fewest_runs(3, has_start=False)
    assert isinstance(method.near_optimum(), type(method))
    assert isinstance(method.closer(), (type(method), type(None)))
    assert eval(repr(method), vars(calibration)) == method
    documented = type(method).__doc__ or ""
    for option in fields(method):
        assert f"{option.name} :" in documented or f"{option.name}, " in documented, option.name
    assert type(method).__name__ in calibration.__all__


def test_a_forgotten_part_is_an_error():
    with pytest.raises(TypeError, match="needs_squares"):

        class Nameless(Method, name="x", keeps_curves=False):  # type: ignore[call-arg]
            pass

    class Empty(Method, name="x", keeps_curves=False, needs_squares=False):
        pass

    with pytest.raises(TypeError, match=r"course.*fewest_runs"):
        Empty()


def test_a_new_method_needs_its_record_alone():
    found = identify(line, line({"a": 4.0}), {"a": (0, 10)}, method=Grid(), progress=False)
    assert (found.parameters["a"], found.evaluations) == (pytest.approx(4.0), 11)
    assert (found.method, found.message) == ("grid", "11 points")
    assert len(found.runs_with_curves) == 11
    keywords = {"measures": ["area", "dtw"], "method": Grid(), "progress": False}
    each = identify_each(line, line({"a": 4.05}), {"a": (0, 10)}, **keywords)
    assert each["area"].parameters["a"] == pytest.approx(4.0)
    assert each["dtw"].parameters["a"] == pytest.approx(4.05, abs=0.051)


def test_a_new_method_has_a_name(monkeypatch):
    monkeypatch.setitem(METHODS, "grid", Grid())
    found = identify(line, line({"a": 4.0}), {"a": (0, 10)}, method="grid", progress=False)
    assert found.evaluations == 11
    assert method_with({"name": "grid", "points": 5}) == Grid(points=5)


def test_methods_as_tables():
    given: dict[str, Any] = {"name": "de", "popsize": 4, "after": {"name": "sdrm", "maxiter": 2}}
    assert method_with(given) == DifferentialEvolution(popsize=4, after=SDRM(maxiter=2))
    assert method_with({"name": "sdrm+de", "popsize": 4}) == DifferentialEvolution(
        popsize=4, after=SDRM()
    )
    assert method_with({"starts": 2}) == TrustRegion(starts=2)


def test_near_an_optimum_what_has_been_set_stays():
    assert TrustRegion(starts=5).near_optimum() == TrustRegion(starts=5, initial_range=0.1)
    assert SDRM(initial_range=1.0).near_optimum() == SDRM(initial_range=1.0)
    assert TrustRegion(gain=1e-2).closer() == TrustRegion(gain=1e-2, initial_range=0.3, tol=1e-4)
    assert METHODS["sdrm+de"].near_optimum() == DifferentialEvolution(after=SDRM(initial_range=0.1))
    assert LeastSquares(starts=5).near_optimum() == LeastSquares(starts=5, initial_range=0.1)
    for method in (NelderMead(), METHODS["auto"], DifferentialEvolution()):
        assert method.near_optimum() == method


def test_functions_among_the_options_are_written_by_their_names():
    method = DifferentialEvolution(options={"callback": line, "mutation": (0.4, 0.9)})
    assert repr(method) == (
        "DifferentialEvolution(options={'callback': line, 'mutation': (0.4, 0.9)})"
    )
