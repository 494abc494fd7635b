"""Two curves in files, and the command line run in this process."""

from __future__ import annotations

import numpy as np
import pytest

import curvewise
from curvewise.commands import main


@pytest.fixture
def files(tmp_path, monkeypatch):
    """Two curves in the plane, in a folder that is the working directory."""
    monkeypatch.chdir(tmp_path)
    experiment, simulation = (curve[:40] for curve in curvewise.datasets.hysteresis_pair())
    np.savetxt("A.csv", experiment, delimiter=",", header="strain,stress", comments="")
    np.savetxt("B.csv", simulation[:30], delimiter=";")
    return ["A.csv", "B.csv"]


@pytest.fixture
def run(capsys):
    """Run the command line in this process; return its status, output and error output."""

    def call(*arguments):
        try:
            status = main(arguments)
        except SystemExit as stopped:
            status = stopped.code
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return call


@pytest.fixture
def output(run):
    """Run a command that succeeds and says nothing besides; return its output."""

    def call(*arguments):
        status, out, error = run(*arguments)
        assert (status, error) == (0, "")
        return out

    return call
