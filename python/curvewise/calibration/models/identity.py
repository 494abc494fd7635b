"""The identity of a model, so that a store never returns a stale simulation.

A model can have an attribute `identity`, a text that changes whenever its curves may change.
:class:`CommandModel` has one, made of its templates, its command and the function that reads. For
any other Python callable the user gives a `version`. A fingerprint of its bytecode and data is
stored with the version: a model whose code has changed under the same version is rejected. The
fingerprint includes functions of the same module that the model calls by name, and the functions
that these call. It excludes functions of other modules. It also excludes lists, dicts, whole
numbers and variables of the module, because a model may keep a record of its runs there. Give a new
`version` if any of these change.
"""

from __future__ import annotations

import hashlib
import sys
import types
from collections.abc import Mapping
from functools import partial
from pathlib import PurePath
from typing import Any, NamedTuple

import numpy as np

__all__ = ["ModelIdentity", "fingerprint", "model_identity", "qualified_name"]


class ModelIdentity(NamedTuple):
    """The key under which a model's runs are stored.

    Attributes
    ----------
    text : str
        Two models with the same text have the same curves for the same parameters.
    fingerprint : str
        The fingerprint of the code behind the text; empty if the text alone identifies the model.
    """

    text: str
    fingerprint: str


def model_identity(model: Any, version: str | None) -> ModelIdentity:
    """Return what the runs of a model are stored under.

    Parameters
    ----------
    model : callable
        The model, perhaps with an attribute `identity`.
    version : str or None
        The user's name for the present state.

    Raises
    ------
    ValueError
        If neither an identity nor a version exists.
    """
    own = getattr(model, "identity", None)
    if isinstance(own, str) and own:
        return ModelIdentity(own if version is None else f"{own}, version {version}", "")
    if version is None:
        raise ValueError(
            f"the store cannot know which state of {qualified_name(model)} its runs are of; give "
            "store=SimulationStore(path, version='1'), and another version whenever the model "
            "changes"
        )
    return ModelIdentity(f"{qualified_name(model)}, version {version}", fingerprint(model))


def qualified_name(function: Any) -> str:
    """Return the name under which a function, or the type of an object, was defined."""
    if isinstance(function, partial):
        return f"partial of {qualified_name(function.func)}"
    named = function if hasattr(function, "__qualname__") else type(function)
    return str(named.__qualname__)


def fingerprint(function: Any) -> str:
    """Return a digest of a callable's bytecode and data, and of the Python that compiled it."""
    digest = hashlib.sha256()
    _add(digest, function, set())
    return f"python {sys.version_info[0]}.{sys.version_info[1]}: {digest.hexdigest()[:16]}"


def _add(digest: Any, value: Any, above: set[int]) -> None:
    """Add the contents of a value, but not its place in memory."""
    digest.update(type(value).__qualname__.encode())
    if id(value) in above:  # it holds itself
        return
    above = above | {id(value)}
    if isinstance(value, (str, bytes, int, float, complex, PurePath, type(None), type(...))):
        digest.update(repr(value).encode())
    elif isinstance(value, (np.ndarray, np.generic)):
        array = np.asarray(value)
        digest.update(f"{array.shape} {array.dtype}".encode() + array.tobytes())
    elif isinstance(value, types.CodeType):
        _add_code(digest, value, above)
    else:
        for part in _parts(value):
            _add(digest, part, above)


def _parts(value: Any) -> list[Any]:
    """Return what a container, a function or an object consists of."""
    if isinstance(value, (set, frozenset)):
        return sorted(value, key=repr)
    if isinstance(value, Mapping):
        return [part for item in value.items() for part in item]
    if isinstance(value, (list, tuple)):
        return list(value)
    if isinstance(value, partial):
        return [value.func, value.args, value.keywords]
    if isinstance(value, types.MethodType):
        return [value.__func__, value.__self__]
    if isinstance(value, types.FunctionType):
        cells = _lasting([_content(cell) for cell in value.__closure__ or ()])
        called = _called_functions(value)
        return [
            _without_docstring(value),
            value.__defaults__,
            value.__kwdefaults__,
            *cells,
            *called,
        ]
    if isinstance(value, (type, types.BuiltinFunctionType, types.ModuleType)):
        return [getattr(value, "__qualname__", value.__name__)]
    call = type(value).__call__ if callable(value) else None
    attributes = getattr(value, "__dict__", {})
    lasting = [part for name in attributes for part in (name, *_lasting([attributes[name]]))]
    return [call if isinstance(call, types.FunctionType) else None, *lasting]


def _lasting(values: list[Any]) -> list[Any]:
    """Return the constant data of a model, without lists, dicts and counters."""
    changing = (list, dict, set, bytearray, int, type(None))
    return [value for value in values if not isinstance(value, changing)]


def _add_code(digest: Any, code: types.CodeType, above: set[int]) -> None:
    """Add bytecode with its constants and names, and not its lines or names of files."""
    digest.update(code.co_code)
    for part in (code.co_names, code.co_varnames, *code.co_consts):
        _add(digest, part, above)


def _without_docstring(function: types.FunctionType) -> types.CodeType:
    """Return a function's code object without its docstring."""
    code = function.__code__
    if not code.co_consts or code.co_consts[0] != function.__doc__:
        return code
    return code.replace(co_consts=(None, *code.co_consts[1:]))


def _called_functions(function: types.FunctionType) -> list[types.FunctionType]:
    """Return the functions of the same module that a function names, in the order of the names."""
    found = [function.__globals__.get(name) for name in sorted(_names(function.__code__))]
    return [
        value
        for value in found
        if isinstance(value, types.FunctionType) and value.__module__ == function.__module__
    ]


def _names(code: types.CodeType) -> set[str]:
    """Return the names that bytecode looks up, including inner functions."""
    inner = [_names(part) for part in code.co_consts if isinstance(part, types.CodeType)]
    return set(code.co_names).union(*inner)


def _content(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not assigned yet
        return None
