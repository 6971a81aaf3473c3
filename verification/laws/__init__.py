"""Laws of frequency responses and influence coefficients."""
