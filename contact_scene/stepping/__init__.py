"""Load stepping: path of the load, increments, checkpoints."""
