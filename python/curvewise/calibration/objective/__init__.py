"""From simulations to one number."""
