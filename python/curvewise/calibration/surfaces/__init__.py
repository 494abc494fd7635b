"""Surfaces of simulated curves, and where a measure is lowest on them."""
