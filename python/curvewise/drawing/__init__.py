"""Pictures of arrays: curves, what links them, loops and their convergence, and the colours.

This package does not depend on measures or results. matplotlib is imported when something is drawn.
"""
