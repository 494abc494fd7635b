"""Everything of this folder from nothing: searches, tables, pictures, verdicts.

The stored optima and the pictures are removed first, then every script runs, in the order in which
one needs what another has stored. `--resume` keeps what is stored and current, so that a run that
was interrupted goes on. `git diff` then shows whether anything has changed. A script that fails,
since an optimum is not what it must be, does not keep the others from running.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time

from arithmetic import environment
from report import HERE

SCRIPTS = (
    "illustrations",
    "straight_line",
    "norms",
    "quadrilaterals",
    "hardening_rules",
    "kinematic_hardening",
    "hardening_figures",
    "lines_between_optima",
    "gradient_descents",
    "cross_validation",
    "known_parameters",
    "load_unload",
    "partial",
    "table6",
    "verdicts",
)
WITHOUT_SEARCHES = (
    "illustrations",
    "straight_line",
    "norms",
    "quadrilaterals",
    "hardening_rules",
    "verdicts",
)


def main() -> None:
    """Remove, run, say how long it took."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--workers", type=int, default=1, help="searches at a time, default 1")
    parser.add_argument("--resume", action="store_true", help="keep what is stored and current")
    options = parser.parse_args()
    if not options.resume:
        for file in [*HERE.glob("optima/*.json.xz"), *HERE.glob("*.webp")]:
            file.unlink()
    began = time.perf_counter()
    held = environment()
    failed: list[str] = []
    for script in SCRIPTS:
        workers = [] if script in WITHOUT_SEARCHES else [f"--workers={options.workers}"]
        done = subprocess.run([sys.executable, str(HERE / f"{script}.py"), *workers], env=held)
        failed += [script] if done.returncode else []
        outcome = "failed" if done.returncode else "done"
        seconds = time.perf_counter() - began
        print(f"{script}: {outcome} [{seconds:.0f} s since the start]", flush=True)
    if failed:
        raise SystemExit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()
