"""The process in which a package is called: it may crash or hang without harm to run.py.

Reads a JSON object a line from standard input: a check, two curves, parameters. Answers each by a
line: the number (its repr, which has nan and inf too), the exception, or that it is not offered.
What a package prints goes to standard error. Any Python that has the package can run it.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import json
import os
import sys
import warnings
from pathlib import Path
from typing import Any


def load(target: str, measure: str | None) -> dict[str, Any]:
    """Return an adapter's names, from its file or from "module:function" and the check's name."""
    if measure:
        module, _, function = target.partition(":")
        return {
            "PACKAGE": module.partition(".")[0],
            "CHECKS": {measure: getattr(importlib.import_module(module), function)},
        }
    spec = importlib.util.spec_from_file_location("adapter", target)
    assert spec
    assert spec.loader
    module_of_file = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module_of_file)
    return vars(module_of_file)


def about(adapter: dict[str, Any]) -> dict[str, Any]:
    """Return what is to be said of the package."""
    try:
        version = adapter.get("VERSION") or importlib.metadata.version(adapter["PACKAGE"])
    except importlib.metadata.PackageNotFoundError:
        version = "not known"
    return {
        "package": adapter.get("NAME", adapter["PACKAGE"]),
        "version": version,
        "licence": adapter.get("LICENCE", "not known"),
        "checks": list(adapter["CHECKS"]),
        "other": adapter.get("OTHER", {}),
        "notes": adapter.get("NOTES", {}),
        "python": sys.version.partition(" ")[0],
    }


def curve(rows: list[list[Any]]) -> Any:
    """Return an (n, d) array of float64, or where there is no numpy a list of lists."""
    numbers = [[float(x) for x in row] for row in rows]
    try:
        import numpy as np
    except ImportError:
        return numbers
    return np.array(numbers, dtype=np.float64).reshape(len(rows), len(rows[0]) if rows else 2)


def answer(adapter: dict[str, Any], question: dict[str, Any]) -> dict[str, str]:
    """Call the package once."""
    call = adapter["CHECKS"][question["check"]]
    try:
        found = call(curve(question["P"]), curve(question["Q"]), **question["parameters"])
        return {"number": repr(float(found))}
    except NotImplementedError as error:
        return {"not offered": str(error)}
    except BaseException as error:  # a panic in Rust is no Exception
        if isinstance(error, KeyboardInterrupt):
            raise
        return {"raised": f"{type(error).__name__}: {str(error)[:200]}"}


def main() -> None:
    """Answer until the input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    sys.path.pop(0)  # a package's modules may have the names of this folder's
    target = sys.argv[1]
    measure = sys.argv[2] if len(sys.argv) > 2 else None
    if measure:
        sys.path.insert(0, str(Path.cwd()))
    try:
        adapter = load(target, measure)
        said: dict[str, Any] = about(adapter)
    except (ImportError, AttributeError, OSError) as error:
        said = {"missing": f"{type(error).__name__}: {error}"}
    print(json.dumps(said), file=answers, flush=True)
    for line in sys.stdin:
        print(json.dumps(answer(adapter, json.loads(line))), file=answers, flush=True)


if __name__ == "__main__":
    main()
