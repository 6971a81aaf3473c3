"""Entry point of `python -m slipstick`, which runs the command line `slipstick`."""

from slipstick.cli import main

main()
