"""What SECURITY.md says of the source: no network, no pickle from strangers, no shell."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import curvewise

PACKAGE = Path(curvewise.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
LIBRARY = sorted((Path(__file__).resolve().parents[3] / "cpp" / "src").rglob("*.?pp"))

NETWORK = {
    "asyncio", "ftplib", "http", "imaplib", "multiprocessing.connection", "poplib", "requests",
    "smtplib", "socket", "socketserver", "ssl", "telnetlib", "urllib", "webbrowser", "xmlrpc",
}  # fmt: skip
# Besides these, all modules that read objects from bytes and execute them.
UNPICKLERS = {"dill", "joblib", "marshal", "shelve"}
# The modules that use pickle. They read only bytes that the same call has made, for the processes
# that it starts.
PICKLERS = {"calibration/models/pool.py"}
EXECUTORS = {"eval", "exec", "os.system", "os.popen", "subprocess.getoutput"}


def imported(tree: ast.AST) -> Iterator[str]:
    """Yield the modules that a module imports, at its top or inside functions."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield node.module


def called(tree: ast.AST) -> Iterator[ast.Call]:
    yield from (node for node in ast.walk(tree) if isinstance(node, ast.Call))


def source_of(module: Path) -> tuple[str, ast.Module]:
    return module.relative_to(PACKAGE).as_posix(), ast.parse(module.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def sources() -> dict[str, ast.Module]:
    return dict(map(source_of, MODULES))


def test_nothing_opens_a_connection(sources):
    assert len(sources) > 60
    for name, tree in sources.items():
        for module in imported(tree):
            assert module not in NETWORK, name
            assert module.split(".")[0] not in NETWORK, name


def test_nothing_is_unpickled_but_what_the_same_call_has_pickled(sources):
    for name, tree in sources.items():
        modules = {module.split(".")[0] for module in imported(tree)}
        assert not modules & UNPICKLERS, name
        assert "pickle" not in modules or name in PICKLERS, name
        for call in called(tree):
            text = ast.unparse(call.func)
            # numpy and pandas read pickles where they are asked to.
            assert not text.endswith("read_pickle"), name
            allowed = [word.value for word in call.keywords if word.arg == "allow_pickle"]
            assert all(isinstance(v, ast.Constant) and v.value is False for v in allowed), name


def test_no_data_reaches_a_shell_or_the_interpreter(sources):
    for name, tree in sources.items():
        for call in called(tree):
            assert ast.unparse(call.func) not in EXECUTORS, name
            for word in call.keywords:
                is_off = isinstance(word.value, ast.Constant) and word.value.value is False
                assert word.arg != "shell" or is_off, name


@pytest.mark.skipif(not LIBRARY, reason="an installed package without its C++ source")
def test_the_library_has_no_files_connections_or_programs():
    words = r"\b(socket|fopen|ifstream|ofstream|popen|fork|exec[lv]p?e?|std::system|dlopen)\b"
    for file in LIBRARY:
        code = re.sub(r"//[^\n]*|/\*.*?\*/", "", file.read_text(encoding="utf-8"), flags=re.DOTALL)
        assert not re.search(words, code), file
