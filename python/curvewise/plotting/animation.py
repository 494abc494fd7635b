"""Animation of a warping path: the current pair of points, and earlier pairs.

A frame shows the curves, the matched pairs so far in grey, and the current pair in black. Next to
them is the path through the table so far. Time: that of the path, and about 0.1 s for each frame.
matplotlib writes a GIF through Pillow, which it requires anyway.
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
    """Write an animated GIF of a DTW or Fréchet coupling of two curves.

    Parameters
    ----------
    P, Q : array_like, shape (n, d) and (m, d), or (n,) and (m,), d = 1 or 2
        The curves.
    file : path-like
        The file to write; an existing file is replaced.
    measure : {"dtw", "frechet"}
        The measure of the path.
    frames : int, default 60
        Number of frames, at least 2; not more than the pairs of the path.
    seconds : float, default 6
        Duration, rounded to a whole number of frames per second.
    normalized, names
        As in `plot_area`.
    **options
        Passed to `dtw_path` or `frechet_path`.

    Raises
    ------
    ValueError, TypeError
        As for `dtw_path` or `frechet_path`. If d > 2, frames or seconds are out of range, or the
        step pattern does not admit a path.
    ImportError
        If matplotlib is missing.
    OSError
        If the file cannot be written.

    Notes
    -----
    Time and memory of the path, and about 0.1 s for each frame.

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
