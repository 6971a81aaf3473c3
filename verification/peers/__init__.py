"""Other contact codes that solve the challenges, installed in a separate Python environment."""
