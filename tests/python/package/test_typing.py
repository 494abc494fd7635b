"""The package's types, as a user's type checker sees them."""

from __future__ import annotations

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import curvewise

FOLDER = Path(__file__).resolve().parents[2] / "typing"
USER_FILE = FOLDER / "every_public_function.py"
COLLECTIONS = FOLDER / "collections_of_curves.py"


@pytest.mark.nightly
@pytest.mark.parametrize("user_file", [USER_FILE, COLLECTIONS], ids=lambda file: file.stem)
def test_mypy_strict_accepts_a_users_file(user_file: Path, tmp_path: Path) -> None:
    pytest.importorskip("mypy", reason='no mypy: pip install "curvewise[dev]"')
    checked = subprocess.run(
        [
            *(sys.executable, "-m", "mypy", "--strict", "--config-file="),
            *(f"--cache-dir={tmp_path}", "--disable-error-code=import-untyped"),  # pandas
            str(user_file),
        ],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "MYPYPATH": ""},
        check=False,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_the_collections_that_types_accept_are_accepted() -> None:
    pytest.importorskip("sklearn", reason='no scikit-learn: pip install "curvewise[sklearn]"')
    runpy.run_path(str(COLLECTIONS))


def test_the_user_file_calls_every_public_function() -> None:
    text = USER_FILE.read_text(encoding="utf-8")
    missing = [
        name for name in curvewise.__all__ if f"curvewise.{name}" not in text and name not in text
    ]
    assert not missing
