"""Doubtful numbers of a fit, and the refusal of cards with them.

Readers of a card take Young's modulus and the initial yield stress for properties of the material.
Hardening parameters compensate for each other: a card whose back stresses are undetermined
individually may follow the tests well. The rule therefore covers only the first two. One of them is
*doubtful* if the tests do not determine it and its interval reaches a bound of the search or is
wider than its value.
"""

from __future__ import annotations

from collections.abc import Mapping

from .._option_names import instead
from ..calibration import Uncertainty
from ..calibration.problem.tables import digits

__all__ = ["UndeterminedCardError", "check_refusals", "refusals_of"]

_REACHED = 1e-6  # part of the bounds' range


class UndeterminedCardError(ValueError):
    """A modulus or yield stress of a card is supported by the bounds alone.

    Examples
    --------
    >>> from curvewise.fitting import UndeterminedCardError
    >>> issubclass(UndeterminedCardError, ValueError)
    True
    """


def refusals_of(
    uncertainty: Uncertainty | None,
    bounds: Mapping[str, tuple[float, float]],
    units: str,
    yield_stress: str,
) -> dict[str, str]:
    """Return why a modulus or a yield stress is doubtful, by name.

    Parameters
    ----------
    uncertainty : Uncertainty or None
    bounds : mapping of str to (low, high)
        The bounds of the search.
    units : str
        Unit of stress.
    yield_stress : str
        Name of the parameter, as :class:`curvewise.materials.Material` has it.
    """
    if uncertainty is None:
        return {}
    found = {}
    for name in ("E", yield_stress):
        if uncertainty.determined.get(name, True):
            continue
        value, (low, high) = uncertainty.parameters[name], uncertainty.intervals[name]
        least, most = bounds[name]
        near = _REACHED * (most - least)
        said = (
            f"{name} = {digits(value, 3)} {units}, {100.0 * uncertainty.level:g} % interval "
            f"{digits(low, 3)} to {digits(high, 3)}"
        )
        if low <= least + near or high >= most - near:
            side, bound = ("lower", least) if low <= least + near else ("upper", most)
            found[name] = f"{said}, which reaches the {side} bound {digits(bound, 3)}"
        elif high - low > value:
            found[name] = f"{said}, which is wider than the value"
    return found


def check_refusals(doubts: Mapping[str, str], solvers: str) -> None:
    """Refuse cards with doubtful numbers, and say what to do.

    Parameters
    ----------
    doubts : mapping of str to str
        As `refusals_of` returns them.
    solvers : str
        For which the cards are.

    Raises
    ------
    UndeterminedCardError
        There are doubts.
    """
    if not doubts:
        return
    reasons = "; ".join(doubts.values())
    fix = f"--fix {next(iter(doubts))}=VALUE"
    known = instead("fix", f"{fix}; fixed=", fix)
    accept = instead("accept_undetermined", "--accept-undetermined; accept_undetermined=True", "{}")
    raise UndeterminedCardError(
        f"no card for {solvers}: the tests do not determine {' and '.join(doubts)} ({reasons}); "
        f"give what is known ({known}), add a test with unloading and small cycles, fit fewer back "
        f"stresses, or accept it ({accept})"
    )
