"""Runs a model in this process or in several, and returns outcomes.

With one worker, the model is called in this process. With more, a pool of processes is started
once. Each process receives the pickled model once, and outcomes are returned as they finish. Calls
may begin before their results are requested.

Ctrl-C stops the model in every process. Workers raise KeyboardInterrupt while the model runs, so
that it can stop its own processes (such as a solver), and ignore it while they are idle. If SIGINT
is ignored, as in background jobs of a shell script, SIGTERM replaces it between these processes. A
worker that dies (killed, or crashed in compiled code of the model) breaks the pool. The interrupted
points are then run again one by one, each in a new process, so that only the point that kills its
process counts as failed. Workers end by themselves if their parent process is killed.

A given executor, such as that of dask or a cluster, replaces these processes. It is left unchanged.
Runs that it continues after Ctrl-C must be stopped by its owner.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from typing import Any, NamedTuple, TypeAlias

from ..._bounds import OutsideModelError
from .process import SolverError
from .raised import named_with_place

__all__ = ["Model", "ModelPool", "Outcome"]

Model: TypeAlias = Callable[[dict[str, Any]], Any]

_LONGEST_MESSAGE = 1500
_PATIENCE = 5.0  # seconds that a model has to end after Ctrl-C before its process is ended


class Outcome(NamedTuple):
    """The outcome of one call of the model: simulations, or a failure's message."""

    simulations: Any
    message: str
    seconds: float


class ModelPool:
    """A model and the processes that run it; a context manager.

    Parameters
    ----------
    model : callable
        Called with a dict of parameters.
    workers : int
        Processes: at least 1 (the model is called in this process), or -1 for one per core.
    executor : concurrent.futures.Executor, optional
        Runs the model instead of processes of this pool.

    Raises
    ------
    ValueError
        If `workers` is out of range, or given together with an executor. If the model cannot be
        sent to another process.
    """

    def __init__(self, model: Model, workers: int = 1, executor: Executor | None = None) -> None:
        if not callable(model):
            raise TypeError(f"the model is {type(model).__name__}; it must be callable")
        if workers == 0 or workers < -1:
            raise ValueError(f"workers is {workers}; give at least 1, or -1 for one per core")
        if executor is not None and workers != 1:
            raise ValueError(f"workers is {workers}, but the executor has its own; omit workers")
        if executor is not None and not callable(getattr(executor, "submit", None)):
            raise TypeError(
                f"executor is {type(executor).__name__}; give one as concurrent.futures has, such "
                "as ProcessPoolExecutor() or dask's Client.get_executor()"
            )
        self._executor = executor
        self._workers = (os.cpu_count() or 1) if workers == -1 else workers
        self._model = model
        self._pickled = b"" if self._workers == 1 else _pickled(model)
        self._pool: ProcessPoolExecutor | None = None
        self._processes: list[Any] = []
        self._out: dict[Future[Outcome], dict[str, Any]] = {}  # runs in progress

    @property
    def is_parallel(self) -> bool:
        """Whether several calls may run at the same time."""
        return self._executor is not None or self._workers > 1

    def __enter__(self) -> ModelPool:
        if self._workers > 1:
            self._start(self._workers)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        for future in self._out:
            future.cancel()
        self._out.clear()
        if self._pool is None:
            return
        if kind is None:
            self._pool.shutdown()
        else:
            self._stop()
        self._pool = None

    def begin(self, calls: Iterable[dict[str, Any]]) -> None:
        """Start calls that will be requested, if processes are free.

        Raises
        ------
        RuntimeError
            If the given executor has broken down.
        """
        if self._executor is not None or self._pool is not None:
            for values in calls:
                self._submit(values)

    def run(self, calls: Sequence[dict[str, Any]]) -> Iterator[tuple[dict[str, Any], Outcome]]:
        """Call the model for every dict; yield dict and outcome as they finish.

        Calls that have begun are not repeated. Begun calls that finish meanwhile are also yielded,
        whether or not they are among these dicts.

        Raises
        ------
        RuntimeError
            If the given executor has broken down.
        ValueError
            If the model cannot be sent to the workers of that executor.
        """
        if self._executor is None and self._pool is None:
            for values in calls:
                yield values, _called(self._model, values)
            return
        begun = list(self._out.items())
        asked, lost = set(), []
        for values in calls:
            future = next((future for future, of in begun if of == values), None)
            if future := future or self._submit(values):
                asked.add(future)
            else:
                lost.append(values)
        while not self._out.keys().isdisjoint(asked):
            for future in wait(self._out, return_when=FIRST_COMPLETED).done:
                values = self._out.pop(future)
                if outcome := self._outcome(future):
                    yield values, outcome
                elif future in asked:
                    lost.append(values)
        if lost:
            yield from self._run_one_by_one(lost)

    def finished(self) -> Iterator[tuple[dict[str, Any], Outcome]]:
        """Yield the begun calls that have finished meanwhile."""
        for future in [future for future in self._out if future.done()]:
            if not future.cancelled() and future.exception() is None:
                yield self._out.pop(future), future.result()

    def _outcome(self, future: Future[Outcome]) -> Outcome | None:
        """Return the outcome, or None if a process of this pool died."""
        if self._executor is not None:
            return _result_of_executor(future)
        try:
            return future.result()
        except BrokenProcessPool:
            return None

    def _submit(self, values: dict[str, Any]) -> Future[Outcome] | None:
        """Start a call; return None if the processes have broken down."""
        future: Future[Outcome]
        if self._executor is not None:
            try:
                future = self._executor.submit(_called, self._model, values)
            except BrokenExecutor as error:
                raise _broken(error) from error
        else:
            assert self._pool is not None
            try:
                future = self._pool.submit(_call_in_worker, values)
            except BrokenProcessPool:
                return None
        self._out[future] = values
        return future

    def _run_one_by_one(
        self, calls: Sequence[dict[str, Any]]
    ) -> Iterator[tuple[dict[str, Any], Outcome]]:
        for values in calls:
            self._restart(1)
            started = time.perf_counter()
            assert self._pool is not None
            outcome = self._outcome(self._pool.submit(_call_in_worker, values))
            seconds = time.perf_counter() - started
            yield values, outcome or Outcome(None, "the worker process died", seconds)
        self._restart(self._workers)

    def _start(self, workers: int) -> None:
        before = set(multiprocessing.active_children())
        self._pool = ProcessPoolExecutor(
            workers, initializer=_prepare_worker, initargs=(self._pickled,)
        )
        # All of them now: later, with other threads about, forking would be unsafe.
        for future in [self._pool.submit(time.sleep, 0.01) for _ in range(workers)]:
            future.result()
        self._processes = [p for p in multiprocessing.active_children() if p not in before]

    def _restart(self, workers: int) -> None:
        if self._pool is not None:
            self._pool.shutdown()
        self._start(workers)

    def _stop(self) -> None:
        """End all processes; the model can stop the processes that it started."""
        assert self._pool is not None
        for process in self._processes:
            if process.is_alive() and os.name == "posix":
                os.kill(process.pid, _stop_signal())
        self._pool.shutdown(wait=False, cancel_futures=True)
        deadline = time.monotonic() + _PATIENCE
        for process in self._processes:
            process.join(max(0.0, deadline - time.monotonic()))
            if process.is_alive():
                process.terminate()


def _stop_signal() -> signal.Signals:
    """Return the signal that stops a worker: SIGINT, or SIGTERM if it is ignored."""
    is_ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    return signal.SIGTERM if is_ignored else signal.SIGINT


def _pickled(model: Model) -> bytes:
    try:
        return pickle.dumps(model)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise ValueError(
            f"the model cannot be sent to other processes ({error}); define it at the top level "
            "of a module, not as a lambda or inside a function, or use workers=1"
        ) from error


def _called(model: Model, parameters: dict[str, Any]) -> Outcome:
    started = time.perf_counter()
    try:
        simulations, message = model(dict(parameters)), ""
    except Exception as error:  # whatever a model raises is a failed simulation
        simulations, message = None, _message(error)
    return Outcome(simulations, message, time.perf_counter() - started)


def _message(error: Exception) -> str:
    """Return what an exception says, in one line; a solver's needs no place in Python."""
    if isinstance(error, (SolverError, OutsideModelError)):
        text = f"{type(error).__name__}: {error}"
    else:
        text = named_with_place(error)
    return " ".join(text.split())[:_LONGEST_MESSAGE]


def _result_of_executor(future: Future[Outcome]) -> Outcome:
    """Return the outcome; what kills a worker of a cluster is a failed simulation."""
    try:
        return future.result()
    except BrokenExecutor as error:
        raise _broken(error) from error
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise ValueError(
            f"the model cannot be sent to the executor's processes ({error}); define it at the "
            "top level of a module"
        ) from error
    except Exception as error:  # dask's KilledWorker, say: the model's own are outcomes already
        return Outcome(None, _message(error), 0.0)


def _broken(error: BrokenExecutor) -> RuntimeError:
    return RuntimeError(
        f"the executor has broken down ({error}); start a new one and run this again: what a store "
        "holds is not lost"
    )


# The functions below run in the worker processes.

_worker: dict[str, Any] = {"model": None, "running": False, "interrupted": False}


def _prepare_worker(pickled: bytes) -> None:
    _worker["model"] = pickle.loads(pickled)
    signal.signal(_stop_signal(), _interrupt)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when the one that started it was killed; concurrent.futures does not."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    started_by = os.getppid()
    # A forked worker holds the pipe that would notify an older one: hence the second test.
    while parent.is_alive() and os.getppid() == started_by:
        parent.join(1.0)
    if os.name == "posix":
        os.kill(os.getpid(), _stop_signal())  # the model may have a solver to end
        time.sleep(_PATIENCE)
    os._exit(1)


def _interrupt(number: int, frame: object) -> None:
    _worker["interrupted"] = True
    if _worker["running"]:
        raise KeyboardInterrupt
    if number != signal.SIGINT:  # SIGTERM, with which the executor also ends its processes
        os._exit(1)


def _call_in_worker(parameters: dict[str, Any]) -> Outcome:
    # The executor hands out a call or two in advance, which can no longer be cancelled: a solver
    # started for one of them would outlive this process.
    if _worker["interrupted"]:
        raise KeyboardInterrupt
    _worker["running"] = True
    try:
        return _called(_worker["model"], parameters)
    finally:
        _worker["running"] = False
