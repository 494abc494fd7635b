"""What all iterative methods here share: ratios for a trust region, and what is negligible.

A. R. Conn, N. I. M. Gould, Ph. L. Toint, "Trust-region methods", SIAM (2000), algorithm 6.1.1.
"""

from __future__ import annotations

__all__ = ["FEW", "GOOD", "POOR", "ROUNDING", "SHRUNK", "SMALL"]

# Ratios of actual to predicted reduction: a step below POOR has failed, one from GOOD on is good.
POOR, GOOD = 0.1, 0.7
SHRUNK = 0.4  # the region after a failed step, in lengths of the step
SMALL = 1e-4  # a part of a value, or of the bounds' range, that is negligible on a surrogate
ROUNDING = 1e-12  # the same for rounding errors
FEW = 10  # steps that suffice where each gains digits
