"""The material cards of a fit: marked, and refused where a number is doubtful (`doubtful`)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ..calibration import Identification, Uncertainty
from ..materials import DrivenModel, Material
from ..solvers.cards import FORMATS
from .card_refusals import check_refusals, refusals_of

__all__ = ["CardsOfFit"]


class CardsOfFit:
    """What a fit has for its cards: parameters, intervals, and which of them are doubtful."""

    model: DrivenModel[Material]
    found: Identification
    uncertainty: Uncertainty | None
    units: str

    @property
    def material(self) -> Material:
        """The fitted material."""
        return self.model.material

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters that were found."""
        return self.found.parameters

    @property
    def doubtful(self) -> dict[str, str]:
        """Young's modulus and yield stress that only bounds support, with the reason; else empty.

        One of them is doubtful if the tests do not determine it, and its interval reaches a bound
        of the search or is wider than its value.
        """
        return refusals_of(
            self.uncertainty, self.found.bounds, self.units, self.material.yield_stress
        )

    def card(
        self, solver: str, *, name: str = "material", accept_undetermined: bool = False
    ) -> str:
        """Return the material card of a solver, with the verdict and the intervals as comments.

        Parameters
        ----------
        solver, name
            As for :meth:`curvewise.materials.Material.card`.
        accept_undetermined : bool, default False
            Write the card even if a modulus or a yield stress is `doubtful`.

        Returns
        -------
        str
            Comments mark each parameter that the tests do not determine as NOT DETERMINED.

        Raises
        ------
        UndeterminedCardError
            If a parameter is `doubtful` and not accepted.
        ValueError
            If the solver does not have such a material.
        """
        if not accept_undetermined:
            check_refusals(self.doubtful, solver)
        verdict = self.found.verdict
        return self.material.card(
            self.parameters,
            solver,
            name=name,
            units=self.units,
            intervals=self._intervals,
            undetermined=[name for name, good in verdict.usable.items() if not good],
            along=list(self.model.strains),
            verdict=verdict.lines,
        )

    @property
    def _intervals(self) -> dict[str, tuple[float, float]]:
        return {} if self.uncertainty is None else self.uncertainty.intervals

    def write_cards(
        self,
        folder: str | os.PathLike[str],
        solvers: Sequence[str],
        *,
        name: str = "material",
        accept_undetermined: bool = False,
    ) -> list[Path]:
        """Write the card of each solver into a folder, as card_abaqus.inp and so on; see `card`.

        Raises
        ------
        UndeterminedCardError
            As `card`. Cards of an earlier fit are removed from the folder.

        Returns
        -------
        list of Path
            The written files.
        """
        files = {
            solver: Path(folder, f"card_{solver}{FORMATS[solver].suffix}") for solver in solvers
        }
        for file in files.values():
            file.unlink(missing_ok=True)
        if files and not accept_undetermined:
            check_refusals(self.doubtful, ", ".join(files))
        for solver, file in files.items():
            text = self.card(solver, name=name, accept_undetermined=True)
            file.write_text(text, encoding="utf-8")
        return list(files.values())
