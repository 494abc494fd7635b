"""The records of runs and searches."""
