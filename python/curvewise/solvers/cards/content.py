"""The content of a material card for any solver, and its leading comments.

Numbers are printed with the digits that give the same double when they are read: Python's shortest
(repr). Solvers with short fields get the same double in fewer characters if possible. Otherwise
they get a rounded one, which a comment names.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ...curves.inputs import Array

__all__ = ["CardContent", "CardFormat", "CardLaw", "SolverCard", "TabulatedLayer", "as_field"]

_LINE = 100  # characters of a comment


@dataclass(frozen=True)
class CardContent:
    """A material with its numbers and their uncertainty.

    Attributes
    ----------
    material : str
        The name of the material's record, such as "chaboche-voce".
    model : str
        The name of its class.
    described : str
        The material with its options, as Python prints it.
    options : mapping of str to object
        The options of the material.
    choices : mapping of str to str
        Options that choose among laws, and differ from their defaults.
    parameters : dict of str to float
        The parameters, in the material's order.
    units : dict of str to str
        The unit of each parameter, "-" for dimensionless ones.
    meanings : dict of str to str
        The meaning of each parameter.
    name, date : str
        The name of the material; the date of the fit.
    poisson : float
        Poisson's ratio, which uniaxial tests do not determine.
    intervals : mapping of str to (low, high)
        The intervals of the parameters that have one.
    undetermined : frozenset of str
        Parameters that the tests do not determine.
    along : sequence of ndarray
        Paths of strain on which the card must follow the material.
    stress : callable
        The material's stress along a path of strain.
    verdict : sequence of str
        Lines of the comments: how far the model is from the tests, and which numbers to use.
    """

    material: str
    model: str
    described: str
    options: Mapping[str, object]
    choices: Mapping[str, str]
    parameters: dict[str, float]
    units: Mapping[str, str]
    meanings: Mapping[str, str]
    name: str
    date: str
    poisson: float
    intervals: Mapping[str, tuple[float, float]]
    undetermined: frozenset[str]
    along: Sequence[Array]
    stress: Callable[[Array], Array]
    verdict: Sequence[str] = ()

    @property
    def backstresses(self) -> list[tuple[float, float]]:
        """C and gamma of each of Chaboche's back stresses."""
        count = sum(name.startswith("gamma") for name in self.parameters)
        p = self.parameters
        return [(p[f"C{k}"], p[f"gamma{k}"]) for k in range(1, count + 1)]


@dataclass(frozen=True)
class TabulatedLayer:
    """One material of CalculiX, and one element, if a card has several.

    Attributes
    ----------
    name : str
    modulus, poisson : float
    kinematic : tuple of (stress, plastic strain)
        The curve of kinematic hardening.
    isotropic : tuple of (stress, plastic strain)
        The yield stress.
    """

    name: str
    modulus: float
    poisson: float
    kinematic: tuple[tuple[float, float], ...]
    isotropic: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class SolverCard:
    """A material card as `read_card` has read it.

    Attributes
    ----------
    solver : str
        "abaqus" or "calculix".
    name : str
        Of the material.
    parameters : dict of str to float
        Names as those of :class:`curvewise.materials.ChabocheVoce`. Of CalculiX's cards, those that
        the comments state: its tables follow from them.
    poisson : float
        Poisson's ratio.
    layers : tuple of TabulatedLayer
        The tables of CalculiX's materials, empty for Abaqus.
    """

    solver: str
    name: str
    parameters: dict[str, float]
    poisson: float
    layers: tuple[TabulatedLayer, ...] = ()


@dataclass(frozen=True)
class CardLaw:
    """How a solver's card is written for one material that the solver has.

    Attributes
    ----------
    keywords : str
        What the solver calls the material.
    source : str
        Where the manual has these keywords.
    write : callable
        From the content to the lines below the comments; a ValueError where these numbers cannot be
        written.
    choices : mapping of str to tuple of str
        Values of options that the solver has in addition to the defaults.
    """

    keywords: str
    source: str
    write: Callable[[CardContent], list[str]]
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class CardFormat:
    """How one solver's cards are written, and read where that is possible.

    Attributes
    ----------
    solver : str
        As `card` takes it.
    title : str
        As the solver's makers write it.
    comment : str
        What a line of comment begins with.
    laws : mapping of str to CardLaw
        The materials that the solver has, by the names of their records.
    width : int or None
        Characters of a field, where they are limited.
    suffix : str
        What the name of a card's file ends in.
    """

    solver: str
    title: str
    comment: str
    laws: Mapping[str, CardLaw]
    width: int | None = None
    suffix: str = ".inp"

    def lack(self, content: CardContent) -> str:
        """Return what the solver does not have of a material; empty if it has all."""
        law = self.laws.get(content.material)
        if law is None:
            return content.model
        for option, choice in content.choices.items():
            if choice not in law.choices.get(option, ()):
                return f'{content.model} with {option}="{choice}"'
        return ""

    def text(self, content: CardContent) -> str:
        """Return the card of a material that the solver has."""
        law = self.laws[content.material]
        body = law.write(content)
        head = [f"{self.comment} {line}" for line in self._head(content, law)]
        return "\n".join([*head, *body, ""])

    def _head(self, content: CardContent, law: CardLaw) -> list[str]:
        lines = [
            f"curvewise card for {self.title}: {content.name}",
            f"{content.described}, fitted {content.date}",
            f"source: {law.source}",
        ]
        for line in content.verdict:  # in ASCII; with a bar, for those who read the lines below
            text = line.replace("±", "+-")
            lines += textwrap.wrap(text, _LINE, initial_indent="| ", subsequent_indent="|   ")
        for name, value in content.parameters.items():
            interval = content.intervals.get(name)
            within = f" ({interval[0]!r} to {interval[1]!r})" if interval else ""
            unit = content.units[name]
            mark = " NOT DETERMINED" if name in content.undetermined else ""
            lines.append(
                f"{name} = {value!r}{'' if unit == '-' else ' ' + unit}{within}{mark}: "
                f"{content.meanings[name]}"
            )
        if content.undetermined:
            lines.append(
                "NOT DETERMINED: the tests leave it open; use the card for loads like theirs"
            )
        lines.append(f"Poisson's ratio {content.poisson!r} is given, not fitted")
        if self.width:
            written = content.parameters | {"Poisson's ratio": content.poisson}
            rounded = [name for name, value in written.items() if _is_lost(value, self.width)]
            if rounded:
                lines.append(f"rounded to fields of {self.width} characters: {', '.join(rounded)}")
        return lines


def as_field(value: float, width: int) -> str:
    """Return a number in at most `width` characters, as the same double if possible.

    Parameters
    ----------
    value : float
        Finite.
    width : int
        At least 10.
    """
    texts = [repr(float(value))]
    for digits in range(17, 0, -1):
        texts += [f"{value:.{digits}g}", f"{value:.{digits - 1}e}", f"{value:.{digits}f}"]
    texts += [_shortened(text) for text in texts]
    fitting = [text for text in texts if len(text) <= width]
    return min(fitting, key=lambda text: abs(float(text) - value))


def _is_lost(value: float, width: int) -> bool:
    """Return whether a field of this width cannot hold the double."""
    return float(as_field(value, width)) != value


def _shortened(text: str) -> str:
    """Return a number without the zeros and the sign that it does not need."""
    text = re.sub(r"e([-+])0*(?=\d)", lambda sign: "e" + sign[1].replace("+", ""), text)
    return re.sub(r"^(-?)0\.(?=\d)", r"\1.", text)
