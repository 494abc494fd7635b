"""Several courses in parallel; each continues when its own runs end.

The courses take turns in rounds, in a fixed order. New courses begin where others ended in the
round before. The points that a course requests are announced at once, so that they can run during
the turns of the other courses. With enough workers, computations within the courses therefore cost
no time. The result of courses that share their runs depends on the order of turns alone. It depends
neither on the number of parallel runs nor on which run finishes first. No run is made that was not
requested. Cost: the cost of the courses.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import TypeAlias, TypeVar

import numpy as np

from ...curves.inputs import Array
from ..records.evaluation import Evaluation

__all__ = ["Part", "side_by_side"]

R = TypeVar("R")
Part: TypeAlias = Generator[Array, list[Evaluation], R]
"""A part of a course, which returns something of its own."""


def side_by_side(
    first: Sequence[Part[R]],
    more: Callable[[], Sequence[Part[R]]],
    expect: Callable[[Array], object],
) -> Part[list[R]]:
    """Drive courses in turns, each to its end; return their results in order.

    The first points of all courses are one batch, because a search ends if all of its first batch
    fails.

    Parameters
    ----------
    first : sequence of generators
        The first courses.
    more : callable
        Called after every round in which a course has ended; returns the courses to begin then.
    expect : callable
        Called with the points that a course requests while it waits for the turns of other courses.
    """
    courses: list[Part[R]] = []
    ended: dict[int, R] = {}
    asked: dict[int, Array] = {}

    def go_on(i: int, answer: list[Evaluation] | None) -> None:
        try:
            asked[i] = next(courses[i]) if answer is None else courses[i].send(answer)
        except StopIteration as end:
            asked.pop(i, None)
            ended[i] = end.value
        else:
            expect(asked[i])

    def begin(new: Sequence[Part[R]]) -> None:
        while new:
            before = len(ended)
            courses.extend(new)
            for i in range(len(courses) - len(new), len(courses)):
                go_on(i, None)
            new = more() if len(ended) > before else ()

    begin(first)
    if asked:
        yield np.vstack(list(asked.values()))
    while asked:
        before = len(ended)
        for i, units in list(asked.items()):
            go_on(i, (yield units))
        if len(ended) > before:
            begin(more())
    return [ended[i] for i in range(len(courses))]
