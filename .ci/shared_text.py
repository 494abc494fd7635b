"""Write the text and the signatures that functions share into their sources.

Two comments directly above a function or class, before its decorators, name what is written::

    # Shared text: workers, cutoff, measure(symmetric)
    # Signature: dtw without missing, closed
    # Signature: hausdorff(metric, p), dtw(window)

The first replaces entries and paragraphs of the docstring, or lines such as ``{workers}``, by those
of `TEXTS`; ``measure(symmetric)`` is the list of names in the entry `measure`. The second copies
keyword-only parameters with their types and defaults from a function of ``measures``: all without
those that are named, or some of them. "without" also rewrites the names behind "As for", and a
tuple called `options`. ``--check`` writes nothing and fails if a file is out of date.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple, get_args

from curvewise._options import EARTH_RADIUS, Differentiable, Metric, WarpingName
from curvewise.calibration.objective.criterion import MEASURES as CRITERIA
from curvewise.measures.edit_distances import EditDistance
from curvewise.measures.gradient import BY_BOTH_CURVES
from curvewise.measures.registry import MEASURES

PACKAGE = Path(__file__).resolve().parents[1] / "python" / "curvewise"
WIDTH = 100
PRAGMA = re.compile(r" *# (Shared text|Signature): (.+)")
Function = ast.FunctionDef | ast.ClassDef


def listed(names: Sequence[str]) -> str:
    """Return quoted names with commas."""
    return ", ".join(f'"{name}"' for name in names)


_ORDER_AND_RADIUS = f"""\
p : float, 1 <= p <= inf, optional
    The order of "minkowski"; 2 if not given.
radius : float > 0, optional
    The radius of the sphere of "haversine", in the unit of the distances. The default is
    {EARTH_RADIUS}, the mean radius of the Earth in metres."""
_METRICS = listed(get_args(Metric))
TEXTS = {
    "curves": """\
P, Q : array_like, shapes (n, d) and (m, d)
    The curves, of any d.""",
    "metric": f"""\
metric : str
    The ground distance between points: {_METRICS}. "haversine" is the distance along the great
    circle, for points (longitude, latitude) in degrees.
{_ORDER_AND_RADIUS}""",
    "ground": f"""\
metric : str, array_like of shape (n, m), or callable, default "euclidean"
    The ground distance between points: {_METRICS}. "haversine" is the distance along the great
    circle, for points (longitude, latitude) in degrees. A user-defined distance is an array of the
    distances of all points of P and Q, or a function. The function receives some points of each
    curve, of shapes (p, d) and (q, d), and returns their distances, of shape (p, q). Distances are
    at least 0; inf forbids a pair.
{_ORDER_AND_RADIUS}""",
    "window": """\
window : int >= 0 or 0 < float < 1, optional
    Sakoe-Chiba band, as for :func:`dtw`.""",
    "workers": """\
workers : int, default 1
    Number of threads: at least 1, or -1 for one per core. The result does not change.""",
    "layout": """\
layout : {"channels_first", "channels_last"}, optional
    Whether the points of an array are its columns, shape (d, n), as in aeon and sktime, or its
    rows. The default is rows, with a LayoutWarning if there are more coordinates than points.""",
    "prune": """\
prune : bool, default True
    Whether to skip table cells that cannot affect the result. The result does not change.""",
    "cutoff": """\
cutoff : float >= 0, optional
    Upper limit: return inf for distances above it, which takes less time.""",
    "missing": """\
missing : {"refuse", "skip"}, default "refuse"
    Whether points with a nan raise an error, or are skipped with a warning of how many.""",
    "closed": """\
closed : bool, default False
    Whether both curves are closed, so that their first points do not matter. See Notes.""",
    "closed_notes": """\
``closed=True``: the first point of a closed curve is arbitrary, and a last point that equals it
only closes the curve. A path goes once around both curves by steps of one point of either or of
both, and returns to its first pair, which counts once. The value is the smallest over all first
points of P and of Q.""",
    "invalid": """\
ValueError
    If a curve is not finite or empty, the curves differ in d, or an option is unknown or out of
    range.
TypeError
    If a curve does not hold real numbers.""",
    "invalid_window": """\
ValueError
    If a curve is not finite or empty, the curves differ in d, an option is unknown or out of range,
    or no path fits the window (window = 0 and n != m).
TypeError
    If a curve does not hold real numbers.""",
    "own_distances": """\
A user-defined metric is computed in one thread and without pruning. A callable is called once for
every 256 rows of the table (fewer if these are more than 2^21 pairs), so that memory stays
O(n + m), and up to three times for a path. It need not be symmetric. Its exceptions are not
caught.""",
}
LISTS = {
    "all": list(MEASURES),
    "symmetric": [name for name, info in MEASURES.items() if info.symmetric],
    "by_default": [name for name, info in MEASURES.items() if info.by_default],
    "anywhere": [n for n, info in MEASURES.items() if info.by_default and not info.planar],
    "criteria": CRITERIA,
    "edit_distances": get_args(EditDistance),
    "warpings": get_args(WarpingName),
    "differentiable": get_args(Differentiable),
    "by_both_curves": BY_BOTH_CURVES,
}
ENTRY = re.compile(r"(\**\w+(?:, \**\w+)*)(?: : .*)?$")
QUOTED = re.compile(r'"\w+"(?:, "\w+")+')


class Source(NamedTuple):
    """A function in the text of its file."""

    node: Function
    pragmas: list[tuple[str, str]]


def sources(text: str) -> Iterator[Source]:
    """Find the functions and classes below such comments, the last one first."""
    lines = text.split("\n")
    nodes = [node for node in ast.walk(ast.parse(text)) if isinstance(node, Function)]
    for node in sorted(nodes, key=lambda node: node.lineno, reverse=True):
        first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)]) - 1
        pragmas = []
        while match := PRAGMA.fullmatch(lines[first - 1]):
            pragmas.insert(0, (match[1], match[2]))
            first -= 1
        if pragmas:
            yield Source(node, pragmas)


def names_in(text: str) -> list[str]:
    """Split "a, b(c, d)" at the commas outside parentheses."""
    return re.findall(r"[\w ]+(?:\([^)]*\))?", text.replace(", ", ","))


def paragraph_end(lines: list[str], first: int) -> int:
    """Return the line behind an entry, or behind a paragraph of the notes."""
    last = first + 1
    while last < len(lines) and lines[last].strip():
        is_entry = ENTRY.fullmatch(lines[first]) and not lines[last].startswith(" ")
        if is_entry:
            break
        last += 1
    return last


def beginning(lines: list[str], names: str) -> int:
    """Return the line of an entry with these names, or of a paragraph that begins with them."""
    for place, line in enumerate(lines):
        entry = ENTRY.fullmatch(line)
        if entry[1] == names if entry else " " in names and line.startswith(names):
            return place
    raise ValueError(f"no entry {names!r}")


def wrapped(text: str, indent: str = "    ") -> list[str]:
    """Break a text to lines as they stand in the docstring of a function."""
    return textwrap.wrap(
        text,
        WIDTH - 4,
        initial_indent=indent,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=False,
    )


def paragraphs_of(name: str) -> list[list[str]]:
    """Return the entries of a shared text, or its only paragraph."""
    lines = TEXTS[name].split("\n")
    if not ENTRY.fullmatch(lines[0]):
        return [wrapped(" ".join(lines), "")]
    starts = [place for place, line in enumerate(lines) if not line.startswith(" ")]
    ends = [*starts[1:], len(lines)]
    entries = [lines[start:end] for start, end in zip(starts, ends, strict=True)]
    return [[head, *wrapped(" ".join(" ".join(rest).split()))] for head, *rest in entries]


def with_text(lines: list[str], name: str) -> list[str]:
    """Replace a shared text in the lines of a docstring."""
    paragraphs = paragraphs_of(name)
    if f"{{{name}}}" in lines:
        place = lines.index(f"{{{name}}}")
        return [*lines[:place], *(line for one in paragraphs for line in one), *lines[place + 1 :]]
    for paragraph in paragraphs:
        head = ENTRY.fullmatch(paragraph[0])
        place = beginning(lines, head[1] if head else " ".join(paragraph[0].split()[:5]))
        lines = lines[:place] + paragraph + lines[paragraph_end(lines, place) :]
    return lines


def with_lists(lines: list[str], entry: str, names: Iterable[str]) -> list[str]:
    """Replace the first lists of quoted names in an entry, and break its lines again."""
    place = beginning(lines, entry)
    end = paragraph_end(lines, place)
    body = " ".join(" ".join(lines[place + 1 : end]).split())
    texts = iter([listed(LISTS[name]) for name in names])
    body = QUOTED.sub(lambda found: next(texts, found[0]), body)
    if next(texts, None) is not None:
        raise ValueError(f"the entry {entry!r} lists fewer names")
    broken = wrapped(body)
    return [*lines[: place + 1], *broken, *lines[end:]]


def with_docstring(lines: list[str], node: Function, change: Sequence[str]) -> list[str]:
    """Write the shared texts and lists into the docstring of a function."""
    docstring = node.body[0]
    assert isinstance(docstring, ast.Expr)
    first, last = docstring.lineno - 1, docstring.end_lineno
    indent = " " * docstring.col_offset
    doc = [line.removeprefix(indent) for line in lines[first:last]]
    for name in change:
        entry, _, argument = name.removesuffix(")").partition("(")
        doc = with_lists(doc, entry, argument.split()) if argument else with_text(doc, entry)
    return lines[:first] + [(indent + line).rstrip() for line in doc] + lines[last:]


def originals() -> dict[str, tuple[dict[str, str], list[str]]]:
    """Return the keyword-only parameters of each measure as written, and its tuple of options."""
    found = {}
    for file in (PACKAGE / "measures").glob("*.py"):
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef):
                found[node.name] = (keywords(node), handed_on(node))
    return found


def keywords(node: ast.FunctionDef) -> dict[str, str]:
    """Return the keyword-only parameters by name, as they are written."""
    return {
        a.arg: f"{a.arg}: {ast.unparse(a.annotation)}" + (f" = {written(d)}" if d else "")
        for a, d in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
        if a.annotation
    }


def written(default: ast.expr) -> str:
    """Return a default as the formatter writes it."""
    return ast.unparse(default).replace("'", '"')


def options_tuple(node: ast.FunctionDef) -> ast.Assign | None:
    """Return the statement ``options = (...)``."""
    for statement in node.body:
        if (
            isinstance(statement, ast.Assign)
            and ast.unparse(statement.targets[0]) == "options"
            and isinstance(statement.value, ast.Tuple)
        ):
            return statement
    return None


def handed_on(node: ast.FunctionDef) -> list[str]:
    """Return the names in the last tuple, which may be an argument instead of `options`."""
    tuples = [one for one in ast.walk(node.body[-1]) if isinstance(one, ast.Tuple)]
    statement = options_tuple(node)
    found = statement.value if statement else tuples[-1] if tuples else ast.Tuple([], ast.Load())
    assert isinstance(found, ast.Tuple)
    return [ast.unparse(name) for name in found.elts]


def with_signature(lines: list[str], node: ast.FunctionDef, wanted: str) -> list[str]:
    """Copy keyword-only parameters into a function."""
    known = originals()
    name, _, without = wanted.partition(" without ")
    parameters = keywords(node)
    if without:
        left_out = without.split(", ")
        given, order = known[name]
        copied = {key: text for key, text in given.items() if key not in left_out}
        parameters = copied
        lines = with_options(lines, node, order, given, left_out)
        lines = with_references(lines, node, list(copied), set(given), name)
    else:
        for group in names_in(wanted):
            original, _, names = group.strip().removesuffix(")").partition("(")
            for key in names.replace(" ", "").split(","):
                parameters[key] = known[original][0][key]
    begin = lines.index("    *,", node.lineno - 1)
    end = next(k for k in range(begin, len(lines)) if lines[k].startswith(") ->"))
    return lines[: begin + 1] + [f"    {text}," for text in parameters.values()] + lines[end:]


def with_options(
    lines: list[str],
    node: ast.FunctionDef,
    order: list[str],
    given: dict[str, str],
    left_out: list[str],
) -> list[str]:
    """Write the tuple of options: each by its name, one that the function lacks by its default."""
    statement = options_tuple(node)
    if statement is None:
        return lines
    values = [given[key].partition(" = ")[2] if key in left_out else key for key in order]
    inline = f"    options = ({', '.join(values)})"
    block = ["    options = (", *(f"        {value}," for value in values), "    )"]
    text = [inline] if len(inline) <= WIDTH else block
    return lines[: statement.lineno - 1] + text + lines[statement.end_lineno :]


def with_references(
    lines: list[str], node: ast.FunctionDef, names: list[str], known: set[str], original: str
) -> list[str]:
    """Write the names of parameters whose description is that of the original.

    Names that exceed a line are two entries or more, of which the last has further sentences.
    """
    docstring = node.body[0]
    entries = {
        place: found
        for place in range(docstring.lineno, docstring.end_lineno or 0)
        if (found := ENTRY.fullmatch(lines[place].strip()))
    }
    described = {one for e in entries.values() if " : " in e[0] for one in e[1].split(", ")}
    shared = [k for k, e in entries.items() if " : " not in e[0] and known & {*e[1].split(", ")}]
    if not shared:
        return lines
    first = [name for name in entries[shared[0]][1].split(", ") if name not in known]
    text = ", ".join([*first, *(name for name in names if name not in described)])
    *rows, last = [row.removesuffix(",") for row in textwrap.wrap(text, WIDTH - 4)]
    written = [
        line for row in rows for line in (f"    {row}", f"        As for :func:`{original}`.")
    ]
    return [*lines[: shared[0]], *written, f"    {last}", *lines[shared[-1] + 1 :]]


def rewritten(text: str) -> str:
    """Return the text of a file with everything that it shares."""
    for place in range(len(list(sources(text)))):
        source = list(sources(text))[place]
        lines = text.split("\n")
        for kind, wanted in source.pragmas:
            if kind == "Shared text":
                lines = with_docstring(lines, source.node, [n.strip() for n in names_in(wanted)])
        for kind, wanted in source.pragmas:
            if kind == "Signature" and isinstance(source.node, ast.FunctionDef):
                node = list(sources("\n".join(lines)))[place].node
                assert isinstance(node, ast.FunctionDef)
                lines = with_signature(lines, node, wanted)
        text = "\n".join(lines)
    return text


def main() -> None:
    """Write the files that are out of date, or report them."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument(
        "--check", action="store_true", help="write nothing; fail if a file differs"
    )
    check = parser.parse_args().check
    stale = []
    for file in sorted(PACKAGE.rglob("*.py")):
        before = file.read_text(encoding="utf-8")
        if not PRAGMA.search(before):
            continue
        try:
            after = rewritten(before)
        except ValueError as error:
            sys.exit(f"{file.relative_to(PACKAGE.parent)}: {error}")
        if after != before:
            stale.append(str(file.relative_to(PACKAGE.parent)))
            if not check:
                file.write_text(after, encoding="utf-8")
    if check and stale:
        sys.exit(f"run python .ci/shared_text.py; it would write {', '.join(stale)}")


if __name__ == "__main__":
    main()
