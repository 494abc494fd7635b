"""What a result shows of itself, as text and in a notebook; knows no result by name."""
