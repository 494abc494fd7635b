"""The Python call that repeats a search."""

from __future__ import annotations

import re
from typing import Any

from ..objective.criterion import criterion_as_code
from ..records.search_record import SearchRecord

__all__ = ["code_to_repeat"]

_OF_A_CASE: dict[str, Any] = {"weight": 1.0, "sigma": None}


def code_to_repeat(record: SearchRecord) -> str:
    """Return the call of `identify` that repeats the search.

    The model and the tests appear by name; the table next to the code lists them. Parameters that
    follow from others by a function are comments.
    """
    settings, details = record.settings, record.details
    method = settings["method_call"]
    methods = re.findall(r"\b[A-Z]\w+(?=\()", method)
    names = ["Below", "Case", "Criterion", "Log", *methods, "identify"]
    lines = [f"from curvewise.calibration import {', '.join(names)}", "", "found = identify("]
    if settings["cases"] is None:
        lines += ["    model,", "    experiments,"]
    else:
        lines += ["    [", *map(_case, settings["cases"]), "    ],"]
    lines.append("    bounds={")
    lines += [_bound(name, given) for name, given in settings["bounds"].items()]
    lines.append("    },")
    if settings["criterion"] is not None:
        lines.append(f"    measure={criterion_as_code(settings['criterion'])},")
    keywords = {"seed": settings["seed"], "start": settings["start"]}
    keywords["max_runs"] = details["max_runs"]
    given = [f"    {name}={value!r}," for name, value in keywords.items() if value is not None]
    return "\n".join([*lines, *given, f"    method={method},", ")"])


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
    given = [f"{name}={case[name]!r}" for name, usual in _OF_A_CASE.items() if case[name] != usual]
    measure = f"measure={criterion_as_code(case['criterion'])}"
    arguments = [repr(case["name"]), "model", "experiment", measure, *given]
    return f"        Case({', '.join(arguments)}),"
