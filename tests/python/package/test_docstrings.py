"""The examples in the docstrings, and that every public function has one."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
from types import ModuleType

import pytest

import curvewise

MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(curvewise.__path__, "curvewise.")
    if not module.name.endswith(("._core", ".__main__"))
)

OPTIONAL = ("dask", "distributed", "geopandas", "jax", "sklearn", "sktime", "torch", "zarr")
FUNCTIONS = sorted(
    name for name in curvewise.__all__ if inspect.isfunction(getattr(curvewise, name))
)


@pytest.mark.parametrize("name", ["curvewise", *MODULES])
def test_examples_run(name: str) -> None:
    try:
        module: ModuleType = importlib.import_module(name)
    except ImportError as error:  # its message names the command that installs the requirement
        if getattr(error.__cause__, "name", None) not in OPTIONAL:
            raise
        pytest.skip(str(error))
    assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("name", FUNCTIONS)
def test_public_function_is_documented(name: str) -> None:
    docstring = inspect.getdoc(getattr(curvewise, name)) or ""
    sections = ["Returns\n-----", "Examples\n-----"]
    if inspect.signature(getattr(curvewise, name)).parameters:
        sections += ["Parameters\n-----", "Raises\n-----", "Notes\n-----"]
    assert [section for section in sections if section not in docstring] == []
