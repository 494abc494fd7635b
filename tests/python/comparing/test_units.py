"""A comparison says where one curve is so much larger that it must be in other units."""

from __future__ import annotations

import numpy as np
import pytest

import curvewise
from curvewise.curves.named_curve import NamedCurve

P, Q = map(np.asarray, curvewise.datasets.hysteresis_pair())


def test_per_cent_and_pascal_are_noticed() -> None:
    found = curvewise.compare(P, Q * (100.0, 1e6))
    notes = [
        "x of P is 0.01 times that of Q; different units?",
        "y of P is 1.16e-06 times that of Q; different units?",
    ]
    assert found.notes == notes
    assert str(found).splitlines()[-2:] == notes
    assert list(found.to_dict()) == ["area", "pcm", "frechet", "dtw", "curve_length"]
    shown = found._repr_html_()
    assert all(note in shown for note in notes)


def test_the_columns_have_their_names() -> None:
    names = ("strain", "stress, MPa")
    found = curvewise.compare(NamedCurve(P, names), NamedCurve(Q / (1, 100.0), names))
    assert found.notes == ["stress, MPa of P is 116 times that of Q; different units?"]
    assert curvewise.compare(P[:, 1], 30 * Q[:, 1]).notes == [
        "value of P is 0.0387 times that of Q; different units?"
    ]


@pytest.mark.parametrize("factor", [1.0, 0.07, 15.0, 0.0])
def test_like_extents_and_flat_curves_are_no_reason(factor: float) -> None:
    found = curvewise.compare(P, Q * (1.0, factor), measures=["dtw"])
    assert found.notes == []
    assert len(str(found).splitlines()) == 1
