"""Several courses as one: in rounds, each of which asks for what all of them ask for next.

A round has the courses in their order, and a course begins where others have ended in the rounds
before, so that what comes of them depends neither on how many runs are made at the same time nor on
which of them is finished first. Cost: nothing beside the courses. A round lasts as long as its
longest run.
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


def side_by_side(first: Sequence[Part[R]], more: Callable[[], Sequence[Part[R]]]) -> Part[list[R]]:
    """Drive courses in rounds, each to its end; return what they return, in their order.

    Parameters
    ----------
    first : sequence of generators
        With which it begins.
    more : callable
        Called after every round in which a course has ended, for those to begin then.
    """
    courses = list(first)
    ended: dict[int, R] = {}
    answers: dict[int, list[Evaluation] | None] = dict.fromkeys(range(len(courses)))
    while True:
        waiting: dict[int, Array] = {}
        while answers:
            before = len(ended)
            for i, answer in answers.items():
                try:
                    waiting[i] = next(courses[i]) if answer is None else courses[i].send(answer)
                except StopIteration as end:
                    ended[i] = end.value
            known = len(courses)
            if len(ended) > before:
                courses += more()
            answers = dict.fromkeys(range(known, len(courses)))
        if not waiting:
            return [ended[i] for i in range(len(courses))]
        runs = iter((yield np.vstack(list(waiting.values()))))
        answers = {i: [next(runs) for _ in units] for i, units in waiting.items()}
