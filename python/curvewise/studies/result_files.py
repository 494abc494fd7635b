"""The results of a study in memory and as files: JSON, CSV, curves, a figure.

The files are result.json and result.csv, one file per curve, and a figure. Unknown values are null
in JSON and empty in CSV. The files do not depend on interruptions of the study.
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..calibration import Identification, SeveralMeasures, Uncertainty
from ..curves.foreign_curves import warn
from ..fitting import MaterialFit, UndeterminedCardError
from ..installation import build_info
from .contents import Contents
from .material_models import MaterialModel

__all__ = ["StudyResult", "file_name", "write_results"]

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


@dataclass(frozen=True)
class StudyResult:
    """What a study has found.

    Attributes
    ----------
    identifications : dict of str to Identification
        By measure; one, unless the study asks for several.
    uncertainties : dict of str to Uncertainty
        Of each; empty where the study has ``uncertainty = false``.
    several : SeveralMeasures or None
        The same together, where there are several.
    fit : MaterialFit or None
        The same as of a material, which takes the place of a solver.
    """

    identifications: dict[str, Identification]
    uncertainties: dict[str, Uncertainty]
    several: SeveralMeasures | None = None
    fit: MaterialFit | None = None

    def __str__(self) -> str:
        if self.fit is not None:
            return str(self.fit)
        parts = [str(self.several)] if self.several is not None else []
        for measure, found in self.identifications.items():
            if self.several is None:
                parts.append(str(found))
            if measure in self.uncertainties:
                title = f"by {measure}\n" if self.several is not None else ""
                parts.append(f"{title}{self.uncertainties[measure]}")
        return "\n\n".join(parts)


def write_results(study: Contents, found: StudyResult) -> None:
    """Write everything into the study's folder for results."""
    folder = study.results
    contents = _contents(study, found)
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
        ending = f"_{file_name(measure)}" if len(found.identifications) > 1 else ""
        for test, curve in zip(study.tests, identification.simulations, strict=False):
            if not test.is_number:
                path = folder / f"simulation_{file_name(test.name)}{ending}.csv"
                np.savetxt(path, curve, delimiter=",", fmt="%.10g")
    if found.fit is not None and study.material is not None:
        found.fit.write(folder, names=[test.name for test in study.tests])
        _write_cards(study.material, found.fit, folder)
        return
    drawn = found.several or next(iter(found.identifications.values()))
    figure = drawn.plot()
    for ax, test in zip(figure.axes, study.tests, strict=False):  # the loops come first
        if not test.is_number:
            title, xlabel, ylabel = map(_label, (test.name, test.axes[0], test.axes[-1]))
            ax.set(title=title, xlabel=xlabel, ylabel=ylabel)
    figure.savefig(folder / "loops.png", dpi=120)


def _write_cards(material: MaterialModel, fit: MaterialFit, folder: Path) -> None:
    """Write the cards; warn of those that are refused, since the search must not be lost."""
    try:
        fit.write_cards(
            folder,
            material.cards,
            name=material.name,
            accept_undetermined=material.accept_undetermined,
        )
    except UndeterminedCardError as error:
        warn(UserWarning(f"{error}; in a study: accept_undetermined = true in [model]"))


def _contents(study: Contents, found: StudyResult) -> dict[str, Any]:
    return {
        "study": study.path.name,
        "title": study.title,
        "curvewise": build_info()["version"],
        "numpy": np.__version__,
        "tests": [test.name for test in study.tests],
        "prepared": {t.name: t.prepared.steps for t in study.tests if t.prepared is not None},
        "found": {
            measure: _one(one, found.uncertainties.get(measure))
            for measure, one in found.identifications.items()
        },
    }


def _one(found: Identification, uncertainty: Uncertainty | None) -> dict[str, Any]:
    parameters, usable = {}, found.verdict.usable
    for name, value in found.parameters.items():
        low, high = found.bounds.get(name, (value, value))
        row: dict[str, Any] = {"value": value, "low": low, "high": high}
        if uncertainty is not None and name in uncertainty.intervals:
            interval = uncertainty.intervals[name]
            row["standard_error"] = float(uncertainty.standard_errors[name])
            row["interval_low"], row["interval_high"] = map(float, interval)
            row["determined"] = usable[name]
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


def file_name(name: str) -> str:
    """Return a name as a part of a file's: several may become one."""
    return re.sub(r"[^\w.-]+", "_", name).strip("_") or "test"


def _label(text: str) -> str:
    """Return a name for a picture: a formula between dollars where it is one."""
    text = re.sub(r"[\x00-\x1f\x7f]+", " ", text)
    try:
        import_module("matplotlib.mathtext").MathTextParser("path").parse(text)
    except ValueError:
        return text.replace("$", r"\$")
    return text


def _without_nan(value: Any) -> Any:
    """JSON has neither nan nor infinity."""
    if isinstance(value, Mapping):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
