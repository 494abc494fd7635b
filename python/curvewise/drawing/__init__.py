"""Pictures of arrays: curves, what links them, loops and their convergence, and the colours.

Nothing here knows a measure or a result by name. matplotlib is imported when something is drawn.
"""
