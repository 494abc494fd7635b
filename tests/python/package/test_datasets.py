"""The built-in hysteresis pair and its material model."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from curvewise.datasets import hysteresis_pair, kinematic_hardening

E, YIELD = 200e3, 300.0
BACKSTRESSES = ((80e3, 400.0), (5e3, 20.0))
CYCLE = [0.0, 0.02, -0.02, 0.02, -0.01, 0.015]


def sampled(turns, steps):
    """Return a path through `turns` in `steps` even steps per branch, without repeated points."""
    branches = [np.linspace(a, b, steps + 1)[1:] for a, b in pairwise(turns)]
    return np.concatenate([turns[:1], *branches])


def explicit_euler(strain):
    """Integrate the rate equations by small explicit steps: no closed form, no Newton."""
    sigma, centres, stress = 0.0, [0.0, 0.0], [0.0]
    for step in np.diff(strain):
        n = math.copysign(1.0, step)
        if n * (sigma + E * step - sum(centres)) < YIELD:
            sigma += E * step
        else:
            hardening = sum(C - g * n * X for (C, g), X in zip(BACKSTRESSES, centres, strict=True))
            p = abs(step) * E / (E + hardening)
            centres = [
                X + C * n * p - g * X * p for (C, g), X in zip(BACKSTRESSES, centres, strict=True)
            ]
            sigma = sum(centres) + n * YIELD
        stress.append(sigma)
    return np.array(stress)


def test_model_follows_its_rate_equations():
    strain = sampled(CYCLE, 20_000)
    np.testing.assert_allclose(kinematic_hardening(strain), explicit_euler(strain), atol=0.5)


def test_model_does_not_depend_on_the_step():
    coarse, fine = (kinematic_hardening(sampled(CYCLE, steps)) for steps in (1, 1000))
    np.testing.assert_allclose(coarse, fine[::1000], rtol=1e-11)


def test_model_agrees_with_the_closed_form_of_monotonic_loading():
    strain = np.linspace(0.002, 0.1, 50)
    stress = kinematic_hardening(strain)
    plastic = strain - stress / E
    expected = YIELD + sum(C / g * (1.0 - np.exp(-g * plastic)) for C, g in BACKSTRESSES)
    np.testing.assert_allclose(stress, expected, rtol=1e-12)


def test_model_is_elastic_below_yield_and_odd():
    strain = np.linspace(-0.0015, 0.0015, 9)
    np.testing.assert_allclose(kinematic_hardening(strain), E * strain, rtol=1e-15)
    path = sampled(CYCLE, 10)
    np.testing.assert_array_equal(kinematic_hardening(-path), -kinematic_hardening(path))


def test_linear_hardening_and_ideal_plasticity_are_special_cases():
    strain = np.array([0.01, 0.02, 0.03])
    linear = kinematic_hardening(strain, backstresses=[(50e3, 0.0)])
    np.testing.assert_allclose(np.diff(linear), 0.01 * E * 50e3 / (E + 50e3), rtol=1e-12)
    ideal = kinematic_hardening([0.01, -0.01], backstresses=[])
    np.testing.assert_allclose(ideal, [300.0, -300.0], rtol=1e-12)


def test_back_stress_saturates_however_long_the_step():
    limit = YIELD + sum(C / g for C, g in BACKSTRESSES)
    np.testing.assert_allclose(kinematic_hardening([50.0, -50.0]), [limit, -limit], rtol=1e-9)


def test_absurd_strain_ends():
    assert kinematic_hardening([1e308, -1e308]).shape == (2,)


def test_model_accepts_no_points_and_leaves_its_input_alone():
    assert kinematic_hardening([]).shape == (0,)
    strain = np.array([0.0, 0.01])
    kinematic_hardening(strain)
    np.testing.assert_array_equal(strain, [0.0, 0.01])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"strain": [[0.0, 0.1]]}, r"strain has shape \(1, 2\); give one value per point"),
        ({"strain": [0.0, np.nan]}, r"strain\[1\] is nan; strains must be finite"),
        ({"strain": [-np.inf]}, r"strain\[0\] is -inf; strains must be finite"),
        ({"strain": [0.0], "youngs_modulus": 0.0}, "youngs_modulus is 0.0; it must be above 0"),
        ({"strain": [0.0], "youngs_modulus": np.nan}, "youngs_modulus is nan; it must be above 0"),
        ({"strain": [0.0], "yield_stress": -1.0}, "yield_stress is -1.0; it must be at least 0"),
        (
            {"strain": [0.0], "backstresses": [(1.0, 1.0), (1.0, -2.0)]},
            r"backstresses\[1\] is \(1.0, -2.0\); both must be at least 0",
        ),
    ],
)
def test_model_says_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        kinematic_hardening(**arguments)


def test_pair_is_the_same_every_time_and_everywhere():
    experiment, simulation = hysteresis_pair()
    again, _ = hysteresis_pair(seed=0)
    np.testing.assert_array_equal(experiment, again)
    # Written down once: another platform or numpy must give these too, to rounding.
    np.testing.assert_allclose(
        experiment[[1, 60, 150, 240]],
        [
            [8.80713610886e-06, 8.7600607292],
            [0.0200251460442, 637.004545928],
            [-0.0199735790273, -678.19711165],
            [0.0201280845301, 673.287243461],
        ],
        rtol=1e-9,
    )
    np.testing.assert_allclose(
        simulation[[30, 90, 150]],
        [[0.02, 572.338194349], [-0.02, -587.249793564], [0.02, 579.706470342]],
        rtol=1e-12,
    )


def test_seed_changes_the_experiment_only():
    np.random.seed(5)  # noqa: NPY002 - the global generator must neither matter nor advance
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    (first, simulation), (second, same_simulation) = hysteresis_pair(), hysteresis_pair(seed=1)
    np.testing.assert_array_equal(np.random.get_state()[1], before)  # noqa: NPY002
    np.testing.assert_array_equal(simulation, same_simulation)
    assert not np.isclose(first[:, 1], second[:, 1]).any()


@pytest.mark.parametrize("seed", range(20))
def test_experiment_is_uneven_noisy_and_near_the_simulation(seed):
    experiment, simulation = hysteresis_pair(seed=seed)
    assert experiment.shape == (241, 2)
    assert simulation.shape == (151, 2)
    assert experiment.dtype == simulation.dtype == np.float64
    for turns, curve in (((0, 60, 150, 240), experiment), ((0, 30, 90, 150), simulation)):
        for sign, start, end in zip((1, -1, 1), turns[:-1], turns[1:], strict=True):
            gaps = sign * np.diff(curve[start : end + 1, 0])
            assert (gaps > 0.0).all()
            evenness = gaps.max() / gaps.min()
            assert evenness > 5.0 if curve is experiment else evenness < 1.0 + 1e-9
        np.testing.assert_allclose(curve[list(turns[1:]), 0], [0.02, -0.02, 0.02], rtol=0.0201)
    # Along the nearly straight end of the last branch, the residual of a line fit is the noise.
    tail = experiment[experiment[:, 0].argmin() :][-40:]
    noise = tail[:, 1] - np.polyval(np.polyfit(*tail.T, 2), tail[:, 0])
    assert 2.0 < noise.std() < 7.0
    # The simulation is wrong by more than the noise and by less than a different material.
    misfit = np.interp(simulation[:30, 0], *experiment[:61].T) - simulation[:30, 1]
    assert 15.0 < np.sqrt((misfit**2).mean()) < 80.0
