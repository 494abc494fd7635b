"""Curves to draw, and what the artists of a picture show."""

from __future__ import annotations

import numpy as np

from curvewise import plotting


def loop(points: int, *, end: float = 2.2, stretch: float = 1.0) -> np.ndarray:
    """Return a hysteresis-like loop in units as unlike as strain and MPa."""
    angle = np.linspace(0.1, end * np.pi, points)
    return np.column_stack([0.02 * stretch * np.sin(angle), 400 * np.sin(angle + 0.6) + 20])


P, Q = loop(60), loop(41, stretch=1.1)
SERIES_P, SERIES_Q = np.sin(np.linspace(0, 9, 50)), 30 + np.cos(np.linspace(0, 8, 40))
SPACE_P, SPACE_Q = (np.column_stack([curve, curve[:, 0] ** 2]) for curve in (P, Q))


def in_box(points: np.ndarray, box: np.ndarray = P) -> np.ndarray:
    return (points - box.min(axis=0)) / np.ptp(box, axis=0)


def segments(artists: plotting.CurveArtists) -> np.ndarray:
    return np.array(artists.between.get_segments())


def polygons(artists: plotting.CurveArtists) -> np.ndarray:
    return np.array([path.vertices[:4] for path in artists.between.get_paths()])


def areas(quads: np.ndarray) -> np.ndarray:
    u, v = quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]
    return np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
