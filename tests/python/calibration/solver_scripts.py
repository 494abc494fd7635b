"""Common code of the tests of solvers: Python scripts that replace a solver, and a test for running
processes.

Processes hold a named pipe open. Its reader sees the end of the file when the last of them has
ended. So the tests need no process ids, which are reused.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from curvewise.calibration import CommandModel

SOLVER = "open('curve.txt', 'w').write('0 0\\n1 <<E>>\\n')\n"

posix = pytest.mark.skipif(os.name != "posix", reason="process groups are POSIX's")


def read_curve(folder: Path) -> Any:
    return np.loadtxt(folder / "curve.txt")


def python_model(folder: Path, script: str, **options: Any) -> CommandModel:
    """Return a model whose solver is a Python script with the placeholder <<E>>."""
    template = folder / "solver.py"
    template.write_text(script)
    scratch = folder / "scratch"
    scratch.mkdir(exist_ok=True)
    settings = {"read": read_curve, "parameters": ["E"], "timeout": 60.0, "scratch": scratch}
    settings.update(options)
    return CommandModel(template, [sys.executable, "solver.py"], **settings)


class Pipe:
    """A named pipe, and what the solver's processes do with it."""

    HOLD = "pipe = open({path!r}, 'wb', buffering=0); pipe.write(b'.')"

    def __init__(self, folder: Path) -> None:
        self.path = folder / "pipe"
        os.mkfifo(self.path)
        self._reader = os.open(self.path, os.O_RDONLY | os.O_NONBLOCK)
        self._started = 0

    @property
    def hold(self) -> str:
        return self.HOLD.format(path=str(self.path))

    def started(self) -> int:
        """Return how many processes have opened the pipe so far."""
        self._listen()
        return self._started

    def all_gone(self, processes: int) -> bool:
        """Return whether that number of processes has opened the pipe and all have ended."""
        wait_until(self._listen)
        os.close(self._reader)
        return self._started == processes

    def _listen(self) -> bool:
        """Count the processes that opened the pipe; return whether all have closed it."""
        try:
            data = os.read(self._reader, 100)
        except BlockingIOError:
            return False
        self._started += len(data)
        return not data


def wait_until(condition: Any, seconds: float = 20.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.01)


def parent_and_child(pipe: Pipe) -> str:
    """Return a solver that starts another one, which ignores SIGTERM, and never ends."""
    child = f"import signal, time; signal.signal(15, signal.SIG_IGN); {pipe.hold}; time.sleep(600)"
    return (
        f"import subprocess, sys, time\n{pipe.hold}\n# <<E>>\n"
        f"subprocess.Popen([sys.executable, '-c', {child!r}])\n"
        "print('iteration 1', flush=True)\ntime.sleep(600)\n"
    )
