"""Searches on a SLURM cluster: a job that is killed, a node that is drained, a full queue.

Where sbatch works; .ci/slurm makes a cluster of one node of any machine with Debian's packages.

    python tests/faults/cluster.py [--runs 50]

The same search five times: here; by `sbatch --wait` as docs/how_to/connect_a_solver.md has it,
while one running
job is killed and queued anew (what SLURM does where a node fails) and the node drained for a time;
by submitit, a job for every run; by dask-jobqueue, whose jobs are workers that go on from run to
run, while one of them is killed and queued anew; and by sbatch while jobs are cancelled, which are
failed runs. Ends with 1 unless the first four have the same bits, and the fifth has gone on.
Minutes: a job takes some 2 s, however short it is.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from curvewise.calibration import CommandModel, Identification, TrustRegion, identify

JOB = """#!/bin/sh
#SBATCH --job-name=curve --ntasks=1 --time=5 --requeue
sleep 0.5
awk 'BEGIN {
    print "strain,stress"
    for (i = 0; i <= 60; i++) {
        e = 0.0005 * i
        trial = <<E>> * e
        s = trial < <<yield>> ? trial : <<yield>> + <<H>> * (e - <<yield>> / <<E>>)
        printf "%.17g,%.17g\\n", e, s
    }
}' >curve.csv
"""
BOUNDS = {"E": (100e3, 300e3), "yield": (100.0, 600.0), "H": (500.0, 9000.0)}
QUEUED = ["sbatch", "--wait", "--output=command.log", "job.sh"]


def measured() -> np.ndarray:
    """Return what E = 200,000, yield = 310 and H = 3,000 give, with noise."""
    strain = 0.0005 * np.arange(61)
    stress = np.minimum(200e3 * strain, 310.0 + 3e3 * (strain - 310.0 / 200e3))
    noise = np.random.default_rng(1).normal(0.0, 3.0, strain.size)
    return np.column_stack((strain, stress + noise))


def read(folder: Path) -> np.ndarray:
    """Read the curve that a job has written."""
    return np.loadtxt(folder / "curve.csv", delimiter=",", skiprows=1)


def model_of(command: list[str], template: Path, scratch: Path) -> CommandModel:
    """Return the model that runs the job by a command."""
    return CommandModel(
        template,
        command,
        read,
        parameters=list(BOUNDS),
        timeout=600,
        scratch=scratch,
    )


def found_by(model, runs: int, **how) -> Identification:
    """Search with that number of runs."""
    return identify(
        model, measured(), BOUNDS, method=TrustRegion(), max_runs=runs, progress=False, **how
    )


def slurm(*command: str) -> list[str]:
    """Run a command of SLURM; return its lines."""
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return done.stdout.split("\n")[:-1]


def running() -> list[str]:
    """Return the numbers of the jobs that run."""
    return slurm("squeue", "--noheader", "--format=%i", "--states=RUNNING", "--name=curve")


def say(text: str) -> None:
    """Print a line with the time."""
    print(f"{time.strftime('%H:%M:%S')}  {text}", flush=True)


def kill_one() -> None:
    """Have one job killed and requeued."""
    while not (jobs := running()):
        time.sleep(0.2)
    slurm("scontrol", "requeue", jobs[0])
    say(f"job {jobs[0]} killed, and queued anew")


def kill_one_and_drain() -> None:
    """Have one job killed and requeued, then no job begin for 15 seconds."""
    kill_one()
    (node,) = slurm("sinfo", "--noheader", "--format=%n")
    time.sleep(10.0)
    slurm("scontrol", "update", f"nodename={node}", "state=drain", "reason=test")
    say(f"node {node} drained: {slurm('sinfo', '--noheader', '--format=%T')[0]}")
    time.sleep(15.0)
    waiting = slurm("squeue", "--noheader", "--format=%i %T %r", "--name=curve")
    say(f"queue meanwhile: {'; '.join(waiting) or 'empty'}")
    slurm("scontrol", "update", f"nodename={node}", "state=resume")
    say(f"node {node} back")


def cancel_two() -> None:
    """Cancel two jobs, one after the other."""
    for _ in range(2):
        time.sleep(3.0)
        while not (jobs := running()):
            time.sleep(0.2)
        slurm("scancel", jobs[0])
        say(f"job {jobs[0]} cancelled")


@contextmanager
def meanwhile(trouble: Callable[[], None]) -> Iterator[None]:
    """Make trouble in a thread while the block runs, which has to take notice of it.

    Raises
    ------
    RuntimeError
        The block has ended before the trouble: it has shown nothing.
    """
    over = threading.Event()

    def make() -> None:
        trouble()
        over.set()

    threading.Thread(target=make, daemon=True).start()
    yield
    if not over.is_set():
        raise RuntimeError(f"the search ended before {trouble.__name__} did: it shows nothing")


def by_submitit(model: CommandModel, runs: int, folder: Path) -> Identification:
    """Search with a job of submitit for every run; a thread waits for each."""
    import submitit

    jobs = submitit.SlurmExecutor(folder=folder)
    jobs.update_parameters(time=5, cpus_per_task=1, job_name="curve")

    def queued(parameters):
        return jobs.submit(model, parameters).result()

    with ThreadPoolExecutor(2) as threads:
        return found_by(queued, runs, executor=threads)


def by_dask(model: CommandModel, runs: int, folder: Path) -> Identification:
    """Search on two workers of dask that dask-jobqueue queues as jobs; one of them is killed."""
    from dask.distributed import Client
    from dask_jobqueue import SLURMCluster

    with (
        SLURMCluster(
            cores=1,
            memory="500MB",
            walltime="00:05:00",
            job_name="curve",
            job_extra_directives=["--requeue"],
            job_directives_skip=["--mem"],  # an option that the cluster of one node does not know
            log_directory=folder,
        ) as cluster,
        Client(cluster) as client,
    ):
        cluster.scale(jobs=2)
        client.wait_for_workers(2)
        with meanwhile(kill_one):
            return found_by(model, runs, executor=client.get_executor())


def bits(found: Identification) -> list[str]:
    """Return the value and the parameters, every bit of them."""
    return [value.hex() for value in (found.value, *found.parameters.values())]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=50)
    runs = parser.parse_args().runs
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        template = folder / "job.sh"
        template.write_text(JOB)
        local = model_of(["sh", "job.sh"], template, folder)
        here = found_by(local, runs, workers=2)
        say(f"here      {here.evaluations} runs, value {here.value:.6g}, {here.message}")
        with meanwhile(kill_one_and_drain):
            queued = found_by(model_of(QUEUED, template, folder), runs, workers=2)
        say(f"sbatch    {queued.evaluations} runs, {len(queued.failures)} failed")
        handed = by_submitit(local, runs, folder / "jobs")
        say(f"submitit  {handed.evaluations} runs, {len(handed.failures)} failed")
        on_dask = by_dask(local, runs, folder / "dask")
        say(f"dask      {on_dask.evaluations} runs, {len(on_dask.failures)} failed")
        with meanwhile(cancel_two):
            cancelled = found_by(model_of(QUEUED, template, folder), 20, workers=2)
        say(f"cancelled {cancelled.evaluations} runs, failed: {cancelled.failures}")
    same = bits(here) == bits(queued) == bits(handed) == bits(on_dask)
    say(f"same bits: {same}")
    return 0 if same and len(cancelled.failures) == 2 and cancelled.evaluations == 20 else 1


if __name__ == "__main__":
    sys.exit(main())
