"""Several courses side by side: each goes on as soon as its own runs are there.

In rounds, in each of which every course has its turn, in their order, and a course begins where
others have ended in the round before. What a course asks for is made known at once, so that it may
be run while the others have their turns: what they compute costs no time where there are workers
enough. What comes of courses that share what they know depends on the order of turns alone, neither
on how many runs are made at the same time nor on which is finished first, and no run is made that
is not asked for. Cost: nothing beside the courses.
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
    """Drive courses in turns, each to its end; return what they return, in their order.

    What they begin with is asked for at once: a search ends where all of that fails.

    Parameters
    ----------
    first : sequence of generators
        With which it begins.
    more : callable
        Called after every round in which a course has ended, for those to begin then.
    expect : callable
        Told what a course asks for, when that is known and other courses' turns come first.
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
