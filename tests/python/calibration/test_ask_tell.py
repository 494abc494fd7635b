"""Searches that an external loop drives: the requests, the allowed order of answers, and the
result.
"""

from __future__ import annotations

import threading

import numpy as np
import pytest
from test_near_names import line

from curvewise.calibration import (
    SDRM,
    DifferentialEvolution,
    Global,
    LeastSquares,
    NelderMead,
    Problem,
    TrustRegion,
    identify,
)
from curvewise.calibration.methods.called_back import course_of
from curvewise.calibration.problem.execution import Execution

BOUNDS = {"a": (0.0, 10.0), "b": (-1.0, 1.0), "fixed": 3.0}
X = np.linspace(0.0, 1.0, 15)


def bent(p):
    assert p["fixed"] == 3.0
    return np.column_stack((X, p["a"] * X + p["b"] * X**2))


TEST = bent({"a": 4.0, "b": 0.3, "fixed": 3.0})
EVERY = [
    TrustRegion(starts_at_once=3),
    TrustRegion(starts_at_once=1),
    SDRM(maxiter=6),
    DifferentialEvolution(popsize=3, maxiter=4),
    DifferentialEvolution(popsize=3, maxiter=2, after=SDRM(maxiter=2)),
    Global(popsize=4, rounds=1),
    NelderMead(restarts=0, options={"maxfev": 30}),
    LeastSquares(starts_at_once=3),
]


def driven(search, order, at_once):
    """Drive a search; runs come back in an order that is drawn, after others have been asked."""
    out = []
    while not search.ended:
        out += search.ask()
        order.shuffle(out)
        for _ in range(min(at_once, len(out))):
            parameters = out.pop()
            search.tell(parameters, bent(parameters))
    assert not out
    return search.answer()


def test_a_start_goes_on_while_others_wait_for_their_runs():
    """By one turn: the next requests then depend on the missing answers of the others."""
    search = TrustRegion(starts=3).begin(Problem.of(TEST, BOUNDS))

    def told(sets):
        for parameters in sets:
            search.tell(parameters, bent(parameters))
        return search.ask()

    own, *others = told(search.ask())
    assert len(others) == 2
    after = told([own])
    assert after  # its next requests
    assert not told(after)
    after = told(others[:1])
    assert after
    assert told(others[1:])  # the first's turn has come, and the second's answers are complete


@pytest.mark.parametrize("method", EVERY, ids=repr)
def test_asked_and_told_is_what_identify_finds(method):
    """Bit for bit, in whatever order runs are told."""
    measure = "sum_of_squares" if method.needs_squares else "area"
    found = identify(bent, TEST, BOUNDS, method=method, measure=measure, seed=4, progress=False)
    for at_once in (1, 5):
        search = method.begin(Problem.of(TEST, BOUNDS, measure=measure), seed=4)
        answer = driven(search, np.random.default_rng(at_once), at_once)
        assert answer.parameters == found.parameters
        assert (answer.value, answer.converged) == (found.value, found.converged)
        assert answer.message == found.message
        for name in ("evaluation", "a", "b", "value"):
            np.testing.assert_array_equal(answer.history[name], found.history[name])
        if method.keeps_curves:
            np.testing.assert_array_equal(answer.simulations, found.simulations[0])


def test_nothing_is_asked_twice_and_what_is_out_is_known():
    search = TrustRegion().begin(Problem.of(TEST, BOUNDS))
    first = search.ask()
    assert len(first) == 3 * 3  # a simplex of three runs around each start
    assert search.ask() == []
    search.tell(first[4], bent(first[4]))
    assert search.out() == first[:4] + first[5:]
    with pytest.raises(RuntimeError, match="the search has not ended"):
        search.answer()
    with pytest.raises(ValueError, match="are not out"):
        search.tell(first[4], bent(first[4]))
    with pytest.raises(ValueError, match="told of a run without b; tell what ask"):
        search.tell({"a": 1.0})
    for parameters in search.out():
        search.tell(parameters, message="the queue was full")
    assert not search.ended  # one of them has succeeded
    assert search.ask()


def test_a_search_of_which_all_runs_fail_says_so():
    search = TrustRegion(starts=1).begin(Problem.of(TEST, BOUNDS))
    *others, last = search.ask()
    for parameters in others:
        search.tell(parameters, message="licence expired")
    with pytest.raises(RuntimeError, match=r"succeeded, of 3 .*licence expired"):
        search.tell(last, message="licence expired")


def test_the_most_runs():
    problem = Problem.of(TEST, BOUNDS)
    answer = driven(TrustRegion().begin(problem, max_runs=11), np.random.default_rng(0), 3)
    assert (len(answer.history), answer.converged) == (11, False)
    assert answer.message == "max_runs = 11 reached"


def test_where_a_search_begins():
    problem = Problem.of(TEST, BOUNDS)
    start = {"a": 1.0, "b": 0.5}
    first = TrustRegion().begin(problem, start=start).ask()[0]
    assert first == pytest.approx({**start, "fixed": 3.0})
    with pytest.raises(ValueError, match="a"):
        TrustRegion().begin(problem, start={**start, "a": 11.0})
    with pytest.raises(ValueError, match="is not a sum of squares"):
        LeastSquares().begin(problem)


def test_a_problem_without_a_model_is_for_asking():
    with pytest.raises(ValueError, match=r"no model: its search is driven by ask\(\) and tell\("):
        Execution().simulator(Problem.of(TEST, BOUNDS).model).__enter__()
    with pytest.raises(TypeError, match="spacings"):
        Problem.of(TEST, BOUNDS, spacings="x")


def test_a_function_that_is_abandoned_ends():
    """However it handles exceptions, and before or after its first question."""
    handled = []

    def stubborn(evaluate):
        for _ in range(3):
            try:
                evaluate(np.zeros((1, 2)))
            except Exception as error:
                handled.append(error)

    before = threading.active_count()
    course = course_of(stubborn)
    assert next(course).shape == (1, 2)
    course.close()
    for thread in threading.enumerate():
        if thread.name == "curvewise optimiser":
            thread.join(10.0)
    assert threading.active_count() == before
    assert not handled


def test_what_a_function_raises_is_raised():
    def wrong(evaluate):
        evaluate(np.zeros((1, 1)))
        raise ValueError("xtol is negative")

    course = course_of(wrong)
    next(course)
    with pytest.raises(ValueError, match="xtol is negative"):
        course.send([])


def test_what_a_model_of_the_wrong_shape_says_reaches_the_user():
    with pytest.raises(ValueError, match="must have the same number of coordinates"):
        identify(lambda p: line({"a": 1.0})[:, :1], TEST, BOUNDS, method="de", progress=False)
