"""A material as an overlay of CalculiX's layers: elements on the same nodes.

In Besseling's overlay, layers share the strain and add their stresses. A layer has the modulus E,
the yield strain y and the plastic strain p. It yields at E y (1 + R (1 - exp(-r p))). Once softer
layers yield, the sum has a rounded curve and yields early after a reversal. If y, R and r are
given, all stresses are linear in the modulus. The best layers among a few dozen are therefore a
problem of non-negative least squares (Lawson & Hanson), whose solution has few non-zero layers. The
equations are reweighted several times to reduce the largest error (Lawson). Layers with a
negligible contribution are removed while the error allows it.

Layers are integrated as in CalculiX, for finite strains with radial return (Simo & Hughes 1998,
9.3), at the material's lateral contraction. The sum of lateral stresses must vanish. The fitted
quantity is the difference of axial and lateral stress, which barely depends on the remaining
lateral stress. Cost: 80 increments for each branch, and 12 least-squares problems for each removed
layer: about a second for a loop.

J. F. Besseling, "A theory of elastic, plastic, and creep deformations of an initially isotropic
material showing anisotropic strain hardening, creep recovery, and secondary creep", Journal of
Applied Mechanics 25 (1958) 529-536.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..._extras import extra
from ...curves.inputs import Array
from ...curves.turns import turning_points

__all__ = ["Overlay", "Path", "best_overlay", "with_increments"]

_INCREMENTS = 160  # of a branch
_FITTED = 2  # every second of them is fitted, and all tell the error
_YIELD_STRAINS = 12  # above the first
_GROWTHS = [(growth, rate) for rate in (15.0, 40.0, 100.0, 300.0) for growth in (1.0, 4.0, -0.7)]
_STEEPEST = 0.3  # softening of a layer, relative to its modulus: below 1 it has one answer
_WEIGHTINGS = 12
_SUM_WEIGHT = 100.0  # of the equation for the sum of moduli, which is all but exact
_GOOD = 3e-3  # of the loop's height: no need to be better


class Path(NamedTuple):
    """Strains along and across that a material undergoes from 0, and its stress."""

    axial: Array
    lateral: Array
    stress: Array


class Overlay(NamedTuple):
    """Layers, one entry each, and how near they come: the error's share of the loop's height."""

    modulus: Array
    yield_strain: Array
    growth: Array
    rate: Array
    error: float


def with_increments(strain: Array) -> Array:
    """Return the path from 0 through the turning points of a strain, dense behind each of them."""
    strain = np.concatenate(([0.0], strain))
    ends = [0.0, *strain[turning_points(strain, reversal=0.02)].tolist(), float(strain[-1])]
    shares = np.linspace(0.0, 1.0, _INCREMENTS + 1)[1:] ** 1.5
    return np.concatenate([a + (b - a) * shares for a, b in pairwise(ends)])


def best_overlay(
    paths: Sequence[Path], modulus: float, first: float, own: tuple[float, float], poisson: float
) -> Overlay:
    """Return the layers that follow the material along paths.

    Parameters
    ----------
    paths : sequence of Path
    modulus : float
        Young's modulus, the sum of the layers'.
    first : float
        The strain at which the material yields, and the first layers.
    own : (float, float)
        Growth of the material's yield stress, as a share of it, and its rate.
    poisson : float
        Poisson's ratio of all layers.
    """
    yields, growths, rates = _candidates(paths, first, own).T
    equations = _Equations(paths, yields, growths, rates, modulus, poisson)
    chosen = np.arange(len(yields), dtype=np.int64)
    moduli, error = equations.solution(chosen)
    enough = max(_GOOD * equations.height, 1.1 * error)
    while True:
        kept = moduli > 0.0
        chosen, moduli = chosen[kept], moduli[kept]
        if len(chosen) == 1:
            break
        fewer = np.delete(chosen, np.argmin(moduli * yields[chosen]))
        found, error = equations.solution(fewer)
        if error > enough:
            break
        chosen, moduli = fewer, found
    moduli *= modulus / moduli.sum()
    layers = (yields[chosen], growths[chosen], rates[chosen])
    errors = [
        _free_response(_Layers(*layers, poisson), moduli, path) - path.stress for path in paths
    ]
    return Overlay(moduli, *layers, max(map(_largest, errors)) / equations.height)


def _candidates(paths: Sequence[Path], first: float, own: tuple[float, float]) -> Array:
    """Return yield strain, growth and its rate of each layer that may be chosen, (layers, 3)."""
    longest = max(float(np.ptp(path.axial)) for path in paths)
    strains = [first, *np.geomspace(1.1 * first, max(0.4 * longest, 3.0 * first), _YIELD_STRAINS)]
    return np.array(
        [
            (strain, growth, rate)
            for strain in strains
            for growth, rate in (own, *_GROWTHS)
            if (growth, rate) == own or -growth * rate * strain < _STEEPEST
        ]
    )


class _Equations:
    """The target of the sum of layers along the paths, linear in their moduli."""

    def __init__(
        self,
        paths: Sequence[Path],
        yields: Array,
        growths: Array,
        rates: Array,
        modulus: float,
        poisson: float,
    ) -> None:
        paths = [Path(*(column[_FITTED - 1 :: _FITTED] for column in path)) for path in paths]
        responses = [_responses(_Layers(yields, growths, rates, poisson), path) for path in paths]
        self._difference = np.concatenate([axial - lateral for axial, lateral in responses])
        self._lateral = np.concatenate([lateral for _, lateral in responses])
        self._stress = np.concatenate([path.stress for path in paths])
        self._modulus = modulus
        self.height = float(np.ptp(self._stress))

    def solution(self, chosen: npt.NDArray[np.int64]) -> tuple[Array, float]:
        """Return moduli for the layers chosen, and the largest error of the stress."""
        with extra("calibration", "an overlay for CalculiX needs scipy"):
            nnls = import_module("scipy.optimize").nnls

        difference, lateral = self._difference[:, chosen], self._lateral[:, chosen]
        total = np.full((1, len(chosen)), _SUM_WEIGHT)
        best, least = np.zeros(len(chosen)), np.inf
        weights = np.ones(len(self._stress))
        for _ in range(_WEIGHTINGS):
            rows = np.vstack((difference * weights[:, None], lateral, total))
            target = (self._stress * weights, 0.0 * weights, [_SUM_WEIGHT * self._modulus])
            moduli = nnls(rows, np.concatenate(target))[0]
            errors = np.abs(difference @ moduli - self._stress)
            if (largest := _largest(errors)) < least:
                best, least = moduli, largest
            if largest == 0.0:
                break
            weights *= np.sqrt(0.1 + errors / largest)
            weights /= np.sqrt(np.mean(weights**2))
        return best, least


def _largest(values: Array) -> float:
    return float(np.abs(values).max())


class _Layers:
    """Layers of the modulus 1, driven step by step by strains along and across."""

    def __init__(self, yields: Array, growths: Array, rates: Array, poisson: float) -> None:
        self._yields, self._growths, self._rates = yields, growths, rates
        self._shear, self._bulk = 0.5 / (1.0 + poisson), 1.0 / (3.0 * (1.0 - 2.0 * poisson))
        # The elastic left Cauchy-Green tensor without its volume, along and across; plastic strain.
        self.state: tuple[Array, ...] = (
            np.ones(len(yields)),
            np.ones(len(yields)),
            np.zeros(len(yields)),
        )
        self.strain = (0.0, 0.0)

    def stresses(self, axial: float, lateral: float) -> tuple[Array, Array, tuple[Array, ...]]:
        """Return axial and lateral stresses at these strains, and the state there."""
        along, across, plastic = self.state
        stretch = 2.0 / 3.0 * ((axial - self.strain[0]) - (lateral - self.strain[1]))
        along, across = along * np.exp(2.0 * stretch), across * np.exp(-stretch)
        mean = (along + 2.0 * across) / 3.0
        trial = self._shear * (along - across)
        stiffness = 3.0 * self._shear * mean
        step = np.zeros(len(plastic))
        for _ in range(12):  # Newton; the yield stress bends one way, so it ends from one side
            decay = self._growths * np.exp(-self._rates * (plastic + step))
            radius = self._yields * (1.0 + self._growths - decay)
            over = np.abs(trial) - stiffness * step - radius
            step = np.maximum(step + over / (stiffness + self._yields * self._rates * decay), 0.0)
        difference = trial - stiffness * np.sign(trial) * step
        volume = np.exp(axial + 2.0 * lateral)
        pressure = 0.5 * self._bulk * (volume - 1.0 / volume)
        state = (
            mean + 2.0 / 3.0 * difference / self._shear,
            mean - difference / (3.0 * self._shear),
            plastic + step,
        )
        third = difference / (3.0 * volume)
        return pressure + 2.0 * third, pressure - third, state


def _responses(layers: _Layers, path: Path) -> tuple[Array, Array]:
    """Return axial and lateral stresses of each layer along a path, (n, layers) each."""
    axial, lateral = [], []
    for strain in zip(path.axial.tolist(), path.lateral.tolist(), strict=True):
        along, across, layers.state = layers.stresses(*strain)
        layers.strain = strain
        axial.append(along)
        lateral.append(across)
    return np.array(axial), np.array(lateral)


def _free_response(layers: _Layers, moduli: Array, path: Path) -> Array:
    """Return the stress of the overlay where it contracts until no lateral stress is left."""
    found = []
    offset = 0.0  # from the material's lateral strain
    for axial, near in zip(path.axial.tolist(), path.lateral.tolist(), strict=True):
        first, second = near + offset, near + offset + 1e-6
        left = float(moduli @ layers.stresses(axial, first)[1])
        for _ in range(20):  # the secant method
            along, across, state = layers.stresses(axial, second)
            now = float(moduli @ across)
            if abs(now) <= 1e-9 * float(moduli.sum()) or now == left:
                break
            first, second, left = second, second - now * (second - first) / (now - left), now
        layers.state, layers.strain, offset = state, (axial, second), second - near
        found.append(float(moduli @ along))
    return np.array(found)
