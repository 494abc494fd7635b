"""The package's types, as a user's type checker sees them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import curvewise

USER_FILE = Path(__file__).resolve().parents[2] / "typing" / "every_public_function.py"


@pytest.mark.nightly
def test_mypy_strict_accepts_every_public_function(tmp_path: Path) -> None:
    pytest.importorskip("mypy", reason='no mypy: pip install "curvewise[dev]"')
    checked = subprocess.run(
        [
            *(sys.executable, "-m", "mypy", "--strict", "--config-file="),
            f"--cache-dir={tmp_path}",
            str(USER_FILE),
        ],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "MYPYPATH": ""},
        check=False,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_the_user_file_calls_every_public_function() -> None:
    text = USER_FILE.read_text(encoding="utf-8")
    missing = [
        name for name in curvewise.__all__ if f"curvewise.{name}" not in text and name not in text
    ]
    assert not missing
