"""The problem of a search: models, objective and parameter space."""
