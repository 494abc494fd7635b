"""Turns a function with a callback, such as a scipy optimiser, into a course.

The function runs in its own thread, and one of the two threads always waits for the other.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import TypeAlias

from ...curves.inputs import Array
from ..problem.ledger import Course, Finish
from ..records.evaluation import Evaluation

__all__ = ["Evaluate", "course_of"]

Evaluate: TypeAlias = Callable[[Array], list[Evaluation]]
"""Returns the evaluations of a batch of points, shape (count, k)."""


class _AbandonedError(BaseException):
    """The course has been abandoned; no handler of Exception can catch this error."""


def course_of(function: Callable[[Evaluate], Finish]) -> Course:
    """Return the course of a function that is given what evaluates batches of points."""
    asked: SimpleQueue[Array | Finish | BaseException] = SimpleQueue()
    answered: SimpleQueue[list[Evaluation] | None] = SimpleQueue()

    def evaluate(units: Array) -> list[Evaluation]:
        asked.put(units)
        answer = answered.get()
        if answer is None:
            raise _AbandonedError
        return answer

    def run() -> None:
        try:
            asked.put(function(evaluate))
        except _AbandonedError:
            pass
        except BaseException as error:
            asked.put(error)

    threading.Thread(target=run, name="curvewise optimiser", daemon=True).start()
    try:
        while True:
            question = asked.get()
            if isinstance(question, BaseException):
                raise question
            if isinstance(question, Finish):
                return question
            answered.put((yield question))
    finally:
        answered.put(None)  # the thread, if it still waits, ends
