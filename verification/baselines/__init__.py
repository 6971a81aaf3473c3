"""Recorded numbers, one file per case; `slipstick baseline --accept --because …` writes them."""
