"""A method that `identify` does not have, "gaussian-process": what it would cost, for methods.py.

A Gaussian process (scikit-learn) for each principal component of the curves, of a Latin hypercube
and of what is run after it; the exact measure is minimised on the curves that the processes
predict. Every fifth run goes where they know least. Their length scales are fitted anew after
every fifth run: each time would take an hour of fitting for a search of some dozen runs.
"""

from __future__ import annotations

import warnings

import numpy as np
from curvewise.calibration.methods.registry.registry import METHODS
from curvewise.calibration.surfaces.surfaces.nelder_mead import nelder_mead
from curvewise.calibration.surfaces.surfaces.surfaces import Responses
from scipy.stats import qmc
from sklearn.decomposition import PCA
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

from curvewise.calibration.problem.evaluations import Finish

COMPONENTS = 8
CANDIDATES = 300
TURN = 5  # runs between two fits of the length scales, and between two runs that explore


def gaussian_process(evaluations, start, seed, *, maxiter=60):
    """Minimise the measure of the curves that Gaussian processes predict, run by run."""
    k = evaluations.dimensions
    random = np.random.default_rng(seed)
    units = qmc.LatinHypercube(k, seed=random).random(2 * k + 3)
    runs = evaluations.evaluated(units, keep_simulations=True)
    kernels = None
    for number in range(maxiter):
        good = [i for i, run in enumerate(runs) if not run.failed]
        responses = Responses(runs[good[0]].simulations)
        vectors = np.array([responses.vector(runs[i].simulations) for i in good])
        curves = _Curves(units[good], vectors, random, kernels if number % TURN else None)
        kernels = curves.kernels
        next_unit = _lowest(curves, responses, evaluations, units, random, number)
        units = np.vstack((units, next_unit))
        runs += evaluations.evaluated(next_unit[np.newaxis], keep_simulations=True)
    return Finish(True, f"{maxiter} runs after the first")


class _Curves:
    """Curves as Gaussian processes of the place in the unit cube."""

    def __init__(self, units, vectors, random, kernels):
        width = np.ptp(vectors, axis=0)
        self._width = np.where(width > 0, width, 1.0)
        self._pca = PCA(min(COMPONENTS, len(units) - 1)).fit(vectors / self._width)
        scores = self._pca.transform(vectors / self._width)
        self._scale = scores.std(axis=0) + 1e-12
        k = units.shape[1]
        first = ConstantKernel(1.0) * RBF(np.full(k, 0.5), (0.05, 20.0)) + WhiteKernel(1e-6)
        components = (scores / self._scale).T
        optimizer = "fmin_l_bfgs_b"
        if kernels is not None and len(kernels) == len(components):
            optimizer = None
        else:
            kernels = [first] * len(components)
        self._processes = []
        for component, kernel in zip(components, kernels, strict=True):
            process = GaussianProcessRegressor(
                kernel, optimizer=optimizer, random_state=int(random.integers(2**31))
            )
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ConvergenceWarning)
                self._processes.append(process.fit(units, component))
        self.kernels = [process.kernel_ for process in self._processes]

    def mean(self, units):
        scores = np.column_stack([p.predict(units) for p in self._processes]) * self._scale
        return self._pca.inverse_transform(scores) * self._width

    def spread(self, units):
        return sum(
            (scale * process.predict(units, return_std=True)[1]) ** 2
            for process, scale in zip(self._processes, self._scale, strict=True)
        )


def _lowest(curves, responses, evaluations, units, random, number):
    """Return the place to run next."""
    k = units.shape[1]
    best = evaluations.best_unit
    near = np.clip(best + random.normal(0.0, 0.1, (CANDIDATES // 2, k)), 0.0, 1.0)
    places = np.vstack((near, random.random((CANDIDATES // 2, k))))
    if number % TURN == TURN - 1:
        return places[np.argmax(curves.spread(places))]

    def value(unit):
        vector = curves.mean(np.clip(unit, 0.0, 1.0)[np.newaxis])[0]
        return evaluations.objective.predicted(responses.curves(vector)).value

    values = [
        evaluations.objective.predicted(responses.curves(vector)).value
        for vector in curves.mean(places)
    ]
    found, _ = nelder_mead(
        value,
        places[int(np.argmin(values))],
        (np.zeros(k), np.ones(k)),
        random,
        negligible=evaluations.negligible,
        size=0.05,
        restarts=0,
        xatol=1e-3,
        fatol=1e-3 * min(values),
        maxfev=20 * k,
    )
    return found


METHODS["gaussian-process"] = {"gaussian-process": gaussian_process}
