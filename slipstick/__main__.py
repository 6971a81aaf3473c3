"""`python -m slipstick` is the command `slipstick`."""

from slipstick.cli import main

main()
