"""The criterion of an objective: a measure and the curves' preparation.

A criterion holds the settings of an objective together, from `identify`, `rescore` and similar
functions to the terms of an objective. They are checked once, when the criterion is created. Cost:
negligible.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from inspect import signature
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from ..._names import did_you_mean
from ..._options import Default, Missing, Preset, check_choice
from ...measures import registry
from ...measures.registry import PRESETS, Condition

__all__ = [
    "LEAST_SQUARES",
    "MEASURES",
    "Criterion",
    "Measure",
    "Part",
    "criterion_as_code",
    "criterion_of",
]

MEASURES = (*registry.MEASURES, "sum_of_squares")
# Measures that add up squares of differences.
LEAST_SQUARES = (
    *(name for name, info in registry.MEASURES.items() if info.residuals),
    "sum_of_squares",
)

Part: TypeAlias = Literal["experiment", "simulation"]


# Shared text: measure(criteria)
@dataclass(frozen=True, init=False, repr=False)
class Criterion:
    """A measure with its options, and the preparation of the curves.

    :func:`identify`, :class:`Objective`, :class:`Case`, :func:`rescore`, :func:`cross_validate` and
    :func:`line_plot` accept it instead of a measure's name.

    Parameters
    ----------
    measure : str or callable
        The name of a measure: "area", "pcm", "frechet", "dtw", "curve_length",
        "frechet_continuous", "hausdorff", "hausdorff_continuous", "erp", "edr", "lcss", "msm",
        "twe", "wdtw", "sum_of_squares". Or a function of the experiment, the simulation and the
        options that returns a float. If the function raises ValueError, the simulation has failed.
        "sum_of_squares" sums squared differences of y; the simulation is interpolated linearly at
        the experiment's x, which must not reverse. Its option `abscissa` is the coordinate over
        which y is compared. It is the number of a column, 0 by default (``abscissa=2`` for loops
        whose third column is time or the step). The value "points" compares point by point, for a
        model that is driven by the experiment's x, such as a material point with the measured
        strains.
    preset : {"scaled", "paper", "raw"}
        As for :func:`curvewise.compare`. "scaled" scales curves by their experiment's bounding box,
        so that experiments, and x and y, have the same weight. Its area uses ``spacing="matched"``,
        which barely depends on the simulation's increments. "paper" uses Algorithm 1. With "paper"
        and "raw", sum_of_squares and functions receive the raw curves.
    part : {"experiment", "simulation"}
        Which curve may be a part of the other, for "pcm" and for "dtw" with an open end. Use
        "experiment" for a test that starts late or stops early, which is compared with the whole
        simulation. Use "simulation" for a model of the first branch alone, which is compared with
        the whole test. In that case dtw is computed from the simulation to the experiment, and
        "pcm" ignores `min_coverage`.
    min_coverage : float
        For "pcm": a simulation shorter than this fraction of its experiment's length (both scaled)
        counts as failed, since partial curve mapping rates a part of the curve as good. An
        experiment that is a part of its simulation is the intended use, and passes.
    weights : sequence of float, optional
        A non-negative factor for every experiment; by default 1.
    failure_value : float, optional
        The finite, positive term of an experiment whose simulation failed. The default is 10⁶ times
        the measure of a simulation that is the experiment shifted up by its own range of y. This
        default suits every measure and unit.
    missing : {"refuse", "skip"}, default "refuse"
        Treatment of experimental points with nan in any coordinate. "refuse" raises an error,
        "skip" omits them and warns with their number. A simulation with nan has failed in both
        cases.
    **options
        Options of the measure; they override the preset's.

    Raises
    ------
    ValueError
        If the measure, preset, part or `missing` is unknown. If a part is given for a measure of
        whole curves. If a number is out of its range.
    TypeError
        If the measure does not have an option.

    Examples
    --------
    >>> from curvewise.calibration import Criterion, Objective
    >>> criterion = Criterion("dtw", preset="raw", weights=[1, 2], window=3)
    >>> criterion
    Criterion('dtw', preset='raw', weights=[1.0, 2.0], window=3)
    >>> Objective([[(0, 0), (1, 1)], [(0, 0), (1, 1)]], criterion)([[(0, 1), (1, 2)]] * 2)
    6.0
    """

    measure: str | Callable[..., float]
    preset: Preset
    part: Part
    min_coverage: float
    weights: tuple[float, ...] | None
    failure_value: float | None
    missing: Missing
    options: dict[str, Any] = field(hash=False)

    def __init__(
        self,
        measure: str | Callable[..., float] = "area",
        *,
        preset: Preset = "scaled",
        part: Part = "experiment",
        min_coverage: float = 0.5,
        weights: Sequence[float] | None = None,
        failure_value: float | None = None,
        missing: Missing = Default.missing,
        **options: Any,
    ) -> None:
        if not callable(measure):
            check_choice("measure", measure, MEASURES)
        check_choice("preset", preset, tuple(PRESETS))
        check_choice("part", part, ("experiment", "simulation"))
        check_choice("missing", missing, get_args(Missing))
        _check_options(measure, options, _SETTINGS)
        if not 0.0 <= min_coverage <= 1.0:
            raise ValueError(f"min_coverage is {min_coverage}; it must be from 0 to 1")
        if failure_value is not None and not 0.0 < failure_value < math.inf:
            raise ValueError(f"failure_value is {failure_value}; it must be finite and above 0")
        for name, value in {
            "measure": measure,
            "preset": preset,
            "part": part,
            "min_coverage": min_coverage,
            "weights": None if weights is None else _checked_weights(weights),
            "failure_value": None if failure_value is None else float(failure_value),
            "missing": missing,
            "options": options,
        }.items():
            object.__setattr__(self, name, value)
        chosen = self.condition.options
        is_open = chosen.get("open_begin", False) or chosen.get("open_end", False)
        if part == "simulation" and measure != "pcm" and not (measure == "dtw" and is_open):
            raise ValueError(
                f"measure {self.name!r} compares whole curves; part='simulation' needs "
                "measure='pcm', or measure='dtw' with open_begin=True or open_end=True"
            )

    def __repr__(self) -> str:
        return f"Criterion({', '.join(_arguments(self.settings))})"

    @property
    def name(self) -> str:
        """The measure's name; of a callable its ``__name__``, or its type's."""
        if isinstance(self.measure, str):
            return self.measure
        return str(getattr(self.measure, "__name__", type(self.measure).__name__))

    @property
    def settings(self) -> dict[str, Any]:
        """The settings for a record: ``Criterion(**settings)`` rebuilds it.

        A function is represented by its name, and cannot be rebuilt.
        """
        weights = None if self.weights is None else list(self.weights)
        named = {name: getattr(self, name) for name in _SETTINGS}
        return {"measure": self.name, **named, "weights": weights, **self.options}

    @property
    def is_of_the_registry(self) -> bool:
        """Whether the measure is one that :func:`curvewise.compare` has too."""
        return not callable(self.measure) and self.measure in registry.MEASURES

    @property
    def condition(self) -> Condition:
        """Whether curves are scaled first, and the measure's options with those of the preset."""
        if not self.is_of_the_registry:
            return Condition(self.preset == "scaled", self.options)
        scaled, options = PRESETS[self.preset][self.name]
        return Condition(scaled, {**options, **self.options})

    def weighing(self, weights: Sequence[float] | None) -> Criterion:
        """Return the same criterion with other weights."""
        return Criterion(**{**self.settings, "measure": self.measure, "weights": weights})


Measure: TypeAlias = str | Callable[..., float] | Criterion
"""What the functions of this package call a measure: a name, a function, or a criterion."""

# The settings other than the measure and its options, with their defaults.
_SETTINGS = {
    name: parameter.default
    for name, parameter in signature(Criterion).parameters.items()
    if name not in ("measure", "options")
}


def criterion_of(
    measure: Measure, options: Mapping[str, Any], others: Iterable[str] = ()
) -> Criterion:
    """Return the criterion that a function is given as `measure` and further keywords.

    Parameters
    ----------
    measure
        The criterion itself, or a measure whose options the keywords are.
    options
        The keywords.
    others
        Further candidates for a misspelt keyword: arguments of that function.
    """
    if isinstance(measure, Criterion):
        if options:
            raise TypeError(f"{', '.join(options)} given together with a Criterion; set them there")
        return measure
    if own := [name for name in options if name in _SETTINGS]:
        settings = ", ".join(f"{name}=..." for name in own)
        shown = repr(measure) if isinstance(measure, str) else "..."
        raise TypeError(
            f"{', '.join(own)} given as a keyword; use measure=Criterion({shown}, {settings})"
        )
    if callable(measure) or measure in MEASURES:
        _check_options(measure, options, (*_SETTINGS, *others))
    return Criterion(measure, **options)


def criterion_as_code(settings: Mapping[str, Any]) -> str:
    """Return the argument that creates a criterion of these settings."""
    arguments = _arguments(settings)
    return f"Criterion({', '.join(arguments)})" if len(arguments) > 1 else arguments[0]


def _arguments(settings: Mapping[str, Any]) -> list[str]:
    """Return the measure, and the settings that are not the defaults, as in a call."""
    given = [
        f"{name}={value!r}"
        for name, value in settings.items()
        if name != "measure" and (name not in _SETTINGS or value != _SETTINGS[name])
    ]
    return [repr(settings["measure"]), *given]


def _check_options(
    measure: str | Callable[..., float], given: Iterable[str], others: Iterable[str]
) -> None:
    """Refuse options that a measure does not have."""
    known = _option_names(measure)
    if known is None or not (unknown := [name for name in given if name not in known]):
        return
    name = measure if isinstance(measure, str) else getattr(measure, "__name__", "the measure")
    raise TypeError(
        f"{name} has no option {', '.join(map(repr, unknown))}; it has {', '.join(known) or 'none'}"
        f"{did_you_mean(unknown, [*known, *others])}"
    )


def _option_names(measure: str | Callable[..., float]) -> list[str] | None:
    """Return the names of a measure's options; None if it takes any."""
    if measure == "sum_of_squares":
        return ["abscissa"]
    function = registry.MEASURES[measure].function if isinstance(measure, str) else measure
    try:
        parameters = list(signature(function).parameters.values())
    except ValueError:  # of a builtin
        return None
    if any(p.kind is p.VAR_KEYWORD for p in parameters):
        return None
    curves = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)][:2]
    named = [p for p in parameters if p.kind in (p.KEYWORD_ONLY, p.POSITIONAL_OR_KEYWORD)]
    return [p.name for p in named if p not in curves]


def _checked_weights(weights: Sequence[float]) -> tuple[float, ...]:
    array = np.asarray(weights, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"weights has shape {array.shape}; give one for each experiment")
    if not (np.isfinite(array).all() and (array >= 0).all() and array.any()):
        raise ValueError("weights must be finite, not negative, and not all 0")
    return tuple(array.tolist())
