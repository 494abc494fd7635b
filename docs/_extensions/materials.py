"""Tables of all materials, from their records.

``.. materials::`` lists the materials, ``.. cards-of-materials::`` the keywords of the solvers.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx

from curvewise.materials import MATERIALS
from curvewise.solvers.cards import FORMATS
from curvewise.solvers.cards.content import CardLaw


class RecordTable(Directive):
    """A table of rows of reStructuredText."""

    def made(self, head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[nodes.Node]:
        """Return a table with a line of titles."""
        lines = [".. list-table::", "   :header-rows: 1", ""]
        for row in (head, *rows):
            lines += [f"   {' ' if i else '*'} - {cell}" for i, cell in enumerate(row)]
        found = nodes.Element()
        self.state.nested_parse(StringList(lines, "materials"), 0, found)
        return found.children


class Materials(RecordTable):
    """Each material: class, name for commands, studies and C, hardening, parameters."""

    def run(self) -> list[nodes.Node]:
        """Read the records."""
        rows = []
        for name, kind in MATERIALS.items():
            what = (kind.__doc__ or "").partition("\n")[0]
            names = ", ".join(f"``{one}``" for one in kind().names)
            rows.append(
                (f":class:`~curvewise.materials.{kind.__name__}`", f"``{name}``", what, names)
            )
        return self.made(("class", "name", "hardening", "parameters"), rows)


class CardsOfMaterials(RecordTable):
    """Each solver's keywords for each material that a solver has."""

    def run(self) -> list[nodes.Node]:
        """Read the records of materials and solvers."""
        shown = [name for name in MATERIALS if any(name in form.laws for form in FORMATS.values())]
        rows = [
            (form.title, *(_cell(form.laws.get(name)) for name in shown))
            for form in FORMATS.values()
        ]
        return self.made(("solver", *(MATERIALS[name].__name__ for name in shown)), rows)


def _cell(law: CardLaw | None) -> str:
    if law is None:
        return "–"
    choices = [f'{name}="{word}"' for name, words in law.choices.items() for word in words]
    also = f"; also {', '.join(f'``{choice}``' for choice in choices)}" if choices else ""
    return f"``{law.keywords}``{also}"


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directives."""
    app.add_directive("materials", Materials)
    app.add_directive("cards-of-materials", CardsOfMaterials)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
