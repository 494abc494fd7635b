"""What is wrong with a study only when its tests, models, measures and method come together.

Objective, models and plan are made as a search would make them, and what they refuse is placed at
the key that it is about. Cost: that of scaling the tests, and of reading the templates.
"""

from __future__ import annotations

from ..calibration.methods import method_of
from .contents import AnyModel, Contents
from .toml_source import KeyPath, Source

__all__ = ["check_together"]


def check_together(study: Contents, source: Source) -> None:
    """Note what is wrong only when tests, measures and method come together.

    Parameters
    ----------
    study : Contents
        What the file says.
    source : Source
        The file, where problems are noted.
    """
    if study.has_cases and len(study.search.measures) > 1:
        named = [i for i, test in enumerate(study.tests) if test.own or test.is_number]
        at: KeyPath = ("tests", named[0]) if named else ("search", "measures")
        source.problem(
            at,
            "has settings of its own, or is simulated by a model of its own, and [search] has "
            "several measures; give one measure, and run the study once for each",
        )
        return
    if study.has_cases and "failure_value" in study.search.comparison:
        source.problem(("search", "failure_value"), "does not go with tests of their own kinds")
    models: dict[str, AnyModel] = {}
    try:  # in a folder that is there: reading a study makes none
        models = study.study_models(kept_in=source.folder)
    except (OSError, ValueError) as error:
        source.problem(("model",) if "" in study.models else ("models",), str(error))
        return
    method = method_of(study.search.method or "auto")
    for measure in study.search.measures:
        key = "measures" if len(study.search.measures) > 1 else "measure"
        try:
            study.objective(models, measure)
        except (TypeError, ValueError) as error:
            _place_objective_error(study, source, key, str(error))
        try:
            # Of cases, identify knows no common measure that is a sum of squares.
            method.check("area" if study.has_cases else measure)
        except ValueError as error:
            source.problem(("search", "method"), f"does not go together: {error}")


def _place_objective_error(study: Contents, source: Source, key: str, message: str) -> None:
    """Note what an objective refuses, at the test or the key that it is about."""
    for i, test in enumerate(study.tests):
        if f"case {test.name!r}" in message or f"experiments[{i}]" in message:
            source.problem(("tests", i), f"cannot be compared: {message}")
            return
    at = "options" if "option" in message else key
    source.problem(("search", at), f"does not go with the tests: {message}")
