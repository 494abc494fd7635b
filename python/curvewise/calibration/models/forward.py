"""The forward model of a search: the functions to run, and their simulations.

A forward model has the functions to call and turns their outcomes into simulations. It also returns
the derivatives of these simulations, if every function has a ``jacobian``. A search uses only this
interface. It represents one model of all experiments (`SingleModel`), some of its curves
(`Selection`), or several cases (`Cases`). Cost of derivatives: one call of ``jacobian`` for every
function, in this process.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...curves.inputs import Array
from ...curves.several_curves import curve_list
from .pool import Model, Outcome

__all__ = ["ForwardModel", "Selection", "SingleModel", "curve_slopes"]


class ForwardModel(ABC):
    """Parameters in, simulations out: the functions behind them, and their derivatives."""

    @property
    @abstractmethod
    def callables(self) -> Sequence[Model]:
        """The functions, each called once for every set of parameters."""

    @abstractmethod
    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return the simulations as one outcome, of an outcome for every function."""

    @abstractmethod
    def slopes(self, parameters: Mapping[str, float], rates: Array) -> list[Array] | None:
        """Return the derivatives of the simulations; None if unknown at this point.

        Parameters
        ----------
        parameters : mapping of str to float
            All p parameters of the functions.
        rates : ndarray, shape (p, k)
            The derivatives of these parameters.

        Returns
        -------
        list of ndarray, shape (n, d, k)
            An array for every simulation.

        Raises
        ------
        ValueError
            If a ``jacobian`` returns arrays of other shapes, or numbers that are not finite.
        """

    @property
    def has_slopes(self) -> bool:
        """Whether every function has a ``jacobian``."""
        return all(callable(getattr(model, "jacobian", None)) for model in self.callables)


class SingleModel(ForwardModel):
    """A model that simulates every experiment.

    Parameters
    ----------
    model : callable
        The model.
    count : int
        The number of experiments.
    """

    def __init__(self, model: Model, count: int) -> None:
        self._model, self._count = model, count

    @property
    def callables(self) -> Sequence[Model]:
        """The model alone."""
        return (self._model,)

    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return the only outcome."""
        (outcome,) = outcomes
        return outcome

    def slopes(self, parameters: Mapping[str, float], rates: Array) -> list[Array] | None:
        """Return the derivatives of all curves."""
        return curve_slopes(self._model, parameters, rates, self._count)


class Selection(ForwardModel):
    """Some curves of a model: what a fold of a cross-validation compares.

    The model is run as a whole, so that its runs in a store are the same for every fold.

    Parameters
    ----------
    whole : callable
        The model, which returns `count` curves.
    kept : tuple of int
        Which of them count.
    count : int
        The number of curves.
    """

    def __init__(self, whole: Model, kept: tuple[int, ...], count: int) -> None:
        self._whole, self._kept, self._count = whole, kept, count

    @property
    def callables(self) -> Sequence[Model]:
        """The whole model."""
        return (self._whole,)

    def assembled(self, outcomes: list[Outcome]) -> Outcome:
        """Return the curves that count, of a run of the whole."""
        (outcome,) = outcomes
        if outcome.message:
            return outcome
        curves = curve_list(outcome.simulations)
        if len(curves) == 1 and curves[0] is None:
            return outcome
        if len(curves) != self._count:
            message = f"the model gave {len(curves)} curves for {self._count} loops"
            return Outcome(None, message, outcome.seconds)
        return outcome._replace(simulations=[curves[i] for i in self._kept])

    def slopes(self, parameters: Mapping[str, float], rates: Array) -> list[Array] | None:
        """Return the derivatives of the curves that count."""
        found = curve_slopes(self._whole, parameters, rates, self._count)
        return found and [found[i] for i in self._kept]


def curve_slopes(
    model: Any, parameters: Mapping[str, float], rates: Array, count: int
) -> list[Array] | None:
    """Return the derivatives of a model's curves; None if its ``jacobian`` does.

    Parameters
    ----------
    model : callable
        With a ``jacobian``.
    parameters, rates
        As for :meth:`ForwardModel.slopes`.
    count : int
        The number of curves.

    Raises
    ------
    ValueError
        If the ``jacobian`` returns arrays of other shapes, or numbers that are not finite.
    """
    found = model.jacobian(dict(parameters))
    if found is None:
        return None
    by_curve = [found] if isinstance(found, np.ndarray) else list(found)
    slopes = [np.asarray(one, dtype=np.float64) for one in by_curve]
    shapes = [one.shape for one in slopes]
    if len(slopes) != count or any(len(s) != 3 or s[2] != len(rates) for s in shapes):
        raise ValueError(
            f"jacobian of the model returned shapes {shapes}; return an array for each of {count} "
            f"curves, (points, coordinates, {len(rates)}): derivatives by the parameters in the "
            "order of the dict that it is called with"
        )
    if not all(np.isfinite(one).all() for one in slopes):
        raise ValueError("jacobian of the model returned derivatives that are not finite")
    return [one @ rates for one in slopes]
