"""What looks wrong with a simulation beside its test: columns, units, signs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from curvewise.comparing.units import unlike_its_test

STRAIN = np.linspace(0.0, 0.02, 21)
TEST = np.column_stack((STRAIN, 400.0 * np.sqrt(STRAIN / 0.02)))
AXES = ("strain", "stress")


@pytest.mark.parametrize(
    ("simulation", "doubts"),
    [
        (TEST, []),
        (TEST * (1.5, 0.7), []),
        (
            TEST[:, ::-1],
            [
                "strain and stress of the simulation have each other's extent in the test; "
                "swapped columns?"
            ],
        ),
        (
            TEST * (100.0, 1.0),
            ["strain of the test is 0.01 times that of the simulation; different units?"],
        ),
        (
            TEST * (1.0, -1.0),
            [
                "stress of the simulation has the opposite sign of the test's; another direction?",
            ],
        ),
        (
            TEST * (1.0, 0.0),
            ["stress of the simulation does not change; another quantity?"],
        ),
    ],
)
def test_a_question_for_each_kind_of_mistake(simulation: np.ndarray, doubts: list[str]) -> None:
    assert unlike_its_test(TEST, simulation, AXES) == doubts


def test_a_loop_has_no_sign() -> None:
    loop = np.column_stack((np.sin(np.arange(60) / 9), np.cos(np.arange(60) / 9)))
    assert unlike_its_test(loop, -loop, AXES) == []


def test_what_has_no_extent_is_not_asked_about() -> None:
    assert unlike_its_test(np.array([[3.0]]), np.array([[4e3]]), ("y",)) == []
    assert unlike_its_test(TEST, np.ones((4, 3)), AXES) == []
    flat = TEST * (1.0, 0.0)
    assert unlike_its_test(flat, flat, AXES) == []


@given(
    factors=st.tuples(*2 * [st.floats(0.06, 18.0)]),
    offset=st.tuples(*2 * [st.floats(0.0, 3.0)]),
    dimensions=st.sampled_from([1, 2, 3, 7]),
)
def test_a_curve_that_is_a_little_off_is_not_asked_about(
    factors: tuple[float, float], offset: tuple[float, float], dimensions: int
) -> None:
    """Within a factor of 20 and on the same side of zero nothing is in doubt."""
    curve = np.linspace(0.0, 1.0, 11)[:, None] ** np.arange(1, dimensions + 1)
    moved = curve * np.resize(factors, dimensions) + np.resize(offset, dimensions)
    assert unlike_its_test(curve, moved, ["c"] * dimensions) == []
