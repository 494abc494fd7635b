"""Programs that end, or fork, while other threads are inside a call.

Each program is a separate Python. Its exit status and output must be the expected ones, without a
hang, a crash, or another value. The moment is drawn at random.

    python tests/faults/endings.py [--times 20]
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys

# Threads that call without end, in all the ways in which a call lets the interpreter go on.
BEGINNING = """
import os, random, sys, threading, time, warnings
import numpy as np
import curvewise

warnings.simplefilter("ignore")  # of Python 3.12, that a process with threads forks
moment, size = float(sys.argv[1]), int(sys.argv[2])
P = np.random.default_rng(0).normal(size=(size, 2)).cumsum(axis=0)
few, index = P[:100], curvewise.Index([P[:60], P[20:90]] * 20)
expected = curvewise.dtw(few, few[::-1]), curvewise.area(few, few[::-1])
calls = [
    lambda: curvewise.dtw(P, P[::-1], prune=False),
    lambda: curvewise.frechet_path(P, P[::-1], workers=2),
    lambda: curvewise.area(P, P[::3]),
    lambda: curvewise.cdist([P, few] * 3, workers=2, progress=lambda done, total: None),
    lambda: curvewise.pcm(few, few[:50], offsets="continuous"),
    lambda: index.kneighbors(n_neighbors=3, workers=2),
]

def without_end(call):
    while True:
        call()

def begin(daemon):
    for call in calls:
        threading.Thread(target=without_end, args=[call], daemon=daemon).start()
    time.sleep(moment)

def check():
    if (curvewise.dtw(few, few[::-1]), curvewise.area(few, few[::-1])) != expected:
        os._exit(99)

class Slow:
    def __del__(self):  # Python waits for it while it ends, and lets other threads go on
        time.sleep(0.2)
"""

PROGRAMS = {
    "exit": "begin(True); sys.modules['slow'] = Slow(); sys.exit(7)",
    "the end of the script": "begin(True); sys.modules['slow'] = Slow(); check()",
    "an exception": "begin(True); sys.modules['slow'] = Slow(); raise SystemExit(3)",
    "os._exit": "begin(True); os._exit(5)",
    "a thread that goes on": """
thread = threading.Thread(target=lambda: [check() for _ in range(200)])
thread.start()
""",
    "fork": """
begin(True)
child = os.fork()
if child == 0:
    check()
    curvewise.cdist([P, few], workers=2)
    curvewise.Index([P, few]).kneighbors(n_neighbors=1, workers=2)
    os._exit(6)
check()
os._exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
""",
    "fork of a pool": """
from concurrent.futures import ProcessPoolExecutor
import multiprocessing
begin(True)
context = multiprocessing.get_context("fork")
with ProcessPoolExecutor(2, mp_context=context) as pool:
    values = list(pool.map(curvewise.dtw, [few] * 8, [few[::-1]] * 8))
sys.exit(4 if values == [expected[0]] * 8 else 98)
""",
}
STATUS = {"exit": 7, "an exception": 3, "os._exit": 5, "fork": 6, "fork of a pool": 4}


def ended(program: str, moment: float, size: int) -> tuple[int | None, str]:
    """Return the exit status (None for a hang), and the text on standard error."""
    command = [sys.executable, "-c", BEGINNING + PROGRAMS[program], str(moment), str(size)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    except subprocess.TimeoutExpired:
        return None, "no end after ten minutes"
    return run.returncode, run.stderr


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--only", default="", help="programs whose name holds this text")
    arguments = parser.parse_args()
    rng = random.Random(arguments.times)
    failures = 0
    for program in PROGRAMS:
        if arguments.only not in program:
            continue
        right = 0
        for _ in range(arguments.times):
            moment, size = rng.uniform(0.0, 0.2), rng.choice([100, 1_000, 10_000])
            status, errors = ended(program, moment, size)
            if status == STATUS.get(program, 0) and not errors:
                right += 1
            else:
                print(f"WRONG: {program} after {moment:.3f} s, {size} points: {status}, {errors}")
        failures += arguments.times - right
        print(f"{program}: {right} of {arguments.times} ended as they should", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
