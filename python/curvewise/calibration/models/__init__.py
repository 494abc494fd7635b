"""Models: what runs them, what they are called, and solvers as models."""
