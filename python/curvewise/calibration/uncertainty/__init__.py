"""What the tests determine: noise, sensitivities, intervals."""
