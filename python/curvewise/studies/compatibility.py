"""Checks of a study that need tests, models, measures and method together.

Objective, models and plan are created in the same way as by a search. Their errors are attributed
to the corresponding keys. Cost: that of scaling the tests, and of reading the templates.
"""

from __future__ import annotations

from ..calibration.methods import method_of
from .contents import AnyModel, Contents
from .toml_source import KeyPath, Source

__all__ = ["check_together"]


def check_together(study: Contents, source: Source) -> None:
    """Record errors that only tests, measures and method together show.

    Parameters
    ----------
    study : Contents
        The content of the file.
    source : Source
        The file; it collects the errors.
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
    try:  # in an existing folder: reading a study does not create one
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
            # For cases, identify does not support a common measure that is a sum of squares.
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
