"""Codes that answer challenges, one file each, all by the same door."""
