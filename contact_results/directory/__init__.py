"""Directory of a run: lock, atomic files, checkpoints, stop signals."""
