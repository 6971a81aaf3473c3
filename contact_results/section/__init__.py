"""The files of a result on a section: what `slipstick run` writes for finite elements."""
