"""All measures of a pair of curves at once, under conditions that make sense together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

from . import measures as _measures
from ._curves import Array, CurveLike, as_curves

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["PRESETS", "Comparison", "Preset", "compare"]

Preset: TypeAlias = Literal["scaled", "paper", "raw"]


class Condition(NamedTuple):
    """How a preset computes one measure."""

    scaled: bool
    options: dict[str, Any]


_MEASURES: dict[str, Callable[..., float]] = {
    "area": _measures.area,
    "pcm": _measures.pcm,
    "frechet": _measures.frechet,
    "dtw": _measures.dtw,
    "curve_length": _measures.curve_length,
}

_ANY_DIMENSION = ("frechet", "dtw")

PRESETS: dict[str, dict[str, Condition]] = {
    "scaled": {
        # "rearrange" jumps where curves cross, which an identification takes for minima.
        "area": Condition(True, {"crossing": "split"}),
        "pcm": Condition(True, {}),
        "frechet": Condition(True, {}),
        "dtw": Condition(True, {}),
        "curve_length": Condition(True, {"scale": "mean_abs"}),
    },
    "paper": {
        "area": Condition(False, {"spacing": "x"}),
        "pcm": Condition(False, {}),
        "frechet": Condition(True, {}),
        "dtw": Condition(True, {"step_pattern": "symmetric2"}),
        "curve_length": Condition(False, {}),
    },
    "raw": {name: Condition(False, {}) for name in _MEASURES},
}


@dataclass(frozen=True, eq=False)
class Comparison:
    """The values of several measures for one pair of curves.

    ``comparison["dtw"]`` is one value, ``str(comparison)`` a table.

    Attributes
    ----------
    P, Q : ndarray
        The curves, in float64, not scaled.
    preset : {"scaled", "paper", "raw"}
        The conditions under which the values were computed.
    values : dict of str to float
        In the order area, pcm, frechet, dtw, curve_length, or as asked for.
    """

    P: Array
    Q: Array
    preset: Preset
    values: dict[str, float]

    def __getitem__(self, measure: str) -> float:
        return self.values[measure]

    def __str__(self) -> str:
        width = max(map(len, self.values))
        lines = [f"{name:<{width}}  {value:.6g}" for name, value in self.values.items()]
        return "\n".join(lines)

    def to_dict(self) -> dict[str, float]:
        """Return the values by name, as a new dict of Python floats."""
        return dict(self.values)

    def plot(self) -> Figure:
        """Return a matplotlib Figure of the curves and of what each measure saw.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        from .plotting import plot_comparison

        return plot_comparison(self)


def compare(
    P: CurveLike,
    Q: CurveLike,
    *,
    preset: Preset = "scaled",
    measures: Sequence[str] | None = None,
) -> Comparison:
    """Compute several measures of a pair of curves.

    Parameters
    ----------
    P, Q : array_like, shapes (n, d) and (m, d)
        The curves; P is the reference.
    preset : {"scaled", "paper", "raw"}
        "scaled": everything on curves scaled by P's box, area with crossing="split",
        curve_length with scale="mean_abs".
        "paper": the conditions of the paper's Table 4 (area raw with spacing="x"; frechet, and
        dtw with step_pattern="symmetric2", on scaled curves; curve_length raw with
        scale="mean"). "raw": every default on the curves as they are.
    measures : sequence of str, optional
        Of "area", "pcm", "frechet", "dtw", "curve_length"; if not given, all five in the plane
        and frechet and dtw in other dimensions.

    Returns
    -------
    Comparison
        The values by name; prints as a table, plots itself.

    Raises
    ------
    ValueError
        An unknown preset or measure, and whatever a measure refuses.
    TypeError
        A curve does not hold real numbers.

    Notes
    -----
    Time O(n m) for frechet and dtw, O(200 (n + m)) for pcm; memory O(n + m).

    Examples
    --------
    >>> import curvewise
    >>> print(curvewise.compare([(0, 0), (1, 1), (2, 0)], [(0, 1), (1, 2), (2, 1)]))
    area          1
    pcm           2.23607
    frechet       1
    dtw           3
    curve_length  2.40113
    """
    P, Q = (curve.copy() for curve in as_curves(P, Q))
    if not isinstance(preset, str) or preset not in PRESETS:
        raise ValueError(f"unknown preset {preset!r}; choose from {', '.join(PRESETS)}")
    if measures is None:
        measures = list(_MEASURES) if P.ndim == 2 and P.shape[1] == 2 else _ANY_DIMENSION
    if isinstance(measures, str) or not (names := list(measures)):
        raise ValueError(f"measures is {measures!r}; give a list of names, e.g. ['area', 'dtw']")
    for name in names:
        if not isinstance(name, str) or name not in _MEASURES:
            raise ValueError(f"unknown measure {name!r}; choose from {', '.join(_MEASURES)}")
    conditions = PRESETS[preset]
    values = {
        name: _MEASURES[name](*_prepared(P, Q, conditions[name]), **conditions[name].options)
        for name in names
    }
    return Comparison(P, Q, preset, values)


def _prepared(P: Array, Q: Array, condition: Condition) -> tuple[Array, Array]:
    if not condition.scaled:
        return P, Q
    scaled_p, scaled_q = _measures.normalize(P, Q)
    return scaled_p, scaled_q
