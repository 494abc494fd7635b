"""Flow curves of tension tests: true stress over plastic strain, with the laws of Voce and Swift.

The plastic strain is the true strain less stress / E. Rows are averaged over sections of strain
that grow with the plastic strain, and made ascending (`curves.isotonic`). Rows of unloading and
rows after the largest force are left out: a neck has no uniaxial stress. The laws are fitted by
`identify` to sections of equal strain. Cost: linear in the test, and some hundred evaluations of
each law.

E. Voce, "The relationship between stress and strain for homogeneous deformation", Journal of the
Institute of Metals 74 (1948) 537-562; H. W. Swift, "Plastic instability under plane stress",
Journal of the Mechanics and Physics of Solids 1 (1952) 1-18.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..calibration import Log, identify
from ..calibration.problem.tables import digits
from ..curves.inputs import Array
from ..curves.isotonic import isotonic
from ..drawing.figures import new_figure
from ..drawing.palette import P_COLOUR, SERIES
from ..materials.readings import strain_and_stress
from ..showing.result import Result, Table
from ..solvers.cards import flow_table
from .moduli import modulus_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..drawing.picture import Picture

__all__ = ["FlowCurve", "FlowLaw", "flow_curve"]

_SECTIONS = 200  # of equal strain, to which the laws are fitted
_BACK = 3e-4  # strain by which an unloading falls below the largest so far; noise is less
_NECKED = 0.005  # share by which the force has fallen where a specimen necks
_FAR = 1.0  # plastic strain at which the laws are compared


@dataclass(frozen=True)
class FlowLaw:
    """A law of hardening that is fitted to a flow curve.

    Attributes
    ----------
    name : {"voce", "swift"}
        Voce: s0 + Q (1 - exp(-b p)). Swift: K (e0 + p)^n.
    parameters : dict of str to float
    misfit : float
        Root mean square of the difference in stress.
    """

    name: Literal["voce", "swift"]
    parameters: dict[str, float]
    misfit: float

    def stress(self, plastic: Any) -> Array:
        """Return the stress at plastic strains."""
        return _LAWS[self.name](np.asarray(plastic, dtype=np.float64), **self.parameters)


@dataclass(frozen=True, eq=False)
class FlowCurve(Result):
    """True stress over plastic strain.

    Attributes
    ----------
    plastic_strain, stress : ndarray, shape (n,)
        From 0 and the yield stress on; both ascend.
    modulus : float
        Young's modulus, given or read off the test.
    offset : float
        Plastic strain at which the yield stress is taken.
    voce, swift : FlowLaw
    units : str
        Unit of stress.
    left_out : str
        What was left out of the test, or "".
    measured : ndarray, shape (m, 2)
        Plastic strain and stress of the test's rows.
    """

    plastic_strain: Array = field(repr=False)
    stress: Array = field(repr=False)
    modulus: float
    offset: float
    voce: FlowLaw
    swift: FlowLaw
    units: str
    left_out: str
    measured: Array = field(repr=False)

    picture_shows = "The flow curve with the laws of Voce and Swift"

    def parts(self) -> Sequence[Table | str]:
        """Return the laws with their misfit, and where the curve begins and ends."""
        unit, last = self.units, self.plastic_strain[-1]
        laws = (self.voce, self.swift)
        rows = [
            (
                law.name,
                ", ".join(f"{name} = {digits(v, 5)}" for name, v in law.parameters.items()),
                digits(law.misfit, 2),
                f"{100.0 * law.misfit / self.stress[-1]:.2g}",
                digits(float(law.stress(_FAR)), 4),
            )
            for law in laws
        ]
        header = (
            "law",
            "parameters",
            f"misfit, {unit}",
            "% of the largest",
            f"at {_FAR:g}, {unit}",
        )
        lines = [
            f"{len(self.stress)} rows up to a plastic strain of {last:.4g}; E = "
            f"{digits(self.modulus, 4)} {unit}, yield stress {digits(self.stress[0], 4)} {unit} at "
            f"a plastic strain of {self.offset:g}",
            self.left_out,
            f"beyond {last:.4g} the laws extrapolate; the test has no points there",
        ]
        return [Table(rows, header), "\n".join(filter(None, lines))]

    def table(
        self,
        solver: str,
        *,
        law: Literal["voce", "swift"] | None = None,
        to: float | None = None,
        name: str = "material",
        poisson: float = 0.3,
    ) -> str:
        r"""Return the material of a solver that takes a table of stress over plastic strain.

        Parameters
        ----------
        solver : {"abaqus", "calculix", "ls-dyna", "ansys"}
            \*PLASTIC, \*MAT_024 with \*DEFINE_CURVE, TB,PLAS with MISO.
        law : {"voce", "swift"}, optional
            Law whose stresses stand in the table (default: the test's).
        to : float, optional
            Plastic strain up to which a law continues beyond the test.
        name : str, default "material"
            Name of the material: a letter, then letters, digits and underscores.
        poisson : float, default 0.3
            Poisson's ratio.

        Raises
        ------
        ValueError
            If the solver has no such table here, `to` is given without a law or is not beyond the
            test, or a name or Poisson's ratio makes no sense.
        """
        plastic, stress = self.plastic_strain, self.stress
        if to is not None:
            if law is None:
                raise ValueError("to is given without a law; give law='voce' or law='swift'")
            if not to > plastic[-1]:
                raise ValueError(f"to is {to}; the test ends at {plastic[-1]:.4g}: give more")
            more = np.geomspace(plastic[-1], to, 11)[1:]
            plastic = np.concatenate((plastic, more))
        source = "the test"
        if law is not None:
            if law not in _LAWS:
                raise ValueError(f"law is {law!r}; give 'voce' or 'swift'")
            fitted: FlowLaw = getattr(self, law)
            stress = np.asarray(fitted.stress(plastic))
            given = ", ".join(f"{n} = {value!r}" for n, value in fitted.parameters.items())
            source = f"the law of {law.capitalize()}, {given}"
        comments = [
            f"curvewise flow curve by {source}",
            f"true stress in {self.units} over plastic strain; yield stress at {self.offset:g}",
            f"the test ends at a plastic strain of {self.plastic_strain[-1]:.4g}",
        ]
        return flow_table(
            solver, name, self.modulus, poisson, plastic.tolist(), stress.tolist(), comments
        )

    def plot(self) -> Picture:
        """Return a matplotlib Figure: the test, the table and both laws.

        Raises
        ------
        ImportError
            If matplotlib is not installed: ``pip install "curvewise[plot]"``.
        """
        figure = new_figure(figsize=(6.4, 4.4), layout="constrained")
        ax = figure.subplots()
        ax.plot(*self.measured.T, ".", color=P_COLOUR, markersize=2, alpha=0.4, label="test")
        ax.plot(self.plastic_strain, self.stress, "o", color=P_COLOUR, markersize=3, label="table")
        dense = np.linspace(0.0, 1.5 * self.plastic_strain[-1], 300)
        for law, colour in zip((self.voce, self.swift), SERIES, strict=False):
            ax.plot(dense, law.stress(dense), color=colour, label=law.name.capitalize())
        ax.set(xlabel="plastic strain [-]", ylabel=f"true stress [{self.units}]")
        ax.set_ylim(bottom=0.0)
        ax.legend(frameon=False, loc="lower right")
        return figure


def flow_curve(
    test: Any,
    *,
    modulus: float | None = None,
    offset: float = 0.002,
    points: int = 40,
    units: str = "MPa",
) -> FlowCurve:
    """Return the flow curve of a tension test, with Voce's and Swift's laws.

    Parameters
    ----------
    test : array_like, shape (n, 2)
        True strain [-] and true stress, such as ``prepare(record, true=True)``.
    modulus : float, optional
        Young's modulus (default: the slope with which the test loads).
    offset : float, default 0.002
        Plastic strain at which the yield stress is taken; the table has it at 0.
    points : int, default 40
        Rows of the table, at least 5.
    units : str, default "MPa"
        Unit of stress.

    Returns
    -------
    FlowCurve

    Raises
    ------
    ValueError
        If the test has other than two columns, strains in per cent, or no plastic strain beyond
        `offset`; if an option is out of range.
    ImportError
        If scipy or tqdm is missing: ``pip install "curvewise[calibration]"``.

    Notes
    -----
    Linear in the test; the laws take about a second.

    Examples
    --------
    >>> import numpy as np
    >>> from curvewise.fitting import flow_curve
    >>> plastic = np.linspace(0.0, 0.15, 400)
    >>> stress = 250.0 + 240.0 * (1.0 - np.exp(-18.0 * plastic))
    >>> strain = np.append(0.0, plastic + stress / 200e3)
    >>> flow = flow_curve(np.column_stack((strain, np.append(0.0, stress))), modulus=200e3)
    >>> {name: round(value, 1) for name, value in flow.voce.parameters.items()}
    {'s0': 250.0, 'Q': 240.0, 'b': 18.0}
    """
    if points < 5:
        raise ValueError(f"points is {points}; give at least 5")
    if not offset > 0.0:
        raise ValueError(f"offset is {offset}; give a plastic strain above 0, such as 0.002")
    curve = strain_and_stress(test, "test")
    E = modulus_of([curve]) if modulus is None else float(modulus)
    if not E > 0.0:
        raise ValueError(f"modulus is {E}; give a positive number")
    loaded, left_out = _until_necking(curve)
    plastic = loaded[:, 0] - loaded[:, 1] / E
    below = np.flatnonzero(plastic < offset)
    first = int(below[-1]) if below.size else 0
    strain = loaded[first:, 0]
    if len(strain) < 5 or not strain[-1] > strain[0]:
        raise ValueError(
            f"test has {len(strain)} rows with a plastic strain above {offset:g}; give a test that "
            "yields, or a smaller offset"
        )
    growing = np.geomspace(offset, offset + strain[-1] - strain[0], points + 1)
    rows = _averaged(loaded[first:], growing - offset + strain[0], E)
    yields = float(np.interp(offset, *rows.T))
    kept = rows[rows[:, 0] > offset]
    table = np.vstack(([0.0, min(yields, float(kept[0, 1]))], kept))
    table = table[np.append(True, np.diff(table[:, 1]) > 0.0)]
    even = np.linspace(strain[0], strain[-1], min(_SECTIONS, len(strain)) + 1)
    fitted = _averaged(loaded[first:], even, E)
    voce, swift = (_fitted_law(name, fitted[fitted[:, 0] > 0.0]) for name in ("voce", "swift"))
    measured = np.column_stack((plastic, loaded[:, 1]))[first:]
    return FlowCurve(table[:, 0], table[:, 1], E, offset, voce, swift, units, left_out, measured)


def _until_necking(curve: Array) -> tuple[Array, str]:
    """Return the rows of loading up to the largest force, and what was left out."""
    largest = np.maximum.accumulate(curve[:, 0])
    is_new = np.append(True, np.diff(largest) > 0.0)
    falls = np.maximum.reduceat(largest - curve[:, 0], np.flatnonzero(is_new))
    loads = is_new | (falls[np.cumsum(is_new) - 1] <= _BACK)
    said = [] if loads.all() else [f"left out: {np.sum(~loads)} rows of unloading and reloading"]
    curve = curve[loads]
    force = curve[:, 1] * np.exp(-curve[:, 0])
    size = max(1, len(force) // 50)
    smooth = np.convolve(force, np.full(size, 1.0 / size), mode="valid")
    most = int(np.argmax(smooth))
    if smooth[-1] < (1.0 - _NECKED) * smooth[most]:
        end = most + size // 2
        if end < len(curve) - 1:
            said.append(
                f"left out: {len(curve) - 1 - end} rows after the largest force, at a true strain "
                f"of {curve[end, 0]:.4g}: the specimen necks"
            )
            curve = curve[: end + 1]
    return curve, "\n".join(said)


def _averaged(rows: Array, edges: Array, modulus: float) -> Array:
    """Return plastic strain and ascending stress of sections of strain, (m, 2)."""
    places = np.clip(np.searchsorted(edges, rows[:, 0], side="right") - 1, 0, len(edges) - 2)
    counts = np.bincount(places, minlength=len(edges) - 1)
    filled = counts > 0
    means = [
        np.bincount(places, column, minlength=len(edges) - 1)[filled] / counts[filled]
        for column in rows.T
    ]
    stress = isotonic(means[1])
    found = np.column_stack((means[0] - stress / modulus, stress))
    kept = np.append(True, np.diff(np.maximum.accumulate(found[:, 0])) > 0.0)
    ascending: Array = found[kept]
    return ascending


def _voce(plastic: Array, s0: float, Q: float, b: float) -> Array:
    return s0 - Q * np.expm1(-b * plastic)


def _swift(plastic: Array, K: float, e0: float, n: float) -> Array:
    stress: Array = K * (e0 + plastic) ** n
    return stress


_LAWS: dict[str, Callable[..., Array]] = {"voce": _voce, "swift": _swift}


class _Law:
    """A law at the plastic strains of a test: a model for `identify`."""

    def __init__(self, name: str, plastic: Array) -> None:
        self._law, self._plastic = _LAWS[name], plastic

    def __call__(self, parameters: Mapping[str, float]) -> Array:
        return np.column_stack((self._plastic, self._law(self._plastic, **parameters)))


def _fitted_law(name: Literal["voce", "swift"], rows: Array) -> FlowLaw:
    """Return a law fitted to plastic strains and stresses."""
    longest, lowest, highest = float(rows[-1, 0]), float(rows[0, 1]), float(rows[-1, 1])
    bounds: dict[str, Any] = {
        "voce": {
            "s0": (0.2 * lowest, highest),
            "Q": (0.0, 5.0 * highest),
            "b": Log(0.05 / longest, 500.0 / longest),
        },
        "swift": {
            "K": Log(0.5 * highest, 20.0 * highest),
            "e0": Log(1e-6, 1.0),
            "n": (0.0, 1.0),
        },
    }[name]
    found = identify(_Law(name, rows[:, 0]), rows, bounds, measure="sum_of_squares", progress=False)
    law = FlowLaw(name, dict(found.parameters), 0.0)
    misfit = float(np.sqrt(np.mean((law.stress(rows[:, 0]) - rows[:, 1]) ** 2)))
    return FlowLaw(name, law.parameters, misfit)
