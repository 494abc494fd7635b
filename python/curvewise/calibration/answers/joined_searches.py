"""Several searches for the same parameters as one: the evaluations of all, the optimum of one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .identification import Identification

__all__ = ["continued", "joined"]


def joined(searches: Sequence[Identification], chosen: Identification) -> Identification:
    """Return one of several searches with the history, failures and runs of all.

    Parameters
    ----------
    searches : sequence of Identification
        The searches in their order, with the same objective and parameters. Their bounds may
        differ.
    chosen : Identification
        One of them. Its optimum and its ending are kept.
    """
    history = np.concatenate([one.history for one in searches])
    history["evaluation"] = np.arange(1, len(history) + 1)
    before = np.cumsum([0, *(one.evaluations for one in searches)]).tolist()
    recorder = chosen.recorder
    if not recorder.has_store:  # a store has a record of each search
        recorder = recorder.with_evaluations([e for s in searches for e in s.recorder.evaluations])
    return replace(
        chosen,
        history=history.view(np.recarray),
        failures=tuple(
            (count + number, message)
            for count, one in zip(before, searches, strict=False)
            for number, message in one.failures
        ),
        runs=sum(one.runs for one in searches),
        recorder=recorder,
    )


def continued(before: Identification, after: Identification) -> Identification:
    """Return a later search of the same problem as the continuation of an earlier one."""
    # A search that only confirms the value has gained nothing, which does not cause doubt.
    ending = before if before.converged and after.value >= before.value else after
    return replace(
        joined([before, after], after if after.value <= before.value else before),
        converged=ending.converged,
        message=ending.message,
        agreement=ending.agreement,
        reason=ending.reason,
        runs_with_curves=after.runs_with_curves,
    )
