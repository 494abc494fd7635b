"""The structs of curvewise.h, for the tests that call C by ctypes."""

from __future__ import annotations

import ctypes
from ctypes import (
    POINTER,
    Structure,
    c_char,
    c_double,
    c_int,
    c_int64,
    c_size_t,
    c_ssize_t,
    c_void_p,
)

import numpy as np

OK, INVALID_ARGUMENT, NO_MEMORY, FAILED, STOPPED, NO_ROOM = range(6)
MEASURES = ["area", "pcm", "frechet", "dtw", "curve_length", "frechet_continuous"]


def structure(name: str, *fields: tuple[str, type]) -> type[Structure]:
    return type(name, (Structure,), {"_fields_": list(fields)})


class Sized(Structure):
    """A struct that begins with its size, which the constructor sets, and `heads` pointers."""

    heads = 0

    def __init__(self, *values: object) -> None:
        super().__init__(ctypes.sizeof(type(self)), *[None] * self.heads, *values)


def sized(name: str, *fields: tuple[str, type]) -> type[Sized]:
    return type(name, (Sized,), {"_fields_": [("size", c_size_t), *fields]})


def options(name: str, *fields: tuple[str, type]) -> type[Sized]:
    """Return a struct of options, which has a control behind its size."""
    fields = ("control", c_void_p), *fields
    return type(name, (Sized,), {"_fields_": [("size", c_size_t), *fields], "heads": 1})


Curve = structure(
    "Curve", ("data", c_void_p), *((x, c_ssize_t) for x in ("n", "dim", "row_stride", "col_stride"))
)
Error = structure("Error", ("message", c_char * 256))
Area = options(
    "Area", ("spacing", c_int), ("crossing", c_int), ("squared", c_int), ("closed", c_int)
)
Pcm = options("Pcm", ("offsets", c_ssize_t), ("continuous", c_int))
PRUNING = ("prune", c_int), ("cutoff", c_double)
Frechet = options(
    "Frechet",
    ("metric", c_int),
    ("p", c_double),
    ("workers", c_ssize_t),
    *PRUNING,
    ("radius", c_double),
    ("closed", c_int),
)
Dtw = options(
    "Dtw",
    ("metric", c_int),
    ("p", c_double),
    *((x, c_int) for x in ("step_pattern", "open_begin", "open_end")),
    *((x, c_ssize_t) for x in ("window", "workers")),
    *PRUNING,
    ("window_fraction", c_double),
    ("normalize", c_int),
    ("penalty", c_double),
    ("radius", c_double),
    *((f"relax_{end}", c_ssize_t) for end in ("p_begin", "p_end", "q_begin", "q_end")),
    ("closed", c_int),
)
CurveLength = options("CurveLength", ("scale", c_int))
FrechetContinuous = options("FrechetContinuous", ("workers", c_ssize_t), ("closed", c_int))
Compare = options("Compare", ("preset", c_int))
Batch = options("Batch", ("workers", c_ssize_t), ("cutoff", c_double))
Search = options(
    "Search", ("workers", c_ssize_t), ("sort_results", c_int), ("with_distances", c_int)
)
Comparison = sized("Comparison", *((x, c_double) for x in MEASURES[:5]))
PcmPlace = sized(
    "PcmPlace",
    ("maps_p", c_int),
    *((x, c_double) for x in ("value", "offset", "coverage", "tolerance")),
)
Report = ctypes.CFUNCTYPE(c_int, c_void_p, c_int64, c_int64)


def view(points: np.ndarray) -> Structure:
    """Return the curve that an array is, of whatever strides; the array must outlive it."""
    strides = [stride // 8 for stride in points.strides]
    return Curve(points.ctypes.data, *points.shape, *strides)


def curves(*arrays: np.ndarray) -> ctypes.Array:
    return (Curve * len(arrays))(*map(view, arrays))


def doubles(array: np.ndarray) -> ctypes._Pointer:
    return array.ctypes.data_as(POINTER(c_double))


def integers(array: np.ndarray) -> ctypes._Pointer:
    return array.ctypes.data_as(POINTER(c_int64))


def walk(n: int, seed: int = 5, dim: int = 2) -> np.ndarray:
    return np.cumsum(np.random.default_rng(seed).normal(size=(n, dim)), axis=0)
