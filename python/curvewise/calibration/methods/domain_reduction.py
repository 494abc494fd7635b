"""Successive response surfaces with domain reduction (SDRM).

In every iteration the model is run at the corners of a region of interest that an orthogonal
two-level design picks (D-optimal for a linear surface) and at its centre. Planes are fitted by
least squares to every coordinate of every point of the simulated curves, and the parameters at
which the curves that these planes predict have the smallest objective, within the region, become
the centre of the next. A parameter that keeps going the same way keeps its range (panning); where
it turns back, or stays in the middle, the range shrinks (zooming). Simulations that differ in their
number of points (a solver with adaptive steps) are resampled by arc length for the planes.

Linear surfaces average over noise and jumps that mislead gradients. Cost: an iteration takes 5
evaluations for k <= 3 parameters, 9 up to 7, and 17 up to 15. With the default options there are at
least 14 iterations (0.6^14 < 1e-3), more where parameters pan: 16 to 29 in what we have run. Each
also minimises the objective on predicted curves (`surface_minimum`).

N. Stander, K. J. Craig, "On the robustness of a simple domain reduction scheme for
simulation-based optimization", Engineering Computations 19 (2002) 431-450.
"""

from __future__ import annotations

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.evaluations import Evaluations, Finish
from ..surfaces.surface_minimum import SurfaceMinimum
from ..surfaces.surfaces import Responses, Surfaces

__all__ = ["domain_reduction"]


def domain_reduction(
    evaluations: Evaluations,
    start: Array | None,
    seed: int,
    *,
    gamma_osc: float = 0.6,
    gamma_pan: float = 1.0,
    eta: float = 0.6,
    initial_range: float = 1.0,
    tol: float = 1e-3,
    maxiter: int = 50,
) -> Finish:
    """Minimise by successive linear response surfaces.

    Parameters
    ----------
    evaluations : Evaluations
        The objective.
    start : ndarray or None
        Where the first region has its centre; the middle of the bounds if not given.
    seed : int
        Of the random turns of the designs.
    gamma_osc, gamma_pan, eta : float
        The contraction parameters of Stander & Craig: for oscillation, for panning, and for
        zooming where the optimum stays in the middle.
    initial_range : float
        The size of the first region, as a fraction of the bounds' range.
    tol : float
        The search ends where all ranges are below this fraction of the bounds' range.
    maxiter : int
        The most iterations.
    """
    random = np.random.default_rng(seed)
    k = evaluations.dimensions
    centre = np.full(k, 0.5) if start is None else start
    size = np.full(k, initial_range)
    move = np.zeros(k)
    responses: Responses | None = None
    for _ in range(maxiter):
        low, high = np.clip((centre - size / 2, centre + size / 2), 0.0, 1.0)
        points = np.vstack((centre, np.where(_design(k, random) > 0, high, low)))
        done = evaluations.evaluated(points, keep_simulations=True)
        good = [i for i, evaluation in enumerate(done) if not evaluation.failed]
        target = evaluations.best_unit  # what is left if no plane goes through so few points
        if len(good) > k:
            curves = [done[i].simulations or () for i in good]
            if responses is None:
                responses = Responses(curves[0])
                minimum = SurfaceMinimum(
                    evaluations.objective,
                    responses,
                    random,
                    evaluations.negligible,
                    evaluations.thinking,
                )
            planes = _planes(points[good], np.array([responses.vector(c) for c in curves]))
            target = minimum.lowest(planes, centre, (low, high), thoroughly=True)
        last_move, move = move, np.clip(2.0 * (target - centre) / size, -1.0, 1.0)
        size = size * _contraction(last_move, move, gamma_osc, gamma_pan, eta)
        centre = target
        if size.max() < tol:
            evaluations.evaluated(centre[np.newaxis], keep_simulations=True)
            return Finish(True, f"all ranges below {tol:g} of the bounds")
    return Finish(False, f"maxiter = {maxiter} iterations")


def _contraction(
    last_move: Array, move: Array, gamma_osc: float, gamma_pan: float, eta: float
) -> Array:
    """Return by what every range is multiplied, of its last two moves in [-1, 1]."""
    turning = last_move * move
    turning = np.sign(turning) * np.sqrt(np.abs(turning))
    gamma = (gamma_pan * (1.0 + turning) + gamma_osc * (1.0 - turning)) / 2.0
    factor: Array = eta + np.abs(move) * (gamma - eta)
    return factor


def _design(k: int, random: np.random.Generator) -> Array:
    """Return an orthogonal design of k columns of -1 and 1, turned at random.

    Columns of a Hadamard matrix, without its column of ones: as many rows as the next power of
    two above k, at least 4. Which column serves which parameter, and its sign, are drawn anew for
    every iteration, so that interactions between parameters do not bias the plane always alike.
    """
    rows = 4
    while rows <= k:
        rows *= 2
    columns = required("scipy.linalg").hadamard(rows)[:, 1 + random.permutation(rows - 1)[:k]]
    signs: Array = columns * random.choice((-1.0, 1.0), k)
    return signs


def _planes(points: Array, responses: Array) -> Surfaces:
    """Return the planes, one for every column of responses, that fit best."""
    # Centred and scaled: a region may be 1e-3 wide.
    middle = points.mean(axis=0)
    width = np.ptp(points, axis=0)
    width = np.where(width == 0, 1.0, width)
    design = np.column_stack((np.ones(len(points)), (points - middle) / width))
    coefficients: Array = np.linalg.lstsq(design, responses, rcond=None)[0]
    return Surfaces(middle, coefficients[0], coefficients[1:].T / width)
