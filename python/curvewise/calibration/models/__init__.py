"""Models: their execution, their identity, and solvers as models."""
