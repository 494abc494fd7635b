"""Fit of a material to tests without a solver: bounds, search, intervals, files.

Each test is thinned to some hundred points, including its reversals, and drives the material-point
model (`curvewise.materials`). The search uses the model's exact derivatives. It takes seconds on
one core; the cost is that of `curvewise.calibration.identify`.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .._bounds import Bounds
from .._options import Default, Missing
from ..calibration import Identification, Uncertainty, identify
from ..calibration.records.search_record import Doubt
from ..calibration.report.notes import Note
from ..calibration.report.verdict import Verdict
from ..curves.inputs import Array
from ..curves.missing import named_without_gaps
from ..curves.named_curve import NamedCurve, known_file
from ..curves.several_curves import curve_list
from ..materials import DrivenModel, Material
from ..showing.result import text_of
from .beginnings import warn_of_beginnings
from .doubts import doubts_of
from .driven_tests import Cycles, DrivenTests, fit_criterion, fit_method
from .fit_cards import CardsOfFit
from .moduli import check_units, checked_names, modulus_of
from .preparation import PreparedTest
from .recorded_cycles import whole_record
from .units_of_tests import warn_of_units
from .wider_bounds import Beyond, search_within

__all__ = ["MaterialFit", "fit_material"]

_COLUMNS = ("parameter", "unit", "value", "interval_low", "interval_high", "determined", "meaning")


@dataclass(frozen=True, eq=False)
class MaterialFit(CardsOfFit):
    """A material with the parameters that fit its tests best.

    Attributes
    ----------
    model : DrivenModel
        The material, driven by the tests.
    tests : tuple of ndarray
        The compared tests: strain and stress, thinned.
    found : Identification
        The result of the search. If bounds were widened, it is the search in the widest, with the
        history, the failures and the runs of all searches.
    uncertainty : Uncertainty or None
        None if a study did not request it.
    modulus_read : float
        The slope of unloading of the tests, or that of the first loading if the tests never unload.
    units : str
        The unit of the stresses.
    beyond : Beyond, optional
        The parameters that ended at bounds derived from the tests, and the gain of wider ones.
    beginning : str, default ""
        Sentences about tests that begin slightly off zero strain and stress.
    prepared : tuple of PreparedTest
        The tests that `prepare` has made, with its steps.
    cycles : {"all", "last"}
        The compared cycles.
    """

    model: DrivenModel[Material] = field(repr=False)
    tests: tuple[Array, ...] = field(repr=False)
    found: Identification
    uncertainty: Uncertainty | None
    modulus_read: float
    units: str = "MPa"
    beyond: Beyond | None = None
    beginning: str = ""
    prepared: tuple[PreparedTest, ...] = field(default=(), repr=False)
    cycles: Cycles = "all"

    def __str__(self) -> str:
        verdict, *tables = self.found.parts()
        notes = [f"{_title(one)}\n{one}" for one in self.prepared]
        intervals = [] if self.uncertainty is None else self.uncertainty.parts()
        after = ["" if self.beyond is None else str(self.beyond)]
        if failures := self.found.failures:
            after.append(
                f"{len(failures)} of {self.found.evaluations} runs failed, the first: "
                f"{failures[0][1]}"
            )
        return text_of([verdict, *notes, *intervals, *tables, *filter(None, after)])

    @property
    def verdict(self) -> Verdict:
        """What is said first: how far off, which parameters can be used, whether it converged.

        Its ``lines`` begin the text, the page and the cards; ``usable`` says of each parameter that
        was searched for whether it can be used.
        """
        return self.found.verdict

    @property
    def doubts(self) -> list[Doubt]:
        """Parameters that are not to be used, with the reason and what would determine them."""
        return doubts_of(
            self.tests,
            self.found,
            self.uncertainty,
            material=self.material,
            modulus_read=self.modulus_read,
            cycles=self.cycles,
            beyond=self.beyond,
            beginning=self.beginning,
        )

    @property
    def runs(self) -> int:
        """How many runs of the model the searches took, of all bounds."""
        return self.found.evaluations

    def write(self, folder: str | os.PathLike[str], *, names: Sequence[str] = ()) -> list[Path]:
        """Write parameters.csv, report.html and fit.png into a new or existing folder.

        Parameters
        ----------
        folder : path-like
            The folder for the files; those of an earlier fit are replaced.
        names : sequence of str, optional
            The names of the tests.

        Returns
        -------
        list of Path
            The written files.
        """
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        table, report, picture = (
            folder / name for name in ("parameters.csv", "report.html", "fit.png")
        )
        with table.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, _COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self._rows())
        notes = [
            Note(_title(one), one.steps, one.beginnings(), one.column_names)
            for one in self.prepared
        ]
        self.found.report(report, uncertainty=self.uncertainty, notes=notes)
        figure = self.found.plot()
        for i, ax in enumerate(figure.axes[: len(self.tests)]):  # the loops come first
            ax.set_title(names[i] if names else "")
            ax.locator_params(axis="x", nbins=5)
        figure.savefig(picture, dpi=120)
        return [table, report, picture]

    def _rows(self) -> list[dict[str, Any]]:
        rows, usable = [], self.verdict.usable
        for name, unit, meaning in self.material.parameters:
            row = {"parameter": name, "meaning": meaning}
            row["unit"] = self.units if unit == "stress" else unit
            row["value"] = repr(self.parameters[name])
            if self.uncertainty is not None and name in self._intervals:  # it was searched for
                low, high = map(float, self._intervals[name])
                row |= {"interval_low": repr(low), "interval_high": repr(high)}
                row["determined"] = str(usable[name])
            rows.append(row)
        return rows


def fit_material(
    tests: Any,
    material: Material,
    *,
    measure: str = "sum_of_squares",
    fixed: Mapping[str, float] | None = None,
    bounds: Bounds | None = None,
    cycles: Cycles = "all",
    points: int = 300,
    rates: Sequence[float] | None = None,
    seed: int = 0,
    max_runs: int | None = None,
    units: str = "MPa",
    progress: bool = True,
    missing: Missing = Default.missing,
) -> MaterialFit:
    """Fit a material to tests that are driven by strain.

    Parameters
    ----------
    tests : array_like of shape (n, 2), or sequence of such
        Strain [-] and stress of each test, from zero strain and stress on: loops, single tension
        tests, raw records of a machine, or results of :func:`prepare`.
    material : Material
        The material, such as ``ChabocheVoce(backstresses=2)``.
    measure : str, default "sum_of_squares"
        The measure to minimise, as for `identify`. The simulated stress is at the strains of the
        test, so that squares of its difference apply.
    fixed : mapping of str to float, optional
        Known parameters, which are not searched for, such as ``{"E": 206e3}``.
    bounds : mapping, optional
        Bounds of some parameters or of all, as for `identify`. The others have those that
        ``material.bounds_from(tests)`` derives from the tests, and wider ones if a parameter ends
        at such a bound. Given bounds are kept.
    cycles : {"all", "last"}
        "last" compares only the last complete cycle of each test
        (:func:`curvewise.curves.last_cycle`), the stabilised one of many cycles. The material still
        undergoes the whole history before it.
    points : int, default 300
        Approximate number of compared points of each test; shorter tests are unchanged. If the
        noise in strain of a longer test exceeds its step from row to row, the test is averaged over
        short blocks of rows first, and its reversals are located from both sides.
    rates : sequence of float, optional
        Rate of strain of each test, as for :meth:`curvewise.materials.Material.driven_by`.
    seed : int, default 0
        Seed of the search.
    max_runs : int, optional
        Maximum number of parameter sets, including those in wider bounds.
    units : str, default "MPa"
        Unit of the stresses, for axes, tables and cards; nothing is converted.
    progress : bool, default True
        Whether to show a bar (tqdm).
    missing : {"refuse", "skip"}, default "refuse"
        Whether points with a nan raise an error, or are skipped with a warning of how many.

    Returns
    -------
    MaterialFit
        The parameters, their intervals, and methods that write them.

    Raises
    ------
    ValueError
        If a test does not hold strain and stress, has strains in per cent, is elastic, or lacks a
        complete cycle for ``cycles="last"``. If a name in `fixed` or `bounds` is not a parameter,
        or a modulus or yield stress is in another unit than the tests. If no remaining parameter
        changes the stress.
    ImportError
        If scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.

    Warns
    -----
    BeginningWarning
        With ``cycles="all"``: if a test does not begin at zero strain and stress, or begins with a
        toe (:func:`curvewise.curves.shift_to_origin` corrects both). The fit then often ends with a
        yield stress near 0.
    UnitsWarning
        If a test seems to have other units: by the names of its columns, or by a modulus outside 1
        to 1,000 GPa in `units`.

    Notes
    -----
    A fit takes seconds. It reports undetermined parameters; do not use these beyond the strains of
    the tests.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.fitting import fit_material
    >>> from curvewise.materials import ChabocheVoce
    >>> steel = ChabocheVoce(backstresses=1)
    >>> turns = [0.0, 0.02, -0.02, 0.02]
    >>> strain = np.interp(np.arange(121) / 40, range(4), turns)
    >>> made_of = dict(zip(steel.names, (200e3, 300.0, -50.0, 8.0, 80e3, 400.0)))
    >>> loop = np.column_stack((strain, steel.stress(strain, made_of)))
    >>> fit = fit_material(loop, steel, progress=False)
    >>> {name: round(value, 1) for name, value in fit.parameters.items()}
    {'E': 200000.0, 'yield': 300.0, 'Q': -50.0, 'b': 8.0, 'C1': 80000.0, 'gamma1': 400.0}
    """
    given = curve_list(tests)
    prepared = tuple(test for test in given if isinstance(test, PreparedTest) and test.steps)
    kept = named_without_gaps(given, missing)
    given = [a if isinstance(a, PreparedTest) else b for a, b in zip(given, kept, strict=True)]
    warn_of_units(given, units)
    whole = list(map(whole_record, given))
    driven = DrivenTests.of(material, given, cycles=cycles, points=points, rates=rates)
    known, own = checked_names(material.names, fixed, bounds)
    is_whole = set(own) >= set(material.names)
    read_off = {} if is_whole else material.bounds_from(whole)
    beginning = warn_of_beginnings(given, units, level=2) if cycles == "all" else ""
    modulus = modulus_of(given)
    check_units({**own, **known}, given, units, material.yield_stress)
    search = partial(
        identify,
        driven.model,
        [
            NamedCurve(compared, ("strain [-]", f"stress [{units}]"), known_file(test))
            for compared, test in zip(driven.compared, given, strict=True)
        ],
        measure=fit_criterion(measure),
        method=fit_method(measure),
        seed=seed,
        progress=progress,
    )
    searched = {name: {**read_off, **own, **known}[name] for name in material.names}
    found, beyond = search_within(search, searched, max_runs, kept=own)
    uncertainty = found.uncertainty()
    if not np.any(uncertainty.sensitivities):
        raise ValueError(
            f"no parameter that is searched for moves the stress ({', '.join(found.bounds)}): the "
            f"material yields at no strain of the tests, or at once; check "
            f"{', '.join(known) or 'bounds'}"
        )
    fit = MaterialFit(
        driven.model,
        driven.compared,
        found,
        uncertainty,
        modulus,
        units,
        beyond,
        beginning,
        prepared,
        cycles,
    )
    found.take_down_doubts(fit.doubts)
    return fit


def _title(test: PreparedTest) -> str:
    """Return what heads the steps of a test."""
    name = known_file(test.curve)
    return f"Preparation of {name}" if name else "Preparation of the test"
