"""Every claim of the paper in its order, with a verdict: verdicts.md, from claims.toml.

A claim has its verdict and a sentence that says what was found. Numbers that a script computes are
not written there: `{section > row > column}` is a cell of a table of results.md, `{max section > *
> column}` (or min) the cell of the largest number among all rows. A row is found by its first
cells, as many as are given. So the page cannot say other numbers than the tables; the verdicts
themselves are a person's. Cost: none.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path
from typing import Any

from report import HERE, Run, table

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

VERDICTS = ("holds", "holds under a condition", "contradicted", "open")
SHOWN = "shown"  # a method or a figure, without a claim

HEAD = """# The paper's claims, one by one

This page lists the claims of Jekel, Venter, Venter, Stander and Haftka, "Similarity measures for
identifying material parameters from hysteresis loops using inverse analysis", Int. J. Material
Forming (2018), in their order, each with our result. `verdicts.py` writes it from claims.toml. The
numbers are those of the tables in [results.md](results.md). Run a script by
`python benchmarks/reproduction/<script>`, or all of them by `regenerate.py`.

- **holds**: we recomputed it, and it is true.
- **holds under a condition**: it is true under the condition that the row gives.
- **contradicted**: the paper's own data or tables, or our results, contradict it.
- **open**: the published data cannot decide it.
- *shown*: a method or a figure, without a claim.
"""


def main() -> None:
    """Write verdicts.md."""
    run = Run(__doc__)
    text = page(HERE / "claims.toml", (run.output / "results.md").read_text(encoding="utf-8"))
    (run.output / "verdicts.md").write_text(text, encoding="utf-8")
    print(f"written: {run.output / 'verdicts.md'}")


def page(claims: Path, results: str) -> str:
    """Return the page: counts, then a table for each section, with its pictures."""
    tables = tables_of(results)
    sections = tomllib.loads(claims.read_text(encoding="utf-8"))["section"]
    parts = [HEAD, count_table(sections)]
    for section in sections:
        parts += [f"## {section['title']}", claim_table(section["claim"], tables)]
        pictures = [name for claim in section["claim"] for name in claim.get("pictures", [])]
        parts += ["\n".join(f"![{name}]({name}.webp)" for name in dict.fromkeys(pictures))]
    return "\n\n".join(part.strip() for part in parts if part) + "\n"


def count_table(sections: list[dict[str, Any]]) -> str:
    """Return how often each verdict is given, by section and in all."""
    rows, total = [], Counter[str]()
    for section in sections:
        counts = Counter(claim["verdict"] for claim in section["claim"])
        if unknown := set(counts) - {*VERDICTS, SHOWN}:
            raise ValueError(f"{section['title']}: unknown verdicts {', '.join(sorted(unknown))}")
        total += counts
        rows.append([section["title"], *(f"{counts[verdict]}" for verdict in (*VERDICTS, SHOWN))])
    rows.append(["**all**", *(f"**{total[verdict]}**" for verdict in (*VERDICTS, SHOWN))])
    return table(["section", *VERDICTS, SHOWN], rows)


def claim_table(claims: list[dict[str, Any]], tables: dict[str, list[list[str]]]) -> str:
    """Return the claims of a section, each with verdict, finding, script and pictures."""
    rows = []
    for claim in claims:
        verdict = claim["verdict"]
        found = re.sub(r"\{([^}]+)\}", lambda match: cell(match[1], tables), claim["found"])
        pictures = ", ".join(f"[{name}]({name}.webp)" for name in claim.get("pictures", []))
        shown = f"*{verdict}*" if verdict == SHOWN else f"**{verdict}**"
        rows.append([claim["says"], shown, found, f"`{claim['by']}`", pictures])
    header = ["the paper", "verdict", "what was found", "by", "picture"]
    lines = table(header, rows).splitlines()
    return "\n".join([lines[0], "|" + " --- |" * len(header), *lines[2:]])


def tables_of(results: str) -> dict[str, list[list[str]]]:
    """Return the tables of results.md by their names, as rows of cells, the header first."""
    found = re.findall(r"<!-- (\S+): begin -->\n(.*?)<!-- \1: end -->", results, re.DOTALL)
    return {
        name: [
            [cell.replace("*", "").strip() for cell in line.strip("| ").split("|")]
            for line in text.splitlines()
            if line.startswith("|") and not line.startswith("| ---")
        ]
        for name, text in found
    }


def cell(query: str, tables: dict[str, list[list[str]]]) -> str:
    """Return the text of a cell, or of that with the largest or smallest number among several."""
    extreme, _, rest = query.partition(" ")
    choose = {"max": max, "min": min}.get(extreme)
    name, *keys, column = (rest if choose else query).split(" > ")
    if column not in next(iter(tables.get(name, [])), []):
        raise ValueError(f"{query}: results.md has no table {name} with a column {column}")
    header, *rows = tables[name]
    at = header.index(column)
    cells = [
        row[at]
        for row in rows
        if all(key in ("*", text) for key, text in zip(keys, row, strict=False))
    ]
    if not cells or (len(cells) > 1 and not choose):
        raise ValueError(f"{query}: {len(cells)} rows of {name} are meant, not one")
    return choose(cells, key=leading_number) if choose else cells[0]


def leading_number(text: str) -> float:
    """Return the number with which a text begins."""
    found = re.match(r"[-+]?[\d.]+(?:e[-+]?\d+)?", text)
    if not found:
        raise ValueError(f"{text!r} begins with no number")
    return float(found[0])


if __name__ == "__main__":
    main()
