"""Runs a solver's process in its folder, and ends its process group.

The program runs in its own process group, without a shell; its output goes to a log. Ten times a
second, the process is checked for its end, its time limit, and excessive output. Cost: a few
milliseconds, and at most 50 ms until the end of the process is noticed.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

__all__ = ["SolverError", "end_of_log", "run_solver"]

# Bytes of output after which a program is stopped, and the size to which its log is then cut.
_MOST_OUTPUT = 2**26
_KEPT_OUTPUT = 2**20
_LOOK = 0.1  # seconds between two looks at the log

_GRACE = 2.0  # seconds between SIGTERM, on which solvers return their licence, and SIGKILL

# An error quotes a log's last lines. Before them it quotes the first lines that mention an error,
# each with the next line, because a solver may name the cause and continue.
_LAST_LINES = 6
_FIRST_ERRORS = 3
_QUOTED_WIDTH = 120  # characters of a line
_QUOTED_BYTES = 2**18  # of the log that are read


class SolverError(RuntimeError):
    """A run of the solver failed; the message names its log and quotes its end."""


def run_solver(
    command: Sequence[str],
    folder: Path,
    log: Path,
    *,
    timeout: float,
    environment: Mapping[str, str],
) -> None:
    """Run a program to its end.

    Parameters
    ----------
    command : sequence of str
        The path of the program, and its arguments.
    folder, log : Path
        The working directory, and the file for the program's output.
    timeout : float
        Seconds after which the program is stopped.
    environment : mapping of str to str
        Variables to set in addition to those of this process.

    Raises
    ------
    SolverError
        If the program does not start, takes too long, prints too much, or ends with an exit code
        other than 0.
    """
    program = Path(command[0]).name
    begin = time.monotonic()
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                command,
                cwd=folder,
                env={**os.environ, **environment},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError as error:
            raise SolverError(f"{program} did not start: {error}; folder: {folder}") from error
        try:
            code = _wait(process, begin + timeout, log)
        except subprocess.TimeoutExpired:
            raise SolverError(
                f"{program} took longer than {timeout:g} s and was stopped; log: {log}"
                f"{end_of_log(log)}"
            ) from None
        finally:
            _end_group(process)
    if code is None:
        os.truncate(log, _KEPT_OUTPUT)
        raise SolverError(
            f"{program} printed more than {_MOST_OUTPUT >> 20} MiB and was stopped; "
            f"the first of it: {log}"
        )
    if code != 0:
        how = f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"
        seconds = time.monotonic() - begin
        raise SolverError(f"{program} {how} after {seconds:.1f} s; log: {log}{end_of_log(log)}")


def end_of_log(log: Path) -> str:
    """Return the last lines of a log and its first errors, each on a line with a mark before it."""
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - _QUOTED_BYTES))
        text = file.read().decode("utf-8", "replace")
    lines = [line.rstrip()[:_QUOTED_WIDTH] for line in text.splitlines() if line.strip()]
    errors = [i for i, line in enumerate(lines) if "error" in line.lower()][:_FIRST_ERRORS]
    last = range(max(0, len(lines) - _LAST_LINES), len(lines))
    chosen = sorted({*errors, *(i + 1 for i in errors if i + 1 < len(lines)), *last})
    quoted = []
    for before, i in zip([None, *chosen], chosen, strict=False):
        if before is not None and i > before + 1:
            quoted.append("...")
        quoted.append(lines[i])
    return "".join(f"\n  | {line}" for line in quoted)


def _wait(process: subprocess.Popen[bytes], deadline: float, log: Path) -> int | None:
    """Return the exit code; None for a huge log. Raise TimeoutExpired if late."""
    while True:
        left = deadline - time.monotonic()
        try:
            return process.wait(min(max(left, 0.0), _LOOK))
        except subprocess.TimeoutExpired:
            if left <= _LOOK:
                raise
            if log.stat().st_size > _MOST_OUTPUT:
                return None


def _end_group(process: subprocess.Popen[bytes]) -> None:
    """End the program and whatever it has started, if that is still running."""
    try:
        if process.poll() is None:
            _signal_group(process, "SIGTERM")
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_GRACE)
    finally:  # also if Ctrl-C is pressed again
        _signal_group(process, "SIGKILL")
        process.wait()


def _signal_group(process: subprocess.Popen[bytes], name: str) -> None:
    if os.name == "posix":
        # The group outlives the program while it has members; macOS refuses where all are zombies.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.Signals[name])
    else:
        process.kill()
