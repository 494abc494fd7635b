"""Checks about twenty times a second whether a block of dask is still needed.

Python delivers Ctrl-C to the main thread alone. The threads of dask's own scheduler continue the
tasks that they have begun, and keep the interpreter from ending. A cluster's worker does the same
with a cancelled task. The task is not notified. The task's thread can check where the main thread
is, whether it has ended, and the state that the worker records for the task.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

__all__ = ["AbandonedError", "watch"]


class AbandonedError(RuntimeError):
    """The result is not needed any more."""


def watch() -> Callable[[int, int], None] | None:
    """Return a function that raises AbandonedError in this thread if abandoned.

    Return None on the main thread, which receives Ctrl-C itself.
    """
    if threading.current_thread() is threading.main_thread():
        return None
    tests = [lambda: not threading.main_thread().is_alive(), _scheduler_test(), _cluster_test()]

    def report(done: int, total: int) -> None:
        if any(test() for test in tests):
            raise AbandonedError(f"abandoned after {done} of {total} steps: nobody waits for it")

    return report


def _scheduler_test() -> Callable[[], bool]:
    """Return whether the main thread has left the call of dask's scheduler that it is in now."""
    waiting = _scheduler_call()
    return lambda: waiting is not None and _scheduler_call() != waiting


def _scheduler_call() -> int | None:
    """Identify the outermost call into dask's local scheduler on the main thread."""
    ident = threading.main_thread().ident
    frame: FrameType | None = sys._current_frames().get(ident or 0)
    found = None
    while frame is not None:
        if frame.f_globals.get("__name__") == "dask.local":
            found = id(frame)
        frame = frame.f_back
    return found


def _cluster_test() -> Callable[[], bool]:
    """Return whether the cluster's worker that runs this thread's task has cancelled it."""
    distributed: Any = sys.modules.get("distributed")
    try:
        worker = distributed.get_worker()
        key = worker.get_current_task()
        worker.state.tasks[key]
    except (AttributeError, KeyError, ValueError):  # no cluster, or one without these
        return lambda: False
    return lambda: _is_cancelled(worker.state.tasks.get(key))


def _is_cancelled(task: Any) -> bool:
    return task is None or task.state in ("cancelled", "released", "forgotten")
