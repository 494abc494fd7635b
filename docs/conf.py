"""How Sphinx makes the site: pages in Markdown, the API from docstrings and headers, a gallery.

`sphinx-build -W docs build/site` with what `pip install ".[docs]"` installs, and doxygen, which is
no Python package. The pages describe the curvewise that is installed, so install it first.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib.metadata import metadata
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import ConfigError

DOCS = Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS / "_extensions"))


def doxygen_xml() -> str:
    """Run doxygen over the headers, and return the folder of what it writes."""
    if shutil.which("doxygen") is None:
        raise ConfigError(
            "doxygen is not installed: the pages of the C++ interface need it. "
            "apt install doxygen, dnf install doxygen, brew install doxygen, or "
            "conda install -c conda-forge doxygen"
        )
    output = DOCS / "_doxygen"
    output.mkdir(exist_ok=True)
    settings = (DOCS / "Doxyfile").read_text(encoding="utf-8") + f'OUTPUT_DIRECTORY = "{output}"\n'
    ran = subprocess.run(
        ["doxygen", "-"], input=settings, text=True, capture_output=True, cwd=DOCS, check=False
    )
    if ran.returncode:
        raise ConfigError(f"doxygen refuses a header:\n{ran.stderr}")
    return str(output / "xml")


def repository() -> list[dict[str, str]]:
    """Return the header's link to the repository, or none where its address is not known.

    It stands among the package's URLs (`[project.urls]`), or the server that builds the site says
    where it has cloned from.
    """
    address = dict(url.split(", ", 1) for url in installed.get_all("Project-URL", [])).get(
        "Repository"
    )
    if github := os.environ.get("GITHUB_REPOSITORY"):
        address = address or f"{os.environ['GITHUB_SERVER_URL']}/{github}"
    address = address or os.environ.get("READTHEDOCS_GIT_CLONE_URL", "").removesuffix(".git")
    icon = "fa-brands fa-github" if "github" in address else "fa-solid fa-code-branch"
    return [{"name": "Repository", "url": address, "icon": icon}] if address else []


installed = metadata("curvewise")
project = "curvewise"
author = "The curvewise developers"
copyright = "the curvewise developers, MIT licence"
version = release = installed["Version"]

extensions = [
    "breathe",
    "command_help",
    "figures",
    "materials",
    "mathml",
    "myst_parser",
    "numpydoc",
    "repository",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "_doxygen", "gallery/*.py", "gallery/*.ipynb", "gallery/*.zip"]
templates_path = ["_templates"]
nitpicky = True
nitpick_ignore = [
    *(("c:identifier", name) for name in ("int64_t", "ptrdiff_t", "size_t")),
    ("std:ref", "curvewise_8h"),
    ("std:ref", "materials_8hpp"),
]
nitpick_ignore_regex = [
    (
        "cpp:identifier",
        r"curvewise|detail(::\w+)?|points(::is_point<Point>)?|std|Eigen|Eigen::DenseBase<Derived>",
    )
]

# Markdown. Links to headings are those of GitHub.
myst_enable_extensions = ["colon_fence", "dollarmath", "attrs_block"]
myst_heading_anchors = 4
repository_folders = {
    "cpp/examples": "docs/embedding/programs.md",
    "examples/studies": "docs/reference/study_examples.rst",
    "benchmarks": "docs/project/benchmarks.md",
    "benchmarks/reproduction": "docs/project/paper/index.md",
    "benchmarks/speed": "docs/project/speed.md",
    "benchmarks/validation": "docs/project/validation.md",
    "conformance": "docs/project/conformance.md",
}

# Python. Types stand in the docstrings, in words; attributes of a result stand before its methods.
autodoc_typehints = "none"
autodoc_member_order = "groupwise"
autosummary_generate = True
autosummary_ignore_module_all = False
numpydoc_show_class_members = False
numpydoc_xref_param_type = False

# C++ and C.
breathe_projects = {"curvewise": doxygen_xml()}
breathe_default_project = "curvewise"
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}

sphinx_gallery_conf = {
    "examples_dirs": str(DOCS.parent / "examples"),
    "gallery_dirs": "gallery",
    "backreferences_dir": "api/generated/backreferences",
    "doc_module": ("curvewise",),
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "min_reported_time": 5,
    "remove_config_comments": True,
    "copyfile_regex": "",
    "image_scrapers": ("figures.every_figure",),
    "capture_repr": (),
    "thumbnail_size": (540, 375),
    "subsection_order": [
        f"../examples/{part}"
        for part in ("measures", "two_curves", "many_curves", "losses", "identification")
    ],
    "show_signature": False,
    "write_computation_times": False,
}

html_theme = "pydata_sphinx_theme"
html_title = "curvewise"
html_math_renderer = "mathml"
html_favicon = "_static/curvewise.svg"
html_static_path = ["_static"]
html_css_files = ["curvewise.css"]
html_show_sourcelink = False
html_theme_options = {
    "logo": {
        "image_light": "_static/curvewise.svg",
        "image_dark": "_static/curvewise.svg",
        "text": f"curvewise {version}",
    },
    "icon_links": repository(),
    "header_links_before_dropdown": 7,
    "show_toc_level": 2,
    "navigation_with_keys": False,
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
}
html_context = {"default_mode": "auto"}
html_sidebars = {"index": [], "getting_started": []}

# "sphinx-build -b linkcheck" asks these servers; publishers' refuse what is no browser.
linkcheck_timeout = 20
linkcheck_ignore = [r"https://doi\.org/.*"]


def only_rst_heads_a_gallery(app: Sphinx) -> None:
    """Keep the gallery from taking examples/studies, with its README.md, for a part of itself."""
    app.config.sphinx_gallery_conf["source_suffix"] = {".rst": "restructuredtext"}


def setup(app: Sphinx) -> None:
    """Come between the gallery's reading of its settings (10) and its run (500)."""
    app.connect("builder-inited", only_rst_heads_a_gallery, priority=100)
