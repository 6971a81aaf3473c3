"""Other contact codes on the challenges that they can solve, in a separate Python environment."""
