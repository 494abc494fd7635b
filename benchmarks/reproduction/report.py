"""What the scripts share beside the problems: their options, tables, pictures and results.md.

Every script replaces its own sections of results.md, each between two comments that name it; the
text around them is written by hand.
"""

from __future__ import annotations

import argparse
import io
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent
SCRATCH = HERE.parents[1] / "build" / "paper"  # not under version control


class Run:
    """One run of a script: its options, and what it prints and writes."""

    def __init__(self, description: str | None, **defaults: int) -> None:
        """Read the command line; `defaults` are further whole-number options."""
        parser = argparse.ArgumentParser(description=(description or "").partition("\n")[0])
        parser.add_argument("--quick", action="store_true", help="small searches, for CI")
        parser.add_argument(
            "--output",
            type=Path,
            metavar="DIR",
            help="where results.md and the pictures go; default: beside this script, with "
            "--quick build/paper/quick",
        )
        for name, value in defaults.items():
            parser.add_argument(f"--{name}", type=int, default=value, help=f"default {value}")
        self.options = parser.parse_args()
        self.quick: bool = self.options.quick
        self.output: Path = self.options.output or (SCRATCH / "quick" if self.quick else HERE)
        self.output.mkdir(parents=True, exist_ok=True)
        self._start = time.perf_counter()

    def store(self, name: str) -> Path:
        """Return the file where the results of a study are stored, from which all is drawn."""
        return self.output / "optima" / f"{name}.json.xz"

    def section(self, name: str, text: str) -> None:
        """Print a section and put it into results.md, in the place of the one of that name."""
        print(f"\n{text}\n[{time.perf_counter() - self._start:.0f} s]", flush=True)
        file = self.output / "results.md"
        before = file.read_text() if file.exists() else ""
        begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
        head, found, rest = before.partition(begin)
        _, _, tail = rest.partition(end)
        separator = "" if found or not head else "\n"
        file.write_text(f"{head}{separator}{begin}{text.strip()}\n{end}{tail}")

    def picture(self, name: str, figure: Figure, *, stored: bool = True) -> None:
        """Save a figure as a small WebP: of 64 colours, enough for lines, without loss.

        One that is not `stored` goes to build/paper instead of the folder of the scripts.
        """
        from PIL import Image

        folder = self.output if stored or self.output != HERE else SCRATCH
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / f"{name}.webp"
        pixels = io.BytesIO()
        figure.savefig(pixels, dpi=90, facecolor="white")
        image = Image.open(pixels).convert("RGB")
        # The default method gives rare colours away, those of lines that others cover.
        method = Image.Quantize.MAXCOVERAGE
        few = image.quantize(64, method, kmeans=1, dither=Image.Dither.NONE)
        few.convert("RGB").save(file, lossless=True, quality=100, method=6)
        print(f"written: {file}", flush=True)


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table, its first column to the left, the others to the right."""
    rule = ["---", *["---:"] * (len(header) - 1)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (header, rule, *rows))


def legend_below(figure: Figure, panel: Axes) -> None:
    """Put one legend below all panels, with the labels of one of them."""
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
