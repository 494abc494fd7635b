"""How results and pictures of measurements are stored: compressed JSON, WebP of few colours."""

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
    """Save a figure as a small WebP: of 64 colours, enough for lines, without loss."""
    from PIL import Image

    pixels = io.BytesIO()
    figure.savefig(pixels, dpi=dpi)
    image = Image.open(pixels).convert("RGB")
    # The default method gives rare colours away, those of lines that others cover.
    method = Image.Quantize.MAXCOVERAGE
    few = image.quantize(64, method, kmeans=1, dither=Image.Dither.NONE)
    few.convert("RGB").save(file, lossless=True, quality=100, method=6)
