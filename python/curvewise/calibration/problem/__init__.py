"""What is searched: models, objective and space, put together."""
