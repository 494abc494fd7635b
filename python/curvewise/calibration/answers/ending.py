"""From an identification to what is written down of its end, and to the record of it all."""

from __future__ import annotations

import logging
import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..records.search_record import Ending, SearchRecord
from ..records.store import SimulationStore
from ..report.reading import history_record
from ..report.uncertainty_summary import summary_of
from ..uncertainty.sensitivity import optimum_surfaces

if TYPE_CHECKING:
    from ..uncertainty.uncertainty import Uncertainty
    from .identification import Identification

__all__ = ["record_of", "write_down"]

_log = logging.getLogger("curvewise.calibration")

# Slopes with more numbers than this (16 MB) are not written down.
_MOST_SLOPES = 2_000_000


def write_down(found: Identification) -> None:
    """Write how a search ended into its store and its history, if it has any.

    A file that has gone, or a disk that is full, is no reason to lose what was found: it is logged,
    and `found.report()` tries again and says so.
    """
    if not found.recorder.has_file:
        return
    ending = _ending(found)
    try:
        found.recorder.end(ending)
    except (OSError, sqlite3.Error) as error:
        _log.warning("how the search ended could not be written down: %s", error)


def record_of(found: Identification, uncertainty: Uncertainty | None) -> SearchRecord:
    """Return what is written down of a search, with its uncertainty, as its files give it."""
    recorder = found.recorder
    ending = recorder.ending or _ending(found)
    is_open = uncertainty is None and ending.uncertainty is None
    if is_open and _has_curves(found) and not found.uncertainty_runs:
        uncertainty = found.uncertainty()
    if uncertainty is not None:
        ending = replace(ending, uncertainty=summary_of(uncertainty))
    recorder.end(ending)
    if recorder.number is not None and recorder.store_exists:
        with SimulationStore(recorder.store or "") as store:
            return store.searches.records()[recorder.number]
    if recorder.history is not None and Path(recorder.history).is_file():
        return history_record(recorder.history)
    return recorder.record()


def _has_curves(found: Identification) -> bool:
    return len(found.simulations) == len(found.experiments)


def _ending(found: Identification) -> Ending:
    deviations: list[Any] = [one and list(one) for one in found.deviations]
    ending = Ending(
        converged=bool(found.converged),
        message=found.message,
        parameters=dict(found.parameters),
        value=float(found.value),
        measures={name: float(value) for name, value in found.measures.items()},
        deviations=deviations,
        simulations=found.simulations,
    )
    if not _has_curves(found) or found.uncertainty_runs:
        return ending
    unit = found.problem.space.unit_of(found.parameters)
    runs = found.runs_with_curves
    slopes = optimum_surfaces(found.problem, unit, found.simulations, runs).surfaces.slopes
    if slopes.size > _MOST_SLOPES:
        return ending
    return replace(ending, unit=unit, slopes=slopes)
