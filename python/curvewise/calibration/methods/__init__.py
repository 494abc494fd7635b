"""The methods that search, and one search from its start to its end."""
