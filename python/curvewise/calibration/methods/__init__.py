"""The methods that search, one file each, and one search from its start to its end.

A method is selected by its record (`method.py`). To add a method, list it in `__all__` and in the
tuple of records; no other module needs a change.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ..._names import did_you_mean
from .differential_evolution import DifferentialEvolution
from .domain_reduction import SDRM
from .global_search import Global
from .least_squares import Auto, LeastSquares
from .method import Method, options_of, refuse_unknown
from .simplex import NelderMead
from .trust_region import TrustRegion

# The public names; the others are internal.
__all__ = [
    "SDRM",
    "Auto",
    "DifferentialEvolution",
    "Global",
    "LeastSquares",
    "NelderMead",
    "TrustRegion",
]

METHODS: dict[str, Method] = {
    str(method): method
    for method in (
        Auto(),
        TrustRegion(),
        LeastSquares(),
        Global(),
        SDRM(),
        DifferentialEvolution(),
        DifferentialEvolution(after=SDRM()),
        NelderMead(),
    )
}


def method_of(method: str | Method) -> Method:
    """Return the method with a given name; return a method record unchanged."""
    if isinstance(method, Method):
        return method
    if not isinstance(method, str) or method not in METHODS:
        raise ValueError(
            f"unknown method {method!r}; choose from {', '.join(METHODS)}"
            f"{did_you_mean([method], METHODS)}"
        )
    return METHODS[method]


def method_with(options: Mapping[str, Any]) -> Method:
    """Return the method of a text's table: {"name": "trust-region", "starts": 5}."""
    given = dict(options)
    method = method_of(given.pop("name", "trust-region"))
    refuse_unknown(method.name, given, options_of(method))
    if isinstance(given.get("after"), Mapping):
        given["after"] = method_with(given["after"])
    return replace(method, **given)
