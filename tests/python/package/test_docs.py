"""What the pages of the documentation show runs, and the reference has every public name."""

from __future__ import annotations

import importlib
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from types import ModuleType
from typing import Any, get_args

import pytest

import curvewise
from curvewise._core import is_symmetric
from curvewise._options import Spacing
from curvewise.commands import command_line as cli

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
HEADERS = ROOT / "cpp" / "include" / "curvewise"
# Everything that a header declares.
SECTIONS = "briefdescription detaileddescription innernamespace innerclass enum typedef func"
# Pages that the build writes and git ignores are not tested.
BUILT = {DOCS / "_build", DOCS / "gallery", DOCS / "api" / "generated"}
PAGES = [page for page in sorted(DOCS.rglob("*.md")) if BUILT.isdisjoint({page, *page.parents})]
# Pages show how to use these, and most machines lack some of them.
OPTIONAL = (
    *("aeon", "dask", "geopandas", "jax", "polars", "shapely", "sklearn", "sktime", "torch"),
    *("movingpandas", "xarray", "zarr"),
)
# Examples of the gallery that take seconds: they run where the site is built.
SLOW = {"plot_identification", "plot_million_points", "plot_ratcheting", "plot_two_tests"}
PYTHON = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# What the Python before it prints, where a page shows it.
PRINTED = re.compile(r"\n\n```text\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CONSOLE = re.compile(r"^```console\n\$ curvewise (.*?)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def name_of(page: Path) -> str:
    """Return a page's path from the root, as its test is called."""
    return page.relative_to(ROOT).as_posix()


def without_numbers(text: str) -> str:
    """Return a text with "#" for each number, whose last digits are those of a machine."""
    return re.sub(r" *\d[\d.]*(e[+-]?\d+)?", " #", text)


def linked(page: Path) -> list[Path]:
    """Return the files, and folders, that a page links to."""
    text = re.sub(
        r"^```.*?^```$|`[^`\n]+`", "", page.read_text(encoding="utf-8"), flags=re.M | re.S
    )
    links = re.findall(r"(?<=\]\()[^()\s#]+", text)
    return [Path(os.path.normpath(page.parent / link)) for link in links if "://" not in link]


def has_code(page: Path) -> bool:
    """Return whether there is something to run on a page."""
    return any(kind in page.read_text(encoding="utf-8") for kind in ("```python", "```console"))


@pytest.mark.parametrize(
    "page", [page for page in [ROOT / "README.md", *PAGES] if has_code(page)], ids=name_of
)
@pytest.mark.nightly(
    "several_tests|inverse_analysis|scale_out|cluster_loops|connect_a|report_results|a_study|identify_a_m"
)
def test_the_code_of_a_page_runs(
    page: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Run a page's blocks in their order; an error of the Python shows the page's line.

    Python runs in one namespace. The output of a command, and of Python code if output follows it,
    must be as on the page, except for the digits.
    """
    text = page.read_text(encoding="utf-8")
    blocks = sorted(
        [*PYTHON.finditer(text), *CONSOLE.finditer(text)], key=lambda block: block.start()
    )
    assert len(blocks) == text.count("```python") + text.count("```console"), "a block is not found"
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    missing = []
    for block in blocks:
        if block.re is PYTHON:
            before = "\n" * text.count("\n", 0, block.start(1))
            capsys.readouterr()
            try:
                exec(compile(before + block[1], str(page), "exec"), names)
            except ImportError as error:
                # The package's own errors name the command that installs a missing package.
                absent = getattr(error.__cause__ or error, "name", None) or ""
                if absent.partition(".")[0] not in OPTIONAL:
                    raise
                missing.append(absent)
                continue
            except NameError:
                # A block may use names of a block that was left out.
                if not missing:
                    raise
                continue
            if shown := PRINTED.match(text, block.end()):
                assert without_numbers(capsys.readouterr().out) == without_numbers(shown[1])
        else:
            capsys.readouterr()
            assert cli.main(shlex.split(block[1])) == 0
            assert capsys.readouterr().out == block[2]
    if missing:
        pytest.skip(f"all but the blocks with {', '.join(missing)}, which are not installed")


@pytest.mark.parametrize(
    "example",
    [file for file in sorted((ROOT / "examples").glob("*/plot_*.py")) if file.stem not in SLOW],
    ids=lambda file: file.stem,
)
def test_an_example_of_the_gallery_runs(example: Path) -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    if example.parent.name == "losses":
        pytest.importorskip("torch", reason='no torch: pip install "curvewise[torch]"')
    plt.switch_backend("Agg")
    exec(compile(example.read_text(encoding="utf-8"), example, "exec"), {"__name__": "__main__"})
    plt.close("all")


def test_nothing_is_installed_by_name_that_is_not_there() -> None:
    """No release is on PyPI: pip finds curvewise by name only where it is installed already."""
    commands = [
        (name_of(page), line)
        for page in [ROOT / "README.md", *PAGES]
        for line in page.read_text(encoding="utf-8").splitlines()
        if line.startswith("    ") and "pip install" in line
    ]
    assert len(commands) > 4
    assert [one for one in commands if re.search(r"install [^&#]*curvewise\b", one[1])] == []


def test_the_table_of_measures_says_what_is_symmetric() -> None:
    """Its last column, and the measures themselves with each of their options."""
    page = (DOCS / "reference/measures/index.md").read_text(encoding="utf-8")
    table = page.partition(" | symmetric |\n")[2].partition("\n:::")[0]
    says = dict(re.findall(r"^\| \[(\w+).* \| ([^|]+) \|$", table, flags=re.MULTILINE))
    assert set(says) == set(curvewise.available_measures())
    for measure, answer in says.items():
        assert is_symmetric(measure, {}) == answer.startswith("yes")
    unless = {choice for choice in get_args(Spacing) if f'"{choice}"' in says["area"]}
    assert unless == {
        choice for choice in get_args(Spacing) if not is_symmetric("area", {"spacing": choice})
    }


def test_the_readme_is_short_and_names_every_measure() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert readme.count("\n") <= 150
    table = readme.partition("\n## Measures\n")[2].partition("\n## ")[0]
    missing = [name for name in curvewise.available_measures() if f"`{name}`" not in table]
    assert missing == []


def test_the_readme_has_both_commands_of_the_set_up() -> None:
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    assert [line.strip() for line in lines if line.startswith("    pip install")] == [
        'pip install ".[all]" && curvewise demo',
        'pip install ".[test]" && pytest',
    ]


def test_the_exceptions_of_ctrl_c_stand_in_one_place() -> None:
    """Each page about the speed of Ctrl-C names the list of its exceptions."""
    for page in (ROOT / "README.md", DOCS / "how_to/compute_distance_matrices.md"):
        (said,) = re.findall(
            r"Ctrl-C ends.*?\.\s", page.read_text(encoding="utf-8"), flags=re.DOTALL
        )
        assert "guarantees.md#4-interruptible" in said, page
    said = (curvewise.cdist.__doc__ or "").partition("Ctrl-C ends")[2]
    assert "docs/explanation/guarantees.md" in said


def test_the_worked_example_shows_its_script() -> None:
    """Its code needs a solver and data, so it is compared line by line with the script that was
    run.
    """
    page = (DOCS / "tutorials" / "worked_example.md").read_text(encoding="utf-8")
    room = ROOT / "benchmarks" / "validation"
    files = (room / "worked_example.py", room / "results" / "worked_example.txt")
    texts = "".join(file.read_text(encoding="utf-8") for file in files)
    known = {line.strip() for line in texts.splitlines()}
    shown = [line.strip() for line in page.splitlines() if line.startswith("    ")]
    assert len(shown) > 20
    assert [line for line in shown if line not in known] == []


def entries(page: Path) -> set[str]:
    """Return what the lists (autosummary) of a page name, and all names of whole modules."""
    listed, module, inside = set(), "", False
    whole = re.findall(r"^\.\. automodule:: (\S+)\n   :members:$", page.read_text(), re.MULTILINE)
    for name in whole:
        listed |= {f"{name}.{one}" for one in importlib.import_module(name).__all__}
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.startswith(".. "):
            inside = line == ".. autosummary::"
            if line.startswith(".. currentmodule:: "):
                module = line.removeprefix(".. currentmodule:: ")
        elif inside and re.fullmatch(r"   [\w.]+", line):
            listed.add(f"{module}.{line.strip()}")
    return listed


def public_modules() -> set[str]:
    """Return curvewise, the modules among its names, and those that only their own page names."""
    names = {*curvewise.__all__, *curvewise._LAZY}
    modules = {name for name in names if isinstance(getattr(curvewise, name), ModuleType)}
    return {
        "curvewise",
        "curvewise.installation",
        "curvewise.reference.materials",
        "curvewise.reference.nearest",
        *(f"curvewise.{name}" for name in modules),
    }


def test_the_reference_has_every_public_name_of_python() -> None:
    for name in ("dask", "geopandas", "jax", "sklearn", "sktime", "torch"):
        pytest.importorskip(name, reason=f'no {name}: pip install "curvewise[{name}]"')
    listed = set().union(*(entries(page) for page in (DOCS / "api").glob("*.rst")))
    modules = public_modules()
    public = {
        f"{module}.{name}" for module in modules for name in importlib.import_module(module).__all__
    }
    assert sorted(public - listed - modules - {"curvewise.__version__"}) == []
    for name in listed - public:  # what belongs to a public name: the class of a result
        module, _, attribute = name.rpartition(".")
        assert hasattr(importlib.import_module(module), attribute), name


def declared(header: Path) -> tuple[Counter[str], set[str]]:
    """Return the functions of a header, overloads counted, and its types."""
    text = header.read_text(encoding="utf-8")
    text = re.sub(r"^namespace (?!curvewise)\w+ \{.*?^\}", "", text, flags=re.MULTILINE | re.DOTALL)
    # A long type stands in a line of its own, before the name of the function.
    text = re.sub(r"^\[\[nodiscard\]\] (\w+ [\w:]+)\n", r"\1 ", text, flags=re.MULTILINE)
    text = text.replace("[[nodiscard]] ", "")
    functions = re.findall(r"^[A-Za-z][^\n;=]*?[ *&](\w+)\(", text, flags=re.MULTILINE)
    kinds = r"^(?:struct|class|enum class) (?:CURVEWISE_EXPORT )?(\w+)[^;\n]*\{|^using (\w+) ="
    types = {a or b for a, b in re.findall(kinds, text, flags=re.MULTILINE)}
    return Counter(functions), types


def test_the_reference_has_every_function_and_type_of_cpp() -> None:
    pages = {page.stem: page.read_text(encoding="utf-8") for page in (DOCS / "api/cpp").iterdir()}
    headers = {header.stem: header for header in HEADERS.glob("*.hpp")}
    assert set(pages) == set(headers) - {"curvewise"}  # which includes the others
    overview = (DOCS / "api/cpp.rst").read_text(encoding="utf-8")
    seen = 0
    for name, page in pages.items():
        functions, types = declared(headers[name])
        seen += functions.total()
        assert [one for one in functions if f":`curvewise::{one}`" not in overview] == []
        if f".. doxygenfile:: {name}.hpp\n   :sections: {SECTIONS}\n" in page:  # the whole header
            continue
        found = re.findall(r"^\.\. doxygenfunction:: curvewise::(\w+)", page, flags=re.MULTILINE)
        assert Counter(found) == functions, name
        kinds = r"^\.\. doxygen(?:struct|class|enum|typedef):: curvewise::(\w+)"
        assert set(re.findall(kinds, page, flags=re.MULTILINE)) == types, name
    assert seen > 60


def test_the_reference_has_c_and_fortran() -> None:
    c, fortran = (
        (DOCS / f"api/{name}.rst").read_text(encoding="utf-8") for name in ("c", "fortran")
    )
    headers = {header.name for header in HEADERS.glob("*.h")} - {"export.h"}
    assert set(re.findall(r"^\.\. doxygenfile:: (\S+)$", c, flags=re.MULTILINE)) == headers
    assert ".. literalinclude:: ../../cpp/fortran/curvewise.f90" in fortran


def test_the_reference_has_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match=r"^0$"):
        cli.main(["--help"])
    commands = re.findall(r"^    (\w+)(?: {2,}|$)", capsys.readouterr().out, flags=re.MULTILINE)
    page = (DOCS / "api/command_line.rst").read_text(encoding="utf-8")
    sections = re.findall(r"^(\w+)\n-+$", page, flags=re.MULTILINE)
    assert sections == re.findall(r"^\.\. command-help:: (\w+)$", page, flags=re.MULTILINE)
    assert sections == commands
    assert len(sections) > 5


def test_every_link_to_a_file_leads_to_one() -> None:
    """The build refuses such a link too; here it is found without one."""
    files = [*ROOT.glob("*.md"), *(ROOT / "benchmarks").rglob("*.md"), *PAGES]
    broken = [
        f"{name_of(file)}: {target}"
        for file in files
        for target in linked(file)
        if DOCS / "gallery" not in target.parents and not target.exists()
    ]
    assert broken == []


def test_a_markdown_file_that_a_page_links_to_is_a_page_too() -> None:
    """Else the build does not know where the link leads."""
    mirrors = re.compile(r"^<!-- mirrors (\S+) -->$", re.MULTILINE)
    found = [mirrors.search(page.read_text(encoding="utf-8")) for page in PAGES]
    shown = {*PAGES, *(ROOT / mirror[1] for mirror in found if mirror)}
    assert len(shown) > len(PAGES) > 50
    unknown = [
        f"{name_of(file)}: {name_of(target)}"
        for file in sorted(shown)
        for target in linked(file)
        if target.suffix == ".md" and target not in shown and target.exists()
    ]
    assert unknown == []


def test_every_path_to_a_benchmark_leads_to_a_file() -> None:
    """In code, comments and text; only the changelog may name earlier contents."""
    if not (ROOT / "benchmarks").is_dir():
        pytest.skip("the source distribution has no benchmarks")
    kinds = {".py", ".md", ".rst", ".toml", ".yml", ".txt", ".cpp", ".hpp", ".cmake", ""}
    rooms = ("python", "cpp", "tests", "docs", "examples", "benchmarks", ".ci", ".github")
    files = {
        file
        for folder in [*(ROOT / room for room in (*rooms, "packaging")), ROOT]
        for file in (folder.glob("*") if folder == ROOT else folder.rglob("*"))
        if file.suffix in kinds and file.is_file() and BUILT.isdisjoint(file.parents)
    } - {ROOT / "CHANGELOG.md"}
    named = [
        (name_of(file), path.rstrip("."))
        for file in sorted(files)
        for path in re.findall(
            r"(?<![\w/.-])benchmarks/[\w./-]+", file.read_text(encoding="utf-8", errors="replace")
        )
    ]
    assert len(named) > 30
    assert [(file, path) for file, path in named if not (ROOT / path).exists()] == []


def test_every_page_has_a_place_in_the_navigation() -> None:
    """A page that no toctree names is an error of the build; here it is found without one."""
    pages = {*PAGES, *(page for page in DOCS.rglob("*.rst") if BUILT.isdisjoint(page.parents))}
    pages -= {page for page in pages if page.parent.name in ("autosummary", "_templates")}
    named = {DOCS / "index.md"}
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for block in re.findall(
            r"^```\{toctree\}\n(.*?)^```|^\.\. toctree::\n(.*?)(?=^\S|\Z)",
            text,
            flags=re.MULTILINE | re.DOTALL,
        ):
            for line in "".join(block).splitlines():
                entry = re.sub(r".*<(.*)>", r"\1", line.strip())
                if entry and not entry.startswith(":"):
                    found = (page.parent.glob(f"{entry}.{ending}") for ending in ("md", "rst"))
                    named |= {target.resolve() for targets in found for target in targets}
    assert sorted(name_of(page) for page in pages - named) == []


@pytest.mark.skipif(
    not (ROOT / ".git").exists() or shutil.which("git") is None,
    reason="git lists the files of a checkout",
)
def test_the_prose_is_within_its_bounds() -> None:
    """.ci/prose.py holds bounds on the sentences of pages, docstrings and comments."""
    counted = subprocess.run(
        [sys.executable, str(ROOT / ".ci" / "prose.py")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert counted.returncode == 0, counted.stderr
    rows = re.findall(r"^([\w ]+?) +(\d+) sentences", counted.stdout, flags=re.MULTILINE)
    assert min(int(count) for _, count in rows) > 100, "a group has lost its texts"
