"""The results of a study as files: result.toml, .json and .csv, the curves, and a picture.

The three hold the same; what is unknown is null in JSON, and nan in TOML. Nothing in them depends
on when or how often the study was interrupted.
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..calibration import Identification, Uncertainty
from ..installation import build_info

if TYPE_CHECKING:
    from .study import Found, Study

__all__ = ["write_results"]

_COLUMNS = (
    "measure",
    "parameter",
    "value",
    "low",
    "high",
    "standard_error",
    "interval_low",
    "interval_high",
    "determined",
)


def write_results(study: Study, found: Found) -> None:
    """Write everything into the study's folder for results."""
    folder = study.results
    contents = _contents(study, found)
    (folder / "result.toml").write_text(_toml(contents), encoding="utf-8")
    (folder / "result.json").write_text(
        json.dumps(_without_nan(contents), indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
    with (folder / "result.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, _COLUMNS, lineterminator="\n", restval="")
        writer.writeheader()
        for measure, one in contents["found"].items():
            for name, row in one["parameters"].items():
                writer.writerow({"measure": measure, "parameter": name, **row})
    for measure, identification in found.identifications.items():
        ending = f"_{_file_name(measure)}" if len(found.identifications) > 1 else ""
        for test, curve in zip(study.tests, identification.simulations, strict=False):
            if not test.is_number:
                _write_curve(folder / f"simulation_{_file_name(test.name)}{ending}.csv", curve)
    drawn = found.several or next(iter(found.identifications.values()))
    figure = drawn.plot()
    for ax, test in zip(figure.axes, study.tests, strict=False):  # the loops come first
        if not test.is_number:
            ax.set(title=test.name, xlabel=test.axes[0], ylabel=test.axes[-1])
    figure.savefig(folder / "loops.png", dpi=120)


def _contents(study: Study, found: Found) -> dict[str, Any]:
    return {
        "study": study.path.name,
        "title": study.title,
        "curvewise": build_info()["version"],
        "numpy": np.__version__,
        "tests": [test.name for test in study.tests],
        "found": {
            measure: _one(one, found.uncertainties.get(measure))
            for measure, one in found.identifications.items()
        },
    }


def _one(found: Identification, uncertainty: Uncertainty | None) -> dict[str, Any]:
    parameters = {}
    for name, value in found.parameters.items():
        low, high = found.bounds.get(name, (value, value))
        row: dict[str, Any] = {"value": value, "low": low, "high": high}
        if uncertainty is not None and name in uncertainty.intervals:
            interval = uncertainty.intervals[name]
            row["standard_error"] = float(uncertainty.standard_errors[name])
            row["interval_low"], row["interval_high"] = map(float, interval)
            row["determined"] = bool(uncertainty.determined[name])
        parameters[name] = row
    contents = {
        "value": found.value,
        "converged": found.converged,
        "message": found.message,
        "method": found.method,
        "seed": found.seed,
        "evaluations": found.evaluations,
        "failures": len(found.failures),
        "parameters": parameters,
        "values_by_measure": {name: float(value) for name, value in found.measures.items()},
    }
    if uncertainty is not None:
        contents["level"] = uncertainty.level
        contents["weakest_direction"] = uncertainty.in_words
    return contents


def _write_curve(path: Path, curve: Any) -> None:
    np.savetxt(path, curve, delimiter=",", fmt="%.10g")


def _file_name(name: str) -> str:
    return re.sub(r"[^\w.-]+", "_", name).strip("_") or "test"


def _without_nan(value: Any) -> Any:
    """JSON has neither nan nor infinity."""
    if isinstance(value, Mapping):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _toml(values: Mapping[str, Any], path: tuple[str, ...] = ()) -> str:
    """Return nested tables as TOML, plain values first."""
    lines = [f"[{'.'.join(map(_toml_key, path))}]"] if path else []
    inner = []
    for key, value in values.items():
        if isinstance(value, Mapping):
            inner.append(_toml(value, (*path, key)))
        else:
            lines.append(f"{_toml_key(key)} = {_toml_value(value)}")
    return "\n".join([*lines, "", *inner])


def _toml_key(key: str) -> str:
    return key if re.fullmatch(r"[\w-]+", key, re.ASCII) else json.dumps(key)


def _toml_value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, list):
        return f"[{', '.join(map(_toml_value, value))}]"
    return json.dumps(value, ensure_ascii=False)  # TOML's texts are JSON's
