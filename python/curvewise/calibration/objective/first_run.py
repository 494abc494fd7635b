"""Warns if the first simulation of a solver does not resemble its test.

The warning comes once, before hours of runs. The extents of both curves reveal other units, swapped
columns and another sign. A function that takes milliseconds is not checked, because its bounds may
well span a factor of 20. Cost: O(n + m).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...comparing.units import unlike_its_test
from ...curves.foreign_curves import warn
from ...curves.inputs import Array
from ...curves.several_curves import as_points, curve_list

__all__ = ["FirstRunWarning", "warn_of_first_run"]


class FirstRunWarning(UserWarning):
    """The first simulation of a search does not look like its test.

    Its extent differs from the test's by more than a factor of 20, it does not change, its columns
    seem to be swapped, or it has the opposite sign. The search continues. Searches with a
    :class:`CommandModel` or a study compare; those with another model do so if the model has an
    attribute ``is_solver = True``.

    Examples
    --------
    >>> import warnings
    >>> from curvewise.calibration import FirstRunWarning
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", FirstRunWarning)  # and identify(...) here
    """


def warn_of_first_run(
    experiments: Sequence[Array], axes: Sequence[tuple[str, ...]], simulations: Any
) -> None:
    """Warn once of simulations that are unlike their tests.

    Parameters
    ----------
    experiments : sequence of ndarray, shape (n, d)
    axes : sequence of tuple of str
        The names of the coordinates of each.
    simulations
        The successful result of the model.
    """
    doubts = []
    for i, (test, names, curve) in enumerate(
        zip(experiments, axes, curve_list(simulations), strict=True)
    ):
        which = f"test {i}: " if len(experiments) > 1 else ""
        found = unlike_its_test(test, as_points(curve, "Q"), names)
        doubts += [f"{which}{doubt}" for doubt in found]
    if doubts:
        warn(
            FirstRunWarning(
                f"the first simulation does not look like its test: {' '.join(doubts)} If so, stop "
                "the search and correct the model or the test"
            )
        )
