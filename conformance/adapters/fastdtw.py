"""fastdtw: its approximation with radius 1, the default."""

from fastdtw import fastdtw

PACKAGE = "fastdtw"
NAME = "fastdtw, radius 1"
LICENCE = "MIT"
CHECKS = {"dtw": lambda P, Q: fastdtw(P, Q, dist=2)[0]}
OTHER = {"dtw": "an approximation by design: never below the value"}
