"""Many curves: all distances, the nearest, runs of a long curve, and means."""
