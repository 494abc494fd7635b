"""What notebooks show of an identification and of what follows it: tables and the picture.

The tables are those of the summaries, the pictures those of `plot()`; see
:mod:`curvewise.notebook`. Cost: that of `plot()`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import notebook

if TYPE_CHECKING:
    from .cross_validation import CrossValidation
    from .identification import Identification
    from .several_measures import SeveralMeasures
    from .uncertainty import Uncertainty

__all__ = ["cross_validation_html", "identification_html", "several_html", "uncertainty_html"]


def identification_html(found: Identification) -> str:
    """Return parameters, measures, how the search ended, and the loops."""
    rows = []
    for name, value in found.parameters.items():
        low, high = found.bounds.get(name, (value, value))
        rows.append([name, f"{value:.6g}", f"{low:.6g}", f"{high:.6g}"])
    measures = [
        [name, f"{value:.6g}", "minimised" if name == found.measure else ""]
        for name, value in found.measures.items()
    ]
    # The last part of the summary says how the search ended, in words.
    ending = found.summary().rpartition("\n\n")[2]
    return "\n".join(
        [
            notebook.table(rows, ["parameter", "value", "from", "to"]),
            notebook.table(measures, ["measure", f"value (preset {found.preset})", ""]),
            notebook.paragraph(ending),
            notebook.picture(found.plot, "The loops at the optimum, and the convergence"),
        ]
    )


def uncertainty_html(found: Uncertainty) -> str:
    """Return intervals, what is not determined, and the picture."""
    percent = f"{100 * found.level:g} %"
    rows = []
    for name, error in found.standard_errors.items():
        low, high = found.intervals[name]
        note = "determined" if found.determined[name] else "not determined"
        numbers = [f"{found.parameters[name]:.5g}", f"{error:.3g}", f"{low:.5g}", f"{high:.5g}"]
        rows.append([name, *numbers, note])
    header = ["parameter", "value", "std. error", f"{percent} from", "to", ""]
    about = "Intervals, correlations, and the weakest direction"
    return "\n".join(
        [
            notebook.table(rows, header),
            notebook.paragraph(f"weakest direction: {found.in_words}"),
            notebook.picture(found.plot, about),
        ]
    )


def several_html(found: SeveralMeasures) -> str:
    """Return the parameters by measure, the optima by every measure, and the loops."""
    parameters, optima = found.rows()
    return "\n".join(
        [
            notebook.table(parameters[1:], parameters[0]),
            notebook.table(optima[1:], optima[0]),
            notebook.paragraph(f"{found.runs} runs of the model"),
            notebook.picture(found.plot, "The loops of every measure, and the parameters"),
        ]
    )


def cross_validation_html(found: CrossValidation) -> str:
    """Return the folds."""
    header, *rows = found.rows()
    return notebook.table(rows, header)
