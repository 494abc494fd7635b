"""The paper's stored results: when they are stale, and whether a difference is seen."""

from __future__ import annotations

import importlib
import logging
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import curvewise

pytest.importorskip("curvewise.calibration")

SCRIPTS = Path(__file__).resolve().parents[3] / "benchmarks" / "reproduction"
PACKAGE = Path(curvewise.__file__).resolve().parent


@pytest.fixture(scope="module", autouse=True)
def _scripts() -> Iterator[None]:
    if not SCRIPTS.is_dir():
        pytest.skip("not a source tree: no benchmarks/reproduction")
    sys.path.insert(0, str(SCRIPTS))
    yield
    sys.path.remove(str(SCRIPTS))


@pytest.fixture(scope="module")
def problems(data_dir: Path, _scripts: None) -> ModuleType:
    module = importlib.import_module("problems")
    if module.data_dir().parent != data_dir:
        pytest.skip(f"the scripts read {module.data_dir().parent}, the tests {data_dir}")
    return module


@pytest.fixture(scope="module")
def stores(problems: ModuleType) -> Iterator[ModuleType]:
    module = importlib.import_module("stores")
    log = logging.getLogger("curvewise.calibration")
    level = log.level
    module.quiet()
    yield module
    log.setLevel(level)  # other tests of this process read it


def cycle_task(problems: ModuleType, method: str = "de", **changes: Any) -> Any:
    studies, cycle = (importlib.import_module(name) for name in ("studies", "cycle"))
    options = {"de": studies.evolution(3, 4), "nelder-mead": {"restarts": 0, "maxfev": 20}}
    test = problems.load_unload_data(noise=True)
    return cycle.SQUARES.task("one", test, {method: options[method]}, **changes)


def hardening_task(problems: ModuleType, measure: str, *, folds: bool) -> Any:
    studies, hardening = (importlib.import_module(name) for name in ("studies", "hardening"))
    loops, bounds = problems.test_loops(), problems.hardening_bounds()
    effort = {"sdrm": {"maxiter": 1}}
    return studies.Task(
        "one", hardening.model(), loops, bounds, measure, effort, folds=folds, material=True
    )


def test_what_is_stored_is_not_searched_for_again(
    problems: ModuleType, stores: ModuleType, tmp_path: Path
) -> None:
    task = cycle_task(problems, traced=True)
    store = tmp_path / "optima" / "store.json.xz"
    found = stores.identify_all([task], store)["one"]
    assert [stage.method for stage in found.stages] == ["de"]
    assert len(found.stages[0].trace) == 5
    assert found.stages[0].value == pytest.approx(found.stages[0].trace[-1], rel=1e-5)
    written = store.read_bytes()
    assert stores.identify_all([task], store)["one"] == found
    assert store.read_bytes() == written
    assert stores.identify_all([cycle_task(problems, seed=1)], store)["one"] != found


def test_a_result_of_other_code_is_said_and_made_again(
    problems: ModuleType,
    stores: ModuleType,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    task, store = cycle_task(problems), tmp_path / "store.json.xz"
    stores.identify_all([task], store)
    assert capsys.readouterr().out == ""
    kernels = tmp_path / "kernels.cpp"
    kernels.write_text("int one = 1;")
    digests = importlib.import_module("digests")
    monkeypatch.setattr(digests, "KERNELS", (*digests.KERNELS, kernels))
    assert stores.stale_parts(task, stores.read(store)["one"]) == ["kernels"]
    stores.identify_all([task], store)
    assert capsys.readouterr().out == "store: 1 of 1 stored results are stale (kernels 1)\n"
    assert stores.stale_parts(task, stores.read(store)["one"]) == []


def test_prose_makes_nothing_stale(problems: ModuleType, tmp_path: Path) -> None:
    code_of = importlib.import_module("digests").code_of
    versions = {
        "a.py": 'x = "# kept"\n\n\ndef f(y):\n    return x\n',
        "b.py": '"""What."""\nx = "# kept"  # why\n\ndef f(y):\n    """How."""\n    return x\n',
        "c.py": 'x = "# kept"\n\n\ndef f(y):\n    return y\n',
        "a.cpp": 'int a = f("// kept", \'"\');',
        "b.cpp": '// What.\nint a = /* why */\n    f("// kept", \'"\');  // "how"\n',
        "c.cpp": "int a = f(\"// kept\", '/');",
    }
    for name, text in versions.items():
        (tmp_path / name).write_text(text)
    for kind in ("py", "cpp"):
        first, prose, other = (code_of(tmp_path / f"{name}.{kind}") for name in "abc")
        assert first == prose != other


@pytest.mark.parametrize("kind", ["de", "nelder-mead", "frechet", "dtw", "folds"])
def test_code_that_runs_is_counted(problems: ModuleType, kind: str) -> None:
    """If a task calls a function of a module, the module is in a list of digests.py."""
    digests, studies = (importlib.import_module(name) for name in ("digests", "studies"))
    if kind in ("de", "nelder-mead"):
        task = cycle_task(problems, kind)
    else:
        task = hardening_task(problems, "area" if kind == "folds" else kind, folds=kind == "folds")
    called: set[str] = set()

    def profile(frame: Any, event: str, argument: Any) -> None:
        called.add(frame.f_code.co_filename)

    threading.setprofile(profile)
    sys.setprofile(profile)
    try:
        studies.found(task)
    finally:
        sys.setprofile(None)
        threading.setprofile(None)  # type: ignore[arg-type]
    files = {Path(name) for name in called if name.startswith(str(PACKAGE))}
    methods = [file for method in task.effort for file in digests.METHODS[method]]
    counted = {*digests.SEARCH, *methods, *digests.FOLDS, *digests.OBJECTIVE, *digests.MATERIAL}
    names = [file.relative_to(PACKAGE).as_posix() for file in files - counted]
    assert len(files & counted) > 10
    assert [name for name in names if not name.startswith(digests.NOT_COUNTED)] == []


def test_a_difference_is_seen(
    problems: ModuleType, stores: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its bits where libraries and processor are the same, by its value elsewhere."""
    check = importlib.import_module("check")
    task = cycle_task(problems)
    stored = stores.make(task)
    assert check.difference_from(task, stored) == ""
    value = stored["stages"][0]["value"]
    stored["stages"][0]["value"] = value * (1 + 1e-15)
    assert check.difference_from(task, stored).startswith(f"de differs in value: value {value!r}")
    elsewhere = {**stored, "made_with": "another processor"}
    assert check.difference_from(task, elsewhere) == ""
    elsewhere["stages"][0]["value"] = value * 1.02
    assert check.difference_from(task, elsewhere).startswith("de differs in value")


@pytest.mark.parametrize(
    ("differing", "made_elsewhere", "fails"),
    [(0, 0, False), (1, 0, True), (1, 3, False), (2, 3, True)],
)
def test_every_bit_counts_here_and_two_in_three_values_elsewhere(
    stores: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    differing: int,
    made_elsewhere: int,
    fails: bool,
) -> None:
    check = importlib.import_module("check")
    differences = ["value 2, stored 1"] * differing + [""] * 3
    elsewhere = [True] * made_elsewhere + [False] * 3
    monkeypatch.setattr(check, "begin_again_held", lambda: None)
    monkeypatch.setattr(check, "difference_from", lambda *_: differences.pop(0))
    monkeypatch.setattr(check, "was_made_here", lambda _: not elsewhere.pop(0))
    monkeypatch.setattr(sys, "argv", ["check.py", "--seed", "1"])
    with pytest.raises(SystemExit, match="not what is stored") if fails else nullcontext():
        check.main()


@pytest.mark.usefixtures("_scripts")
def test_a_process_begins_again_with_the_arithmetic_of_avx2(tmp_path: Path) -> None:
    arithmetic = importlib.import_module("arithmetic")
    script = tmp_path / "script.py"
    script.write_text(
        f"import sys; sys.path.insert(0, {str(SCRIPTS)!r})\n"
        "from arithmetic import begin_again_held, is_held\n"
        "print('began', flush=True)\n"
        "begin_again_held()\n"
        "print(is_held(), sys.argv[1:])\n"
    )
    environment = {k: v for k, v in os.environ.items() if k not in arithmetic._HELD}
    command = [sys.executable, str(script), "an option"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    has_avx2 = arithmetic._has_avx2()
    expected = ["began"] * (2 if has_avx2 else 1) + [f"{has_avx2} ['an option']"]
    assert done.stdout.splitlines() == expected


def test_every_stored_result_is_of_a_task(stores: ModuleType) -> None:
    check = importlib.import_module("check")
    tasks = check.all_tasks()
    for store, known in tasks.items():
        stored = stores.read(SCRIPTS / "optima" / f"{store}.json.xz")
        assert stored
        assert set(stored) <= set(known)
    stored = {store: stores.read(SCRIPTS / "optima" / f"{store}.json.xz") for store in tasks}
    drawn = check.draw(tasks, stored, 4, seed=0)
    assert [check.begins_with_sdrm(tasks, *one) for one in drawn] == [True, False, True, False]


def test_the_page_of_verdicts_is_that_of_the_tables() -> None:
    """Written again from claims.toml and results.md, it equals the stored page."""
    verdicts = importlib.import_module("verdicts")
    results = (SCRIPTS / "results.md").read_text(encoding="utf-8")
    page = verdicts.page(SCRIPTS / "claims.toml", results)
    assert page == (SCRIPTS / "verdicts.md").read_text(encoding="utf-8")


def test_cells_of_tables_are_found_by_rows_and_columns() -> None:
    verdicts = importlib.import_module("verdicts")
    rows = [
        "| a | b | c |",
        "| --- | ---: | ---: |",
        "| x | one | **2.5 %** |",
        "| *x* | two | 3 |",
    ]
    text = "\n".join(["<!-- t: begin -->", *rows, "<!-- t: end -->"])
    tables = verdicts.tables_of(text)
    assert verdicts.cell("t > x > one > c", tables) == "2.5 %"
    assert verdicts.cell("max t > * > c", tables) == "3"
    assert verdicts.cell("min t > x > * > c", tables) == "2.5 %"
    with pytest.raises(ValueError, match="2 rows of t are meant, not one"):
        verdicts.cell("t > x > c", tables)
    with pytest.raises(ValueError, match="no table t with a column d"):
        verdicts.cell("t > x > d", tables)


def test_an_unknown_verdict_is_refused(tmp_path: Path) -> None:
    verdicts = importlib.import_module("verdicts")
    claims = tmp_path / "claims.toml"
    claims.write_text("""
        [[section]]
        title = "1"
        [[section.claim]]
        says = "so"
        verdict = "perhaps"
        found = "nothing"
        by = "nobody"
        """)
    with pytest.raises(ValueError, match="1: unknown verdicts perhaps"):
        verdicts.page(claims, "")
