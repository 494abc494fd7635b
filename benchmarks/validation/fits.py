"""Every public test, fitted by the defaults of `curvewise fit`, and by scipy from fifty places.

    python fits.py

For each test and material: the deviation (root mean square, MPa), how far the sum of squares is
above scipy's best of fifty random starts with the same slopes, runs of the model (in wider bounds,
too), those of the same search where the model does not say its slopes (in the bounds read off the
test alone), CPU seconds of the fit with its intervals, and what is not determined; "limit": at 0,
or a yield surface as large as the bounding surface; "wider": in bounds wider than those read off
the test, at one of which it had ended; "bound": at one still. Writes results/fits.md. Some minutes
on one core; the tests are those of CURVEWISE_DATA.
"""

from __future__ import annotations

import logging
import time
import warnings

import numpy as np
from places import DATA, RESULTS
from scipy.optimize import least_squares

from curvewise import read_curve
from curvewise.calibration import identify
from curvewise.calibration.problem.space import Space
from curvewise.fitting import MaterialFit, fit_material
from curvewise.fitting.driven_tests import fit_criterion, fit_method
from curvewise.materials import ChabocheVoce, Material, YoshidaUemori

MATERIALS = {"Chaboche–Voce, 2": ChabocheVoce(2), "Yoshida–Uemori": YoshidaUemori()}
STARTS = 50
HEADER = (
    "| test | material | rms, MPa | above scipy's best of 50 | runs | without slopes | s "
    "| not determined |\n"
    "|---|---|---:|---:|---:|---:|---:|---|\n"
)


def tests() -> dict[str, np.ndarray]:
    """Return strain and stress of every test, by its file's name."""
    found = {}
    for path in sorted([*(DATA / "loops").glob("*.csv"), *(DATA / "cyclic").glob("*.csv")]):
        if path.stem.startswith("lcf"):
            found[path.stem] = read_curve(path, ["Strain 1 (%)", "Stress"], factors=[0.01, 1.0])
        elif path.stem.endswith("example_3"):
            found[path.stem] = read_curve(path, ["e_true", "Sigma_true"])
        else:
            found[path.stem] = read_curve(path)
    return found


def best_by_scipy(material: Material, test: np.ndarray, space: Space) -> float:
    """Return the smallest sum of squares that scipy finds, MPa²."""
    strain, stress = test.T

    def residuals(unit: np.ndarray) -> np.ndarray:
        try:
            return material.stress(strain, space.dictionary(space.point(unit))) - stress
        except ValueError:  # softened to nothing, say
            return np.full(len(stress), 1e4)

    def slopes(unit: np.ndarray) -> np.ndarray:
        try:
            by = material.stress_and_slopes(strain, space.dictionary(space.point(unit)))[1]
        except ValueError:
            return np.zeros((len(stress), len(space.names)))
        order = [material.names.index(name) for name in space.names]
        return by[:, order] @ space.differential(unit)

    random = np.random.default_rng(0)
    best = np.inf
    for _ in range(STARTS):
        begin = random.random(len(space.names))
        found = least_squares(
            residuals, begin, slopes, bounds=(0.0, 1.0), x_scale="jac", xtol=1e-9, max_nfev=200
        )
        best = min(best, 2.0 * found.cost)
    return best


def runs_without_slopes(fit: MaterialFit, test: np.ndarray) -> int:
    """Return how many runs the same search takes of a model that says stresses alone."""
    return identify(
        lambda parameters: fit.model(parameters),
        list(fit.tests),
        fit.material.bounds_from(test),
        measure=fit_criterion("sum_of_squares"),
        method=fit_method("sum_of_squares"),
        progress=False,
    ).evaluations


def name_and_place(fit: MaterialFit, name: str) -> str:
    """Return the name of a parameter, and where among its bounds it has ended, if that matters."""
    assert fit.uncertainty is not None
    if name in fit.uncertainty.at_limits:
        return f"{name} (limit)"
    if name in fit.uncertainty.at_bounds:
        return f"{name} ({fit.uncertainty.at_bounds[name]} bound)"
    return f"{name} (wider)" if fit.beyond is not None and name in fit.beyond.sides else name


def main() -> None:
    warnings.simplefilter("ignore")
    logging.disable(logging.WARNING)
    text = HEADER
    for name, test in tests().items():
        for label, material in MATERIALS.items():
            began = time.process_time()
            fit = fit_material(test, material, progress=False)
            seconds = time.process_time() - began
            (compared,) = fit.tests
            stress = material.stress(compared[:, 0], fit.parameters)
            squares = float(((stress - compared[:, 1]) ** 2).sum())
            best = best_by_scipy(material, compared, fit.found.problem.space)
            determined = fit.uncertainty.determined.items()
            loose = [name_and_place(fit, name) for name, good in determined if not good]
            row = (
                f"| {name} | {label} | {np.sqrt(squares / len(stress)):.3g} | "
                f"{100.0 * (squares / best - 1.0):+.3f} % | {fit.runs} | "
                f"{runs_without_slopes(fit, test)} | {seconds:.1f} | {', '.join(loose) or '–'} |"
            )
            print(row, flush=True)
            text += row + "\n"
    (RESULTS / "fits.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
