"""The directory of a run: one writer, atomic files, checkpoints, signals."""
