"""Energy of loops beside a published curve of cumulative energy, and damping beside a formula."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hysteresis import bilinear, driven

from curvewise.curves import backbone, damping, loop_energy, peaks_and_valleys

DAMPER = Path(__file__).with_name("slit_damper.csv")

# Cumulative deformation [mm] and cumulative energy [kJ] of the same test, read from the paper's own
# figure by C. Slotboom (slit_damper.csv has the source; commit fc208ae4, Hys1_Energy.csv).
PUBLISHED = np.array(
    [
        (54.36, 0.0845), (67.95, 0.1924), (84.63, 0.2644), (100.69, 0.4800), (117.37, 0.6477),
        (131.58, 0.7914), (151.35, 1.0429), (167.41, 1.2106), (182.24, 1.3903), (204.48, 1.7016),
        (222.39, 1.9292), (244.63, 2.2644), (266.25, 2.5877), (294.05, 2.9231), (310.73, 3.2583),
        (331.74, 3.5217), (353.98, 3.8929), (392.90, 4.5394), (442.93, 5.3416), (494.83, 6.1916),
        (548.57, 7.0895),
    ]
)  # fmt: skip


def test_the_energy_of_a_damper_is_the_published_one() -> None:
    """Each amplitude was run three times, and one cycle of each is in the figure."""
    record = np.loadtxt(DAMPER, delimiter=",")
    energy = np.repeat(loop_energy(record, reversal=0.03), 3) / 1e3  # kN mm
    tips = peaks_and_valleys(record, reversal=0.03)[:, :, 0]
    assert tips.shape == (7, 2)
    deformation = np.cumsum(np.repeat(2.0 * np.abs(np.diff(tips, axis=1)[:, 0]), 3))
    published = np.interp(deformation, *PUBLISHED.T)
    ends = np.array([8, 11, 14, 17, 20])  # third cycles of the five larger amplitudes
    ours, theirs = np.cumsum(energy)[ends], published[ends]
    assert ours[-1] - ours[0] == pytest.approx(theirs[-1] - theirs[0], rel=0.03)
    assert np.diff(ours)[1:] == pytest.approx(np.diff(theirs)[1:], rel=0.05)
    assert np.diff(ours)[0] == pytest.approx(np.diff(theirs)[0], rel=0.10)


def test_the_backbone_of_a_damper_goes_through_its_tips() -> None:
    record = np.loadtxt(DAMPER, delimiter=",")
    curve = backbone(record, reversal=0.03)
    assert len(curve) == 15
    assert np.all(np.diff(curve[:, 1]) > -0.2)
    assert curve[-1] == pytest.approx((12.039, 25.06), abs=0.01)


@pytest.mark.parametrize("ductility", [1.5, 2.0, 4.0, 8.0])
@pytest.mark.parametrize("alpha", [0.0, 0.05, 0.2])
def test_damping_of_a_bilinear_system_is_that_of_the_formula(
    ductility: float, alpha: float
) -> None:
    """A. K. Chopra, R. K. Goel, Earthquake Spectra 17 (2001) 33-64: 2 (mu - 1)(1 - alpha) / ..."""
    record = bilinear(driven([0.0, ductility, -ductility, ductility], 4000), 1.0, 1.0, alpha)
    expected = 2.0 * (ductility - 1.0) * (1.0 - alpha)
    expected /= np.pi * ductility * (1.0 + alpha * ductility - alpha)
    assert damping(record)[0] == pytest.approx(expected, rel=2e-3)
