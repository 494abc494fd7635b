"""Pictures for the gallery that do not come from pyplot.

The package's own plots are plain figures of matplotlib, so that no window or memory is kept for
them. sphinx-gallery looks for figures of pyplot only; this takes the others, by the names that an
example gives them.
"""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst


def plain_figures(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figures that a block of an example has made, and return their place on the page."""
    seen = block_vars["example_globals"].setdefault("__figures_seen__", [])
    of_pyplot = [plt.figure(number) for number in plt.get_fignums()]
    files = []
    for value in list(block_vars["example_globals"].values()):
        if isinstance(value, Figure) and not any(value is one for one in seen + of_pyplot):
            seen.append(value)
            file = next(block_vars["image_path_iterator"])
            value.savefig(file, dpi=100)
            files.append(file)
    return str(figure_rst(files, gallery_conf["src_dir"])) if files else ""
