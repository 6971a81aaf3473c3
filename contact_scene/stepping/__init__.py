"""Load stepping: load path, increments, increment error and checkpoints of a load history."""
