"""Display of results as text and in notebooks, for any kind of result."""
