"""DataFrames with other columns, or in another order, are refused wherever two curves meet."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable

import pandas as pd
import pytest

import curvewise
from curvewise.calibration import Objective, identify

TEST = pd.DataFrame({"strain": [0.0, 1.0, 2.0], "stress": [0.0, 5.0, 1.0]})
SWAPPED = TEST[["stress", "strain"]]

CALLS: dict[str, Callable[[pd.DataFrame], object]] = {
    "dtw": lambda Q: curvewise.dtw(TEST, Q),
    "cdist": lambda Q: curvewise.cdist([TEST], [Q]),
    "Prepared": lambda Q: curvewise.Prepared(TEST)(Q),
    "Prepared, list": lambda Q: curvewise.Prepared(TEST)([TEST, Q]),
    "Prepared, pickled": lambda Q: pickle.loads(pickle.dumps(curvewise.Prepared(TEST)))(Q),
    "Prepared, copied": lambda Q: copy.copy(curvewise.Prepared(TEST))(Q),
    "Prepared, copied, list": lambda Q: copy.deepcopy(curvewise.Prepared(TEST))([Q]),
    "normalize": lambda Q: curvewise.normalize(TEST, Q),
    "normalize, several": lambda Q: curvewise.normalize(TEST, TEST, Q),
    "reference.normalize": lambda Q: curvewise.reference.normalize(TEST, Q),
    "Objective": lambda Q: Objective(TEST)(Q),
    "Objective, several": lambda Q: Objective([TEST, TEST])([TEST, Q]),
    "Objective.residuals": lambda Q: Objective(TEST, "curve_length").residuals(Q),
    "identify": lambda Q: identify(lambda _: Q, TEST, {"a": (0, 1)}, progress=False, max_runs=2),
}


@pytest.mark.parametrize("name", CALLS)
def test_other_columns_are_refused(name):
    CALLS[name](TEST)
    CALLS[name](TEST.to_numpy())  # an array does not have names that could be wrong
    for other in (SWAPPED, TEST.rename(columns={"stress": "force"})):
        with pytest.raises(ValueError, match="name and order them alike"):
            CALLS[name](other)


def test_the_error_says_which_curve():
    with pytest.raises(ValueError, match=r"^experiments\[1\] has columns .* and the simulation "):
        Objective([TEST, TEST])([TEST, SWAPPED])
    with pytest.raises(ValueError, match=r"^P has columns .* and Q\[1\] has columns "):
        curvewise.Prepared(TEST)([TEST, SWAPPED])
    with pytest.raises(ValueError, match=r"^P has columns .* and others\[1\] has columns "):
        curvewise.normalize(TEST, TEST, SWAPPED)
