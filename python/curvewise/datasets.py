"""A generated hysteresis pair, and the material model behind it.

The model is 1-D plasticity with nonlinear kinematic hardening: a yield surface of fixed size whose
centre is the back stress. The back stress follows Armstrong and Frederick's law; several such terms
are added, as Chaboche does. A step of strain is integrated exactly. The back stresses have a closed
form in the plastic strain, which leaves one scalar equation. The equation is convex and decreasing,
and Newton's method solves it from the left without overshooting. Cost: O(n) steps of a few
iterations each, in Python, since every step starts where the last one ended (a few microseconds per
point).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ._names import names_alone
from .curves.checks import check_finite
from .curves.named_curve import NamedCurve

__all__ = ["hysteresis_pair", "kinematic_hardening"]
__dir__ = names_alone(__all__)

# Strain amplitude of the pair's cycle, and where its branches end: tension, compression, tension.
_AMPLITUDE = 0.02
_TURNS = (0.0, _AMPLITUDE, -_AMPLITUDE, _AMPLITUDE)
_NAMES = ("true strain", "true stress, MPa")


def kinematic_hardening(
    strain: npt.ArrayLike,
    *,
    youngs_modulus: float = 200e3,
    yield_stress: float = 300.0,
    backstresses: Sequence[tuple[float, float]] = ((80e3, 400.0), (5e3, 20.0)),
) -> npt.NDArray[np.float64]:
    r"""Compute the stress along a strain path by Chaboche's kinematic hardening.

    With stress :math:`\sigma`, plastic strain :math:`\varepsilon_p`, back stresses :math:`X_k`
    and :math:`\dot p = |\dot\varepsilon_p|`, all 0 at the start:

    .. math::

        \sigma = E (\varepsilon - \varepsilon_p), \qquad
        \left|\sigma - {\textstyle\sum_k X_k}\right| \le \sigma_y, \qquad
        \dot X_k = C_k \dot\varepsilon_p - \gamma_k X_k \dot p

    (factors of 2/3 and 3/2 absorbed into the constants). While plastic flow keeps its direction
    :math:`n = \pm 1`, the last equation gives

    .. math::

        n X_k(p) = n X_k^0 + (C_k - \gamma_k n X_k^0)\, \frac{1 - e^{-\gamma_k p}}{\gamma_k}

    so that a step of strain is integrated exactly, however long, if strain is monotonic in it.

    Parameters
    ----------
    strain : array_like, shape (n,)
        Strain [-] in the order of loading; the first step leads there from the unloaded state.
    youngs_modulus : float, default 200e3
        Young's modulus E [MPa], above 0.
    yield_stress : float, default 300
        Half the size of the elastic range [MPa], at least 0.
    backstresses : sequence of (C, gamma), default ((80e3, 400), (5e3, 20))
        Initial modulus C [MPa] and recall coefficient gamma [-] of each back stress, both at
        least 0. It saturates at C / gamma; gamma = 0 is Prager's linear hardening. An empty
        sequence is ideal plasticity.

    Returns
    -------
    ndarray, shape (n,)
        Stress [MPa].

    Raises
    ------
    ValueError
        If `strain` is not one-dimensional or not finite, or a constant is out of its range.

    Notes
    -----
    O(n) time and memory.

    References
    ----------
    .. [1] P. J. Armstrong, C. O. Frederick, "A mathematical representation of the multiaxial
       Bauschinger effect", CEGB report RD/B/N731, 1966; reprinted in Materials at High
       Temperatures 24 (2007) 1-26.
    .. [2] J. L. Chaboche, "Time-independent constitutive theories for cyclic plasticity",
       International Journal of Plasticity 2 (1986) 149-188.

    Examples
    --------
    Loaded to 2 %, unloaded and pulled back: yield comes early in compression (Bauschinger).

    >>> from curvewise.datasets import kinematic_hardening
    >>> kinematic_hardening([0.001, 0.02, 0.018, -0.02]).round(2)
    array([ 200.  ,  572.34,  172.34, -587.25])
    """
    path = np.asarray(strain, dtype=np.float64)
    if path.ndim != 1:
        raise ValueError(f"strain has shape {path.shape}; give one value per point, shape (n,)")
    check_finite(path, "strain", "strains")
    _check_constants(youngs_modulus, yield_stress, backstresses)

    centres = [0.0] * len(backstresses)
    plastic_strain = 0.0
    stress = np.empty_like(path)
    for i, total_strain in enumerate(path.tolist()):
        trial = youngs_modulus * (total_strain - plastic_strain)
        n = math.copysign(1.0, trial - sum(centres))
        excess = n * (trial - sum(centres)) - yield_stress
        if excess > 0.0:
            # Modulus C - gamma n X at which each back stress starts this step.
            moduli = [
                C - gamma * n * X for (C, gamma), X in zip(backstresses, centres, strict=True)
            ]
            gammas = [gamma for _, gamma in backstresses]
            p = _plastic_step(excess, youngs_modulus, moduli, gammas)
            plastic_strain += n * p
            centres = [
                X + n * modulus * _grown(gamma, p)
                for X, modulus, gamma in zip(centres, moduli, gammas, strict=True)
            ]
            trial = youngs_modulus * (total_strain - plastic_strain)
        stress[i] = trial
    return stress


def _check_constants(
    youngs_modulus: float, yield_stress: float, backstresses: Sequence[tuple[float, float]]
) -> None:
    if not 0.0 < youngs_modulus < math.inf:
        raise ValueError(f"youngs_modulus is {youngs_modulus}; it must be above 0")
    if not 0.0 <= yield_stress < math.inf:
        raise ValueError(f"yield_stress is {yield_stress}; it must be at least 0")
    for k, (C, gamma) in enumerate(backstresses):
        if not (0.0 <= C < math.inf and 0.0 <= gamma < math.inf):
            raise ValueError(f"backstresses[{k}] is ({C}, {gamma}); both must be at least 0")


def _grown(gamma: float, p: float) -> float:
    """Return (1 - exp(-gamma p)) / gamma, which is p for gamma = 0."""
    return -math.expm1(-gamma * p) / gamma if gamma else p


def _plastic_step(
    excess: float, youngs_modulus: float, moduli: list[float], gammas: list[float]
) -> float:
    """Return the plastic strain p > 0 that brings the stress back to the yield surface.

    It is the root of f(p) = excess - E p - sum_k modulus_k grown_k(p). The moduli are not negative,
    because a back stress never leaves [-C / gamma, C / gamma]. So f is decreasing and convex, and
    Newton's iterates climb from 0 to the root until rounding stops them.
    """
    p, exp, expm1 = 0.0, math.exp, math.expm1  # names found soon: most of the time goes here
    terms = list(zip(moduli, gammas, strict=True))
    while True:
        value = excess - youngs_modulus * p
        slope = youngs_modulus
        for modulus, gamma in terms:
            value -= modulus * (-expm1(-gamma * p) / gamma if gamma else p)  # as _grown
            slope += modulus * exp(-gamma * p)
        step = value / slope
        if not step > 1e-15 * p:
            return p
        p += step


def hysteresis_pair(*, seed: int = 0) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Generate a measured and a simulated hysteresis loop of a sheet steel.

    Both are strain-driven cycles tension, compression, tension (0, +2 %, -2 %, +2 %) of
    `kinematic_hardening`, with different constants. The "experiment" resembles the log of a test
    machine. It is unevenly spaced, densest after each reversal, and reverses up to 2 % early or
    late; the stress has normal noise of standard deviation 4 MPa. The "simulation" is smooth and,
    in each branch, evenly spaced in strain.

    Parameters
    ----------
    seed : int, default 0
        Seed of the experiment's noise and spacing; the simulation is always the same.

    Returns
    -------
    experiment : ndarray, shape (241, 2)
        True strain [-] and true stress [MPa]; plots show these names on their axes.
    simulation : ndarray, shape (151, 2)
        The same quantities of the simulation.

    Notes
    -----
    The random numbers are ``numpy.random.Generator(numpy.random.PCG64(seed)).normal``. NumPy does
    not promise to keep these, and has kept them since version 1.17; platforms differ in the last
    digits of exp and log at most. A call takes a few milliseconds.

    Examples
    --------
    >>> from curvewise.datasets import hysteresis_pair
    >>> experiment, simulation = hysteresis_pair()
    >>> experiment.shape, simulation.shape
    ((241, 2), (151, 2))
    >>> simulation[[30, 90, 150], 1].round(1)  # stress at the three turns
    array([ 572.3, -587.2,  579.7])
    """
    random = np.random.Generator(np.random.PCG64(seed))
    strain = _logged_strain(random)
    stress = kinematic_hardening(
        strain,
        youngs_modulus=195e3,
        yield_stress=330.0,
        backstresses=((110e3, 600.0), (10e3, 60.0), (2e3, 0.0)),
    )
    stress += random.normal(0.0, 4.0, strain.size)
    experiment = NamedCurve(np.column_stack((strain, stress)), _NAMES)

    steps = np.repeat([1.0, -1.0, 1.0], [30, 60, 60]).cumsum()
    strain = np.concatenate(([0.0], steps * (_AMPLITUDE / 30)))
    simulation = np.column_stack((strain, kinematic_hardening(strain)))
    return experiment, NamedCurve(simulation, _NAMES)


def _logged_strain(random: np.random.Generator) -> npt.NDArray[np.float64]:
    """Draw 241 strains along the cycle, as a data logger that samples unevenly would."""
    turns = np.array(_TURNS)
    turns[1:] *= 1.0 + 0.01 * np.clip(random.normal(size=3), -2.0, 2.0)
    pieces = [turns[:1]]
    for start, end, n in zip(turns[:-1], turns[1:], (60, 90, 90), strict=True):
        # Gaps are never 0, so that strain is monotonic in a branch and the model's steps exact.
        run = np.cumsum(0.25 + np.abs(random.normal(size=n)))
        pieces.append(start + (end - start) * (run / run[-1]) ** 1.5)
    return np.concatenate(pieces)
