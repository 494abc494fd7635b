"""The call that makes a search again, as Python."""

from __future__ import annotations

import re
from typing import Any

from ..records.search_record import SearchRecord

__all__ = ["code_to_repeat"]

_DEFAULTS: dict[str, Any] = {
    "min_coverage": 0.5,
    "start": None,
    "max_runs": None,
}


def code_to_repeat(record: SearchRecord) -> str:
    """Return the call of `identify` that makes the search again.

    The model and the tests stand for themselves: they are named in the table beside it. Parameters
    that follow from others by a function stand as comments.
    """
    settings, details = record.settings, record.details
    method = settings["method_call"]
    names = ["Below", "Case", "Log", *re.findall(r"\b[A-Z]\w+(?=\()", method), "identify"]
    lines = [
        f"from curvewise.calibration import {', '.join(names)}",
        "",
        "found = identify(",
    ]
    if details["cases"] is None:
        lines += ["    model,", "    experiments,"]
    else:
        lines += ["    [", *map(_case, details["cases"]), "    ],"]
    lines.append("    bounds={")
    lines += [_bound(name, given) for name, given in settings["bounds"].items()]
    lines.append("    },")
    keywords: dict[str, Any] = {}
    if details["cases"] is None:
        keywords |= {name: settings[name] for name in ("measure", "preset")}
        if set(settings["weights"]) != {1.0}:
            keywords["weights"] = settings["weights"]
        keywords |= settings["options"]
    keywords["seed"] = settings["seed"]
    for name, default in _DEFAULTS.items():
        value = settings[name] if name in settings else details[name]
        if value != default and not (details["cases"] and name == "min_coverage"):
            keywords[name] = value
    lines += [f"    {name}={value!r}," for name, value in keywords.items()]
    lines.append(f"    method={method},")
    return "\n".join([*lines, ")"])


def _bound(name: str, given: Any) -> str:
    if not isinstance(given, list):
        return f"        {name!r}: {given!r},"
    kind, *rest = given
    if kind == "tied":
        return f"        # {name!r}: Tied(...), a function of the parameters above,"
    if kind in ("log", "below"):
        return f"        {name!r}: {kind.capitalize()}({', '.join(map(repr, rest))}),"
    return f"        {name!r}: ({', '.join(map(repr, given))}),"


def _case(case: dict[str, Any]) -> str:
    others = {"measure": "area", "weight": 1.0, "sigma": None, "preset": "scaled"}
    others |= {"min_coverage": 0.5, "part": "experiment", "options": {}}
    given = [f"{name}={case[name]!r}" for name, value in others.items() if case[name] != value]
    return f"        Case({', '.join([repr(case['name']), 'model', 'experiment', *given])}),"
