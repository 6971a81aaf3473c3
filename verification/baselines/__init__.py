"""Recorded numbers, one file per case, written by `slipstick maintain baseline --accept`."""
