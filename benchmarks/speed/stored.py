"""How results and pictures of measurements are stored: compressed JSON, PNG of few colours."""

from __future__ import annotations

import io
import json
import lzma
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def read_json(file: Path) -> dict[str, Any]:
    """Return results that were written before; nothing where there are none."""
    if not file.exists():
        return {}
    content: dict[str, Any] = json.loads(lzma.decompress(file.read_bytes()))
    return content


def write_json(file: Path, content: Mapping[str, object]) -> None:
    """Write results, compressed (``xzcat`` shows them), and make the folder for them."""
    file.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
    file.write_bytes(lzma.compress(text.encode(), preset=9))
    print(f"\nwritten: {file}")


def save_picture(figure: Figure, file: Path, dpi: int) -> None:
    """Save a figure as a PNG of modest size: of 256 colours, enough for lines."""
    from PIL import Image

    pixels = io.BytesIO()
    figure.savefig(pixels, dpi=dpi)
    image = Image.open(pixels).convert("RGB")
    # The default method gives rare colours away, those of lines that others cover.
    few = image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    few.save(file, optimize=True)
