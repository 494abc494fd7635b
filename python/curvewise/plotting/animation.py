"""A moving picture of a warping: the pair of points that a path has come to, and those behind it.

A frame shows the curves, the matched pairs so far in grey, and the pair of now in black; beside
them the path through the table, as far as it has come. Time: that of the path, and some 0.1 s a
frame. A GIF is written by matplotlib through Pillow, which matplotlib brings.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from .._options import WarpingName
from ..curves.inputs import CurveLike
from ..drawing.figures import evenly, matplotlib_required, new_figure
from ..drawing.links import draw_path, label_places
from ..drawing.palette import ACCENT_COLOUR
from .measured import measured_and_drawn, warping_of

__all__ = ["animate_alignment"]


def animate_alignment(
    P: CurveLike,
    Q: CurveLike,
    file: str | os.PathLike[str],
    *,
    measure: WarpingName = "dtw",
    frames: int = 60,
    seconds: float = 6.0,
    normalized: bool = False,
    names: Sequence[str] | None = None,
    **options: Any,
) -> None:
    """Write how a DTW or Fréchet coupling walks along two curves, as an animated GIF.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    file : path-like
        What to write; what is there is replaced.
    measure : {"dtw", "frechet"}
        Whose path to walk along.
    frames : int, default 60
        How many pictures, at least 2; not more than the path has pairs.
    seconds : float, default 6
        How long they take, to a whole number of frames a second.
    normalized, names
        As in `plot_area`.
    **options
        Passed to `dtw_path` or `frechet_path`.

    Raises
    ------
    ValueError, TypeError
        Where `dtw_path` or `frechet_path` does; for d > 2, for frames or seconds out of range, and
        where the step pattern admits no path.
    ImportError
        Without matplotlib.
    OSError
        The file cannot be written.

    Notes
    -----
    Time and memory of the path, and some 0.1 s a frame.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from curvewise.plotting import animate_alignment
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     animate_alignment([0, 1, 2, 0], [0, 2, 0], Path(folder, "warping.gif"), frames=2)
    ...     Path(folder, "warping.gif").read_bytes()[:6]
    b'GIF89a'
    """
    if frames < 2 or frames % 1:
        raise ValueError(f"frames is {frames}; give a whole number >= 2")
    if not 0.0 < seconds < np.inf:
        raise ValueError(f"seconds is {seconds}; it must be finite and above 0")
    warping = warping_of(measure)
    refused = "animate_alignment draws 1 or 2 coordinates"
    measured, drawn, labels = measured_and_drawn(P, Q, normalized, names, refused)
    path = warping.path(*measured, **options).path
    if len(path) == 0:
        n, m = map(len, measured)
        raise ValueError(
            f"step_pattern admits no path between {n} and {m} points; use another step pattern"
        )
    figure = new_figure(figsize=(9.0, 4.2), layout="constrained")
    with matplotlib_required():
        from matplotlib.animation import FuncAnimation, PillowWriter
    left, right = figure.subplots(1, 2, width_ratios=(1.7, 1.0))
    artists = draw_path(left, drawn, path, labels, every=1)
    ends = [np.asarray(line.get_xydata()) for line in (artists.P, artists.Q)]
    links = np.stack([ends[k][path[:, k]] for k in (0, 1)], axis=1)
    (now,) = left.plot([], [], "o-", color=ACCENT_COLOUR, linewidth=2, markersize=5)
    (walked,) = right.plot([], [], color=ACCENT_COLOUR, linewidth=1.6)
    right.set(xlim=(-0.5, path[:, 1].max() + 0.5), ylim=(-0.5, path[:, 0].max() + 0.5))
    label_places(right, "index in", labels)
    places = evenly(len(path), int(frames))

    def show(place: int) -> list[Any]:
        artists.between.set_segments(list(links[evenly(place + 1)]))  # type: ignore[attr-defined]  # a LineCollection has it
        now.set_data(*links[place].T)
        walked.set_data(*path[: place + 1].T[::-1])
        return [artists.between, now, walked]

    moving = FuncAnimation(figure, show, frames=places.tolist(), blit=False)
    rate = max(1, round(len(places) / seconds))
    moving.save(os.fspath(file), writer=PillowWriter(fps=rate), dpi=80)
