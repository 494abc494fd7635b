"""What is written down of runs and searches."""
