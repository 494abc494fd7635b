"""Successive response surfaces with domain reduction (SDRM)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._extras import required
from ...curves.inputs import Array
from ..problem.ledger import Course, Finish, Ledger
from ..records.evaluation import Evaluation
from ..surfaces.inner_search import CurveSearch
from ..surfaces.surfaces import regression
from .method import NEAR, Method, with_other_defaults
from .starts import WITHIN, nothing_beside

__all__ = ["SDRM"]


@dataclass(frozen=True, kw_only=True, repr=False)
class SDRM(Method, name="sdrm", keeps_curves=True, needs_squares=False):
    """Successive linear response surfaces with domain reduction.

    Suitable for any measure and robust to noise. An iteration takes 5 runs for up to 3 parameters,
    9 for up to 7 and 17 for up to 15. A search takes 14 to about 30 iterations.

    Parameters
    ----------
    gamma_osc, gamma_pan, eta : float, default 0.6, 1.0 and 0.6
        Contraction parameters of Stander & Craig: for oscillation, for panning, and for zooming if
        the optimum stays in the middle.
    initial_range : float, optional
        Size of the first region, around the start or the middle of the bounds, as a fraction of the
        bounds' range. The default is 1.0, or 0.1 if :func:`identify_each` begins near the end of
        another search.
    tol : float, default 1e-3
        The search ends if all ranges are below this fraction of the bounds' range.
    maxiter : int, default 50
        Maximum number of iterations.

    Notes
    -----
    Every iteration runs the model at the centre of a region and at corners of it that an orthogonal
    two-level design selects. Planes are fitted by least squares to every coordinate of every point
    of the curves. The minimiser of the measure of the curves that they predict is the next centre.
    A parameter that keeps moving in one direction keeps its range (panning). If it reverses, or
    stays in the middle, its range shrinks (zooming). Planes average over noise and jumps that
    mislead gradients.

    N. Stander, K. J. Craig, "On the robustness of a simple domain reduction scheme for
    simulation-based optimization", Engineering Computations 19 (2002) 431-450.

    Examples
    --------
    >>> from curvewise.calibration import SDRM
    >>> SDRM(maxiter=30)
    SDRM(maxiter=30)
    """

    gamma_osc: float = 0.6
    gamma_pan: float = 1.0
    eta: float = 0.6
    initial_range: float | None = None
    tol: float = 1e-3
    maxiter: int = 50

    def fewest_runs(self, parameters: int, *, has_start: bool) -> int:
        """Return the runs of the iterations after which no range is above 1e-3."""
        return 14 * (_design_rows(parameters) + 1)

    def near_optimum(self) -> SDRM:
        """Return the same with a small first region."""
        return with_other_defaults(self, initial_range=NEAR)

    def course(self, ledger: Ledger, start: Array | None, seed: int) -> Course:
        """Minimise by successive linear response surfaces."""
        random = np.random.default_rng(seed)
        k = ledger.dimensions
        centre = np.full(k, 0.5) if start is None else start
        size = np.full(k, 1.0 if self.initial_range is None else self.initial_range)
        move = np.zeros(k)
        inner = CurveSearch(ledger.objective, self.tol, ledger.show_activity)
        for _ in range(self.maxiter):
            low, high = np.clip((centre - size / 2, centre + size / 2), 0.0, 1.0)
            points = np.vstack((centre, np.where(_design(k, random) > 0, high, low)))
            done = yield points
            good = [i for i, evaluation in enumerate(done) if not evaluation.failed]
            target = ledger.best_unit  # used if too few runs succeeded to fit a plane
            if len(good) > k:
                runs = [inner.taken(done[i])[0] for i in good]
                places = points[good]
                planes = regression(places, np.array(runs), places.mean(axis=0))
                target = inner.lowest(planes, centre, low, high)
            last_move, move = move, np.clip(2.0 * (target - centre) / size, -1.0, 1.0)
            size = size * self._contraction(last_move, move)
            centre = target
            if size.max() < self.tol:
                (end,) = yield centre[np.newaxis]
                return self._finish(ledger, end)
        return Finish(False, f"maxiter = {self.maxiter} iterations")

    def _finish(self, ledger: Ledger, end: Evaluation) -> Finish:
        """Return the ending; the ranges also vanish at a place above an earlier run."""
        message = f"all ranges below {self.tol:g} of the bounds"
        first = next(run.value for run in ledger.done if not run.failed)
        is_best = end.value <= ledger.best.value * (1.0 + WITHIN) + nothing_beside(first)
        if is_best and not end.failed:
            return Finish(True, message)
        above = "failed" if end.failed else f"has {end.value:.3g}"
        return Finish(
            False,
            f"{message}, but the last run {above}, and the best one {ledger.best.value:.3g}",
            reason='the method "sdrm" ended away from the best run; use another method or start',
        )

    def _contraction(self, last_move: Array, move: Array) -> Array:
        """Return by what every range is multiplied, of its last two moves in [-1, 1]."""
        turning = last_move * move
        turning = np.sign(turning) * np.sqrt(np.abs(turning))
        gamma = (self.gamma_pan * (1.0 + turning) + self.gamma_osc * (1.0 - turning)) / 2.0
        factor: Array = self.eta + np.abs(move) * (gamma - self.eta)
        return factor


def _design_rows(k: int) -> int:
    """Return the next power of two above k, at least 4."""
    return max(4, 1 << k.bit_length())


def _design(k: int, random: np.random.Generator) -> Array:
    """Return an orthogonal design of k columns of -1 and 1, of a Hadamard matrix.

    The columns are drawn again each time, so that interactions do not always bias the same way.
    """
    rows = _design_rows(k)
    columns = required("scipy.linalg").hadamard(rows)[:, 1 + random.permutation(rows - 1)[:k]]
    signs: Array = columns * random.choice((-1.0, 1.0), k)
    return signs
