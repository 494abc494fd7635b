"""Count sentences of pages, docstrings and comments, and hold bounds on their length and idioms.

``python .ci/prose.py`` prints a row for each group and fails if a row exceeds its bounds;
``python .ci/prose.py --worst docs`` lists the sentences of a group to rewrite first. Code, tables,
formulas, doctests and type lines are left out. Idioms are constructions that the style guide
replaces by plain words; the list stems from the habits of this repository.
"""

from __future__ import annotations

import argparse
import ast
import io
import re
import subprocess
import sys
import tokenize
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LONG = 30  # words


@dataclass(frozen=True)
class Bounds:
    """The largest mean length, share of long sentences in %, and idioms in 100 sentences."""

    mean: float
    long: float
    idioms: float


GROUPS = {
    "docs": Bounds(15.0, 4.0, 4.0),
    "root pages": Bounds(15.0, 4.0, 3.5),
    "python": Bounds(15.0, 4.0, 3.5),
    "cpp": Bounds(15.0, 4.0, 3.5),
    "benchmarks": Bounds(15.0, 4.0, 3.5),
    "examples": Bounds(15.0, 4.0, 3.5),
}
IDIOMS = re.compile(
    r"\b(?:(?:of|by|to) whom|(?:of|by) which|of whose|in (?:the )?place of|so many|as many as"
    r"|(?:one's|of (?:its|their)) own|valleys?|leash(?:es)?|hops?|anew|hardly|likewise|shall"
    r"|had better|(?:is|are) said|(?:say|know)s? (?:its|their|no)|goes? (?:by|over|on|with|through)"
    r"|alike|as (?:it is|they are)|beside|nobody|whoever"
    r"|what (?:it|they|is|are|was|were|has|can|there)|(?:is|are|has|have) no|none|mended"
    r"|by how (?:much|many)|looked (?:at|up)|stands?)\b",
    re.IGNORECASE,
)
# A full stop of these ends no sentence.
ABBREVIATIONS = re.compile(
    r"\b(e\.g|i\.e|et al|vs|cf|No|Fig|Eq|Proc|Trans|Soc|Am|Ph|[A-Z])\.(?=\s)"
)
END = re.compile(r"(?<=[.!?])[)\"”]?\s+(?=[A-Z0-9`\"“(])")
WORD = re.compile(r"[^\W_][\w'’./%–-]*")


def sentences(paragraphs: Iterable[str]) -> Iterator[str]:
    """Split paragraphs into sentences of at least three words, without markup."""
    for paragraph in paragraphs:
        text = re.sub(r"\{[\w:-]+\}(?=`)|:[\w:]+:(?=`)", "", paragraph)
        text = re.sub(r"``.+?``|`[^`]+`|\$[^$]+\$", "CODE", text)
        text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
        text = ABBREVIATIONS.sub(r"\1", re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", text))
        for sentence in END.split(" ".join(text.split())):
            if len(WORD.findall(sentence)) > 2:
                yield sentence


def joined(lines: Iterable[str]) -> Iterator[str]:
    """Join lines to paragraphs; an empty line ends one, and a list item begins one."""
    paragraph: list[str] = []
    for line in [*lines, ""]:
        item = re.match(r"\s*(?:[-*]|\d+\.)\s+", line)
        if (item or not line.strip()) and paragraph:
            yield " ".join(paragraph)
            paragraph = []
        if line.strip():
            paragraph.append(line[item.end() :] if item else line)


def markdown(text: str) -> Iterator[str]:
    """Return the paragraphs of a Markdown page."""
    text = re.sub(r"\A---\n.*?^---$|<!--.*?-->|\$\$.*?\$\$", "", text, flags=re.S | re.M)
    text = re.sub(r"^(```+|~~~+).*?^\1\s*$", "", text, flags=re.S | re.M)
    lines: list[str] = []
    is_code = False
    for line in text.split("\n"):
        is_code = bool(re.match(r"    |\t", line)) and (
            is_code or not lines or not lines[-1].strip()
        )
        skipped = is_code or re.match(r"\s*(?:\||#|!\[|:)", line)
        lines.append("" if skipped else line)
    yield from joined(lines)


def restructured(text: str) -> Iterator[str]:
    """Return the paragraphs of a reStructuredText page, without directives and titles."""
    lines: list[str] = []
    inside = False
    for line in text.split("\n"):
        inside = line.startswith(".. ") or (inside and (not line.strip() or line[0] == " "))
        if re.fullmatch(r"([=~^*-])\1+", line) and lines:
            lines[-1] = ""
        lines.append("" if inside or re.fullmatch(r"([=~^*-])\1+", line) else line)
    yield from joined(lines)


def docstring(text: str) -> Iterator[str]:
    """Return the paragraphs of a numpydoc docstring, without examples, headings and type lines."""
    lines: list[str] = []
    section = ""
    rows = text.split("\n")
    for line, below in zip(rows, [*rows[1:], ""], strict=True):
        if re.fullmatch(r"\s*-{3,}", below):
            section = line.strip()
        names = section not in ("", "Notes", "References", "See Also") and not line.startswith(" ")
        skipped = (
            section == "Examples"
            or section == line.strip()
            or names
            or re.match(r"\s*(?:>>>|\.\.\. |-{3,}|[=\s]+$|[\w*, .]+ : )", line)
        )
        lines.append("" if skipped else line)
    yield from joined(lines)


def runs(comments: Iterable[tuple[int, str, bool]]) -> Iterator[str]:
    """Join comments (line, text, alone) on consecutive lines of their own."""
    last = -2
    paragraph: list[str] = []
    for number, text, alone in comments:
        if paragraph and not (alone and number == last + 1 and text):
            yield " ".join(paragraph)
            paragraph = []
        paragraph.append(text)
        last = number if alone else -2
    yield " ".join(paragraph)


def python(text: str) -> Iterator[str]:
    """Return the paragraphs of docstrings and comments of a Python file."""
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, kinds) and (found := ast.get_docstring(node)):
            yield from docstring(found)
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    yield from runs(
        (token.start[0], token.string.lstrip("#! "), token.line.lstrip().startswith("#"))
        for token in tokens
        if token.type == tokenize.COMMENT and not re.match(r"#\s*(?:type:|noqa|fmt:)", token.string)
    )


def cpp(text: str) -> Iterator[str]:
    """Return the paragraphs of the comments of a C or C++ file."""
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    for block in re.findall(r"/\*(.*?)\*/", text, flags=re.S):
        yield from joined(re.sub(r"^\s*\*+ ?", "", line) for line in block.split("\n"))
    found = (
        (number, line, re.search(r"(?<!:)//+[!<]*\s*(.*)$", line))
        for number, line in enumerate(text.split("\n"))
    )
    comments = (
        (number, re.sub(r"[@\\]\w+|NOLINT\S*", "", match[1]), line.lstrip().startswith("//"))
        for number, line, match in found
        if match
    )
    yield from (one for one in runs(comments) if not one.lstrip().startswith("namespace"))


def group_of(name: str) -> str | None:
    """Return the group of a file, or None if it is not counted."""
    folder, _, rest = name.partition("/")
    if not rest:
        return "root pages" if name.endswith(".md") else None
    if folder in ("benchmarks", "conformance"):
        return "benchmarks" if name.endswith(".md") and "/results" not in name else None
    if name.startswith(("cpp/examples/", "examples/")):
        return "examples" if folder == "examples" else "cpp"
    return folder if folder in GROUPS else None


READERS = {".md": markdown, ".rst": restructured, ".py": python} | dict.fromkeys(
    (".hpp", ".cpp", ".h", ".c"), cpp
)


def counted() -> dict[str, list[tuple[str, str]]]:
    """Return the sentences of each group, with their files."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\n")
    found: dict[str, list[tuple[str, str]]] = {group: [] for group in GROUPS}
    for name in listed:
        reader, group = READERS.get(Path(name).suffix), group_of(name)
        if reader is None or group is None or "_templates" in name or not (ROOT / name).is_file():
            continue
        text = (ROOT / name).read_text(encoding="utf-8")
        found[group] += [(name, sentence) for sentence in sentences(reader(text))]
    return found


def length(sentence: str) -> int:
    """Return the number of words."""
    return len(WORD.findall(sentence))


def measured(texts: list[str]) -> Bounds:
    """Return the mean length, the share of long sentences, and idioms in 100 sentences."""
    lengths = [length(text) for text in texts]
    over = sum(words > LONG for words in lengths)
    idioms = sum(len(IDIOMS.findall(text)) for text in texts)
    count = max(len(texts), 1)
    return Bounds(sum(lengths) / count, 100 * over / count, 100 * idioms / count)


def worst(items: list[tuple[str, str]], count: int) -> list[str]:
    """Return the sentences with the most idioms, then the longest ones."""

    def rank(item: tuple[str, str]) -> tuple[int, int]:
        return len(IDIOMS.findall(item[1])), length(item[1])

    bad = [item for item in items if rank(item)[0] or rank(item)[1] > LONG]
    return [f"{name}: {text}" for name, text in sorted(bad, key=rank, reverse=True)[:count]]


def main() -> int:
    """Print the rows, or the worst sentences of a group; return 1 if a bound is exceeded."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--worst", choices=[*GROUPS], help="list sentences of this group")
    parser.add_argument("--count", type=int, default=20, help="how many (default: 20)")
    arguments = parser.parse_args()
    found = counted()
    if arguments.worst:
        print("\n\n".join(worst(found[arguments.worst], arguments.count)))
        return 0
    failed = False
    for group, bounds in GROUPS.items():
        now = measured([text for _, text in found[group]])
        row = f"{group:11} {len(found[group]):6} sentences, mean {now.mean:4.1f} words, "
        row += f"{now.long:3.1f} % above {LONG}, {now.idioms:4.1f} idioms in 100"
        print(row)
        if now.mean > bounds.mean or now.long > bounds.long or now.idioms > bounds.idioms:
            failed = True
            print(
                f"{group}: at most {bounds.mean} words, {bounds.long} %, {bounds.idioms} idioms; "
                f"python .ci/prose.py --worst '{group}' lists what to rewrite",
                file=sys.stderr,
            )
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
