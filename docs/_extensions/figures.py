"""Pictures of the gallery: each for a light page and a dark one, and one panel as the thumbnail.

The package's own plots are plain figures of matplotlib, so that no window or memory is kept for
them; they are taken by the names that an example gives them, those of pyplot by their numbers. A
figure is saved as it is, then with its greys turned round and on no ground, and the page shows the
one that its reader's theme asks for. Of an example's first figure the first panel, alone and
without title and legend, becomes the thumbnail: all panels together would be too small to read.
"""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.cm import ScalarMappable
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.ticker import MaxNLocator
from sphinx.application import Sphinx

_COLOURS = ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor")
_thumbnails: dict[Path, Path] = {}


def every_figure(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figures that a block of an example has made, and return their place on the page."""
    names = block_vars["example_globals"]
    seen = names.setdefault("__figures_seen__", [])
    figures = [plt.figure(number) for number in plt.get_fignums()]
    figures += [value for value in names.values() if isinstance(value, Figure)]
    text = ""
    for figure in figures:
        if any(figure is one for one in seen):
            continue
        light = Path(next(block_vars["image_path_iterator"]))
        dark = light.with_stem(f"{light.stem}_dark")
        figure.savefig(light, dpi=100)
        darkened(figure).savefig(dark, dpi=100, transparent=True)
        for file, shown in ((light, "only-light"), (dark, "only-dark")):
            path = file.resolve().relative_to(Path(gallery_conf["src_dir"]).resolve()).as_posix()
            text += f"\n.. image:: /{path}\n   :alt: {described(figure)}\n"
            text += f"   :class: sphx-glr-single-img {shown}\n"
        if not seen:
            thumbnail = f"sphx_glr_{Path(block_vars['src_file']).stem}_thumb.png"
            saved = light.with_stem(f"{light.stem}_panel")
            first_panel(figure).savefig(saved, dpi=150)
            _thumbnails[light.parent / "thumb" / thumbnail] = saved
        seen.append(figure)
    plt.close("all")
    return text


def described(figure: Figure) -> str:
    """Return what a reader hears who does not see a figure: its panels' titles, or their axes."""
    panels = (
        ax.get_title() or f"{ax.get_ylabel()} over {ax.get_xlabel()}"
        for ax in figure.axes
        if ax.get_title() or ax.get_xlabel()
    )
    return "; ".join(panels).replace("\n", " ") or "a figure"


def darkened(figure: Figure) -> Figure:
    """Return a copy with its greys turned round, black for white, and its colours a bit lighter."""
    figure = pickle.loads(pickle.dumps(figure))
    figure.draw_without_rendering()  # ticks are made when they are drawn
    on_images = {id(line) for ax in figure.axes if ax.images for line in ax.lines}
    for artist in {id(artist): artist for artist in figure.findobj(Artist)}.values():
        is_image = isinstance(artist, ScalarMappable) and artist.get_array() is not None
        if is_image or id(artist) in on_images:
            continue  # its colours are numbers, or it lies on what stays as it is
        for name in _COLOURS:
            get, put = (getattr(artist, f"{verb}_{name}", None) for verb in ("get", "set"))
            if get is None or put is None:
                continue
            colours = to_rgba_array(get())
            is_grey = np.ptp(colours[:, :3], axis=1) < 0.05
            colours[is_grey, :3] = 0.93 - 0.85 * colours[is_grey, :3]
            colours[~is_grey, :3] = 0.2 + 0.8 * colours[~is_grey, :3]
            if len(colours):
                put(colours if len(colours) > 1 else tuple(colours[0]))
    for ax in figure.axes:
        ax.tick_params(which="both", colors="0.93")  # also those that are made anew
    return figure


def first_panel(figure: Figure) -> Figure:
    """Return a copy with the first panel alone, without title and legend."""
    figure = pickle.loads(pickle.dumps(figure))
    first, *others = figure.axes
    for ax in others:
        colorbar = getattr(ax, "_colorbar", None)
        (colorbar or ax).remove()
    for legend in (first.get_legend(), *figure.legends):
        if legend is not None:
            legend.remove()
    first.set_title("")
    if len(first.get_ylabel()) > 20:
        first.set_ylabel("")
    if hasattr(first, "set_zlabel"):
        first.set_zlabel("")  # for which no layout leaves room
    first.set_subplotspec(GridSpec(1, 1, figure=figure)[0])
    for axis in (first.xaxis, first.yaxis):
        if isinstance(axis.get_major_locator(), MaxNLocator):
            axis.set_major_locator(MaxNLocator(4))
    figure.set_size_inches(3.6, 2.5)
    return figure


def write_thumbnails(app: Sphinx) -> None:
    """Put the panels in the place of the thumbnails that the gallery has made."""
    for thumbnail, saved in _thumbnails.items():
        saved.replace(thumbnail)


def setup(app: Sphinx) -> dict[str, Any]:
    """Come after the gallery's run (500)."""
    app.connect("builder-inited", write_thumbnails, priority=600)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
