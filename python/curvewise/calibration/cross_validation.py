"""Leave one loop out: how well parameters identified from the others predict it.

The paper's five-fold study. Every loop in turn is left out of an identification, and the objective
of the left-out loop is computed at the parameters that the others gave. A value much larger than
those of the loops that were identified from means that the model, or the set of tests, does not
determine the parameters. Cost: as many identifications as there are loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from inspect import signature
from typing import Any

import numpy as np

from .._bounds import Bounds
from ..curves.inputs import Array
from ..curves.several_curves import as_points, curve_list
from ..showing.result import Table, Tabular
from .answers.identification import Identification
from .identify import identify
from .models.forward import Selection
from .models.identity import model_identity
from .models.pool import Model
from .objective.criterion import Criterion, Measure, criterion_of
from .objective.noisy_tests import warn_of_noise
from .objective.objective import Objective
from .problem.space import Space
from .records.store import SimulationStore

__all__ = ["CrossValidation", "Fold", "cross_validate"]


@dataclass(frozen=True, eq=False)
class Fold:
    """One loop left out.

    Attributes
    ----------
    left_out : int
        The index of the loop.
    value : float
        Its measure at the parameters that the other loops gave, without weight; nan if its
        simulation fails there.
    others : float
        The mean of the measure, without weights, over the loops that were identified from.
    identification : Identification
        From the other loops.
    simulation : ndarray or None
        The left-out loop, predicted; None if its simulation failed.
    """

    left_out: int
    value: float
    others: float
    identification: Identification = field(repr=False)
    simulation: Array | None = field(repr=False)

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters that the other loops gave."""
        return self.identification.parameters


@dataclass(frozen=True, eq=False, repr=False)
class CrossValidation(Tabular):
    """Result of `cross_validate`: a fold for every loop.

    Attributes
    ----------
    folds : tuple of Fold
        In the order of the loops.
    measure, preset
        The arguments of the call.
    """

    folds: tuple[Fold, ...]
    measure: str
    preset: str

    def __repr__(self) -> str:
        return f"CrossValidation({len(self.folds)} folds, measure={self.measure!r})"

    def parts(self) -> Sequence[Table | str]:
        """Return the parameters of every fold, the left-out loop's value, and the others'."""
        numbers = np.array(
            [[*fold.parameters.values(), fold.value, fold.others] for fold in self.folds]
        )
        names = [*(f"loop {fold.left_out}" for fold in self.folds), "mean", "std"]
        columns = np.vstack([numbers, numbers.mean(axis=0), numbers.std(axis=0, ddof=1)])
        rows = [
            [name, *(f"{number:.5g}" for number in row)]
            for name, row in zip(names, columns, strict=True)
        ]
        return [Table(rows, ["left out", *self.folds[0].parameters, self.measure, "others"])]


def cross_validate(
    model: Model,
    experiments: Any,
    bounds: Bounds,
    *,
    measure: Measure = "area",
    **keywords: Any,
) -> CrossValidation:
    """Identify the parameters without each loop in turn, and predict that loop.

    Parameters
    ----------
    model : callable
        As for :func:`identify`: returns a curve for every experiment. The fit to the other loops
        ignores the curves of the left-out loop.
    experiments : sequence of array_like
        At least two measured curves.
    bounds, measure, **keywords
        As for :func:`identify`.

    Returns
    -------
    CrossValidation
        The folds; prints as a table.

    Raises
    ------
    ValueError
        If only one experiment is given; as for :func:`identify`.
    RuntimeError, ImportError, KeyboardInterrupt
        As for :func:`identify`.

    Warns
    -----
    NoisyTestWarning, FirstRunWarning, WideBoundsWarning
        As for :func:`identify`, once for all searches.

    Notes
    -----
    Time: for k loops that of k identifications, and k runs of the model. With ``store=``, a run
    that several folds request is made once, and an interrupted call can be repeated to continue.
    The paper's section on cross-validation leaves out each of its five loops.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.calibration import cross_validate
    >>> x = np.linspace(0, 1, 20)
    >>> def lines(p):
    ...     return [np.column_stack((x, p["slope"] * x)), np.column_stack((x, p["slope"] * x**2))]
    >>> checked = cross_validate(
    ...     lines, lines({"slope": 2.0}), {"slope": (0, 10)}, method="sdrm", progress=False
    ... )
    >>> [round(fold.parameters["slope"], 3) for fold in checked.folds]
    [2.0, 2.0]
    """
    curves = curve_list(experiments)
    count = len(curves)
    if count < 2:
        raise ValueError("there is one experiment; cross-validation needs at least 2")
    own = signature(identify).parameters
    options = {name: keywords.pop(name) for name in list(keywords) if name not in own}
    criterion = criterion_of(measure, options, own)
    warn_of_noise([Objective(curves, criterion.weighing(None))])
    Space(bounds).warn_of_wide_bounds()
    folds = []
    for left_out in range(count):
        kept = tuple(i for i in range(count) if i != left_out)
        identification = identify(
            Selection(model, kept, count),
            [curves[i] for i in kept],
            bounds,
            measure=_criterion_of(kept, criterion, count),
            **keywords,
        )
        folds.append(_fold(model, curves, left_out, identification, keywords))
    return CrossValidation(tuple(folds), identification.measure, identification.preset)


def _criterion_of(kept: Sequence[int], criterion: Criterion, count: int) -> Criterion:
    """Return the criterion for the loops that are kept: with their weights, if it has any."""
    if (weights := criterion.weights) is None:
        return criterion
    if len(weights) != count:
        raise ValueError(f"weights has {len(weights)} entries; give one for each of {count} loops")
    return criterion.weighing([weights[i] for i in kept])


def _fold(
    model: Model,
    curves: list[Any],
    left_out: int,
    identification: Identification,
    keywords: dict[str, Any],
) -> Fold:
    """Return the prediction of a loop by the identification without it."""
    objective = identification.problem.objective
    simulation: Any
    try:
        simulation = curve_list(_at_optimum(model, identification, keywords))[left_out]
    except Exception as error:  # the left-out loop may be the one that fails
        simulation = error
    assert objective.criterion is not None, "the loops have the same"
    alone = Objective(curves[left_out], objective.criterion.weighing(None))
    score = alone.predicted([simulation])
    others = objective.predicted(list(identification.simulations)).terms
    return Fold(
        left_out,
        np.nan if score.failures else score.value,
        float(others.mean()),
        identification,
        None if score.failures else as_points(simulation, "Q").copy(),
    )


def _at_optimum(model: Model, identification: Identification, keywords: dict[str, Any]) -> Any:
    """Return the model's curves at the optimum, of the store if there is one."""
    if (store := keywords.get("store")) is None:
        return model(dict(identification.parameters))
    with SimulationStore(store) as runs:
        outcome = runs.look_up(model_identity(model, runs.version).text, identification.parameters)
    return model(dict(identification.parameters)) if outcome is None else outcome.simulations
