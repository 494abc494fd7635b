"""Linear surfaces of simulated curves, and where a measure is lowest on them."""
